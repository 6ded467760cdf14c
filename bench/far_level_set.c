/* bench/far_level_set.c - pairs of crescents given by their distance field that do not touch, see
 * far_pairs.h. */
/* slots: shapes/level_set contact/hertz_mindlin */
#define START 0.12
#define BED                                                                                    \
    xprintf("[domain]\nsize = 28 28 60 mm\n[grains l]\nform = %s/scenes/crescent.stl\n"        \
            "form_cells = 40\nnode_spacing = 0.12\ndiameter = 4 mm\ndensity = 2500 kg/m3\n"    \
            "count = 60\nfill = random\nmaterial = m\n[material m]\nyoung = 5 MPa\n"           \
            "poisson = 0.3\nfriction = 0.5\nrestitution = 0.5\n[run]\nend = 1 s\n"             \
            "substeps = 1\ndt = 20 us\n",                                                      \
            getcwd(here, sizeof here))
#include <unistd.h>
static char here[4096];
#include "far_pairs.h"
