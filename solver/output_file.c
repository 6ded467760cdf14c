/* output_file.c - a netCDF-4 file with CF metadata [CF-1.10]: what it holds follows from the
 * tables of table.h, no field is named here. Grains go in order of id, grid fields without
 * their ghosts, faces of a direction with one layer more than cells. */
#include "output_file.h"

#include <errno.h>
#include <netcdf.h>
#include <string.h>
#include <unistd.h>
#include "output_walls.h"
#include "provenance_info.h"
#include "surface_file.h"

/* HDF5 cleans up at exit, and crashes there after a write that failed (1.10.8, a full disk):
 * the program would end with a signal instead of its exit code. So it leaves without that. */
static void leave(int code, const char *message)
{
    (void)message;
    fflush(NULL);
    _exit(code);
}

void output_check(const struct output_file *f, int status)
{
    if (status == NC_NOERR)
        return;
    die_hook = leave;
    /* HDF5 says only that it failed; the system says why */
    const int why = status == NC_EHDFERR ? errno : 0;
    die(EXIT_WRITE, "%s: cannot be written: %s%s%s", f->part, nc_strerror(status),
        why ? ": " : "", why ? strerror(why) : "");
}

void output_text(const struct output_file *f, int var, const char *key, const char *text)
{
    output_check(f, nc_put_att_text(f->nc, var, key, strlen(text), text));
}

int output_define(const struct output_file *f, const char *name, int type, int n,
                  const int *dims, const char *unit, const char *long_name)
{
    int var;
    output_check(f, nc_def_var(f->nc, name, type, n, dims, &var));
    output_text(f, var, "units", unit);
    output_text(f, var, "long_name", long_name);
    return var;
}

static void define_dim(struct output_file *f, const char *name, size_t length, int which)
{
    output_check(f, nc_def_dim(f->nc, name, length, &f->dim[which]));
}

static const char *const axis_name[2][3] = {{"x", "y", "z"}, {"xf", "yf", "zf"}};

static void define_axes(struct output_file *f, const struct sim *s)
{
    static const char *const axis[3] = {"X", "Y", "Z"};
    for (int face = 0; face < 2; face++)
        for (int a = 0; a < 3; a++) {
            const int which = (face ? DIM_XF : DIM_X) + a;
            define_dim(f, axis_name[face][a], (size_t)s->grid.n[a] + face, which);
            const int var =
                output_define(f, axis_name[face][a], NC_DOUBLE, 1, &f->dim[which], "m",
                              face ? "faces of the cells" : "centres of the cells");
            output_text(f, var, "axis", axis[a]);
            if (a == 2)
                output_text(f, var, "positive", "up");
        }
}

static void write_axes(const struct output_file *f, const struct sim *s)
{
    for (int face = 0; face < 2; face++)
        for (int a = 0; a < 3; a++) {
            const int n = s->grid.n[a] + face;
            double *const x = xalloc((size_t)n, sizeof *x);
            int var;
            for (int i = 0; i < n; i++)
                x[i] = (i + (face ? 0.0 : 0.5)) * s->grid.h[a];
            output_check(f, nc_inq_varid(f->nc, axis_name[face][a], &var));
            output_check(f, nc_put_var_double(f->nc, var, x));
            xfree(x);
        }
}

/* Two dimensions without an end: the library would take chunks of one entry. */
static void chunk(const struct output_file *f, int var, const struct grains *g)
{
    const double expected = fmax(g->n, 512.0);
    const size_t size[3] = {1, (size_t)fmin(expected, 65536.0), 3};
    if (f->varies)
        output_check(f, nc_def_var_chunking(f->nc, var, NC_CHUNKED, size));
}

static void define_grains(struct output_file *f, const struct sim *s)
{
    const struct grains *const g = &s->grains;
    define_dim(f, "grain", f->varies ? NC_UNLIMITED : (size_t)g->n, DIM_GRAIN);
    define_dim(f, "component", 3, DIM_COMPONENT);
    if (g->orientation)
        define_dim(f, "quaternion", 4, DIM_QUATERNION);
    int var;
    output_check(f, nc_def_var(f->nc, "component", NC_STRING, 1, &f->dim[DIM_COMPONENT], &var));
    output_text(f, var, "long_name", "component of a vector");
    const int dims[2] = {f->dim[DIM_TIME], f->dim[DIM_GRAIN]};
    const int *const dim = f->varies ? dims : dims + 1;
    const int n = f->varies ? 2 : 1;
    if (f->varies) {
        output_define(f, "grain_count", NC_INT, 1, dims, "1",
                      "grains of this output: the first entries along grain");
        var = output_define(f, "grain_id", NC_INT, 2, dims, "1", "identity of the grain");
        chunk(f, var, g);
    }
    var = output_define(f, "radius", NC_DOUBLE, n, dim, "m", "bounding radius of the grain");
    chunk(f, var, g);
    var = output_define(f, "grain_mass", NC_DOUBLE, n, dim, "kg", "mass of the grain");
    chunk(f, var, g);
    var = output_define(f, "grain_species", NC_INT, n, dim, "1", "species of the grain");
    chunk(f, var, g);
    if (g->n_species == 0)
        return;
    char *const names = xalloc((size_t)g->n_species, NAME_LENGTH + 1);
    int *const values = xalloc((size_t)g->n_species, sizeof *values);
    for (int k = 0; k < g->n_species; k++) {
        strcat(strcat(names, k > 0 ? " " : ""), g->species[k].name);
        values[k] = k;
    }
    output_check(
        f, nc_put_att_int(f->nc, var, "flag_values", NC_INT, (size_t)g->n_species, values));
    output_text(f, var, "flag_meanings", names);
    xfree(names);
    xfree(values);
}

