/* field_pair.c - two grains given by distance fields: nodes of either in the field of the other
 * [Kawamoto16], see field_body.h; a force that has a potential.
 *
 * The original gives every node a spring, whose stiffness then goes with the number of nodes, and pushes along
 * normals that are no gradient of anything. Here the pair has one depth D, made of the depths d_k of
 * the nodes of either inside the other, each with its area w_k,
 *     D = (5 S / (2 pi R*))^(1/5),   S = 1/2 sum w_k d_k^4,   1/R* = 1/size_i + 1/size_j,
 * and node k bears the part dD/dd_k = 2/5 (D/S) w_k d_k^3 of what the laws give for D, along the gradient of
 * the very distance that d_k is read from. So whatever law F(D), the force of an elastic contact is the gradient
 * of the energy of the law at D, which collisions keep [Feng21 says what that takes], as they keep angular
 * momentum: both bodies are pushed at the same places.
 *
 * Why the fourth power: of paraboloids d = delta - x^2/2 R_1 - y^2/2 R_2, so that S = 2 pi sqrt(R_1 R_2)
 * delta^5 / 10 from each side, and Hertz' energy 8/15 E* sqrt(R*) D^(5/2) is that of radii R_1 and R_2, whatever R*.
 * Of flat faces of area A it is that of a linear spring, of 0.84 times the stiffness of a rigid punch, 2 E*
 * sqrt(A/pi); and dashpots that give Hertz' contact its restitution give such a spring the same. Places far
 * apart where two bodies touch count as one: m like ones are stiff as sqrt(m), not m.
 *
 * Overlaps less than what nodes do not see, d_0 = spacing^2/8 R*, start softer, D (S/(S + S_0))^(1/10) with
 * S_0 = 1/2 spacing^2 d_0^4: the force begins as the square of the depth, not with a kink, which
 * steps of finite length would pay for with energy.
 *
 * Nodes less than LINK spacings apart are one patch. It is given to the laws as four points (one where
 * it is a single node) about the line on which its force acts: with its force and torque, its part of
 * the energy and its spread. A force along one line has no torque about it, a patch may have some: so the normals
 * of the four lean round that line. */
#include "base.h"
#include "field_body.h"

#define LINK 2.2
enum { SAMPLES = 1024, PATCHES = 8, CORNERS = 4 };

/* A node of one body inside the other. */
struct sample {
    int node, cluster;
    double depth, area;
    vec3 slope; /* of the distance; it pushes i along this */
    vec3 at;
};

struct samples {
    int n;
    double nearest; /* m; least distance of a node that is outside */
    double clear;   /* m; of those not looked at, a bound */
    struct sample near, s[SAMPLES];
};

/* Sums over the nodes of a patch. */
struct patch {
    int n, first;  /* nodes; the least of their numbers */
    double energy; /* sum of w d^4 */
    double deepest;
    double weight;                 /* of w d^3 = c */
    vec3 force;                    /* of c slope */
    vec3 torque;                   /* of c at x slope, about x_i */
    vec3 at;                       /* of c at */
    double xx, yy, zz, xy, xz, yz; /* of c at at */
};

/* x_field = o + Q x: from the frame of body a to the field of b. */
struct passage {
    struct mat3 q;
    vec3 o;
};

static struct passage passage(const struct field_placed *a, const struct field_placed *b,
                              vec3 apart)
{
    /* M_b turn_b^T turn_a s_a/s_b */
    const struct mat3 turn = mat3_between(&b->turn, &a->turn);
    const struct mat3 back = mat3_transposed(&b->body->to_field);
    struct mat3 q = mat3_between(&back, &turn);
    const vec3 o = mat3_turn(&b->body->to_field, mat3_back(&b->turn, apart));
    for (int k = 0; k < 3; k++)
        q.row[k] = v3_scale(a->size / b->size, q.row[k]);
    return (struct passage){q, v3_axpy(b->body->centre, 1.0 / b->size, o)};
}

static void add(struct patch *p, const struct sample *s)
{
    const double c = s->area * s->depth * s->depth * s->depth;
    const vec3 x = s->at;
    p->first = p->n == 0 || s->node < p->first ? s->node : p->first;
    p->n++;
    p->energy += c * s->depth;
    p->deepest = fmax(p->deepest, s->depth);
    p->weight += c;
    p->force = v3_axpy(p->force, c, s->slope);
    p->torque = v3_axpy(p->torque, c, v3_cross(x, s->slope));
    p->at = v3_axpy(p->at, c, x);
    p->xx += c * x.x * x.x;
    p->yy += c * x.y * x.y;
    p->zz += c * x.z * x.z;
    p->xy += c * x.x * x.y;
    p->xz += c * x.x * x.z;
    p->yz += c * x.y * x.z;
}

/* Nodes of a in b; `place`: of a from x_i, m; `sign`: 1 where a is i. Those for which there is no room go
 * to `rest`. */
