/* output_walls.c - the surfaces of the walls in run.nc: triangles, at each output where a wall moves,
 * else once. */
#include "output_walls.h"

#include <netcdf.h>
#include <string.h>
#include "wall_draw.h"

static void define_names(const struct output_file *f, const struct sim *s, int var)
{
    char *names = xstrdup("");
    for (int k = 0; k < s->walls.n; k++) {
        if (s->walls.wall[k].kind == &wall_side)
            continue;
        char *const longer =
            xprintf("%s%s%s", names, names[0] ? " " : "", s->walls.wall[k].name);
        xfree(names);
        names = longer;
    }
    output_text(f, var, "flag_meanings", names);
    xfree(names);
}

void output_walls_define(struct output_file *f, const struct sim *s)
{
    struct wall_drawing d = walls_draw(s);
    f->wall_triangles = d.n;
    wall_drawing_free(&d);
    if (f->wall_triangles == 0)
        return;
    int triangle, corner, vertex, xyz;
    output_check(f, nc_def_dim(f->nc, "wall_triangle", (size_t)f->wall_triangles, &triangle));
    output_check(f, nc_def_dim(f->nc, "wall_corner", 3, &corner));
    output_check(f, nc_def_dim(f->nc, "wall_vertex", 3 * (size_t)f->wall_triangles, &vertex));
    if (nc_inq_dimid(f->nc, "component", &xyz) != NC_NOERR)
        output_check(f, nc_def_dim(f->nc, "component", 3, &xyz));
    const int moving[3] = {f->dim[DIM_TIME], vertex, xyz}, corners[2] = {triangle, corner};
    const int still = s->walls.moving ? 0 : 1;
    output_define(f, "wall_position", NC_DOUBLE, 3 - still, moving + still, "m",
                  "corners of the triangles of the walls");
    output_define(f, "wall_corners", NC_INT, 2, corners, "1",
                  "vertices of each triangle of the walls");
    define_names(f, s,
                 output_define(f, "wall_of_triangle", NC_INT, 1, &triangle, "1",
                               "wall of the triangle"));
}

static int variable(const struct output_file *f, const char *name)
{
    int var;
    output_check(f, nc_inq_varid(f->nc, name, &var));
    return var;
}

static void put_positions(const struct output_file *f, const struct sim *s,
                          const struct wall_drawing *d)
{
    const size_t start[3] = {f->n_time, 0, 0}, count[3] = {1, 3 * (size_t)d->n, 3};
    const int still = s->walls.moving ? 0 : 1;
    output_check(f, nc_put_vara_double(f->nc, variable(f, "wall_position"), start + still,
                                       count + still, &d->at[0].x));
}

void output_walls_begin(const struct output_file *f, const struct sim *s)
{
    if (f->wall_triangles == 0)
        return;
    struct wall_drawing d = walls_draw(s);
    int *const corner = xalloc(3 * (size_t)d.n, sizeof *corner);
    for (int i = 0; i < 3 * d.n; i++)
        corner[i] = i;
    output_check(f, nc_put_var_int(f->nc, variable(f, "wall_corners"), corner));
    output_check(f, nc_put_var_int(f->nc, variable(f, "wall_of_triangle"), d.wall));
    if (!s->walls.moving)
        put_positions(f, s, &d);
    xfree(corner);
    wall_drawing_free(&d);
}

void output_walls_record(const struct output_file *f, const struct sim *s)
{
    if (f->wall_triangles == 0 || !s->walls.moving)
        return;
    struct wall_drawing d = walls_draw(s);
    put_positions(f, s, &d);
    wall_drawing_free(&d);
}
