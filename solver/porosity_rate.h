/* porosity_rate.h - how fast the fluid fraction changes, from the grains' velocities. */
#ifndef POROSITY_RATE_H
#define POROSITY_RATE_H

struct sim;

/* out = d(eps)/dt = div(phi v), 1/s on cells; phi v of a cell by the shares of its grains, on a
 * face the mean of the two cells, none through the sides of the box. scratch: a grid field. */
void porosity_rate(const struct sim *s, double *scratch, double *out);

#endif
