/* verify/boxes_in_air.c - places of cubes that do not overlap, for grains as wide as these to fall from.
 *
 * boxes_in_air EDGE COUNT SEED BASE HEIGHT X Y Z DIAMETER: lines for fill = file on stdout, of COUNT grains of
 * that volume-equivalent diameter in BASE x BASE x HEIGHT from X Y Z up; all in m. */
#include <stdlib.h>
#include "random_boxes.h"

int main(int argc, char **argv)
{
    double v[10] = {0.0};
    for (int k = 1; k < argc && k < 10; k++)
        v[k] = atof(argv[k]);
    if (argc != 10) {
        fprintf(stderr, "boxes_in_air EDGE COUNT SEED BASE HEIGHT X Y Z DIAMETER\n");
        return 2;
    }
    const double half = 0.5 * v[1];
    const struct box_kind k = {.half = {half, half, half}, .base = v[4], .height = v[5]};
    if (!boxes_place(&k, (int)v[2], (unsigned long)v[3], v3(v[6], v[7], v[8]), 1.0, v[9],
                     stdout)) {
        fprintf(stderr, "%d cubes of %g m find no room in %g x %g x %g m\n", (int)v[2], v[1],
                v[4], v[4], v[5]);
        return 2;
    }
    return 0;
}
