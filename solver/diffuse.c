/* diffuse.c - Gaussian diffusion of a field of cells, see diffuse.h.
 *
 * The transforms of the pressure solve (cosines between walls, Fourier modes along periodic directions;
 * transform.h) diagonalise L, so exp(t L), t = w^2/2, multiplies the mode of eigenvalue -lambda by
 * exp(-t lambda). L is a sum over directions: each takes its lines forward, times exp(-t lambda), and
 * back while they are in cache, so a field is read and written three times in all, whatever the width.
 *
 * In space it is a convolution with exp(-2 s) I_n(2 s), s = t/h^2, of modified Bessel functions
 * [AbramowitzStegun64, 9.6.34], mirrored at walls. Measured on 64^3 cells and one thread: 3.9 ns per cell
 * (periodic 3.4) at any width; the convolution 5.3 at half a cell's width, 6.8 at one, 9.1 at two, more
 * than 30 at four. A number of cells with a large prime factor is dear, as in the pressure solve: 97 and
 * 127 cells take 40 to 60 ns. */
#include "diffuse.h"

#include <math.h>
#include <string.h>
#include "transform.h"

#define REAL  double
#define INDEX long
static inline const double *table_of(const struct transform *t)
{
    return t->table;
}
#include "transform_lanes.h"
#include "transform_lines.h"

/* One direction; t is NULL where there is one cell. */
struct direction {
    struct transform *t;
    double *decay; /* per mode, over the norm of the transforms */
};

struct transforms {
    struct diffuse can; /* first */
    const struct grid *g;
    struct direction of[3];
};

static void apply(struct diffuse *can, double *field);
static void transforms_free(struct diffuse *can);

struct diffuse *diffuse_create(const struct grid *g, const struct domain *d, double width)
{
    struct transforms *const f = xalloc(1, sizeof *f);
    f->can = (struct diffuse){.apply = apply, .free = transforms_free};
    f->g = g;
    for (int a = 0; a < 3; a++) {
        const enum poisson_side side = d->periodic[a] ? POISSON_PERIODIC : POISSON_NEUMANN;
        const double s = 0.5 * width * width / (g->h[a] * g->h[a]);
        const int n = g->n[a];
        if (n == 1)
            continue;
        struct transform *const t = transform_create(n, side, side);
        f->of[a].t = t;
        f->of[a].decay = xalloc((size_t)n, sizeof(double));
        for (int k = 0; k < n; k++)
            f->of[a].decay[k] = exp(-s * t->eigenvalue[k]) / t->norm;
    }
    return &f->can;
}

static void transforms_free(struct diffuse *can)
{
    struct transforms *const f = (struct transforms *)can;
    for (int a = 0; a < 3; a++) {
        if (f->of[a].t)
            transform_free(f->of[a].t);
        xfree(f->of[a].decay);
    }
    xfree(f);
}

/* Up to LINES lines of direction a, in place: cell i of line l at at[i along + l across], where one of the
 * two steps is 1. The work takes four packs a cell. */
static void diffuse_lines(const struct direction *d, double *at, int along, int across,
                          int lines, struct pair *work)
{
    const struct transform *const t = d->t;
    struct pair *const other = work + t->n;
    const struct places cells = places_of_cells(t);
    lines_move(&cells, t->n, &work->re, at, along, across, lines, false);
    struct pair *const modes = forward(t, work, other);
    pack *const of = &modes->re;
    for (int k = 0; k < t->n; k++) {
        of[k * t->step] *= d->decay[k];
        of[k * t->step + t->group] *= d->decay[k];
    }
    struct pair *const out = backward(t, modes, modes == work ? other : work);
    lines_move(&cells, t->n, &out->re, at, along, across, lines, true);
}

static int at_most(int x, int most)
{
    return x < most ? x : most;
}

/* Columns side by side along direction a (y or z), from the first interior cells of a row. */
static void columns(const struct transforms *f, int a, double *row, struct pair *work)
{
    const int n = f->g->n[0];
    for (int i = 0; i < n; i += LINES)
        diffuse_lines(&f->of[a], row + i, f->g->s[a], 1, at_most(n - i, LINES), work);
}

static void apply(struct diffuse *can, double *field)
{
    const struct transforms *const f = (const struct transforms *)can;
    const struct grid *const g = f->g;
    int longest = 1;
    for (int a = 0; a < 3; a++)
        longest = g->n[a] > longest ? g->n[a] : longest;
#pragma omp parallel
    {
        struct pair *const work = xalloc(2 * (size_t)longest, sizeof *work);
#pragma omp for schedule(static)
        for (int k = 1; k <= g->n[2]; k++) {
            for (int j = 1; j <= g->n[1] && f->of[0].t; j += LINES)
                diffuse_lines(&f->of[0], field + cell(g, 1, j, k), 1, g->sj,
                              at_most(g->n[1] + 1 - j, LINES), work);
            if (f->of[1].t)
                columns(f, 1, field + cell(g, 1, 1, k), work);
        }
        if (f->of[2].t) {
#pragma omp for schedule(static)
            for (int j = 1; j <= g->n[1]; j++)
                columns(f, 2, field + cell(g, 1, j, 1), work);
        }
        xfree(work);
    }
}
