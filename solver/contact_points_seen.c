/* contact_points_seen.c - the single contacts of slots with any number of them, for those who look at
 * them (contact_view.h). */
#include "contact_points.h"

/* Room in a slot for the contacts that someone looks at. */
struct kept {
    int n;
    struct seen seen[];
};

size_t points_seen_size(const struct sim *s)
{
    return sizeof(struct kept) + (size_t)points_cut(s).most * sizeof(struct seen);
}

static struct kept *kept_of(const struct sim *s, bool walls, int slot)
{
    return (struct kept *)((char *)s->contacts->seen[walls] +
                           (size_t)slot * points_seen_size(s));
}

void points_forget_seen(const struct sim *s, bool walls, int slot)
{
    if (s->contacts->watched)
        kept_of(s, walls, slot)->n = 0;
}

void points_note_seen(const struct sim *s, const struct block *b, int c, struct report *r)
{
    const struct touch *const t = &b->t;
    const struct levers *const l = &b->l;
    struct kept *const kept = kept_of(s, b->walls, b->slot[c]);
    const double4 f = laws_force(b, c);
    const int i = b->c.i[c];
    if (kept->n == points_cut(s).most) {
        r->points = kept->n + 1;
        return;
    }
    struct seen *const v = &kept->seen[kept->n++];
    const vec3 arm_i = v3((double)l->ix[c], (double)l->iy[c], (double)l->iz[c]);
    const vec3 arm_j = v3((double)l->jx[c], (double)l->jy[c], (double)l->jz[c]);
    v->i = i;
    v->j = b->walls ? -1 : b->c.j[c];
    v->wall = b->walls ? b->wall[c] : -1;
    v->point = v3_add(s->grains.pos[i], arm_i);
    v->branch = b->walls ? v3_scale(-1.0, arm_i) : v3_sub(arm_j, arm_i);
    v->normal = v3((double)t->nx[c], (double)t->ny[c], (double)t->nz[c]);
    v->force = v3(f[0], f[1], f[2]);
    v->normal_force = v3_dot(v->force, v->normal);
    v->depth = (double)t->depth[c];
}

static size_t view_list(const struct sim *s, bool walls, struct seen *out)
{
    const struct slots *const l = walls ? &s->neighbours.walls : &s->neighbours.pairs;
    size_t n = 0;
    for (size_t slot = 0; slot < l->n; slot++) {
        if (!l->live[slot])
            continue;
        const struct kept *const kept = kept_of(s, walls, (int)slot);
        for (int k = 0; k < kept->n && out; k++)
            out[n + (size_t)k] = kept->seen[k];
        n += (size_t)kept->n;
    }
    return n;
}

void points_view(const struct sim *s, struct contact_view *v)
{
    v->n = 0;
    if (s->neighbours.builds == 0)
        return;
    const size_t pairs = view_list(s, false, NULL);
    contact_view_reserve(v, pairs + view_list(s, true, NULL));
    view_list(s, false, v->seen);
    view_list(s, true, v->seen + pairs);
}
