/* verify/crossing.c - crossing RUN.NC RHO V: how much pressure noise a grain makes that is carried through
 * the grid at velocity V: prints the largest |p| over all cells and output times, and the largest change of
 * a cell's p from one output to the next, both over rho V^2. Used by verify/coupling.sh. */
#include <math.h>
#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>

static void fail(const char *what, int status)
{
    fprintf(stderr, "crossing: %s: %s\n", what, nc_strerror(status));
    exit(2);
}

int main(int argc, char **argv)
{
    int nc, var, dims, dim[NC_MAX_VAR_DIMS], status;
    size_t length[NC_MAX_VAR_DIMS], cells = 1;
    double largest = 0.0, jump = 0.0;
    if (argc != 4) {
        fprintf(stderr, "usage: crossing RUN.NC RHO V\n");
        return 2;
    }
    if ((status = nc_open(argv[1], NC_NOWRITE, &nc)) != NC_NOERR)
        fail(argv[1], status);
    if ((status = nc_inq_varid(nc, "pressure", &var)) != NC_NOERR ||
        (status = nc_inq_var(nc, var, NULL, NULL, &dims, dim, NULL)) != NC_NOERR)
        fail("pressure", status);
    for (int i = 0; i < dims; i++)
        nc_inq_dimlen(nc, dim[i], &length[i]);
    for (int i = 1; i < dims; i++)
        cells *= length[i];
    double *const now = malloc(cells * sizeof *now), *const before =
                                                         malloc(cells * sizeof *before);
    if (!now || !before)
        return 4;
    const size_t skip = length[0] / 20 + 2; /* the jerk at the start is not meant */
    for (size_t t = 1; t < length[0]; t++) {
        size_t start[NC_MAX_VAR_DIMS] = {t}, count[NC_MAX_VAR_DIMS];
        for (int i = 0; i < dims; i++)
            count[i] = i ? length[i] : 1;
        if ((status = nc_get_vara_double(nc, var, start, count, now)) != NC_NOERR)
            fail("pressure", status);
        for (size_t c = 0; c < cells && t > skip; c++) {
            largest = fmax(largest, fabs(now[c]));
            jump = fmax(jump, fabs(now[c] - before[c]));
        }
        for (size_t c = 0; c < cells; c++)
            before[c] = now[c];
    }
    nc_close(nc);
    free(now);
    free(before);
    const double scale = atof(argv[2]) * atof(argv[3]) * atof(argv[3]);
    printf("%.3g %.3g\n", largest / scale, jump / scale);
    return 0;
}
