/* verify/test_porosity.c - the volume of a sphere in a box, and every answer of porosity/.
 *
 * The exact overlap is compared with an adaptive quadrature over the height of the box (the
 * area of a disc in a rectangle, by another formula than the program's), and with the volume of
 * the sphere when the boxes of a grid cover it. The contract, for every answer there is, between walls,
 * in corners, in periodic boxes and in boxes one cell thick: shares are positive, sum to 1, name
 * interior cells, fit the room asked for; what grains of any place put on the grid is their volume;
 * what a grain feels of a field is what it would put there (the same weights both ways, the Gaussian
 * included); grains that fill a box evenly give an even fluid fraction up to its walls. How well a
 * field linear in space is felt is printed; answers that promise it exactly are held to it. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_rng.h>
#include "../porosity/porosity.h"
#include "../solver/base.h"
#include "../solver/diffuse.h"
#include "../solver/sphere_box.h"
#include "../solver/spread.h"
#include "answers.h"

static const double pi = 3.14159265358979323846;

struct cut {
    vec3 centre, lo, hi;
    double radius, r; /* m; r: of the disc at the height at hand */
};

/* Length of the chord at x inside lo.y..hi.y, for a disc of radius r. */
static double chord(double x, void *params)
{
    const struct cut *const c = params;
    const double dx = x - c->centre.x;
    const double half = sqrt(fmax(0.0, c->r * c->r - dx * dx));
    const double from = fmax(c->lo.y, c->centre.y - half),
                 to = fmin(c->hi.y, c->centre.y + half);
    return fmax(0.0, to - from);
}

/* Integral of sqrt(r^2 - x^2) from a to b, for |a|, |b| <= r. */
static double under_arc(double r, double a, double b)
{
    const double at_b = b * sqrt(fmax(0.0, r * r - b * b)) + r * r * asin(fmin(1.0, b / r));
    const double at_a = a * sqrt(fmax(0.0, r * r - a * a)) + r * r * asin(fmax(-1.0, a / r));
    return 0.5 * (at_b - at_a);
}

/* Sorts a few numbers. */
static void sort(double *x, int n)
{
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && x[j] < x[j - 1]; j--) {
            const double swap = x[j];
            x[j] = x[j - 1];
            x[j - 1] = swap;
        }
}

/* Area of the disc at height z inside the rectangle: between the x at which the chord changes
 * its form, it is an arc's area, a rectangle, or both. */
static double slice(double z, void *params)
{
    struct cut c = *(const struct cut *)params;
    const double dz = z - c.centre.z, r2 = c.radius * c.radius - dz * dz;
    if (r2 <= 0.0)
        return 0.0;
    c.r = sqrt(r2);
    double x[7] = {fmax(c.lo.x - c.centre.x, -c.r), fmin(c.hi.x - c.centre.x, c.r)};
    int n = 2;
    if (x[0] >= x[1])
        return 0.0;
    const double edge[2] = {c.lo.y - c.centre.y, c.hi.y - c.centre.y};
    for (int e = 0; e < 2; e++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double at = sign * sqrt(fmax(0.0, r2 - edge[e] * edge[e]));
            if (at > x[0] && at < x[1] && fabs(edge[e]) < c.r)
                x[n++] = at;
        }
    sort(x, n);
    double area = 0.0;
    for (int i = 0; i + 1 < n; i++) {
        const double a = x[i], b = x[i + 1], mid = 0.5 * (a + b);
        const double half = sqrt(fmax(0.0, r2 - mid * mid));
        if (chord(c.centre.x + mid, &c) <= 0.0)
            continue;
        area += edge[1] < half ? edge[1] * (b - a) : under_arc(c.r, a, b);
        area -= edge[0] > -half ? edge[0] * (b - a) : -under_arc(c.r, a, b);
    }
    return area;
}

/* Volume, piece by piece between the heights at which the slice changes its form: where a plane
 * or an edge of the box leaves the sphere. */
