/* wall_motion.c - reads how walls move, and moves them. */
#include "wall_motion.h"

#include "contact_loop.h"
#include "sim.h"

#define TWO_PI 6.28318530717958647692

const struct key wall_motion_keys[] = {
    {"wall", "velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s", "the wall moves"},
    {"wall", "surface_velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s",
     "of its surface, as of a belt: the wall stays"},
    {"wall", "spin", KEY_REAL, "rad s-1", "(-inf, inf)", "0 rad/s",
     "the wall turns about spin_axis"},
    {"wall", "spin_axis", KEY_VECTOR, "1", "(-inf, inf)", NULL,
     "direction, for spin and swing"},
    {"wall", "spin_point", KEY_VECTOR, "m", "(-inf, inf)", NULL,
     "a point of the axis of the spin"},
    {"wall", "amplitude", KEY_REAL, "m", "[0, inf)", "0 m",
     "the wall vibrates along `direction`: half of its stroke"},
    {"wall", "swing", KEY_REAL, "rad", "[0, inf)", "0 rad",
     "the wall vibrates about spin_axis: half of its angle"},
    {"wall", "frequency", KEY_REAL, "Hz", "(0, inf)", NULL, "of amplitude and swing"},
    {"wall", "phase", KEY_REAL, "rad", "(-inf, inf)", "0 rad", "of amplitude and swing"},
    {"wall", "direction", KEY_VECTOR, "1", "(-inf, inf)", NULL,
     "of the vibration; the way in which a servo pushes"},
    {"wall", "start", KEY_REAL, "s", "[0, inf)", "0 s", "the motion starts"},
    {"wall", "stop", KEY_REAL, "s", "never | (0, inf)", "never",
     "the motion stops; the wall stays where it is"},
    {"wall", "push", KEY_REAL, "N", "(-inf, inf)", NULL,
     "servo: the wall moves along `direction` until the grains bear this force"},
    {"wall", "stress", KEY_REAL, "Pa", "(-inf, inf)", NULL, "servo: the same, per area"},
    {"wall", "push_ramp", KEY_REAL, "s", "[0, inf)", "0 s",
     "time in which push or stress grows from 0"},
    {"wall", "push_table", KEY_TEXT, "", "", "",
     "CSV file of push or stress: time in s, value in N or Pa"},
    {"wall", "area", KEY_REAL, "m2", "auto | (0, inf)", "auto",
     "area of `stress`; auto: between the flat walls across (or the period)"},
    {"wall", "gain", KEY_REAL, "1", "(0, inf)", "1",
     "servo: speed over speed_max per error over the largest target"},
    {"wall", "integral_time", KEY_REAL, "s", "off | auto | (0, inf)", "auto",
     "servo: of its integral part; auto: while it moves half a diameter at gain "
     "speed_max"},
    {"wall", "speed_max", KEY_REAL, "m s-1", "(0, inf)", NULL, "servo: its highest speed"},
    {0},
};

/* m; how far from the axis a point can be where grains are: within the box. */
static double domain_reach(const struct domain *d, const struct wall_motion *m)
{
    double most = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        const vec3 x = v3(corner & 1 ? d->size[0] : 0.0, corner & 2 ? d->size[1] : 0.0,
                          corner & 4 ? d->size[2] : 0.0);
        most = fmax(most, v3_norm(v3_cross(v3_sub(x, m->pivot), m->axis)));
    }
    return most;
}

static double bounds_reach(const struct wall *w, const struct wall_motion *m)
{
    double most = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        const vec3 x = v3(corner & 1 ? w->low.x : w->high.x, corner & 2 ? w->low.y : w->high.y,
                          corner & 4 ? w->low.z : w->high.z);
        if (!isfinite(x.x + x.y + x.z))
            return (double)INFINITY;
        most = fmax(most, v3_norm(v3_cross(v3_sub(x, m->pivot), m->axis)));
    }
    return most;
}

static void read_turning(struct wall *w, struct scene *scene, const struct sim *s)
{
    struct wall_motion *const m = &w->motion;
    m->spin = scene_real(scene, "wall", w->name, "spin");
    m->swing = scene_real(scene, "wall", w->name, "swing");
    m->turns = m->spin != 0.0 || m->swing != 0.0;
    m->axis = v3(0.0, 0.0, 1.0);
    m->pivot = w->middle;
    if (!m->turns)
        return;
    m->axis = wall_unit_vector(scene, w->name, "spin_axis");
    m->pivot = scene_vector(scene, "wall", w->name, "spin_point");
    const double sweep =
        w->kind->sweep ? w->kind->sweep(w->shape, m->pivot, m->axis) : (double)INFINITY;
    m->sweep = fmin(sweep, fmin(bounds_reach(w, m), domain_reach(&s->domain, m)));
    if (m->sweep > 0.0)
        for (int a = 0; a < 3; a++)
            if (s->domain.periodic[a] && !isfinite(a == 0   ? w->high.x - w->low.x
                                                   : a == 1 ? w->high.y - w->low.y
                                                            : w->high.z - w->low.z))
                scene_error(scene, "wall", w->name, "spin",
                            "a wall without end in periodic %c can only turn in itself",
                            'x' + a);
}

static void read_vibration(struct wall *w, struct scene *scene)
{
    struct wall_motion *const m = &w->motion;
    m->amplitude = scene_real(scene, "wall", w->name, "amplitude");
    if (m->amplitude > 0.0)
        m->direction = wall_unit_vector(scene, w->name, "direction");
    if (m->amplitude > 0.0 || m->swing > 0.0) {
        m->frequency = scene_real(scene, "wall", w->name, "frequency");
        m->phase = scene_real(scene, "wall", w->name, "phase");
    }
}

