/* probes.h - what is measured of the fluid while it flows: [probe NAME].
 *
 *   point         pressure, velocity and porosity at a point
 *   line          the same along a line, a table at the end
 *   plane         means over a plane across an axis: pressure, superficial velocity, porosity
 *   drop          pressure drop between two planes
 *   permeability  k = mu U L/drop between two planes, and whether it has converged: its
 *                 relative change over a span of time below a tolerance, which may end the run
 * Values are time series of run.nc ("NAME_pressure"), and lines of the summary with their mean
 * and their largest and smallest value over the run. Pressures are without their hydrostatic
 * part; a driving gradient counts as a drop. */
#ifndef PROBES_H
#define PROBES_H

#include <stdbool.h>
#include <stdio.h>
#include "scene.h"

struct sim;

extern const struct key probe_keys[];

void probes_create(struct sim *s, struct scene *scene); /* once the grid exists */
void probes_watch(struct sim *s);                       /* after every step of the fluid */
void probes_report(struct sim *s);                      /* summary lines, tables of lines */
void probes_free(struct sim *s);

#endif
