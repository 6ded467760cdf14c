/* forces/viscous_torque.c - the fluid's torque on a grain that spins otherwise than the fluid around it.
 *
 *   T = (rho/2) (d/2)^5 C_R |W| W,    W = curl u/2 - omega
 *   C_R = 64 pi/Re_W                           Re_W = rho d^2 |W|/mu < 32  (T = pi mu d^3 W) [Lamb32]
 *   C_R = 12.9/sqrt(Re_W) + 128.4/Re_W         32 to 4000                    [Dennis80]
 * The two forms meet at Re_W = 31.7, which is where they are switched here: no jump. The second is a fit
 * of solutions of the flow, to 0.3 % from Re_W = 80 on and held good to 4000 (20 and 1000 on the radius);
 * between 8 and 80 the law is up to 5 % low, since the torque leaves the creeping form as
 * 1 + Re_W^2/19200 (verify/reference/rotating_sphere.csv).
 *
 * It acts on the grain only: the fluid, whose equation has no couple stress, keeps its momentum. */
#include "force.h"

static const struct key keys[] = {{0}};

static double rate(const struct force_view *v)
{
    const double pi = 3.14159265358979323846;
    const double creeping = pi * v->mu * v->d * v->d * v->d;
    const double w = v3_norm(v3_axpy(v3_scale(-1.0, v->spin), 0.5, v->curl));
    if (!(v->mu > 0.0))
        return 0.0;
    const double re = v->rho * v->d * v->d * w / v->mu;
    /* C_R Re_W over that of the creeping form; it is 1 where the larger form takes over */
    const double fitted = (12.9 * sqrt(re) + 128.4) / (64.0 * pi);
    return creeping * fmax(1.0, fitted);
}

const struct force force_viscous_torque = {
    .about = {.name = "viscous_torque",
              .summary = "the fluid's torque on a spinning grain, implicit",
              .equation = "T = (rho/2)(d/2)^5 C_R |W| W; pi mu d^3 W at small Re_W",
              .source = "[Lamb32, art. 334]; [Dennis80]",
              .range = "rho d^2 |W|/mu < 4000",
              .cost = "two roots"},
    .keys = keys,
    .spin_rate = rate,
};
