/* memory_order.c - grains by cells, cells by blocks.
 *
 * A cell is as wide as one and a half grains take at a solid fraction of 0.6, and there are not many
 * more cells than grains. Grains of a cell keep the order that they had, whoever puts them there: the
 * same on any number of threads. */
#include "memory_order.h"

#include <string.h>
#include "sim.h"

#define PER_CELL 1.5
#define DENSE    0.6

struct cells {
    int n[3];
    double edge[3]; /* m */
    int all;
};

static struct cells cells_for(const struct sim *s)
{
    const double *const size = s->domain.size;
    const int n = s->grains.n > 0 ? s->grains.n : 1;
    const double solid = sum_blocks(s->grains.volume, (size_t)s->grains.n);
    const double dense = cbrt(PER_CELL * solid / DENSE / n);
    const double edge = fmax(dense, cbrt(size[0] * size[1] * size[2] / (4.0 * n + 64.0)));
    struct cells c = {.all = 1};
    for (int a = 0; a < 3; a++) {
        c.n[a] = (int)fmin(fmax(1.0, floor(size[a] / edge)), 1000.0);
        c.edge[a] = size[a] / c.n[a];
        c.all *= c.n[a];
    }
    return c;
}

static int step_to(const struct cells *c, double x, int a)
{
    return (int)fmin(fmax(0.0, floor(x / c->edge[a])), c->n[a] - 1.0);
}

/* Cells are counted block by block, so that grains near in memory are near in space. */
enum { SIDE = 4 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int cell_of(const struct cells *c, vec3 x)
{
    const int i = step_to(c, x.x, 0), j = step_to(c, x.y, 1), k = step_to(c, x.z, 2);
    const int bi = i / SIDE * SIDE, bj = j / SIDE * SIDE, bk = k / SIDE * SIDE;
    const int wide = least(SIDE, c->n[0] - bi), deep = least(SIDE, c->n[1] - bj);
    const int high = least(SIDE, c->n[2] - bk);
    return c->n[0] * c->n[1] * bk + c->n[0] * bj * high + bi * deep * high + (i - bi) +
           wide * ((j - bj) + deep * (k - bk));
}

/* order[new] = old; `n`: how many stay. */
static int *order_by_cell(struct sim *s, int *n)
{
    struct grains *const g = &s->grains;
    const struct cells c = cells_for(s);
    int *const order = xalloc((size_t)g->n + 1, sizeof *order);
    int *const home = xalloc((size_t)g->n + 1, sizeof *home);
    int *const next = xalloc((size_t)c.all + 1, sizeof *next);
    int *const begin = xalloc((size_t)c.all + 1, sizeof *begin);
#pragma omp parallel for schedule(static)
    for (int i = 0; i < g->n; i++) {
        home[i] = -1;
        if (g->id[i] < 0)
            continue;
        g->pos[i] = domain_wrap(&s->domain, g->pos[i]);
        home[i] = cell_of(&c, g->pos[i]);
#pragma omp atomic
        begin[home[i] + 1]++;
    }
    for (int k = 0; k < c.all; k++) {
        next[k] = begin[k];
        begin[k + 1] += begin[k];
    }
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
    for (int k = 0; k < c.all; k++)
        sort_few(order + begin[k], begin[k + 1] - begin[k]);
    *n = begin[c.all];
    xfree(begin);
    xfree(next);
    xfree(home);
    return order;
}

/* Copies n things of a size, out[k] = in[order[k]]: a size that the compiler knows takes a load or two. */
static void take(char *restrict out, const char *restrict in, const int *order, int n,
                 size_t size)
{
#define TAKE(SIZE)                                                                             \
    _Pragma("omp parallel for schedule(static)") for (int k = 0; k < n; k++)                   \
        memcpy(out + (size_t)k * (SIZE), in + (size_t)order[k] * (SIZE), SIZE)
    if (size == sizeof(int))
        TAKE(sizeof(int));
    else if (size == sizeof(double))
        TAKE(sizeof(double));
    else if (size == sizeof(vec3))
        TAKE(sizeof(vec3));
    else
        TAKE(size);
#undef TAKE
}

/* The room of a sorted field serves the next one of its size. */
static void sort_fields(struct sim *s, const int *order)
{
    const struct grains *const g = &s->grains;
    enum { SIZES = 4 };
    struct {
        size_t size;
        char *room;
    } spare[SIZES] = {0};
    for (int f = 0; f < s->fields.n; f++) {
        const struct field *const field = &s->fields.field[f];
        if (field->place != PLACE_GRAIN)
            continue;
        const size_t size = kind_size(field->kind);
        int k = 0;
        while (k < SIZES - 1 && spare[k].size != size && spare[k].size != 0)
            k++;
        if (spare[k].size != size) {
            xfree(spare[k].room);
            spare[k].size = size;
            spare[k].room = xalloc((size_t)g->capacity, size);
        }
        char *const old = *field->data;
        take(spare[k].room, old, order, g->n, size);
        memset(spare[k].room + (size_t)g->n * size, 0, (size_t)(g->capacity - g->n) * size);
        *field->data = spare[k].room;
        spare[k].room = old;
    }
    for (int k = 0; k < SIZES; k++)
        xfree(spare[k].room);
}

int *memory_order(struct sim *s)
{
    int n;
    int *const order = order_by_cell(s, &n);
    s->grains.n = n;
    sort_fields(s, order);
    return order;
}
