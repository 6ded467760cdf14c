/* region.c - averages over a box.
 *
 *   sigma_ab = 1/V [ sum over contacts of w f_a l_b + sum over grains of m v'_a v'_b ]
 *
 * Love and Weber's stress [Weber66] with the kinetic part [Goldhirsch10], compression positive: f
 * the force on a grain, l the branch to its centre from that of the other, w the part of the branch
 * that lies in the box, so that in equilibrium a layer bears exactly what lies above it; v' the
 * velocity relative to the mean of the box. Fabric F_ab = <n_a n_b> over the contacts whose points
 * lie inside [Satake82]. Sums go in the order of contacts and grains. */
#include "region.h"

#include <gsl/gsl_eigen.h>
#include <string.h>
#include "contact_view.h"
#include "sim.h"
#include "sphere_box.h"

/* Part of the segment x .. x + d that lies in the box. */
static double part_inside(const struct region *r, vec3 x, vec3 d)
{
    const double at[3] = {x.x, x.y, x.z}, way[3] = {d.x, d.y, d.z};
    const double lo[3] = {r->from.x, r->from.y, r->from.z};
    const double hi[3] = {r->to.x, r->to.y, r->to.z};
    double enter = 0.0, leave = 1.0;
    for (int a = 0; a < 3; a++) {
        if (way[a] == 0.0) {
            if (at[a] < lo[a] || at[a] >= hi[a])
                return 0.0;
            continue;
        }
        const double p = (lo[a] - at[a]) / way[a], q = (hi[a] - at[a]) / way[a];
        enter = fmax(enter, fmin(p, q));
        leave = fmin(leave, fmax(p, q));
    }
    return fmax(0.0, leave - enter);
}

/* Images of a place along periodic directions in which the box is not whole: -1, 0, 1 times the
 * size; elsewhere the one place. */
static int images(const struct sim *s, const struct region *r, int a)
{
    const double lo = a == 0 ? r->from.x : a == 1 ? r->from.y : r->from.z;
    const double hi = a == 0 ? r->to.x : a == 1 ? r->to.y : r->to.z;
    const double size = s->domain.size[a];
    return s->domain.periodic[a] && hi - lo < size * (1.0 - 1e-12) ? 1 : 0;
}

/* A box that spans a periodic direction holds all of it, wherever its places are written. */
static struct region widened(const struct sim *s, const struct region *r)
{
    struct region w = *r;
    double *const lo[3] = {&w.from.x, &w.from.y, &w.from.z};
    double *const hi[3] = {&w.to.x, &w.to.y, &w.to.z};
    for (int a = 0; a < 3; a++)
        if (s->domain.periodic[a] && images(s, r, a) == 0) {
            *lo[a] = -(double)INFINITY;
            *hi[a] = (double)INFINITY;
        }
    return w;
}

static double part_of_segment(const struct sim *s, const struct region *w, const int n[3],
                              vec3 x, vec3 d)
{
    const double *const size = s->domain.size;
    double part = 0.0;
    for (int k = -n[2]; k <= n[2]; k++)
        for (int j = -n[1]; j <= n[1]; j++)
            for (int i = -n[0]; i <= n[0]; i++)
                part += part_inside(w, v3_add(x, v3(i * size[0], j * size[1], k * size[2])), d);
    return part;
}

static bool inside(const struct region *r, vec3 x)
{
    return x.x >= r->from.x && x.x < r->to.x && x.y >= r->from.y && x.y < r->to.y &&
           x.z >= r->from.z && x.z < r->to.z;
}

static bool holds(const struct sim *s, const struct region *w, vec3 x)
{
    return inside(w, domain_wrap(&s->domain, x));
}

static void add_outer(double m[3][3], double weight, vec3 a, vec3 b)
{
    const double p[3] = {a.x, a.y, a.z}, q[3] = {b.x, b.y, b.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] += weight * p[i] * q[j];
}

/* m3; of grain i in the box, as of a sphere of its volume. */
static double volume_inside(const struct sim *s, const struct region *r, const int n[3], int i)
{
    const double *const size = s->domain.size;
    const vec3 x = domain_wrap(&s->domain, s->grains.pos[i]);
    const double radius = cbrt(3.0 * s->grains.volume[i] / (4.0 * 3.14159265358979323846));
    double volume = 0.0;
    vec3 lo = r->from, hi = r->to;
    double *const l[3] = {&lo.x, &lo.y, &lo.z}, *const h[3] = {&hi.x, &hi.y, &hi.z};
    for (int a = 0; a < 3; a++) /* open where the whole periodic box is meant */
        if (s->domain.periodic[a] && n[a] == 0) {
            *l[a] = -size[a];
            *h[a] = 2.0 * size[a];
        }
    for (int c = -n[2]; c <= n[2]; c++)
        for (int b = -n[1]; b <= n[1]; b++)
            for (int a = -n[0]; a <= n[0]; a++) {
                const vec3 at = v3_add(x, v3(a * size[0], b * size[1], c * size[2]));
                if (at.x + radius <= lo.x || at.x - radius >= hi.x || at.y + radius <= lo.y ||
                    at.y - radius >= hi.y || at.z + radius <= lo.z || at.z - radius >= hi.z)
                    continue;
                volume += sphere_box_overlap(at, radius, lo, hi);
            }
    return volume;
}

