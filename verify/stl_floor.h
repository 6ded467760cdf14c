/* verify/stl_floor.h - STL files for tests: a floor at z = 10 mm cut into triangles in several ways. */
#ifndef STL_FLOOR_H
#define STL_FLOOR_H

#include <stdint.h>
#include <string.h>
#include "../solver/mesh.h"
#include "check.h"
#include "harness.h"

enum { CUT_TWO, CUT_GRID, CUT_FINE, CUT_FAN, CUT_TEE, FLOORS };

static const char *const floor_name[] = {"in two", "in squares of 7 mm",
                                         "finer than the contact", "in a fan under the path",
                                         "with corners amid edges"};

/* Writes an ASCII STL in mm with all digits; returns the section of the scene, xfree it by
 * floor_remove. */
static inline char *stl_wall(const vec3 *c, int n)
{
    char path[] = "/tmp/silt-stl-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const file = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (!file)
        abort();
    fprintf(file, "solid floor\n");
    for (int t = 0; t < n; t++) {
        fprintf(file, "facet normal 0 0 1\nouter loop\n");
        for (int k = 0; k < 3; k++)
            fprintf(file, "vertex %.17g %.17g %.17g\n", 1e3 * c[3 * t + k].x,
                    1e3 * c[3 * t + k].y, 1e3 * c[3 * t + k].z);
        fprintf(file, "endloop\nendfacet\n");
    }
    fprintf(file, "endsolid floor\n");
    fclose(file);
    return xprintf("[wall floor]\nkind = mesh\nfile = %s\nscale = 1 mm\n", path);
}

static inline void floor_remove(char *wall)
{
    char path[64] = "";
    sscanf(strstr(wall, "file = "), "file = %63s", path);
    unlink(path);
    xfree(wall);
}

static inline int cut_grid(vec3 *c, double edge, bool alternate)
{
    int n = 0;
    const int cells = (int)floor(0.056 / edge);
    for (int i = 0; i < cells; i++)
        for (int j = 0; j < cells; j++) {
            const double x = 0.002 + edge * i, y = 0.002 + edge * j;
            const vec3 p = v3(x, y, 0.01), q = v3(x + edge, y, 0.01);
            const vec3 r = v3(x, y + edge, 0.01), s = v3(x + edge, y + edge, 0.01);
            const bool other = alternate && (i + j) % 2;
            const vec3 t[6] = {p, q, other ? s : r, other ? p : q, s, r};
            memcpy(&c[3 * n], t, sizeof t);
            n += 2;
        }
    return n;
}

static inline char *floor_mesh(int how)
{
    vec3 *const c = xalloc(3 * 80000, sizeof *c);
    const vec3 a = v3(0.0, 0.0, 0.01), b = v3(0.06, 0.0, 0.01), p = v3(0.06, 0.06, 0.01),
               q = v3(0.0, 0.06, 0.01);
    int n = 0;
    if (how == CUT_TWO || how == CUT_TEE) {
        const vec3 t[6] = {a, b, q, b, p, q};
        memcpy(c, t, sizeof t);
        n = 2;
    }
    if (how == CUT_TEE) { /* the second one is cut where the first one is not */
        const vec3 m = v3(0.03, 0.03, 0.01), t[6] = {b, p, m, m, p, q};
        memcpy(&c[3], t, sizeof t);
        n = 3;
    }
    if (how == CUT_GRID)
        n = cut_grid(c, 0.007, true);
    if (how == CUT_FINE)
        n = cut_grid(c, 0.00031, true);
    if (how == CUT_FAN) {
        const vec3 m = v3(0.0231, 0.0257, 0.01), rim[5] = {a, b, p, q, a};
        for (int k = 0; k < 4; k++) {
            const vec3 t[3] = {m, rim[k], rim[k + 1]};
            memcpy(&c[3 * n++], t, sizeof t);
        }
    }
    char *const wall = stl_wall(c, n);
    xfree(c);
    return wall;
}

#endif
