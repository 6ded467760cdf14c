/* output.h - run.nc, run.xmf, summary.txt, crash.nc.
 *
 * run.nc is netCDF-4 with CF metadata. Dimensions: grain, x, y, z (centres), xf, yf, zf
 * (faces), time (outputs of fields and grains), sample (time series, named `sample_time`), and
 * per table <table>_row. Grains are written in order of id. Global attributes hold the resolved
 * scene, module names, versions, revision, compiler, flags, threads, host, date. */
#ifndef OUTPUT_H
#define OUTPUT_H

struct sim;
struct scene;

/* Makes the folder and run.nc (written under a temporary name, renamed when complete).
 * EXIT_WRITE if it cannot. `scene` is only read here. */
void output_create(struct sim *s, struct scene *scene);
void output_fields(struct sim *s); /* grains and fields at this time */
void output_sample(struct sim *s); /* one sample of every series */
void output_close(struct sim *s);  /* tables, summary attributes, run.xmf, summary.txt */
void output_crash(struct sim *s, const char *message); /* crash.nc: the state at hand */

#endif
