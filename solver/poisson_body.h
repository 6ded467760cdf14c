/* poisson_body.h - the direct solve, plane by plane so that a plane stays in cache between its
 * two transforms, then the sweeps in z, a few packs of modes at a time, then back.
 *
 * A body, included once for each precision (see transform_lanes.h). */
#include "poisson_plan.h"
#include "transform_lanes.h"

enum { LINES = 2 * LANES, SINGLE = sizeof(REAL) == sizeof(float), FEW_PLANES = 8 };

static inline pack load(const REAL *from)
{
    pack x;
    memcpy(&x, from, sizeof x);
    return x;
}

static inline void store(REAL *to, pack x)
{
    memcpy(to, &x, sizeof x);
}

static inline REAL *row_of(const struct poisson *p, long line) /* of the work */
{
    return (REAL *)p->work + (size_t)line * (size_t)p->width[SINGLE];
}

static inline size_t row_in_field(const struct poisson *p, long line)
{
    return (size_t)p->start + (size_t)(line % p->n[1]) * p->stride[1] +
           (size_t)(line / p->n[1]) * p->stride[2];
}

static inline struct pair *thread_scratch(const struct poisson *p)
{
    return (struct pair *)(void *)(p->scratch + (size_t)omp_get_thread_num() * p->scratch_size);
}

static inline pack signed_as(const struct transform *t, int input, pack x)
{
    return t->signs && t->negative[input] ? -x : x;
}

/* The rows first..first + LINES - 1 of the field (the last one again beyond `last`), as
 * columns of packs where forward() wants them. */
static void gather_rows(const struct poisson *p, const REAL *field, long first, long last,
                        pack *x)
{
    const struct transform *const t = p->t[0];
    const int n = p->n[0], stride = p->stride[0];
    for (int g = 0; g < 2; g++) {
        const REAL *row[LANES];
        for (int l = 0; l < LANES; l++) {
            const long line = first + g * LANES + l;
            row[l] = field + row_in_field(p, line < last ? line : last - 1);
        }
        int i = 0;
        for (; stride == 1 && i + LANES <= n; i += LANES) {
            pack block[LANES];
            for (int l = 0; l < LANES; l++)
                block[l] = load(row[l] + i);
            transpose(block);
            for (int l = 0; l < LANES; l++)
                x[t->slot[i + l] + g * t->group] = signed_as(t, i + l, block[l]);
        }
        for (; i < n; i++) {
            pack column;
            for (int l = 0; l < LANES; l++)
                column[l] = row[l][(size_t)i * stride];
            x[t->slot[i] + g * t->group] = signed_as(t, i, column);
        }
    }
}

/* The other way, times `factor`. */
static void scatter_rows(const struct poisson *p, const pack *x, REAL factor, long first,
                         long last, REAL *field)
{
    const struct transform *const t = p->t[0];
    const int n = p->n[0], stride = p->stride[0];
    for (int g = 0; g < 2; g++)
        for (int i0 = 0; i0 < n; i0 += LANES) {
            pack block[LANES];
            for (int l = 0; l < LANES; l++) {
                const int i = i0 + l;
                block[l] = (pack){0};
                if (i < n)
                    block[l] = signed_as(t, i, factor * x[t->slot[i] + g * t->group]);
            }
            transpose(block);
            for (int l = 0; l < LANES && first + g * LANES + l < last; l++) {
                REAL *const row = field + row_in_field(p, first + g * LANES + l);
                if (stride == 1 && i0 + LANES <= n)
                    store(row + i0, block[l]);
                else
                    for (int i = i0; i < n && i < i0 + LANES; i++)
                        row[(size_t)i * stride] = block[l][i - i0];
            }
        }
}

/* Modes of LINES rows between the packs and the work. The padding is zero at each solve: two packs
 * share a transform, whose round-off would otherwise grow in it from solve to solve and leak back. */
