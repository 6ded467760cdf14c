/* verify/test_helmholtz.c - Crank and Nicolson's step without grains, solved directly, put into its
 * equation with the operator of diffusion.h: from noise, between sides of every kind in boxes thick and
 * thin; the same bits on any number of threads. */
/* slots: drag/stokes porosity/divided solver/fluid/navier_stokes contact/linear */
#include <omp.h>
#include <string.h>
#include "../solver/diffusion.h"
#include "../solver/fluid_state.h"
#include "check.h"
#include "harness.h"

static unsigned long seed = 90125;
static double noise(void)
{
    seed = seed * 6364136223846793005ul + 1442695040888963407ul;
    return (double)(seed >> 11) / 9007199254740992.0 - 0.5;
}

static int any(int n)
{
    return (int)((noise() + 0.5) * n);
}

enum { PAIRS = 13, SIZES = 8, BOXES = 250 };
static const char *const pair[PAIRS][2] = {
    {"periodic", "periodic"}, {"wall", "wall"},       {"slip", "slip"},
    {"wall", "slip"},         {"slip", "wall"},       {"wall", "outflow"},
    {"outflow", "wall"},      {"outflow", "outflow"}, {"inflow", "outflow"},
    {"outflow", "inflow"},    {"slip", "outflow"},    {"outflow", "slip"},
    {"wall", "moving"}};
static const int size[SIZES] = {1, 2, 3, 5, 8, 17, 33, 40};

/* A box with an even fluid, sides as given by three pairs. */
static struct sim *box(const int n[3], const int p[3], double viscosity)
{
    char *sides = xstrdup(""), *moving = xstrdup("");
    bool inflow = false;
    for (int b = 0; b < 3; b++)
        for (int end = 0; end < 2; end++) {
            const char *const kind = pair[p[b]][end];
            const bool moves = strcmp(kind, "moving") == 0;
            inflow = inflow || strcmp(kind, "inflow") == 0;
            char *const more = xprintf("%s%c%c = %s\n", sides, 'x' + b, end ? '+' : '-',
                                       moves ? "wall" : kind);
            xfree(sides);
            sides = more;
            if (!moves)
                continue;
            char *const wall =
                xprintf("%s[side %c+]\nvelocity = %g %g %g m/s\n", moving, 'x' + b,
                        b == 0 ? 0.0 : 0.7, b == 1 ? 0.0 : -0.4, b == 2 ? 0.0 : 0.9);
            xfree(moving);
            moving = wall;
        }
    char *const text = xprintf("[domain]\nsize = %g %g %g m\ncells = %d %d %d\n%s%s"
                               "[fluid]\ndensity = 2 kg/m3\nviscosity = %g Pa s\ndt = 0.1 s\n"
                               "viscous = implicit\n%s[run]\nend = 1e9 s\nforce = on\n",
                               n[0] * 1.0, n[1] * 0.9, n[2] * 1.2, n[0], n[1], n[2], sides,
                               inflow ? "[flow]\nvelocity = 0.3 m/s\n" : "", viscosity, moving);
    struct sim *const s = sim_from(text);
    xfree(text);
    xfree(sides);
    xfree(moving);
    return s;
}

/* out += part L u on the faces of component a that have an equation. */
static void add_laplacian(const struct sim *s, const struct momentum *m, int a, double part,
                          double *out)
{
    const struct grid *const g = &s->grid;
    const double *const u = s->fluid.u[a];
    double *const row = xalloc((size_t)g->sj, sizeof *row);
    for (int k = inside_first(s, a, 2); k <= g->n[2]; k++)
        for (int j = inside_first(s, a, 1); j <= g->n[1]; j++) {
            diffusion_row(s, m, FORM_A, a, j, k, u, row);
            for (int i = inside_first(s, a, 0); i <= g->n[0]; i++)
                out[cell(g, i, j, k)] += part * row[i];
        }
    const int b = (a + 1) % 3, d = (a + 2) % 3;
    for (int end = 0; end < 2; end++)
        for (int k = 1; k <= g->n[d] && side_open(&s->domain, 2 * a + end); k++)
            for (int j = 1; j <= g->n[b]; j++) {
                const int c = (end ? g->n[a] + 1 : 1) * g->s[a] + j * g->s[b] + k * g->s[d];
                out[c] += part * diffusion_open(s, m, FORM_A, a, end, c, u);
            }
    xfree(row);
}

/* x is the velocity without viscosity, u the old one. Largest |rho/dt (new - x) - L (new + u)/2| over
 * the faces that have an equation, relative to the largest term. */
