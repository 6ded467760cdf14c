/* helmholtz.c - the direct solve for a component of the velocity (helmholtz.h): directions along the sides
 * and periodic ones are diagonal in the transforms of transform.h; across walls, inflows and outflows
 * the component lies on the sides themselves, and there a tridiagonal system is left for each mode
 * [SwarztrauberSweet73]:
 *
 *   (A + nu (lambda_b + lambda_c)) w_i - nu/h^2 (w_{i-1} - 2 w_i + w_{i+1}) = r_i
 *   on the face of an open side  ... - 2 nu/h^2 (w_{inside} - w_i)
 *
 * Two passes over slabs, each for one or two directions while the slab is in cache, with one over the
 * direction across the slabs between them: a field is read and written three times. */
#include "helmholtz.h"

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

enum { FEW_SLABS = 8, SWEEP = 8 }; /* SWEEP: packs of a tridiagonal sweep */

struct direction {
    int first, n;        /* faces with an equation */
    struct transform *t; /* NULL: one cell thick, or across */
    double *eigenvalue;  /* n, 1/m2; 0 across */
    bool across, open[2];
    double h;
};

struct helmholtz {
    const struct grid *g;
    struct direction of[3];
    int slab, between; /* direction of the slabs (1 or 2), and the other one */
    bool none;         /* no face has an equation */
    double norm;       /* of all transforms */
    int longest;
};

static bool holds(enum side_kind kind)
{
    return kind == SIDE_WALL || kind == SIDE_INFLOW || kind == SIDE_FLUX;
}

static bool opens(enum side_kind kind)
{
    return kind == SIDE_OUTFLOW || kind == SIDE_HEAD;
}

static enum poisson_side tangential(enum side_kind kind)
{
    return kind == SIDE_PERIODIC ? POISSON_PERIODIC
           : holds(kind)         ? POISSON_DIRICHLET
                                 : POISSON_NEUMANN;
}

static void create_direction(struct helmholtz *h, const struct domain *d, int a, int b)
{
    struct direction *const e = &h->of[b];
    const enum side_kind lo = d->side[2 * b].kind, hi = d->side[2 * b + 1].kind;
    e->h = h->g->h[b];
    e->first = 1;
    e->n = h->g->n[b];
    e->across = a == b && !d->periodic[b];
    if (e->across) {
        e->open[0] = opens(lo);
        e->open[1] = opens(hi);
        e->first = e->open[0] ? 1 : 2;
        e->n += e->open[0] + e->open[1] - 1;
        h->none = e->n == 0;
    } else if (e->n > 1) {
        e->t = transform_create(e->n, tangential(lo), tangential(hi));
        h->norm *= e->t->norm;
    }
    e->eigenvalue = xalloc((size_t)e->n + LANES, sizeof *e->eigenvalue);
    const double alone = e->across || d->periodic[b] ? 0.0 : 2.0 * (holds(lo) + holds(hi));
    for (int m = 0; m < e->n + LANES; m++)
        e->eigenvalue[m] =
            m < e->n ? (e->t ? e->t->eigenvalue[m] : alone) / (e->h * e->h) : 0.0;
    h->longest = e->n > h->longest ? e->n : h->longest;
}

struct helmholtz *helmholtz_create(const struct grid *g, const struct domain *d, int a)
{
    struct helmholtz *const h = xalloc(1, sizeof *h);
    h->g = g;
    h->norm = 1.0;
    for (int b = 0; b < 3; b++)
        create_direction(h, d, a, b);
    const bool thin_y = g->n[1] < LINES && g->n[1] < g->n[2];
    const bool thin_z = g->n[2] < LINES && g->n[2] < g->n[1];
    const bool y = h->of[0].across ? thin_z : !h->of[2].across && thin_y;
    h->slab = h->of[1].across || y ? 1 : 2; /* lanes that are full */
    h->between = 3 - h->slab;
    return h;
}

void helmholtz_free(struct helmholtz *h)
{
    if (!h)
        return;
    for (int b = 0; b < 3; b++) {
        transform_free(h->of[b].t);
        xfree(h->of[b].eigenvalue);
    }
    xfree(h);
}

/* One solve. */
struct task {
    const struct helmholtz *h;
    double A, nu; /* times the norm of the transforms */
    double *field;
    const struct helmholtz_hook *hook;
    int s[3], n[3];
};

