/* wells.c - wells, see wells.h. The rate of a well is spread evenly over its length: many points
 * along it each give their part to the cell that they lie in. */
#include "wells.h"

static void read_well(struct well *w, struct scene *s, const char *name, const struct domain *d)
{
    const vec3 from = scene_vector(s, "well", name, "from");
    const bool point = scene_word(s, "well", name, "to", "from");
    const vec3 to = point ? from : scene_vector(s, "well", name, "to");
    const double ends[2][3] = {{from.x, from.y, from.z}, {to.x, to.y, to.z}};
    for (int a = 0; a < 3; a++) {
        w->from[a] = ends[0][a];
        w->to[a] = ends[1][a];
        for (int end = 0; end < 2; end++)
            if (ends[end][a] > d->size[a])
                scene_error(s, "well", name, end ? "to" : "from", "lies outside the box in %c",
                            'x' + a);
    }
    w->rate.value = scene_real(s, "well", name, "rate");
    w->rate.ramp = scene_real(s, "well", name, "ramp");
    course_read_table(&w->rate, s, "well", name, "table");
    if (w->rate.n > 0 && scene_given(s, "well", name, "rate"))
        scene_error(s, "well", name, "rate",
                    "contradicts the table of the well: give either one");
}

void wells_read(struct wells *w, struct scene *s, const struct domain *d)
{
    const char *const *names;
    w->n = scene_names(s, "well", &names);
    w->well = xalloc((size_t)w->n, sizeof *w->well);
    for (int i = 0; i < w->n; i++)
        read_well(&w->well[i], s, names[i], d);
}

/* The cell that holds the part `along` (0..1) of the well; a point on a face belongs to the cell
 * above it, at the far side of the box to the last one. */
static int cell_at(const struct well *w, const struct grid *g, double along)
{
    int at[3];
    for (int a = 0; a < 3; a++) {
        const double x = w->from[a] + along * (w->to[a] - w->from[a]);
        const int i = (int)floor(x / g->h[a]);
        at[a] = 1 + (i < 0 ? 0 : i >= g->n[a] ? g->n[a] - 1 : i);
    }
    return cell(g, at[0], at[1], at[2]);
}

void wells_place(struct wells *wells, const struct grid *g)
{
    enum { PER_CELL = 64 };
    for (int i = 0; i < wells->n; i++) {
        struct well *const w = &wells->well[i];
        double cells = 0.0; /* along it, at most */
        for (int a = 0; a < 3; a++)
            cells += fabs(w->to[a] - w->from[a]) / g->h[a];
        const int most = (int)cells + 4, points = cells > 0.0 ? PER_CELL * most : 1;
        w->cell = xalloc((size_t)most, sizeof *w->cell);
        w->share = xalloc((size_t)most, sizeof *w->share);
        for (int q = 0; q < points; q++) {
            const int c = cell_at(w, g, (q + 0.5) / points);
            if (w->n == 0 || w->cell[w->n - 1] != c)
                w->cell[w->n++] = c;
            w->share[w->n - 1] += 1.0 / points;
        }
    }
}

void wells_free(struct wells *wells)
{
    for (int i = 0; i < wells->n; i++) {
        course_free(&wells->well[i].rate);
        xfree(wells->well[i].cell);
        xfree(wells->well[i].share);
    }
    xfree(wells->well);
}

void wells_add(const struct wells *wells, const struct grid *g, double t, double *out)
{
    for (int i = 0; i < wells->n; i++) {
        const struct well *const w = &wells->well[i];
        const double rate = course_at(&w->rate, t) / g->volume;
        for (int q = 0; q < w->n; q++)
            out[w->cell[q]] += rate * w->share[q];
    }
}
