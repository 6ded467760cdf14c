/* fill.c - placing grains: lattice, random without overlap, unit cells, a point, a file.
 *
 * Random filling is random sequential addition: centres are drawn uniformly and kept if they
 * overlap nothing. It jams at a solid fraction of 0.384 [Zhang13]; up to RANDOM_MOST it is
 * quick. `settle` is a random filling of the lower part of the region at SETTLE_LOOSE, which
 * then falls (settle.c). */
#include "fill.h"

#include <gsl/gsl_rng.h>
#include <string.h>
#include "bed_file.h"
#include "sim.h"

#define PI           3.14159265358979323846
#define RANDOM_MOST  0.34
#define SETTLE_LOOSE 0.28

enum { LATTICE, RANDOM, SETTLE, UNIT_CELL, POINT, FROM_FILE };

/* The grains placed so far, with a search grid over the box. */
struct bed {
    const struct domain *domain;
    int n, capacity;
    struct placed *grain;
    int cells[3];
    int *first, *next; /* chains of grains per search cell, -1 ends */
    double edge[3];
    double largest; /* m, diameter */
};

static void bed_open(struct bed *b, const struct domain *d, double largest)
{
    *b = (struct bed){.domain = d, .largest = largest};
    size_t total = 1;
    for (int a = 0; a < 3; a++) {
        b->cells[a] = (int)fmin(fmax(1.0, floor(d->size[a] / largest)), 400.0);
        b->edge[a] = d->size[a] / b->cells[a];
        total *= (size_t)b->cells[a];
    }
    b->first = xalloc(total, sizeof *b->first);
    for (size_t c = 0; c < total; c++)
        b->first[c] = -1;
}

static int bed_index(const struct bed *b, double x, int axis)
{
    const int i = (int)floor(x / b->edge[axis]);
    return i < 0 ? 0 : i >= b->cells[axis] ? b->cells[axis] - 1 : i;
}

static int bed_cell(const struct bed *b, const int i[3])
{
    return i[0] + b->cells[0] * (i[1] + b->cells[1] * i[2]);
}

static void bed_add(struct bed *b, struct placed p)
{
    if (b->n == b->capacity) {
        const int capacity = b->capacity ? 2 * b->capacity : 1024;
        b->grain = xrealloc(b->grain, (size_t)b->capacity, (size_t)capacity, sizeof *b->grain);
        b->next = xrealloc(b->next, (size_t)b->capacity, (size_t)capacity, sizeof *b->next);
        b->capacity = capacity;
    }
    const int at[3] = {bed_index(b, p.pos.x, 0), bed_index(b, p.pos.y, 1),
                       bed_index(b, p.pos.z, 2)};
    const int c = bed_cell(b, at);
    b->next[b->n] = b->first[c];
    b->first[c] = b->n;
    b->grain[b->n++] = p;
}

/* Neighbouring search cells of index i along an axis, each once; returns how many. */
static int bed_around(const struct bed *b, int i, int axis, int out[3])
{
    int n = 0;
    for (int o = -1; o <= 1; o++) {
        int k = i + o;
        if (b->domain->periodic[axis])
            k = (k + b->cells[axis]) % b->cells[axis];
        bool seen = k < 0 || k >= b->cells[axis];
        for (int m = 0; m < n; m++)
            seen = seen || out[m] == k;
        if (!seen)
            out[n++] = k;
    }
    return n;
}

/* Largest overlap of a sphere with those placed, as part of the smaller diameter. */
static double bed_overlap(const struct bed *b, vec3 x, double diameter)
{
    int near[3][3], n[3];
    const double at[3] = {x.x, x.y, x.z};
    for (int a = 0; a < 3; a++)
        n[a] = bed_around(b, bed_index(b, at[a], a), a, near[a]);
    double worst = 0.0;
    for (int i = 0; i < n[0] * n[1] * n[2]; i++) {
        const int k[3] = {near[0][i % n[0]], near[1][i / n[0] % n[1]],
                          near[2][i / (n[0] * n[1])]};
        for (int m = b->first[bed_cell(b, k)]; m >= 0; m = b->next[m]) {
            const double apart = 0.5 * (diameter + b->grain[m].diameter);
            const double r =
                v3_norm(domain_minimum_image(b->domain, v3_sub(x, b->grain[m].pos)));
            worst = fmax(worst, (apart - r) / fmin(diameter, b->grain[m].diameter));
        }
    }
    return worst;
}

