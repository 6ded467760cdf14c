/* verify/ball_mesh.h - a ball of triangles, for tests to turn into other closed bodies. */
#ifndef BALL_MESH_H
#define BALL_MESH_H

#include "../solver/base.h"

/* The octahedron drawn out to the unit ball: n = 8 N^2 triangles, three corners each, counter-clockwise from
 * outside. Free with xfree. */
static inline vec3 *ball_mesh(int N, int *n)
{
    vec3 *const c = xalloc((size_t)(24 * N * N), sizeof *c);
    *n = 0;
    for (int o = 0; o < 8; o++)
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N - i; j++) {
                const bool in =
                    ((o ^ o >> 1 ^ o >> 2) & 1) != 0; /* mirrored an odd number of times */
                vec3 p[4];
                for (int k = 0; k < 4; k++) {
                    const int u = i + (k == 1 || k == 3), v = j + (k == 2 || k == 3);
                    p[k] = v3((o & 1 ? -1 : 1) * u, (o & 2 ? -1 : 1) * v,
                              (o & 4 ? -1 : 1) * (N - u - v));
                    p[k] = v3_scale(1 / v3_norm(p[k]), p[k]);
                }
                for (int t = 0; t < (i + j + 2 <= N ? 2 : 1); t++) {
                    vec3 *const at = c + 3 * (*n)++;
                    at[0] = p[t ? 3 : 0];
                    at[1] = p[in == !t ? 2 : 1];
                    at[2] = p[in == !t ? 1 : 2];
                }
            }
    return c;
}

#endif
