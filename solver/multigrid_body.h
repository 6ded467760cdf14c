/* multigrid_body.h - one V-cycle of geometric multigrid as a preconditioner, for coefficients of
 * any contrast, boxes of any size (odd ones, one cell thick) and all sides.
 *
 * Cells are joined in pairs along each direction whose faces pass about as much as those of the
 * strongest one (a last odd cell stays alone), until one cell is left. A face of a joined cell
 * passes what the fine faces in it pass, less by the larger distance of the centres. (With the
 * inner faces of the pairs in series, as in homogenisation, sharp fields of contrast 1e3 took four
 * times the iterations, 1e6 did not converge.) Residuals go down as sums and corrections come up
 * as constants, so the cycle is symmetric [Wesseling92, sec. 5.4]. Smoothing: two
 * Jacobi steps before and after, with the factors of Chebyshev's polynomial for the upper part
 * of the spectrum [AdamsEtAl03].
 *
 * A body, included once for each precision after rows_body.h. */

enum { LEVELS_MOST = 64, STEPS = 2 };

struct level {
    struct stencil t;
    int factor[3]; /* cells joined into one of the next level */
    REAL *inverse; /* of the diagonal; 0 where there is none */
    REAL *x, *x_new, *b;
    bool owns; /* c (the finest level's is the caller's) */
};

struct multigrid {
    int levels;
    struct level level[LEVELS_MOST];
};

static void level_allocate(struct level *l, bool owns)
{
    struct stencil *const t = &l->t;
    l->owns = owns;
    l->inverse = xalloc(t->total, sizeof(REAL));
    l->x = xalloc(t->total, sizeof(REAL));
    l->x_new = xalloc(t->total, sizeof(REAL));
    l->b = owns ? xalloc(t->total, sizeof(REAL)) : NULL;
    for (int a = 0; a < 3; a++) {
        t->c[a] = owns ? xalloc(t->total, sizeof(REAL)) : t->c[a];
        t->weight[a] = xalloc((size_t)t->n[a], sizeof(REAL));
        for (int i = 0; i < t->n[a]; i++)
            t->weight[a][i] = 1;
    }
}

static void level_free(struct level *l)
{
    xfree(l->inverse);
    xfree(l->x);
    xfree(l->x_new);
    for (int a = 0; a < 3; a++) {
        xfree(l->owns ? l->t.c[a] : NULL);
        xfree(l->t.weight[a]);
    }
    xfree(l->b);
}

static struct multigrid *multigrid_create(const struct stencil *t)
{
    struct multigrid *const m = xalloc(1, sizeof *m);
    m->levels = 1;
    m->level[0].t = *t;
    level_allocate(&m->level[0], false);
    return m;
}

static void multigrid_free(struct multigrid *m)
{
    if (!m)
        return;
    for (int l = 0; l < m->levels; l++)
        level_free(&m->level[l]);
    xfree(m);
}

/* Mean of what the inner faces of direction a pass. */
static double strength(const struct stencil *t, int a)
{
    double sum = 0.0;
    long count = 0;
    if (t->n[a] == 1)
        return 0.0;
    for (long row = 0; row < rows_of(t); row++) {
        const long at_a = a == 1 ? row % t->n[1] : row / t->n[1];
        if (a > 0 && at_a == 0)
            continue;
        double part = 0.0;
        for (int i = a == 0; i < t->n[0]; i++)
            part += (double)t->c[a][row_at(t, row) + i];
        sum += part;
        count += t->n[0] - (a == 0);
    }
    return sum / (double)count;
}

static void choose_factors(struct level *l)
{
    double s[3], most = 0.0;
    for (int a = 0; a < 3; a++)
        most = fmax(most, s[a] = strength(&l->t, a));
    bool any = false;
    for (int a = 0; a < 3; a++) {
        l->factor[a] = l->t.n[a] > 1 && s[a] >= 0.25 * most ? 2 : 1;
        any = any || l->factor[a] == 2;
    }
    for (int a = 0; a < 3 && !any; a++)
        l->factor[a] = l->t.n[a] > 1 ? 2 : 1;
}

/* Sizes and strides of the next level; true if they are those that it has. */
static bool next_shape(const struct level *fine, struct stencil *t)
{
    const struct stencil old = *t;
    t->total = 1;
    t->start = 0;
    for (int a = 0; a < 3; a++) {
        t->n[a] = (fine->t.n[a] + fine->factor[a] - 1) / fine->factor[a];
        t->s[a] = (int)t->total;
        t->start += t->s[a];
        t->total *= (size_t)t->n[a] + 2;
        t->periodic[a] = fine->t.periodic[a];
    }
    t->shift = fine->t.shift;
    return old.n[0] == t->n[0] && old.n[1] == t->n[1] && old.n[2] == t->n[2];
}

static inline size_t cell_of(const struct stencil *t, const int at[3])
{
    return (size_t)t->start + (size_t)at[0] * t->s[0] + (size_t)at[1] * t->s[1] +
           (size_t)at[2] * t->s[2];
}

/* Between the centres of cells i - 1 and i (from 0) of direction a, or from a side to the centre
 * next to it; in cells of the finest level. */