/* The part of the box in which a species is placed, for the centres. */
struct region {
    double from[3], to[3]; /* m, as asked */
    double lo[3], hi[3];   /* m, for centres: a radius inside along walls of the box */
};

static struct region region_read(struct sim *s, struct scene *scene, const char *name, double d)
{
    struct region r;
    const vec3 from = scene_vector(scene, "grains", name, "from");
    const vec3 to = scene_vector(scene, "grains", name, "to");
    const bool lower = !scene_word(scene, "grains", name, "from", "box");
    const bool upper = !scene_word(scene, "grains", name, "to", "box");
    const double f[3] = {from.x, from.y, from.z}, t[3] = {to.x, to.y, to.z};
    for (int a = 0; a < 3; a++) {
        const double size = s->domain.size[a], radius = 0.5 * d;
        r.from[a] = lower ? f[a] : 0.0;
        r.to[a] = upper ? t[a] : size;
        if (r.from[a] < 0.0 || r.to[a] > size * (1.0 + 1e-12) || !(r.from[a] < r.to[a]))
            scene_error(scene, "grains", name,
                        upper   ? "to"
                        : lower ? "from"
                                : NULL,
                        "the region must lie inside the box, from below to");
        const bool open = s->domain.periodic[a];
        r.lo[a] = open && !lower ? r.from[a] : r.from[a] + radius;
        r.hi[a] = open && !upper ? r.to[a] : r.to[a] - radius;
        if (r.lo[a] > r.hi[a])
            scene_error(scene, "grains", name, "diameter", "is wider than the region (%g m)",
                        r.to[a] - r.from[a]);
    }
    return r;
}

static double region_volume(const struct region *r)
{
    return (r->to[0] - r->from[0]) * (r->to[1] - r->from[1]) * (r->to[2] - r->from[2]);
}

/* True, or an error on the list, if `count` spheres are at most `most` of the region. */
static bool fits(struct scene *scene, const char *name, const struct region *r, int count,
                 double d, double most, const char *why)
{
    const double solid = count * PI / 6.0 * d * d * d / region_volume(r);
    if (solid <= most)
        return true;
    scene_error(scene, "grains", name, "count",
                "the grains fill %.3g %% of their region; at most %.3g %% %s", 100.0 * solid,
                100.0 * most, why);
    return false;
}

static void fill_lattice(struct bed *b, struct scene *scene, const char *name, int species,
                         const struct region *r, int count, double d)
{
    const double spacing = scene_word(scene, "grains", name, "spacing", "auto")
                               ? 1.05 * d
                               : scene_real(scene, "grains", name, "spacing");
    int n[3];
    for (int a = 0; a < 3; a++) {
        n[a] = (int)floor((r->hi[a] - r->lo[a]) / spacing * (1.0 + 1e-12)) + 1;
        if (b->domain->periodic[a] && n[a] > 1 && /* the last must not meet the first's image */
            r->lo[a] + n[a] * spacing > r->hi[a] + d * 1e-9 &&
            r->hi[a] - r->lo[a] > 0.999 * b->domain->size[a])
            n[a] = (int)floor((r->hi[a] - r->lo[a]) / spacing * (1.0 + 1e-12));
        n[a] = n[a] < 1 ? 1 : n[a];
    }
    if ((double)n[0] * n[1] * n[2] < count) {
        scene_error(scene, "grains", name, "count",
                    "a lattice of %g m has room for %.0f grains", spacing,
                    (double)n[0] * n[1] * n[2]);
        return;
    }
    for (int i = 0; i < count; i++) {
        const vec3 x =
            v3(r->lo[0] + spacing * (i % n[0]), r->lo[1] + spacing * (i / n[0] % n[1]),
               r->lo[2] + spacing * (i / (n[0] * n[1])));
        bed_add(b, (struct placed){x, d, species});
    }
}

