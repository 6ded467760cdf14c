/* shapes/geometry/dilated_pair.c - where two bodies of dilated polyhedra touch.
 *
 * All is done in the body frame of i, with its size as the unit: the vertices of i then stand where
 * they are stored, and those of j are turned once a pair. A pair of parts that was found apart is passed
 * over until the bodies may have come that much nearer; then boxes tell, then the direction kept from
 * the last look: the lowest and highest vertex along it. */
#include "dilated.h"
#include "envelope.h"

#define MORE 0.1 /* sizes: a direction that parts two parts by that much more serves for long */

/* j as seen by i. */
struct view {
    vec3 axes[3], place; /* of j's frame in that of i, in sizes of i */
    vec3 wide[3];        /* the axes' components without their signs */
    double scale;        /* size of j over that of i */
    double reach;        /* in sizes of i */
};

static vec3 into_own(const vec3 axes[3], vec3 d)
{
    return v3(v3_dot(axes[0], d), v3_dot(axes[1], d), v3_dot(axes[2], d));
}

static vec3 out_of(const struct view *v, vec3 x)
{
    const vec3 turned =
        v3_add(v3_scale(x.x, v->axes[0]), v3_axpy(v3_scale(x.y, v->axes[1]), x.z, v->axes[2]));
    return v3_axpy(v->place, v->scale, turned);
}

static void look(const struct shape_pose *i, const struct shape_pose *j, double reach,
                 struct view *v)
{
    const double per = 1.0 / i->size;
    const struct mat3 *const a = &i->turn, *const b = &j->turn;
    const vec3 column[3] = {{b->row[0].x, b->row[1].x, b->row[2].x},
                            {b->row[0].y, b->row[1].y, b->row[2].y},
                            {b->row[0].z, b->row[1].z, b->row[2].z}};
    for (int k = 0; k < 3; k++) {
        const vec3 e = v->axes[k] = mat3_back(a, column[k]);
        v->wide[k] = v3(fabs(e.x), fabs(e.y), fabs(e.z));
    }
    v->place = v3_scale(per, mat3_back(a, v3_sub(j->centre, i->centre)));
    v->scale = j->size * per;
    v->reach = reach * per;
}

static double most_of(vec3 x)
{
    return fmax(x.x, fmax(x.y, x.z));
}

/* A lower bound of how far apart two parts are: by their balls, then by their boxes along the sides
 * of either, of the axes that can part two boxes [GottschalkLinManocha96] those that cost little. */
static double far_apart(const struct dilated_part *a, const struct dilated_part *b,
                        const struct view *v)
{
    const vec3 d = v3_sub(out_of(v, b->middle), a->middle);
    const double reach = a->radius + v->scale * b->radius + v->reach, square = v3_dot(d, d);
    if (square > reach * reach)
        return sqrt(square) - (reach - v->reach);
    const vec3 h = v3_scale(v->scale, b->half), *const w = v->wide;
    const double along_a =
        most_of(v3(fabs(d.x) - a->half.x - (w[0].x * h.x + w[1].x * h.y + w[2].x * h.z),
                   fabs(d.y) - a->half.y - (w[0].y * h.x + w[1].y * h.y + w[2].y * h.z),
                   fabs(d.z) - a->half.z - (w[0].z * h.x + w[1].z * h.y + w[2].z * h.z)));
    if (along_a > v->reach)
        return along_a;
    return most_of(v3(fabs(v3_dot(v->axes[0], d)) - h.x - v3_dot(w[0], a->half),
                      fabs(v3_dot(v->axes[1], d)) - h.y - v3_dot(w[1], a->half),
                      fabs(v3_dot(v->axes[2], d)) - h.z - v3_dot(w[2], a->half)));
}

/* What is kept of a pair of parts between steps. */
struct kept {
    vec3 direction;
    struct gap_memory simplex;
};

static bool recall(const real *memory, int kept, int pair, struct kept *k)
{
    *k = (struct kept){.direction = {0.0, 0.0, 0.0}};
    const real *const m = &memory[DILATED_MEMORY * (pair % kept)];
    if (m[0] != (real)(pair + 1))
        return false;
    k->direction = v3((double)m[1], (double)m[2], (double)m[3]);
    for (int c = 0; c < 3 && m[4 + c] > (real)0.0; c++) {
        const int packed = (int)m[4 + c] - 1;
        k->simplex.a[c] = packed / POLYHEDRON_MOST;
        k->simplex.b[c] = packed % POLYHEDRON_MOST;
        k->simplex.n++;
    }
    return true;
}

static void remember(real *memory, int kept, int pair, const struct kept *k)
{
    real *const m = &memory[DILATED_MEMORY * (pair % kept)];
    m[0] = (real)(pair + 1);
    m[1] = (real)k->direction.x;
    m[2] = (real)k->direction.y;
    m[3] = (real)k->direction.z;
    for (int c = 0; c < 3; c++)
        m[4 + c] = c < k->simplex.n
                       ? (real)(k->simplex.a[c] * POLYHEDRON_MOST + k->simplex.b[c] + 1)
                       : (real)0.0;
}

