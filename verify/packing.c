/* verify/packing.c - how densely spheres pack: packing jam SEEDS GRAINS, packing measure BED.NC.
 *
 * jam: equal spheres without friction in a periodic box, the protocol of [OHern03]: random points,
 * swollen to a solid fraction of 0.66, are brought to the least energy of harmonic overlaps, then
 * let out in steps, each at rest (net force below 1e-7 of a contact's). Harmonic springs give a
 * pressure that is linear in the solid fraction and a coordination that grows with the root of the
 * pressure: straight lines in these are taken to pressure 0, where the packing is just jammed.
 * Rattlers (fewer than 4 contacts, again and again until none is left) do not count in the
 * coordination, and do in the solid fraction.
 *
 * measure: solid fraction of a settled bed between 0.2 and 0.7 of its height, and the coordination
 * there, rattlers excluded (fewer than 2 contacts, friction) and not. */
#include <gsl/gsl_fit.h>
#include <gsl/gsl_rng.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>
#include "../solver/bed_file.h"
#include "../solver/fill_relax.h"

#define PI 3.14159265358979323846

enum { STATES = 12 };

/* Solid fraction, pressure (of unit springs, over 1/d), contacts per grain that is no rattler. */
struct state {
    double phi, pressure, coordination, rattlers;
};

static double coordination(const struct fill_grid *b, double *pressure, double *rattlers,
                           int least, double lo, double hi)
{
    enum { MOST = 32 };
    const int n = b->n;
    const double d = b->grain[0].diameter;
    int *const near = xalloc((size_t)n * MOST, sizeof *near), *const count = xalloc(
                                                                  (size_t)n, sizeof *count);
    bool *const out = xalloc((size_t)n, sizeof *out);
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        count[i] = fill_grid_near(b, i, 0.0, &near[(size_t)i * MOST], MOST);
        for (int k = 0; k < count[i]; k++) {
            const vec3 r = domain_minimum_image(
                b->domain, v3_sub(b->grain[i].pos, b->grain[near[i * MOST + k]].pos));
            sum += 0.5 * (d - v3_norm(r)) * v3_norm(r);
        }
    }
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < n; i++) {
            int held = 0;
            for (int k = 0; k < count[i]; k++)
                held += !out[near[i * MOST + k]];
            if (!out[i] && held < least)
                again = out[i] = true;
        }
    }
    double contacts = 0.0, grains = 0.0, free = 0.0;
    for (int i = 0; i < n; i++) {
        if (b->grain[i].pos.z < lo || b->grain[i].pos.z > hi)
            continue;
        free += out[i];
        grains += !out[i];
        for (int k = 0; k < count[i] && !out[i]; k++)
            contacts += !out[near[i * MOST + k]];
    }
    *pressure = sum / (3.0 * b->domain->size[0] * b->domain->size[1] * b->domain->size[2]) * d;
    *rattlers = free / (free + grains);
    xfree(near);
    xfree(count);
    xfree(out);
    return grains > 0.0 ? contacts / grains : 0.0;
}

static void swell(struct fill_grid *b, double phi)
{
    const double volume = b->domain->size[0] * b->domain->size[1] * b->domain->size[2];
    const double d = cbrt(phi * volume / (PI / 6.0 * b->n));
    for (int i = 0; i < b->n; i++)
        b->grain[i].diameter = d;
    b->widest = d;
}

/* One packing: its jammed solid fraction and coordination, extrapolated. */
static bool jam(unsigned long seed, int n, double *phi_j, double *z_j, double *rattlers)
{
    struct domain box = {.size = {1.0, 1.0, 1.0},
                         .periodic = {true, true, true},
                         .image = {1.0, 1.0, 1.0},
                         .inv_image = {1.0, 1.0, 1.0}};
    const struct fill_region all = {.to = {1.0, 1.0, 1.0}, .open = {true, true, true}};
    static const double excess[STATES] = {0.66,   0.656, 0.653,  0.651,  0.6495, 0.648,
                                          0.6465, 0.645, 0.6437, 0.6425, 0.6413, 0.6402};
    struct state state[STATES];
    struct fill_grid b;
    int jammed = 0;
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    fill_grid_open(&b, &box, 1.0 / cbrt(n), n);
    for (int i = 0; i < n; i++)
        fill_grid_add(&b, (struct placed){v3(gsl_rng_uniform(rng), gsl_rng_uniform(rng),
                                             gsl_rng_uniform(rng)),
                                          1.0 / cbrt(n), 0});
    gsl_rng_free(rng);
    for (int k = 0; k < STATES; k++) {
        struct state *const s = &state[jammed];
        swell(&b, excess[k]);
        const struct relaxed r = fill_relax(
            &b, 0, &all, &(struct relax_goal){.scale = 1.0, .balance = 1e-7, .sweeps = 40000});
        s->phi = excess[k];
        s->coordination = coordination(&b, &s->pressure, &s->rattlers, 4, 0.0, 1.0);
        printf("    seed %lu: solid %.4f, pressure %.3e, coordination %.3f, rattlers %.1f %%, "
               "balance %.1e, %d sweeps\n",
               seed, s->phi, s->pressure, s->coordination, 100.0 * s->rattlers, r.balance,
               r.sweeps);
        fflush(stdout);
        if (r.overlap <= 0.0 || r.balance > 1e-6) /* not jammed, or too near to come to rest */
            break;
        jammed++;
    }
    fill_grid_close(&b);
    double x[STATES], root[STATES], phi[STATES], z[STATES], slope, c[3], square;
    const int from = jammed > 6 ? jammed - 6 : 0; /* the six nearest to pressure 0 */
    for (int k = from; k < jammed; k++) {
        x[k] = state[k].pressure;
        root[k] = sqrt(state[k].pressure);
        phi[k] = state[k].phi;
        z[k] = state[k].coordination;
    }
    if (jammed - from < 3)
        return false;
    gsl_fit_linear(x + from, 1, phi + from, 1, (size_t)(jammed - from), phi_j, &slope, c, c + 1,
                   c + 2, &square);
    gsl_fit_linear(root + from, 1, z + from, 1, (size_t)(jammed - from), z_j, &slope, c, c + 1,
                   c + 2, &square);
    *rattlers = state[jammed - 1].rattlers;
    return true;
}

