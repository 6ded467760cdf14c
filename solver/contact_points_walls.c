/* contact_points_walls.c - grains of any shape against walls of every kind.
 *
 * A shape touches walls with its balls (shape.h): each of them meets the elements of the walls as a
 * sphere would (contact_facing.h). A convex body without vertices meets an element by a ball of
 * INSET of its size that touches its surface from within at the point that lies deepest: n, the
 * direction from the element's nearest point to the ball, and the farthest point of the body along
 * -n are found by turns. Flat elements may be met by the shape's convex parts instead (meet_flat):
 * a face of a grain is then no stiffer than a vertex. A contact that goes over to another element
 * takes its memory along. */
#include "contact_points_walls.h"

#define SAME  1e-6 /* of the size: points nearer than this coincide */
#define INSET 0.25

static void grow(struct meetings *all)
{
    const int more = 2 * all->room + 32;
    all->m = xrealloc(all->m, (size_t)all->room, (size_t)more, sizeof *all->m);
    all->room = more;
}

static void grow_facings(struct meetings *all, int room)
{
    void *const old[] = {all->seen, all->radius, all->met, all->flat};
    for (size_t k = 0; k < sizeof old / sizeof old[0]; k++)
        xfree(old[k]);
    all->facings = room;
    all->seen = xalloc(2 * (size_t)room, sizeof *all->seen);
    all->radius = xalloc((size_t)room, sizeof *all->radius);
    all->met = xalloc((size_t)room, sizeof *all->met);
    all->flat = xalloc((size_t)room, sizeof *all->flat);
}

/* m; run.overlap_max is of the radius of curvature, but a ball may not go through the wall. */
static double deepest_of(const struct sim *s, double curve, double radius)
{
    return fmin(curve, radius / s->run.overlap_max);
}

/* Adds what a ball meets: of the elements from `from` on, those that count. */
static void meet(const struct sim *s, struct meetings *all, const struct around *a,
                 struct facing *f, int n, double radius, double curve, vec3 centre, int id)
{
    const double reach = radius + s->neighbours.reach;
    for (int k = 0; k < n; k++) {
        if (!(f[k].distance < reach) || facing_hidden(s, f, n, k, SAME * a->pose.size))
            continue;
        if (all->n == all->room)
            grow(all);
        struct shape_point p =
            shape_balls_meet(centre, radius, v3(0.0, 0.0, 0.0), 0.0, f[k].away, id);
        p.at_j = v3(0.0, 0.0, 0.0);
        p.r_i = curve > 0.0 ? curve : radius;
        p.scale = curve > 0.0 ? deepest_of(s, curve, radius) : radius;
        all->m[all->n++] =
            (struct meeting){.f = f[k], .p = p, .place = mat3_back(&a->pose.turn, p.at_i)};
    }
}

/* How near a ball of radius r at `centre` (from x_i) may come to a convex element that is seen from
 * x_i: a plane through its nearest point parts it from x_i. */
static bool near_enough(const struct facing *seen, vec3 centre, double reach)
{
    if (seen->curvature < 0.0)
        return seen->distance - v3_norm(centre) < reach;
    return seen->distance + v3_dot(seen->away, centre) / seen->distance < reach;
}

static void meet_balls(const struct sim *s, struct meetings *all, const struct around *a,
                       const struct facing *seen, struct facing *f)
{
    const vec3 x = s->grains.pos[a->i];
    int balls = 0;
    const struct shape_ball *const ball = shape.balls(a->pose.species, &balls);
    for (int q = 0; q < balls; q++) {
        const vec3 c = mat3_turn(&a->pose.turn, v3_scale(a->pose.size, ball[q].centre));
        const double r = a->pose.size * ball[q].radius;
        int n = 0;
        for (int k = 0; k < a->n; k++)
            if (near_enough(&seen[k], c, r + s->neighbours.reach))
                f[n++] = facing_look(s, seen[k].slot, s->neighbours.walls.other[seen[k].slot],
                                     v3_add(x, c));
        meet(s, all, a, f, n, r, a->pose.size * ball[q].curve, c, q);
    }
}