static int at_most(int x, int most)
{
    return x < most ? x : most;
}

static int blocks(int n, int size)
{
    return (n + size - 1) / size;
}

/* First face with an equation at place i of the slabs' direction and j of the other. */
static double *face(const struct task *q, int i, int j)
{
    const struct direction *const of = q->h->of;
    const int slab = q->h->slab, between = q->h->between;
    return q->field + of[0].first + (long)(of[slab].first + i) * q->s[slab] +
           (long)(of[between].first + j) * q->s[between];
}

/* Up to LINES lines of a direction, from values to modes or back. */
static void turn_lines(const struct direction *d, double *at, int along, int across, int lines,
                       bool back, struct pair *work)
{
    const struct transform *const t = d->t;
    const struct places cells = places_of_cells(t), modes = places_of_modes(t);
    lines_move(back ? &modes : &cells, t->n, &work->re, at, along, across, lines, false);
    struct pair *const out =
        back ? backward(t, work, work + t->n) : forward(t, work, work + t->n);
    lines_move(back ? &cells : &modes, t->n, &out->re, at, along, across, lines, true);
}

/* Lines along x, block b of them: of one slab, or of all where slabs are thin. */
static void turn_rows(const struct task *q, bool thin, int i, int b, bool back,
                      struct pair *work)
{
    const int first = b * LINES, beside = thin ? q->h->slab : q->h->between;
    turn_lines(&q->h->of[0], thin ? face(q, first, i) : face(q, i, first), 1, q->s[beside],
               at_most(q->n[beside] - first, LINES), back, work);
}

/* Lines of a slab across x. */
static void turn_columns(const struct task *q, int slab, int b, bool back, struct pair *work)
{
    const int first = b * LINES, between = q->h->between;
    turn_lines(&q->h->of[between], face(q, slab, 0) + first, q->s[between], 1,
               at_most(q->n[0] - first, LINES), back, work);
}

static void hook_rows(const struct task *q, int slab, int from, int to, bool back)
{
    const struct direction *const of = q->h->of;
    const int at = of[q->h->slab].first + slab, first = of[0].first;
    for (int i = from; i < to; i++) {
        const int other = of[q->h->between].first + i;
        const int j = q->h->slab == 1 ? at : other, k = q->h->slab == 1 ? other : at;
        (back ? q->hook->after : q->hook->before)(q->hook->with, j, k, first,
                                                  first + q->n[0] - 1);
    }
}

/* What is left in the direction across the slabs when the others are in modes: LINES lines side by side. */
static void divide_lines(const struct task *q, int i, int first, struct pair *work)
{
    const struct direction *const x = &q->h->of[0], *const d = &q->h->of[q->h->slab];
    const double other = q->h->of[q->h->between].eigenvalue[i];
    const int lines = at_most(q->n[0] - first, LINES), along = q->s[q->h->slab];
    double *const at = face(q, 0, i) + first;
    const struct transform *const t = d->t;
    pack base[2];
    for (int g = 0; g < 2; g++)
        base[g] = q->A + q->nu * (other + load(x->eigenvalue + first + g * LANES,
                                               g * LANES < lines ? LANES : 0));
    if (!t) {
        for (int g = 0; g < 2; g++) {
            const int count = lines - g * LANES;
            store(at + g * LANES,
                  load(at + g * LANES, count) / (base[g] + q->nu * d->eigenvalue[0]), count);
        }
        return;
    }
    const struct places cells = places_of_cells(t);
    lines_move(&cells, t->n, &work->re, at, along, 1, lines, false);
    struct pair *const modes = forward(t, work, work + t->n);
    pack *const of = &modes->re;
    for (int m = 0; m < t->n; m++)
        for (int g = 0; g < 2; g++)
            of[m * t->step + g * t->group] /= base[g] + q->nu * d->eigenvalue[m];
    struct pair *const out = backward(t, modes, modes == work ? work + t->n : work);
    lines_move(&cells, t->n, &out->re, at, along, 1, lines, true);
}

/* Thomas down and up: value i of system p at x[i packs + p], its diagonal without the second
 * difference in base[p]. pivot: as x. */
