/* xdmf.h - a sidecar that lets ParaView open run.nc (netCDF-4 is HDF5). */
#ifndef XDMF_H
#define XDMF_H

#include <stddef.h>

struct sim;

/* Writes run.xmf for the outputs at these times, s; `count`: grains of each, or NULL where they
 * are always the same. */
void xdmf_write(const struct sim *s, const double *times, size_t n_time, const size_t *count);

#endif
