/* drag/drag.h - contract: what resists the flow through or past the grains?
 *
 * To add a law: copy none.c to drag/NAME.c and write `drag = NAME`. Every answer exports
 * exactly the symbols below. Formulas that several laws share are in formulas.h.
 *
 * One normalisation for all laws (shared by both fluid solvers):
 *   F_d   drag on one grain, WITHOUT the pressure-gradient force (model A, form 27a)
 *   eps   fluid fraction; u_r interstitial slip speed |u_f - v_p|
 *   Re  = rho eps u_r d / mu   (superficial slip, volume-equivalent diameter)
 *   Fhat(eps, Re) = F_d / (3 pi mu d eps u_r)        -> 1 for an isolated sphere as Re -> 0
 *   beta = 18 mu eps (1 - eps) Fhat / d^2            kg/(m3 s), per volume of mixture
 *   k    = mu eps^2 / beta = eps d^2 / (18 (1 - eps) Fhat)   m2, permeability implied
 * For an isolated grain Fhat = C_D Re/24, C_D = F/(pi d^2 rho U^2/8).
 * A law must be finite and positive for every eps in (0, 1] and every Re >= 0 (evaluate C_D Re,
 * never C_D, at small Re), in its range or out of it. Laws are pure functions, called from
 * parallel loops. */
#ifndef DRAG_H
#define DRAG_H

#include "../solver/scene.h"

enum { DRAG_OWN = 6 };

/* The numbers of a grain's shape that a law reads; a scene that gives others is refused. */
enum drag_shape {
    DRAG_SPHERICITY = 1,
    DRAG_CROSSWISE = 2,
    DRAG_LENGTHWISE = 4,
    DRAG_CIRCULARITY = 8
};

/* A grain as the laws see it, one per species; of a sphere all four numbers of shape are 1. */
struct drag_grain {
    double sphericity;    /* surface of the sphere of equal volume over its own, (0, 1] */
    double crosswise;     /* section of that sphere over its area seen along the slip, > 0 */
    double lengthwise;    /* section of that sphere over (half its own surface - mean area seen
                             along it), > 0 */
    double circularity;   /* of its outline, >= 1 */
    double density_ratio; /* grain over fluid */
    double d10;           /* m; 10 % of the volume of all grains of the scene is smaller */
    double own[DRAG_OWN]; /* what the law makes of these, once: see drag_prepare */
};

struct drag_point {
    double eps;                     /* fluid fraction, (0, 1] */
    double re;                      /* Reynolds number as above, >= 0 */
    double d;                       /* m, volume-equivalent diameter */
    double y;                       /* d over the Sauter mean diameter of the grains around */
    const struct drag_grain *grain; /* prepared */
};

/* Where a law holds, and what it asks for; a run counts the grains outside. */
struct drag_limits {
    double eps_min, eps_max; /* fluid fraction */
    double re_min, re_max;   /* of Re; 0: it keeps its creeping limit below the data it was
                                fitted to; INFINITY: no limit */
    bool per_solid;          /* re_max is of Re/(1 - eps) */
    unsigned shape;          /* sum of enum drag_shape; 0: it takes grains for spheres */
    bool sauter;             /* it reads y */
    double jump;             /* largest relative jump of Fhat in this range, 0: continuous */
    double isolated;         /* Fhat of a sphere at eps = 1 as Re -> 0; 0: the law has none */
};

extern const struct about drag_about;
extern const struct key drag_keys[]; /* of section "drag" */
extern const struct drag_limits drag_limits;

void drag_init(struct scene *s);
/* Fills grain->own from the rest of it; after drag_init, once per species, before any
 * drag_factor. */
void drag_prepare(struct drag_grain *grain);
double drag_factor(const struct drag_point *p); /* Fhat; 0 for `none` */

static inline double drag_reynolds(double eps, double slip, double d, double rho, double mu)
{
    return rho * eps * slip * d / mu;
}

/* kg/s: F_d = kappa (u_f - v_p) on the grain. */
static inline double drag_kappa(const struct drag_point *p, double mu)
{
    return 3.0 * 3.14159265358979323846 * mu * p->d * p->eps * drag_factor(p);
}

static inline bool drag_outside(const struct drag_point *p)
{
    const double re_max =
        drag_limits.per_solid ? drag_limits.re_max * (1.0 - p->eps) : drag_limits.re_max;
    return p->eps < drag_limits.eps_min || p->eps > drag_limits.eps_max ||
           p->re < drag_limits.re_min || p->re > re_max;
}

#endif