/* A normal that is tried, the inset ball for it, and how far the element would have the normal turn. */
struct trial {
    vec3 n, centre, turn;
};

static struct trial try_normal(const struct sim *s, const struct around *a,
                               const struct facing *seen, double inset, vec3 n, double *radius,
                               struct facing *f)
{
    struct trial t = {.n = v3_scale(1.0 / v3_norm(n), n)};
    t.centre = v3_axpy(shape.support(&a->pose, v3_scale(-1.0, t.n), radius), inset, t.n);
    *f = facing_look(s, seen->slot, s->neighbours.walls.other[seen->slot],
                     v3_add(s->grains.pos[a->i], t.centre));
    t.turn = v3_sub(v3_scale(1.0 / f->distance, f->away), t.n);
    return t;
}

/* The inset ball of a convex body that lies deepest in an element: its centre from x_i. The normal
 * follows the element's; over an edge the point runs ahead of it by the ratio of their radii, and by
 * any factor where the body is flat: there two normals that turn towards each other close in on the
 * one between, by false position and every third time by halves (the point of a convex body goes the
 * way of its outer normal, always: there is one). */
static vec3 deepest(const struct sim *s, const struct around *a, const struct facing *seen,
                    double inset, double *radius, struct facing *f)
{
    enum { MOST = 100 };
    const double enough = 1e-26;
    struct trial at = try_normal(s, a, seen, inset, seen->away, radius, f), other = at;
    bool between = false;
    for (int k = 0; k < MOST && v3_dot(at.turn, at.turn) > enough; k++) {
        const vec3 way = v3_sub(other.n, at.n);
        const double mine = v3_dot(at.turn, way), its = v3_dot(other.turn, way);
        struct trial next;
        between = between && its < 0.0 &&
                  mine > 0.3 * v3_norm(way) * v3_norm(at.turn); /* or across the two */
        if (between) {
            const double part = fmin(fmax(mine / (mine - its), 0.05), 0.95);
            next = try_normal(s, a, seen, inset, v3_axpy(at.n, k % 3 == 2 ? 0.5 : part, way),
                              radius, f);
            other = v3_dot(next.turn, way) > 0.0 ? other : at;
        } else {
            const double part = f->part == WALL_FACE
                                    ? 1.0
                                    : 1.0 / (1.0 + fmax(0.0, *radius - inset) / f->distance);
            next = try_normal(s, a, seen, inset, v3_axpy(at.n, part, at.turn), radius, f);
            between = v3_dot(next.turn, at.turn) < 0.0;
            other = at;
        }
        at = next;
    }
    return at.centre;
}

static void meet_convex(const struct sim *s, struct meetings *all, const struct around *a,
                        const struct facing *seen, struct facing *f)
{
    const double inset = INSET * a->pose.size;
    double *const radius = all->radius;
    for (int k = 0; k < a->n; k++)
        deepest(s, a, &seen[k], inset, &radius[k], &f[k]);
    const int before = all->n;
    for (int k = 0; k < a->n; k++) {
        struct facing own = f[k];
        if (!(own.distance < inset + s->neighbours.reach) ||
            facing_hidden(s, f, a->n, k, SAME * a->pose.size))
            continue;
        const vec3 c = v3_sub(own.centre, s->grains.pos[a->i]);
        meet(s, all, a, &own, 1, inset, 0.0, c, 0);
        struct shape_point *const p = &all->m[all->n - 1].p;
        p->r_i = radius[k];
        p->scale = a->pose.size;
    }
    for (int k = before; k < all->n; k++)
        all->m[k].p.id = 0;
}

