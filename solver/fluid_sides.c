/* fluid_sides.c - what the fluid meets at the sides of the box: velocities given there, the
 * ghosts beyond, the pressure on a side. */
#include "fluid_state.h"

bool side_open(const struct domain *d, int side)
{
    return d->side[side].kind == SIDE_OUTFLOW || d->side[side].kind == SIDE_HEAD;
}

void fluid_pressure_sides(const struct domain *d, enum poisson_side side[6])
{
    for (int i = 0; i < 6; i++)
        side[i] = d->periodic[i / 2] ? POISSON_PERIODIC
                  : side_open(d, i)  ? POISSON_DIRICHLET
                                     : POISSON_NEUMANN;
}

double fluid_inflow(const struct sim *s, int side, double t)
{
    const struct side *const e = &s->domain.side[side];
    return e->own_inflow ? course_at(&e->inflow, t) : flow_velocity(&s->flow, t);
}

double fluid_entry_rate(const struct sim *s, double t)
{
    double most = 0.0;
    for (int side = 0; side < 6; side++)
        if (s->domain.side[side].kind == SIDE_INFLOW)
            most = fmax(most, fabs(fluid_inflow(s, side, t)) / s->grid.h[side / 2]);
    most *= s->flow.profile == PROFILE_PARABOLIC ? 2.25 : 1.0;
    return most / (s->fluid.bare ? 1.0 : 0.4);
}

/* What the profile makes of the mean velocity at cell i of direction b, beside an inflow side:
 * the mean over each cell of a parabola between two walls, so that the mean over the side is 1. */
static double profile(const struct sim *s, int b, int i)
{
    const struct side *const lo = &s->domain.side[2 * b], *const hi = lo + 1;
    const bool walls = lo->kind == SIDE_WALL && hi->kind == SIDE_WALL;
    if (s->flow.profile == PROFILE_UNIFORM || !walls)
        return 1.0;
    const double n = s->grid.n[b], x0 = (i - 1) / n, x1 = i / n;
    return n * (3.0 * (x1 * x1 - x0 * x0) - 2.0 * (x1 * x1 * x1 - x0 * x0 * x0));
}

/* Index of layer i of direction a at (j, k) of the two directions beside it, the nearer in
 * memory first. */
static inline int at_layer(const struct grid *g, int a, int i, int j, int k)
{
    return i * g->s[a] + j * g->s[a == 0 ? 1 : 0] + k * g->s[a == 2 ? 1 : 2];
}

/* The two directions beside a, the nearer in memory first. */
static inline int beside(int a, int which)
{
    return which == 0 ? (a == 0 ? 1 : 0) : a == 2 ? 1 : 2;
}

static void wrap_component(struct sim *s, int a)
{
    const struct grid *const g = &s->grid;
    double *const u = s->fluid.u[a];
    const int nb = g->n[beside(a, 0)], nc = g->n[beside(a, 1)], n = g->n[a];
    for (int k = 1; k <= nc; k++)
        for (int j = 1; j <= nb; j++) {
            u[at_layer(g, a, n + 1, j, k)] = u[at_layer(g, a, 1, j, k)];
            u[at_layer(g, a, 0, j, k)] = u[at_layer(g, a, n, j, k)];
        }
}

/* The normal component on the faces of one side, where it is given. */
static void normal_component(struct sim *s, int side, double t)
{
    const struct grid *const g = &s->grid;
    const int a = side / 2, end = side % 2, b = beside(a, 0), d = beside(a, 1);
    double *const u = s->fluid.u[a];
    const double *const eps = s->fluid.eps;
    const enum side_kind kind = s->domain.side[side].kind;
    double given = 0.0;
    if (side_open(&s->domain, side))
        return;
    if (kind == SIDE_INFLOW)
        given = (end ? -1.0 : 1.0) * fluid_inflow(s, side, t);
    else if (kind == SIDE_FLUX)
        given = (end ? -1.0 : 1.0) * course_at(&s->domain.side[side].flux, t);
    for (int k = 1; k <= g->n[d]; k++) {
        const double part = given * (kind == SIDE_INFLOW ? profile(s, d, k) : 1.0);
        for (int j = 1; j <= g->n[b]; j++) {
            const int face = at_layer(g, a, end ? g->n[a] + 1 : 1, j, k);
            const double here = part * (kind == SIDE_INFLOW ? profile(s, b, j) : 1.0);
            u[face] = eps ? here / grid_face(eps, face, g->s[a]) : here;
        }
    }
}

/* One ghost before the first face: the face again. */
static void first_ghost(struct sim *s, int a)
{
    const struct grid *const g = &s->grid;
    double *const u = s->fluid.u[a];
    for (int k = 1; k <= g->n[beside(a, 1)]; k++)
        for (int j = 1; j <= g->n[beside(a, 0)]; j++)
            u[at_layer(g, a, 0, j, k)] = u[at_layer(g, a, 1, j, k)];
}

/* The ghosts of component a beyond a side across it: what the side holds it at (`wall` is the
 * velocity of a wall), or the velocity inside again. */
