/* halos.h - which grains of other runs each run adds forces to, and where each grain finds its own. */
#ifndef HALOS_H
#define HALOS_H

#include "neighbours.h"

/* Makes to, halo_begin, in and begin_in of the pairs at hand, of n grains. */
void halos_make(struct neighbours *nb, int n);

#endif
