/* krylov_body.h - conjugate gradients, see krylov.h: few passes over memory, sums by rows.
 * A body, included once for each precision after rows_body.h and multigrid_body.h. */

static struct stencil stencil_of(const struct krylov *w)
{
    const struct box *const b = w->box;
    struct stencil t = {.start = b->start, .total = b->total, .shift = w->shift};
    for (int a = 0; a < 3; a++) {
        t.n[a] = b->n[a];
        t.s[a] = b->s[a];
        t.periodic[a] = w->periodic[a];
        t.c[a] = w->c[a];
    }
    return t;
}

static struct krylov *krylov_create(const struct box *b, const bool periodic[3],
                                    struct poisson *direct, double *const lent[2])
{
    struct krylov *const w = xalloc(1, sizeof *w);
    w->box = b;
    w->real = sizeof(REAL);
    w->direct = direct;
    void **const own[] = {&w->c[0], &w->c[1], &w->c[2], &w->x};
    void **const scratch[] = {&w->r, &w->z, &w->s, &w->q};
    w->lent = lent && 2 * sizeof(REAL) == sizeof(double);
    for (int i = 0; i < 4; i++) {
        *own[i] = xalloc(b->total, sizeof(REAL));
        *scratch[i] = w->lent
                          ? (void *)((REAL *)(void *)lent[i / 2] + (size_t)(i % 2) * b->total)
                          : xalloc(b->total, sizeof(REAL));
    }
    w->part = xalloc(2 * (size_t)b->n[1] * b->n[2], sizeof *w->part);
    w->flat = xalloc((size_t)b->n[2] + 2, sizeof *w->flat);
    w->up = xalloc((size_t)b->n[2] + 2, sizeof *w->up);
    for (int a = 0; a < 3; a++)
        w->periodic[a] = periodic[a];
    return w;
}

static void krylov_free(struct krylov *w)
{
    if (!w)
        return;
    multigrid_free(w->multigrid);
    void *const scratch[] = {w->r, w->z, w->s, w->q};
    for (int i = 0; i < 4 && !w->lent; i++)
        xfree(scratch[i]);
    void *const all[] = {w->c[0], w->c[1], w->c[2], w->x, w->part, w->flat, w->up, w};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}

static void krylov_start(struct krylov *w)
{
    const struct stencil t = stencil_of(w);
    const size_t plane = (size_t)t.s[2], row = (size_t)t.s[1];
    REAL *const fields[] = {w->r, w->z, w->s, w->q};
#pragma omp parallel for schedule(static) if (worth_threads(&t))
    for (int k = 0; k < t.n[2] + 2; k++)
        for (int i = 0; i < 4 && w->lent; i++) {
            REAL *const at = fields[i] + (size_t)k * plane;
            const bool whole = k == 0 || k == t.n[2] + 1;
            for (int j = 0; j < t.n[1] + 2; j++) {
                REAL *const cells = at + (size_t)j * row;
                if (whole || j == 0 || j == t.n[1] + 1)
                    memset(cells, 0, row * sizeof(REAL));
                cells[0] = cells[t.n[0] + 1] = (REAL)0;
            }
        }
}

static void krylov_coarsen(struct krylov *w)
{
    const struct stencil t = stencil_of(w);
    if (!w->multigrid)
        w->multigrid = multigrid_create(&t);
    multigrid_coarsen(w->multigrid, &t);
}

/* Rows first..last - 1: their parts of z r and z q. */
static void row_products(const struct krylov *w, const struct stencil *t, long first, long last)
{
    const REAL *const z = w->z, *const r = w->r, *const q = w->q;
    for (long row = first; row < last; row++) {
        const size_t at = row_at(t, row);
        w->part[row] = row_dot(z + at, r + at, t->n[0]);
        w->part[rows_of(t) + row] = row_dot(z + at, q + at, t->n[0]);
    }
}

static void after_planes(void *with, int lo, int hi)
{
    const struct krylov *const w = with;
    const struct stencil t = stencil_of(w);
    row_products(w, &t, (long)lo * t.n[1], (long)hi * t.n[1]);
}