static void measure_grains(const struct sim *s, struct region *r, const struct region *w,
                           const int n[3], vec3 *velocity)
{
    const struct grains *const g = &s->grains;
    double mass = 0.0, solid = 0.0;
    vec3 momentum = v3(0.0, 0.0, 0.0);
    r->grains = 0.0;
    for (int i = 0; i < g->n; i++) {
        solid += volume_inside(s, r, n, i);
        if (!holds(s, w, g->pos[i]))
            continue;
        r->grains += 1.0;
        mass += g->mass[i];
        momentum = v3_axpy(momentum, g->mass[i], g->vel[i]);
    }
    r->solid = solid / r->volume;
    *velocity = mass > 0.0 ? v3_scale(1.0 / mass, momentum) : v3(0.0, 0.0, 0.0);
    for (int i = 0; i < g->n; i++)
        if (g->inv_mass[i] != 0.0 && holds(s, w, g->pos[i])) {
            const vec3 v = v3_sub(g->vel[i], *velocity);
            add_outer(r->kinetic, g->mass[i] / r->volume, v, v);
        }
}

static void measure_contacts(const struct sim *s, const struct contact_view *v,
                             struct region *r, const struct region *w, const int n[3])
{
    double ends = 0.0;
    for (size_t k = 0; k < v->n; k++) {
        const struct seen *const c = &v->seen[k];
        const vec3 x = s->grains.pos[c->i], back = v3_scale(-1.0, c->branch);
        const double part = part_of_segment(s, w, n, x, back);
        add_outer(r->stress, part / r->volume, c->force, c->branch);
        if (c->depth < 0.0 && v3_dot(c->force, c->force) == 0.0)
            continue;
        ends += holds(s, w, x);
        ends += c->j >= 0 && holds(s, w, s->grains.pos[c->j]);
        if (!holds(s, w, c->point))
            continue;
        r->contacts += 1.0;
        add_outer(r->fabric, 1.0, c->normal, c->normal);
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            r->stress[a][b] += r->kinetic[a][b];
            r->fabric[a][b] = r->contacts > 0.0 ? r->fabric[a][b] / r->contacts : 0.0;
        }
    r->coordination = r->grains > 0.0 ? ends / r->grains : 0.0;
}

/* sqrt(3/2 m':m') of the symmetric part. */
static double deviator(double m[3][3])
{
    const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const double x = 0.5 * (m[a][b] + m[b][a]) - (a == b ? mean : 0.0);
            sum += x * x;
        }
    return sqrt(1.5 * sum);
}

static void principal(double m[3][3], double out[3])
{
    double sym[9], value[3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            sym[3 * a + b] = 0.5 * (m[a][b] + m[b][a]);
    gsl_matrix_view matrix = gsl_matrix_view_array(sym, 3, 3);
    gsl_vector_view vector = gsl_vector_view_array(value, 3);
    gsl_eigen_symm_workspace *const work = gsl_eigen_symm_alloc(3);
    if (!work)
        die(EXIT_WRITE, "no memory");
    gsl_eigen_symm(&matrix.matrix, &vector.vector, work);
    gsl_eigen_symm_free(work);
    out[0] = fmax(value[0], fmax(value[1], value[2]));
    out[2] = fmin(value[0], fmin(value[1], value[2]));
    out[1] = value[0] + value[1] + value[2] - out[0] - out[2];
}

void region_measure(const struct sim *s, const struct contact_view *v, struct region *r)
{
    const int n[3] = {images(s, r, 0), images(s, r, 1), images(s, r, 2)};
    const struct region w = widened(s, r);
    const double zero[3][3] = {{0.0}};
    memcpy(r->stress, zero, sizeof zero);
    memcpy(r->kinetic, zero, sizeof zero);
    memcpy(r->fabric, zero, sizeof zero);
    r->contacts = 0.0;
    measure_grains(s, r, &w, n, &r->velocity);
    measure_contacts(s, v, r, &w, n);
    principal(r->stress, r->principal);
    r->pressure = (r->stress[0][0] + r->stress[1][1] + r->stress[2][2]) / 3.0;
    r->deviator = deviator(r->stress);
    r->ratio = r->pressure != 0.0 ? r->deviator / r->pressure : 0.0;
    const double sum = r->principal[0] + r->principal[2];
    const double sine = sum > 0.0 ? (r->principal[0] - r->principal[2]) / sum : 0.0;
    r->friction_angle = asin(fmin(fmax(sine, -1.0), 1.0)) * 180.0 / 3.14159265358979323846;
    r->anisotropy = deviator(r->fabric);
}
