/* bed_save.c - writes bed.nc: the grains at hand, for another run. */
#include "bed_file.h"

#include <errno.h>
#include <netcdf.h>
#include <string.h>
#include "output_file.h"
#include "provenance_info.h"

static void put_vectors(const struct output_file *f, int var, const vec3 *v, const int *order,
                        int n)
{
    vec3 *const x = xalloc((size_t)n + 1, sizeof *x);
    for (int i = 0; i < n; i++)
        x[i] = v[order[i]];
    output_check(f, nc_put_var_double(f->nc, var, &x[0].x));
    xfree(x);
}

static void put_sizes(const struct output_file *f, int radius, int species,
                      const struct grains *g, const int *order)
{
    double *const r = xalloc((size_t)g->n + 1, sizeof *r);
    int *const k = xalloc((size_t)g->n + 1, sizeof *k);
    for (int i = 0; i < g->n; i++) {
        r[i] = g->radius[order[i]];
        k[i] = g->kind[order[i]];
    }
    output_check(f, nc_put_var_double(f->nc, radius, r));
    output_check(f, nc_put_var_int(f->nc, species, k));
    xfree(r);
    xfree(k);
}

static int define_turns(const struct output_file *f, int grain)
{
    int dim[2] = {grain};
    output_check(f, nc_def_dim(f->nc, "quaternion", 4, &dim[1]));
    return output_define(f, "orientation", NC_DOUBLE, 2, dim, "1",
                         "w x y z, the quaternion that turns the body's axes to the box's");
}

static void put_turns(const struct output_file *f, int var, const struct grains *g,
                      const int *order)
{
    struct quat *const q = xalloc((size_t)g->n + 1, sizeof *q);
    for (int i = 0; i < g->n; i++)
        q[i] = g->orientation[order[i]];
    output_check(f, nc_put_var_double(f->nc, var, &q[0].w));
    xfree(q);
}

void bed_file_write(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    struct output_file f = {.path = xprintf("%s/bed.nc", s->run.directory)};
    struct provenance line[PROVENANCE_LINES];
    char *const names = xalloc((size_t)g->n_species + 1, NAME_LENGTH + 1);
    int dim[2];
    errno = 0;
    f.part = xprintf("%s.part", f.path);
    output_check(&f, nc_create(f.part, NC_NETCDF4 | NC_CLOBBER, &f.nc));
    const int lines = provenance(line);
    for (int i = 0; i < lines; i++)
        output_text(&f, NC_GLOBAL, line[i].key, line[i].value);
    output_check(
        &f, nc_put_att_double(f.nc, NC_GLOBAL, "domain_size", NC_DOUBLE, 3, s->domain.size));
    output_check(&f, nc_put_att_double(f.nc, NC_GLOBAL, "time", NC_DOUBLE, 1, &s->t));
    output_check(&f, nc_def_dim(f.nc, "grain", (size_t)g->n, &dim[0]));
    output_check(&f, nc_def_dim(f.nc, "component", 3, &dim[1]));
    const int turn = g->orientation ? define_turns(&f, dim[0]) : -1;
    const int pos =
        output_define(&f, "position", NC_DOUBLE, 2, dim, "m", "centre of the grain");
    const int vel =
        output_define(&f, "velocity", NC_DOUBLE, 2, dim, "m s-1", "velocity of the grain");
    const int spin = output_define(&f, "spin", NC_DOUBLE, 2, dim, "rad s-1",
                                   "angular velocity of the grain");
    const int radius =
        output_define(&f, "radius", NC_DOUBLE, 1, dim, "m", "bounding radius of the grain");
    const int species =
        output_define(&f, "grain_species", NC_INT, 1, dim, "1", "species of the grain");
    for (int k = 0; k < g->n_species; k++)
        strcat(strcat(names, k > 0 ? " " : ""), g->species[k].name);
    output_text(&f, species, "flag_meanings", names);
    output_check(&f, nc_enddef(f.nc));
    int *const order = grains_order(g);
    if (g->n > 0) {
        put_vectors(&f, pos, g->pos, order, g->n);
        put_vectors(&f, vel, g->vel, order, g->n);
        put_vectors(&f, spin, g->spin, order, g->n);
        if (turn >= 0)
            put_turns(&f, turn, g, order);
        put_sizes(&f, radius, species, g, order);
    }
    output_file_close(&f);
    xfree(order);
    xfree(names);
}
