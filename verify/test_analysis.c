/* verify/test_analysis.c - what is measured of the contacts, where the answer is known in closed form:
 * stress of two spheres pressed together, fabric and coordination of lattices, the stress in a bed at
 * rest, the list of contacts against the walls' forces; the same bits on any number of threads. */
/* slots: contact/hertz_mindlin */
#include <netcdf.h>
#include <omp.h>
#include <string.h>
#include "check.h"
#include "harness.h"
#include "../solver/output_file.h"
#include "../solver/region.h"

#define MATERIAL                                                                               \
    "[material m]\nyoung = 2e7 Pa\npoisson = 0.3\nrestitution = 0.2\nfriction = 0.5\n"
#define PERIODIC "x = periodic\ny = periodic\nz = periodic\ngravity = 0 0 0 m/s2\n"

/* Two spheres across a periodic edge, the line of centres oblique. */
static void check_two(void)
{
    const double d = 3e-3, l = 2.97e-3, n[3] = {0.48, 0.6, 0.64}, edge = 12e-3;
    char *const text = xprintf(
        "[grains a]\ndiameter = %.17g m\ndensity = 2385 kg/m3\nfill = point\n"
        "material = m\nposition = 0.3 0.2 0.4 mm\n"
        "[grains b]\ndiameter = %.17g m\ndensity = 2385 kg/m3\nfill = point\n"
        "material = m\nposition = %.17g %.17g %.17g m\n"
        "[domain]\nsize = 12 12 12 mm\n" PERIODIC
        "[region all]\n[region part]\nfrom = 0 0 0 mm\nto = 0.3 12 12 mm\n"
        "[run]\nend = 1 s\n" MATERIAL,
        d, d, edge + 0.3e-3 - l * n[0], edge + 0.2e-3 - l * n[1], edge + 0.4e-3 - l * n[2]);
    struct sim *const s = sim_from(text);
    analysis_sample(s);
    const struct region *const all = region_find(s, "all"), *const part =
                                                                region_find(s, "part");
    const double e_star = 2e7 / (2.0 * (1.0 - 0.09));
    const double force = 4.0 / 3.0 * e_star * sqrt(0.25 * d) * pow(d - l, 1.5);
    const double unit = force * l / (edge * edge * edge);
    check_rel(all->stress[0][0], unit * n[0] * n[0], 1e-9, "two spheres: stress xx");
    check_rel(all->stress[1][2], unit * n[1] * n[2], 1e-9, "two spheres: stress yz");
    check_rel(all->stress[2][1], unit * n[1] * n[2], 1e-9, "two spheres: stress zy");
    check_rel(all->pressure, unit / 3.0, 1e-9, "two spheres: pressure");
    check_rel(all->deviator, unit, 1e-9, "two spheres: deviator");
    check_rel(all->principal[0], unit, 1e-9, "two spheres: largest principal stress");
    check_rel(all->anisotropy, 1.0, 1e-9, "two spheres: fabric");
    /* the box holds the part of the branch between x = 0 and the grain at x = 0.3 mm */
    const double piece = 0.3e-3 / (l * n[0]);
    check_rel(part->stress[0][0] * part->volume, piece * force * l * n[0] * n[0], 1e-9,
              "two spheres: part of the branch in a box at the periodic side");
    check_rel(all->coordination, 1.0, 1e-12, "two spheres: a contact each");
    sim_free(s);
    xfree(text);
}

static void check_lattice(const char *cell, double spacing, double z, double grains)
{
    char *const text =
        xprintf("[grains a]\ndiameter = 1.002 mm\ndensity = 2385 kg/m3\nfill = unit_cell\n"
                "cell = %s\nspacing = %.17g mm\nmaterial = m\n"
                "[domain]\nsize = %.17g %.17g %.17g mm\n" PERIODIC
                "[output]\ncoordination = on\n[region all]\n[run]\nend = 1 s\n" MATERIAL,
                cell, spacing, 4.0 * spacing, 5.0 * spacing, 6.0 * spacing);
    struct sim *const s = sim_from(text);
    analysis_sample(s);
    const struct region *const r = region_find(s, "all");
    check(s->grains.n == 120 * (int)grains, "%s: %d grains", cell, s->grains.n);
    check_rel(r->coordination, z, 1e-12, "lattice: coordination of the region");
    check_rel(*s->series.entry[0].value, z, 1e-12, "lattice: coordination");
    check_rel(*s->series.entry[1].value, z, 1e-12, "lattice: without rattlers");
    check_abs(r->anisotropy, 0.0, 1e-9, "lattice: isotropic fabric");
    check_rel(r->fabric[1][1], 1.0 / 3.0, 1e-9, "lattice: fabric");
    check_abs(r->deviator / r->pressure, 0.0, 1e-8, "lattice: isotropic stress");
    /* virial: 3 p V = sum of f l over the contacts */
    const double l = 1e-3, d = 1.002e-3, e_star = 2e7 / (2.0 * (1.0 - 0.09));
    const double force = 4.0 / 3.0 * e_star * sqrt(0.25 * d) * pow(d - l, 1.5);
    check_rel(r->pressure, s->grains.n * z / 2.0 * force * l / (3.0 * r->volume), 1e-6,
              "lattice: pressure");
    check_rel(r->solid, s->grains.n * PI / 6.0 * d * d * d / r->volume, 1e-10,
              "lattice: solid fraction");
    sim_free(s);
    xfree(text);
}

