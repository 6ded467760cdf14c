/* bench/far_dilated.c - pairs of cubes with rounded edges that do not touch, see far_pairs.h. */
/* slots: shapes/dilated_polyhedron contact/hertz_mindlin */
#define START 0.12
#define BED                                                                                    \
    "[domain]\nsize = 16 16 60 mm\n[grains cubes]\nform = cube\ndilation = 0.2 mm\n"           \
    "diameter = 2.43 mm\ndensity = 2500 kg/m3\ncount = 300\nfill = random\nmaterial = m\n"     \
    "[material m]\nyoung = 5 MPa\npoisson = 0.3\nfriction = 0.5\nrestitution = 0.5\n"          \
    "[run]\nend = 1 s\nsubsteps = 1\ndt = 20 us\n"
#include "far_pairs.h"
