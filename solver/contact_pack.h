/* contact_pack.h - the active contacts of a run as the loop of spheres keeps them from one choice of
 * active slots to the next: side by side in blocks, their memory as the laws want it, so that a step
 * reads and writes it in place and nothing else of the lists. Between choices the slots' own memory
 * and marks (neighbours.h) are out of date; pack_put_back brings them up. */
#ifndef CONTACT_PACK_H
#define CONTACT_PACK_H

#include "../contact/touch.h"
#include "neighbours.h"

struct sim;

struct pack_block {
    _Alignas(64) int i[TOUCH], j[TOUCH]; /* grains */
    int to[TOUCH];                       /* j as the run counts it (neighbours.to) */
    real depth[TOUCH];                   /* m, overlap at the last step */
    real memory[][TOUCH];                /* rows */
};

struct pack {
    int n;    /* contacts; lanes behind them repeat the last one */
    int room; /* blocks */
    char *data;
};

static inline size_t pack_size(int rows)
{
    return sizeof(struct pack_block) + (size_t)rows * TOUCH * sizeof(real);
}

static inline struct pack_block *pack_block(const struct pack *p, int block, int rows)
{
    return (struct pack_block *)(void *)(p->data + (size_t)block * pack_size(rows));
}

/* Packs the active pair slots of a run; those of its pack go back to their slots. */
void pack_fill(struct sim *s, int run);
void pack_put_back(struct sim *s, int run);

#endif
