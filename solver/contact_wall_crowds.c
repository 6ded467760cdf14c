/* contact_wall_crowds.c - which of the elements of a wall that a ball is near count: on coplanar
 * triangles it feels one plane, at a convex edge one contact, at a concave one two (contact_facing.h).
 *
 * A ball whose foot lies on an element touches the plane of its patch there, and no other element of the
 * patch. Where the foot stays on it until the slots are chosen anew these others are left out, and mostly
 * nothing is then left to decide. Else nearly always one face counts and the rest is of its patch, or edges
 * from whose hollow side the ball comes (wall_kind.h); only where it is not so the general rule is
 * asked. When a contact goes over to another element, its lane goes along: to the one that is new,
 * from the one that ended whose normal is nearest. */
#include "contact_wall_crowds.h"

#include <string.h>
#include "contact_facing.h"
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_spheres.h"

#define SAME 1e-6 /* of the radius: points nearer than this coincide */
#define ROOM 1.01 /* on the way that a ball may move until slots are chosen anew */

enum { FEW = WALL_LOOKS, EIGHT = 8 };

/* An element of a crowd as its ball sees it. */
struct glimpse {
    vec3 away;       /* m */
    double distance; /* m */
    double near;     /* m, within which it is touched */
    int part, hollow, patch;
    bool counts, live;
};

/* The crowds at hand: entries of one wall from `from` on. */
struct crowds {
    const struct sim *s;
    struct wall_pack *pack;
    const struct ball_walls *balls;
    int from, n, room;
    struct glimpse few[FEW], *seen;
    bool hidden[FEW], *hides;
};

static struct glimpse *glimpse(const struct crowds *c, int entry)
{
    return &c->seen[entry - c->from];
}

/* Looks at n entries from `from` on, at most FEW. */
static void look(const struct crowds *all, int from, int n)
{
    const struct sim *const s = all->s;
    const struct crowd_entry *const e = &all->pack->entry[from];
    const struct wall *const w =
        &s->walls.wall[s->walls.wall_of[s->neighbours.walls.other[e->slot]]];
    struct wall_looks l;
    struct ball_places places;
    double arm[3][WALL_LOOKS];
    int i[WALL_LOOKS], ball[WALL_LOOKS];
    l.n = (n + EIGHT - 1) / EIGHT * EIGHT;
    for (int c = 0; c < l.n; c++) {
        const struct crowd_entry *const of = &e[c < n ? c : n - 1];
        i[c] = of->i;
        ball[c] = of->ball;
        l.element[c] = of->element;
    }
    spheres_places(s, i, &l);
    if (all->balls)
        all->balls->place(s, i, ball, l.n, &places);
    for (int c = 0; c < l.n && all->balls; c++) {
        l.x[c] += (double)places.off[0][c];
        l.y[c] += (double)places.off[1][c];
        l.z[c] += (double)places.off[2][c];
    }
    walls_look(s, w, &l, arm);
    for (int c = 0; c < n; c++) {
        struct glimpse *const g = glimpse(all, from + c);
        const double radius = (double)(all->balls ? places.radius[c] : s->bodies[i[c]].spin[3]);
        g->away.x = l.ax[c];
        g->away.y = l.ay[c];
        g->away.z = l.az[c];
        g->distance = sqrt(l.ax[c] * l.ax[c] + l.ay[c] * l.ay[c] + l.az[c] * l.az[c]);
        g->near = radius + s->neighbours.reach;
        g->part = l.part[c];
        g->hollow = l.hollow[c];
        g->patch = e[c].patch;
        g->counts = g->distance < g->near;
    }
}

/* The point of k is no contact, since the ball's foot lies on the face f. */
static bool is_beside(const struct glimpse *k, const struct glimpse *f)
{
    return ((k->patch >= 0) & (k->patch == f->patch) & (k->part != WALL_FACE)) |
           (k->hollow & (f->distance <= k->distance));
}

/* One face counts, it has the only lane, and the rest is beside it. */
static bool simple(const struct crowds *all, const struct wall_crowd *crowd)
{
    const struct crowd_entry *const e = all->pack->entry;
    const struct glimpse *f = NULL;
    int faces = 0, lanes = 0, others = 0, lane = -1;
    for (int k = crowd->from; k < crowd->to; k++) {
        const struct glimpse *const g = glimpse(all, k);
        const bool face = g->counts & (g->part == WALL_FACE);
        f = face ? g : f;
        lane = face ? e[k].lane : lane;
        faces += face;
        lanes += e[k].lane >= 0;
    }
    if (faces != 1 || lanes != 1 || lane < 0)
        return false;
    for (int k = crowd->from; k < crowd->to; k++) {
        const struct glimpse *const g = glimpse(all, k);
        others += (g != f) & g->counts & !is_beside(g, f);
    }
    if (others > 0)
        return false;
    wall_pack_lane(all->pack, crowd, lane)->counts[lane % TOUCH] = 1;
    return true;
}

