/* body.c - the grains as the contact loop reads them. */
#include "body.h"

#include "sim.h"

void frame_of(struct frame *f, const struct domain *d)
{
    *f = (struct frame){0};
    for (int a = 0; a < 3; a++) {
#ifdef SILT_FLOAT
        const double span = d->periodic[a] ? d->size[a] : 2.0 * d->size[a];
        f->origin[a] = d->periodic[a] ? 0.0 : 0.5 * d->size[a];
        f->per_metre[a] = 0x1p32 / span;
        f->scale[a] = (real)(span * 0x1p-32);
#else
        f->scale[a] = 1.0;
        f->image[a] = d->image[a];
        f->inv_image[a] = d->inv_image[a];
#endif
    }
}

static void fill(const struct sim *s, struct body *b, int i)
{
    const struct grains *const g = &s->grains;
    const vec3 x = g->pos[i], v = g->vel[i], w = g->spin[i];
    const struct motion_state m = {
        .pos = {x.x, x.y, x.z, 0.0},
        .vel_spin = {v.x, v.y, v.z, g->inv_mass[i], w.x, w.y, w.z, g->radius[i]}};
    body_write(b, &s->frame, &m, (double4){v.x, v.y, v.z, (double)grain_material(g, i)});
}

void bodies_fill(struct sim *s)
{
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++)
        fill(s, &s->bodies[i], i);
}

void bodies_sort(struct sim *s, const int *order, int listed)
{
    struct body *const sorted = xalloc((size_t)s->grains.capacity + 1, sizeof *sorted);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++) {
        if (order[i] >= listed && s->grains.inv_mass[i] == 0.0) {
            fill(s, &sorted[i], i);
        } else {
            sorted[i] = s->bodies[order[i]];
            const vec3 x = s->grains.pos[i];
            sorted[i].place = frame_place(&s->frame, (double4){x.x, x.y, x.z, 0.0});
        }
    }
    xfree(s->bodies);
    s->bodies = sorted;
}
