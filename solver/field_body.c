/* field_body.c - mass, nodes and balls of a grain given by its distance field, see field_body.h.
 *
 * Volume, centre and inertia are sums over the parts of the body (volume_parts.c) at the spacing of
 * the field. Balls for walls: the largest that touch the surface at a node from within are taken in
 * order of size, each unless its node is already covered to within COVER. */
#include "field_body.h"

#include <stdlib.h>
#include "../shapes/shape.h"
#include "base.h"
#include "volume_parts.h"

#define COVER 0.01 /* of the size */
enum { LEAF = 16 };

static double depth_in_field(const void *field, vec3 x)
{
    return -distance_at(field, x);
}

static vec3 to_field(const struct field_body *b, vec3 x)
{
    return v3_add(b->centre, mat3_turn(&b->to_field, x));
}

double field_body_depth(const void *body, vec3 x)
{
    const struct field_body *const b = body;
    return -distance_at(b->field, to_field(b, x));
}

/* The grid less its outermost layer. */
static void box_of(const struct distance_field *f, vec3 *lo, vec3 *hi)
{
    *lo = f->origin;
    *hi = v3_axpy(f->origin, f->spacing, v3(f->n[0] - 1, f->n[1] - 1, f->n[2] - 1));
}

/* Volume, centre and principal inertia; the field in units of the size. */
static void weigh(struct field_body *b)
{
    struct distance_field *const f = b->field;
    double tensor[6] = {0}, volume = 0.0;
    vec3 lo, hi, moment = v3(0.0, 0.0, 0.0);
    int n;
    box_of(f, &lo, &hi);
    struct shape_part *const part =
        volume_shape_parts(depth_in_field, f, lo, hi, f->spacing, 0.0, NULL, &n);
    for (int k = 0; k < n; k++) {
        volume += part[k].volume;
        moment = v3_axpy(moment, part[k].volume, part[k].at);
    }
    b->volume = volume;
    if (!(volume > 0.0)) {
        xfree(part);
        return;
    }
    b->centre = v3_scale(1.0 / volume, moment);
    for (int k = 0; k < n; k++) {
        const vec3 x = v3_sub(part[k].at, b->centre);
        const double v = part[k].volume / volume, own = cbrt(part[k].volume);
        const double square = v3_dot(x, x) + own * own / 6.0;
        tensor[0] += v * (square - x.x * x.x);
        tensor[1] += v * (square - x.y * x.y);
        tensor[2] += v * (square - x.z * x.z);
        tensor[3] -= v * x.x * x.y;
        tensor[4] -= v * x.y * x.z;
        tensor[5] -= v * x.z * x.x;
    }
    xfree(part);
    const double size = cbrt(volume / (4.0 / 3.0 * 3.14159265358979323846)), inv = 1.0 / size;
    for (int k = 0; k < 6; k++)
        tensor[k] *= inv * inv;
    b->inertia = rotation_principal(tensor, &b->axes);
    b->to_field = quat_matrix(b->axes);
    b->centre = v3_scale(inv, b->centre);
    f->origin = v3_scale(inv, f->origin);
    f->spacing *= inv;
    f->inv_spacing *= size;
    for (size_t k = 0; k < (size_t)f->n[0] * (size_t)f->n[1] * (size_t)f->n[2]; k++)
        f->value[k] = (float)((double)f->value[k] * inv);
}

static double along(const struct field_body *b, int node, int axis)
{
    const vec3 x = b->net->at[node];
    return axis == 0 ? x.x : axis == 1 ? x.y : x.z;
}

static void sort_along(const struct field_body *b, int *order, int n, int axis)
{
    for (int gap = n / 2; gap > 0; gap /= 2)
        for (int i = gap; i < n; i++)
            for (int j = i - gap; j >= 0; j -= gap) {
                const double lo = along(b, order[j], axis), hi = along(b, order[j + gap], axis);
                if (lo < hi || (lo == hi && order[j] < order[j + gap]))
                    break;
                const int swap = order[j];
                order[j] = order[j + gap];
                order[j + gap] = swap;
            }
}

/* Orders nodes first..first + n - 1 into leaves: halves along the longest edge of their box. */
static void split(struct field_body *b, int *order, int first, int n, int *room)
{
    int longest = 0;
    double widest = -1.0;
    if (n <= LEAF) {
        if (b->n_leaves == *room) {
            const int more = 2 * *room + 16;
            b->leaf = xrealloc(b->leaf, (size_t)*room, (size_t)more, sizeof *b->leaf);
            *room = more;
        }
        b->leaf[b->n_leaves++] = (struct field_leaf){.first = first, .n = n};
        return;
    }
    for (int a = 0; a < 3; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (int k = 0; k < n; k++) {
            lo = fmin(lo, along(b, order[first + k], a));
            hi = fmax(hi, along(b, order[first + k], a));
        }
        if (hi - lo > widest) {
            widest = hi - lo;
            longest = a;
        }
    }
    sort_along(b, order + first, n, longest);
    split(b, order, first, n / 2, room);
    split(b, order, first + n / 2, n - n / 2, room);
}

static void bound_leaves(struct field_body *b)
{
    for (int l = 0; l < b->n_leaves; l++) {
        struct field_leaf *const leaf = &b->leaf[l];
        for (int k = leaf->first; k < leaf->first + leaf->n; k++)
            leaf->centre = v3_axpy(leaf->centre, 1.0 / leaf->n, b->at[k]);
        for (int k = leaf->first; k < leaf->first + leaf->n; k++)
            leaf->radius = fmax(leaf->radius, v3_norm(v3_sub(b->at[k], leaf->centre)));
    }
}

