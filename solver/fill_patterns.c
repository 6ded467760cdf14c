/* fill_patterns.c - placing grains where they are told to be: on a lattice, in unit cells, at a
 * point, from a file. */
#include "fill_patterns.h"

#include <string.h>
#include "bed_file.h"
#include "sim.h"

static vec3 lattice_point(const double lo[3], const int n[3], double spacing, int i)
{
    return v3(lo[0] + spacing * (i % n[0]), lo[1] + spacing * (i / n[0] % n[1]),
              lo[2] + spacing * (i / (n[0] * n[1])));
}

void fill_lattice(struct fill_grid *b, const struct fill_task *t)
{
    const double d = t->widest;
    const double spacing = scene_word(t->scene, "grains", t->name, "spacing", "auto")
                               ? 1.05 * d
                               : scene_real(t->scene, "grains", t->name, "spacing");
    double lo[3], hi[3];
    int n[3];
    region_bounds(&t->region, 0.5 * d, lo, hi);
    for (int a = 0; a < 3; a++) {
        n[a] = (int)floor((hi[a] - lo[a]) / spacing * (1.0 + 1e-12)) + 1;
        /* the last must not meet the first's image */
        if (t->region.open[a] && n[a] > 1 && lo[a] + n[a] * spacing > hi[a] + d * 1e-9)
            n[a] = (int)floor((hi[a] - lo[a]) / spacing * (1.0 + 1e-12));
        n[a] = n[a] < 1 ? 1 : n[a];
    }
    const double points = (double)n[0] * n[1] * n[2];
    int put = 0;
    for (int i = 0; put < t->n && i < points; i++) {
        const vec3 x = lattice_point(lo, n, spacing, i);
        const double r = 0.5 * t->diameter[put];
        if (!t->walls || walls_gap(t->walls, x, r, 0.0, NULL) >= -1e-9 * r)
            fill_grid_add(b, (struct placed){x, t->diameter[put++], t->species});
    }
    if (put < t->n)
        scene_error(t->scene, "grains", t->name, "count",
                    "a lattice of %g m has room for %d grains%s, %d are asked for", spacing,
                    put, t->walls ? " clear of the walls" : "", t->n);
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

void fill_unit_cell(struct fill_grid *b, const struct fill_task *t)
{
    struct scene *const scene = t->scene;
    const struct unit_cell *const u =
        &unit_cells[scene_choice(scene, "grains", t->name, "cell")];
    const double d = t->widest;
    const bool given = !scene_word(scene, "grains", t->name, "spacing", "auto");
    const double edge =
        given ? scene_real(scene, "grains", t->name, "spacing") : u->touching * d;
    const int errors = scene_errors(scene);
    int n[3];
    for (int a = 0; a < 3; a++) {
        const double cells = (t->region.to[a] - t->region.from[a]) / edge;
        n[a] = (int)floor(cells + 1e-6);
        if (n[a] < 1 || (b->domain->periodic[a] && fabs(cells - n[a]) > 1e-6))
            scene_error(scene, "grains", t->name, "spacing",
                        "the region holds %.6g unit cells of %g m in %c; it must hold %s",
                        cells, edge, 'x' + a,
                        n[a] < 1 ? "one at least" : "a whole number of them");
    }
    if (t->sizes->kind != SIZES_ONE)
        scene_error(scene, "grains", t->name, "sizes",
                    "fill = unit_cell takes grains of one size");
    if (scene_errors(scene) > errors)
        return;
    for (int i = 0; i < n[0] * n[1] * n[2]; i++)
        for (int m = 0; m < u->n; m++) {
            const double *const from = t->region.from;
            const vec3 x = v3(from[0] + edge * (i % n[0] + u->at[m][0]),
                              from[1] + edge * (i / n[0] % n[1] + u->at[m][1]),
                              from[2] + edge * (i / (n[0] * n[1]) + u->at[m][2]));
            fill_grid_add(b, (struct placed){x, d, t->species});
        }
}

void fill_point(struct fill_grid *b, const struct fill_task *t)
{
    const double *const from = t->region.from, *const to = t->region.to;
    vec3 x = scene_vector(t->scene, "grains", t->name, "position");
    if (scene_word(t->scene, "grains", t->name, "position", "centre"))
        x = v3(0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), 0.5 * (from[2] + to[2]));
    const double at[3] = {x.x, x.y, x.z};
    for (int a = 0; a < 3; a++)
        if (at[a] < from[a] || at[a] > to[a])
            scene_error(t->scene, "grains", t->name, "position", "must lie inside the region");
    if (t->n != 1) {
        scene_error(t->scene, "grains", t->name, "count", "fill = point places one grain");
        return;
    }
    fill_grid_add(b, (struct placed){x, t->diameter[0], t->species});
}

