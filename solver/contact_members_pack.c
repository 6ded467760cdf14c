/* contact_members_pack.c - pairs of member spheres between the slots and the blocks of the loop.
 *
 * A slot keeps the memory of its contacts in records (contact_points.h), found by the numbers of
 * the two members. Which members come within the thin skin is the answer of the shape's `points`,
 * asked for a gap of that width: a point of the balls a and b has the id a n_j + b. */
#include "contact_members.h"

#include <string.h>
#include "attitude.h"
#include "contact_points.h"

struct member_block *member_block(const struct pack *p, int block, int rows)
{
    return (struct member_block *)(void *)(p->data + (size_t)block * member_block_size(rows));
}

void members_create(struct sim *s)
{
    struct contact_work *const w = s->contacts;
    const int species = s->grains.n_species;
    struct members *const m = &w->members;
    m->first = xalloc((size_t)species + 1, sizeof *m->first);
    for (int k = 0; k < species; k++) {
        int n = 0;
        shape.balls(k, &n);
        m->first[k + 1] = m->first[k] + n;
    }
    m->row = xalloc((size_t)m->first[species] + 1, sizeof *m->row);
    for (int k = 0; k < species; k++) {
        int n = 0;
        const struct shape_ball *const ball = shape.balls(k, &n);
        for (int b = 0; b < n; b++)
            m->row[m->first[k] + b] = (real4){(real)ball[b].centre.x, (real)ball[b].centre.y,
                                              (real)ball[b].centre.z, (real)ball[b].radius};
    }
    grains_follow(&s->grains, (void **)&s->attitudes, sizeof *s->attitudes);
}

void members_free(struct sim *s)
{
    xfree(s->contacts->members.first);
    xfree(s->contacts->members.row);
    xfree(s->attitudes);
}

void members_prepare(struct sim *s)
{
    const struct grains *const g = &s->grains;
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        struct attitude *const a = &s->attitudes[i];
        a->spin[3] = (real)(g->radius[i] / g->species[g->kind[i]].form.bounding);
        attitude_write(a, g->orientation[i], g->full_spin[i]);
    }
}

/* What is filled or emptied. */
struct filling {
    struct sim *s;
    struct pack *pack;
    struct cut cut;
    int at; /* contacts so far */
    int room;
    struct shape_point *found; /* of a slot */
    int found_room;
};

static struct filling open_filling(struct sim *s, int run)
{
    return (struct filling){.s = s, .pack = &s->contacts->pack[run], .cut = points_cut(s)};
}

/* The members that come close in a slot. */
static int find(struct filling *f, struct shape_pair *pair)
{
    int n = shape.points(pair, f->found_room, f->found);
    if (n > f->found_room) {
        xfree(f->found);
        f->found_room = 2 * n;
        f->found = xalloc((size_t)f->found_room, sizeof *f->found);
        n = shape.points(pair, f->found_room, f->found);
    }
    return n;
}

/* The record of a contact that was; NULL: there is none. */
const real *members_record(const struct cut *cut, real *memory, int id)
{
    for (int r = 0; r < points_used(cut, memory); r++)
        if (record_id(points_record(cut, memory, r)) == id)
            return points_record(cut, memory, r);
    return NULL;
}

/* A lane of its own for the next contact. */
static struct member_block *next_lane(struct filling *f)
{
    struct pack *const p = f->pack;
    const int rows = f->cut.rows;
    if (f->at == p->room * TOUCH) {
        const int more = p->room + p->room / 2 + 2;
        p->data = xrealloc(p->data, (size_t)p->room, (size_t)more, member_block_size(rows));
        p->room = more;
    }
    return member_block(p, f->at++ / TOUCH, rows);
}

static void enter(struct filling *f, int slot, int id)
{
    const struct sim *const s = f->s;
    const struct slots *const l = &s->neighbours.pairs;
    const struct grains *const g = &s->grains;
    const int *const first = s->contacts->members.first;
    const int c = f->at % TOUCH, i = l->owner[slot], j = l->other[slot];
    const int n_j = first[g->kind[j] + 1] - first[g->kind[j]];
    struct member_block *const b = next_lane(f);
    real *const memory = &l->memory[(size_t)slot * s->neighbours.rows];
    const real *const record = members_record(&f->cut, memory, id);
    b->i[c] = i;
    b->j[c] = j;
    b->to[c] = s->neighbours.to[slot];
    b->of_i[c] = first[g->kind[i]] + id / n_j;
    b->of_j[c] = first[g->kind[j]] + id % n_j;
    b->slot[c] = slot;
    b->depth[c] = record && record_overlapped(record) ? (real)INFINITY : -(real)INFINITY;
    for (int row = 0; row < f->cut.rows; row++)
        b->memory[row][c] = record ? record[RECORD_HEAD + row] : (real)0.0;
}