/* A closed chain of three: each of its grains has two contacts, which bear only with friction. */
static void check_rattlers(const char *friction, double bear)
{
#define LINK(name, z)                                                                          \
    "[grains " name "]\ndiameter = 3.01 mm\ndensity = 2385 kg/m3\nfill = point\n"              \
    "material = m\nposition = 3.1 2.9 " z " mm\n"
    char *const text = xprintf(
        LINK("a", "0.7") LINK("b", "3.7") LINK(
            "c", "6.7") "[domain]\nsize = 12 12 9 mm\n" PERIODIC
                        "[output]\ncoordination = on\n[run]\nend = 1 s\n[material m]\n"
                        "young = 2e7 Pa\npoisson = 0.3\nrestitution = 0.2\nfriction = %s\n",
        friction);
    struct sim *const s = sim_from(text);
    analysis_sample(s);
    check_abs(*s->series.entry[0].value, 2.0, 0.0, "chain: coordination");
    check_abs(*s->series.entry[1].value, 2.0 * bear, 0.0, "chain: without rattlers");
    check_abs(*s->series.entry[2].value, 1.0 - bear, 0.0, "chain: rattlers");
    sim_free(s);
    xfree(text);
}

#define BED                                                                                    \
    "[grains a]\ndiameter = 1 mm\ndensity = 2385 kg/m3\nfill = random\ncount = 96\n"           \
    "material = m\nfrom = 0 0 0 mm\nto = 4 4.2 10 mm\n"                                        \
    "[domain]\nsize = 4 4.2 14 mm\ny = periodic\n"                                             \
    "[output]\ncontacts = on\ncoordination = on\nrattlers = 2\n"                               \
    "[region low]\nto = 4 4.2 1.37 mm\n[region middle]\nfrom = 0 0 1.7 mm\nto = 4 4.2 3.13 "   \
    "mm\n"                                                                                     \
    "[region side]\nfrom = 1.1 2.3 0.7 mm\nto = 3.1 4.1 2.2 mm\n"                              \
    "[run]\nend = 1 s\ndt = 7 us\nsubsteps = 100\n"                                            \
    "[material m]\nyoung = 8e6 Pa\npoisson = 0.3\nrestitution = 0.2\nfriction = 0\n"

/* The bed after so many steps, or at rest. */
static struct sim *bed(int threads, int steps)
{
    omp_set_num_threads(threads);
    struct sim *const s = sim_from(BED);
    ledger_start(s);
    for (int k = 0; k < steps; k++) {
        step(s);
        if (k > 100 && s->ledger.kinetic < 1e-15)
            break;
    }
    return s;
}

/* N m; the weight above a place, integrated over the heights of a layer. */
static double weight_above(const struct sim *s, double lo, double hi)
{
    const struct grains *const g = &s->grains;
    double sum = 0.0;
    for (int i = 0; i < g->n; i++)
        sum += 9.81 * g->mass[i] * fmin(fmax(g->pos[i].z - lo, 0.0), hi - lo);
    return sum;
}

static void check_weight(struct sim *s)
{
    analysis_sample(s);
    const struct region *const low = region_find(s, "low"), *const mid =
                                                                region_find(s, "middle");
    const double side = v3_norm(s->walls.wall[0].force) + v3_norm(s->walls.wall[1].force);
    vec3 shear = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < 2; k++) /* the walls at x bear a part by friction */
        shear = v3_add(shear, s->walls.wall[k].force);
    check(side > 0.0, "the walls are pressed");
    check_abs(low->velocity.z, 0.0, 1e-6, "the bed rests");
    double weight = 0.0, floor = 0.0;
    for (int i = 0; i < s->grains.n; i++)
        weight += 9.81 * s->grains.mass[i];
    for (int k = 0; k < s->walls.n; k++)
        floor -= s->walls.wall[k].force.z;
    check_rel(floor, weight, 1e-4, "the walls bear the weight");
    /* sum over the layer of z-forces: weight above, less what the walls bear below by friction */
    const struct contact_view *const v = contact_view(s);
    double want_low = weight_above(s, 0.0, 1.37e-3),
           want_mid = weight_above(s, 1.7e-3, 3.13e-3);
    for (size_t k = 0; k < v->n; k++) {
        const struct seen *const c = &v->seen[k];
        if (c->wall < 0 || strcmp(s->walls.wall[c->wall].name, "z-") == 0)
            continue;
        const double z =
            s->grains.pos[c->i].z; /* a side holds the grain up: all below it bears less */
        want_low -= c->force.z * fmin(fmax(z, 0.0), 1.37e-3);
        want_mid -= c->force.z * fmin(fmax(z - 1.7e-3, 0.0), 1.43e-3);
    }
    check_rel(low->stress[2][2] * low->volume, want_low, 1e-4, "stress in the lowest layer");
    check_rel(mid->stress[2][2] * mid->volume, want_mid, 1e-4, "stress in a layer within");
    check(region_find(s, "side")->contacts > 10.0, "a box within the bed holds contacts: %g",
          region_find(s, "side")->contacts);
}