static double quadrature(gsl_integration_workspace *w, struct cut *c)
{
    const double ex[2] = {c->lo.x - c->centre.x, c->hi.x - c->centre.x};
    const double ey[2] = {c->lo.y - c->centre.y, c->hi.y - c->centre.y};
    const double lo = fmax(c->lo.z, c->centre.z - c->radius);
    const double hi = fmin(c->hi.z, c->centre.z + c->radius);
    const gsl_function f = {.function = slice, .params = c};
    double z[18] = {lo, hi}, volume = 0.0;
    int n = 2;
    for (int m = 1; m < 9; m++) { /* planes in x (m / 3), in y (m % 3), and both */
        const double x = m / 3 > 0 ? ex[m / 3 - 1] : 0.0, y = m % 3 > 0 ? ey[m % 3 - 1] : 0.0;
        const double at = sqrt(fmax(0.0, c->radius * c->radius - x * x - y * y));
        for (int sign = -1; sign <= 1; sign += 2)
            if (c->centre.z + sign * at > lo && c->centre.z + sign * at < hi)
                z[n++] = c->centre.z + sign * at;
    }
    sort(z, n);
    for (int i = 0; i + 1 < n && lo < hi; i++) {
        double piece, error;
        gsl_integration_qags(&f, z[i], z[i + 1], 1e-13 * pow(c->radius, 3), 1e-12, 2000, w,
                             &piece, &error);
        volume += piece;
    }
    return volume;
}

static double uniform(gsl_rng *rng, double a, double b)
{
    return a + (b - a) * gsl_rng_uniform(rng);
}

static void test_overlap(gsl_rng *rng)
{
    gsl_integration_workspace *const w = gsl_integration_workspace_alloc(2000);
    double worst = 0.0;
    int partial = 0;
    for (int t = 0; t < 1000; t++) {
        const double r = pow(10.0, uniform(rng, -5.0, 0.0)), size = uniform(rng, 0.1, 2.0);
        struct cut c = {.radius = r};
        c.centre =
            v3(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0));
        c.lo = v3_axpy(
            c.centre, r,
            v3(uniform(rng, -1.3, 0.9), uniform(rng, -1.3, 0.9), uniform(rng, -1.3, 0.9)));
        if (t % 4 == 0) /* one face just touches the sphere, or nearly */
            c.lo.x = c.centre.x - r * (1.0 + uniform(rng, -1.0, 1.0) * pow(10.0, -(t % 16)));
        if (t % 4 == 1) /* an edge passes through the surface */
            c.lo.y = c.centre.y + sqrt(fmax(0.0, r * r - pow(c.lo.x - c.centre.x, 2)));
        c.hi = v3_add(c.lo, v3_scale(size * r, v3(1.0, uniform(rng, 0.5, 2.0), 1.0)));
        const double got = sphere_box_overlap(c.centre, r, c.lo, c.hi);
        const double all = 4.0 / 3.0 * pi * r * r * r, want = quadrature(w, &c);
        worst = fmax(worst, fabs(got - want) / all);
        partial += want > 0.0 && want < all;
    }
    gsl_integration_workspace_free(w);
    check(worst < 1e-9, "overlap against quadrature: 1000 boxes (%d cut), largest error %.1e",
          partial, worst);
    check_abs(ball_octant(0.0, 0.0, 0.0), 0.125, 1e-16, "an eighth");
    check_abs(ball_wedge(1.0, 0.0), 0.0, 1e-16, "tangent plane");
    check_rel(ball_octant(-0.3, -2.0, -5.0), 0.25 * 1.3 * 1.3 * 1.7, 1e-14, "a cap");
}

/* Boxes of a grid that cover a sphere hold all of it. */
static void test_cover(gsl_rng *rng)
{
    double worst = 0.0;
    for (int t = 0; t < 1000; t++) {
        const double r = uniform(rng, 0.05, 2.4);
        vec3 x = v3(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0));
        if (t % 5 == 0) /* centre on a corner of the grid */
            x = v3(0.0, 0.0, 0.0);
        double sum = 0.0;
        for (int k = -4; k < 4; k++)
            for (int j = -4; j < 4; j++)
                for (int i = -4; i < 4; i++)
                    sum += sphere_box_overlap(x, r, v3(i, j, k), v3(i + 1, j + 1, k + 1));
        worst = fmax(worst, fabs(sum / (4.0 / 3.0 * pi * r * r * r) - 1.0));
    }
    check(worst < 1e-12, "1000 spheres covered by 512 boxes: largest relative error %.1e",
          worst);
}

struct answer {
    const char *name;
    int (*reach)(const struct grid *g, double radius);
    int (*shares)(const struct grid *g, const struct domain *d, const struct grains *grains,
                  int i, struct share *out);
    struct diffuse *(*diffusion)(const struct grid *g, const struct domain *d, double radius);
    void (*init)(struct scene *s);
    const struct key *keys;
    const int *displaces;
};

enum { GRAINS = 3000 };
static vec3 positions[GRAINS];
static double radii[GRAINS];

static bool interior(const struct grid *g, int c)
{
    const int i = c % g->sj, j = c / g->sj % (g->n[1] + 2), k = c / g->sk;
    return i >= 1 && i <= g->n[0] && j >= 1 && j <= g->n[1] && k >= 1 && k <= g->n[2];
}

