/* solver/walls/wall_kind.h - contract: what surface is a wall?
 *
 * A scene may hold as many walls of as many kinds as it wants: [wall NAME] kind = disc. To add a
 * kind: a new file solver/walls/NAME.c with one `const struct wall_kind wall_NAME`; nothing else
 * is edited (the table of kinds is made from the folder).
 *
 * A kind is a surface at rest, made of elements that are each convex enough for their nearest
 * point to be the only one at which a sphere can touch them (a triangle, a tube). Where it is and
 * how it moves is not its affair: it is always asked in its own frame (wall_motion.h). Which of the
 * elements that a grain touches count is decided for all kinds alike (contact_walls.h).
 *
 * Called from parallel loops, except read and free. */
#ifndef WALL_KIND_H
#define WALL_KIND_H

#include <stdbool.h>
#include "../domain.h"

/* Numbers that grow as they are found. */
struct found {
    int *x;
    int n, room;
};

void found_add(struct found *f, int x);

enum wall_part { WALL_FACE, WALL_EDGE, WALL_VERTEX };

/* An element as seen from a point. */
struct wall_view {
    vec3 away;           /* m, from the nearest point of the element to the point */
    double curvature;    /* 1/m, mean over the two directions; > 0: bulges towards the point,
                            < 0: hollow; 0: flat, and of edges by convention */
    enum wall_part part; /* on which the nearest point lies */
};

static inline void wall_view_put(struct wall_view *v, vec3 away, double curvature,
                                 enum wall_part part)
{
    v->away.x = away.x;
    v->away.y = away.y;
    v->away.z = away.z;
    v->curvature = curvature;
    v->part = part;
}

/* Takes the triangles of a picture, m; surfaces without end are to end at low and high. */
struct wall_canvas {
    void (*triangle)(struct wall_canvas *c, vec3 a, vec3 b, vec3 p);
    vec3 low, high;
};

/* Elements of one wall as seen each from a point of its own; in the frame of the wall. */
enum { WALL_LOOKS = 32 };
struct wall_looks {
    int n; /* at most WALL_LOOKS */
    int element[WALL_LOOKS];
    _Alignas(64) double x[WALL_LOOKS], y[WALL_LOOKS], z[WALL_LOOKS]; /* m, the points */
    double ax[WALL_LOOKS], ay[WALL_LOOKS], az[WALL_LOOKS];           /* m, away */
    double curvature[WALL_LOOKS];                                    /* 1/m */
    int part[WALL_LOOKS];                                            /* enum wall_part */
    /* The nearest point lies on an edge that is shared with a neighbour, and the point seen from is on
     * the hollow side of the two: the neighbour is nearer. Comes as 0. */
    int hollow[WALL_LOOKS];
};

/* A plane without end; grains are on the side of its normal. */
struct wall_flat {
    vec3 point, normal; /* m; unit */
};

struct wall_kind {
    const char *name, *summary;
    const struct key *keys; /* of section "wall", besides those of walls.c */
    /* Reads what it needs; what is wrong goes on the scene's list. Never NULL. */
    void *(*read)(struct scene *scene, const char *name, const struct domain *d);
    void (*free)(void *shape);
    int (*elements)(const void *shape);
    /* By address, since the loop over contacts asks it most: structs that are handed over by value
     * are written number by number and read back as vectors, which waits for the memory. */
    void (*view)(const void *shape, int element, const vec3 *x, struct wall_view *out);
    /* The same for several points at once, away, curvature and part; a plain loop that the compiler
     * turns into vectors. NULL: by `view`, one after the other, which costs several times as much. */
    void (*views)(const void *shape, struct wall_looks *l);
    /* Adds the elements whose distance from x is less than reach, in a fixed order. NULL: there
     * are few, all are looked at. */
    void (*near)(const void *shape, vec3 x, double reach, struct found *out);
    /* x is where no grain may be: behind a plane, outside of a drum. NULL: both sides are good. */
    bool (*behind)(const void *shape, vec3 x);
    /* The box around it; INFINITY where it has no end. */
    void (*bounds)(const void *shape, vec3 *low, vec3 *high);
    /* The middle of an element, for its nearest periodic image. NULL: that of the bounds. */
    vec3 (*middle)(const void *shape, int element);
    /* The corners of a flat element with straight edges, in order; returns how many (3 or 4). NULL:
     * there are none. */
    int (*corners)(const void *shape, int element, vec3 out[4]);
    /* Flat elements that lie in one plane and join have one number. NULL: each has its own. */
    int (*patch)(const void *shape, int element);
    /* Whether an element is flat; then its plane (`point`: the middle of the element) and how far from its rim
     * the foot of x lies on its face, m; negative: it does not. NULL: none is. */
    bool (*flat)(const void *shape, int element, const vec3 *x, struct wall_flat *plane,
                 double *within);
    /* Largest distance of its points from the axis of a turn; 0 where the turn maps it onto
     * itself. NULL: from its bounds. */
    double (*sweep)(const void *shape, vec3 point, vec3 axis);
    void (*draw)(const void *shape, struct wall_canvas *c); /* NULL: nothing */
};

extern const struct wall_kind *const wall_kinds[]; /* the last entry is NULL */

extern const struct wall_kind wall_side; /* a side of the box: a plane; not to be named */

/* Unit vector along a key that must not be zero. */
vec3 wall_unit_vector(struct scene *scene, const char *name, const char *key);

/* A sphere touching a ring, a segment, a disc: helpers of the kinds. */

int wall_single(const void *shape); /* one element */
void wall_flat_view(const void *flat, int element, const vec3 *x, struct wall_view *out);
void wall_flat_views(const void *flat, struct wall_looks *l);
void wall_flat_near(const void *flat, vec3 x, double reach, struct found *out);
bool wall_flat_behind(const void *flat, vec3 x);
void wall_flat_bounds(const void *flat, vec3 *low, vec3 *high);
double wall_flat_sweep(const void *flat, vec3 point, vec3 axis);
void wall_flat_draw(const void *flat, struct wall_canvas *c);

/* Nearest point of the rectangle origin + u e1 + v e2, 0 <= u, v <= 1 (e1, e2 at right angles). */
void wall_rectangle_view(const vec3 *origin, const vec3 *e1, const vec3 *e2, const vec3 *x,
                         struct wall_view *out);
void wall_rectangle_views(const vec3 *origin, const vec3 *e1, const vec3 *e2,
                          struct wall_looks *l);

bool wall_rectangle_flat(const vec3 *origin, const vec3 *e1, const vec3 *e2, const vec3 *x,
                         struct wall_flat *plane, double *within);

/* Of the strip of revolution through (h0, r0) and (h1, r1) in heights along the axis from `foot`
 * and radii: a disc, tube or frustum. */
struct wall_strip {
    vec3 foot, axis;
    double h0, r0, h1, r1;
};
void wall_strip_view(const struct wall_strip *s, const vec3 *x, struct wall_view *out);
/* Of n strips that share foot and axis: element k is strip[k]. */
void wall_strip_views(const struct wall_strip *strip, int n, struct wall_looks *l);
bool wall_strip_flat(const struct wall_strip *s, const vec3 *x, struct wall_flat *plane,
                     double *within); /* of a disc */
void wall_strip_draw(const struct wall_strip *s, struct wall_canvas *c);
void wall_strip_bounds(const struct wall_strip *s, vec3 *low, vec3 *high);
double wall_strip_sweep(const struct wall_strip *s, vec3 point, vec3 axis);

#endif
