/* drag/gidaspow.c - Ergun's law in dense, Wen and Yu's in dilute regions, switched
 * [Gidaspow94].
 *
 *   Fhat = [150 (1-eps) + 1.75 Re]/(18 eps^2)     eps <= 0.8     [Ergun52]
 *        = (C_D Re/24) eps^-3.65                  eps >  0.8     [WenYu66, SchillerNaumann35]
 *
 * Not continuous at eps = 0.8: from 2.60 to 2.26 at Re = 0, from 8.68 to 6.53 at Re = 40.
 * gidaspow_blend is the smooth form. Programs differ in the side on which 0.8 itself falls:
 * here, as in the review, on Ergun's. The review's row "Wen & Yu" means this law; its
 * misprints are listed in wen_yu.c. */
#include "drag.h"

#include "formulas.h"

const struct about drag_about = {
    .name = "gidaspow",
    .summary = "Ergun's law up to eps = 0.8, Wen and Yu's above",
    .equation =
        "Fhat = [150 (1-eps) + 1.75 Re]/(18 eps^2), eps <= 0.8; (C_D Re/24) eps^-3.65 above",
    .source = "[Gidaspow94]; [Ergun52]; [WenYu66]",
    .range =
        "eps 0.35 to 1, Re < 2e5 (beds: Re/(1-eps) < 2500); jumps at eps = 0.8 by up to 73 %",
    .cost = "Wen and Yu's two powers for the part of grains in dilute flow"};
const struct drag_limits drag_limits = {
    .eps_min = 0.35, .eps_max = 1.0, .re_max = 2e5, .jump = 0.7325, .isolated = 1.0};
const struct key drag_keys[] = {{0}};

void drag_init(struct scene *s)
{
    (void)s;
}

void drag_prepare(struct drag_grain *grain)
{
    (void)grain;
}

double drag_factor(const struct drag_point *p)
{
    return p->eps <= 0.8 ? packed_ergun(p->eps, p->re)
                         : sphere_schiller_naumann(p->re) * voidage(p->eps, 3.65);
}
