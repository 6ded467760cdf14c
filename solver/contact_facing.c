/* contact_facing.c - see contact_facing.h. */
#include "contact_facing.h"

#include "../contact/contact.h"
#include "sim.h"

struct facing facing_look(const struct sim *s, int slot, int element, vec3 centre)
{
    const int wall = s->walls.wall_of[element];
    struct wall_seen seen;
    struct facing f; /* number by number, see wall_kind.h */
    wall_look(s, element, &centre, &seen);
    f.slot = slot;
    f.wall = wall;
    f.local = element - s->walls.first[wall];
    f.centre = v3(centre.x, centre.y, centre.z);
    f.away = v3(seen.view.away.x, seen.view.away.y, seen.view.away.z);
    f.distance = v3_norm(f.away);
    f.curvature = seen.view.curvature;
    f.arm = v3(seen.arm.x, seen.arm.y, seen.arm.z);
    f.part = seen.view.part;
    f.counts = f.live = false;
    return f;
}

/* The nearest point of k lies on element m too: the distance of m from it is nothing. */
static bool shares(const struct sim *s, const struct facing *k, const struct facing *m,
                   double tolerance)
{
    const vec3 point = v3_sub(k->centre, k->away);
    const int element = s->walls.first[m->wall] + m->local;
    return v3_norm(wall_see(s, element, point).view.away) < tolerance;
}

/* Of two elements that meet the grain in the same point: does m go before k? */
static bool before(const struct facing *m, const struct facing *k)
{
    if (m->part != k->part)
        return m->part < k->part;
    return m->distance < k->distance || (m->distance == k->distance && m->slot < k->slot);
}

bool facing_hidden(const struct sim *s, const struct facing *f, int n, int k, double tolerance)
{
    for (int m = 0; m < n; m++) {
        if (m == k || f[m].wall != f[k].wall)
            continue;
        const vec3 apart = v3_sub(f[k].away, f[m].away);
        if (v3_dot(apart, apart) < tolerance * tolerance) {
            if (before(&f[m], &f[k]))
                return true;
            continue;
        }
        const bool nearer = f[m].part == WALL_FACE || f[m].distance < f[k].distance;
        if (f[k].part != WALL_FACE && nearer && shares(s, &f[k], &f[m], tolerance))
            return true;
    }
    return false;
}

double facing_matched(double radius, double curvature)
{
    return radius / sqrt(fmax(1.0 + curvature * radius, 0.01));
}

/* What the contact remembers turns with the wall about the normal; with the normal, laws turn it. */
void facing_turn(const struct sim *s, const struct facing *f, const struct wall *w,
                 real *history)
{
    if (contact_history < 3)
        return;
    const vec3 n = v3_scale(1.0 / f->distance, f->away);
    const double angle = v3_dot(w->pose.half_spin, n) * s->run.dt;
    real *const h = history;
    const vec3 held = v3((double)h[0], (double)h[1], (double)h[2]);
    if (angle == 0.0)
        return;
    const vec3 part = v3_scale(v3_dot(held, n), n), flat = v3_sub(held, part);
    const vec3 turned =
        v3_add(part, v3_axpy(v3_scale(cos(angle), flat), sin(angle), v3_cross(n, flat)));
    h[0] = (real)turned.x;
    h[1] = (real)turned.y;
    h[2] = (real)turned.z;
}