static bool is_hidden(const struct crowds *all, const struct wall_crowd *crowd, int entry)
{
    const struct glimpse *const g = glimpse(all, entry);
    for (int k = crowd->from; k < crowd->to; k++) {
        const struct glimpse *const f = glimpse(all, k);
        if (f != g && f->counts && f->part == WALL_FACE && is_beside(g, f))
            return true;
    }
    return false;
}

static vec3 centre_of(const struct sim *s, const struct ball_walls *balls, int i, int ball)
{
    struct ball_places place;
    if (!balls)
        return s->grains.pos[i];
    balls->place(s, &i, &ball, 1, &place);
    return v3_add(s->grains.pos[i], v3((double)place.off[0][0], (double)place.off[1][0],
                                       (double)place.off[2][0]));
}

/* The general rule (contact_facing.h), of those that are left. */
static void hide(const struct crowds *all, const struct wall_crowd *crowd)
{
    const int n = crowd->to - crowd->from;
    const struct crowd_entry *const e = &all->pack->entry[crowd->from];
    struct facing some[FEW], *const f = n > FEW ? xalloc((size_t)n, sizeof *f) : some;
    int places[FEW], *const place = n > FEW ? xalloc((size_t)n, sizeof *place) : places;
    int facings = 0;
    const vec3 centre = centre_of(all->s, all->balls, e->i, e->ball);
    const double same = SAME * all->s->grains.radius[e->i];
    for (int k = 0; k < n; k++) {
        const struct glimpse *const g = glimpse(all, crowd->from + k);
        if (!g->counts)
            continue;
        place[facings] = k;
        f[facings++] = (struct facing){.slot = e[k].slot,
                                       .wall = all->pack->lanes[crowd->of].wall,
                                       .local = e[k].element,
                                       .centre = centre,
                                       .away = g->away,
                                       .distance = g->distance,
                                       .part = (enum wall_part)g->part};
    }
    for (int k = 0; k < facings; k++) {
        const int entry = crowd->from + place[k];
        if (!all->hides[entry - all->from])
            all->hides[entry - all->from] = facing_hidden(all->s, f, facings, k, same);
    }
    if (n > FEW) {
        xfree(f);
        xfree(place);
    }
}

/* Those that are hidden by others count no more. */
static void choose(const struct crowds *all, const struct wall_crowd *crowd)
{
    int left = 0;
    for (int k = crowd->from; k < crowd->to; k++) {
        bool *const hidden = &all->hides[k - all->from];
        *hidden = !glimpse(all, k)->counts || is_hidden(all, crowd, k);
        left += !*hidden;
    }
    if (left > 1)
        hide(all, crowd);
    for (int k = crowd->from; k < crowd->to; k++)
        glimpse(all, k)->counts = !all->hides[k - all->from];
}

/* A new contact takes the lane of one that has just ended, which gets its own. */
static void pass_lane(const struct crowds *all, const struct wall_crowd *crowd, int new)
{
    struct crowd_entry *const e = all->pack->entry;
    const struct glimpse *const g = glimpse(all, new);
    double nearest = 0.0;
    int from = -1;
    for (int k = crowd->from; k < crowd->to; k++) {
        const struct glimpse *const old = glimpse(all, k);
        if (old->counts || !old->live)
            continue;
        const double cosine = v3_dot(old->away, g->away) / (old->distance * g->distance);
        if (cosine > nearest) {
            nearest = cosine;
            from = k;
        }
    }
    if (from < 0)
        return;
    const int both[2] = {new, from}, lane[2] = {e[from].lane, e[new].lane};
    for (int k = 0; k < 2; k++) {
        struct crowd_entry *const of = &e[both[k]];
        of->lane = lane[k];
        if (lane[k] < 0)
            continue;
        struct wall_block *const b = wall_pack_lane(all->pack, crowd, lane[k]);
        b->slot[lane[k] % TOUCH] = of->slot;
        b->element[lane[k] % TOUCH] = of->element;
    }
    glimpse(all, from)->live = false; /* given away */
}