static void fill_random(struct bed *b, struct scene *scene, const char *name, int species,
                        const struct region *r, int count, double d, gsl_rng *rng)
{
    const long tries = 200L * count + 100000L;
    long tried = 0;
    for (int i = 0; i < count; i++) {
        vec3 x;
        do {
            if (tried++ > tries * 50) {
                scene_error(scene, "grains", name, "count",
                            "only %d grains found room without overlap", i);
                return;
            }
            x = v3(r->lo[0] + (r->hi[0] - r->lo[0]) * gsl_rng_uniform(rng),
                   r->lo[1] + (r->hi[1] - r->lo[1]) * gsl_rng_uniform(rng),
                   r->lo[2] + (r->hi[2] - r->lo[2]) * gsl_rng_uniform(rng));
        } while (bed_overlap(b, x, d) > 0.0);
        bed_add(b, (struct placed){x, d, species});
    }
}

/* Positions in the unit cell, in parts of its edge; the edge at which neighbours touch. */
struct unit_cell {
    int n;
    double at[4][3], touching;
};

static const struct unit_cell unit_cells[] = {
    {1, {{0.5, 0.5, 0.5}}, 1.0},
    {2, {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}}, 1.1547005383792515},
    {4,
     {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}},
     1.4142135623730951},
};

static void fill_unit_cell(struct bed *b, struct scene *scene, const char *name, int species,
                           const struct region *r, double d)
{
    const struct unit_cell *const u = &unit_cells[scene_choice(scene, "grains", name, "cell")];
    const bool given = !scene_word(scene, "grains", name, "spacing", "auto");
    const double edge = given ? scene_real(scene, "grains", name, "spacing") : u->touching * d;
    int n[3];
    for (int a = 0; a < 3; a++) {
        const double cells = (r->to[a] - r->from[a]) / edge;
        n[a] = (int)floor(cells + 1e-6);
        if (n[a] < 1 || (b->domain->periodic[a] && fabs(cells - n[a]) > 1e-6))
            scene_error(scene, "grains", name, "spacing",
                        "the region holds %.6g unit cells of %g m in %c; it must hold %s",
                        cells, edge, 'x' + a,
                        n[a] < 1 ? "one at least" : "a whole number of them");
    }
    if (scene_errors(scene) > 0)
        return;
    for (int i = 0; i < n[0] * n[1] * n[2]; i++)
        for (int m = 0; m < u->n; m++) {
            const vec3 x = v3(r->from[0] + edge * (i % n[0] + u->at[m][0]),
                              r->from[1] + edge * (i / n[0] % n[1] + u->at[m][1]),
                              r->from[2] + edge * (i / (n[0] * n[1]) + u->at[m][2]));
            bed_add(b, (struct placed){x, d, species});
        }
}

static void fill_point(struct bed *b, struct scene *scene, const char *name, int species,
                       const struct region *r, int count, double d)
{
    vec3 x = scene_vector(scene, "grains", name, "position");
    if (scene_word(scene, "grains", name, "position", "centre"))
        x = v3(0.5 * (r->from[0] + r->to[0]), 0.5 * (r->from[1] + r->to[1]),
               0.5 * (r->from[2] + r->to[2]));
    const double at[3] = {x.x, x.y, x.z};
    for (int a = 0; a < 3; a++)
        if (at[a] < r->from[a] || at[a] > r->to[a])
            scene_error(scene, "grains", name, "position", "must lie inside the region");
    if (count != 1)
        scene_error(scene, "grains", name, "count", "fill = point places one grain");
    bed_add(b, (struct placed){x, d, species});
}