static void check_list(struct sim *s)
{
    char folder[] = "/tmp/silt-analysis-XXXXXX";
    if (!mkdtemp(folder))
        abort();
    s->run.directory = xstrdup(folder);
    struct output_file f;
    output_file_open(&f, s, "run.nc");
    analysis_define(s, &f);
    output_file_begin(&f, s);
    for (int k = 0; k < 2; k++) {
        analysis_record(s, &f);
        output_file_record(&f, s);
    }
    output_file_close(&f);
    char *const path = xprintf("%s/run.nc", folder);
    int nc, var, dim, listed[2];
    size_t n = 0;
    check(nc_open(path, NC_NOWRITE, &nc) == NC_NOERR, "the list of contacts is written");
    check(nc_inq_varid(nc, "contacts_listed", &var) == NC_NOERR &&
              nc_get_var_int(nc, var, listed) == NC_NOERR &&
              nc_inq_dimid(nc, "contact", &dim) == NC_NOERR &&
              nc_inq_dimlen(nc, dim, &n) == NC_NOERR,
          "it says how many");
    check(listed[0] > 150 && listed[0] == listed[1] && n == 2 * (size_t)listed[0],
          "twice %d contacts, %zu rows", listed[0], n);
    int *const a = xalloc(2 * n, sizeof *a), *const b = a + n;
    double *const force = xalloc(3 * n, sizeof *force);
    nc_inq_varid(nc, "contact_grain", &var);
    nc_get_var_int(nc, var, a);
    nc_inq_varid(nc, "contact_other", &var);
    nc_get_var_int(nc, var, b);
    nc_inq_varid(nc, "contact_force", &var);
    nc_get_var_double(nc, var, force);
    double wall[6][3] = {{0.0}}, worst = 0.0;
    double *const on = xalloc(3 * (size_t)s->grains.n, sizeof *on); /* by id */
    for (size_t k = 0; k < (size_t)listed[0]; k++)
        for (int c = 0; c < 3; c++) {
            on[3 * a[k] + c] += force[3 * k + c];
            if (b[k] >= 0)
                on[3 * b[k] + c] -= force[3 * k + c];
            else
                wall[-1 - b[k]][c] -= force[3 * k + c];
        }
    for (int k = 0; k < s->walls.n; k++) {
        const vec3 w = s->walls.wall[k].force;
        worst = fmax(worst, v3_norm(v3_sub(w, v3(wall[k][0], wall[k][1], wall[k][2]))));
    }
    check(worst < 1e-15, "forces of wall contacts add up to those on the walls: off by %.3g N",
          worst);
    worst = 0.0;
    for (int i = 0; i < s->grains.n; i++) {
        const double *const p = &on[3 * s->grains.id[i]];
        worst = fmax(worst, v3_norm(v3_sub(s->grains.force[i], v3(p[0], p[1], p[2]))));
    }
    check(worst < 1e-15, "forces of all contacts add up to those on the grains: off by %.3g N",
          worst);
    nc_close(nc);
    xfree(a);
    xfree(force);
    xfree(on);
    unlink(path);
    rmdir(folder);
    xfree(path);
}

/* FNV-1a over the contacts seen. */
static unsigned long view_bits(struct sim *s)
{
    const struct contact_view *const v = contact_view(s);
    unsigned long h = 14695981039346656037ul;
    for (size_t k = 0; k < v->n; k++) {
        const struct seen *const c = &v->seen[k];
        const double x[] = {c->force.x, c->force.y,  c->force.z,
                            c->point.x, c->branch.y, c->depth};
        for (size_t b = 0; b < sizeof x; b++)
            h = (h ^ ((const unsigned char *)x)[b]) * 1099511628211ul;
    }
    return h;
}

int main(void)
{
    check_two();
    check_rattlers("0.3", 1.0);
    check_rattlers("0", 0.0);
    check_lattice("simple_cubic", 1.0, 6.0, 1.0);
    check_lattice("bcc", 2.0 / sqrt(3.0), 8.0, 2.0);
    check_lattice("fcc", sqrt(2.0), 12.0, 4.0);
    struct sim *const rest = bed(1, 3000);
    check_weight(rest);
    check_list(rest);
    sim_free(rest);
    unsigned long bits[3];
    const int threads[] = {1, 3, 16};
    for (int k = 0; k < 3; k++) {
        struct sim *const s = bed(threads[k], 60);
        bits[k] = view_bits(s);
        check(s->neighbours.touching > 30 && bits[k] == bits[0],
              "the same %ld contacts, bit for bit, on 1 and %d threads", s->neighbours.touching,
              threads[k]);
        sim_free(s);
    }
    return check_end();
}
