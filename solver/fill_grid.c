/* fill_grid.c - search grids for placing grains, one per size class. */
#include "fill_grid.h"

/* Cells of a level along each axis, in a range: lo..hi, taken modulo the cells where periodic. */
struct span {
    int lo[3], hi[3];
};

void fill_grid_open(struct fill_grid *b, const struct domain *d, double widest, int n_most)
{
    *b = (struct fill_grid){.domain = d, .widest = widest, .n_most = n_most};
}

void fill_grid_clear(struct fill_grid *b)
{
    for (int l = 0; l < FILL_LEVELS; l++) {
        xfree(b->level[l].first);
        b->level[l] = (struct fill_level){0};
    }
    b->n = 0;
}

void fill_grid_close(struct fill_grid *b)
{
    fill_grid_clear(b);
    xfree(b->grain);
    xfree(b->next);
    *b = (struct fill_grid){0};
}

static int level_of(const struct fill_grid *b, double diameter)
{
    int l = 0;
    for (double d = 0.5 * b->widest; l < FILL_LEVELS - 1 && diameter <= d; d *= 0.5)
        l++;
    return l;
}

/* Cells as wide as the largest of the level, or wider: 2 for each grain and 4096 at most. */
static void level_open(const struct fill_grid *b, struct fill_level *v, int l)
{
    const double *const size = b->domain->size;
    const double room = size[0] * size[1] * size[2] / (2.0 * b->n_most + 4096.0);
    const double edge = fmax(ldexp(b->widest, -l), cbrt(room));
    size_t total = 1;
    for (int a = 0; a < 3; a++) {
        v->cells[a] = (int)fmin(fmax(1.0, floor(size[a] / edge)), 1000.0);
        v->edge[a] = size[a] / v->cells[a];
        total *= (size_t)v->cells[a];
    }
    v->first = xalloc(total, sizeof *v->first);
    for (size_t c = 0; c < total; c++)
        v->first[c] = -1;
}

static int inside(int i, int n)
{
    return i < 0 ? 0 : i >= n ? n - 1 : i;
}

void fill_grid_add(struct fill_grid *b, struct placed p)
{
    if (b->n == b->capacity) {
        const int more = b->capacity ? 2 * b->capacity : 1024;
        b->grain = xrealloc(b->grain, (size_t)b->capacity, (size_t)more, sizeof *b->grain);
        b->next = xrealloc(b->next, (size_t)b->capacity, (size_t)more, sizeof *b->next);
        b->capacity = more;
    }
    const int l = level_of(b, p.diameter);
    struct fill_level *const v = &b->level[l];
    if (!v->first)
        level_open(b, v, l);
    const int i = inside((int)floor(p.pos.x / v->edge[0]), v->cells[0]);
    const int j = inside((int)floor(p.pos.y / v->edge[1]), v->cells[1]);
    const int k = inside((int)floor(p.pos.z / v->edge[2]), v->cells[2]);
    const int c = i + v->cells[0] * (j + v->cells[1] * k);
    b->next[b->n] = v->first[c];
    v->first[c] = b->n;
    v->largest = fmax(v->largest, p.diameter);
    v->n++;
    b->grain[b->n++] = p;
}

static struct span span_around(const struct fill_grid *b, const struct fill_level *v, vec3 x,
                               double reach)
{
    const double at[3] = {x.x, x.y, x.z};
    struct span s;
    for (int a = 0; a < 3; a++) {
        s.lo[a] = (int)floor((at[a] - reach) / v->edge[a]);
        s.hi[a] = (int)floor((at[a] + reach) / v->edge[a]);
        if (!b->domain->periodic[a]) {
            s.lo[a] = inside(s.lo[a], v->cells[a]);
            s.hi[a] = inside(s.hi[a], v->cells[a]);
        } else if (s.hi[a] - s.lo[a] + 1 >= v->cells[a]) { /* every cell once */
            s.lo[a] = 0;
            s.hi[a] = v->cells[a] - 1;
        }
    }
    return s;
}

static int modulo(int i, int n)
{
    return i < 0 ? i + n : i >= n ? i - n : i;
}

double fill_grid_overlap(const struct fill_grid *b, vec3 x, double diameter, double enough)
{
    double worst = 0.0;
    for (int l = 0; l < FILL_LEVELS; l++) {
        const struct fill_level *const v = &b->level[l];
        if (v->n == 0)
            continue;
        const struct span s = span_around(b, v, x, 0.5 * (diameter + v->largest));
        for (int k = s.lo[2]; k <= s.hi[2]; k++)
            for (int j = s.lo[1]; j <= s.hi[1]; j++)
                for (int i = s.lo[0]; i <= s.hi[0]; i++) {
                    const int c = modulo(i, v->cells[0]) +
                                  v->cells[0] * (modulo(j, v->cells[1]) +
                                                 v->cells[1] * modulo(k, v->cells[2]));
                    for (int m = v->first[c]; m >= 0; m = b->next[m]) {
                        const double apart = 0.5 * (diameter + b->grain[m].diameter);
                        const vec3 r =
                            domain_minimum_image(b->domain, v3_sub(x, b->grain[m].pos));
                        const double square = v3_dot(r, r);
                        if (square >= apart * apart)
                            continue;
                        const double least = fmin(diameter, b->grain[m].diameter);
                        worst = fmax(worst, (apart - sqrt(square)) / least);
                        if (worst > enough)
                            return worst;
                    }
                }
    }
    return worst;
}

int fill_grid_near(const struct fill_grid *b, int i, double gap, int *out, int most)
{
    const vec3 x = b->grain[i].pos;
    const double diameter = b->grain[i].diameter;
    int found = 0;
    for (int l = 0; l < FILL_LEVELS; l++) {
        const struct fill_level *const v = &b->level[l];
        if (v->n == 0)
            continue;
        const struct span s = span_around(b, v, x, 0.5 * (diameter + v->largest) + gap);
        for (int k = s.lo[2]; k <= s.hi[2]; k++)
            for (int j = s.lo[1]; j <= s.hi[1]; j++)
                for (int h = s.lo[0]; h <= s.hi[0]; h++) {
                    const int c = modulo(h, v->cells[0]) +
                                  v->cells[0] * (modulo(j, v->cells[1]) +
                                                 v->cells[1] * modulo(k, v->cells[2]));
                    for (int m = v->first[c]; m >= 0; m = b->next[m]) {
                        const double cut = 0.5 * (diameter + b->grain[m].diameter) + gap;
                        const vec3 r =
                            domain_minimum_image(b->domain, v3_sub(x, b->grain[m].pos));
                        if (m == i || v3_dot(r, r) >= cut * cut)
                            continue;
                        if (found < most)
                            out[found] = m;
                        found++;
                    }
                }
    }
    return found;
}
