/* drag/wang.c - Wang, Zhou and Yang's grains of calcareous sand, in Di Felice's voidage
 * function [WangZhouYang19, DiFelice94].
 *
 *   Fhat  = 0.945 Psi^-theta Re^-0.01 (C_D,s Re/24) eps^-chi,   C_D,s and chi as in di_felice.c
 *   theta = 0.641 Re^0.153,   Psi = Phi/X: sphericity over the circularity X >= 1 of the outline
 *
 * The review's Table 4 is what was read of it; it does not say whose sphere C_D,s is, and
 * Dallavalle's is taken, as there. Psi = 1 does not give the sphere back: 0.945 Re^-0.01. The
 * two powers are fits and nothing more: in them (not in C_D,s) Re counts as 0.1 at least and
 * 1000 at most, 0.1 so that Re -> 0 stays finite. A creeping isolated sphere then feels 0.928
 * of Stokes'. */
#include "drag.h"

#include "formulas.h"

enum { LOG_PSI };

#define LOG_LEAST (-2.30258509299404568402) /* of 0.1 */
#define LOG_MOST  6.90775527898213705205    /* of 1000 */

const struct about drag_about = {
    .name = "wang",
    .summary = "Wang, Zhou and Yang's calcareous sand, shape in Di Felice's law",
    .equation = "Fhat = 0.945 Psi^-theta Re^-0.01 (C_D Re/24) eps^-chi, theta = 0.641 "
                "Re^0.153, Psi = sphericity/circularity",
    .source = "[WangZhouYang19]; [DiFelice94]",
    .range = "eps 0.4 to 1, 1 < Re < 1000",
    .cost = "two logarithms and three exponentials: shape, eps and Re to powers that follow "
            "log Re"};
const struct drag_limits drag_limits = {.eps_min = 0.4,
                                        .eps_max = 1.0,
                                        .re_min = 1.0,
                                        .re_max = 1000.0,
                                        .shape = DRAG_SPHERICITY | DRAG_CIRCULARITY,
                                        .isolated = 0.9283314025971};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    grain->own[LOG_PSI] = log(grain->sphericity / grain->circularity);
}

double drag_factor(const struct drag_point *p)
{
    const bool moves = p->re > 1e-12;
    const double log_of = log(moves ? p->re : 1.0);
    const double log_re = fmin(fmax(moves ? log_of : -1e3, LOG_LEAST), LOG_MOST);
    const double theta = 0.641 * exp(0.153 * log_re);
    const double chi = 3.7 - (moves ? 0.65 * intermediate_of(log_of) : 0.0);
    const double shape =
        exp(-theta * p->grain->own[LOG_PSI] - 0.01 * log_re - chi * log(p->eps));
    return 0.945 * shape * sphere_dallavalle(p->re);
}