static void write_grains(const struct output_file *f, const struct sim *s)
{
    const struct grains *const g = &s->grains;
    const struct {
        const char *name;
        const double *value;
    } list[] = {{"radius", g->radius}, {"grain_mass", g->mass}};
    const size_t start[2] = {f->varies ? f->n_time : 0, 0}, count[2] = {1, (size_t)g->n};
    const int skip = f->varies ? 0 : 1;
    double *const x = xalloc((size_t)g->n + 1, sizeof *x);
    int *const k = xalloc((size_t)g->n + 1, sizeof *k), *const order = grains_order(g), var;
    for (size_t l = 0; l < sizeof list / sizeof list[0] && g->n > 0; l++) {
        for (int i = 0; i < g->n; i++)
            x[i] = list[l].value[order[i]];
        output_check(f, nc_inq_varid(f->nc, list[l].name, &var));
        output_check(f, nc_put_vara_double(f->nc, var, start + skip, count + skip, x));
    }
    for (int i = 0; i < g->n; i++)
        k[i] = g->kind[order[i]];
    output_check(f, nc_inq_varid(f->nc, "grain_species", &var));
    if (g->n > 0)
        output_check(f, nc_put_vara_int(f->nc, var, start + skip, count + skip, k));
    for (int i = 0; i < g->n; i++)
        k[i] = g->id[order[i]];
    if (f->varies && g->n > 0) {
        output_check(f, nc_inq_varid(f->nc, "grain_id", &var));
        output_check(f, nc_put_vara_int(f->nc, var, start, count, k));
    }
    xfree(order);
    xfree(x);
    xfree(k);
}

static void write_components(const struct output_file *f)
{
    static const char *component[3] = {"x", "y", "z"};
    int var;
    output_check(f, nc_inq_varid(f->nc, "component", &var));
    output_check(f, nc_put_var_string(f->nc, var, component));
}

/* Sizes, species and ids of this record. */
static void record_grains(struct output_file *f, const struct sim *s)
{
    int var;
    f->count = xrealloc(f->count, f->n_time, f->n_time + 1, sizeof *f->count);
    f->count[f->n_time] = (size_t)s->grains.n;
    output_check(f, nc_inq_varid(f->nc, "grain_count", &var));
    output_check(f, nc_put_var1_int(f->nc, var, &f->n_time, &s->grains.n));
    write_grains(f, s);
}

static bool has_grains(const struct sim *s)
{
    return s->grains.n > 0 || insert_changes(s);
}

static bool is_written(const struct sim *s, const struct field *field)
{
    return field->flags & FIELD_OUTPUT &&
           (field->place == PLACE_GRAIN ? has_grains(s) : s->fluid.exists);
}

/* Dimensions of a field's variable; returns how many. */
static int field_dims(const struct output_file *f, const struct field *field, int dims[5])
{
    int n = 0;
    dims[n++] = f->dim[DIM_TIME];
    if (field->place == PLACE_GRAIN)
        dims[n++] = f->dim[DIM_GRAIN];
    else
        for (int a = 2; a >= 0; a--)
            dims[n++] = f->dim[((int)field->place - PLACE_FACE_X == a ? DIM_XF : DIM_X) + a];
    if (field->kind == KIND_VEC3)
        dims[n++] = f->dim[DIM_COMPONENT];
    if (field->kind == KIND_QUAT)
        dims[n++] = f->dim[DIM_QUATERNION];
    return n;
}

static void define_fields(struct output_file *f, const struct sim *s)
{
    f->var_field = xalloc((size_t)s->fields.n + 1, sizeof *f->var_field);
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const field = &s->fields.field[i];
        int dims[5];
        if (!is_written(s, field))
            continue;
        const int n = field_dims(f, field, dims);
        f->var_field[i] =
            output_define(f, field->name, field->kind == KIND_INT ? NC_INT : NC_DOUBLE, n, dims,
                          field->unit, field->long_name);
        if (field->place == PLACE_GRAIN)
            chunk(f, f->var_field[i], &s->grains);
    }
}