static void look(const struct field_placed *a, const struct field_placed *b, vec3 apart,
                 vec3 place, double sign, double reach, int offset, struct samples *out,
                 struct patch *rest)
{
    const struct field_body *const body = a->body;
    const struct distance_field *const f = b->body->field;
    const struct passage p = passage(a, b, apart);
    const double ratio = a->size / b->size, within = reach / b->size;
    for (int l = 0; l < body->n_leaves; l++) {
        const struct field_leaf *const leaf = &body->leaf[l];
        const vec3 middle = v3_add(p.o, mat3_turn(&p.q, leaf->centre));
        const double off = distance_at(f, middle) - 1.1 * leaf->radius * ratio;
        if (off > within) {
            out->clear = fmin(out->clear, b->size * off);
            continue;
        }
        for (int k = leaf->first; k < leaf->first + leaf->n; k++) {
            vec3 slope;
            const double d =
                b->size * distance_slope(f, v3_add(p.o, mat3_turn(&p.q, body->at[k])), &slope);
            out->clear = fmin(out->clear, d);
            if ((d >= 0.0 && d >= out->nearest) || !(v3_dot(slope, slope) > 0.0))
                continue;
            const vec3 g =
                v3_scale(sign, mat3_turn(&b->turn, mat3_back(&b->body->to_field, slope)));
            const vec3 at = v3_axpy(place, a->size, mat3_turn(&a->turn, body->at[k]));
            const struct sample s = {.node = offset + k,
                                     .depth = -d,
                                     .area = body->weight[k] * a->size * a->size,
                                     .slope = g,
                                     .at = v3_axpy(at, -0.5 * d * sign, g)};
            if (d >= 0.0) {
                out->nearest = d;
                out->near = s;
            } else if (out->n < SAMPLES) {
                out->s[out->n++] = s;
            } else {
                add(rest, &s);
            }
        }
    }
}

static int root(const struct samples *all, int k)
{
    while (all->s[k].cluster != k)
        k = all->s[k].cluster;
    return k;
}

static void link(struct samples *all, double distance)
{
    for (int k = 0; k < all->n; k++) {
        all->s[k].cluster = k;
        for (int m = 0; m < k; m++) {
            const vec3 d = v3_sub(all->s[k].at, all->s[m].at);
            if (v3_dot(d, d) > distance * distance)
                continue;
            const int a = root(all, k), b = root(all, m);
            all->s[a > b ? a : b].cluster = a > b ? b : a;
        }
    }
}

/* The patches, of which the last takes what there is no room for; returns how many. */
static int gather(struct samples *all, const struct patch *rest, int room, struct patch *out)
{
    int n = 0, of[SAMPLES];
    if (rest->n > 0)
        out[n++] = *rest;
    for (int k = 0; k < all->n; k++) {
        const int r = root(all, k);
        if (r == k) {
            of[k] = n < room ? n : room - 1;
            if (n < room)
                out[n++] = (struct patch){.n = 0};
        }
        add(&out[of[r]], &all->s[k]);
    }
    return n;
}

/* Two vectors across the normal whose squares add up to the spread of the patch. */
static void spread(const struct patch *p, vec3 middle, vec3 normal, vec3 lever[2])
{
    const double per = 1.0 / p->weight;
    const vec3 e1 = v3_across(normal), e2 = v3_cross(normal, e1), m = middle;
    const struct mat3 c = {
        {{per * p->xx - m.x * m.x, per * p->xy - m.x * m.y, per * p->xz - m.x * m.z},
         {per * p->xy - m.x * m.y, per * p->yy - m.y * m.y, per * p->yz - m.y * m.z},
         {per * p->xz - m.x * m.z, per * p->yz - m.y * m.z, per * p->zz - m.z * m.z}}};
    const vec3 c1 = mat3_turn(&c, e1), c2 = mat3_turn(&c, e2);
    const double c11 = fmax(v3_dot(e1, c1), 0.0), c12 = v3_dot(e1, c2),
                 c22 = fmax(v3_dot(e2, c2), 0.0);
    /* the root of a matrix of two by two */
    const double det = sqrt(fmax(c11 * c22 - c12 * c12, 0.0)), trace = c11 + c22 + 2.0 * det;
    const double by = trace > 0.0 ? 1.0 / sqrt(trace) : 0.0;
    lever[0] = v3_add(v3_scale((c11 + det) * by, e1), v3_scale(c12 * by, e2));
    lever[1] = v3_add(v3_scale(c12 * by, e1), v3_scale((c22 + det) * by, e2));
}

/* The pair's depth from the sum of w d^4 of all patches, (S/D) dD/dS, and the deepest node. */
struct onset {
    double depth, power, deepest;
};

