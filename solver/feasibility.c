/* feasibility.c - the limits of a scene before it runs.
 *
 * Contact loop: velocity Verlet is stable for dt < 2/omega; a single contact lasts pi/omega,
 * and a grain with several of them is stiffer by their number, so a quarter of a contact's
 * duration is the limit set here. The duration is that at the highest expected speed:
 * run.speed, or else the fastest start plus a free fall through the box. */
#include "feasibility.h"

#include "../contact/contact.h"
#include <string.h>
#include "sim.h"

#define PART_OF_CONTACT 0.25

void feasibility_add(struct feasibility *f, const char *name, const char *unit, double used,
                     double limit, bool binding, const char *note)
{
    if (f->n == FEASIBILITY_LINES)
        return;
    snprintf(f->line[f->n].name, sizeof f->line[0].name, "%s", name);
    snprintf(f->line[f->n].unit, sizeof f->line[0].unit, "%s", unit);
    snprintf(f->line[f->n].note, sizeof f->line[0].note, "%s", note);
    f->line[f->n].limit = limit;
    f->line[f->n].used = used;
    f->line[f->n].binding = binding;
    f->n++;
}

/* m/s; see the head */
static double expected_speed(const struct sim *s)
{
    if (s->run.speed > 0.0)
        return s->run.speed;
    const struct grains *const g = &s->grains;
    const double gravity[3] = {s->domain.gravity.x, s->domain.gravity.y, s->domain.gravity.z};
    double start = 0.0, fall = 0.0, largest = 0.0;
    for (int i = 0; i < g->n; i++) {
        start = fmax(start, v3_norm(g->vel[i]));
        largest = fmax(largest, 2.0 * g->radius[i]);
    }
    for (int k = 0; k < s->traffic.n_sources; k++) {
        const struct source *const o = &s->traffic.source[k];
        start = fmax(start, v3_norm(o->velocity) + sqrt(3.0) * o->scatter);
        largest = fmax(largest, g->species[o->species].largest);
    }
    for (int a = 0; a < 3; a++)
        fall += fabs(gravity[a]) * (s->domain.periodic[a] ? 10.0 * largest : s->domain.size[a]);
    return sqrt(start * start + 2.0 * fall);
}

int feasibility_grain(const struct sim *s, int species)
{
    for (int i = 0; i < s->grains.n; i++)
        if (s->grains.kind[i] == species && s->grains.inv_mass[i] > 0.0)
            return i;
    return -1;
}

/* m; the radius of the smallest grain of a species that moves, of those that there are and those
 * that a source may bring; 0 if there is none. */
static double smallest(const struct sim *s, int species)
{
    const struct grains *const g = &s->grains;
    double least = (double)INFINITY;
    for (int i = 0; i < g->n; i++)
        if (g->kind[i] == species && g->inv_mass[i] > 0.0)
            least = fmin(least, g->radius[i]);
    for (int k = 0; k < s->traffic.n_sources; k++)
        if (s->traffic.source[k].species == species)
            least = fmin(least, 0.5 * g->species[species].sizes.least);
    return isfinite(least) ? least : 0.0;
}

/* kg; the mass of that grain: of one that there is, as its shape makes it, or of a sphere. */
static double smallest_mass(const struct sim *s, int species, double radius)
{
    const struct grains *const g = &s->grains;
    for (int i = 0; i < g->n; i++)
        if (g->kind[i] == species && g->inv_mass[i] > 0.0 && g->radius[i] == radius)
            return g->mass[i];
    return 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius *
           g->species[species].density;
}

/* s; of a contact at that speed, of two of them or with a wall */
static double species_duration(const struct sim *s, int species, double radius, double speed)
{
    const int m = s->grains.species[species].material;
    const double v = fmax(speed, 1e-9), mass = smallest_mass(s, species, radius);
    double shortest = contact_duration(m, m, 0.5 * mass, 0.5 * radius, v);
    for (int k = 0; k < s->walls.n; k++)
        shortest =
            fmin(shortest, contact_duration(m, s->walls.wall[k].material, mass, radius, v));
    return shortest;
}

