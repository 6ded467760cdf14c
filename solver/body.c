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
        f->per_step[a] = span * 0x1p-32;
        f->scale[a] = (real)f->per_step[a];
#else
        f->scale[a] = 1.0;
        f->image[a] = d->image[a];
        f->inv_image[a] = d->inv_image[a];
#endif
    }
}

void bodies_fill(struct sim *s)
{
    const struct grains *const g = &s->grains;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        const vec3 v = g->vel[i], w = g->spin[i];
        s->bodies[i] =
            (struct body){.place = frame_place(&s->frame, g->pos[i]),
                          .vel = {(real)v.x, (real)v.y, (real)v.z, (real)g->inv_mass[i]},
                          .full = {(real)v.x, (real)v.y, (real)v.z, (real)grain_material(g, i)},
                          .spin = {(real)w.x, (real)w.y, (real)w.z, (real)g->radius[i]}};
    }
}

void bodies_sort(struct sim *s, const int *order)
{
    struct body *const sorted = xalloc((size_t)s->grains.capacity, sizeof *sorted);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < s->grains.n; i++) {
        sorted[i] = s->bodies[order[i]];
        sorted[i].place = frame_place(&s->frame, s->grains.pos[i]);
    }
    xfree(s->bodies);
    s->bodies = sorted;
}