static struct onset onset(const struct field_placed *i, const struct field_placed *j,
                          double sum, double deepest)
{
    const double r = i->size * j->size / (i->size + j->size);
    const double spacing = fmax(i->size * i->body->spacing, j->size * j->body->spacing);
    const double hidden = spacing * spacing / (8.0 * r), square = hidden * hidden;
    const double least = spacing * spacing * square * square, part = sum / (sum + least);
    const double depth = pow(1.25 * sum / (3.14159265358979323846 * r), 0.2);
    return (struct onset){depth * pow(part, 0.1), 0.2 + 0.1 * (1.0 - part), deepest};
}

/* The points of a patch: 1 or 4. `all`: the sum of w d^4 of all patches. */
static int represent(const struct patch *p, double all, const struct onset *o, int id,
                     struct field_touch *out)
{
    const double pull = v3_norm(p->force), per = 1.0 / p->weight;
    const vec3 middle = v3_scale(per, p->at);
    const double share = p->energy / all;
    /* dD/dd = power D/S 2 c, S = all / 2 */
    const double depth = o->depth,
                 slope = fmax(4.0 * o->power * depth / all * pull / share, 1e-12);
    vec3 lever[2], at = middle;
    *out = (struct field_touch){
        .id = id, .depth = depth, .deepest = o->deepest, .share = share, .slope = slope};
    out->normal = pull > 0.0 ? v3_scale(1.0 / pull, p->force) : v3(0.0, 0.0, 1.0);
    out->at = middle;
    if (p->n < 2 || !(pull > 0.0))
        return 1;
    const vec3 n = out->normal;
    const vec3 couple =
        v3_scale(1.0 / pull, v3_sub(p->torque, v3_cross(middle, p->force))); /* m */
    spread(p, middle, n, lever);
    const double wide = v3_dot(lever[0], lever[0]) + v3_dot(lever[1], lever[1]);
    if (!(wide > 0.0))
        return 1;
    /* onto the line on which the force acts, but where opposite pushes cancel it is far off */
    const vec3 aside = v3_cross(n, couple);
    const double most = 2.0 * sqrt(wide), far = v3_norm(aside);
    at = v3_axpy(middle, far > most ? most / far : 1.0, aside);
    const double lean = v3_dot(n, couple) / wide;
    for (int k = 0; k < CORNERS; k++) {
        const vec3 arm = v3_scale(k % 2 ? -sqrt(2.0) : sqrt(2.0), lever[k / 2]);
        const vec3 way = v3_axpy(n, lean, v3_cross(n, arm));
        const double longer = v3_norm(way);
        out[k] = (struct field_touch){.id = id + k,
                                      .depth = depth,
                                      .deepest = o->deepest,
                                      .normal = v3_scale(1.0 / longer, way),
                                      .at = v3_add(at, arm),
                                      .share = 0.25 * share,
                                      .slope = longer * slope};
    }
    return CORNERS;
}

static int lone(const struct sample *s, struct field_touch *out)
{
    const double steep = v3_norm(s->slope);
    *out = (struct field_touch){.id = 0,
                                .depth = s->depth,
                                .deepest = s->depth,
                                .normal = v3_scale(1.0 / steep, s->slope),
                                .at = s->at,
                                .share = 1.0,
                                .slope = 1.0};
    return 1;
}

int field_meet(const struct field_placed *i, const struct field_placed *j, vec3 apart,
               double reach, int most, struct field_touch *out, double *clear)
{
    struct samples all;
    struct patch patch[PATCHES], rest = {.n = 0};
    const vec3 other = v3_scale(-1.0, apart);
    const int room = most / CORNERS < PATCHES ? most / CORNERS : PATCHES;
    double energy = 0.0, deepest = 0.0;
    int n = 0;
    all.n = 0;
    all.nearest = reach;
    all.near.node = -1;
    all.clear = (double)INFINITY;
    look(i, j, apart, v3(0.0, 0.0, 0.0), 1.0, reach, 0, &all, &rest);
    look(j, i, other, other, -1.0, reach, i->body->n, &all, &rest);
    *clear = 0.0;
    if (all.n == 0 || room < 1) {
        if (all.n == 0 && all.near.node < 0) /* the slope of the spline may exceed 1 */
            *clear = 0.9 * all.clear;
        return all.near.node < 0 || most < 1 ? 0 : lone(&all.near, out);
    }
    link(&all, LINK * fmax(i->size * i->body->spacing, j->size * j->body->spacing));
    const int patches = gather(&all, &rest, room, patch);
    for (int k = 0; k < patches; k++) {
        energy += patch[k].energy;
        deepest = fmax(deepest, patch[k].deepest);
    }
    const struct onset o = onset(i, j, energy, deepest);
    for (int k = 0; k < patches; k++)
        n += represent(&patch[k], energy, &o, patches == 1 ? 0 : CORNERS * (patch[k].first + 1),
                       out + n);
    return n;
}