static void put_globals(const struct output_file *f, const struct sim *s)
{
    struct provenance line[PROVENANCE_LINES];
    const int n = provenance(line);
    const int periodic[3] = {s->domain.periodic[0], s->domain.periodic[1],
                             s->domain.periodic[2]};
    output_text(f, NC_GLOBAL, "Conventions", "CF-1.10");
    for (int i = 0; i < n; i++)
        output_text(f, NC_GLOBAL, line[i].key, line[i].value);
    output_check(
        f, nc_put_att_double(f->nc, NC_GLOBAL, "domain_size", NC_DOUBLE, 3, s->domain.size));
    output_check(f, nc_put_att_int(f->nc, NC_GLOBAL, "domain_periodic", NC_INT, 3, periodic));
}

void output_file_open(struct output_file *f, const struct sim *s, const char *name)
{
    *f = (struct output_file){.path = xprintf("%s/%s", s->run.directory, name)};
    f->part = xprintf("%s.part", f->path);
    output_check(f, nc_create(f->part, NC_NETCDF4 | NC_CLOBBER, &f->nc));
    put_globals(f, s);
    define_dim(f, "time", NC_UNLIMITED, DIM_TIME);
    f->var_time =
        output_define(f, "time", NC_DOUBLE, 1, &f->dim[DIM_TIME], "s", "simulated time");
    output_text(f, f->var_time, "axis", "T");
    f->varies = insert_changes(s);
    if (has_grains(s))
        define_grains(f, s);
    if (s->fluid.exists)
        define_axes(f, s);
    define_fields(f, s);
    output_walls_define(f, s);
    if (has_grains(s))
        surface_file_define(f, s);
}

void output_file_begin(struct output_file *f, const struct sim *s)
{
    output_check(f, nc_enddef(f->nc));
    if (has_grains(s)) {
        write_components(f);
        surface_file_write(f, s);
    }
    if (has_grains(s) && !f->varies)
        write_grains(f, s);
    if (s->fluid.exists)
        write_axes(f, s);
    output_walls_begin(f, s);
    output_check(f, nc_sync(f->nc));
}

/* The interior of a grid field, packed. */
static void *pack(const struct sim *s, const struct field *field, size_t count[5])
{
    const struct grid *const g = &s->grid;
    const int more = (int)field->place - PLACE_FACE_X; /* direction with n + 1 layers, or < 0 */
    const int n[3] = {g->n[0] + (more == 0), g->n[1] + (more == 1), g->n[2] + (more == 2)};
    const size_t size = kind_size(field->kind), row = (size_t)n[0] * size;
    const char *const from = *field->data;
    char *const x = xalloc((size_t)n[1] * n[2], row), *to = x;
    for (int k = 1; k <= n[2]; k++)
        for (int j = 1; j <= n[1]; j++, to += row)
            memcpy(to, from + (size_t)cell(g, 1, j, k) * size, row);
    for (int a = 0; a < 3; a++)
        count[1 + a] = (size_t)n[2 - a];
    count[4] = 3;
    return x;
}

/* The entries of the grains in order of id. */
static void *by_id(const struct sim *s, const struct field *field, const int *order,
                   size_t count[5])
{
    const size_t size = kind_size(field->kind);
    char *const x = xalloc((size_t)s->grains.n + 1, size);
    const char *const from = *field->data;
    for (int i = 0; i < s->grains.n; i++)
        memcpy(x + (size_t)i * size, from + (size_t)order[i] * size, size);
    count[1] = (size_t)s->grains.n;
    count[2] = size / sizeof(double);
    return x;
}

void output_file_record(struct output_file *f, const struct sim *s)
{
    const size_t start[5] = {f->n_time, 0, 0, 0, 0};
    output_check(f, nc_put_var1_double(f->nc, f->var_time, start, &s->t));
    if (f->varies)
        record_grains(f, s);
    int *const order = has_grains(s) ? grains_order(&s->grains) : NULL;
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const field = &s->fields.field[i];
        size_t count[5] = {1, 1, 1, 1, 1};
        if (!is_written(s, field) || (field->place == PLACE_GRAIN && s->grains.n == 0))
            continue;
        void *const x =
            field->place == PLACE_GRAIN ? by_id(s, field, order, count) : pack(s, field, count);
        output_check(f, field->kind == KIND_INT
                            ? nc_put_vara_int(f->nc, f->var_field[i], start, count, x)
                            : nc_put_vara_double(f->nc, f->var_field[i], start, count, x));
        xfree(x);
    }
    xfree(order);
    output_walls_record(f, s);
    f->n_time++;
    output_check(f, nc_sync(f->nc));
}

void output_file_close(struct output_file *f)
{
    output_check(f, nc_close(f->nc));
    if (rename(f->part, f->path) != 0)
        die(EXIT_WRITE, "%s: cannot be renamed: %s", f->part, strerror(errno));
    xfree(f->path);
    xfree(f->part);
    xfree(f->var_field);
    xfree(f->var_series);
    xfree(f->count);
    *f = (struct output_file){.nc = -1};
}
