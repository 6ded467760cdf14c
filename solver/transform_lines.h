/* transform_lines.h - lines of a field of doubles into the packs of transform_lanes.h and back, up to
 * LINES of them at a time. A body, to be included after it. */

enum { LINES = 2 * LANES }; /* of one transform, side by side */

/* Where value i of the lines of pack g lies: in pack slot[i] (without slots i step) + g group, its sign
 * changed where `negative` says so. */
struct places {
    const int *slot;
    const bool *negative;
    int step, group;
};

static inline struct places places_of_cells(const struct transform *t)
{
    return (struct places){t->slot, t->signs ? t->negative : NULL, 0, t->group};
}

static inline struct places places_of_modes(const struct transform *t)
{
    return (struct places){NULL, NULL, t->step, t->group};
}

static inline pack *place(const struct places *p, pack *x, int i, int g)
{
    return &x[(p->slot ? p->slot[i] : i * p->step) + g * p->group];
}

static inline pack signed_at(const struct places *p, int i, pack x)
{
    return p->negative && p->negative[i] ? -x : x;
}

static inline pack load(const double *from, int count)
{
    pack x = {0};
    if (count >= LANES)
        memcpy(&x, from, sizeof x);
    else
        for (int l = 0; l < count; l++)
            x[l] = from[l];
    return x;
}

static inline void store(double *to, pack x, int count)
{
    if (count >= LANES)
        memcpy(to, &x, sizeof x);
    else
        for (int l = 0; l < count; l++)
            to[l] = x[l];
}

/* n cells of LINES lines that lie side by side, into packs or back. */
static inline __attribute__((always_inline)) void all_beside(const struct places *p, int n,
                                                             pack *x, double *at, int along,
                                                             bool back, bool slots, bool signs)
{
    const int group = p->group, step = p->step;
    for (int i = 0; i < n; i++, at += along) {
        pack *const low = x + (slots ? p->slot[i] : i * step), *const high = low + group;
        const bool turn = signs && p->negative[i];
        pack a, b;
        __builtin_prefetch(at + LINES); /* of the lines to come */
        memcpy(&a, back ? (const double *)low : at, sizeof a);
        memcpy(&b, back ? (const double *)high : at + LANES, sizeof b);
        a = turn ? -a : a;
        b = turn ? -b : b;
        memcpy(back ? at : (double *)low, &a, sizeof a);
        memcpy(back ? at + LANES : (double *)high, &b, sizeof b);
    }
}

/* The same of any number of lines up to LINES. */
static void lines_beside(const struct places *p, int n, pack *x, double *at, int along,
                         int lines, bool back)
{
    if (lines >= LINES) {
        if (p->negative)
            (back ? all_beside(p, n, x, at, along, true, true, true)
                  : all_beside(p, n, x, at, along, false, true, true));
        else if (p->slot)
            (back ? all_beside(p, n, x, at, along, true, true, false)
                  : all_beside(p, n, x, at, along, false, true, false));
        else
            (back ? all_beside(p, n, x, at, along, true, false, false)
                  : all_beside(p, n, x, at, along, false, false, false));
        return;
    }
    for (int g = 0; g < 2; g++)
        for (int i = 0; i < n; i++) {
            pack *const to = place(p, x, i, g);
            double *const cells = at + (long)i * along + g * LANES;
            if (back)
                store(cells, signed_at(p, i, *to), lines - g * LANES);
            else
                *to = signed_at(p, i, load(cells, lines - g * LANES));
        }
}

/* LANES cells from i0 on of LANES lines that lie one after the other, turned; row: cell i0 of the first. */
static inline __attribute__((always_inline)) void
block_behind(const struct places *p, int i0, int g, pack *x, double *row, int across, bool back)
{
    pack block[LANES];
    if (back) {
        for (int l = 0; l < LANES; l++)
            block[l] = signed_at(p, i0 + l, *place(p, x, i0 + l, g));
        transpose(block);
        for (int l = 0; l < LANES; l++)
            memcpy(row + (long)l * across, &block[l], sizeof(pack));
    } else {
        for (int l = 0; l < LANES; l++)
            memcpy(&block[l], row + (long)l * across, sizeof(pack));
        transpose(block);
        for (int l = 0; l < LANES; l++)
            *place(p, x, i0 + l, g) = signed_at(p, i0 + l, block[l]);
    }
}

/* The same of fewer lines or cells. */
static void part_behind(const struct places *p, int i0, int cells, int g, pack *x, double *row,
                        int across, int lines, bool back)
{
    pack block[LANES] = {{0}};
    for (int l = 0; back && l < cells; l++)
        block[l] = signed_at(p, i0 + l, *place(p, x, i0 + l, g));
    for (int l = 0; !back && l < LANES && l < lines; l++)
        block[l] = load(row + (long)l * across, cells);
    transpose(block);
    for (int l = 0; !back && l < cells; l++)
        *place(p, x, i0 + l, g) = signed_at(p, i0 + l, block[l]);
    for (int l = 0; back && l < LANES && l < lines; l++)
        store(row + (long)l * across, block[l], cells);
}

static void lines_behind(const struct places *p, int n, pack *x, double *at, int across,
                         int lines, bool back)
{
    for (int g = 0; g < 2; g++)
        for (int i0 = 0; i0 < n; i0 += LANES) {
            const int cells = n - i0 < LANES ? n - i0 : LANES, left = lines - g * LANES;
            double *const row = at + (long)g * LANES * across + i0;
            if (cells < LANES || left < LANES)
                part_behind(p, i0, cells, g, x, row, across, left, back);
            else if (back)
                block_behind(p, i0, g, x, row, across, true);
            else
                block_behind(p, i0, g, x, row, across, false);
        }
}

/* Lines in direction whose cells are `along` apart, `across` from line to line, where one of the two is 1. */
static inline void lines_move(const struct places *p, int n, pack *x, double *at, int along,
                              int across, int lines, bool back)
{
    if (across == 1)
        lines_beside(p, n, x, at, along, lines, back);
    else
        lines_behind(p, n, x, at, across, lines, back);
}
