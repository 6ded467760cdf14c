/* walls_check.c - what is wrong with the walls of a scene: grains that start in them, walls out of the
 * box, walls too wide for a period. */
#include "walls.h"

#include "../shapes/shape.h"
#include "sim.h"

/* m; room between a grain as it lies and the nearest wall, as walls_gap: as part of the balls by
 * which it touches walls, times its radius. A
 * convex shape without them is only seen behind a wall. */
static double grain_gap(const struct sim *s, int i, int *which)
{
    const struct grains *const g = &s->grains;
    const vec3 x = g->pos[i];
    if (!g->orientation)
        return walls_gap(s, x, g->radius[i], 0.0, which);
    if (!shape.balls)
        return walls_gap(s, x, 0.0, 0.0, which);
    const double size = g->radius[i] / g->species[g->kind[i]].form.bounding;
    const struct mat3 m = quat_matrix(g->orientation[i]);
    int n = 0;
    const struct shape_ball *const ball = shape.balls(g->kind[i], &n);
    double least = 0.0;
    for (int b = 0; b < n; b++) {
        const vec3 c = v3_add(x, mat3_turn(&m, v3_scale(size, ball[b].centre)));
        const double r = size * ball[b].radius;
        int k = 0;
        /* in parts of what run.overlap_max is of in a run (contact_points_walls.c) */
        const double curve = size * ball[b].curve;
        const double scale = curve > 0.0 ? fmin(curve, r / s->run.overlap_max) : r;
        const double gap = walls_gap(s, c, r, 0.0, &k) / scale * g->radius[i];
        if (gap < least) {
            least = gap;
            *which = k;
        }
    }
    return least;
}

static void check_grains(const struct sim *s, struct scene *scene)
{
    const struct grains *const g = &s->grains;
    for (int i = 0; i < g->n; i++) {
        const vec3 x = g->pos[i];
        int k = 0;
        if (g->inv_mass[i] == 0.0)
            continue;
        const double gap = grain_gap(s, i, &k);
        if (gap >= -s->run.overlap_max * g->radius[i])
            continue;
        const char *const name = s->walls.wall[k].name;
        if (isinf(gap))
            scene_error(scene, "wall", name, NULL,
                        "a grain starts behind it, at %.6g %.6g %.6g m: is it turned the wrong "
                        "way, or do from and to of the grains reach too far?",
                        x.x, x.y, x.z);
        else
            scene_error(scene, "wall", name, NULL,
                        "a grain starts inside it, at %.6g %.6g %.6g m, by %.3g of its radius "
                        "(run.overlap_max = %g)",
                        x.x, x.y, x.z, -gap / g->radius[i], s->run.overlap_max);
        return;
    }
}

static double along(vec3 v, int a)
{
    return a == 0 ? v.x : a == 1 ? v.y : v.z;
}

/* A wall that stays beyond a side is of no use: its units or its shift are wrong. */
static void check_outside(const struct sim *s, struct scene *scene, const struct wall *w)
{
    for (int a = 0; a < 3; a++) {
        const double low = along(w->low, a), high = along(w->high, a), size = s->domain.size[a];
        if (s->domain.periodic[a] || w->motion.moves || !(low > size || high < 0.0))
            continue;
        scene_error(scene, "wall", w->name, NULL,
                    "lies outside of the box: its %c goes from %.6g to %.6g m, that of the box "
                    "from 0 to %.6g m",
                    'x' + a, low, high, size);
        return;
    }
}

/* The box around an element. */
static void element_bounds(const struct wall *w, int element, vec3 *low, vec3 *high)
{
    vec3 corner[4];
    const int n = w->kind->corners ? w->kind->corners(w->shape, element, corner) : 0;
    *low = n > 0 ? corner[0] : w->low;
    *high = n > 0 ? corner[0] : w->high;
    for (int c = 1; c < n; c++) {
        *low =
            v3(fmin(low->x, corner[c].x), fmin(low->y, corner[c].y), fmin(low->z, corner[c].z));
        *high = v3(fmax(high->x, corner[c].x), fmax(high->y, corner[c].y),
                   fmax(high->z, corner[c].z));
    }
}

/* The widest that a box of these edges gets across an axis about which it turns. */
static double across(vec3 edge, vec3 axis)
{
    double most = 0.0;
    for (int k = 0; k < 4; k++) {
        const vec3 d = v3(edge.x, k & 1 ? -edge.y : edge.y, k & 2 ? -edge.z : edge.z);
        most = fmax(most, v3_norm(v3_cross(d, axis)));
    }
    return most;
}

/* Whether the element looks the same from its middle and from places shifted along an axis. */
static bool runs_along(const struct wall *w, int element, vec3 middle, int axis, double width)
{
    struct wall_view here, there;
    w->kind->view(w->shape, element, &middle, &here);
    for (int side = -1; side <= 1; side += 2) {
        const double d = 0.45 * side * width;
        const vec3 x =
            v3_add(middle, v3(axis == 0 ? d : 0.0, axis == 1 ? d : 0.0, axis == 2 ? d : 0.0));
        w->kind->view(w->shape, element, &x, &there);
        if (v3_norm(v3_sub(here.away, there.away)) > 1e-9 * width)
            return false;
    }
    return true;
}

/* A grain meets the image of an element whose middle is nearest (into_frame): what does not run along a
 * period must leave room for a grain within it. */
static void check_period(const struct sim *s, struct scene *scene, const struct wall *w,
                         int element, int axis, double widest)
{
    vec3 low, high;
    element_bounds(w, element, &low, &high);
    const vec3 extent = v3_sub(high, low), middle = v3_scale(0.5, v3_add(low, high));
    const double size = s->domain.size[axis];
    const bool tumbles = w->motion.turns && fabs(along(w->motion.axis, axis)) < 1.0 - 1e-9 &&
                         w->motion.sweep > 0.0;
    const double width = tumbles ? across(extent, w->motion.axis) : along(extent, axis);
    if (!(width > size - widest) || !isfinite(v3_norm(extent)) ||
        (!tumbles && runs_along(w, element, middle, axis, width)))
        return;
    scene_error(scene, "wall", w->name, NULL,
                "is %.4g m wide in periodic %c, across which it %s; at most the period less a "
                "grain, %.4g m: a wider box, or several walls",
                width, 'x' + axis, tumbles ? "turns" : "does not run straight", size - widest);
}

static double widest_grain(const struct sim *s)
{
    double most = 0.0;
    for (int k = 0; k < s->grains.n_species; k++)
        most = fmax(most, s->grains.species[k].largest * s->grains.species[k].form.bounding);
    return most;
}

static void check_wall(const struct sim *s, struct scene *scene, const struct wall *w)
{
    const int errors = scene_errors(scene);
    check_outside(s, scene, w);
    for (int a = 0; a < 3; a++)
        for (int e = 0;
             s->domain.periodic[a] && e < w->elements && scene_errors(scene) == errors; e++)
            check_period(s, scene, w, e, a, widest_grain(s));
}

void walls_check(struct sim *s, struct scene *scene)
{
    for (int k = 0; k < s->walls.n; k++)
        if (s->walls.wall[k].kind != &wall_side)
            check_wall(s, scene, &s->walls.wall[k]);
    check_grains(s, scene);
}
