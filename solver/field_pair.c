/* field_pair.c - two grains given by distance fields [Kawamoto16]: nodes of either in the field of the
 * other, see field_body.h.
 *
 * Nodes of one that lie inside the other, both ways, are gathered into clusters: nodes less than LINK
 * spacings apart belong together. A cluster is one contact. Its depth is that of its deepest node, its
 * normal and place are means over its nodes weighted by their area and depth - as pressures
 * proportional to the depth would have them - so neither depends on the number of nodes. The original
 * gives every node a spring of its own, so that its stiffness goes with their number. */
#include "base.h"
#include "field_body.h"

#define LINK 2.2
enum { SAMPLES = 512 };

/* A node of one body inside the other. */
struct sample {
    int node, cluster;
    double depth, weight;
    vec3 normal, at;
};

struct samples {
    int n;
    double nearest; /* m; least distance of a node that is outside */
    struct sample near, s[SAMPLES];
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

/* Nodes of a in b; `place`: of a from x_i, m; `sign`: 1 where a is i. */
static void look(const struct field_placed *a, const struct field_placed *b, vec3 apart,
                 vec3 place, double sign, double reach, int offset, struct samples *out)
{
    const struct field_body *const body = a->body;
    const struct distance_field *const f = b->body->field;
    const struct passage p = passage(a, b, apart);
    const double ratio = a->size / b->size, within = reach / b->size;
    for (int l = 0; l < body->n_leaves; l++) {
        const struct field_leaf *const leaf = &body->leaf[l];
        const vec3 middle = v3_add(p.o, mat3_turn(&p.q, leaf->centre));
        if (distance_at(f, middle) > 1.1 * leaf->radius * ratio + within)
            continue;
        for (int k = leaf->first; k < leaf->first + leaf->n; k++) {
            vec3 slope;
            const double d =
                b->size * distance_slope(f, v3_add(p.o, mat3_turn(&p.q, body->at[k])), &slope);
            const double steep = v3_norm(slope);
            if ((d >= 0.0 && d >= out->nearest) || !(steep > 0.0) ||
                (d < 0.0 && out->n == SAMPLES))
                continue;
            const vec3 n = v3_scale(sign / steep,
                                    mat3_turn(&b->turn, mat3_back(&b->body->to_field, slope)));
            const vec3 at = v3_axpy(place, a->size, mat3_turn(&a->turn, body->at[k]));
            const struct sample s = {.node = offset + k,
                                     .depth = -d,
                                     .weight = body->weight[k] * a->size * a->size,
                                     .normal = n,
                                     .at = v3_axpy(at, -0.5 * d * sign, n)};
            if (d < 0.0) {
                out->s[out->n++] = s;
            } else {
                out->nearest = d;
                out->near = s;
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

/* The cluster of this root. */
static struct field_touch gather(const struct samples *all, int first)
{
    struct field_touch t = {.node = all->s[first].node};
    double sum = 0.0;
    for (int k = first; k < all->n; k++) {
        const struct sample *const s = &all->s[k];
        const double w = s->weight * s->depth;
        if (root(all, k) != first)
            continue;
        sum += w;
        t.normal = v3_axpy(t.normal, w, s->normal);
        t.at = v3_axpy(t.at, w, s->at);
        if (s->depth > t.depth) {
            t.depth = s->depth;
            t.node = s->node;
        }
    }
    const double length = v3_norm(t.normal);
    t.normal = length > 0.0 ? v3_scale(1.0 / length, t.normal) : all->s[first].normal;
    t.at = sum > 0.0 ? v3_scale(1.0 / sum, t.at) : all->s[first].at;
    return t;
}

int field_meet(const struct field_placed *i, const struct field_placed *j, vec3 apart,
               double reach, int most, struct field_touch *out)
{
    struct samples all;
    const vec3 other = v3_scale(-1.0, apart);
    int n = 0;
    all.n = 0;
    all.nearest = reach;
    all.near.node = -1;
    look(i, j, apart, v3(0.0, 0.0, 0.0), 1.0, reach, 0, &all);
    look(j, i, other, other, -1.0, reach, i->body->n, &all);
    if (all.n == 0) {
        if (all.near.node < 0 || most < 1)
            return 0;
        out[0] = (struct field_touch){.node = all.near.node,
                                      .depth = all.near.depth,
                                      .normal = all.near.normal,
                                      .at = all.near.at};
        return 1;
    }
    link(&all, LINK * fmax(i->size * i->body->spacing, j->size * j->body->spacing));
    for (int k = 0; k < all.n; k++)
        if (all.s[k].cluster == k) {
            if (n < most)
                out[n] = gather(&all, k);
            n++;
        }
    return n;
}
