/* search.c - cell grids per class of sizes, sorting, pairs.
 *
 * Everything that follows from the state alone is the same on any number of threads: grains of
 * a cell are put in the order that they had, whoever placed them. */
#include "search.h"

#include <string.h>
#include "sim.h"

static int halvings(const struct search *c, double radius)
{
    int k = 0;
    for (double r = c->largest; radius <= 0.5 * r && k < 63; k++)
        r *= 0.5;
    return k;
}

static void open_classes(struct search *c, const struct sim *s)
{
    const struct grains *const g = &s->grains;
    double largest = 0.0, widest[SEARCH_CLASSES] = {0.0};
    int count[SEARCH_CLASSES] = {0};
    for (int i = 0; i < g->n; i++)
        largest = fmax(largest, g->radius[i]);
    c->largest = largest;
    for (int i = 0; i < g->n; i++) {
        if (g->id[i] < 0)
            continue;
        int k = halvings(c, g->radius[i]);
        k = k < SEARCH_CLASSES ? k : SEARCH_CLASSES - 1;
        count[k]++;
        widest[k] = fmax(widest[k], g->radius[i]);
    }
    for (int k = 0; k < SEARCH_CLASSES; k++) {
        c->class_of[k] = c->classes;
        if (count[k] == 0)
            continue;
        c->class[c->classes].widest = widest[k];
        c->class[c->classes++].n_grains = count[k];
    }
    for (int k = SEARCH_CLASSES; k < 64; k++)
        c->class_of[k] = c->classes - 1;
}

/* Cells no narrower than the widest pair, and not many more of them than grains. */
static void open_cells(struct search *c, const struct sim *s, double margin)
{
    const double *const size = s->domain.size;
    for (int k = 0; k < c->classes; k++) {
        struct search_class *const l = &c->class[k];
        const double room = size[0] * size[1] * size[2] / (4.0 * l->n_grains + 64.0);
        const double edge = fmax(2.0 * l->widest + margin, cbrt(room));
        for (int a = 0; a < 3; a++) {
            l->n[a] = (int)fmin(fmax(1.0, floor(size[a] / edge)), 1000.0);
            l->edge[a] = size[a] / l->n[a];
        }
        l->first = c->cells;
        c->cells += l->n[0] * l->n[1] * l->n[2];
    }
}

static int index_along(const struct search_class *l, const struct domain *d, double x, int a)
{
    const double at = x / l->edge[a];
    if (!(at >= 0.0))
        return d->periodic[a] ? l->n[a] - 1 : 0;
    if (at >= l->n[a])
        return d->periodic[a] ? 0 : l->n[a] - 1;
    return (int)at;
}

/* Cells are counted block by block, so that grains near in memory are near in space. */
enum { SIDE = 4 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int cell_index(const struct search_class *l, int i, int j, int k)
{
    const int bi = i / SIDE * SIDE, bj = j / SIDE * SIDE, bk = k / SIDE * SIDE;
    const int wide = least(SIDE, l->n[0] - bi), deep = least(SIDE, l->n[1] - bj);
    const int high = least(SIDE, l->n[2] - bk);
    return l->first + l->n[0] * l->n[1] * bk + l->n[0] * bj * high + bi * deep * high +
           (i - bi) + wide * ((j - bj) + deep * (k - bk));
}

static int home_of(const struct search *c, const struct sim *s, int i)
{
    const vec3 x = s->grains.pos[i];
    const struct search_class *const l =
        &c->class[c->class_of[halvings(c, s->grains.radius[i])]];
    return cell_index(l, index_along(l, &s->domain, x.x, 0), index_along(l, &s->domain, x.y, 1),
                      index_along(l, &s->domain, x.z, 2));
}

static void sort_ints(int *x, int n)
{
    for (int i = 1; i < n; i++) {
        const int v = x[i];
        int j = i;
        for (; j > 0 && x[j - 1] > v; j--)
            x[j] = x[j - 1];
        x[j] = v;
    }
}

/* order[new] = old, by cell. */
static int *order_by_cell(struct search *c, struct sim *s)
{
    struct grains *const g = &s->grains;
    int *const order = xalloc((size_t)g->n + 1, sizeof *order);
    int *const home = xalloc((size_t)g->n + 1, sizeof *home);
    int *const next = xalloc((size_t)c->cells + 1, sizeof *next);
    c->begin = xalloc((size_t)c->cells + 1, sizeof *c->begin);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        home[i] = -1;
        if (g->id[i] < 0)
            continue;
        g->pos[i] = domain_wrap(&s->domain, g->pos[i]);
        home[i] = home_of(c, s, i);
#pragma omp atomic
        c->begin[home[i] + 1]++;
    }
    for (int k = 0; k < c->cells; k++)
        c->begin[k + 1] += c->begin[k];
    memcpy(next, c->begin, (size_t)c->cells * sizeof *next);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        int place;
        if (home[i] < 0)
            continue;
#pragma omp atomic capture
        place = next[home[i]]++;
        order[place] = i;
    }
