/* body.c - the grains as the contact loop reads them. */
#include "body.h"

#include "sim.h"

void frame_of(struct frame *f, const struct domain *d)
{
    *f = (struct frame){0};
    for (int a = 0; a < 3; a++) {
#ifdef SILT_FLOAT
        const double span = d->periodic[a] ? d->size[a] : 2.0 * d->size[a];
        f->origin[a] = 0.5 * d->size[a];
        f->per_metre[a] = 0x1p32 / span;
        f->fine[a] = 0x1p64 / span;
        f->metre[a] = span * 0x1p-64;
        f->scale[a] = (real)(span * 0x1p-32);
#else
        f->scale[a] = 1.0;
        f->image[a] = d->image[a];
        f->inv_image[a] = d->inv_image[a];
#endif
    }
}

static void write(const struct grains *g, struct body *b, struct body_rest *r, int i,
                  const struct motion_state *m)
{
    b->full[3] = (real)grain_material(g, i);
    b->spin[3] = (real)g->radius[i];
    body_write(b, r, m, m->vel);
}

void bodies_write(struct sim *s, int i, const struct motion_state *m)
{
    write(&s->grains, &s->bodies[i], &s->rests[i], i, m);
}

struct motion_state bodies_state(const struct sim *s, int i)
{
    const struct grains *const g = &s->grains;
    const vec3 x = g->pos[i], v = g->vel[i], w = g->spin[i];
    struct motion_state m = {
        .place = frame_place(&s->frame, (double4){x.x, x.y, x.z, g->inv_inertia[i]}),
        .vel = {v.x, v.y, v.z, g->inv_mass[i]},
        .spin = {w.x, w.y, w.z, BODY_IS_FLOAT ? g->inv_inertia[i] : g->radius[i]}};
    if (BODY_IS_FLOAT) { /* which is finer: the one at hand, if it is that */
        const struct motion_state own = body_state(&s->bodies[i], &s->rests[i]);
        const vec3 same = motion_pos(&s->frame, &own);
        if (same.x == x.x && same.y == x.y && same.z == x.z)
            m.place = own.place;
    }
    return m;
}

void bodies_fill(struct sim *s)
{
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++) {
        const struct motion_state m = bodies_state(s, i);
        bodies_write(s, i, &m);
    }
}

void bodies_sort(struct sim *s, const int *order, int listed)
{
    const size_t room = (size_t)s->grains.capacity + 1;
    struct body *const sorted = xalloc(room, sizeof *sorted);
    struct body_rest *const rests = xalloc(room, sizeof *rests);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++) {
        if (order[i] >= listed && s->grains.inv_mass[i] == 0.0) {
            const struct motion_state m = bodies_state(s, i);
            write(&s->grains, &sorted[i], &rests[i], i, &m);
            continue;
        }
        sorted[i] = s->bodies[order[i]];
        rests[i] = s->rests[order[i]];
        if (!BODY_IS_FLOAT) { /* a place in float is wrapped by itself */
            const vec3 x = s->grains.pos[i];
            sorted[i].place[0] = (coordinate)x.x;
            sorted[i].place[1] = (coordinate)x.y;
            sorted[i].place[2] = (coordinate)x.z;
        }
    }
    xfree(s->bodies);
    xfree(s->rests);
    s->bodies = sorted;
    s->rests = rests;
}
