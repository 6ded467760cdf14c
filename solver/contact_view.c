/* contact_view.c - the contacts of the last step, one after the other. Geometry comes from the
 * shape once more; forces are those that the motion used. */
#include "contact_view.h"

#include "analysis.h"
#include "contact_loop.h"
#include "contact_path.h"
#include "sim.h"

static vec3 of4(double4 a)
{
    return v3(a[0], a[1], a[2]);
}

static void candidate(const struct sim *s, const struct slots *l, bool walls, int slot,
                      struct candidates *c, struct touch *t)
{
    const struct grains *const g = &s->grains;
    const int k = c->n++, i = l->owner[slot], other = l->other[slot];
    vec3 d;
    c->i[k] = i;
    if (walls) {
        c->j[k] = i;
        c->wall[k] = &s->walls.wall[s->walls.wall_of[other]];
        d = wall_see(s, other, g->pos[i]).view.away;
    } else {
        c->j[k] = other;
        c->wall[k] = NULL;
        d = domain_minimum_image(&s->domain, v3_sub(g->pos[i], g->pos[other]));
    }
    c->dx[k] = (real)d.x;
    c->dy[k] = (real)d.y;
    c->dz[k] = (real)d.z;
    t->r_i[k] = (real)g->radius[i];
    t->r_j[k] = walls ? 0 : (real)g->radius[other];
    t->r_eff[k] = walls ? t->r_i[k] : t->r_i[k] * t->r_j[k] / (t->r_i[k] + t->r_j[k]);
}

static void pad(struct candidates *c, struct touch *t)
{
    for (const int last = c->n - 1; c->n % TOUCH_LANES != 0; c->n++) {
        c->i[c->n] = c->i[last];
        c->j[c->n] = c->j[last];
        c->wall[c->n] = c->wall[last];
        c->dx[c->n] = c->dx[last];
        c->dy[c->n] = c->dy[last];
        c->dz[c->n] = c->dz[last];
        t->r_i[c->n] = t->r_i[last];
        t->r_j[c->n] = t->r_j[last];
        t->r_eff[c->n] = t->r_eff[last];
    }
}

/* Looks at up to TOUCH slots; writes them from out on. */
static void look(const struct sim *s, const struct slots *l, bool walls, const int *slot, int n,
                 struct seen *out)
{
    struct candidates c = {0};
    struct touch t;
    struct levers arm;
    for (int k = 0; k < n; k++)
        candidate(s, l, walls, slot[k], &c, &t);
    pad(&c, &t);
    t.n = c.n;
    shape.overlaps(&s->grains, &c, &t, &arm);
    for (int k = 0; k < n; k++) {
        struct seen *const v = &out[k];
        const vec3 lever = v3((double)arm.ix[k], (double)arm.iy[k], (double)arm.iz[k]);
        v->i = c.i[k];
        v->j = walls ? -1 : c.j[k];
        v->wall = walls ? s->walls.wall_of[l->other[slot[k]]] : -1;
        v->normal = v3((double)t.nx[k], (double)t.ny[k], (double)t.nz[k]);
        v->depth = (double)t.depth[k];
        v->point = v3_add(s->grains.pos[v->i], lever);
        v->branch = walls ? v3_scale(-1.0, lever)
                          : v3((double)c.dx[k], (double)c.dy[k], (double)c.dz[k]);
        v->force = of4(((const double4 *)s->contacts->seen[walls])[slot[k]]);
        v->normal_force = v3_dot(v->force, v->normal);
    }
}

/* The live slots of one run of grains, from out on; with out NULL only how many. */
static size_t look_run(const struct sim *s, const struct slots *l, bool walls, int run,
                       struct seen *out)
{
    const int first = run * s->neighbours.run;
    const int last =
        first + s->neighbours.run < s->grains.n ? first + s->neighbours.run : s->grains.n;
    int slot[TOUCH], n = 0;
    size_t total = 0;
    for (int k = l->begin[first]; k < l->begin[last]; k++) {
        if (!l->live[k])
            continue;
        total++;
        if (!out)
            continue;
        slot[n++] = k;
        if (n == TOUCH) {
            look(s, l, walls, slot, n, out);
            out += n;
            n = 0;
        }
    }
    if (n > 0)
        look(s, l, walls, slot, n, out);
    return total;
}

void contact_view_reserve(struct contact_view *v, size_t n)
{
    v->n = n;
    if (n > v->capacity) {
        xfree(v->seen);
        v->capacity = n + n / 4;
        v->seen = xalloc(v->capacity, sizeof *v->seen);
    }
}

void contact_view_slots(const struct sim *s, struct contact_view *v)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const list[2] = {&nb->pairs, &nb->walls};
    size_t *const first = xalloc(2 * (size_t)nb->runs + 1, sizeof *first);
    v->n = 0;
    if (nb->builds == 0) {
        xfree(first);
        return;
    }
#pragma omp parallel for schedule(static)
    for (int r = 0; r < 2 * nb->runs; r++)
        first[r + 1] = look_run(s, list[r / nb->runs], r >= nb->runs, r % nb->runs, NULL);
    for (int r = 0; r < 2 * nb->runs; r++)
        first[r + 1] += first[r];
    contact_view_reserve(v, first[2 * nb->runs]);
#pragma omp parallel for schedule(static)
    for (int r = 0; r < 2 * nb->runs; r++)
        if (first[r + 1] > first[r])
            look_run(s, list[r / nb->runs], r >= nb->runs, r % nb->runs, v->seen + first[r]);
    xfree(first);
}

void contact_view_wanted(struct sim *s)
{
    s->contacts->watched = true;
}

const struct contact_view *contact_view(struct sim *s)
{
    struct contact_view *const v = &s->analysis.view;
    if (v->taken != s->substep + 1) {
        shape.path->view(s, v);
        v->taken = s->substep + 1;
    }
    return v;
}
