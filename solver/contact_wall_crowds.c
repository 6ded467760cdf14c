/* contact_wall_crowds.c - which of the elements of a wall that a ball is near count: on coplanar
 * triangles it feels one plane, at a convex edge one contact, at a concave one two (contact_facing.h).
 *
 * Where the kind of wall knows that an edge or vertex goes on flat, or that the ball is on its hollow
 * side, a neighbour is nearer than that point, and where a face in reach tells the same nothing more is
 * asked. When a contact goes over to another element, its lane goes along: to the one that is new, from
 * the one that ended whose normal is nearest. */
#include "contact_wall_crowds.h"

#include "contact_facing.h"
#include "contact_laws.h"
#include "contact_loop.h"
#include "contact_spheres.h"

#define SAME 1e-6 /* of the radius: points nearer than this coincide */
#define FLAT 1e-9 /* relative: of squares of distances from one plane */

enum { FEW = 32 };

/* One of a crowd. */
struct member {
    struct crowd_block *block;
    int c, entry;
    bool counts, live;
};

static struct member member_of(const struct sim *s, const struct wall_pack *p, int entry,
                               const struct wall_lanes *lanes)
{
    struct crowd_block *const b = &p->entry[entry / TOUCH];
    const int c = entry % TOUCH, lane = b->lane[c];
    struct member m = {.block = b, .c = c, .entry = entry, .counts = b->counts[c]};
    if (lane >= 0) {
        const struct wall_block *const of =
            wall_pack_block(p, lanes->block + lane / TOUCH, laws_rows());
        m.live = of->depth[lane % TOUCH] > -(real)s->neighbours.reach;
    }
    return m;
}

static double along(const struct member *a, const struct member *b)
{
    const struct wall_looks *const l = &a->block->look, *const m = &b->block->look;
    return l->ax[a->c] * m->ax[b->c] + l->ay[a->c] * m->ay[b->c] + l->az[a->c] * m->az[b->c];
}

/* The point of k is no contact: its element goes on there, and the face f is as near. */
static bool goes_on(const struct member *k, const struct member *f)
{
    const double near = f->block->distance[f->c], far = k->block->distance[k->c];
    if (f->block->look.part[f->c] != WALL_FACE || !f->counts || near > far)
        return false;
    if (k->block->look.seam[k->c] == SEAM_HOLLOW)
        return true;
    return fabs(along(k, f) - near * near) <=
           FLAT * near * near; /* it lies in the plane of f */
}

static bool is_seam(const struct member *of, int n, int k)
{
    if (of[k].block->look.seam[of[k].c] == SEAM_NONE)
        return false;
    for (int m = 0; m < n; m++)
        if (m != k && goes_on(&of[k], &of[m]))
            return true;
    return false;
}

static struct facing facing_of(const struct sim *s, const struct member *m)
{
    const struct crowd_block *const b = m->block;
    const int c = m->c;
    struct facing f = {.slot = b->slot[c], .wall = b->wall, .local = b->look.element[c]};
    f.centre = v3_add(s->grains.pos[b->i[c]],
                      v3((double)b->places.off[0][c], (double)b->places.off[1][c],
                         (double)b->places.off[2][c]));
    f.away = v3(b->look.ax[c], b->look.ay[c], b->look.az[c]);
    f.distance = b->distance[c];
    f.part = (enum wall_part)b->look.part[c];
    return f;
}

/* The general rule, of those that still count. */
static void hide(const struct sim *s, struct member *of, const bool *left, int n)
{
    struct facing few[FEW], *const f = n > FEW ? xalloc((size_t)n, sizeof *f) : few;
    int facings = 0, at[FEW], *const place = n > FEW ? xalloc((size_t)n, sizeof *at) : at;
    for (int k = 0; k < n; k++)
        if (of[k].counts) {
            place[facings] = k;
            f[facings++] = facing_of(s, &of[k]);
        }
    for (int k = 0; k < facings; k++) {
        struct member *const m = &of[place[k]];
        const double same = SAME * s->grains.radius[m->block->i[m->c]];
        m->block->counts[m->c] = left[place[k]] && !facing_hidden(s, f, facings, k, same);
    }
    if (f != few)
        xfree(f);
    if (place != at)
        xfree(place);
}

