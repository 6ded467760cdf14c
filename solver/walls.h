/* walls.h - what bounds the grains: the sides of the box that are not periodic, and [wall NAME].
 *
 * A wall is a surface (its kind, see walls/wall_kind.h) and how it moves (wall_motion.h). Surfaces
 * are made of elements, numbered through over all walls: one of a plane, one per triangle of a
 * mesh. The list of neighbours pairs grains with elements. */
#ifndef WALLS_H
#define WALLS_H

#include "wall_motion.h"
#include "walls/wall_kind.h"

struct sim;

enum { WALL_NAME = 32 };

struct wall {
    char name[WALL_NAME];
    const struct wall_kind *kind;
    void *shape;  /* of its kind, in the frame of t = 0 */
    int elements; /* how many */
    int material;
    vec3 middle, low,
        high; /* m, of its bounds; an end that is none is infinite, its middle 0 */
    struct wall_motion motion; /* as asked */
    struct servo servo;
    struct wall_pose pose;   /* where it is and how it moves now */
    struct wall_state state; /* what a restart needs besides the time */
    vec3 force, torque;      /* N, N m about its pivot, by the grains, at the last step */
    vec3 force_before, torque_before; /* the same when last turned into impulses */
    vec3 sum, torque_sum;             /* over the steps since then */
    vec3 impulse, turn_impulse;       /* N s, N m s, their integrals over time */
    struct wall_series series;        /* what is written in time */
};

struct walls {
    int n;
    struct wall *wall;
    int *wall_of, *first; /* per element: its wall; per wall: its first element */
    bool moving;          /* some wall moves */
    bool still;           /* walls wait: the bed is settling */
    bool periodic;        /* some direction is */
    int ahead;            /* grain steps since sim.t */
    int n_texts;
    char **text;         /* names of series, which the table of series refers to */
    double speed;        /* m/s, the fastest of their points over the step at hand, or more */
    vec3 skeleton_force; /* N, by the other grains on frozen ones, at the last step */
    vec3 skeleton_sum, skeleton_impulse; /* N, N s, as of a wall */
};

extern const struct key wall_keys[];

/* Reads every wall but its material; before the grains, which keep clear of walls. */
void walls_create(struct sim *s, struct scene *scene);
void walls_materials(struct sim *s, struct scene *scene); /* once the materials are known */
/* Walls must lie in the box and leave room within a period, and a grain that moves must not start
 * inside or behind one: else an error of the scene. */
void walls_check(struct sim *s, struct scene *scene);
void walls_free(struct sim *s);

/* An element as seen from a point, in the frame of the laboratory. */
struct wall_seen {
    struct wall_view view;
    vec3 arm; /* m, from the pivot of the wall to the point */
};
struct wall_seen wall_see(const struct sim *s, int element, vec3 x);
void wall_look(const struct sim *s, int element, const vec3 *x, struct wall_seen *out);
/* The same for elements of one wall (l->element counts within it) from points x, y, z in the frame of
 * the laboratory, which are overwritten: away, curvature and part; arms, m. */
void walls_look(const struct sim *s, const struct wall *w, struct wall_looks *l,
                double (*arm)[WALL_LOOKS]);
/* Whether an element is flat; then its plane in the frame of the wall, the middle of the element in it, and how
 * far from its rim the foot of x lies on its face (m; negative: it does not). */
bool wall_flat_at(const struct sim *s, int element, vec3 x, struct wall_flat *plane,
                  double *within);
int wall_patch(const struct sim *s, int element); /* negative: its own (wall_kind.h) */
/* The same of faces that the points are above, by their planes: x y z of a point, of the unit normal; part
 * and hollow stay. */
void walls_look_flat(const struct sim *s, const struct wall *w,
                     const double (*plane)[WALL_LOOKS], struct wall_looks *l,
                     double (*arm)[WALL_LOOKS]);
/* Corners of a flat element, m, as seen from x; returns how many, 0 for other elements. */
int wall_corners(const struct sim *s, int element, vec3 x, vec3 out[4]);

/* Adds the elements that a sphere of this radius at x may touch within `margin`. */
void walls_around(const struct sim *s, vec3 x, double reach, struct found *out);
/* The same for grain i, for the list of neighbours: `n` numbers are in *out, which has room for
 * *room and grows; returns how many then are. */
int walls_near(const struct sim *s, int i, double margin, int **out, int *room, int n);

bool wall_is_behind(const struct sim *s, const struct wall *w, vec3 x); /* of what has a side */

/* m; room between a sphere at x and the nearest wall, at most `most`; negative: it overlaps, or is
 * behind a wall (then -INFINITY). `which`: that wall, if not NULL. */
double walls_gap(const struct sim *s, vec3 x, double radius, double most, int *which);
/* m; the same for the wall that the sphere is deepest in, and the unit vector along which it must
 * move by that much to be clear of it; 0 where it overlaps none. Behind a wall: -(distance +
 * radius), the way back, if it is less than the radius behind. */
double walls_escape(const struct sim *s, vec3 x, double radius, vec3 *way);
/* What is left of a force on a sphere at rest on walls: no part of it presses into one. */
vec3 walls_bear(const struct sim *s, vec3 x, double radius, vec3 force);
/* Whether the scene has walls besides the sides of the box; whether x is behind any of these. */
bool walls_named(const struct sim *s);
bool walls_hide(const struct sim *s, vec3 x);

/* Turns the sum of the forces of the last steps into an impulse: each step takes half of the force
 * at either end, as the kicks do. `now` is the force at the last of them. */
void walls_impulse(vec3 *force, vec3 *sum, vec3 *impulse, vec3 now, int steps, double dt);

/* J, done by the walls on the grains since the ledger was opened; opening it. */
double walls_work(const struct sim *s);
void walls_open(struct sim *s);
/* Forces on walls to the summary. */
void walls_report(struct sim *s);

#endif
