/* verify/test_superquadric.c - superquadrics: support function, volume and inertia against
 * quadrature, the common normal of two against brute force and in turned frames. */
#include <gsl/gsl_rng.h>
#include <stdlib.h>
#include "../solver/superquadric.h"
#include "check.h"

static gsl_rng *rng;

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * gsl_rng_uniform(rng);
}

static vec3 direction(void)
{
    vec3 v;
    do
        v = v3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    while (v3_dot(v, v) > 1.0 || v3_dot(v, v) < 0.01);
    return v3_scale(1.0 / v3_norm(v), v);
}

static struct mat3 turn(void)
{
    const double u[4] = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    return quat_matrix(quat_unit((struct quat){u[0], u[1], u[2], u[3]}));
}

static struct superquadric any(double blockiness)
{
    struct superquadric s;
    const double axes[3] = {uniform(0.3, 1), uniform(0.3, 1), uniform(0.3, 1)};
    const double n1 = blockiness > 2 ? uniform(2, blockiness) : 2;
    const double n2 = blockiness > 2 && uniform(0, 1) < 0.5 ? uniform(2, blockiness) : n1;
    superquadric_set(&s, axes, n1,
                     n2); /* half of them with one exponent, which has its own formulas */
    return s;
}

/* Volume and inertia by slices: sections of z are superellipses of known area and second moments,
 * here by the midpoint rule in a variable that is smooth at the poles. */
static void test_mass(double n1, double n2)
{
    struct superquadric s;
    const double axes[3] = {0.5, 0.8, 1.1};
    double volume = 0, xx = 0, yy = 0, zz = 0, inertia[3];
    superquadric_set(&s, axes, n1, n2);
    superquadric_inertia(&s, inertia);
    enum { N = 400 };
    double area = 0, ax = 0, ay = 0; /* of x^n2 + y^n2 <= 1, one quadrant, with moments */
    for (int k = 0; k < 4000; k++) {
        const double t = (k + 0.5) / 4000 * PI / 2, x = sin(t), y = pow(1 - pow(x, n2), 1 / n2);
        const double w = PI / 2 / 4000 * cos(t);
        area += w * y;
        ax += w * x * x * y;
        ay += w * y * y * y / 3;
    }
    for (int k = 0; k < N; k++) {
        const double t = (k + 0.5) / N * PI / 2, z = sin(t), r = pow(1 - pow(z, n1), 1 / n1);
        const double w = 8 * PI / 2 / N * cos(t);
        volume += w * r * r * area;
        xx += w * pow(r, 4) * ax;
        yy += w * pow(r, 4) * ay;
        zz += w * r * r * area * z * z;
    }
    const double abc = axes[0] * axes[1] * axes[2];
    xx *= abc * axes[0] * axes[0];
    yy *= abc * axes[1] * axes[1];
    zz *= abc * axes[2] * axes[2];
    check_rel(superquadric_volume(&s), volume * abc, 1e-4, "volume by quadrature");
    check_rel(inertia[0], yy + zz, 1e-4, "inertia about x by quadrature");
    check_rel(inertia[1], xx + zz, 1e-4, "inertia about y by quadrature");
    check_rel(inertia[2], xx + yy, 1e-4, "inertia about z by quadrature");
}

/* The supporting point lies on the surface with that normal, and the Hessian is its derivative. */
static void test_support(double blockiness)
{
    double off = 0, wrong = 0, slope = 0, radius = 0;
    for (int k = 0; k < 300; k++) {
        const struct superquadric s = any(blockiness);
        const vec3 n = direction(), t = direction();
        struct symmetric m;
        const vec3 p = superquadric_support_curved(&s, n, &m);
        const double e = 1e-5;
        const vec3 hi = superquadric_support(&s, v3_axpy(n, e, t));
        const vec3 lo = superquadric_support(&s, v3_axpy(n, -e, t));
        const vec3 d = v3_scale(0.5 / e, v3_sub(hi, lo));
        const vec3 mt =
            v3(m.xx * t.x + m.xy * t.y + m.xz * t.z, m.xy * t.x + m.yy * t.y + m.yz * t.z,
               m.xz * t.x + m.yz * t.y + m.zz * t.z);
        off = fmax(off, fabs(superquadric_inside(&s, p)));
        wrong = fmax(wrong, v3_norm(v3_sub(superquadric_normal(&s, p), n)));
        if (fmin(fabs(n.x), fmin(fabs(n.y), fabs(n.z))) > 0.02)
            slope = fmax(slope, v3_norm(v3_sub(d, mt)) / (1 + v3_norm(mt)));
        radius = fmax(radius, v3_norm(p) / superquadric_radius(&s));
    }
    check(off < 1e-14, "blockiness up to %g: points on the surface to %.1e", blockiness, off);
    check(wrong < 1e-12, "blockiness up to %g: their normals to %.1e", blockiness, wrong);
    check(slope < 1e-5, "blockiness up to %g: curvature by differences to %.1e", blockiness,
          slope);
    check(radius < 1 + 1e-14 && radius > 0.95,
          "no point beyond the bounding sphere: %.4f of it", radius);
}