double feasibility_grain_limit(const struct sim *s)
{
    double limit = (double)INFINITY;
    for (int k = 0; k < s->grains.n_species; k++) {
        const double radius = smallest(s, k);
        if (radius == 0.0)
            continue;
        const struct species *const sp = &s->grains.species[k];
        limit = fmin(limit, contact_rayleigh(sp->material, radius, sp->density));
        limit =
            fmin(limit, PART_OF_CONTACT * species_duration(s, k, radius, expected_speed(s)));
    }
    return limit;
}

/* A contact that lasts t at v is deepest at v t/pi if linear, v t/2.94 by Hertz [Johnson85], less with
 * damping. What falls faster than it sinks in the fluid at hand does so more slowly. */
#define DEEPEST 0.34

static void overlap_line(const struct sim *s, int species, struct feasibility *f)
{
    char name[64], note[96];
    const double radius = smallest(s, species);
    const double speed = fmin(expected_speed(s), feasibility_sinking(s, species));
    const struct species *const sp = &s->grains.species[species];
    const double deepest =
        DEEPEST * speed * species_duration(s, species, radius, speed) / radius;
    snprintf(name, sizeof name, "overlap, %.32s", sp->name);
    snprintf(note, sizeof note, "of the radius, should it collide at %.3g m/s: a warning",
             speed);
    feasibility_add(f, name, "1", deepest, s->run.overlap_max, false, note);
}

static void contact_lines(const struct sim *s, struct feasibility *f)
{
    char name[64], note[96];
    for (int k = 0; k < s->grains.n_species; k++) {
        const double radius = smallest(s, k);
        if (radius == 0.0)
            continue;
        const struct species *const sp = &s->grains.species[k];
        const double rayleigh = contact_rayleigh(sp->material, radius, sp->density);
        const double duration = species_duration(s, k, radius, expected_speed(s));
        if (isfinite(rayleigh)) {
            snprintf(name, sizeof name, "Rayleigh's step, %.32s", sp->name);
            feasibility_add(f, name, "s", s->run.dt, rayleigh, true, "0.1 to 0.3 is usual");
        }
        if (isfinite(duration)) {
            snprintf(name, sizeof name, "a quarter of a contact, %.32s", sp->name);
            snprintf(note, sizeof note, "at %.3g m/s", expected_speed(s));
            feasibility_add(f, name, "s", s->run.dt, PART_OF_CONTACT * duration, true, note);
            overlap_line(s, k, f);
        }
    }
}

static void grid_lines(const struct sim *s, struct feasibility *f)
{
    const struct grains *const g = &s->grains;
    double d = 0.0;
    for (int i = 0; i < g->n; i++)
        d = fmax(d, 2.0 * g->radius[i]);
    const double h = fmin(s->grid.h[0], fmin(s->grid.h[1], s->grid.h[2]));
    const double cells = (double)s->grid.n[0] * s->grid.n[1] * s->grid.n[2];
    if (g->n == 0)
        return;
    feasibility_add(f, "cell over grain diameter", "1", h / d, (double)INFINITY, false,
                    "2 and more give smooth porosities");
    feasibility_add(f, "grains per cell", "1", g->n / cells, (double)INFINITY, false, "mean");
}

static double memory(const struct sim *s)
{
    const double cells = (double)s->grid.total;
    return 1000.0 * (s->grains.n + insert_expected(s)) +
           (s->fluid.bare ? 100.0 : 250.0) * cells; /* as measured */
}

void feasibility_fill(const struct sim *s, struct feasibility *f)
{
    f->n = 0;
    contact_lines(s, f);
    if (s->fluid.exists) {
        if (s->grains.n > 0)
            feasibility_relaxation(s, f);
        fluid_feasibility(s, f);
        feasibility_coupling(s, f);
        grid_lines(s, f);
    }
}

