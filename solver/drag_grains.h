/* drag_grains.h - what the laws of drag know of the grains, and how many they do not hold for.
 *
 * One struct drag_grain per species: its shape (of a sphere all numbers are 1; keys of [grains]
 * give others; else a shape's sphericity, and its crosswise and
 * lengthwise one along the slip as the grain lies), density ratio, D10. The mean diameter of the grains around a grain is Sauter's,
 * of its cell: d_32 = sum w V / sum (w V/d), with the shares w; kept only where the law of
 * the run asks for it. */
#ifndef DRAG_GRAINS_H
#define DRAG_GRAINS_H

#include "scene.h"

struct sim;
struct drag_grain;

struct drag_grains {
    int n_kinds;
    struct drag_grain *kind;         /* per species, prepared */
    struct shadow **across, **along; /* per species: crosswise and lengthwise sphericity of a
                                        direction; NULL: not by direction */
    double *sauter;                  /* m per cell; NULL: not asked for */
    int outside; /* grains outside the law's range, at the last fluid step */
    bool told;   /* the warning is out */
};

extern const struct key drag_grains_keys[];

void drag_grains_read(struct sim *s, struct scene *scene); /* after drag_init */
void drag_grains_create(struct sim *s);                    /* once grid and grains exist */
void drag_grains_free(struct sim *s);

/* The grain as its slip sees it, prepared: its species, or *own where the shape's numbers depend on the
 * direction of `slip` (m/s). */
const struct drag_grain *drag_grains_seen(const struct sim *s, int i, vec3 slip,
                                          struct drag_grain *own);
double drag_grains_diameter(const struct sim *s, int i); /* m, volume-equivalent */
/* From the shares at hand, and the volume of the grains per cell (diffused as these are). */
void drag_grains_sauter(struct sim *s, const double *volume);
void drag_grains_warn(struct sim *s);   /* on stderr, the first time that a grain is outside */
void drag_grains_report(struct sim *s); /* to the summary */

#endif