static struct points own_points(const struct polyhedron *p)
{
    return (struct points){p->vertex_room, p->x, p->y, p->z};
}

/* How far apart the cores are along the direction, at least. */
static double along(const struct polyhedron *a, const struct polyhedron *b,
                    const struct view *v, vec3 direction)
{
    const struct points pa = own_points(a), pb = own_points(b);
    double low, high;
    points_lowest(&pa, direction, &low);
    points_highest(&pb, into_own(v->axes, direction), &high);
    return low - v->scale * high - v3_dot(v->place, direction);
}

struct scratch {
    _Alignas(64) double x[POLYHEDRON_MOST];
    _Alignas(64) double y[POLYHEDRON_MOST];
    _Alignas(64) double z[POLYHEDRON_MOST];
};

static void turn_vertices(const struct polyhedron *p, const struct view *v, struct scratch *s)
{
    const vec3 ex = v3_scale(v->scale, v->axes[0]), ey = v3_scale(v->scale, v->axes[1]),
               ez = v3_scale(v->scale, v->axes[2]), at = v->place;
    for (int k = 0; k < p->vertex_room; k++) {
        s->x[k] = at.x + ex.x * p->x[k] + ey.x * p->y[k] + ez.x * p->z[k];
        s->y[k] = at.y + ex.y * p->x[k] + ey.y * p->y[k] + ez.y * p->z[k];
        s->z[k] = at.z + ex.z * p->x[k] + ey.z * p->y[k] + ez.z * p->z[k];
    }
}

static struct patch_body body_of(const struct polyhedron *p, struct points at,
                                 const vec3 axes[3], vec3 place, double scale)
{
    return (struct patch_body){p, at, {axes[0], axes[1], axes[2]}, place, scale};
}

/* The point in the laboratory, m. */
static struct shape_point make_point(const struct shape_pair *p, const struct patch_point *q,
                                     vec3 n, double ri, double rj, int id)
{
    const double size = p->i.size;
    const vec3 normal = mat3_turn(&p->i.turn, n);
    const vec3 on_j = v3_scale(size, mat3_turn(&p->i.turn, q->on_b));
    const double gap = size * q->gap, hi = size * ri, hj = size * rj;
    const vec3 at = v3_axpy(on_j, 0.5 * (gap - hi + hj), normal);
    const vec3 apart = v3_sub(p->j.centre, p->i.centre);
    return (struct shape_point){.id = id + q->id,
                                .depth = hi + hj - gap,
                                .normal = normal,
                                .at_i = at,
                                .at_j = v3_sub(at, apart),
                                .from_i = v3_axpy(on_j, gap, normal),
                                .from_j = v3_sub(on_j, apart),
                                .r_i = p->i.size,
                                .r_j = p->j.size,
                                .lever = v3_scale(size, mat3_turn(&p->i.turn, q->lever)),
                                .scale = fmin(p->i.size, p->j.size),
                                .share = q->share};
}

/* What two parts are given to the search with. */
struct parts {
    const struct dilated *i, *j;
    const struct polyhedron *a, *b;
    const double *weights_a, *weights_b;
    int pair, first_id;
    real *memory;
    double *apart; /* sizes of i; a bound of how far apart they are, where they do not touch */
};

static int gather(const struct shape_pair *p, const struct parts *w,
                  const struct patch_point *q, int n, vec3 normal, const struct view *v,
                  int most, int have, struct shape_point *out)
{
    int count = have;
    for (int k = 0; k < n; k++) {
        const struct shape_point point =
            make_point(p, &q[k], normal, w->i->r, v->scale * w->j->r, w->first_id);
        if (point.depth < -p->reach)
            continue;
        if (count < most)
            out[count] = point;
        count++;
    }
    return count;
}

/* The points that stand for a patch: its middle, or, where it is wide, two on either side whose
 * variance is the patch's. The force of all goes through the middle; what each has of its own is
 * friction and the dashpot. */
static int spread(const struct crown_gap *g, double size, struct patch_point *q)
{
    const double width = g->r11 + g->r22;
    const vec3 first = v3_add(v3_scale(g->r11, g->e1), v3_scale(g->r12, g->e2)),
               second = v3_add(v3_scale(g->r12, g->e1), v3_scale(g->r22, g->e2));
    if (width < CROWN_NARROW * size) {
        q[0] = (struct patch_point){.share = 1.0, .gap = g->gap, .on_b = g->on_b};
        return 1;
    }
    for (int k = 0; k < 4; k++) {
        const vec3 lever = v3_scale(k % 2 ? -sqrt(2.0) : sqrt(2.0), k < 2 ? first : second);
        q[k] = (struct patch_point){1 + k, 0.25, g->gap, v3_add(g->on_b, lever), lever};
    }
    return 4;
}