/* Grains anywhere in the box, against its sides, a little outside, and on the planes of cells.
 */
static double place_grains(gsl_rng *rng, const struct domain *d, const struct grid *g)
{
    double volume = 0.0;
    for (int n = 0; n < GRAINS; n++) {
        double x[3];
        radii[n] = g->h[0] * pow(10.0, uniform(rng, -2.0, 0.3));
        for (int a = 0; a < 3; a++) {
            x[a] = uniform(rng, -0.05, 1.05) * d->size[a];
            if (n % 7 == a)
                x[a] = g->h[a] * (double)gsl_rng_uniform_int(rng, (unsigned long)g->n[a] + 1);
            if (n % 11 == a)
                x[a] = radii[n];
        }
        positions[n] = v3(x[0], x[1], x[2]);
        volume += 4.0 / 3.0 * pi * pow(radii[n], 3);
    }
    return volume;
}

static void test_answer(const struct answer *answer, const struct domain *d, const char *what)
{
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    struct grid g;
    grid_create(&g, d);
    const double volume = place_grains(rng, d, &g);
    const struct grains grains = {.n = GRAINS, .pos = positions, .radius = radii};
    double worst = 0.0, least = 1.0;
    int outside = 0, reach = 1, crowded = 0;
    double *const field = xalloc(g.total, sizeof *field);
    for (int n = 0; n < GRAINS; n++)
        reach = answer->reach(&g, radii[n]) > reach ? answer->reach(&g, radii[n]) : reach;
    struct share *const out = xalloc((size_t)reach, sizeof *out);
    for (int n = 0; n < GRAINS; n++) {
        const int m = answer->shares(&g, d, &grains, n, out);
        double sum = 0.0;
        crowded += m < 1 || m > answer->reach(&g, radii[n]);
        for (int i = 0; i < m; i++) {
            sum += out[i].weight;
            least = fmin(least, out[i].weight);
            outside += !interior(&g, out[i].cell);
            field[out[i].cell] += out[i].weight * 4.0 / 3.0 * pi * pow(radii[n], 3);
        }
        worst = fmax(worst, fabs(sum - 1.0));
    }
    const double on_grid = sum_blocks(field, g.total);
    check(worst <= 1e-14, "%s, %s: shares sum to 1, largest error %.1e", answer->name, what,
          worst);
    check(least >= 0.0 && outside == 0 && crowded == 0,
          "%s, %s: smallest share %.1e, %d outside, %d beyond reach", answer->name, what, least,
          outside, crowded);
    check(fabs(on_grid / volume - 1.0) <= 1e-12, "%s, %s: volume on the grid, error %.1e",
          answer->name, what, on_grid / volume - 1.0);
    xfree(out);
    xfree(field);
    gsl_rng_free(rng);
}

/* All of an answer: the shares of n grains, and the Gaussian. */
struct seen {
    const struct answer *answer;
    struct grid g;
    int reach, *n_shares;
    struct share *shares;
    struct spread spread;
    struct diffuse *diffuse;
};

/* In place: spread and diffusion keep the address of the grid. */
static void see(struct seen *s, const struct answer *answer, const struct domain *d,
                const struct grains *grains)
{
    double largest = 0.0;
    *s = (struct seen){.answer = answer};
    grid_create(&s->g, d);
    for (int n = 0; n < grains->n; n++)
        largest = fmax(largest, grains->radius[n]);
    s->reach = answer->reach(&s->g, largest);
    s->shares = xalloc((size_t)grains->n * s->reach, sizeof *s->shares);
    s->n_shares = xalloc((size_t)grains->n, sizeof *s->n_shares);
    for (int n = 0; n < grains->n; n++)
        s->n_shares[n] = answer->shares(&s->g, d, grains, n, &s->shares[(size_t)n * s->reach]);
    s->diffuse = answer->diffusion(&s->g, d, largest);
    spread_create(&s->spread, &s->g);
    spread_prepare(&s->spread, grains->n, s->reach, s->n_shares, s->shares);
}

static void see_free(struct seen *s)
{
    xfree(s->shares);
    xfree(s->n_shares);
    spread_free(&s->spread);
    diffuse_free(s->diffuse);
}

static void see_spread(struct seen *s, const double *value, double *out)
{
    spread_one(&s->spread, value, out);
    if (s->diffuse)
        diffuse_apply(s->diffuse, out);
}

