/* walls.c - the walls of a scene, their elements, and what of them is near. */
#include "walls.h"

#include <stdio.h>
#include <string.h>
#include "sim.h"

const struct key wall_keys[] = {
    {"wall", "kind", KEY_TEXT, "", "", "plane",
     "what surface: one of those listed below, files of solver/walls/"},
    {"wall", "material", KEY_TEXT, "", "", "",
     "its material; default: \"wall\" if there is one, or that of the first species"},
    {"wall", "point", KEY_VECTOR, "m", "(-inf, inf)", NULL,
     "a point of a plane; middle of a disc; foot of the axis of a cylinder or cone"},
    {"wall", "normal", KEY_VECTOR, "1", "(-inf, inf)", NULL,
     "of a plane, towards the grains; of a disc"},
    {"wall", "axis", KEY_VECTOR, "1", "(-inf, inf)", NULL, "direction of a cylinder or cone"},
    {"wall", "radius", KEY_REAL, "m", "(0, inf)", NULL, "of a disc, cylinder or cone"},
    {"wall", "length", KEY_REAL, "m", "endless | (0, inf)", "endless",
     "of a cylinder or cone, from `point` on"},
    {"wall", "caps", KEY_CHOICE, "", "none | foot | end | both", "none",
     "flat ends of a cylinder or cone"},
    {"wall", "side", KEY_CHOICE, "", "both | in | out", "both",
     "where grains may be, of a box, cylinder or cone; both are felt all the same"},
    {0},
};

static const struct wall_kind *find_kind(struct scene *scene, const char *name)
{
    const char *const asked = scene_text(scene, "wall", name, "kind");
    char *all = xstrdup("");
    for (int k = 0; wall_kinds[k]; k++) {
        if (strcmp(wall_kinds[k]->name, asked) == 0) {
            xfree(all);
            return wall_kinds[k];
        }
        char *const longer = xprintf("%s%s%s", all, k ? " | " : "", wall_kinds[k]->name);
        xfree(all);
        all = longer;
    }
    scene_error(scene, "wall", name, "kind", "must be one of %s", all);
    xfree(all);
    return NULL;
}

static double half_way(double low, double high)
{
    return isfinite(low) && isfinite(high) ? 0.5 * (low + high) : 0.0;
}

static struct wall *add_wall(struct sim *s, const char *name, const struct wall_kind *kind,
                             void *surface)
{
    struct wall *const w = &s->walls.wall[s->walls.n++];
    snprintf(w->name, sizeof w->name, "%.31s", name);
    w->kind = kind;
    w->shape = surface;
    w->elements = kind->elements(surface);
    kind->bounds(surface, &w->low, &w->high);
    w->middle = v3(half_way(w->low.x, w->high.x), half_way(w->low.y, w->high.y),
                   half_way(w->low.z, w->high.z));
    wall_pose_at(w, 0.0, 0.0);
    return w;
}

static void add_sides(struct sim *s)
{
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2;
        s->walls.periodic = s->walls.periodic || s->domain.periodic[axis];
        if (s->domain.periodic[axis] || s->domain.side[side].open)
            continue;
        struct wall_flat *const p = xalloc(1, sizeof *p);
        const double at = side % 2 ? s->domain.size[axis] : 0.0;
        const double to = side % 2 ? -1.0 : 1.0;
        p->point = v3(axis == 0 ? at : 0.0, axis == 1 ? at : 0.0, axis == 2 ? at : 0.0);
        p->normal = v3(axis == 0 ? to : 0.0, axis == 1 ? to : 0.0, axis == 2 ? to : 0.0);
        struct wall *const w = add_wall(s, side_name[side], &wall_side, p);
        w->motion.surface = s->domain.side[side].velocity;
    }
}

static void add_named(struct sim *s, struct scene *scene, const char *name)
{
    const struct wall_kind *const kind = find_kind(scene, name);
    if (!kind)
        return;
    if (strlen(name) >= WALL_NAME)
        scene_error(scene, "wall", name, NULL, "the name must be shorter than %d letters",
                    WALL_NAME);
    scene_declare(scene, kind->keys);
    struct wall *const w = add_wall(s, name, kind, kind->read(scene, name, &s->domain));
    wall_motion_read(w, scene, s);
    servo_read(w, scene);
    s->walls.moving = s->walls.moving || w->motion.moves;
}

static void number_elements(struct walls *all)
{
    size_t n = 0;
    all->first = xalloc((size_t)all->n + 1, sizeof *all->first);
    for (int k = 0; k < all->n; k++)
        n += (size_t)all->wall[k].elements;
    all->wall_of = xalloc(n + 1, sizeof *all->wall_of);
    int e = 0;
    for (int k = 0; k < all->n; k++) {
        all->first[k] = e;
        for (int i = 0; i < all->wall[k].elements; i++)
            all->wall_of[e++] = k;
    }
    all->first[all->n] = e;
}