/* What the scene asks for, species by species, and what its sources are to bring. */
static void print_grains(FILE *out, const struct sim *s)
{
    for (int k = 0; k < s->grains.n_species; k++) {
        const struct species *const sp = &s->grains.species[k];
        double *const d = xalloc((size_t)sp->n_made + 1, sizeof *d), mass = 0.0;
        for (int i = 0; i < sp->n_made; i++)
            d[i] = sp->made[i];
        for (int i = 0; i < s->grains.n; i++)
            mass += s->grains.kind[i] == k ? s->grains.mass[i] : 0.0;
        if (sp->n_made > 0)
            fprintf(out, "%s: %d grains, %.4g kg, D10 %.4g, D50 %.4g, D90 %.4g m by mass\n",
                    sp->name, sp->n_made, mass, sizes_measured(d, (size_t)sp->n_made, 0.1),
                    sizes_measured(d, (size_t)sp->n_made, 0.5),
                    sizes_measured(d, (size_t)sp->n_made, 0.9));
        xfree(d);
    }
    insert_expect(out, s);
}

void feasibility_print(FILE *out, const struct sim *s, const struct feasibility *f)
{
    double most = 0.0;
    int worst = -1;
    fprintf(out, "%-40s %12s %12s %8s\n", "limit", "used", "limit", "ratio");
    for (int i = 0; i < f->n; i++) {
        const double ratio = f->line[i].used / f->line[i].limit;
        char used[32], limit[32];
        snprintf(used, sizeof used, "%.4g %s", f->line[i].used, f->line[i].unit);
        snprintf(limit, sizeof limit, "%.4g %s", f->line[i].limit, f->line[i].unit);
        if (isinf(f->line[i].limit)) {
            fprintf(out, "%-40s %12s %12s %8s  %s\n", f->line[i].name, used, "-", "-",
                    f->line[i].note);
            continue;
        }
        fprintf(out, "%-40s %12s %12s %8.3g  %s%s\n", f->line[i].name, used, limit, ratio,
                !f->line[i].binding || ratio <= 1.0 ? ""
                : strcmp(f->line[i].unit, "s") == 0 ? "TOO LONG; "
                                                    : "REFUSED; ",
                f->line[i].note);
        if (f->line[i].binding && ratio > most) {
            most = ratio;
            worst = i;
        }
    }
    if (worst >= 0)
        fprintf(out, "nearest limit: %s, at %.3g of it\n", f->line[worst].name, most);
    print_grains(out, s);
    if (s->grains.n > 0) {
        const double *const size = s->domain.size;
        double volume = 0.0;
        for (int k = 0; k < s->grains.n; k++)
            volume += s->grains.volume[k];
        fprintf(out, "the grains fit: they fill %.3g %% of the box\n",
                100.0 * volume / (size[0] * size[1] * size[2]));
    }
    fprintf(out,
            "grains %d, cells %.0f, sub-steps %d per step, steps %.0f, memory about %.3g MiB\n",
            s->grains.n, (double)s->grid.n[0] * s->grid.n[1] * s->grid.n[2], s->run.substeps,
            ceil(s->run.end / (s->run.dt * s->run.substeps) - 1e-9), memory(s) / 1048576.0);
}

void feasibility_enforce(const struct sim *s, struct scene *scene, const struct feasibility *f)
{
    if (s->run.force)
        return;
    for (int i = 0; i < f->n; i++) {
        if (!f->line[i].binding || !(f->line[i].used > f->line[i].limit * (1.0 + 1e-9)))
            continue;
        if (strncmp(f->line[i].name, "lightness", 9) == 0) {
            scene_error(
                scene, "grains", f->line[i].name + strlen("lightness, "), "density",
                "so light grains in two-way flow are unstable: the ratio of densities must "
                "be %.3g at least (run.force = on runs it all the same)",
                f->line[i].used);
            continue;
        }
        const bool moving = s->grains.n > s->grains.n_frozen || !s->fluid.exists;
        const bool grains = moving && f->line[i].used == s->run.dt;
        scene_error(
            scene, grains ? "run" : "fluid", NULL, "dt",
            "%s allows %.4g %s at most, %.4g is used (run.force = on runs it all the same)",
            f->line[i].name, f->line[i].limit, f->line[i].unit, f->line[i].used);
    }
}
