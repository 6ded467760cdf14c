/* contact_points_memory.c - which contact of a pair goes on with which memory, see contact_points.h. */
#include "contact_points.h"

#include <string.h>

/* Which record each of n points goes on with; -1 for none. Of points that share a stiffness several may
 * go on with the memory of one that has ended: then a new record starts as a copy of it, `like`. */
static void match(const struct cut *cut, real *memory, const struct shape_point *p,
                  const vec3 *place, int n, double close, int *record, int *like)
{
    const int used = points_used(cut, memory);
    bool taken[POINTS_MOST], ended[POINTS_MOST];
    memset(taken, 0, (size_t)used);
    for (int k = 0; k < n; k++) {
        record[k] = -1;
        for (int r = 0; r < used && record[k] < 0; r++)
            if (record_id(points_record(cut, memory, r)) == p[k].id)
                record[k] = r;
        if (record[k] >= 0)
            taken[record[k]] = true;
    }
    for (int r = 0; r < used; r++)
        ended[r] = !taken[r];
    for (int k = 0; k < n; k++) {
        double nearest = close * close;
        int best = -1;
        like[k] = -1;
        if (record[k] >= 0)
            continue;
        for (int r = 0; r < used; r++) {
            const real *const at = points_record(cut, memory, r);
            const vec3 d = v3_sub(place[k], v3((double)at[1], (double)at[2], (double)at[3]));
            const bool busy = taken[r] && !(ended[r] && p[k].share > 0.0 && p[k].share < 1.0);
            if (busy || at[0] == (real)0.0 || v3_dot(d, d) >= nearest)
                continue;
            nearest = v3_dot(d, d);
            best = r;
        }
        if (best >= 0 && taken[best])
            like[k] = best;
        else if (best >= 0)
            record[k] = best;
        if (best >= 0)
            taken[best] = true;
    }
    for (int r = 0; r < used; r++) { /* contacts that ended */
        real *const at = points_record(cut, memory, r);
        if (!taken[r] && at[0] != (real)0.0)
            memset(at, 0, (size_t)(RECORD_HEAD + cut->rows) * sizeof *at);
    }
}

/* A free record; there is one, as n <= most. */
static int free_record(const struct cut *cut, real *memory, int from)
{
    while (points_record(cut, memory, from)[0] != (real)0.0)
        from++;
    return from;
}

/* Gives new points their records, before any record goes on to this step: a copy is of the last
 * one. Returns up to where records are in use. */
static int start_records(const struct cut *cut, real *memory, int n, int *record,
                         const int *like)
{
    int next = 0, used = 0;
    for (int k = 0; k < n; k++) {
        if (record[k] < 0) {
            record[k] = next = free_record(cut, memory, next);
            real *const at = points_record(cut, memory, next);
            at[0] = RECORD_NEW;
            if (like[k] >= 0)
                memcpy(at, points_record(cut, memory, like[k]),
                       (size_t)(RECORD_HEAD + cut->rows) * sizeof *memory);
        }
        used = record[k] >= used ? record[k] + 1 : used;
    }
    return used;
}

int points_match(const struct cut *cut, real *memory, const struct shape_point *p,
                 const vec3 *place, int n, double close, int *record)
{
    int like[POINTS_MOST];
    match(cut, memory, p, place, n, close, record, like);
    return start_records(cut, memory, n, record, like);
}