static void fill_from_file(struct bed *b, struct scene *scene, const char *name, int species)
{
    const char *const file = scene_text(scene, "grains", name, "file");
    struct bed_file bed;
    char *const why = bed_file_read(&bed, file, scene_path(scene));
    if (why) {
        scene_error(scene, "grains", name, "file", "%s", why);
        xfree(why);
        return;
    }
    for (int i = 0; i < bed.n; i++) {
        const vec3 x = domain_wrap(b->domain, bed.pos[i]);
        const double at[3] = {x.x, x.y, x.z};
        for (int a = 0; a < 3; a++)
            if (at[a] < 0.0 || at[a] > b->domain->size[a]) {
                scene_error(scene, "grains", name, "file",
                            "grain %d at %g %g %g m is outside "
                            "the box",
                            i + 1, x.x, x.y, x.z);
                i = bed.n - 1;
                break;
            }
        bed_add(b, (struct placed){x, bed.diameter[i], species});
    }
    bed_file_free(&bed);
}

static void fill_species(struct sim *s, struct scene *scene, const char *name, int species,
                         struct bed *b, gsl_rng *rng)
{
    const double d = s->grains.species[species].diameter;
    const int count = s->grains.species[species].count;
    const int how = scene_choice(scene, "grains", name, "fill");
    struct region r = region_read(s, scene, name, d);
    if (scene_errors(scene) > 0)
        return;
    switch (how) {
    case LATTICE:
        if (fits(scene, name, &r, count, d, 0.5236, "can lie on a lattice"))
            fill_lattice(b, scene, name, species, &r, count, d);
        break;
    case SETTLE:
    case RANDOM:
        if (!fits(scene, name, &r, count, d, RANDOM_MOST, "find room at random"))
            break;
        if (how == SETTLE) { /* the lower part only: less far to fall */
            const double solid = count * PI / 6.0 * d * d * d / region_volume(&r);
            const double part = fmin(1.0, solid / SETTLE_LOOSE);
            r.hi[2] =
                fmin(r.hi[2], fmax(r.from[2] + part * (r.to[2] - r.from[2]), r.lo[2] + d));
        }
        fill_random(b, scene, name, species, &r, count, d, rng);
        break;
    case UNIT_CELL:
        fill_unit_cell(b, scene, name, species, &r, d);
        break;
    case POINT:
        fill_point(b, scene, name, species, &r, count, d);
        break;
    default:
        fill_from_file(b, scene, name, species);
    }
}

/* A grain that moves must not start inside a wall of the box. */
static void check_walls(const struct sim *s, struct scene *scene, const struct bed *b,
                        const char *const *names)
{
    for (int i = 0; i < b->n; i++) {
        const struct placed *const p = &b->grain[i];
        const double x[3] = {p->pos.x, p->pos.y, p->pos.z};
        for (int a = 0; a < 3 && !s->grains.species[p->species].frozen; a++) {
            const double room = fmin(x[a], s->domain.size[a] - x[a]),
                         radius = 0.5 * p->diameter;
            if (s->domain.periodic[a] || room >= (1.0 - s->run.overlap_max) * radius)
                continue;
            scene_error(
                scene, "grains", names[p->species], "fill",
                "places a grain at %.6g %.6g %.6g m, of radius %g m, inside a wall in %c", x[0],
                x[1], x[2], radius, 'x' + a);
            return;
        }
    }
}

int fill(struct sim *s, struct scene *scene, struct placed **out)
{
    double largest = 0.0;
    for (int i = 0; i < s->grains.n_species; i++)
        largest = fmax(largest, s->grains.species[i].diameter);
    if (s->grains.n_species == 0)
        return 0;
    struct bed b;
    bed_open(&b, &s->domain, largest);
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, s->run.seed);
    const char *const *names;
    scene_names(scene, "grains", &names);
    for (int i = 0; i < s->grains.n_species; i++)
        fill_species(s, scene, names[i], i, &b, rng);
    gsl_rng_free(rng);
    check_walls(s, scene, &b, names);
    xfree(b.first);
    xfree(b.next);
    *out = b.grain;
    return b.n;
}

bool fill_settles(struct sim *s, struct scene *scene)
{
    const char *const *names;
    scene_names(scene, "grains", &names);
    for (int i = 0; i < s->grains.n_species; i++)
        if (scene_choice(scene, "grains", names[i], "fill") == SETTLE)
            return true;
    return false;
}