static void add_motion(struct fill_motion *m, int n, vec3 vel, vec3 spin, struct quat turn)
{
    if (n >= m->capacity) {
        const int more = 2 * n + 1024;
        m->vel = xrealloc(m->vel, (size_t)m->capacity, (size_t)more, sizeof *m->vel);
        m->spin = xrealloc(m->spin, (size_t)m->capacity, (size_t)more, sizeof *m->spin);
        m->turn = xrealloc(m->turn, (size_t)m->capacity, (size_t)more, sizeof *m->turn);
        m->capacity = more;
    }
    for (int i = m->n; i < n; i++) /* placed otherwise */
        m->vel[i].x = m->turn[i].w = (double)NAN;
    m->vel[n] = vel;
    m->spin[n] = spin;
    m->turn[n] = turn;
    m->n = n + 1;
}

/* The index in the file of the species that this one takes; -1: all grains; -2: an error. */
static int file_species(const struct fill_task *t, const struct bed_file *f)
{
    const char *const asked = scene_text(t->scene, "grains", t->name, "file_species");
    char there[256] = "";
    for (int k = 0; k < f->n_species; k++) {
        if (strcmp(f->species[k], asked[0] ? asked : t->name) == 0)
            return k;
        snprintf(there + strlen(there), sizeof there - strlen(there), " %.32s", f->species[k]);
    }
    if (!asked[0] && f->n_species < 2)
        return -1;
    scene_error(t->scene, "grains", t->name, asked[0] ? "file_species" : "file",
                f->n_species > 0 ? "the file has no species %s; it has%s"
                                 : "the file does not tell species apart",
                asked[0] ? asked : t->name, there);
    return -2;
}

void fill_from_file(struct fill_grid *b, const struct fill_task *t, struct fill_motion *m)
{
    struct bed_file f;
    char *const why = bed_file_read(&f, scene_text(t->scene, "grains", t->name, "file"),
                                    scene_path(t->scene));
    if (why) {
        scene_error(t->scene, "grains", t->name, "file", "%s", why);
        xfree(why);
        return;
    }
    const int which = file_species(t, &f);
    for (int i = 0; i < f.n && which > -2; i++) {
        if (which >= 0 && f.kind[i] != which)
            continue;
        const vec3 x = domain_wrap(b->domain, f.pos[i]);
        const double at[3] = {x.x, x.y, x.z};
        bool in = true;
        for (int a = 0; a < 3; a++)
            in = in && at[a] >= 0.0 && at[a] <= b->domain->size[a];
        if (!in) {
            scene_error(t->scene, "grains", t->name, "file",
                        "grain %d at %g %g %g m is outside the box", i + 1, x.x, x.y, x.z);
            break;
        }
        if (f.vel || f.turn) {
            const vec3 none = {(double)NAN, 0.0, 0.0};
            struct quat turn = f.turn ? f.turn[i] : (struct quat){.w = (double)NAN};
            if (f.turn && f.described)
                turn = quat_mul(turn, t->axes);
            add_motion(m, b->n, f.vel ? f.vel[i] : none, f.vel ? f.spin[i] : none, turn);
        }
        const double d = f.described ? t->bounding * f.diameter[i] : f.diameter[i];
        fill_grid_add(b, (struct placed){x, d, t->species});
    }
    bed_file_free(&f);
}