static void thomas(const struct direction *d, double nu, int packs, const pack *base,
                   pack *restrict x, pack *restrict pivot)
{
    const double c = nu / (d->h * d->h);
    const int n = d->n;
    for (int i = 0; i < n; i++) {
        const double below = i == 0 ? 0.0 : i == n - 1 && d->open[1] ? 2.0 * c : c;
        const double above = i == n - 1 ? 0.0 : i == 0 && d->open[0] ? 2.0 * c : c;
        const pack *const x_below = i > 0 ? x + (i - 1) * packs : x;
        const pack *const p_below = i > 0 ? pivot + (i - 1) * packs : pivot;
        for (int p = 0; p < packs; p++) {
            const pack inverse =
                1.0 / (base[p] + 2.0 * c - (i > 0 ? below * p_below[p] : (pack){0}));
            pivot[i * packs + p] = above * inverse;
            x[i * packs + p] =
                (x[i * packs + p] + (i > 0 ? below * x_below[p] : (pack){0})) * inverse;
        }
    }
    for (int i = n - 2; i >= 0; i--)
        for (int p = 0; p < packs; p++)
            x[i * packs + p] += pivot[i * packs + p] * x[(i + 1) * packs + p];
}

/* The tridiagonal systems across the slabs: packs of lines side by side. */
static void sweep_lines(const struct task *q, int i, int first, struct pair *work)
{
    const struct direction *const x = &q->h->of[0], *const d = &q->h->of[q->h->slab];
    const double other = q->h->of[q->h->between].eigenvalue[i];
    const int lines = at_most(q->n[0] - first, SWEEP * LANES), along = q->s[q->h->slab];
    const int packs = blocks(lines, LANES);
    double *const at = face(q, 0, i) + first;
    pack *const value = &work->re, *const pivot = value + (size_t)d->n * packs;
    pack base[SWEEP];
    for (int p = 0; p < packs; p++)
        base[p] = q->A + q->nu * (other + load(x->eigenvalue + first + p * LANES, LANES));
    for (int m = 0; m < d->n; m++)
        for (int p = 0; p < packs; p++)
            value[m * packs + p] = load(at + (long)m * along + p * LANES, lines - p * LANES);
    thomas(d, q->nu, packs, base, value, pivot);
    for (int m = 0; m < d->n; m++)
        for (int p = 0; p < packs; p++)
            store(at + (long)m * along + p * LANES, value[m * packs + p], lines - p * LANES);
}

/* The same along x, LINES rows of place i between the slabs. */
static void sweep_rows(const struct task *q, int i, int first, struct pair *work)
{
    const struct direction *const d = &q->h->of[0], *const e = &q->h->of[q->h->slab];
    const double other = q->h->of[q->h->between].eigenvalue[i];
    const int lines = at_most(q->n[q->h->slab] - first, LINES), across = q->s[q->h->slab];
    const struct places places = {NULL, NULL, 2, 1};
    pack *const value = &work->re, *const pivot = value + 2 * (size_t)d->n;
    pack base[2];
    for (int g = 0; g < 2; g++)
        base[g] = q->A + q->nu * (other + load(e->eigenvalue + first + g * LANES,
                                               g * LANES < lines ? LANES : 0));
    lines_behind(&places, d->n, value, face(q, first, i), across, lines, false);
    thomas(d, q->nu, 2, base, value, pivot);
    lines_behind(&places, d->n, value, face(q, first, i), across, lines, true);
}

/* All slabs, each while it is in cache. */
static void turn_slabs(const struct task *q, bool back, struct pair *work)
{
    const struct direction *const of = q->h->of;
    const int slabs = q->n[q->h->slab], lines = q->n[q->h->between];
    const int rows = of[0].t ? blocks(lines, LINES) : 0;
    const int columns = of[q->h->between].t ? blocks(q->n[0], LINES) : 0;
#pragma omp for schedule(static)
    for (int i = 0; i < slabs; i++) {
        if (!back)
            hook_rows(q, i, 0, lines, false);
        for (int b = 0; b < columns && back; b++)
            turn_columns(q, i, b, true, work);
        for (int b = 0; b < rows; b++)
            turn_rows(q, false, i, b, back, work);
        for (int b = 0; b < columns && !back; b++)
            turn_columns(q, i, b, false, work);
        if (back)
            hook_rows(q, i, 0, lines, true);
    }
}