/* Lanes of a and b change places. */
static void swap(const struct wall_pack *p, const struct wall_lanes *lanes,
                 const struct member *a, const struct member *b)
{
    const struct member *const both[2] = {a, b};
    const int lane = a->block->lane[a->c];
    a->block->lane[a->c] = b->block->lane[b->c];
    b->block->lane[b->c] = lane;
    for (int k = 0; k < 2; k++) {
        const struct crowd_block *const e = both[k]->block;
        const int c = both[k]->c, at = e->lane[c];
        if (at < 0)
            continue;
        struct wall_block *const of =
            wall_pack_block(p, lanes->block + at / TOUCH, laws_rows());
        of->slot[at % TOUCH] = e->slot[c];
        of->of[at % TOUCH] = both[k]->entry;
    }
}

/* A new contact takes the lane of one that has just ended. */
static void pass_lane(const struct wall_pack *p, const struct wall_lanes *lanes,
                      struct member *of, int n, int k)
{
    double nearest = 0.0;
    int from = -1;
    for (int m = 0; m < n; m++) {
        if (of[m].counts || !of[m].live)
            continue;
        const double cosine = along(&of[m], &of[k]) /
                              (of[m].block->distance[of[m].c] * of[k].block->distance[of[k].c]);
        if (cosine > nearest) {
            nearest = cosine;
            from = m;
        }
    }
    if (from < 0)
        return;
    swap(p, lanes, &of[from], &of[k]);
    of[from].live = false; /* given away */
}

/* Of n members those that count. */
static void choose(const struct sim *s, struct member *of, int n, bool *left)
{
    int counting = 0;
    for (int k = 0; k < n; k++) {
        left[k] = of[k].counts && !is_seam(of, n, k);
        counting += left[k];
    }
    if (counting > 1)
        hide(s, of, left, n);
    else
        for (int k = 0; k < n; k++)
            of[k].block->counts[of[k].c] = left[k];
    for (int k = 0; k < n; k++)
        of[k].counts = of[k].block->counts[of[k].c];
}

static void decide(const struct sim *s, struct wall_pack *p, const struct wall_crowd *crowd)
{
    struct member few[FEW], *of = few;
    bool some[FEW], *left = some;
    const struct wall_lanes *const lanes = &p->lanes[crowd->of];
    int n = 0;
    if (crowd->to - crowd->from > FEW) {
        of = xalloc((size_t)(crowd->to - crowd->from), sizeof *of);
        left = xalloc((size_t)(crowd->to - crowd->from), sizeof *left);
    }
    for (int e = crowd->from; e < crowd->to; e++) {
        of[n] = member_of(s, p, e, lanes);
        n += of[n].counts || of[n].live;
    }
    if (n > 1)
        choose(s, of, n, left);
    for (int k = 0; k < n; k++) {
        if (!of[k].counts || of[k].live)
            continue;
        if (n > 1)
            pass_lane(p, lanes, of, n, k);
        if (of[k].block->lane[of[k].c] < 0)
            wall_pack_begin(p, of[k].block, of[k].c, of[k].entry, crowd->of);
    }
    if (of != few) {
        xfree(of);
        xfree(left);
    }
}

static void look(const struct sim *s, struct crowd_block *b, const struct ball_walls *balls)
{
    struct wall_looks *const l = &b->look;
    const double reach = s->neighbours.reach;
    double near[TOUCH];
    spheres_places(s, b->i, l);
    for (int c = 0; c < l->n; c++)
        near[c] = (double)s->bodies[b->i[c]].spin[3] + reach;
    if (balls) {
        balls->place(s, b->i, b->ball, l->n, &b->places);
        for (int c = 0; c < l->n; c++) {
            l->x[c] += (double)b->places.off[0][c];
            l->y[c] += (double)b->places.off[1][c];
            l->z[c] += (double)b->places.off[2][c];
            near[c] = (double)b->places.radius[c] + reach;
        }
    }
    walls_look(s, &s->walls.wall[b->wall], l, b->arm);
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->ax[c], y = l->ay[c], z = l->az[c];
        b->distance[c] = sqrt(x * x + y * y + z * z);
        b->counts[c] = b->distance[c] < near[c];
    }
}

void wall_crowds_decide(const struct sim *s, struct wall_pack *p,
                        const struct ball_walls *balls)
{
    for (int k = 0; k < p->crowd_blocks; k++)
        look(s, &p->entry[k], balls);
    for (int k = 0; k < p->n_crowds; k++)
        decide(s, p, &p->crowd[k]);
}