/* Lanes behind the last contact repeat it. */
static void close_filling(struct filling *f)
{
    const int n = f->pack->n = f->at;
    const int rows = f->cut.rows;
    if (n == 0)
        return;
    struct member_block *const b = member_block(f->pack, (n - 1) / TOUCH, rows);
    const int last = (n - 1) % TOUCH;
    for (int c = last + 1; c < TOUCH; c++) {
        b->i[c] = b->i[last];
        b->j[c] = b->j[last];
        b->to[c] = b->to[last];
        b->of_i[c] = b->of_i[last];
        b->of_j[c] = b->of_j[last];
        b->slot[c] = b->slot[last];
        b->depth[c] = b->depth[last];
        for (int row = 0; row < rows; row++)
            b->memory[row][c] = b->memory[row][last];
    }
}

void members_take(struct sim *s, int run)
{
    const struct neighbours *const nb = &s->neighbours;
    const struct slots *const l = &nb->pairs;
    const struct grains *const g = &s->grains;
    const int *const active = &l->active[l->begin[run * s->neighbours.run]];
    struct filling f = open_filling(s, run);
    struct shape_pair pair = {0};
    int before = -1;
    f.found_room = POINTS_MOST;
    f.found = xalloc(POINTS_MOST, sizeof *f.found);
    for (int k = 0; k < l->n_active[run]; k++) {
        const int slot = active[k], i = l->owner[slot], j = l->other[slot];
        if (i != before)
            pair.i = points_pose(s, i);
        before = i;
        pair.j = points_pose(s, j);
        pair.reach = neighbours_inner(nb, i, j);
        pair.j.centre =
            domain_minimum_image(&s->domain, v3_sub(g->pos[j], g->pos[i])); /* from x_i */
        const int n = find(&f, &pair);
        for (int m = 0; m < n; m++)
            enter(&f, slot, f.found[m].id);
    }
    close_filling(&f);
    xfree(f.found);
}

/* Contacts that a law acts on go to the records of their slot; more than it has records for stop
 * the run. */
void members_put_back(struct sim *s, int run)
{
    const struct grains *const g = &s->grains;
    struct slots *const l = &s->neighbours.pairs;
    const struct filling f = open_filling(s, run);
    const int *const first = s->contacts->members.first;
    const real reach = (real)s->neighbours.reach;
    int before = -1, used = 0;
    if (f.pack->n == 0) /* a run that is no longer, perhaps */
        return;
    for (int k = 0; k < l->n_active[run]; k++) {
        const int slot = l->active[l->begin[run * s->neighbours.run] + k];
        l->live[slot] = 0;
        points_use(&f.cut, &l->memory[(size_t)slot * s->neighbours.rows], 0);
    }
    for (int k = 0; k < f.pack->n; k++) {
        const struct member_block *const b = member_block(f.pack, k / TOUCH, f.cut.rows);
        const int c = k % TOUCH, slot = b->slot[c];
        const bool over = b->depth[c] > (real)0.0;
        used = slot == before ? used : 0;
        before = slot;
        if (!(b->depth[c] > -reach))
            continue;
        if (used++ >= f.cut.most) {
            s->contacts->report[run].points = used;
            continue;
        }
        const int n_j = first[g->kind[b->j[c]] + 1] - first[g->kind[b->j[c]]];
        const int id =
            (b->of_i[c] - first[g->kind[b->i[c]]]) * n_j + b->of_j[c] - first[g->kind[b->j[c]]];
        real *const memory = &l->memory[(size_t)slot * s->neighbours.rows];
        real *const record = points_record(&f.cut, memory, used - 1);
        l->live[slot] = over || l->live[slot] == LIVE_OVERLAP ? LIVE_OVERLAP : LIVE_REACH;
        points_use(&f.cut, memory, used);
        record[0] = (real)(2 * (id + 1) + over);
        record[1] = record[2] = record[3] = 0.0;
        for (int row = 0; row < f.cut.rows; row++)
            record[RECORD_HEAD + row] = b->memory[row][c];
    }
    f.pack->n = 0;
}