/* Few slabs, or of few lines: the same, one direction after the other, by all threads. */
static void turn_rows_of_all(const struct task *q, bool back, struct pair *work)
{
    const struct direction *const of = q->h->of;
    const int slabs = q->n[q->h->slab], lines = q->n[q->h->between];
    const bool thin = lines < LINES && lines < slabs;
    const int along = blocks(thin ? slabs : lines, LINES), sets = thin ? lines : slabs;
#pragma omp for schedule(static)
    for (int b = 0; b < (of[0].t ? sets * along : 0); b++)
        turn_rows(q, thin, b / along, b % along, back, work);
}

static void turn_columns_of_all(const struct task *q, bool back, struct pair *work)
{
    const int slabs = q->n[q->h->slab], along = blocks(q->n[0], LINES);
#pragma omp for schedule(static)
    for (int b = 0; b < (q->h->of[q->h->between].t ? slabs * along : 0); b++)
        turn_columns(q, b / along, b % along, back, work);
}

static void turn_parts(const struct task *q, bool back, struct pair *work)
{
    const int lines = q->n[q->h->between], all = q->n[q->h->slab] * lines;
    if (back)
        turn_columns_of_all(q, true, work);
#pragma omp for schedule(static)
    for (int b = 0; b < (back ? 0 : all); b++)
        hook_rows(q, b / lines, b % lines, b % lines + 1, false);
    turn_rows_of_all(q, back, work);
#pragma omp for schedule(static)
    for (int b = 0; b < (back ? all : 0); b++)
        hook_rows(q, b / lines, b % lines, b % lines + 1, true);
    if (!back)
        turn_columns_of_all(q, false, work);
}

/* Block b of the lines across the slabs at place i between them. */
static void turn_across(const struct task *q, int i, int b, bool back, struct pair *work)
{
    const struct direction *const d = &q->h->of[q->h->slab];
    const int first = b * LINES;
    if (d->t)
        turn_lines(d, face(q, 0, i) + first, q->s[q->h->slab], 1,
                   at_most(q->n[0] - first, LINES), back, work);
}

/* All lines across the slabs, from modes of the other directions to modes of the solution. */
static void cross_slabs(const struct task *q, struct pair *work)
{
    const struct direction *const d = &q->h->of[q->h->slab];
    const int places = q->n[q->h->between], step = d->across ? SWEEP * LANES : LINES;
    const int along = blocks(q->n[0], step);
#pragma omp for schedule(static)
    for (int b = 0; b < places * along; b++)
        (d->across ? sweep_lines : divide_lines)(q, b / along, b % along * step, work);
}

/* The same where the tridiagonal systems lie along x. */
static void cross_rows(const struct task *q, struct pair *work)
{
    const int places = q->n[q->h->between], along = blocks(q->n[0], LINES);
    const int rows = blocks(q->n[q->h->slab], LINES);
    if (places >= FEW_SLABS) {
#pragma omp for schedule(static)
        for (int i = 0; i < places; i++) {
            for (int b = 0; b < along; b++)
                turn_across(q, i, b, false, work);
            for (int b = 0; b < rows; b++)
                sweep_rows(q, i, b * LINES, work);
            for (int b = 0; b < along; b++)
                turn_across(q, i, b, true, work);
        }
        return;
    }
#pragma omp for schedule(static)
    for (int b = 0; b < places * along; b++)
        turn_across(q, b / along, b % along, false, work);
#pragma omp for schedule(static)
    for (int b = 0; b < places * rows; b++)
        sweep_rows(q, b / rows, b % rows * LINES, work);
#pragma omp for schedule(static)
    for (int b = 0; b < places * along; b++)
        turn_across(q, b / along, b % along, true, work);
}

void helmholtz_solve(struct helmholtz *h, double A, double nu, double *field,
                     const struct helmholtz_hook *hook)
{
    if (h->none)
        return;
    struct task q = {
        .h = h, .A = A * h->norm, .nu = nu * h->norm, .field = field, .hook = hook};
    for (int b = 0; b < 3; b++) {
        q.s[b] = h->g->s[b];
        q.n[b] = h->of[b].n;
    }
    const bool parts = q.n[h->slab] < FEW_SLABS || q.n[h->between] < LINES;
#pragma omp parallel if (h->g->total > GRID_SMALL)
    {
        struct pair *const work = xalloc((size_t)(SWEEP + 2) * h->longest, sizeof *work);
        (parts ? turn_parts : turn_slabs)(&q, false, work);
        (h->of[0].across ? cross_rows : cross_slabs)(&q, work);
        (parts ? turn_parts : turn_slabs)(&q, true, work);
        xfree(work);
    }
}
