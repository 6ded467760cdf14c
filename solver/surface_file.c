/* surface_file.c - see surface_file.h. */
#include "surface_file.h"

#include <errno.h>
#include <netcdf.h>
#include <stdio.h>
#include <string.h>
#include "../shapes/shape.h"
#include "output_file.h"
#include "sim.h"

/* Corners as they come. */
struct corners {
    struct shape_canvas canvas;
    size_t n, room;
    double scale;
    int of;
    vec3 *x;
    int *species;
};

static void add(struct shape_canvas *canvas, vec3 a, vec3 b, vec3 p)
{
    struct corners *const c = (struct corners *)canvas;
    const vec3 three[3] = {a, b, p};
    if (c->n + 3 > c->room) {
        const size_t more = 2 * c->room + 3072;
        c->x = xrealloc(c->x, c->room, more, sizeof *c->x);
        c->species = xrealloc(c->species, c->room, more, sizeof *c->species);
        c->room = more;
    }
    for (int k = 0; k < 3; k++) {
        c->x[c->n] = v3_scale(c->scale, three[k]);
        c->species[c->n++] = c->of;
    }
}

/* Of species `only`, or of all (-1); free x and species. */
static struct corners corners_of(const struct sim *s, int only)
{
    struct corners c = {.canvas = {.triangle = add}};
    for (int k = 0; k < s->grains.n_species; k++) {
        if (only >= 0 && k != only)
            continue;
        c.of = k;
        c.scale = 1.0 / s->grains.species[k].form.bounding;
        shape.surface(k, &c.canvas);
    }
    return c;
}

static void drop(struct corners *c)
{
    xfree(c->x);
    xfree(c->species);
}

void surface_file_define(const struct output_file *f, const struct sim *s)
{
    int dim[2];
    if (!shape.surface || s->grains.n_species == 0)
        return;
    struct corners c = corners_of(s, -1);
    output_check(f, nc_def_dim(f->nc, "surface_corner_count", c.n, &dim[0]));
    dim[1] = f->dim[DIM_COMPONENT];
    output_define(f, "surface_corner", NC_FLOAT, 2, dim, "1",
                  "corners of triangles, three in a row, in the body's frame over the bounding "
                  "radius");
    output_define(f, "surface_species", NC_INT, 1, dim, "1", "species of the triangle");
    drop(&c);
}

void surface_file_write(const struct output_file *f, const struct sim *s)
{
    int corner, species;
    if (!shape.surface || s->grains.n_species == 0)
        return;
    struct corners c = corners_of(s, -1);
    output_check(f, nc_inq_varid(f->nc, "surface_corner", &corner));
    output_check(f, nc_inq_varid(f->nc, "surface_species", &species));
    if (c.n > 0) {
        output_check(f, nc_put_var_double(f->nc, corner, &c.x[0].x));
        output_check(f, nc_put_var_int(f->nc, species, c.species));
    }
    drop(&c);
}

static void write_stl(const struct sim *s, int species)
{
    const char *const name = s->grains.species[species].name;
    char *const path = xprintf("%s/surface_%s.stl", s->run.directory, name);
    FILE *const to = fopen(path, "w");
    struct corners c = corners_of(s, species);
    if (!to)
        die(EXIT_WRITE, "%s: %s", path, strerror(errno));
    fprintf(to, "solid %s\n", name);
    for (size_t k = 0; k + 2 < c.n; k += 3) {
        const vec3 *const x = &c.x[k];
        const vec3 n = v3_cross(v3_sub(x[1], x[0]), v3_sub(x[2], x[0]));
        const double size = v3_norm(n), inverse = size > 0.0 ? 1.0 / size : 0.0;
        fprintf(to, "facet normal %.6g %.6g %.6g\nouter loop\n", inverse * n.x, inverse * n.y,
                inverse * n.z);
        for (int v = 0; v < 3; v++)
            fprintf(to, "vertex %.7g %.7g %.7g\n", x[v].x, x[v].y, x[v].z);
        fprintf(to, "endloop\nendfacet\n");
    }
    fprintf(to, "endsolid %s\n", name);
    if (fclose(to) != 0)
        die(EXIT_WRITE, "%s: %s", path, strerror(errno));
    drop(&c);
    xfree(path);
}

void surface_file_stl(const struct sim *s)
{
    for (int k = 0; shape.surface && k < s->grains.n_species; k++)
        write_stl(s, k);
}
