/* contact_rocking.c - what damps two faces that rock on each other.
 *
 * Faces of polyhedra are crowned a little (shapes/geometry/crown.h), so that the force has a
 * potential: such faces roll on each other, and what rights them is the load times the crown's
 * radius, hundreds of times less than what flat faces would bear. The dashpot of the normal force
 * alone, spread over the patch, then hardly damps a tower that sways. So the patch has the dashpot
 * of rocking that flat faces would have at the damping ratio of the law. With k and c the stiffness
 * and the dashpot of the normal force, a rigid flat punch of radius s on an elastic half-space
 * resists to rocking by
 *   K = 4/3 E* s^3                                                            [Johnson85, chapter 3]
 * and k = 2 E* sqrt(R* depth), so that with the reduced inertia I* about the contact, rho^2 = I* / m*,
 *   C / c = sqrt(K I* / (k m*)) = rho sqrt(2/3 s^3 / sqrt(R* depth)).
 * s: how far the points that stand for the patch are from its middle; as each bears its share of
 * the couple at its lever, with the variance s^2/2, the dashpot at the point is 2 C/s^2. Of it c is
 * there already.
 *
 * The couple is what a force E along the normal at the point, and its opposite at the middle, give:
 *   E = - (2 C/s^2 - c) u / (1 + C dt / I*),   u = n . (spin x lever),
 * implicit over the step, stable for any, and |E| <= F_n - c |u|, by which the couple of all is at
 * most F_n s: the middle of the pressure stays within the patch. E u <= 0: it only takes energy. */
#include "contact_points.h"

#include "../contact/contact.h"
#include "sim.h"

void points_rock(const struct sim *s, struct block *b)
{
    struct touch *const t = &b->t;
    real damping[TOUCH];
    contact_damping(t, damping);
    laws_inertia(&s->grains, b);
    for (int c = 0; c < b->n; c++) {
        const vec3 n = v3((double)t->nx[c], (double)t->ny[c], (double)t->nz[c]);
        const vec3 spin = v3((double)t->wx[c], (double)t->wy[c], (double)t->wz[c]);
        const double own = (double)damping[c], inertia = (double)t->inertia[c];
        const double square = v3_dot(b->lever[c], b->lever[c]), depth = (double)t->depth[c];
        b->couple[c] = v3(0.0, 0.0, 0.0);
        if (!(square > 0.0) || !(depth > 0.0) || !(own > 0.0))
            continue;
        const double whole = own * sqrt(inertia / (double)t->m_eff[c] * (2.0 / 3.0) * square *
                                        sqrt(square) / sqrt((double)t->r_eff[c] * depth));
        const double more = fmax(2.0 * whole / square - own, 0.0);
        const double u = v3_dot(n, v3_cross(spin, b->lever[c]));
        const double most = fmax((double)t->fn[c] - own * fabs(u), 0.0);
        const double force = -more * u / (1.0 + whole * t->dt / inertia);
        b->couple[c] = v3_scale((double)b->share[c] * fmin(fmax(force, -most), most),
                                v3_cross(b->lever[c], n));
    }
}

void points_add_rocking(struct block *b)
{
    for (int c = 0; c < b->n; c++) {
        const real m[3] = {(real)b->couple[c].x, (real)b->couple[c].y, (real)b->couple[c].z};
        for (int a = 0; a < 3; a++) {
            b->on[0][c][4 + a] += m[a];
            b->on[1][c][4 + a] -= m[a];
        }
    }
}