/* z = M r; *rz, *zq: their products with z */
static void precondition(struct krylov *w, const struct stencil *t, bool multigrid, double *rz,
                         double *zq)
{
    const struct poisson_hook hook = {after_planes, w};
    if (multigrid) {
        multigrid_cycle(w->multigrid, w->r, w->z);
#pragma omp parallel for schedule(static) if (worth_threads(t))
        for (int k = 0; k < t->n[2]; k++)
            row_products(w, t, (long)k * t->n[1], (long)(k + 1) * t->n[1]);
    } else {
        DIRECT(w->direct, w->flat, w->up, w->shift, w->r, w->z, &hook);
    }
    *rz = sum_rows(t, w->part);
    *zq = sum_rows(t, w->part + rows_of(t));
}

/* s = z + beta s on plane k, ghosts in the plane; beta = 0: whatever s holds. */
static void turn_plane(struct krylov *w, const struct stencil *t, int k, REAL beta)
{
    REAL *const s = w->s;
    const REAL *const z = w->z;
    const int n = t->n[0];
    for (int j = 0; j < t->n[1]; j++) {
        const size_t at = row_at(t, (long)k * t->n[1] + j);
        if (beta != (REAL)0)
            for (int i = 0; i < n; i++)
                s[at + i] = z[at + i] + beta * s[at + i];
        else
            memcpy(s + at, z + at, (size_t)n * sizeof(REAL));
        row_ghosts(t, s + at);
    }
    plane_ghosts(t, s, k);
}

/* q = A s on plane k, and its products with s. */
static void apply_plane(struct krylov *w, const struct stencil *t, int k)
{
    REAL *const s = w->s, *const q = w->q;
    for (long row = (long)k * t->n[1]; row < (long)(k + 1) * t->n[1]; row++) {
        const size_t at = row_at(t, row);
        row_apply(t, s + at, at, row, q + at);
        w->part[row] = row_dot(s + at, q + at, t->n[0]);
    }
}

/* s = z + beta s, q = A s; returns s q. One pass: a plane is turned just before it is a neighbour; the
 * first and the last plane of each thread before all others. */
static double turn(struct krylov *w, const struct stencil *t, REAL beta)
{
#pragma omp parallel if (worth_threads(t))
    {
        const int threads = omp_get_num_threads(), me = omp_get_thread_num();
        const int lo = (int)((long)t->n[2] * me / threads);
        const int hi = (int)((long)t->n[2] * (me + 1) / threads);
        if (lo < hi)
            turn_plane(w, t, lo, beta);
        if (lo < hi - 1)
            turn_plane(w, t, hi - 1, beta);
#pragma omp barrier
        end_ghosts(t, w->s);
        for (int k = lo; k < hi; k++) {
            if (k + 1 < hi - 1)
                turn_plane(w, t, k + 1, beta);
            apply_plane(w, t, k);
        }
    }
    return sum_rows(t, w->part);
}

/* x += alpha s, r -= alpha q; returns r r */
static double advance(struct krylov *w, const struct stencil *t, REAL alpha)
{
    REAL *const x = w->x, *const r = w->r;
    const REAL *const s = w->s, *const q = w->q;
    const int n = t->n[0];
    const long rows = rows_of(t);
#pragma omp parallel for schedule(static) if (worth_threads(t))
    for (long row = 0; row < rows; row++) {
        const size_t at = row_at(t, row);
        for (int i = 0; i < n; i++) {
            x[at + i] += alpha * s[at + i];
            r[at + i] -= alpha * q[at + i];
        }
        w->part[row] = row_dot(r + at, r + at, n);
    }
    return sum_rows(t, w->part);
}

static int krylov_solve(struct krylov *w, bool multigrid, bool fresh, double goal, int most,
                        double *end)
{
    const struct stencil t = stencil_of(w);
    int iterations = 0;
    double alpha = 0.0;
    for (*end = (double)INFINITY; *end > goal && iterations < most; iterations++) {
        double rz, zq;
        precondition(w, &t, multigrid, &rz, &zq);
        double beta = 0.0;
        if (iterations > 0)
            beta = -alpha * zq / w->rz;
        else if (!fresh)
            beta = rz / w->rz;
        w->rz = rz;
        const double sq = turn(w, &t, (REAL)beta);
        if (!(fabs(sq) > 0.0))
            break;
        alpha = rz / sq;
        *end = sqrt(advance(w, &t, (REAL)alpha));
    }
    return iterations;
}
