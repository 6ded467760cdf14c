/* halos.c - halos of runs, in the order in which their slots name them. */
#include "halos.h"

#include <string.h>

/* Counts the grains of other runs that a run's slots name, in the order of the slots; writes the
 * `to` of the slots and, from `halo` on, the grains. The marks of the thread tell what it has
 * seen in this run. */
static int count_halo(struct neighbours *nb, int run, int n, int (*mark)[2], int *halo)
{
    const struct slots *const l = &nb->pairs;
    const int first = run * nb->run, last = first + nb->run < n ? first + nb->run : n;
    int count = 0;
    for (int t = l->begin[first]; t < l->begin[last]; t++) {
        const int j = l->other[t];
        if (j >= first && j < last) {
            nb->to[t] = j - first;
            continue;
        }
        if (mark[j][0] != run + 1) {
            mark[j][0] = run + 1;
            mark[j][1] = count;
            halo[count++] = j;
        }
        nb->to[t] = nb->run + mark[j][1];
    }
    return count;
}

/* For each run its grains' entries in the halos of others. */
static void list_incoming(struct neighbours *nb, const int *halo)
{
    const int entries = nb->halo_begin[nb->runs];
    int *const next = xalloc((size_t)nb->runs + 1, sizeof *next);
    xfree(nb->begin_in);
    xfree(nb->in);
    nb->begin_in = xalloc((size_t)nb->runs + 1, sizeof *nb->begin_in);
    nb->in = xalloc((size_t)entries + IN_AHEAD, sizeof *nb->in);
    for (int e = 0; e < entries; e++)
        nb->begin_in[halo[e] / nb->run + 1]++;
    for (int run = 0; run < nb->runs; run++) {
        nb->begin_in[run + 1] += nb->begin_in[run];
        next[run] = nb->begin_in[run];
    }
    for (int run = 0; run < nb->runs; run++)
        for (int e = nb->halo_begin[run]; e < nb->halo_begin[run + 1]; e++)
            nb->in[next[halo[e] / nb->run]++] = (struct incoming){
                .entry = (int)neighbours_entry(nb, run, nb->run + e - nb->halo_begin[run]),
                .local = halo[e] % nb->run};
    xfree(next);
}

void halos_make(struct neighbours *nb, int n)
{
    const struct slots *const l = &nb->pairs;
    int *const halo = xalloc(l->n + 1, sizeof *halo); /* of a run from its first slot on */
    xfree(nb->to);
    xfree(nb->halo_begin);
    nb->to = xalloc(l->n + 1, sizeof *nb->to);
    nb->halo_begin = xalloc((size_t)nb->runs + 1, sizeof *nb->halo_begin);
#pragma omp parallel
    {
        int(*const mark)[2] = xalloc((size_t)n + 1, sizeof *mark);
#pragma omp for schedule(static)
        for (int run = 0; run < nb->runs; run++)
            nb->halo_begin[run + 1] =
                count_halo(nb, run, n, mark, halo + l->begin[run * nb->run]);
        xfree(mark);
    }
    for (int run = 0; run < nb->runs; run++) {
        const int count = nb->halo_begin[run + 1];
        nb->halo_begin[run + 1] = nb->halo_begin[run] + count;
        memmove(halo + nb->halo_begin[run], halo + l->begin[run * nb->run],
                (size_t)count * sizeof *halo);
    }
    list_incoming(nb, halo);
    xfree(halo);
}