static double spacing(const struct stencil *t, int a, int i)
{
    const int n = t->n[a];
    const double below = i > 0 || t->periodic[a] ? (double)t->weight[a][(i + n - 1) % n] : 0.0;
    const double above = i < n || t->periodic[a] ? (double)t->weight[a][i % n] : 0.0;
    return 0.5 * (below + above);
}

/* Low faces of direction a of a coarse row of n cells: the fine faces in them, summed. */
static void coarse_row(const struct level *l, const struct stencil *t, int a, int j, int k,
                       int n, REAL *restrict out)
{
    const struct stencil *const f = &l->t;
    const int *const factor = l->factor;
    const int first[3] = {0, j * factor[1], k * factor[2]};
    int last[3]; /* of the fine rows in it; one where they make the face */
    for (int d = 1; d < 3; d++) {
        const int end = first[d] + factor[d] < f->n[d] ? first[d] + factor[d] : f->n[d];
        last[d] = d == a ? first[d] + 1 : end;
    }
    const int beyond = a == 1 ? j == t->n[1] : a == 2 && k == t->n[2]; /* the far side */
    const int j0 = a == 1 && beyond ? f->n[1] : first[1], j1 = a == 1 ? j0 + 1 : last[1];
    const int k0 = a == 2 && beyond ? f->n[2] : first[2], k1 = a == 2 ? k0 + 1 : last[2];
    for (int i = 0; i < n; i++)
        out[i] = 0;
    for (int z = k0; z < k1; z++)
        for (int y = j0; y < j1; y++) {
            const REAL *const c =
                f->c[a] + f->start + (size_t)y * f->s[1] + (size_t)z * f->s[2];
            for (int i = 0; i < n; i++) {
                const int x = i * factor[0] < f->n[0] ? i * factor[0] : f->n[0];
                out[i] += c[x];
                if (a != 0 && factor[0] == 2 && x + 1 < f->n[0])
                    out[i] += c[x + 1];
            }
        }
}

static void coarse_faces(const struct level *l, struct stencil *t)
{
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < t->n[a]; i++) {
            t->weight[a][i] = 0;
            for (int f = i * l->factor[a]; f < (i + 1) * l->factor[a] && f < l->t.n[a]; f++)
                t->weight[a][i] += l->t.weight[a][f];
        }
    for (int a = 0; a < 3; a++) {
        const int n[3] = {t->n[0] + (a == 0), t->n[1] + (a == 1), t->n[2] + (a == 2)};
#pragma omp parallel for schedule(static) if (worth_threads(t))
        for (int row = 0; row < n[1] * n[2]; row++) {
            const int j = row % n[1], k = row / n[1];
            REAL *const out = t->c[a] + t->start + (size_t)j * t->s[1] + (size_t)k * t->s[2];
            coarse_row(l, t, a, j, k, n[0], out);
            for (int i = 0; i < n[0]; i++) {
                const int at = a == 0 ? i : a == 1 ? j : k;
                const int fine = at < t->n[a] ? at * l->factor[a] : l->t.n[a];
                out[i] *= (REAL)(spacing(&l->t, a, fine) / spacing(t, a, at));
            }
        }
    }
}

static void invert_diagonal(struct level *l)
{
    const struct stencil *const t = &l->t;
#pragma omp parallel for schedule(static) if (worth_threads(t))
    for (long row = 0; row < rows_of(t); row++) {
        const size_t at = row_at(t, row);
        for (int i = 0; i < t->n[0]; i++) {
            double sum = t->shift;
            if (t->weight[0])
                sum *= (double)(t->weight[0][i] * t->weight[1][row % t->n[1]] *
                                t->weight[2][row / t->n[1]]);
            for (int a = 0; a < 3; a++)
                if (!(t->periodic[a] && t->n[a] == 1))
                    sum += (double)t->c[a][at + i] + (double)t->c[a][at + i + t->s[a]];
            l->inverse[at + i] = sum > 0.0 ? (REAL)(-1.0 / sum) : (REAL)0;
        }
    }
}

static void multigrid_coarsen(struct multigrid *m, const struct stencil *finest)
{
    m->level[0].t.shift = finest->shift;
    for (int at = 0;; at++) {
        struct level *const l = &m->level[at], *const next = l + 1;
        invert_diagonal(l);
        if ((size_t)l->t.n[0] * l->t.n[1] * l->t.n[2] == 1 || at + 1 == LEVELS_MOST) {
            for (; m->levels > at + 1; m->levels--)
                level_free(&m->level[m->levels - 1]);
            return;
        }
        choose_factors(l);
        struct stencil t = next->t;
        if (!next_shape(l, &t) || at + 1 >= m->levels) {
            if (at + 1 < m->levels)
                level_free(next);
            next->t = t;
            level_allocate(next, true);
            m->levels = m->levels > at + 2 ? m->levels : at + 2;
        }
        next->t.shift = t.shift;
        coarse_faces(l, &next->t);
    }
}