static void decide(const struct crowds *all, const struct wall_crowd *crowd)
{
    struct crowd_entry *const e = all->pack->entry;
    const real reach = (real)all->s->neighbours.reach;
    if (simple(all, crowd))
        return;
    for (int k = crowd->from; k < crowd->to; k++) {
        const int lane = e[k].lane;
        glimpse(all, k)->live =
            lane >= 0 && wall_pack_lane(all->pack, crowd, lane)->depth[lane % TOUCH] > -reach;
    }
    choose(all, crowd);
    for (int k = crowd->from; k < crowd->to; k++) {
        if (!glimpse(all, k)->counts)
            continue;
        if (!glimpse(all, k)->live)
            pass_lane(all, crowd, k);
        if (e[k].lane < 0)
            wall_pack_begin(all->pack, &e[k], crowd);
        wall_pack_lane(all->pack, crowd, e[k].lane)->counts[e[k].lane % TOUCH] = 1;
    }
}

/* Whether the foot of a ball lies on this face until the slots are chosen anew. */
static bool stays(const struct sim *s, const struct wall_entry *e, vec3 centre)
{
    const struct neighbours *const nb = &s->neighbours;
    const double way = neighbours_inner_wall(nb, nb->walls.owner[e->slot]) - nb->reach;
    struct wall_flat plane;
    double within;
    return wall_flat_at(s, nb->walls.other[e->slot], centre, &plane, &within) &&
           within > ROOM * way;
}

/* Another element of a patch of which a face is sure. */
static bool is_left_out(const struct sim *s, const struct wall_entry *e, int n, int k)
{
    const struct slots *const l = &s->neighbours.walls;
    const int patch = wall_patch(s, l->other[e[k].slot]);
    if (e[k].kind == ON_FACE || patch < 0 || l->live[e[k].slot])
        return false;
    for (int m = 0; m < n; m++)
        if (e[m].kind == ON_FACE && wall_patch(s, l->other[e[m].slot]) == patch)
            return true;
    return false;
}

/* Of one ball's n entries those that are left: the faces that it stays on, where all others are of their
 * patches; else all, since what does not count may yet hide another. */
static int thin(const struct sim *s, struct wall_entry *e, int n, vec3 centre)
{
    int left = 0, sure = 0;
    for (int k = 0; k < n; k++) {
        e[k].kind = stays(s, &e[k], centre) ? ON_FACE : n == 1 ? ALONE : OF_CROWD;
        sure += e[k].kind == ON_FACE;
    }
    if (sure == n || n == 1)
        return n;
    for (int k = 0; k < n; k++)
        left += !is_left_out(s, e, n, k);
    if (left == sure) {
        for (int k = 0, to = 0; k < n; k++)
            if (e[k].kind == ON_FACE)
                e[to++] = e[k];
        return left;
    }
    for (int k = 0; k < n; k++)
        e[k].kind = OF_CROWD;
    return n;
}

int wall_crowds_thin(const struct sim *s, struct wall_entry *e, int n,
                     const struct ball_walls *balls)
{
    const int *const owner = s->neighbours.walls.owner;
    int left = 0;
    for (int k = 0, to; k < n; k = to) {
        to = wall_entries_end(s, e, k, n);
        struct wall_entry *const of = &e[left];
        const vec3 centre = centre_of(s, balls, owner[e[k].slot], e[k].ball);
        memmove(of, &e[k], (size_t)(to - k) * sizeof *e);
        left += thin(s, of, to - k, centre);
    }
    return left;
}

static void reserve(struct crowds *all, int n)
{
    if (n <= all->room)
        return;
    if (all->seen != all->few) {
        xfree(all->seen);
        xfree(all->hides);
    }
    all->room = n;
    all->seen = xalloc((size_t)n, sizeof *all->seen);
    all->hides = xalloc((size_t)n, sizeof *all->hides);
}

void wall_crowds_decide(const struct sim *s, struct wall_pack *p,
                        const struct ball_walls *balls)
{
    struct crowds all = {.s = s, .pack = p, .balls = balls, .room = FEW};
    all.seen = all.few;
    all.hides = all.hidden;
    for (int k = 0; k < p->n_blocks; k++) {
        struct wall_block *const b = wall_pack_block(p, k, laws_rows());
        for (int c = 0; c < b->n && b->kind == OF_CROWD; c++)
            b->counts[c] = 0;
    }
    for (int k = 0, to; k < p->n_crowds; k = to) {
        const struct wall_crowd *const first = &p->crowd[k];
        for (to = k + 1; to < p->n_crowds && p->crowd[to].of == first->of &&
                         p->crowd[to].to - first->from <= FEW;)
            to++;
        all.from = first->from;
        all.n = p->crowd[to - 1].to - first->from;
        reserve(&all, all.n);
        for (int at = 0; at < all.n; at += FEW)
            look(&all, all.from + at, all.n - at < FEW ? all.n - at : FEW);
        for (int m = k; m < to; m++)
            decide(&all, &p->crowd[m]);
    }
    if (all.seen != all.few) {
        xfree(all.seen);
        xfree(all.hides);
    }
}
