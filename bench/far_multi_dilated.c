/* bench/far_multi_dilated.c - pairs of tetrapods that do not touch, see far_pairs.h. */
/* slots: shapes/multi_dilated_polyhedron contact/hertz_mindlin */
#define START 0.12
#define BED                                                                                    \
    "[domain]\nsize = 18 18 70 mm\n[grains t]\nform = tetrapod\ndilation = 0.2 mm\n"           \
    "diameter = 2.43 mm\ndensity = 2500 kg/m3\ncount = 200\nfill = random\nmaterial = m\n"     \
    "[material m]\nyoung = 5 MPa\npoisson = 0.3\nfriction = 0.5\nrestitution = 0.5\n"          \
    "[run]\nend = 1 s\nsubsteps = 1\ndt = 20 us\n"
#include "far_pairs.h"