static int jam_all(int seeds, int n)
{
    double phi = 0.0, z = 0.0, rattlers = 0.0;
    int good = 0;
    for (int k = 1; k <= seeds; k++) {
        double p, c, r;
        if (!jam((unsigned long)k, n, &p, &c, &r)) {
            printf("    seed %d: too few jammed states to extrapolate\n", k);
            continue;
        }
        printf("  seed %d, %d spheres: at pressure 0 solid fraction %.4f, coordination %.3f; "
               "%.1f %% rattlers\n",
               k, n, p, c, 100.0 * r);
        phi += p;
        z += c;
        rattlers += r;
        good++;
    }
    if (good == 0)
        return 1;
    phi /= good, z /= good, rattlers /= good;
    const bool pass = fabs(phi - 0.64) <= 0.005 && fabs(z - 6.0) <= 0.1;
    printf("  without friction: solid fraction %.4f (0.64 +- 0.005), coordination %.3f (6.0 +- "
           "0.1), rattlers %.1f %%: %s\n",
           phi, z, 100.0 * rattlers, pass ? "pass" : "FAIL");
    return !pass;
}

/* Part of a ball of radius r at height z that lies below h, m3. */
static double below(double z, double r, double h)
{
    const double t = fmin(fmax(h - z, -r), r);
    return PI * (r * r * (t + r) - (t * t * t + r * r * r) / 3.0);
}

static int measure(const char *path)
{
    struct bed_file f;
    struct domain box = {.periodic = {true, true, false}};
    int nc;
    char *const why = bed_file_read(&f, path, NULL);
    if (why || nc_open(path, NC_NOWRITE, &nc) ||
        nc_get_att_double(nc, NC_GLOBAL, "domain_size", box.size))
        die(EXIT_SCENE, "%s", why ? why : path);
    for (int a = 0; a < 2; a++) {
        box.image[a] = box.size[a];
        box.inv_image[a] = 1.0 / box.size[a];
    }
    struct fill_grid b;
    double top = 0.0, solid = 0.0, pressure, rattlers;
    fill_grid_open(&b, &box, f.diameter[0], f.n);
    for (int i = 0; i < f.n; i++) {
        fill_grid_add(&b, (struct placed){domain_wrap(&box, f.pos[i]), f.diameter[i], 0});
        top = fmax(top, f.pos[i].z);
    }
    const double lo = 0.2 * top, hi = 0.7 * top;
    for (int i = 0; i < f.n; i++)
        solid += below(f.pos[i].z, 0.5 * f.diameter[i], hi) -
                 below(f.pos[i].z, 0.5 * f.diameter[i], lo);
    solid /= (hi - lo) * box.size[0] * box.size[1];
    const double z = coordination(&b, &pressure, &rattlers, 2, lo, hi);
    const double all = coordination(&b, &pressure, &rattlers, 0, lo, hi);
    coordination(&b, &pressure, &rattlers, 2, lo, hi);
    const bool pass = fabs(solid - 0.60) <= 0.02;
    printf(
        "  poured, friction 0.5: solid fraction %.4f (0.60 +- 0.02), coordination %.3f without "
        "rattlers (%.1f %%), %.3f with: %s\n",
        solid, z, 100.0 * rattlers, all, pass ? "pass" : "FAIL");
    return !pass;
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "jam") == 0)
        return jam_all(atoi(argv[2]), atoi(argv[3]));
    if (argc == 3 && strcmp(argv[1], "measure") == 0)
        return measure(argv[2]);
    die(EXIT_SCENE, "usage: packing jam SEEDS GRAINS | packing measure BED.NC");
}