static void modes_to_work(const struct poisson *p, const pack *x, long first, long last)
{
    const struct transform *const t = p->t[0];
    for (int g = 0; g < 2; g++)
        for (int m0 = 0; m0 < p->width[SINGLE]; m0 += LANES) {
            pack block[LANES];
            for (int l = 0; l < LANES; l++)
                block[l] = m0 + l < p->n[0] ? x[(m0 + l) * t->step + g * t->group] : (pack){0};
            transpose(block);
            for (int l = 0; l < LANES && first + g * LANES + l < last; l++)
                store(row_of(p, first + g * LANES + l) + m0, block[l]);
        }
}

static void modes_from_work(const struct poisson *p, long first, long last, pack *x)
{
    const struct transform *const t = p->t[0];
    for (int g = 0; g < 2; g++)
        for (int m0 = 0; m0 < p->n[0]; m0 += LANES) {
            pack block[LANES];
            for (int l = 0; l < LANES; l++) {
                const long line = first + g * LANES + l;
                block[l] = load(row_of(p, line < last ? line : last - 1) + m0);
            }
            transpose(block);
            for (int l = 0; l < LANES && m0 + l < p->n[0]; l++)
                x[(m0 + l) * t->step + g * t->group] = block[l];
        }
}

/* Rows first..last - 1 into the work, LINES at a time, each transformed. */
static void rows_forward(const struct poisson *p, const REAL *field, long first, long last)
{
    struct pair *const x = thread_scratch(p);
    if (!p->t[0]) { /* one cell */
        for (long line = first; line < last; line++)
            row_of(p, line)[0] = field[row_in_field(p, line)];
        return;
    }
    for (long line = first; line < last; line += LINES) {
        gather_rows(p, field, line, last, &x->re);
        const struct pair *const z = forward(p->t[0], x, x + p->n[0]);
        modes_to_work(p, &z->re, line, last);
    }
}

static void rows_backward(const struct poisson *p, long first, long last, REAL *field)
{
    struct pair *const x = thread_scratch(p);
    const REAL factor = (REAL)(1.0 / p->norm);
    if (!p->t[0]) {
        for (long line = first; line < last; line++)
            field[row_in_field(p, line)] = row_of(p, line)[0] * factor;
        return;
    }
    for (long line = first; line < last; line += LINES) {
        modes_from_work(p, line, last, &x->re);
        const struct pair *const z = backward(p->t[0], x, x + p->n[0]);
        scatter_rows(p, &z->re, factor, line, last, field);
    }
}

/* LINES columns of plane k of the work, transformed in place. */
static void columns_transform(const struct poisson *p, int k, int column, bool back)
{
    const struct transform *const t = p->t[1];
    const int n = p->n[1];
    struct pair *const x = thread_scratch(p);
    pack *const in = &x->re;
    for (int j = 0; j < n; j++) {
        const REAL *const from = row_of(p, (long)k * n + j) + column;
        const int at = back ? j * t->step : t->slot[j];
        in[at] = back ? load(from) : signed_as(t, j, load(from));
        in[at + t->group] = back ? load(from + LANES) : signed_as(t, j, load(from + LANES));
    }
    const struct pair *const z = back ? backward(t, x, x + n) : forward(t, x, x + n);
    const pack *const out = &z->re;
    for (int j = 0; j < n; j++) {
        REAL *const to = row_of(p, (long)k * n + j) + column;
        const int at = back ? t->slot[j] : j * t->step;
        store(to, back ? signed_as(t, j, out[at]) : out[at]);
        store(to + LANES, back ? signed_as(t, j, out[at + t->group]) : out[at + t->group]);
    }
}

/* Planes k0..k1 - 1. */
static void planes_forward(const struct poisson *p, const REAL *field, int k0, int k1)
{
    rows_forward(p, field, (long)k0 * p->n[1], (long)k1 * p->n[1]);
    for (int k = k0; k < k1 && p->t[1]; k++)
        for (int column = 0; column < p->n[0]; column += LINES)
            columns_transform(p, k, column, false);
}

static void planes_backward(const struct poisson *p, int k0, int k1, REAL *field)
{
    for (int k = k0; k < k1 && p->t[1]; k++)
        for (int column = 0; column < p->n[0]; column += LINES)
            columns_transform(p, k, column, true);
    rows_backward(p, (long)k0 * p->n[1], (long)k1 * p->n[1], field);
}

