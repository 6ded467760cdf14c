/* contact_points.c - contacts of grains of any shape: a slot has as many as the shape finds.
 *
 * The points of pair after pair are packed into blocks and go through the same laws as those of
 * spheres. A contact finds its memory by its id among the records of its slot; one whose id is new
 * takes the nearest record that has just been left, if that contact was close by: so friction
 * survives when a vertex rolls over an edge. */
#include "contact_points.h"

#include "turning.h"

enum { AHEAD = 4 }; /* slots, whose memory is fetched before it is needed */

#define TUMBLE 0.1 /* rad a step */

#define CLOSE 0.1 /* of the size: a new contact goes on with the memory of one this near */

struct cut points_cut(const struct sim *s)
{
    struct cut c = {.rows = laws_rows(), .head = (shape.memory + 3) / 4 * 4, .most = 1};
    c.first = c.head + SLOT_HEAD;
    for (int k = 0; k < s->grains.n_species; k++) {
        const int most = s->grains.species[k].form.points_most;
        c.most = most > c.most ? most : c.most;
    }
    if (c.most > POINTS_MOST)
        c.most = POINTS_MOST;
    return c;
}

int points_rows(const struct sim *s)
{
    const struct cut c = points_cut(s);
    return c.first + c.most * (RECORD_HEAD + c.rows);
}

struct shape_pose points_pose(const struct sim *s, int i)
{
    const struct grains *const g = &s->grains;
    const int kind = g->kind[i];
    return (struct shape_pose){.species = kind,
                               .size = g->radius[i] / g->species[kind].form.bounding,
                               .q = g->orientation[i],
                               .turn = quat_matrix(g->orientation[i])};
}

/* Velocities of i less those of j, at the half step and at the full one. */
static void enter_pair(const struct sim *s, struct block *b, const struct point_of *o)
{
    const struct grains *const g = &s->grains;
    const int c = points_enter(s, b, o);
    const struct body *const i = &s->bodies[o->i], *const j = &s->bodies[o->j];
    const vec3 more = v3_sub(v3_cross(g->full_spin[o->i], o->p->from_i),
                             v3_cross(g->full_spin[o->j], o->p->from_j));
    b->t.vx[c] = i->vel[0] - j->vel[0];
    b->t.vy[c] = i->vel[1] - j->vel[1];
    b->t.vz[c] = i->vel[2] - j->vel[2];
    b->vx[c] = i->full[0] - j->full[0] + (real)more.x;
    b->vy[c] = i->full[1] - j->full[1] + (real)more.y;
    b->vz[c] = i->full[2] - j->full[2] + (real)more.z;
    b->qx[c] = j->spin[0];
    b->qy[c] = j->spin[1];
    b->qz[c] = j->spin[2];
    b->inv_m[c] = i->vel[3] + j->vel[3];
    b->c.wall[c] = NULL;
    b->t.pair[c] = (int)i->full[3] * g->n_materials + (int)j->full[3];
}

/* Tells of the first run that has something to tell. */
void points_stop(const struct sim *s)
{
    for (int run = 0; run < s->neighbours.runs; run++) {
        const struct report *const r = &s->contacts->report[run];
        if (r->points > 0)
            die(EXIT_UNSTABLE,
                "two bodies touch at %d points, more than there is room for (%d), at t = %.9g "
                "s: "
                "they overlap too much, or the shape needs more points",
                r->points, points_cut(s).most, s->t);
        if (r->too_deep)
            contact_die(s, r->i, r->j,
                        xprintf("%.3g m, where %.3g m are allowed,", r->deep, r->allowed));
    }
}

/* Finds the memory of a slot's points and enters them. */
static void enter_points(struct sim *s, struct block *b, const struct cut *cut, int slot,
                         const struct shape_pair *pair, const struct shape_point *p, int n,
                         const struct target *to)
{
    struct slots *const l = &s->neighbours.pairs;
    real *const memory = &l->memory[(size_t)slot * s->neighbours.rows];
    vec3 place[POINTS_MOST];
    int record[POINTS_MOST];
    bool overlaps = false;
    for (int k = 0; k < n; k++)
        place[k] = mat3_back(&pair->i.turn, p[k].at_i);
    const int used = points_match(cut, memory, p, place, n,
                                  CLOSE * fmin(pair->i.size, pair->j.size), record);
    for (int k = 0; k < n; k++) {
        const bool over = p[k].depth > 0.0;
        real *const at = points_record(cut, memory, record[k]);
        const struct point_of o = {.slot = slot,
                                   .i = l->owner[slot],
                                   .j = l->other[slot],
                                   .record = at,
                                   .was = record_overlapped(at) ||
                                          (p[k].slope > 0.0 && l->live[slot] == LIVE_OVERLAP),
                                   .p = &p[k]};
        at[0] = (real)(2 * (p[k].id + 1) + over);
        at[1] = (real)place[k].x;
        at[2] = (real)place[k].y;
        at[3] = (real)place[k].z;
        overlaps = overlaps || over;
        enter_pair(s, b, &o);
        if (b->n == TOUCH)
            points_work(s, b, to);
    }
    points_use(cut, memory, used);
    l->live[slot] = overlaps ? LIVE_OVERLAP : n > 0 || shape.memory > 0 ? LIVE_REACH : 0;
}

/* m; x_i - x_j by the nearest image, as the loop of spheres has it; in single precision from the
 * places in double, as the geometry of shapes is: nothing of the overlap is lost. */