/* x_new = x + omega (b - A x)/diagonal, then they change places. In a team. */
static void jacobi(struct level *l, const REAL *b, REAL omega)
{
    const struct stencil *const t = &l->t;
    const int n = t->n[0];
    const REAL *const x = l->x, *const inverse = l->inverse;
    REAL *const x_new = l->x_new;
    const long rows = rows_of(t);
    all_ghosts(t, l->x);
#pragma omp for schedule(static)
    for (long row = 0; row < rows; row++) {
        const size_t at = row_at(t, row);
        REAL *const restrict out = x_new + at;
        row_apply(t, x + at, at, row, out);
        for (int i = 0; i < n; i++)
            out[i] = x[at + i] + omega * inverse[at + i] * (b[at + i] - out[i]);
        row_ghosts(t, out);
    }
#pragma omp single
    {
        REAL *const swap = l->x;
        l->x = l->x_new;
        l->x_new = swap;
    }
}

/* The step from x = 0. */
static void jacobi_first(struct level *l, const REAL *b, REAL omega)
{
    const struct stencil *const t = &l->t;
    const long rows = rows_of(t);
#pragma omp for schedule(static)
    for (long row = 0; row < rows; row++) {
        const size_t at = row_at(t, row);
        for (int i = 0; i < t->n[0]; i++)
            l->x[at + i] = omega * l->inverse[at + i] * b[at + i];
        row_ghosts(t, l->x + at);
    }
}

/* Residuals of the rows that coarse row `row` holds, summed into it. */
static void restrict_row(struct level *l, const REAL *b, struct level *next, long row)
{
    const struct stencil *const t = &l->t, *const c = &next->t;
    const int n = t->n[0], j0 = (int)(row % c->n[1]) * l->factor[1],
              k0 = (int)(row / c->n[1]) * l->factor[2];
    REAL *const sum = next->b + row_at(c, row);
    for (int i = 0; i < c->n[0]; i++)
        sum[i] = 0;
    for (int k = k0; k < k0 + l->factor[2] && k < t->n[2]; k++)
        for (int j = j0; j < j0 + l->factor[1] && j < t->n[1]; j++) {
            const long fine = (long)k * t->n[1] + j;
            const size_t at = row_at(t, fine);
            REAL *const restrict left = l->x_new + at;
            row_apply(t, l->x + at, at, fine, left);
            for (int i = 0; i < n; i++)
                left[i] = b[at + i] - left[i];
            if (l->factor[0] == 1)
                for (int i = 0; i < n; i++)
                    sum[i] += left[i];
            else
                for (int i = 0; i < n / 2; i++)
                    sum[i] += left[2 * i] + left[2 * i + 1];
            if (l->factor[0] == 2 && n % 2)
                sum[n / 2] += left[n - 1];
        }
}

static void prolong_row(struct level *l, const struct level *next, long row)
{
    const struct stencil *const t = &l->t, *const c = &next->t;
    const int n = t->n[0];
    const long coarse =
        (row / t->n[1]) / l->factor[2] * c->n[1] + (row % t->n[1]) / l->factor[1];
    REAL *const restrict x = l->x + row_at(t, row);
    const REAL *const e = next->x + row_at(c, coarse);
    if (l->factor[0] == 1)
        for (int i = 0; i < n; i++)
            x[i] += e[i];
    else
        for (int i = 0; i < n / 2; i++) {
            x[2 * i] += e[i];
            x[2 * i + 1] += e[i];
        }
    if (l->factor[0] == 2 && n % 2)
        x[n - 1] += e[n / 2];
    row_ghosts(t, x);
}

/* Chebyshev's roots between a share of the largest eigenvalue of A/diagonal, 2, and it. */
static REAL omega_of(int step)
{
    const double high = 2.0, low = 0.3, pi = 3.14159265358979323846;
    return (REAL)(1.0 /
                  (0.5 * (high + low) + 0.5 * (high - low) * cos(pi * (step + 0.5) / STEPS)));
}

static void descend(struct multigrid *m, int at, const REAL *b)
{
    struct level *const l = &m->level[at], *const next = l + 1;
    if (at == m->levels - 1) {
        jacobi_first(l, b, 1); /* one cell: exact */
        return;
    }
    const long rows = rows_of(&l->t), coarse = rows_of(&next->t);
#pragma omp parallel if (worth_threads(&l->t))
    {
        jacobi_first(l, b, omega_of(0));
        for (int step = 1; step < STEPS; step++)
            jacobi(l, b, omega_of(step));
        all_ghosts(&l->t, l->x);
#pragma omp for schedule(static)
        for (long row = 0; row < coarse; row++)
            restrict_row(l, b, next, row);
    }
    descend(m, at + 1, next->b);
#pragma omp parallel if (worth_threads(&l->t))
    {
#pragma omp for schedule(static)
        for (long row = 0; row < rows; row++)
            prolong_row(l, next, row);
        for (int step = STEPS - 1; step >= 0; step--)
            jacobi(l, b, omega_of(step));
    }
}

/* z = the cycle's answer to A z = r */
static void multigrid_cycle(struct multigrid *m, const REAL *r, REAL *z)
{
    struct level *const l = &m->level[0];
    descend(m, 0, r);
    memcpy(z, l->x, l->t.total * sizeof(REAL));
}