#pragma omp parallel for schedule(static)
    for (int k = 0; k < c->cells; k++)
        sort_ints(order + c->begin[k], c->begin[k + 1] - c->begin[k]);
    xfree(next);
    xfree(home);
    return order;
}

int *search_sort(struct search *c, struct sim *s, double margin)
{
    struct grains *const g = &s->grains;
    *c = (struct search){0};
    open_classes(c, s);
    open_cells(c, s, margin);
    int *const order = order_by_cell(c, s);
    g->n = c->begin[c->cells];
    for (int f = 0; f < s->fields.n; f++) {
        const struct field *const field = &s->fields.field[f];
        if (field->place != PLACE_GRAIN)
            continue;
        const size_t size = kind_size(field->kind);
        char *const old = *field->data, *const sorted = xalloc((size_t)g->capacity, size);
#pragma omp parallel for schedule(static)
        for (int i = 0; i < g->n; i++)
            memcpy(sorted + (size_t)i * size, old + (size_t)order[i] * size, size);
        *field->data = sorted;
        xfree(old);
    }
    return order;
}

void search_free(struct search *c)
{
    xfree(c->begin);
}

static int step_of(double x, double edge)
{
    return (int)fmin(fmax(floor(x / edge), -2.0), 1001.0);
}

/* Cells along an axis that hold what is nearer than `reach` (an edge at most) to x, each once;
 * returns how many: two, mostly, of a class whose grains are much larger. */
static int around(const struct search_class *l, const struct domain *d, double x, double reach,
                  int a, int out[3])
{
    const int home = index_along(l, d, x, a), last = l->n[a] - 1;
    const double wide = reach * (1.0 + 1e-9); /* above round-off */
    const int low = step_of(x - wide, l->edge[a]), high = step_of(x + wide, l->edge[a]);
    const bool wrapped = d->periodic[a] && step_of(x, l->edge[a]) != home; /* x is the size */
    int n = 0;
    for (int k = home - 1; k <= home + 1; k++) {
        const int i = d->periodic[a] ? (k + l->n[a]) % l->n[a] : k;
        bool seen = k != home && !wrapped && (k < low || k > high);
        seen = seen || i < 0 || i > last;
        for (int m = 0; m < n; m++)
            seen = seen || out[m] == i;
        if (!seen)
            out[n++] = i;
    }
    return n;
}

/* The grains from..to-1 that i owns a pair with. */
static int scan(const struct sim *s, double margin, int i, int from, int to, int *out, int n)
{
    const struct grains *const g = &s->grains;
    const vec3 x = g->pos[i];
    const double r = g->radius[i];
    const bool frozen = g->inv_mass[i] == 0.0;
    for (int m = from; m < to; m++) {
        const vec3 d = domain_minimum_image(&s->domain, v3_sub(x, g->pos[m]));
        const double cut = r + g->radius[m] + margin;
        const bool near = v3_dot(d, d) < cut * cut;
        const bool mine = g->radius[m] > r || (g->radius[m] == r && g->id[m] > g->id[i]);
        const bool moves = !(frozen && g->inv_mass[m] == 0.0);
        out[n] = m;
        n += near & mine & moves;
    }
    return n;
}

int search_pairs(const struct search *c, const struct sim *s, double margin, int i, int **out,
                 int *room, int n)
{
    const vec3 x = s->grains.pos[i];
    const double at[3] = {x.x, x.y, x.z};
    const int own = c->class_of[halvings(c, s->grains.radius[i])];
    for (int level = 0; level <= own; level++) {
        const struct search_class *const l = &c->class[level];
        int near[3][3], count[3];
        for (int a = 0; a < 3; a++)
            count[a] = around(l, &s->domain, at[a], s->grains.radius[i] + l->widest + margin, a,
                              near[a]);
        for (int k = 0; k < count[2]; k++)
            for (int j = 0; j < count[1]; j++)
                for (int h = 0; h < count[0]; h++) {
                    const int home = cell_index(l, near[0][h], near[1][j], near[2][k]);
                    const int from = c->begin[home], to = c->begin[home + 1];
                    if (n + to - from + 1 > *room) {
                        const int more = 2 * (n + to - from) + 1024;
                        *out = xrealloc(*out, (size_t)*room, (size_t)more, sizeof **out);
                        *room = more;
                    }
                    n = scan(s, margin, i, from, to, *out, n);
                }
    }
    return n;
}