static double error_of(struct sim *s, int a, struct diffusion *d, const struct momentum *m)
{
    const struct grid *const g = &s->grid;
    const double A = s->fluid.rho / s->fluid.dt;
    double *const sum = grid_field(g), *const x = grid_field(g), *const left = grid_field(g);
    double worst = 0.0;
    for (size_t c = 0; c < g->total; c++) {
        s->fluid.u[a][c] = noise();
        x[c] = noise();
    }
    fluid_velocity_sides(s, 0.0);
    for (size_t c = 0; c < g->total; c++)
        sum[c] = x[c] + s->fluid.u[a][c];
    add_laplacian(s, m, a, -0.5, left);
    diffusion_direct(s, d, a, sum);
    const int first[3] = {side_open(&s->domain, 0) && a == 0 ? 1 : inside_first(s, a, 0),
                          side_open(&s->domain, 2) && a == 1 ? 1 : inside_first(s, a, 1),
                          side_open(&s->domain, 4) && a == 2 ? 1 : inside_first(s, a, 2)};
    int last[3];
    for (int b = 0; b < 3; b++)
        last[b] = g->n[b] + (a == b && side_open(&s->domain, 2 * b + 1));
    for (int k = first[2]; k <= last[2]; k++)
        for (int j = first[1]; j <= last[1]; j++)
            for (int i = first[0]; i <= last[0]; i++)
                s->fluid.u[a][cell(g, i, j, k)] = sum[cell(g, i, j, k)];
    fluid_velocity_sides(s, 0.0);
    add_laplacian(s, m, a, -0.5, left);
    for (int k = first[2]; k <= last[2]; k++)
        for (int j = first[1]; j <= last[1]; j++)
            for (int i = first[0]; i <= last[0]; i++) {
                const int c = cell(g, i, j, k);
                worst = fmax(worst, fabs(A * (sum[c] - x[c]) + left[c]) / A);
            }
    xfree(sum);
    xfree(x);
    xfree(left);
    return worst;
}

static void check_boxes(void)
{
    double worst = 0.0;
    int seen[PAIRS] = {0}, bad[6] = {0};
    for (int q = 0; q < BOXES; q++) {
        int n[3], p[3];
        for (int b = 0; b < 3; b++) {
            n[b] = size[any(q % 8 == 0 ? SIZES : SIZES - 2)];
            p[b] = any(PAIRS);
            seen[p[b]]++;
        }
        struct sim *const s = box(n, p, q % 2 ? 3.0 : 500.0);
        struct diffusion d = {0};
        struct momentum m = {0};
        diffusion_create(&d, s);
        momentum_create(&m, s, CONVECTION_CENTRED, FORM_A, true);
        for (int a = 0; a < 3; a++) {
            const double error = error_of(s, a, &d, &m);
            if (error > worst) {
                worst = error;
                memcpy(bad, n, sizeof n);
                memcpy(bad + 3, p, sizeof p);
            }
        }
        diffusion_free(&d);
        momentum_free(&m);
        sim_free(s);
    }
    int fewest = BOXES;
    for (int p = 0; p < PAIRS; p++)
        fewest = seen[p] < fewest ? seen[p] : fewest;
    check(
        worst < 1e-12,
        "%d boxes, each pair of sides at least %d times: largest residual %.2g of rho u/dt (%d "
        "x %d x %d cells, sides %d %d %d)",
        BOXES, fewest, worst, bad[0], bad[1], bad[2], bad[3], bad[4], bad[5]);
}

/* The bits after some steps, folded into one number. */
static unsigned long bits_of(const int n[3], const int p[3], int threads)
{
    omp_set_num_threads(threads);
    struct sim *const s = box(n, p, 3.0);
    seed = 31337;
    for (int a = 0; a < 3; a++)
        for (size_t c = 0; c < s->grid.total; c++)
            s->fluid.u[a][c] = 0.1 * noise();
    for (int i = 0; i < 2; i++)
        step(s);
    unsigned long hash = 14695981039346656037ul;
    for (int a = 0; a < 3; a++)
        for (int k = 1; k <= n[2]; k++)
            for (int j = 1; j <= n[1]; j++)
                for (int i = 1; i <= n[0]; i++) {
                    unsigned long word;
                    memcpy(&word, &s->fluid.u[a][cell(&s->grid, i, j, k)], sizeof word);
                    hash = (hash ^ word) * 1099511628211ul;
                }
    sim_free(s);
    return hash;
}

static void check_threads(void)
{
    static const int n[3][3] = {{33, 26, 40}, {150, 140, 1}, {40, 7, 90}};
    static const int p[3][3] = {{0, 12, 5}, {12, 8, 2}, {1, 0, 12}};
    bool same = true;
    for (int q = 0; q < 3; q++) {
        const unsigned long one = bits_of(n[q], p[q], 1);
        for (int threads = 2; threads <= 5; threads++)
            same = same && bits_of(n[q], p[q], threads) == one;
    }
    check(same, "the same bits on 1 to 5 threads, in boxes thick and thin");
}

int main(void)
{
    check_threads();
    omp_set_num_threads(1);
    check_boxes();
    return check_end();
}