void walls_create(struct sim *s, struct scene *scene)
{
    const char *const *names;
    scene_declare(scene, wall_keys);
    scene_declare(scene, wall_motion_keys);
    const int n = scene_names(scene, "wall", &names);
    s->walls.wall = xalloc((size_t)n + 6, sizeof *s->walls.wall);
    add_sides(s);
    for (int i = 0; i < n; i++)
        add_named(s, scene, names[i]);
    number_elements(&s->walls);
}

void walls_free(struct sim *s)
{
    for (int k = 0; k < s->walls.n; k++) {
        s->walls.wall[k].kind->free(s->walls.wall[k].shape);
        wall_motion_free(&s->walls.wall[k]);
    }
    for (int i = 0; i < s->walls.n_texts; i++)
        xfree(s->walls.text[i]);
    xfree(s->walls.text);
    xfree(s->walls.wall);
    xfree(s->walls.wall_of);
    xfree(s->walls.first);
}

static int material_index(const struct sim *s, const char *name)
{
    for (int m = 0; m < s->grains.n_materials; m++)
        if (strcmp(s->grains.materials[m].name, name) == 0)
            return m;
    return -1;
}

void walls_materials(struct sim *s, struct scene *scene)
{
    const int wall = material_index(s, "wall");
    for (int k = 0; k < s->walls.n; k++) {
        struct wall *const w = &s->walls.wall[k];
        w->material = wall >= 0 ? wall : 0;
        const char *const section = w->kind == &wall_side ? "side" : "wall";
        const char *const asked = scene_text(scene, section, w->name, "material");
        const int m = material_index(s, asked);
        if (asked[0] != '\0' && m < 0)
            scene_error(scene, section, w->name, "material", "there is no [material %s]",
                        asked);
        else if (asked[0] != '\0')
            w->material = m;
    }
}

/* The place of a point in the frame of the wall, by the nearest image of the element. */
static inline vec3 into_frame(const struct sim *s, const struct wall *w, int local, vec3 x)
{
    const struct wall_pose *const p = &w->pose;
    if (p->moved)
        x = v3_sub(x, p->shift);
    if (s->walls.periodic && !p->turned) {
        const vec3 m = w->kind->middle ? w->kind->middle(w->shape, local) : w->middle;
        x = v3_add(m, domain_minimum_image(&s->domain, v3_sub(x, m)));
    } else if (s->walls.periodic) {
        const vec3 m = v3_sub(w->kind->middle ? w->kind->middle(w->shape, local) : w->middle,
                              w->motion.pivot);
        const vec3 at = v3_add(w->motion.pivot, pose_turn(p, m));
        x = v3_add(at, domain_minimum_image(&s->domain, v3_sub(x, at)));
    }
    if (p->turned)
        x = v3_add(w->motion.pivot, pose_back(p, v3_sub(x, w->motion.pivot)));
    return x;
}

void wall_look(const struct sim *s, int element, const vec3 *x, struct wall_seen *out)
{
    const int k = s->walls.wall_of[element], local = element - s->walls.first[k];
    const struct wall *const w = &s->walls.wall[k];
    const vec3 in = into_frame(s, w, local, v3(x->x, x->y, x->z));
    w->kind->view(w->shape, local, &in, &out->view);
    out->arm.x = in.x - w->motion.pivot.x;
    out->arm.y = in.y - w->motion.pivot.y;
    out->arm.z = in.z - w->motion.pivot.z;
    if (w->pose.turned) {
        out->view.away = pose_turn(&w->pose, out->view.away);
        out->arm = pose_turn(&w->pose, out->arm);
    }
}

struct wall_seen wall_see(const struct sim *s, int element, vec3 x)
{
    struct wall_seen seen;
    wall_look(s, element, &x, &seen);
    return seen;
}

bool wall_flat_at(const struct sim *s, int element, vec3 x, struct wall_flat *plane,
                  double *within)
{
    const int k = s->walls.wall_of[element], local = element - s->walls.first[k];
    const struct wall *const w = &s->walls.wall[k];
    const vec3 in = into_frame(s, w, local, x);
    return w->kind->flat && w->kind->flat(w->shape, local, &in, plane, within);
}

int wall_patch(const struct sim *s, int element)
{
    const int k = s->walls.wall_of[element];
    const struct wall *const w = &s->walls.wall[k];
    return w->kind->patch ? w->kind->patch(w->shape, element - s->walls.first[k]) : -1;
}