/* A flat element as the grain sees it; false: it is not one. */
static bool facet_of(const struct sim *s, const struct around *a, const struct facing *seen,
                     struct shape_facet *out)
{
    const int element = s->neighbours.walls.other[seen->slot];
    out->n = wall_corners(s, element, s->grains.pos[a->i], out->corner);
    if (out->n == 0) {
        out->corner[0] = v3_scale(-1.0, seen->away);
        out->normal = v3_scale(1.0 / seen->distance, seen->away);
        return seen->curvature == 0.0 && seen->part == WALL_FACE;
    }
    const vec3 n = v3_cross(v3_sub(out->corner[1], out->corner[0]),
                            v3_sub(out->corner[2], out->corner[0]));
    const double side = v3_dot(n, out->corner[0]) > 0.0 ? -1.0 : 1.0;
    out->normal = v3_scale(side / v3_norm(n), n);
    return true;
}

/* The flat elements; those that are none, or are met beside the end of a curved edge, are left in
 * `seen`; returns how many. */
static int meet_flat(const struct sim *s, struct meetings *all, const struct around *a,
                     struct facing *seen, struct facing *f)
{
    const vec3 x = s->grains.pos[a->i];
    const double reach = s->neighbours.reach;
    const int parts = shape.convex_parts(a->pose.species);
    struct flat_meeting *const met = all->met;
    bool *const flat = all->flat;
    int left = 0;
    for (int k = 0; k < a->n; k++)
        flat[k] = true;
    for (int part = 0; part < parts; part++) {
        int n = 0;
        for (int k = 0; k < a->n; k++) {
            struct shape_facet facet;
            vec3 core;
            flat[k] = flat[k] && facet_of(s, a, &seen[k], &facet);
            if (!flat[k])
                continue;
            met[n].points = shape.meet_flat(&a->pose, part, &facet, reach, &core, met[n].p);
            if (met[n].points == 0)
                continue;
            f[n] = facing_look(s, seen[k].slot, s->neighbours.walls.other[seen[k].slot],
                               v3_add(x, core));
            n++;
        }
        for (int k = 0; k < n; k++) {
            if (facing_hidden(s, f, n, k, SAME * a->pose.size))
                continue;
            for (int m = 0; m < met[k].points; m++) {
                if (all->n == all->room)
                    grow(all);
                all->m[all->n++] =
                    (struct meeting){.f = f[k],
                                     .p = met[k].p[m],
                                     .place = mat3_back(&a->pose.turn, met[k].p[m].at_i)};
            }
        }
    }
    for (int k = 0; k < a->n; k++)
        if (!flat[k])
            seen[left++] = seen[k];
    return left;
}

static void enter(struct sim *s, struct block *b, int i, struct meeting *m)
{
    const struct wall *const w = &s->walls.wall[m->f.wall];
    const struct body *const body = &s->bodies[i];
    const struct point_of o = {.slot = m->f.slot,
                               .i = i,
                               .j = i,
                               .record = m->record,
                               .was = record_overlapped(m->record),
                               .p = &m->p};
    /* pivot to x_i, to the contact */
    const vec3 arm = v3_sub(m->f.arm, v3_sub(m->f.centre, s->grains.pos[i]));
    const vec3 lever = v3_add(arm, m->p.at_i);
    const vec3 own = v3_cross(s->grains.full_spin[i], m->p.from_i);
    vec3 half = w->motion.surface, full = half, spin = v3(0.0, 0.0, 0.0);
    const int c = points_enter(s, b, &o);
    if (w->motion.moves && !s->walls.still) {
        const struct wall_pose *const p = &w->pose;
        half = v3_add(half, v3_add(p->half, v3_cross(p->half_spin, lever)));
        full = v3_add(full, v3_add(p->velocity, v3_cross(p->spin, lever)));
        spin = p->half_spin;
        if (!m->new)
            facing_turn(s, &m->f, w, m->record + RECORD_HEAD);
    }
    m->record[0] = (real)(2 * (m->p.id + 1) + (m->p.depth > 0.0));
    m->record[1] = (real)m->place.x;
    m->record[2] = (real)m->place.y;
    m->record[3] = (real)m->place.z;
    b->c.wall[c] = w;
    b->wall[c] = m->f.wall;
    b->arm[c] = arm;
    b->curve[c] = m->f.curvature == 0.0
                      ? 0.0
                      : (real)(1.0 / facing_matched(m->p.r_i, m->f.curvature) - 1.0 / m->p.r_i);
    b->inv_m[c] = body->vel[3];
    b->t.vx[c] = body->vel[0] - (real)half.x;
    b->t.vy[c] = body->vel[1] - (real)half.y;
    b->t.vz[c] = body->vel[2] - (real)half.z;
    b->vx[c] = body->full[0] - (real)(full.x - own.x);
    b->vy[c] = body->full[1] - (real)(full.y - own.y);
    b->vz[c] = body->full[2] - (real)(full.z - own.z);
    b->qx[c] = (real)spin.x;
    b->qy[c] = (real)spin.y;
    b->qz[c] = (real)spin.z;
    b->t.pair[c] = (int)body->full[3] * s->grains.n_materials + w->material;
}