/* The bound without powers lies above the support function, by little. */
static void test_reach(void)
{
    double least = 1e300, most = 0;
    for (int k = 0; k < 3000; k++) {
        const struct superquadric s = any(20);
        const vec3 n = direction();
        const double h = v3_dot(n, superquadric_support(&s, n)),
                     r = superquadric_reach(&s, n) / h;
        least = fmin(least, r);
        most = fmax(most, r);
    }
    check(least > 1 - 1e-14 && most < 1.06, "bound of the support function: %.6f to %.4f of it",
          least, most);
}

static double gap_along(const struct superquadric_placed *i,
                        const struct superquadric_placed *j, vec3 apart, vec3 n)
{
    const struct superquadric_placed *const both[2] = {i, j};
    double gap = v3_dot(n, apart);
    for (int k = 0; k < 2; k++) {
        const vec3 b = mat3_back(&both[k]->turn, n);
        gap -= both[k]->size * v3_dot(b, superquadric_support(both[k]->shape, b));
    }
    return gap;
}

/* Largest gap over all directions: a fine lattice, then shrinking random steps. */
static double brute(const struct superquadric_placed *i, const struct superquadric_placed *j,
                    vec3 apart)
{
    vec3 best = v3(0, 0, 1);
    double most = -1e300, size = 0.05;
    for (int k = 0; k < 4000; k++) {
        const double z = 1 - (2 * k + 1) / 4000.0, r = sqrt(1 - z * z), a = 2.399963 * k;
        const vec3 n = v3(r * cos(a), r * sin(a), z);
        const double gap = gap_along(i, j, apart, n);
        if (gap > most) {
            most = gap;
            best = n;
        }
    }
    for (int k = 0; k < 3000; k++, size *= 0.993) {
        vec3 n = v3_axpy(best, size * uniform(0, 1), direction());
        n = v3_scale(1.0 / v3_norm(n), n);
        const double gap = gap_along(i, j, apart, n);
        if (gap > most) {
            most = gap;
            best = n;
        }
    }
    return most;
}

static void test_pairs(double blockiness, bool deep)
{
    double below = 0, above = 0, line = 0;
    long tries = 0;
    int many = 0;
    enum { PAIRS = 60 };
    for (int k = 0; k < PAIRS; k++) {
        const struct superquadric a = any(blockiness), b = any(blockiness);
        struct superquadric_placed i = {.shape = &a, .size = 1, .turn = turn()},
                                   j = {.shape = &b, .size = 1, .turn = turn()};
        struct superquadric_touch t = {.normal = {0, 0, 0}};
        /* Along a line of centres to a gap, or on to an overlap as deep as a run's: followed from
         * where they are apart, as a run does. */
        const vec3 way = direction();
        double far = 3;
        vec3 apart = v3_scale(far, way);
        superquadric_meet(&i, &j, apart, 10, &t);
        while (t.gap > (deep ? -0.02 : 0.3)) {
            far -= fmax(0.005, 0.5 * t.gap);
            apart = v3_scale(far, way);
            superquadric_meet(&i, &j, apart, 10, &t);
        }
        const double want = brute(&i, &j, apart);
        below = fmax(below, want - t.gap);
        above = fmax(above, fabs(t.gap - gap_along(&i, &j, apart, t.normal)));
        const vec3 between = v3_sub(v3_add(apart, t.at_i), t.at_j);
        line = fmax(line, v3_norm(v3_axpy(between, -t.gap, t.normal)));
        tries += t.tries;
        many = t.tries > many ? t.tries : many;
    }
    check(
        below < 1e-12 && above < 1e-12,
        "blockiness up to %g, %s: gaps of %d pairs, brute force finds at most %.1e more; they "
        "are those of the normals to %.1e (%.1f tries, %d at most)",
        blockiness, deep ? "overlaps" : "apart", PAIRS, below, above, (double)tries / PAIRS,
        many);
    /* On a face of blockiness 10 the point goes as the ninth root of the normal's tilt, of which a
     * double knows 1e-16. */
    check(line < (blockiness > 4 ? 2e-2 : 1e-10), "their points on the common normal to %.1e",
          line);
}