/* Those of the crowned cores. */
static int crown_points(const struct shape_pair *p, const struct parts *w, const struct view *v,
                        const struct scratch *s, struct kept *keep, int kept, int most,
                        int have, struct shape_point *out)
{
    const double dilation = w->i->r + v->scale * w->j->r, reach = v->reach + dilation;
    const struct crown a = {own_points(w->a), w->weights_a, CROWN_SHARP},
                       b = {{w->b->vertex_room, s->x, s->y, s->z},
                            w->weights_b,
                            CROWN_SHARP / v->scale};
    struct crown_gap g;
    struct patch_point q[4];
    const bool near = crown_find_gap(&a, &b, v3(0.0, 0.0, 0.0), reach, keep->direction, &g);
    keep->direction = g.normal;
    remember(w->memory, kept, w->pair, keep);
    *w->apart = g.gap - dilation;
    if (!near)
        return have;
    const int n = spread(&g, fmin(1.0, v->scale), q);
    return gather(p, w, q, n, g.normal, v, most, have, out);
}

/* Adds the points of two parts to those that there are. */
static int part_points(const struct shape_pair *p, const struct parts *w, const struct view *v,
                       const struct detection *how, int kept, int most, int have,
                       struct shape_point *out)
{
    static const vec3 own[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const double dilation = w->i->r + v->scale * w->j->r, reach = v->reach + dilation;
    struct kept keep;
    struct scratch s;
    struct gap gap;
    struct patch_point q[PATCH_MOST];
    const double slack = how->detector == DETECTOR_GJK ? CROWN_SLACK * (1.0 + v->scale) : 0.0;
    if (recall(w->memory, kept, w->pair, &keep)) {
        const double far = along(w->a, w->b, v, keep.direction) - slack;
        *w->apart = far - dilation;
        if (far > reach)
            return have;
        if (how->detector == DETECTOR_GJK && far > 0.0) {
            turn_vertices(w->b, v, &s);
            return crown_points(p, w, v, &s, &keep, kept, most, have, out);
        }
    }
    turn_vertices(w->b, v, &s);
    const struct points pa = own_points(w->a), pb = {w->b->vertex_room, s.x, s.y, s.z};
    gap_find(&pa, w->a, &pb, w->b, v->axes, reach + MORE, &keep.simplex, &gap);
    gap.distance -= slack;
    keep.direction = gap.normal;
    remember(w->memory, kept, w->pair, &keep);
    *w->apart = gap.distance - dilation;
    if (gap.distance >= reach)
        return have;
    if (how->detector == DETECTOR_GJK)
        return crown_points(p, w, v, &s, &keep, kept, most, have, out);
    const struct patch_body a = body_of(w->a, pa, own, v3(0.0, 0.0, 0.0), 1.0),
                            b = body_of(w->b, pb, v->axes, v->place, v->scale);
    if (gap.distance > 0.0) {
        envelope_gap(&a, w->i->r, &b, v->scale * w->j->r, how->smoothness, &gap);
        q[0] = (struct patch_point){.id = patch_ids(w->a, w->b) - 1,
                                    .share = 1.0,
                                    .gap = gap.distance,
                                    .on_b = gap.on_b};
        return gather(p, w, q, 1, gap.normal, v, most, have, out);
    }
    const int n = patch_find(&a, &b, &gap, how->tilt, PATCH_MOST, q);
    return gather(p, w, q, n, gap.normal, v, most, have, out);
}

/* Takes what the bodies have come nearer off what parts two of their parts, m; is something left? */
static bool still_apart(const struct shape_pair *p, real *left)
{
    if (!(*left > (real)0.0 && p->approached > 0.0))
        return false;
    *left -= (real)p->approached;
    return *left > (real)0.0;
}

int dilated_points(const struct dilated *i, const struct dilated *j,
                   const struct detection *how, const struct shape_pair *p, int kept, int most,
                   struct shape_point *out)
{
    struct view v;
    int n = 0, first = 0, pair = 0;
    const bool several = i->n_parts + j->n_parts > 2;
    double least = (double)INFINITY;
    look(&p->i, &p->j, p->reach, &v);
    for (int a = 0; a < i->n_parts; a++)
        for (int b = 0; b < j->n_parts; b++, pair++) {
            real *const left = kept > 1 && pair < DILATED_LEFT ? &p->memory[pair] : NULL;
            const int id = first;
            first += patch_ids(i->part[a].core, j->part[b].core);
            if (left && still_apart(p, left)) {
                least = fmin(least, v.reach + (double)*left / p->i.size);
                continue;
            }
            double apart = (double)INFINITY;
            const struct parts w = {i,
                                    j,
                                    i->part[a].core,
                                    j->part[b].core,
                                    i->part[a].log_weight,
                                    j->part[b].log_weight,
                                    pair,
                                    id,
                                    p->memory + (kept > 1 ? DILATED_LEFT : 0),
                                    &apart};
            if (several)
                apart = far_apart(&i->part[a], &j->part[b], &v);
            if (!several || apart <= v.reach)
                n = part_points(p, &w, &v, how, kept, most, n, out);
            least = fmin(least, apart);
            if (left)
                *left = (real)fmax(p->i.size * (apart - v.reach), 0.0);
        }
    if (n == 0 && p->apart)
        *p->apart = p->i.size * least;
    return n;
}
