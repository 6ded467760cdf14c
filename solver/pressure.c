/* pressure.c - the loop around conjugate gradients (krylov.h) that keeps the solution and its
 * true residual in double precision [GolubYe99], [Strzodka06]; chooses the preconditioner by
 * the coefficient's statistics. */
#include "pressure_parts.h"

#include <stdio.h>
#include "feasibility.h"

enum { MOST = 3000 }; /* iterations */

/* Chosen by measurement, see bench/kernels.c. */
static const double contrast_multigrid = 40.0, /* multigrid beats the direct solve */
    contrast_double = 1e3,                     /* single precision loses the differences */
    variance_layers = 0.1, /* within layers, of the whole: layer means are better below */
    drop_single = 1e-5;    /* of the residual, before it is taken anew */

struct pressure *pressure_create(const struct grid *g, const struct domain *d,
                                 const enum poisson_side side[6])
{
    struct pressure *const p = xalloc(1, sizeof *p);
    p->g = g;
    p->d = d;
    memcpy(p->side, side, sizeof p->side);
    box_create(&p->box, g);
    p->direct = poisson_create(g, side);
    double **const layers[] = {&p->flat, &p->up, &p->square, &p->least, &p->most};
    for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++)
        *layers[i] = xalloc((size_t)g->n[2] + 2, sizeof(double));
    p->part = xalloc(2 * (size_t)p->box.n[1] * p->box.n[2], sizeof(double));
    return p;
}

void pressure_free(struct pressure *p)
{
    if (!p)
        return;
    poisson_free(p->direct);
    krylov_single.free(p->krylov[0]);
    krylov_double.free(p->krylov[1]);
    void *const all[] = {p->flat, p->up, p->square, p->least, p->most, p->part, p};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

void pressure_lend(struct pressure *p, double *one, double *other)
{
    p->lent[0] = one;
    p->lent[1] = other;
}

void pressure_method(struct pressure *p, enum pressure_method method)
{
    p->method = method;
}

static enum pressure_method choose(const struct pressure *p, const struct statistics *s)
{
    if (p->method != PRESSURE_AUTO)
        return p->method;
    if (s->within <= variance_layers * s->variance)
        return PRESSURE_LAYERS;
    return s->most > contrast_multigrid * s->least ? PRESSURE_MULTIGRID : PRESSURE_BOX;
}

static struct krylov *krylov_for(struct pressure *p, bool in_double)
{
    const struct box *const b = &p->box;
    bool periodic[3];
    for (int a = 0; a < 3; a++)
        periodic[a] = p->side[2 * b->axis[a]] == POISSON_PERIODIC;
    const struct krylov_kind *const kind = in_double ? &krylov_double : &krylov_single;
    struct krylov **const w = &p->krylov[in_double];
    if (!*w)
        *w = kind->create(b, periodic, p->direct, p->lent[0] ? p->lent : NULL);
    return *w;
}

/* One direct solve of the residual, as a change of phi; what is left of it. */
static double solve_directly(struct pressure *p, double *const c[3], double shift,
                             const double *rhs, double mean, double *phi)
{
    struct krylov scratch = {.real = sizeof(double), .r = p->lent[0], .x = p->lent[1]};
    struct krylov *const w = p->lent[0] ? &scratch : krylov_for(p, true);
    pressure_residual(p, c, shift, rhs, mean, phi, 1.0, w);
    poisson_solve_double(p->direct, p->flat, p->up, shift, w->r, w->x, NULL);
    pressure_take(p, w, 1.0, phi);
    return pressure_residual(p, c, shift, rhs, mean, phi, 1.0, NULL);
}

/* Conjugate gradients from the residual that `w` holds, in rounds: each takes the true residual
 * anew. Stops where a round no longer gains. */
static void iterate(struct pressure *p, double *const c[3], double shift, const double *rhs,
                    double mean, double *phi, double target, const struct statistics *s,
                    bool in_double, double unit, struct solve *result)
{
    struct krylov *const w = krylov_for(p, in_double);
    const struct krylov_kind *const kind = in_double ? &krylov_double : &krylov_single;
    const bool multigrid = result->method == PRESSURE_MULTIGRID;
    pressure_set_coefficients(p, w, c, s->scale);
    w->shift = shift * s->scale;
    for (int k = 1; k <= p->g->n[2] + 1; k++) {
        w->flat[k] = p->flat[k] * s->scale;
        w->up[k] = p->up[k] * s->scale;
    }
    if (multigrid)
        kind->coarsen(w);
    bool fresh = true;
    double before;
    do {
        before = result->end;
        const double goal = fmax(0.7 * target, in_double ? 0.0 : drop_single * before);
        double end;
        result->iterations +=
            kind->solve(w, multigrid, fresh, goal * unit, MOST - result->iterations, &end);
        pressure_take(p, w, s->scale / unit, phi);
        result->end = pressure_residual(p, c, shift, rhs, mean, phi, unit, w);
        fresh = false;
    } while (result->end > target && result->end < 0.5 * before && result->iterations < MOST);
}

struct solve pressure_solve(struct pressure *p, double *const c[3], double shift,
                            const double *rhs, double *phi, double tolerance, double floor)
{
    const struct statistics s = pressure_statistics(p, c);
    double mean;
    const double size = pressure_rhs_norm(p, rhs, &mean), unit = size > 0.0 ? 1.0 / size : 1.0;
    mean = poisson_singular(p->direct, shift) ? mean : 0.0;
    const double target = fmax(tolerance * size, floor);
    struct solve result = {.method = choose(p, &s), .contrast = s.most / s.least};
    bool in_double = result.contrast > contrast_double;
    if (!in_double)
        krylov_single.start(krylov_for(p, false));
    result.start = result.end =
        pressure_residual(p, c, shift, rhs, mean, phi, unit, krylov_for(p, in_double));
    if (result.end > 2.0 * size) { /* worse than none */
        memset(phi, 0, p->g->total * sizeof *phi);
        result.end =
            pressure_residual(p, c, shift, rhs, mean, phi, unit, krylov_for(p, in_double));
    }
    if (result.end > target && p->method == PRESSURE_AUTO && pressure_layered(p, &s, c)) {
        for (; result.iterations < 3 && result.end > target; result.iterations++)
            result.end = solve_directly(p, c, shift, rhs, mean, phi);
    } else {
        if (result.method == PRESSURE_BOX)
            pressure_box_means(p);
        for (; result.end > target && result.iterations < MOST; in_double = true) {
            iterate(p, c, shift, rhs, mean, phi, target, &s, in_double, unit, &result);
            if (in_double)
                break; /* round-off: no better */
            if (result.end > target)
                pressure_residual(p, c, shift, rhs, mean, phi, unit, krylov_for(p, true));
        }
    }
    result.converged = result.end <= target || result.end <= pressure_round_off(p, c, phi);
    pressure_ghosts(p, phi);
    return result;
}

void pressure_feasibility(const struct grid *g, int directions, struct feasibility *f)
{
    for (int a = 0; a < directions; a++)
        if (transform_largest_prime(g->n[a]) > TRANSFORM_QUICK) {
            char name[64], note[96];
            snprintf(name, sizeof name, "cells in %c, largest prime factor", 'x' + a);
            snprintf(note, sizeof note, "%s is quicker with %d cells than with %d",
                     a < 2 ? "the pressure solve" : "implicit viscosity",
                     transform_good_size(g->n[a]), g->n[a]);
            feasibility_add(f, name, "1", transform_largest_prime(g->n[a]), TRANSFORM_QUICK,
                            false, note);
        }
}
