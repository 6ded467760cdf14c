/* wall_draw.c - the walls of a scene as triangles: each kind draws itself at rest, its wall's pose
 * puts that where it is now (wall_motion.h). */
#include "wall_draw.h"

#include "sim.h"

struct pen {
    struct wall_canvas canvas;
    struct wall_drawing *to;
    const struct wall *wall;
    int index;
};

static vec3 placed_at(const struct wall *w, vec3 x)
{
    const struct wall_pose *const p = &w->pose;
    if (p->turned)
        x = v3_add(w->motion.pivot, pose_turn(p, v3_sub(x, w->motion.pivot)));
    return p->moved ? v3_add(x, p->shift) : x;
}

static void add_triangle(struct wall_canvas *c, vec3 a, vec3 b, vec3 p)
{
    struct pen *const pen = (struct pen *)c; /* its first member */
    struct wall_drawing *const d = pen->to;
    if (d->n == d->room) {
        const int more = 2 * d->room + 256;
        d->at = xrealloc(d->at, 3 * (size_t)d->room, 3 * (size_t)more, sizeof *d->at);
        d->wall = xrealloc(d->wall, (size_t)d->room, (size_t)more, sizeof *d->wall);
        d->room = more;
    }
    d->at[3 * d->n] = placed_at(pen->wall, a);
    d->at[3 * d->n + 1] = placed_at(pen->wall, b);
    d->at[3 * d->n + 2] = placed_at(pen->wall, p);
    d->wall[d->n++] = pen->index;
}

struct wall_drawing walls_draw(const struct sim *s)
{
    struct wall_drawing d = {0};
    struct pen pen = {
        .canvas = {.triangle = add_triangle,
                   .high = v3(s->domain.size[0], s->domain.size[1], s->domain.size[2])},
        .to = &d};
    for (int k = 0; k < s->walls.n; k++) {
        const struct wall *const w = &s->walls.wall[k];
        if (w->kind == &wall_side)
            continue;
        pen.wall = w;
        if (w->kind->draw)
            w->kind->draw(w->shape, &pen.canvas);
        pen.index++;
    }
    return d;
}

void wall_drawing_free(struct wall_drawing *d)
{
    xfree(d->at);
    xfree(d->wall);
    *d = (struct wall_drawing){0};
}