/* 0 in place of what is too small to matter: the corners' influence falls off with the distance, and
 * numbers below the smallest normal one are slow. */
static inline pack flushed(pack x)
{
    const pack tiny = (pack){0} + (SINGLE ? (REAL)1e-30 : (REAL)1e-200);
    const pack_index keep = (x > tiny) | (x < -tiny);
    pack_index bits;
    memcpy(&bits, &x, sizeof bits);
    bits &= keep;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Thomas over all layers for `packs` packs of modes: x in place, and w with it where the column
 * is periodic. pivot and w: layers x packs. */
static inline __attribute__((always_inline)) void thomas(const struct poisson *p,
                                                         const REAL *lambda, int packs, REAL *x,
                                                         size_t plane, pack *restrict pivot,
                                                         pack *restrict w, bool wrapped)
{
    const int n = p->n[2];
    for (int k = 0; k < n; k++) {
        const struct layer *const l = &p->layers[k];
        const bool first = k == 0, end = k == 0 || k == n - 1;
        const REAL corner = wrapped && end ? (REAL)p->layers[0].below : (REAL)0;
        const REAL diagonal = (REAL)l->diagonal + corner, flat = (REAL)l->flat;
        const REAL below = first ? (REAL)0 : (REAL)l->below;
        const REAL above = k == n - 1 ? (REAL)0 : (REAL)l->above;
        REAL *const at = x + (size_t)k * plane;
        pack *const g = pivot + k * packs, *const g_below = first ? g : g - packs;
        for (int q = 0; q < packs; q++) {
            const pack d = -diagonal - flat * load(lambda + q * LANES);
            const pack inverse = (REAL)1 / (first ? d : d - below * g_below[q]);
            g[q] = above * inverse;
            const pack r = load(at + q * LANES);
            const pack before = first ? (pack){0} : below * load(at - plane + q * LANES);
            store(at + q * LANES, (r - before) * inverse);
            if (wrapped)
                w[k * packs + q] = flushed(
                    (corner - (first ? (pack){0} : below * w[(k - 1) * packs + q])) * inverse);
        }
    }
    for (int k = n - 2; k >= 0; k--) {
        REAL *const at = x + (size_t)k * plane;
        for (int q = 0; q < packs; q++) {
            const pack g = pivot[k * packs + q];
            store(at + q * LANES, load(at + q * LANES) - g * load(at + plane + q * LANES));
            if (wrapped)
                w[k * packs + q] = flushed(w[k * packs + q] - g * w[(k + 1) * packs + q]);
        }
    }
}

/* A periodic column is a tridiagonal one plus a rank-one part at the corners (Sherman and
 * Morrison): A = T + u v^T, u = (c, 0, ..., 0, c), v = (1, 0, ..., 0, 1). */
static void unwrap(const struct poisson *p, int packs, REAL *x, size_t plane, const pack *w)
{
    const int n = p->n[2];
    const REAL *const last = x + (size_t)(n - 1) * plane;
    pack factor[SWEEP_PACKS];
    for (int q = 0; q < packs; q++)
        factor[q] = (load(x + q * LANES) + load(last + q * LANES)) /
                    ((REAL)1 + w[q] + w[(n - 1) * packs + q]);
    for (int k = 0; k < n; k++)
        for (int q = 0; q < packs; q++) {
            REAL *const at = x + (size_t)k * plane + q * LANES;
            store(at, load(at) - factor[q] * w[k * packs + q]);
        }
}

/* The modes of `packs` packs from `first` of a plane on. */
static void sweep(const struct poisson *p, size_t first, int packs)
{
    const size_t plane = (size_t)p->width[SINGLE] * p->n[1];
    const int n = p->n[2];
    REAL *const x = (REAL *)p->work + first;
    pack *const pivot = (pack *)thread_scratch(p), *const w = pivot + (size_t)n * SWEEP_PACKS;
    double *const column = (double *)(w + (size_t)n * SWEEP_PACKS);
    REAL lambda[SWEEP_PACKS * LANES] __attribute__((aligned(64)));
    memcpy(lambda, (const REAL *)p->lambda_wide[SINGLE] + first, (size_t)packs * sizeof(pack));
    const bool singular = p->singular && first == 0;
    if (singular) {
        for (int k = 0; k < n; k++)
            column[k] = (double)x[(size_t)k * plane];
        poisson_singular_column(p, column);
        lambda[0] = (REAL)(1.0 / (p->g->h[2] * p->g->h[2])); /* anything: it is replaced */
    }
    if (p->side[Z_LO] == POISSON_PERIODIC && n > 1) {
        thomas(p, lambda, packs, x, plane, pivot, w, true);
        unwrap(p, packs, x, plane, w);
    } else {
        thomas(p, lambda, packs, x, plane, pivot, w, false);
    }
    for (int k = 0; k < n && singular; k++)
        x[(size_t)k * plane] = (REAL)column[k];
}

static void hooked(const struct poisson_hook *hook, int k0, int k1)
{
    if (hook)
        hook->after(hook->with, k0, k1);
}

/* Few planes: threads share each of them. */
static void few_forward(const struct poisson *p, const REAL *rhs)
{
    const long lines = (long)p->n[1] * p->n[2];
    const int groups = (p->n[0] + LINES - 1) / LINES;
#pragma omp for schedule(static)
    for (long line = 0; line < lines; line += LINES)
        rows_forward(p, rhs, line, line + LINES < lines ? line + LINES : lines);
#pragma omp for schedule(static)
    for (int q = 0; q < (p->t[1] ? groups * p->n[2] : 0); q++)
        columns_transform(p, q / groups, q % groups * LINES, false);
}

static void few_backward(const struct poisson *p, REAL *out, const struct poisson_hook *hook)
{
    const long lines = (long)p->n[1] * p->n[2];
    const int groups = (p->n[0] + LINES - 1) / LINES;
#pragma omp for schedule(static)
    for (int q = 0; q < (p->t[1] ? groups * p->n[2] : 0); q++)
        columns_transform(p, q / groups, q % groups * LINES, true);
#pragma omp for schedule(static)
    for (long line = 0; line < lines; line += LINES)
        rows_backward(p, line, line + LINES < lines ? line + LINES : lines, out);
#pragma omp for schedule(static)
    for (int k = 0; k < p->n[2]; k++)
        hooked(hook, k, k + 1);
}

/* Planes taken together, so that their rows fill the lanes. */
static int planes_of_slab(const struct poisson *p)
{
    return p->n[1] >= LINES ? 1 : LINES / p->n[1];
}

static void direct(const struct poisson *p, const REAL *rhs, REAL *out,
                   const struct poisson_hook *hook)
{
    const int n = p->n[2], slab = planes_of_slab(p), slabs = (n + slab - 1) / slab;
    const size_t modes = (size_t)p->width[SINGLE] * p->n[1], block = SWEEP_PACKS * LANES;
    const long blocks = (long)((modes + block - 1) / block);
#pragma omp parallel if (modes * n > POISSON_SERIAL)
    {
        if (slabs < FEW_PLANES) {
            few_forward(p, rhs);
        } else {
#pragma omp for schedule(static)
            for (int q = 0; q < slabs; q++) {
                const int k0 = q * slab, k1 = k0 + slab < n ? k0 + slab : n;
                planes_forward(p, rhs, k0, k1);
            }
        }
#pragma omp for schedule(static)
        for (long q = 0; q < blocks; q++) {
            const size_t first = (size_t)q * block, left = (modes - first) / LANES;
            sweep(p, first, left < SWEEP_PACKS ? (int)left : SWEEP_PACKS);
        }
        if (slabs < FEW_PLANES) {
            few_backward(p, out, hook);
        } else {
#pragma omp for schedule(static)
            for (int q = 0; q < slabs; q++) {
                const int k0 = q * slab, k1 = k0 + slab < n ? k0 + slab : n;
                planes_backward(p, k0, k1, out);
                hooked(hook, k0, k1);
            }
        }
    }
}