static vec3 apart(const struct sim *s, int i, int j)
{
    if (BODY_IS_FLOAT)
        return domain_minimum_image(&s->domain, v3_sub(s->grains.pos[i], s->grains.pos[j]));
    const struct frame *const f = &s->frame;
    const real8 d = body_apart(&s->bodies[i], &s->bodies[j]);
    real x[3];
    for (int a = 0; a < 3; a++) {
        x[a] = d[a] * f->scale[a];
        x[a] = fma(-f->image[a], rint(x[a] * f->inv_image[a]), x[a]);
    }
    return v3((double)x[0], (double)x[1], (double)x[2]);
}

/* The points within reach of a law; too many of them stop the run. */
static int find(const struct sim *s, const struct cut *cut, const struct shape_pair *pair,
                struct shape_point *p, struct report *r)
{
    const double reach = s->neighbours.reach;
    const int found = shape.points(pair, cut->most, p);
    const int n = found < cut->most ? found : cut->most;
    int near = 0;
    if (found > cut->most && found > r->points)
        r->points = found;
    for (int k = 0; k < n; k++)
        if (p[k].depth > -reach)
            p[near++] = p[k];
    return near;
}

static void leave(const struct sim *s, struct slots *l, int slot)
{
    if (!l->live[slot])
        return;
    l->live[slot] = 0;
    memset(&l->memory[(size_t)slot * s->neighbours.rows], 0,
           (size_t)s->neighbours.rows * sizeof *l->memory);
}

static void fetch(const struct sim *s, const struct cut *cut, int slot)
{
    const real *const memory =
        &s->neighbours.pairs.memory[(size_t)slot * s->neighbours.rows + cut->head];
    for (int line = 0; line < 4; line++)
        __builtin_prefetch(memory + line * 8, 1);
}

/* m; how far the surfaces of two bodies may have approached each other in the last step: places
 * moved by the velocities at hand, and turns by spins that a tumbling body's own change by little
 * in a step. */
static double approached(const struct body *i, const struct body *j, double dt)
{
    const double4 v = __builtin_convertvector(i->vel - j->vel, double4);
    const double4 a = __builtin_convertvector(i->spin, double4),
                  b = __builtin_convertvector(j->spin, double4);
    const double turn_i = dt * sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double turn_j = dt * sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    const double way = dt * sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const bool slow = turn_i < TUMBLE && turn_j < TUMBLE;
    return slow ? way + 2.0 * (turn_i * a[3] + turn_j * b[3]) : (double)INFINITY;
}

/* Takes the last step off what parts a pair; is something left? */
static bool still_apart(const struct sim *s, const struct slots *l, int slot, real *head)
{
    const bool apart = head[HEAD_APART] > (real)0.0;
    if (!apart && head[HEAD_ASKED] == (real)0.0)
        return false;
    const real step =
        (real)approached(&s->bodies[l->owner[slot]], &s->bodies[l->other[slot]], s->run.dt);
    head[HEAD_NEARER] += step;
    head[HEAD_APART] -= apart ? step : (real)0.0;
    return head[HEAD_APART] > (real)0.0;
}

/* What the shape may take as known of the time since it was last asked. */
static double nearer(real *head)
{
    const double by = head[HEAD_ASKED] > (real)0.0 ? (double)head[HEAD_NEARER] : 0.0;
    head[HEAD_NEARER] = (real)0.0;
    head[HEAD_ASKED] = (real)1.0;
    return by;
}

static void work_pairs(struct sim *s, struct block *b, const int *slot, int count,
                       const struct target *to)
{
    const struct cut cut = points_cut(s);
    const struct grains *const g = &s->grains;
    struct slots *const l = &s->neighbours.pairs;
    struct shape_point p[POINTS_MOST];
    struct shape_pair pair = {.reach = s->neighbours.reach};
    int before = -1;
    b->n = 0;
    b->rocks = false;
    b->walls = false;
    for (int k = 0; k < count; k++) {
        const int i = l->owner[slot[k]], j = l->other[slot[k]];
        if (k + AHEAD < count) /* the memory of slots is large and cold */
            fetch(s, &cut, slot[k + AHEAD]);
        const vec3 d = apart(s, i, j);
        const double cut_off = g->radius[i] + g->radius[j] + pair.reach;
        if (to->asked)
            points_forget_seen(s, false, slot[k]);
        if (v3_dot(d, d) >= cut_off * cut_off) {
            leave(s, l, slot[k]);
            continue;
        }
        pair.memory = &l->memory[(size_t)slot[k] * s->neighbours.rows];
        real *const head = &pair.memory[cut.head];
        if (still_apart(s, l, slot[k], head))
            continue;
        if (i != before)
            pair.i = points_pose(s, i);
        before = i;
        pair.j = points_pose(s, j);
        pair.j.centre = v3_scale(-1.0, d);
        double far = 0.0;
        pair.apart = &far;
        pair.approached = nearer(head);
        const int n = find(s, &cut, &pair, p, to->report);
        if (n > 0 || l->live[slot[k]] || shape.memory > 0)
            enter_points(s, b, &cut, slot[k], &pair, p, n, to);
        head[HEAD_APART] = n == 0 && far > pair.reach ? (real)(far - pair.reach) : (real)0.0;
        if (!l->live[slot[k]])
            l->live[slot[k]] = LIVE_REACH; /* the head is kept or cleared with the slot */
    }
    points_work(s, b, to);
    to->report->too_deep = to->report->too_deep || to->report->points > 0;
}

const struct contact_path contact_points = {.rows = points_rows,
                                            .pairs = work_pairs,
                                            .walls = points_walls,
                                            .view = points_view,
                                            .seen_size = points_seen_size,
                                            .stop = points_stop,
                                            .turning = &turning};