/* What grain n feels of a field that has been diffused. */
static double see_felt(const struct seen *s, const double *field, int n)
{
    double sum = 0.0;
    for (int k = 0; k < s->n_shares[n]; k++)
        sum += s->shares[(size_t)n * s->reach + k].weight *
               field[s->shares[(size_t)n * s->reach + k].cell];
    return sum;
}

/* Volume with the Gaussian, and the two ways of a random exchange. */
static void test_exchange(const struct answer *answer, const struct domain *d, const char *what)
{
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_ranlxs0);
    struct grid g;
    grid_create(&g, d);
    const double volume = place_grains(rng, d, &g);
    const struct grains grains = {.n = GRAINS, .pos = positions, .radius = radii};
    struct seen s;
    see(&s, answer, d, &grains);
    double *const out = grid_field(&g), *const field = grid_field(&g);
    double value[GRAINS], felt = 0.0, given = 0.0, size = 0.0;
    for (int n = 0; n < GRAINS; n++)
        value[n] = 4.0 / 3.0 * pi * pow(radii[n], 3);
    see_spread(&s, value, out);
    double least = 0.0;
    for (size_t c = 0; c < g.total; c++)
        least = fmin(least, out[c]);
    check(fabs(sum_blocks(out, g.total) / volume - 1.0) <= 1e-12 && least >= 0.0,
          "%s, %s: volume spread, error %.1e", answer->name, what,
          sum_blocks(out, g.total) / volume - 1.0);
    for (int n = 0; n < GRAINS; n++)
        value[n] = uniform(rng, -1.0, 1.0);
    for (size_t c = 0; c < g.total; c++)
        field[c] = interior(&g, (int)c) ? uniform(rng, -1.0, 1.0) : 0.0;
    see_spread(&s, value, out);
    for (size_t c = 0; c < g.total; c++)
        given += out[c] * field[c];
    if (s.diffuse)
        diffuse_apply(s.diffuse, field);
    for (int n = 0; n < GRAINS; n++) {
        felt += value[n] * see_felt(&s, field, n);
        size += fabs(value[n] * see_felt(&s, field, n));
    }
    check(fabs(felt - given) <= 1e-13 * size,
          "%s, %s: felt and given by the same weights, %.1e", answer->name, what,
          (felt - given) / size);
    xfree(out);
    xfree(field);
    see_free(&s);
    gsl_rng_free(rng);
}

/* Grains on a lattice that fills the box, mirrored in its walls: the fluid fraction is even. */
static void test_even(const struct answer *answer, const struct domain *d, const char *what)
{
    enum { PER_CELL = 2 };
    struct grid g;
    grid_create(&g, d);
    const int m[3] = {PER_CELL * g.n[0], PER_CELL * g.n[1], PER_CELL * g.n[2]};
    struct grains grains = {.n = m[0] * m[1] * m[2]};
    grains.pos = xalloc((size_t)grains.n, sizeof *grains.pos);
    grains.radius = xalloc((size_t)grains.n, sizeof *grains.radius);
    double *const value = xalloc((size_t)grains.n, sizeof *value), *const out = grid_field(&g);
    for (int n = 0; n < grains.n; n++) {
        const double at[3] = {n % m[0] + 0.5, n / m[0] % m[1] + 0.5, n / (m[0] * m[1]) + 0.5};
        grains.pos[n] =
            v3(at[0] * d->size[0] / m[0], at[1] * d->size[1] / m[1], at[2] * d->size[2] / m[2]);
        grains.radius[n] = 0.23 * g.h[0];
        value[n] = 1.0;
    }
    struct seen s;
    see(&s, answer, d, &grains);
    see_spread(&s, value, out);
    const double mean = pow(PER_CELL, 3);
    double worst = 0.0;
    for (size_t c = 0; c < g.total; c++)
        if (interior(&g, (int)c))
            worst = fmax(worst, fabs(out[c] / mean - 1.0));
    check(worst <= 1e-12, "%s, %s: an even lattice is seen as even, up to its sides, %.1e",
          answer->name, what, worst);
    see_free(&s);
    xfree(grains.pos);
    xfree(grains.radius);
    xfree(value);
    xfree(out);
}

