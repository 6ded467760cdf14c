/* contact_points_block.c - a block of points of contact: entered, filled up, put through the laws, added to
 * the grains. */
#include "contact_points.h"

int points_enter(const struct sim *s, struct block *b, const struct point_of *o)
{
    const struct shape_point *const p = o->p;
    const struct body *const body = &s->bodies[o->i];
    const int c = b->n++;
    struct touch *const t = &b->t;
    struct levers *const l = &b->l;
    b->slot[c] = o->slot;
    b->c.i[c] = o->i;
    b->c.j[c] = o->j;
    b->memory[c] = o->record + RECORD_HEAD;
    b->was[c] = o->was;
    b->scale[c] = (real)p->scale;
    b->share[c] = p->share > 0.0 ? (real)p->share : (real)1.0;
    b->slope[c] = p->slope > 0.0 ? (real)p->slope : (real)1.0;
    b->lever[c] = p->lever;
    b->rocks = b->rocks || v3_dot(p->lever, p->lever) > 0.0;
    t->depth[c] = (real)p->depth;
    t->nx[c] = (real)p->normal.x;
    t->ny[c] = (real)p->normal.y;
    t->nz[c] = (real)p->normal.z;
    t->r_i[c] = (real)p->r_i;
    t->r_j[c] = (real)p->r_j;
    l->ix[c] = (real)p->at_i.x;
    l->iy[c] = (real)p->at_i.y;
    l->iz[c] = (real)p->at_i.z;
    l->jx[c] = (real)p->at_j.x;
    l->jy[c] = (real)p->at_j.y;
    l->jz[c] = (real)p->at_j.z;
    b->px[c] = body->spin[0];
    b->py[c] = body->spin[1];
    b->pz[c] = body->spin[2];
    return c;
}

/* Lanes without a contact of their own repeat the last one. */
static void pad(struct block *b)
{
    struct touch *const t = &b->t;
    const int last = b->n - 1;
    int n = b->n;
    for (; n % TOUCH_LANES != 0; n++) {
        real *const array[] = {t->depth, t->nx,    t->ny,    t->nz,    t->r_i,  t->r_j,
                               b->curve, b->inv_m, t->vx,    t->vy,    t->vz,   b->vx,
                               b->vy,    b->vz,    b->px,    b->py,    b->pz,   b->qx,
                               b->qy,    b->qz,    b->l.ix,  b->l.iy,  b->l.iz, b->l.jx,
                               b->l.jy,  b->l.jz,  b->scale, b->share, b->slope};
        for (size_t k = 0; k < sizeof array / sizeof array[0]; k++)
            array[k][n] = array[k][last];
        b->slot[n] = b->slot[last];
        b->c.i[n] = b->c.i[last];
        b->c.j[n] = b->c.j[last];
        b->c.wall[n] = b->c.wall[last];
        b->memory[n] = b->memory[last];
        b->was[n] = b->was[last];
        t->pair[n] = t->pair[last];
    }
    b->c.n = t->n = n;
}

/* Where j is flat. */
static void reduce_flat(struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++)
        if (t->r_j[c] == (real)0.0) {
            t->m_eff[c] = 1.0 / b->inv_m[c];
            t->r_eff[c] = t->r_i[c] / (1.0 + (b->walls ? b->curve[c] * t->r_i[c] : 0.0));
        }
}

static void starts(struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++)
        t->start[c] = !b->was[c] && t->depth[c] > (real)0.0 ? laws_first_part(t, c) : (real)1.0;
}

static void load_memory(struct block *b, int law_rows)
{
    for (int c = 0; c < b->t.n; c++)
        for (int k = 0; k < law_rows; k++)
            b->history[k][c] = b->memory[c][k];
}

static void keep(struct block *b, int law_rows)
{
    for (int c = 0; c < b->n; c++)
        for (int k = 0; k < law_rows; k++)
            b->memory[c][k] = b->history[k][c];
}

/* Points that share one stiffness take their parts of what the laws give for the whole. */
static void share_out(struct block *b)
{
    struct touch *const t = &b->t;
    for (int c = 0; c < t->n; c++) {
        const real part = b->share[c] * b->slope[c];
        t->fx[c] *= part;
        t->fy[c] *= part;
        t->fz[c] *= part;
        t->mx[c] *= part;
        t->my[c] *= part;
        t->mz[c] *= part;
    }
}

static void guard(const struct block *b, real most, struct report *r)
{
    for (int c = 0; c < b->n; c++)
        if (b->t.depth[c] > most * b->scale[c]) {
            r->too_deep = true;
            r->i = b->c.i[c];
            r->j = b->walls ? -1 - b->wall[c] : b->c.j[c];
            r->deep = (double)b->t.depth[c];
            r->allowed = (double)(most * b->scale[c]);
        }
    r->too_deep = r->too_deep || r->points > 0;
}

static void report_all(const struct sim *s, struct block *b, struct report *r)
{
    r->energy += laws_energy(b, s->neighbours.reach, b->share);
    for (int c = 0; c < b->n; c++) {
        const double depth = (double)b->t.depth[c];
        r->touching += depth > 0.0;
        r->overlap = fmax(r->overlap, depth / (double)b->scale[c]);
        if (s->contacts->watched)
            points_note_seen(s, b, c, r);
    }
}

void points_work(struct sim *s, struct block *b, const struct target *to)
{
    struct slots *const l = b->walls ? &s->neighbours.walls : &s->neighbours.pairs;
    const int law_rows = laws_rows();
    if (b->n == 0)
        return;
    pad(b);
    laws_reduce(b);
    reduce_flat(b);
    b->t.dt = s->run.dt;
    b->t.time = to->time;
    laws_velocities(b);
    starts(b);
    load_memory(b, law_rows);
    laws_apply(s, b);
    if (b->rocks)
        points_rock(s, b);
    share_out(b);
    laws_note_broken(s, b, l, to->time);
    keep(b, law_rows);
    laws_pack(b);
    if (b->rocks)
        points_add_rocking(b);
    guard(b, (real)s->run.overlap_max, to->report);
    if (to->asked)
        report_all(s, b, to->report);
    if (b->walls)
        laws_add_walls(b, to);
    else
        laws_add(b, s->neighbours.to, to);
    if (!b->walls && s->grains.n_frozen > 0)
        laws_add_skeleton(&s->grains, b, to->report);
    b->n = 0;
    b->rocks = false;
}
