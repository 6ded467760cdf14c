/* wall_motion.h - how a wall moves: at rest, along, turning, vibrating, or pressed with a force.
 *
 *   tau   = min(max(t, start), stop) - start
 *   shift = velocity tau + direction (A (sin(2 pi f tau + phase) - sin phase) + travel)
 *   angle = spin tau + swing (sin(2 pi f tau + phase) - sin phase)
 *   x     = pivot + shift + R(angle about the axis) (X - pivot)
 * X is the wall at t = 0. All but `travel`, which the servo integrates, is a formula of the time:
 * nothing drifts however many steps there are. */
#ifndef WALL_MOTION_H
#define WALL_MOTION_H

#include <stdbool.h>
#include "course.h"

struct sim;
struct wall;

struct wall_motion {
    vec3 velocity;    /* m/s, along; the wall moves */
    vec3 surface;     /* m/s, of its surface in itself (a belt); the wall stays */
    vec3 axis, pivot; /* unit; m, a point of the axis at t = 0 */
    double spin;      /* rad/s about it */
    vec3 direction;   /* unit, of vibration and servo */
    double amplitude, swing, frequency, phase; /* m, rad, Hz, rad */
    double start, stop;                        /* s */
    bool moves, turns;
    double sweep; /* m, largest distance of its points from the axis; 0: it turns in itself */
};

/* A servo pushes along `direction` with the force that is asked for, see servo.c. */
struct servo {
    bool on, stress, own_area;
    struct course target; /* N or Pa */
    double scale;         /* largest absolute target */
    double area;          /* m2 */
    double gain, speed_most;
    double integral_time; /* s; 0: auto, INFINITY: off */
};

struct wall_pose {
    double turn[3][3];    /* R */
    vec3 shift;           /* m */
    vec3 velocity, spin;  /* m/s of the pivot, rad/s, at the full step */
    vec3 half, half_spin; /* the same at the half step before */
    double angle;         /* rad */
    bool moved, turned;   /* shift and turn are not nothing */
};

static inline vec3 pose_turn(const struct wall_pose *p, vec3 x)
{
    return v3(p->turn[0][0] * x.x + p->turn[0][1] * x.y + p->turn[0][2] * x.z,
              p->turn[1][0] * x.x + p->turn[1][1] * x.y + p->turn[1][2] * x.z,
              p->turn[2][0] * x.x + p->turn[2][1] * x.y + p->turn[2][2] * x.z);
}

static inline vec3 pose_back(const struct wall_pose *p, vec3 x)
{
    return v3(p->turn[0][0] * x.x + p->turn[1][0] * x.y + p->turn[2][0] * x.z,
              p->turn[0][1] * x.x + p->turn[1][1] * x.y + p->turn[2][1] * x.z,
              p->turn[0][2] * x.x + p->turn[1][2] * x.y + p->turn[2][2] * x.z);
}

struct wall_state {
    double travel, speed, integral; /* m, m/s, 1, of the servo */
    double work,
        power; /* J, W, by the grains on the wall by its motion; power at the last step */
};

/* What is written in time: means over the last step of the ledger. */
struct wall_series {
    vec3 force, torque;
    double pushed; /* N or Pa, along the direction of the servo */
};

extern const struct key wall_motion_keys[];

void wall_motion_read(struct wall *w, struct scene *scene, const struct sim *s);
void servo_read(struct wall *w, struct scene *scene);
void wall_motion_free(struct wall *w);

/* Where a wall is at time t; dt back is the half step. */
void wall_pose_at(struct wall *w, double t, double half);

/* m2 that the wall bears on: given, or between the flat walls across. */
double servo_area(const struct sim *s, const struct wall *w);
void servo_speed(const struct sim *s, struct wall *w, double t);

/* By one thread of the team, between the loop over the contacts and the drift of the grains: the
 * walls go on to the time of the next grain step; their largest speed is told to the lists
 * (`parity` as of motion.h). */
void walls_drift(struct sim *s, int parity);
/* By one thread, after the loop over the contacts: forces on walls that move, their work, servos. */
void walls_feel(struct sim *s);

#endif