/* A field linear in space, felt by grains far from the sides: largest error over a cell's step. */
static void test_linear(const struct answer *answer)
{
    const struct domain d = {.size = {1.1, 1.3, 1.5}, .cells = {44, 40, 36}};
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    const vec3 slope = v3(1.7, -2.3, 0.9);
    const struct grains grains = {.n = 200, .pos = positions, .radius = radii};
    struct grid g;
    grid_create(&g, &d);
    for (int n = 0; n < grains.n; n++) {
        positions[n] =
            v3(uniform(rng, 0.45, 0.65), uniform(rng, 0.55, 0.75), uniform(rng, 0.65, 0.85));
        radii[n] = 0.45 * g.h[0];
    }
    struct seen s;
    see(&s, answer, &d, &grains);
    double *const field = grid_field(&g), worst = 0.0;
    for (int k = 1; k <= g.n[2]; k++)
        for (int j = 1; j <= g.n[1]; j++)
            for (int i = 1; i <= g.n[0]; i++)
                field[cell(&g, i, j, k)] = v3_dot(
                    slope, v3((i - 0.5) * g.h[0], (j - 0.5) * g.h[1], (k - 0.5) * g.h[2]));
    if (s.diffuse)
        diffuse_apply(s.diffuse, field);
    for (int n = 0; n < grains.n; n++)
        worst = fmax(worst, fabs(see_felt(&s, field, n) - v3_dot(slope, positions[n])));
    worst /= v3_norm(slope) * g.h[0];
    const bool exact =
        strcmp(answer->name, "trilinear") == 0 || strcmp(answer->name, "gaussian") == 0;
    check(worst <= (exact ? 1e-11 : 1.0),
          "%s: a linear field is felt within %.1e of a cell's step%s", answer->name, worst,
          exact ? " (exactly)" : "");
    xfree(field);
    see_free(&s);
    gsl_rng_free(rng);
}

static const struct domain walls = {.size = {0.01, 0.012, 0.03}, .cells = {5, 6, 15}};
static const struct domain periodic = {
    .size = {0.01, 0.012, 0.03}, .cells = {5, 6, 15}, .periodic = {true, true, true}};
static const struct domain flat = {
    .size = {0.01, 0.001, 0.03}, .cells = {10, 1, 30}, .periodic = {true, true, false}};

static void visit(const char *name, void *object)
{
    struct answer a = {.name = name};
    if (!answers_symbol(object, "porosity_reach", &a.reach, sizeof a.reach) ||
        !answers_symbol(object, "porosity_shares", &a.shares, sizeof a.shares) ||
        !answers_symbol(object, "porosity_diffusion", &a.diffusion, sizeof a.diffusion) ||
        !answers_symbol(object, "porosity_displaces", &a.displaces, sizeof a.displaces) ||
        !answers_symbol(object, "porosity_init", &a.init, sizeof a.init) ||
        !answers_symbol(object, "porosity_keys", &a.keys, sizeof a.keys))
        return;
    struct scene *const s = scene_load(NULL, 0, NULL);
    scene_declare(s, a.keys);
    a.init(s);
    scene_free(s);
    test_answer(&a, &walls, "walls");
    test_answer(&a, &periodic, "periodic");
    test_answer(&a, &flat, "one cell thick");
    test_exchange(&a, &walls, "walls");
    test_exchange(&a, &periodic, "periodic");
    test_exchange(&a, &flat, "one cell thick");
    test_even(&a, &walls, "walls");
    test_even(&a, &periodic, "periodic");
    test_even(&a, &flat, "one cell thick");
    test_linear(&a);
    const double since = wall_clock();
    const struct domain box = {.size = {1.0, 1.0, 1.0}, .cells = {20, 20, 20}};
    struct grid g;
    grid_create(&g, &box);
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    struct share *const out = xalloc((size_t)a.reach(&g, 0.25 * g.h[0]), sizeof *out);
    double sum = 0.0;
    for (int n = 0; n < GRAINS; n++) {
        positions[n] =
            v3(uniform(rng, 0.1, 0.9), uniform(rng, 0.1, 0.9), uniform(rng, 0.1, 0.9));
        radii[n] = 0.25 * g.h[0];
    }
    const struct grains grains = {.n = GRAINS, .pos = positions, .radius = radii};
    for (int t = 0; t < 20; t++)
        for (int n = 0; n < GRAINS; n++)
            sum += a.shares(&g, &box, &grains, n, out);
    gsl_rng_free(rng);
    xfree(out);
    printf("    %s: %.0f ns per grain at cells of 2 diameters, %.2f cells per grain\n", name,
           (wall_clock() - since) / (20 * GRAINS) * 1e9, sum / (20 * GRAINS));
}

int main(int argc, char **argv)
{
    (void)argc;
    gsl_set_error_handler_off();
    gsl_rng *const rng = gsl_rng_alloc(gsl_rng_mt19937);
    test_overlap(rng);
    test_cover(rng);
    gsl_rng_free(rng);
    answers_visit(argv[0], "porosity", visit);
    return check_end();
}