int wall_corners(const struct sim *s, int element, vec3 x, vec3 out[4])
{
    const int k = s->walls.wall_of[element], local = element - s->walls.first[k];
    const struct wall *const w = &s->walls.wall[k];
    const int n = w->kind->corners ? w->kind->corners(w->shape, local, out) : 0;
    const vec3 in = into_frame(s, w, local, x);
    for (int c = 0; c < n; c++) {
        out[c] = v3_sub(out[c], in);
        if (w->pose.turned)
            out[c] = pose_turn(&w->pose, out[c]);
    }
    return n;
}

/* Whether the bounds of a wall, which has no inside to be caught in, are out of reach. */
static bool far_from(const struct wall *w, vec3 x, double reach)
{
    return !w->kind->behind &&
           (x.x < w->low.x - reach || x.x > w->high.x + reach || x.y < w->low.y - reach ||
            x.y > w->high.y + reach || x.z < w->low.z - reach || x.z > w->high.z + reach);
}

static void near_of_wall(const struct wall *w, vec3 x, double reach, struct found *out)
{
    if (far_from(w, x, reach))
        return;
    if (w->kind->near) {
        w->kind->near(w->shape, x, reach, out);
        return;
    }
    for (int e = 0; e < w->elements; e++) {
        struct wall_view view;
        w->kind->view(w->shape, e, &x, &view);
        if (v3_dot(view.away, view.away) < reach * reach)
            found_add(out, e);
    }
}

/* An element met by two images of a point counts once. */
static void drop_repeated(struct found *f, int from, int old)
{
    int n = old;
    for (int i = old; i < f->n; i++) {
        bool known = false;
        for (int k = from; k < old && !known; k++)
            known = f->x[k] == f->x[i];
        if (!known)
            f->x[n++] = f->x[i];
    }
    f->n = n;
}

/* Whether all images of a point along an axis are the same to a wall: a plane across another axis. */
static bool same_along(const struct wall *w, int a)
{
    const double low[3] = {w->low.x, w->low.y, w->low.z};
    const double high[3] = {w->high.x, w->high.y, w->high.z};
    const bool flat = low[0] == high[0] || low[1] == high[1] || low[2] == high[2];
    return flat && low[a] == -(double)INFINITY && !w->pose.turned;
}

/* All images of a point that may be near the wall: those beside it along periodic directions. */
static void near_of_images(const struct sim *s, const struct wall *w, vec3 x, double reach,
                           struct found *out)
{
    const int from = out->n;
    int most[3];
    for (int a = 0; a < 3; a++)
        most[a] = s->domain.periodic[a] && !same_along(w, a) ? 1 : 0;
    const vec3 pivot = w->motion.pivot;
    vec3 middle = w->middle;
    if (w->pose.turned)
        middle = v3_add(pivot, pose_turn(&w->pose, v3_sub(middle, pivot)));
    const vec3 home =
        domain_minimum_image(&s->domain, v3_sub(v3_sub(x, w->pose.shift), middle));
    for (int i = -most[0]; i <= most[0]; i++)
        for (int j = -most[1]; j <= most[1]; j++)
            for (int k = -most[2]; k <= most[2]; k++) {
                const int old = out->n;
                vec3 at = v3_add(
                    v3_add(middle, home),
                    v3(i * s->domain.size[0], j * s->domain.size[1], k * s->domain.size[2]));
                if (w->pose.turned)
                    at = v3_add(pivot, pose_back(&w->pose, v3_sub(at, pivot)));
                near_of_wall(w, at, reach, out);
                drop_repeated(out, from, old);
            }
}

void walls_around(const struct sim *s, vec3 x, double reach, struct found *out)
{
    for (int k = 0; k < s->walls.n; k++) {
        const struct wall *const w = &s->walls.wall[k];
        const int from = out->n;
        if (s->walls.periodic)
            near_of_images(s, w, x, reach, out);
        else
            near_of_wall(w, into_frame(s, w, 0, x), reach, out);
        for (int i = from; i < out->n; i++)
            out->x[i] += s->walls.first[k];
    }
}

int walls_near(const struct sim *s, int i, double margin, int **out, int *room, int n)
{
    const struct grains *const g = &s->grains;
    struct found f = {.x = *out, .n = n, .room = *room};
    if (g->inv_mass[i] == 0.0)
        return n;
    walls_around(s, g->pos[i], g->radius[i] + margin, &f);
    *out = f.x;
    *room = f.room;
    return f.n;
}

bool wall_is_behind(const struct sim *s, const struct wall *w, vec3 x)
{
    return w->kind->behind && w->kind->behind(w->shape, into_frame(s, w, 0, x));
}

void walls_impulse(vec3 *force, vec3 *sum, vec3 *impulse, vec3 now, int steps, double dt)
{
    if (steps > 0)
        *impulse = v3_axpy(*impulse, dt, v3_add(*sum, v3_scale(0.5, v3_sub(*force, now))));
    *force = now;
    *sum = v3(0.0, 0.0, 0.0);
}