static void tangential_ghosts(const struct sim *s, double *u, int side, double wall)
{
    const struct grid *const g = &s->grid;
    const int b = side / 2, end = side % 2, n = g->n[b];
    const enum side_kind kind = s->domain.side[side].kind;
    const int from = kind == SIDE_PERIODIC ? (end ? 1 : n) : end ? n : 1;
    const bool holds = kind == SIDE_WALL || kind == SIDE_INFLOW || kind == SIDE_FLUX;
    const double sign = holds ? -1.0 : 1.0, twice = kind == SIDE_WALL ? 2.0 * wall : 0.0;
    for (int k = 0; k <= g->n[beside(b, 1)] + 1; k++)
        for (int j = 0; j <= g->n[beside(b, 0)] + 1; j++)
            u[at_layer(g, b, end ? n + 1 : 0, j, k)] =
                twice + sign * u[at_layer(g, b, from, j, k)];
}

static void ghosts_of(const struct sim *s, int a, double *u, double moving)
{
    for (int side = 0; side < 6; side++) {
        const vec3 v = s->domain.side[side].velocity;
        if (side / 2 != a)
            tangential_ghosts(s, u, side, moving * (a == 0 ? v.x : a == 1 ? v.y : v.z));
    }
}

void fluid_velocity_sides(struct sim *s, double t)
{
#pragma omp parallel for schedule(static) if (s->grid.total > GRID_SMALL)
    for (int a = 0; a < 3; a++) {
        if (s->domain.periodic[a]) {
            wrap_component(s, a);
        } else {
            normal_component(s, 2 * a, t);
            normal_component(s, 2 * a + 1, t);
            first_ghost(s, a);
        }
        ghosts_of(s, a, s->fluid.u[a], 1.0);
    }
}

void fluid_ghosts_nearest(const struct sim *s, int a, double *u)
{
    const struct grid *const g = &s->grid;
    for (int k = 1; k <= g->n[beside(a, 1)]; k++)
        for (int j = 1; j <= g->n[beside(a, 0)]; j++) {
            const bool wrap = s->domain.periodic[a];
            if (wrap)
                u[at_layer(g, a, g->n[a] + 1, j, k)] = u[at_layer(g, a, 1, j, k)];
            u[at_layer(g, a, 0, j, k)] = u[at_layer(g, a, wrap ? g->n[a] : 1, j, k)];
        }
    for (int b = 0; b < 3; b++) {
        const int n = g->n[b];
        for (int k = 0; b != a && k <= g->n[beside(b, 1)] + 1; k++)
            for (int j = 0; j <= g->n[beside(b, 0)] + 1; j++)
                for (int end = 0; end < 2; end++) {
                    const int from = (end == 0) == s->domain.periodic[b] ? n : 1;
                    u[at_layer(g, b, end ? n + 1 : 0, j, k)] = u[at_layer(g, b, from, j, k)];
                }
    }
}

void fluid_ghosts_of_change(const struct sim *s, int a, double *du)
{
    const struct grid *const g = &s->grid;
    for (int k = 1; k <= g->n[beside(a, 1)]; k++)
        for (int j = 1; j <= g->n[beside(a, 0)]; j++) {
            double *const lo = &du[at_layer(g, a, 1, j, k)];
            double *const hi = &du[at_layer(g, a, g->n[a] + 1, j, k)];
            if (s->domain.periodic[a]) {
                *hi = *lo;
                du[at_layer(g, a, 0, j, k)] = du[at_layer(g, a, g->n[a], j, k)];
                continue;
            }
            if (!side_open(&s->domain, 2 * a))
                *lo = 0.0;
            if (!side_open(&s->domain, 2 * a + 1))
                *hi = 0.0;
        }
    ghosts_of(s, a, du, 0.0);
}

/* What of the stress balances the drag on a face whose velocity is given, N/m3: 0 on a wall. */
static double balance_on_face(const struct sim *s, int a, int face, bool flows)
{
    const struct fluid *const f = &s->fluid;
    const double share = f->whole_pressure ? 1.0 : grid_face(f->eps, face, s->grid.s[a]);
    return flows && share > 0.0
               ? (f->drag[a][face] * f->u[a][face] - f->drag_s[a][face]) / share
               : 0.0;
}

double fluid_boundary_pressure(const struct sim *s, int side)
{
    const enum side_kind kind = s->domain.side[side].kind;
    const bool flows = kind == SIDE_INFLOW || kind == SIDE_FLUX;
    const struct grid *const g = &s->grid;
    const int a = side / 2, end = side % 2, n = g->n[a];
    const int nb = g->n[beside(a, 0)], nc = g->n[beside(a, 1)];
    const double gravity = v3_norm(s->domain.gravity);
    const double drive[3] = {s->flow.gradient.x, s->flow.gradient.y, s->flow.gradient.z};
    if (kind == SIDE_OUTFLOW)
        return 0.0;
    if (kind == SIDE_HEAD)
        return s->fluid.rho * (gravity > 0.0 ? gravity : 9.81) *
               course_at(&s->domain.side[side].head, s->t);
    double sum = 0.0;
    for (int k = 1; k <= nc; k++)
        for (int j = 1; j <= nb; j++) {
            const int face = at_layer(g, a, end ? n + 1 : 1, j, k);
            const int inside = at_layer(g, a, end ? n : 1, j, k);
            const double G =
                s->fluid.bare ? 0.0 : balance_on_face(s, a, face, flows) - drive[a];
            sum += s->fluid.p[inside] + (end ? -0.5 : 0.5) * g->h[a] * G;
        }
    return sum / ((double)nb * nc);
}
