/* bench/dem_tile.c - a bed of silt for other programs, and for a larger bed of silt:
 *   dem_tile FORMAT BED LX LY NX NY [SWELL]   (m; the period of the bed, how often it is laid side by
 * side in x and y, and a factor on its diameters), to standard output. FORMAT: text (x y z diameter, m), atoms (the data file of
 * LAMMPS and LIGGGHTS: atom_style sphere and granular; density 2500 kg/m3). */
#include "../solver/bed_file.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double wrapped(double x, double period)
{
    const double y = fmod(x, period);
    return y < 0.0 ? y + period : y;
}

int main(int argc, char **argv)
{
    if ((argc != 7 && argc != 8) ||
        (strcmp(argv[1], "text") != 0 && strcmp(argv[1], "atoms") != 0)) {
        fprintf(stderr, "usage: dem_tile text|atoms BED LX LY NX NY [SWELL]\n");
        return EXIT_FAILURE;
    }
    const bool atoms = argv[1][0] == 'a';
    const double lx = strtod(argv[3], NULL), ly = strtod(argv[4], NULL);
    const int nx = atoi(argv[5]), ny = atoi(argv[6]);
    const double swell = argc == 8 ? strtod(argv[7], NULL) : 1.0;
    struct bed_file bed;
    char *const why = bed_file_read(&bed, argv[2], "");
    if (why != NULL || nx < 1 || ny < 1 || !(lx > 0.0) || !(ly > 0.0) || !(swell > 0.0)) {
        fprintf(stderr, "dem_tile: %s: %s\n", argv[2],
                why != NULL ? why : "not tiled like this");
        return EXIT_FAILURE;
    }
    double top = 0.0;
    for (int i = 0; i < bed.n; i++)
        top = fmax(top, bed.pos[i].z + 2.0 * bed.diameter[i]);
    if (atoms)
        printf("bed\n\n%d atoms\n1 atom types\n\n0 %.9g xlo xhi\n0 %.9g ylo yhi\n0 %.9g zlo "
               "zhi\n\nAtoms\n\n",
               bed.n * nx * ny, lx * nx, ly * ny, top);
    int id = 0;
    for (int x = 0; x < nx; x++)
        for (int y = 0; y < ny; y++)
            for (int i = 0; i < bed.n; i++) {
                const double px = wrapped(bed.pos[i].x, lx) + x * lx;
                const double py = wrapped(bed.pos[i].y, ly) + y * ly;
                const double d = swell * bed.diameter[i];
                id++;
                if (atoms)
                    printf("%d 1 %.9g 2500 %.10g %.10g %.10g\n", id, d, px, py, bed.pos[i].z);
                else
                    printf("%.10g %.10g %.10g %.9g\n", px, py, bed.pos[i].z, d);
            }
    bed_file_free(&bed);
    return EXIT_SUCCESS;
}
