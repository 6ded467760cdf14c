/* diffuse.h - a field of cells diffused by a Gaussian of given width: exp(w^2/2 L) with L the
 * seven-point Laplacian, no flux through sides that are not periodic.
 *
 * The operator is symmetric (its own transpose in the sum over cells), keeps the sum of a field to
 * round-off, next to walls too, keeps what is constant or, away from walls, linear in space, and makes
 * no negative value of positive ones beyond round-off. */
#ifndef DIFFUSE_H
#define DIFFUSE_H

#include "grid.h"

/* What a binary without diffusion must know of it, so that it links none of the transforms. */
struct diffuse {
    void (*apply)(struct diffuse *f, double *field);
    void (*free)(struct diffuse *f);
};

/* width: standard deviation, m, > 0 */
struct diffuse *diffuse_create(const struct grid *g, const struct domain *d, double width);
static inline void diffuse_free(struct diffuse *f)
{
    if (f)
        f->free(f);
}

/* In place; reads and writes interior cells only. The same bits on any number of threads. */
static inline void diffuse_apply(struct diffuse *f, double *field)
{
    f->apply(f, field);
}

#endif
