/* verify/test_distance_field.c - distance fields of meshes, voxels and files; nets of their surface. */
#include <gsl/gsl_rng.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "../solver/base.h"
#include "../solver/distance_field.h"
#include "ball_mesh.h"
#include "check.h"

static gsl_rng *rng;

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * gsl_rng_uniform(rng);
}

/* The twelve triangles of a box. */
static vec3 *box(vec3 half, int *n)
{
    vec3 *const c = xalloc(36, sizeof *c);
    *n = 0;
    for (int a = 0; a < 3; a++)
        for (int s = -1; s <= 1; s += 2) {
            vec3 p[4];
            for (int k = 0; k < 4; k++) {
                double x[3];
                x[a] = s;
                x[(a + 1) % 3] = k == 1 || k == 2 ? 1 : -1;
                x[(a + 2) % 3] = k >= 2 ? 1 : -1;
                p[k] = v3(x[0] * half.x, x[1] * half.y, x[2] * half.z);
            }
            const vec3 two[6] = {p[0], p[1], p[2], p[0], p[2], p[3]};
            memcpy(c + 3 * *n, two, sizeof two);
            *n += 2;
        }
    return c;
}

static double net_volume(const struct surface_net *s)
{
    double v = 0;
    for (int t = 0; t < s->n_triangles; t++) {
        const int *const k = s->triangle[t];
        v += v3_dot(s->at[k[0]], v3_cross(s->at[k[1]], s->at[k[2]])) / 6;
    }
    return v;
}

/* Every edge is met as often in one sense as in the other. */
static bool net_closed(const struct surface_net *s)
{
    vec3 sum = v3(0, 0, 0);
    for (int t = 0; t < s->n_triangles; t++) {
        const int *const k = s->triangle[t];
        sum = v3_add(
            sum, v3_cross(v3_sub(s->at[k[1]], s->at[k[0]]), v3_sub(s->at[k[2]], s->at[k[0]])));
    }
    int *const edge = xalloc((size_t)(3 * s->n_triangles), sizeof *edge),
               n = 3 * s->n_triangles;
    bool closed = v3_norm(sum) < 1e-10;
    for (int e = 0; e < n && closed; e++) { /* a few thousand edges: each against all */
        const int a = s->triangle[e / 3][e % 3], b = s->triangle[e / 3][(e + 1) % 3];
        int balance = 0;
        for (int f = 0; f < n; f++) {
            const int c = s->triangle[f / 3][f % 3], d = s->triangle[f / 3][(f + 1) % 3];
            balance += (a == c && b == d) - (a == d && b == c);
        }
        closed = balance == 0;
    }
    xfree(edge);
    return closed;
}

static void test_ball(void)
{
    int n;
    char *why = NULL;
    vec3 *const c = ball_mesh(40, &n);
    struct distance_field *const f = distance_of_triangles(c, n, 33, &why);
    double near = 0, far = 0, slope = 0;
    for (int k = 0; k < 4000; k++) {
        const vec3 x = v3(uniform(-1.2, 1.2), uniform(-1.2, 1.2), uniform(-1.2, 1.2));
        const double want = v3_norm(x) - 1;
        vec3 g;
        const double off = fabs(distance_slope(f, x, &g) - want);
        if (fabs(want) < 0.1) {
            near = fmax(near, off);
            slope = fmax(slope, v3_norm(v3_axpy(g, -1 / v3_norm(x), x)));
        } else if (v3_norm(x) > 0.3) {
            far = fmax(far, off);
        }
    }
    check(near < 2e-3, "a ball of 33 nodes across: distances next to its surface to %.1e radii",
          near);
    check(slope < 0.06, "their gradients to %.1e", slope);
    check(far < 0.05, "distances farther away to %.1e", far);
    struct surface_net *const s = surface_net(f, 0.15);
    double off = 0, area = 0, aslant = 0;
    for (int k = 0; k < s->n; k++) {
        off = fmax(off, fabs(v3_norm(s->at[k]) - 1));
        area += s->area[k];
        aslant = fmax(aslant,
                      v3_norm(v3_sub(s->normal[k], v3_scale(1 / v3_norm(s->at[k]), s->at[k]))));
    }
    check(off < 2e-3, "corners of its net (%d) to %.1e on the surface", s->n, off);
    check(aslant < 0.06, "their normals to %.1e", aslant);
    check(net_closed(s), "the net is closed");
    check_rel(net_volume(s), 4 * PI / 3, 2e-2, "its volume, outward");
    check_rel(area, 4 * PI, 1e-2, "areas of its corners");
    surface_net_free(s);
    distance_free(f);
    check(distance_of_triangles(c, n - 100, 33, &why) == NULL && why, "a ball with holes: %s",
          why);
    xfree(why);
    xfree(c);
}

