/* xdmf.c - run.xmf: grains as points, cell fields on a uniform mesh, walls as triangles, one
 * collection in time each. */
#include "xdmf.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include "output_file.h"
#include "wall_draw.h"

/* Slab t of variable `name` with dimensions (time, dims...), of which the first in the file is
 * `most`. */
static void item(FILE *o, const char *name, size_t t, size_t n_time, int n, const int *dims,
                 int most)
{
    char slab[128] = "", ones[64] = "", size[128] = "", all[128] = "";
    for (int i = 0; i < n; i++) {
        snprintf(slab + strlen(slab), sizeof slab - strlen(slab), " 0");
        snprintf(ones + strlen(ones), sizeof ones - strlen(ones), " 1");
        snprintf(size + strlen(size), sizeof size - strlen(size), " %d", dims[i]);
        snprintf(all + strlen(all), sizeof all - strlen(all), " %d", i == 0 ? most : dims[i]);
    }
    fprintf(
        o,
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"%s\">"
        "<DataItem Dimensions=\"3 %d\" Format=\"XML\">%zu%s 1%s 1%s</DataItem>"
        "<DataItem Dimensions=\"%zu%s\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
        "run.nc:/%s</DataItem></DataItem>\n",
        size + 1, n + 1, t, slab, ones, size, n_time, all, name);
}

static void attribute(FILE *o, const struct field *field, const char *centre, size_t t,
                      size_t n_time, int n, const int *dims, int most)
{
    fprintf(o, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">\n", field->name,
            field->kind == KIND_VEC3   ? "Vector"
            : field->kind == KIND_QUAT ? "Matrix"
                                       : "Scalar",
            centre);
    item(o, field->name, t, n_time, n, dims, most);
    fprintf(o, "</Attribute>\n");
}

/* Grains at output t: n of them, of rows that hold `most`; their radii change with t or not. */
static void grains(FILE *o, const struct sim *s, size_t t, size_t n_time, double time, int n,
                   int most, bool varies)
{
    const int dims[2] = {n, 3}, four[2] = {n, 4};
    fprintf(o,
            "<Grid Name=\"grains\"><Time Value=\"%.17g\"/>\n"
            "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%d\" "
            "NodesPerElement=\"1\"/>\n"
            "<Geometry GeometryType=\"XYZ\">\n",
            time, n);
    item(o, "position", t, n_time, 2, dims, most);
    fprintf(o, "</Geometry>\n<Attribute Name=\"radius\" Center=\"Node\">");
    if (varies)
        item(o, "radius", t, n_time, 1, dims, most);
    else
        fprintf(o,
                "<DataItem Dimensions=\"%d\" "
                "NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">run.nc:/radius</DataItem>",
                n);
    fprintf(o, "</Attribute>\n");
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const f = &s->fields.field[i];
        if (f->place == PLACE_GRAIN && f->flags & FIELD_OUTPUT && f->kind != KIND_INT &&
            strcmp(f->name, "position") != 0)
            attribute(o, f, "Node", t, n_time, f->kind == KIND_REAL ? 1 : 2,
                      f->kind == KIND_QUAT ? four : dims, most);
    }
    fprintf(o, "</Grid>\n");
}

static void cells(FILE *o, const struct sim *s, size_t t, size_t n_time, double time)
{
    const struct grid *const g = &s->grid;
    const int dims[3] = {g->n[2], g->n[1], g->n[0]};
    fprintf(
        o,
        "<Grid Name=\"fluid\"><Time Value=\"%.17g\"/>\n"
        "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"%d %d %d\"/>\n"
        "<Geometry GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Dimensions=\"3\">0 0 0</DataItem>"
        "<DataItem Dimensions=\"3\">%.17g %.17g %.17g</DataItem></Geometry>\n",
        time, g->n[2] + 1, g->n[1] + 1, g->n[0] + 1, g->h[2], g->h[1], g->h[0]);
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const f = &s->fields.field[i];
        if (f->place == PLACE_CELL && f->flags & FIELD_OUTPUT)
            attribute(o, f, "Cell", t, n_time, 3, dims, dims[0]);
    }
    fprintf(o, "</Grid>\n");
}

/* The walls at output t. */
static void surfaces(FILE *o, const struct sim *s, size_t t, size_t n_time, double time)
{
    struct wall_drawing d = walls_draw(s);
    const int dims[2] = {3 * d.n, 3};
    fprintf(o,
            "<Grid Name=\"walls\"><Time Value=\"%.17g\"/>\n"
            "<Topology TopologyType=\"Triangle\" NumberOfElements=\"%d\">"
            "<DataItem Dimensions=\"%d 3\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">"
            "run.nc:/wall_corners</DataItem></Topology>\n<Geometry GeometryType=\"XYZ\">\n",
            time, d.n, d.n);
    if (s->walls.moving)
        item(o, "wall_position", t, n_time, 2, dims, dims[0]);
    else
        fprintf(o,
                "<DataItem Dimensions=\"%d 3\" NumberType=\"Float\" Precision=\"8\" "
                "Format=\"HDF\">run.nc:/wall_position</DataItem>",
                dims[0]);
    fprintf(o,
            "</Geometry>\n<Attribute Name=\"wall\" Center=\"Cell\"><DataItem "
            "Dimensions=\"%d\" NumberType=\"Int\" Precision=\"4\" Format=\"HDF\">"
            "run.nc:/wall_of_triangle</DataItem></Attribute>\n</Grid>\n",
            d.n);
    wall_drawing_free(&d);
}

static int count_triangles(const struct sim *s)
{
    struct wall_drawing d = walls_draw(s);
    const int n = d.n;
    wall_drawing_free(&d);
    return n;
}

void xdmf_write(const struct sim *s, const double *times, size_t n_time, const size_t *count)
{
    int most = s->grains.n;
    for (size_t t = 0; count && t < n_time; t++)
        most = (int)count[t] > most ? (int)count[t] : most;
    char *const path = xprintf("%s/run.xmf", s->run.directory);
    FILE *const o = output_text_open(path);
    fprintf(o, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n");
    static const char *const name[3] = {"grains", "fluid", "walls"};
    const bool there[3] = {most > 0, s->fluid.exists, count_triangles(s) > 0};
    for (int what = 0; what < 3; what++) {
        if (!there[what])
            continue;
        fprintf(o, "<Grid Name=\"%s\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                name[what]);
        for (size_t t = 0; t < n_time; t++) {
            const int n = count ? (int)count[t] : s->grains.n;
            if (what == 1)
                cells(o, s, t, n_time, times[t]);
            else if (what == 2)
                surfaces(o, s, t, n_time, times[t]);
            else if (n > 0)
                grains(o, s, t, n_time, times[t], n, most, count != NULL);
        }
        fprintf(o, "</Grid>\n");
    }
    fprintf(o, "</Domain></Xdmf>\n");
    output_text_close(o, path);
    xfree(path);
}