/* Turned as a whole: the same contact; the bodies exchanged: the opposite. */
static void test_frames(void)
{
    double worst = 0, swapped = 0;
    for (int k = 0; k < 100; k++) {
        const struct superquadric a = any(5), b = any(5);
        struct superquadric_placed i = {.shape = &a, .size = 1, .turn = turn()},
                                   j = {.shape = &b, .size = 1, .turn = turn()}, ti = i, tj = j;
        struct superquadric_touch t = {0}, u = {0}, s = {0};
        const struct mat3 frame = turn(), back = mat3_transposed(&frame);
        const vec3 apart = v3_scale(1.4, direction()), turned = mat3_turn(&frame, apart);
        ti.turn = mat3_between(&back, &i.turn);
        tj.turn = mat3_between(&back, &j.turn);
        superquadric_meet(&i, &j, apart, 10, &t);
        superquadric_meet(&ti, &tj, turned, 10, &u);
        superquadric_meet(&j, &i, v3_scale(-1, apart), 10, &s);
        worst = fmax(worst, fabs(t.gap - u.gap));
        swapped = fmax(swapped, fabs(t.gap - s.gap) + v3_norm(v3_add(t.normal, s.normal)));
    }
    check(worst < 1e-12, "turned as a whole: the same gap to %.1e", worst);
    check(swapped < 1e-7, "exchanged: the opposite normal, the same gap to %.1e", swapped);
}

/* Spheres, and the curvature of ellipsoids at their poles. */
static void test_exact(void)
{
    struct superquadric a, b, e;
    const double one[3] = {1, 1, 1}, long_[3] = {1, 1, 2};
    struct superquadric_touch t = {0};
    superquadric_set(&a, one, 2, 2);
    superquadric_set(&b, one, 2, 2);
    superquadric_set(&e, long_, 2, 2);
    struct superquadric_placed i = {.shape = &a, .size = 1, .turn = turn()},
                               j = {.shape = &b, .size = 1, .turn = turn()},
                               up = {.shape = &e, .size = 1, .turn = turn()};
    const vec3 n = direction();
    j.size = 0.5;
    superquadric_meet(&i, &j, v3_scale(1.45, n), 1, &t);
    check_abs(t.gap, -0.05, 1e-15, "spheres: depth");
    check_abs(v3_norm(v3_sub(t.normal, n)), 0, 1e-15, "spheres: normal");
    check_abs(v3_norm(v3_axpy(t.at_i, 1.0, n)), 0, 1e-14, "spheres: point");
    check_rel(t.r_eff, 1.0 / 3.0, 1e-14, "spheres: reduced radius");
    const vec3 axis = mat3_turn(&up.turn, v3(0, 0, 1));
    t = (struct superquadric_touch){0};
    superquadric_meet(&up, &j, v3_scale(2.4, axis), 1, &t);
    check_abs(t.gap, -0.1, 1e-14, "a sphere on the tip of an ellipsoid: depth");
    check_rel(t.r_i, 0.5, 1e-12, "radius of its tip b^2/c");
    const vec3 side = mat3_turn(&up.turn, v3(1, 0, 0));
    t = (struct superquadric_touch){0};
    superquadric_meet(&up, &j, v3_scale(1.4, side), 1, &t);
    check_rel(t.r_i, 2.0, 1e-12, "root of the radii 1 and 4 of its side");
    check_rel(t.r_eff, 1.0 / sqrt((1 + 2) * (0.25 + 2)), 1e-12, "reduced radius at its side");
}

/* Areas: exact for a spheroid; Cauchy's theorem, surface = 4 mean shadows. */
static void test_areas(void)
{
    struct superquadric s;
    const double flat[3] = {1, 1, 0.5}, axes[3] = {0.7, 1, 1.2}, e = sqrt(0.75);
    superquadric_set(&s, flat, 2, 2);
    check_rel(superquadric_area(&s), 2 * PI * (1 + 0.25 / e * atanh(e)), 1e-3,
              "surface of an oblate spheroid");
    check_rel(superquadric_shadow(&s, v3(1, 0, 0)), PI * 0.5, 1e-12,
              "its shadow from the side");
    superquadric_set(&s, axes, 5, 3);
    double mean = 0;
    enum { N = 3000 };
    for (int k = 0; k < N; k++) {
        const double z = 1 - (2 * k + 1) / (double)N, r = sqrt(1 - z * z), a = 2.39996323 * k;
        mean += superquadric_shadow(&s, v3(r * cos(a), r * sin(a), z)) / N;
    }
    check_rel(superquadric_area(&s), 4 * mean, 2e-3, "surface and mean shadow");
}

int main(void)
{
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    test_mass(2, 2);
    test_mass(5, 3);
    test_mass(2.5, 8);
    test_support(2);
    test_support(8);
    test_reach();
    test_exact();
    test_areas();
    test_frames();
    test_pairs(2, false);
    test_pairs(2, true);
    test_pairs(4, false);
    test_pairs(4, true);
    test_pairs(10, true);
    gsl_rng_free(rng);
    return check_end();
}