static void test_box(void)
{
    int n;
    char *why = NULL;
    vec3 *const c = box(v3(1, 0.6, 0.3), &n);
    struct distance_field *const f = distance_of_triangles(c, n, 41, &why);
    double off = 0;
    for (int k = 0; k < 4000; k++) {
        const vec3 x = v3(uniform(-1.1, 1.1), uniform(-0.7, 0.7), uniform(-0.4, 0.4));
        const vec3 q = v3(fabs(x.x) - 1, fabs(x.y) - 0.6, fabs(x.z) - 0.3);
        const vec3 out = v3(fmax(q.x, 0), fmax(q.y, 0), fmax(q.z, 0));
        const double want = v3_norm(out) + fmin(0, fmax(q.x, fmax(q.y, q.z)));
        off = fmax(off, fabs(distance_at(f, x) - want));
    }
    /* trilinear across an edge: up to 0.2 spacings per direction */
    check(off < 0.05, "a box: distances to %.1e, a spacing is 0.05", off);
    const double beyond = distance_at(f, v3(5, 0, 0));
    check(beyond > 3.5 && beyond <= 4, "far beyond its grid at most the distance: %g of 4",
          beyond);
    struct surface_net *const s = surface_net(f, 0.1);
    check(net_closed(s), "its net is closed");
    check_rel(net_volume(s), 8 * 0.18, 5e-2, "and has its volume");
    surface_net_free(s);
    distance_free(f);
    xfree(c);
}

static unsigned char *voxels(int n)
{
    unsigned char *const solid = xalloc((size_t)(n * n * n), 1);
    for (int c = 0; c < n * n * n; c++) {
        const vec3 x =
            v3(c % n + 0.5 - n / 2.0, c / n % n + 0.5 - n / 2.0, c / n / n + 0.5 - n / 2.0);
        solid[c] = v3_norm(x) < 0.45 * n;
    }
    return solid;
}

static void test_voxels(void)
{
    double last = 1;
    for (int n = 16; n <= 64; n *= 2) {
        unsigned char *const solid = voxels(n);
        const int size[3] = {n, n, n};
        struct distance_field *const f = distance_of_voxels(solid, size, 1.0 / n, 1.5);
        double sum = 0;
        enum { POINTS = 2000 };
        for (int k = 0; k < POINTS; k++) {
            vec3 x = v3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            x = v3_scale(0.45 / v3_norm(x), x);
            const double d = distance_at(f, v3_add(x, v3(0.5, 0.5, 0.5)));
            sum += d * d;
        }
        const double rms = sqrt(sum / POINTS);
        check(rms < 0.35 / n && rms < 0.7 * last,
              "a ball of %d voxels: its surface to %.1e edges", n, rms * n);
        last = rms;
        distance_free(f);
        xfree(solid);
    }
}

static void write_file(const char *path, const char *name, int n, const unsigned char *solid)
{
    int nc, dim[3], var;
    const double spacing = 0.01;
    nc_create(path, NC_NETCDF4 | NC_CLOBBER, &nc);
    nc_def_dim(nc, "z", (size_t)n, &dim[0]);
    nc_def_dim(nc, "y", (size_t)n, &dim[1]);
    nc_def_dim(nc, "x", (size_t)n, &dim[2]);
    nc_def_var(nc, name, NC_UBYTE, 3, dim, &var);
    nc_put_att_double(nc, var, "spacing", NC_DOUBLE, 1, &spacing);
    nc_enddef(nc);
    nc_put_var_uchar(nc, var, solid);
    nc_close(nc);
}

static void test_file(void)
{
    char path[] = "/tmp/silt-voxels-XXXXXX", *why;
    unsigned char *const solid = voxels(20);
    close(mkstemp(path));
    write_file(path, "solid", 20, solid);
    struct distance_field *f = distance_read(path, 1.0, &why);
    check(f && fabs(distance_at(f, v3(0.14, 0.1, 0.1)) + 0.05) < 0.01,
          "voxels from a file, their edge its attribute: %.4f m inside",
          f ? -distance_at(f, v3(0.14, 0.1, 0.1)) : 0);
    distance_free(f);
    write_file(path, "distance", 20, solid);
    f = distance_read(path, 1.0, &why);
    check(!f && why && strstr(why, "inside"), "no distance: %s", why ? why : "");
    xfree(why);
    write_file(path, "what", 20, solid);
    f = distance_read(path, 1.0, &why);
    check(!f && why, "no variable: %s", why ? why : "");
    xfree(why);
    unlink(path);
    f = distance_read(path, 1.0, &why);
    check(!f && why, "no file: %s", why ? why : "");
    xfree(why);
    xfree(solid);
}

int main(void)
{
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    test_ball();
    test_box();
    test_voxels();
    test_file();
    gsl_rng_free(rng);
    return check_end();
}