/* Nodes in the body's frame, in the order of their leaves. The net's corners turn too. */
static void set_nodes(struct field_body *b)
{
    struct surface_net *const s = b->net;
    const size_t room = (size_t)s->n + 1;
    int *const order = xalloc(room, sizeof *order), leaves = 0;
    for (int k = 0; k < s->n; k++) {
        s->at[k] = mat3_back(&b->to_field, v3_sub(s->at[k], b->centre));
        s->normal[k] = mat3_back(&b->to_field, s->normal[k]);
        order[k] = k;
        b->area += s->area[k];
        b->bounding = fmax(b->bounding, v3_norm(s->at[k]));
    }
    split(b, order, 0, s->n, &leaves);
    b->n = s->n;
    b->at = xalloc(room, sizeof *b->at);
    b->normal = xalloc(room, sizeof *b->normal);
    b->weight = xalloc(room, sizeof *b->weight);
    for (int k = 0; k < b->n; k++) {
        b->at[k] = s->at[order[k]];
        b->normal[k] = s->normal[order[k]];
        b->weight[k] = s->area[order[k]];
    }
    bound_leaves(b);
    xfree(order);
}

/* The largest ball that touches the surface at a node from within: its radius, by bisection. */
static double inner_radius(const struct field_body *b, int k)
{
    double lo = 0.02, hi = b->thin * 1.0001;
    for (int step = 0; step < 20; step++) {
        const double r = 0.5 * (lo + hi);
        const double d = field_body_depth(b, v3_axpy(b->at[k], -r, b->normal[k]));
        if (d > r - 0.5 * COVER)
            lo = r;
        else
            hi = r;
    }
    return lo;
}

static int largest_first(const void *x, const void *y)
{
    const struct shape_ball *const a = x, *const b = y;
    if (a->radius != b->radius)
        return a->radius < b->radius ? 1 : -1;
    return a->centre.x != b->centre.x
               ? (a->centre.x > b->centre.x) - (a->centre.x < b->centre.x)
               : (a->centre.y > b->centre.y) - (a->centre.y < b->centre.y);
}

static void set_balls(struct field_body *b)
{
    struct shape_ball *const all = xalloc((size_t)b->n + 1, sizeof *all);
    bool *const covered = xalloc((size_t)b->n + 1, sizeof *covered);
    for (int k = 0; k < b->n; k++) {
        const double r = inner_radius(b, k);
        all[k] = (struct shape_ball){
            .centre = v3_axpy(b->at[k], -r, b->normal[k]), .radius = r, .curve = 1.0};
    }
    qsort(all, (size_t)b->n, sizeof *all, largest_first);
    b->ball = xalloc((size_t)b->n + 1, sizeof *b->ball);
    for (int m = 0; m < b->n; m++) {
        bool news = false;
        for (int k = 0; k < b->n; k++) {
            const double out = v3_norm(v3_sub(b->at[k], all[m].centre)) - all[m].radius;
            if (!covered[k] && out < COVER)
                covered[k] = news = true;
        }
        if (news)
            b->ball[b->n_balls++] = all[m];
    }
    xfree(all);
    xfree(covered);
}

struct field_body *field_body(struct distance_field *field, double spacing, char **why)
{
    struct field_body *const b = xalloc(1, sizeof *b);
    b->field = field;
    weigh(b);
    for (size_t k = 0;
         k < (size_t)field->n[0] * (size_t)field->n[1] * (size_t)field->n[2] && b->volume > 0.0;
         k++)
        b->thin = fmax(b->thin, -(double)field->value[k]);
    if (b->thin < 2.0 * field->spacing) {
        *why = xprintf("the body is thinner than 4 cells of its grid; take a finer one");
        field_body_free(b);
        return NULL;
    }
    b->spacing = 2.0 * spacing;
    b->net = surface_net(field, b->spacing);
    set_nodes(b);
    set_balls(b);
    return b;
}

void field_body_free(struct field_body *b)
{
    if (!b)
        return;
    distance_free(b->field);
    surface_net_free(b->net);
    xfree(b->at);
    xfree(b->normal);
    xfree(b->weight);
    xfree(b->leaf);
    xfree(b->ball);
    xfree(b);
}

struct shape_part *field_body_parts(const struct field_body *b, double spacing, int *n)
{
    vec3 lo = v3(INFINITY, INFINITY, INFINITY), hi = v3_scale(-1.0, lo);
    const vec3 centre = v3(0.0, 0.0, 0.0);
    for (int k = 0; k < b->n; k++) {
        lo = v3(fmin(lo.x, b->at[k].x), fmin(lo.y, b->at[k].y), fmin(lo.z, b->at[k].z));
        hi = v3(fmax(hi.x, b->at[k].x), fmax(hi.y, b->at[k].y), fmax(hi.z, b->at[k].z));
    }
    const double edge = 0.25 * b->spacing; /* what sticks out between nodes */
    return volume_shape_parts(field_body_depth, b, v3_sub(lo, v3(edge, edge, edge)),
                              v3_add(hi, v3(edge, edge, edge)), spacing,
                              4.0 / 3.0 * 3.14159265358979323846, &centre, n);
}
