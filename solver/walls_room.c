/* walls_room.c - where a sphere has room beside walls: for filling, and for what lies at rest on them. */
#include "sim.h"

double walls_gap(const struct sim *s, vec3 x, double radius, double most, int *which)
{
    struct found f = {0};
    double gap = most;
    walls_around(s, x, radius + most, &f);
    for (int i = 0; i < f.n; i++) {
        const double room = v3_norm(wall_see(s, f.x[i], x).view.away) - radius;
        if (room < gap) {
            gap = room;
            if (which)
                *which = s->walls.wall_of[f.x[i]];
        }
    }
    for (int k = 0; k < s->walls.n; k++) {
        const struct wall *const w = &s->walls.wall[k];
        if (!wall_is_behind(s, w, x))
            continue;
        gap = -(double)INFINITY;
        if (which)
            *which = k;
    }
    xfree(f.x);
    return gap;
}

double walls_escape(const struct sim *s, vec3 x, double radius, vec3 *way)
{
    struct found f = {0};
    double gap = 0.0;
    walls_around(s, x, radius, &f);
    for (int i = 0; i < f.n; i++) {
        const vec3 away = wall_see(s, f.x[i], x).view.away;
        const double distance = v3_norm(away);
        const double side =
            wall_is_behind(s, &s->walls.wall[s->walls.wall_of[f.x[i]]], x) ? -1 : 1;
        if (!(distance > 0.0) || side * distance - radius >= gap)
            continue;
        gap = side * distance - radius;
        *way = v3_scale(side / distance, away);
    }
    xfree(f.x);
    return gap;
}

vec3 walls_bear(const struct sim *s, vec3 x, double radius, vec3 force)
{
    struct found f = {0};
    walls_around(s, x, radius, &f);
    for (int i = 0; i < f.n; i++) {
        const vec3 away = wall_see(s, f.x[i], x).view.away;
        const double square = v3_dot(away, away);
        if (square > 0.0 && square < radius * radius)
            force = v3_axpy(force, fmax(0.0, -v3_dot(force, away)) / square, away);
    }
    xfree(f.x);
    return force;
}

bool walls_hide(const struct sim *s, vec3 x)
{
    for (int k = 0; k < s->walls.n; k++)
        if (s->walls.wall[k].kind != &wall_side && wall_is_behind(s, &s->walls.wall[k], x))
            return true;
    return false;
}

bool walls_named(const struct sim *s)
{
    for (int k = 0; k < s->walls.n; k++)
        if (s->walls.wall[k].kind != &wall_side)
            return true;
    return false;
}