/* The wall contacts of one grain. */
static void work_grain(struct sim *s, struct block *b, const struct cut *cut, struct around *a,
                       struct meetings *all, const struct target *to)
{
    struct slots *const l = &s->neighbours.walls;
    if (a->n > all->facings)
        grow_facings(all, 2 * a->n);
    struct facing *const seen = all->seen;
    int near = 0, live = 0;
    const vec3 x = s->grains.pos[a->i];
    const double reach = s->grains.radius[a->i] + s->neighbours.reach;
    struct around close = *a;
    all->n = 0;
    for (int k = 0; k < a->n; k++) {
        seen[near] = facing_look(s, a->slot[k], l->other[a->slot[k]], x);
        near += seen[near].distance < reach;
        live += l->live[a->slot[k]] > 0;
        if (to->asked)
            points_forget_seen(s, true, a->slot[k]);
    }
    close.n = near;
    if (near > 0) {
        close.pose = a->pose = points_pose(s, a->i);
        if (shape.meet_flat)
            close.n = meet_flat(s, all, &close, seen, seen + near);
        if (shape.balls)
            meet_balls(s, all, &close, seen, seen + near);
        else
            meet_convex(s, all, &close, seen, seen + near);
    }
    if (all->n == 0 && live == 0)
        return;
    meetings_remember(s, cut, all, a, to->report);
    for (int k = 0; k < a->n; k++)
        l->live[a->slot[k]] = 0;
    for (int k = 0; k < all->n; k++) {
        struct meeting *const m = &all->m[k];
        const unsigned char now = m->p.depth > 0.0 ? LIVE_OVERLAP : LIVE_REACH;
        if (!m->record)
            continue;
        l->live[m->f.slot] = now > l->live[m->f.slot] ? now : l->live[m->f.slot];
        enter(s, b, a->i, m);
        if (b->n == TOUCH)
            points_work(s, b, to);
    }
}

void points_walls(struct sim *s, int run, struct block *b, const struct target *to)
{
    const struct slots *const l = &s->neighbours.walls;
    const int *const active = &l->active[l->begin[to->first]];
    const struct cut cut = points_cut(s);
    struct meetings all = {0};
    b->n = 0;
    b->rocks = false;
    b->walls = true;
    for (int k = 0; k < l->n_active[run];) {
        struct around a = {.i = l->owner[active[k]], .slot = &active[k]};
        while (k < l->n_active[run] && l->owner[active[k]] == a.i)
            a.n++, k++;
        work_grain(s, b, &cut, &a, &all, to);
    }
    points_work(s, b, to);
    to->report->too_deep = to->report->too_deep || to->report->points > 0;
    void *const buffers[] = {all.m, all.seen, all.radius, all.met, all.flat, all.taken};
    for (size_t k = 0; k < sizeof buffers / sizeof buffers[0]; k++)
        xfree(buffers[k]);
}
