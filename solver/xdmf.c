/* xdmf.c - run.xmf: grains as points, cell fields on a uniform mesh, one collection in time
 * each. */
#include "xdmf.h"

#include <stdio.h>
#include <string.h>
#include "output_file.h"

/* Slab t of variable `name` with dimensions (time, dims...). */
static void item(FILE *o, const char *name, size_t t, size_t n_time, int n, const int *dims)
{
    char slab[128] = "", ones[64] = "", size[128] = "", all[128] = "";
    for (int i = 0; i < n; i++) {
        snprintf(slab + strlen(slab), sizeof slab - strlen(slab), " 0");
        snprintf(ones + strlen(ones), sizeof ones - strlen(ones), " 1");
        snprintf(size + strlen(size), sizeof size - strlen(size), " %d", dims[i]);
        snprintf(all + strlen(all), sizeof all - strlen(all), " %d", dims[i]);
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
                      size_t n_time, int n, const int *dims)
{
    fprintf(o, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">\n", field->name,
            field->kind == KIND_VEC3 ? "Vector" : "Scalar", centre);
    item(o, field->name, t, n_time, n, dims);
    fprintf(o, "</Attribute>\n");
}

static void grains(FILE *o, const struct sim *s, size_t t, size_t n_time, double time)
{
    const int dims[2] = {s->grains.n, 3};
    fprintf(o,
            "<Grid Name=\"grains\"><Time Value=\"%.17g\"/>\n"
            "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%d\" "
            "NodesPerElement=\"1\"/>\n"
            "<Geometry GeometryType=\"XYZ\">\n",
            time, s->grains.n);
    item(o, "position", t, n_time, 2, dims);
    fprintf(
        o,
        "</Geometry>\n<Attribute Name=\"radius\" Center=\"Node\"><DataItem Dimensions=\"%d\" "
        "NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">run.nc:/radius</DataItem>"
        "</Attribute>\n",
        s->grains.n);
    for (int i = 0; i < s->fields.n; i++) {
        const struct field *const f = &s->fields.field[i];
        if (f->place == PLACE_GRAIN && f->flags & FIELD_OUTPUT && f->kind != KIND_INT &&
            strcmp(f->name, "position") != 0)
            attribute(o, f, "Node", t, n_time, f->kind == KIND_VEC3 ? 2 : 1, dims);
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
            attribute(o, f, "Cell", t, n_time, 3, dims);
    }
    fprintf(o, "</Grid>\n");
}

void xdmf_write(const struct sim *s, const double *times, size_t n_time)
{
    char *const path = xprintf("%s/run.xmf", s->run.directory);
    FILE *const o = output_text_open(path);
    fprintf(o, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n");
    for (int what = 0; what < 2; what++) {
        if (what == 0 ? s->grains.n == 0 : !s->fluid.exists)
            continue;
        fprintf(o, "<Grid Name=\"%s\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
                what == 0 ? "grains" : "fluid");
        for (size_t t = 0; t < n_time; t++)
            (what == 0 ? grains : cells)(o, s, t, n_time, times[t]);
        fprintf(o, "</Grid>\n");
    }
    fprintf(o, "</Domain></Xdmf>\n");
    output_text_close(o, path);
    xfree(path);
}