void wall_motion_read(struct wall *w, struct scene *scene, const struct sim *s)
{
    struct wall_motion *const m = &w->motion;
    m->velocity = scene_vector(scene, "wall", w->name, "velocity");
    m->surface = scene_vector(scene, "wall", w->name, "surface_velocity");
    read_turning(w, scene, s);
    read_vibration(w, scene);
    const bool servo = scene_given(scene, "wall", w->name, "push") ||
                       scene_given(scene, "wall", w->name, "stress") ||
                       scene_given(scene, "wall", w->name, "push_table");
    m->moves = v3_norm(m->velocity) > 0.0 || m->turns || m->amplitude > 0.0 || servo;
    m->stop = (double)INFINITY;
    if (!m->moves)
        return;
    m->start = scene_real(scene, "wall", w->name, "start");
    if (!scene_word(scene, "wall", w->name, "stop", "never"))
        m->stop = scene_real(scene, "wall", w->name, "stop");
    if (m->stop < m->start)
        scene_error(scene, "wall", w->name, "stop", "must not be before start, %g s", m->start);
}

/* Rodrigues' formula. */
static void set_turn(struct wall_pose *p, vec3 k, double angle)
{
    const double c = cos(angle), s = sin(angle), o = 1.0 - c;
    const double turn[3][3] = {
        {c + o * k.x * k.x, o * k.x * k.y - s * k.z, o * k.x * k.z + s * k.y},
        {o * k.x * k.y + s * k.z, c + o * k.y * k.y, o * k.y * k.z - s * k.x},
        {o * k.x * k.z - s * k.y, o * k.y * k.z + s * k.x, c + o * k.z * k.z}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            p->turn[i][j] = turn[i][j];
}

/* Velocity of the pivot and spin at time t. */
static void rates(const struct wall *w, double t, vec3 *velocity, vec3 *spin)
{
    const struct wall_motion *const m = &w->motion;
    *velocity = v3_scale(w->state.speed, m->direction);
    *spin = v3(0.0, 0.0, 0.0);
    if (t < m->start || t > m->stop)
        return;
    const double omega = TWO_PI * m->frequency;
    const double rate = omega * cos(omega * (t - m->start) + m->phase);
    *velocity = v3_axpy(v3_add(*velocity, m->velocity), m->amplitude * rate, m->direction);
    *spin = v3_scale(m->spin + m->swing * rate, m->axis);
}

void wall_pose_at(struct wall *w, double t, double half)
{
    const struct wall_motion *const m = &w->motion;
    struct wall_pose *const p = &w->pose;
    const double tau = fmin(fmax(t, m->start), m->stop) - m->start;
    const double wave = sin(TWO_PI * m->frequency * tau + m->phase) - sin(m->phase);
    p->shift = v3_axpy(v3_scale(tau, m->velocity), m->amplitude * wave + w->state.travel,
                       m->direction);
    p->angle = m->spin * tau + m->swing * wave;
    p->moved = m->moves;
    p->turned = m->turns && m->sweep > 0.0; /* what turns in itself stays where it is */
    if (p->turned)
        set_turn(p, m->axis, p->angle);
    rates(w, t, &p->velocity, &p->spin);
    rates(w, t - half, &p->half, &p->half_spin);
}

/* m/s; no point of the wall is faster around time t. */
static double fastest(const struct wall *w, double t, double dt)
{
    const struct wall_motion *const m = &w->motion;
    double speed = fabs(w->state.speed);
    if (t < m->start - dt || t > m->stop + dt)
        return speed;
    const double omega = TWO_PI * m->frequency;
    speed += v3_norm(m->velocity) + m->amplitude * omega;
    return speed + (fabs(m->spin) + m->swing * omega) * m->sweep;
}

void walls_drift(struct sim *s, int parity)
{
    struct walls *const all = &s->walls;
    if (!all->moving || all->still)
        return;
    all->ahead++;
    const double t = s->t + all->ahead * s->run.dt;
    all->speed = 0.0;
    for (int k = 0; k < all->n; k++) {
        struct wall *const w = &all->wall[k];
        if (!w->motion.moves)
            continue;
        w->state.travel += w->state.speed * s->run.dt;
        wall_pose_at(w, t, 0.5 * s->run.dt);
        all->speed = fmax(all->speed, fastest(w, t, s->run.dt));
    }
    neighbours_wall_speed(s, parity, all->speed);
}

static double8 add_runs(const struct sim *s, int k)
{
    double8 sum = {0.0};
    for (int run = 0; run < s->neighbours.runs; run++)
        sum += s->contacts->wall_force[(size_t)run * s->walls.n + k].both;
    return sum;
}

void walls_feel(struct sim *s)
{
    struct walls *const all = &s->walls;
    if (!all->moving || all->still)
        return;
    for (int k = 0; k < all->n; k++) {
        struct wall *const w = &all->wall[k];
        if (!w->motion.moves)
            continue;
        const double8 on = add_runs(s, k);
        vec3 force, torque;
        sums_part(on, &force, &torque);
        const double power = v3_dot(force, w->pose.velocity) + v3_dot(torque, w->pose.spin);
        w->state.work += 0.5 * s->run.dt * (w->state.power + power);
        w->state.power = power;
        w->force = force;
        w->torque = torque;
        if (w->servo.on)
            servo_speed(s, w, s->t + all->ahead * s->run.dt);
    }
}

void wall_motion_free(struct wall *w)
{
    course_free(&w->servo.target);
}
