/* wall_looks.c - several elements of a wall as seen each from its point: into the frame of the wall,
 * its kind's `views`, and back (walls.c does the same for one). */
#include <string.h>
#include "sim.h"

/* Points to where their nearest image lies. `middle`: m, of each element, in the laboratory but for
 * the shift. */
static void nearest(const struct domain *d, struct wall_looks *l, double (*middle)[WALL_LOOKS])
{
    const double lx = d->image[0], ly = d->image[1], lz = d->image[2];
    const double ix = d->inv_image[0], iy = d->inv_image[1], iz = d->inv_image[2];
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        l->x[c] -= lx * rint((l->x[c] - middle[0][c]) * ix);
        l->y[c] -= ly * rint((l->y[c] - middle[1][c]) * iy);
        l->z[c] -= lz * rint((l->z[c] - middle[2][c]) * iz);
    }
}

/* The middles of the elements, m; `point`: these, or NULL. */
static void middles(const struct wall *w, const struct wall_looks *l,
                    const double (*point)[WALL_LOOKS], double (*middle)[WALL_LOOKS])
{
    const vec3 pivot = w->motion.pivot;
    for (int c = 0; c < l->n; c++) {
        vec3 m = w->middle;
        if (w->kind->middle)
            m = point ? v3(point[0][c], point[1][c], point[2][c])
                      : w->kind->middle(w->shape, l->element[c]);
        if (w->pose.turned)
            m = v3_add(pivot, pose_turn(&w->pose, v3_sub(m, pivot)));
        middle[0][c] = m.x;
        middle[1][c] = m.y;
        middle[2][c] = m.z;
    }
}

/* R or its transpose times each of n vectors. */
static void turn(const double (*r)[3], bool back, int n, double *restrict x, double *restrict y,
                 double *restrict z)
{
    double m[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = back ? r[j][i] : r[i][j];
#pragma omp simd
    for (int c = 0; c < n; c++) {
        const double a = x[c], b = y[c], d = z[c];
        x[c] = m[0][0] * a + m[0][1] * b + m[0][2] * d;
        y[c] = m[1][0] * a + m[1][1] * b + m[1][2] * d;
        z[c] = m[2][0] * a + m[2][1] * b + m[2][2] * d;
    }
}

static void shift(int n, vec3 by, double *restrict x, double *restrict y, double *restrict z)
{
#pragma omp simd
    for (int c = 0; c < n; c++) {
        x[c] += by.x;
        y[c] += by.y;
        z[c] += by.z;
    }
}

static void by_one(const struct wall *w, struct wall_looks *l)
{
    for (int c = 0; c < l->n; c++) {
        const vec3 x = v3(l->x[c], l->y[c], l->z[c]);
        struct wall_view view;
        w->kind->view(w->shape, l->element[c], &x, &view);
        l->ax[c] = view.away.x;
        l->ay[c] = view.away.y;
        l->az[c] = view.away.z;
        l->curvature[c] = view.curvature;
        l->part[c] = view.part;
    }
}

static void come_in(const struct sim *s, const struct wall *w, struct wall_looks *l,
                    const double (*point)[WALL_LOOKS])
{
    const struct wall_pose *const p = &w->pose;
    const vec3 pivot = w->motion.pivot;
    if (p->moved)
        shift(l->n, v3_scale(-1.0, p->shift), l->x, l->y, l->z);
    if (s->walls.periodic) {
        double middle[3][WALL_LOOKS];
        middles(w, l, point, middle);
        nearest(&s->domain, l, middle);
    }
    if (p->turned) {
        shift(l->n, v3_scale(-1.0, pivot), l->x, l->y, l->z);
        turn(p->turn, true, l->n, l->x, l->y, l->z);
        shift(l->n, pivot, l->x, l->y, l->z);
    }
}

static void go_out(const struct wall *w, struct wall_looks *l, double (*arm)[WALL_LOOKS])
{
    const struct wall_pose *const p = &w->pose;
    const vec3 pivot = w->motion.pivot;
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        arm[0][c] = l->x[c] - pivot.x;
        arm[1][c] = l->y[c] - pivot.y;
        arm[2][c] = l->z[c] - pivot.z;
    }
    if (p->turned) {
        turn(p->turn, false, l->n, l->ax, l->ay, l->az);
        turn(p->turn, false, l->n, arm[0], arm[1], arm[2]);
    }
}

void walls_look(const struct sim *s, const struct wall *w, struct wall_looks *l,
                double (*arm)[WALL_LOOKS])
{
    come_in(s, w, l, NULL);
    memset(l->hollow, 0, sizeof l->hollow);
    if (w->kind->views)
        w->kind->views(w->shape, l);
    else
        by_one(w, l);
    go_out(w, l, arm);
}

void walls_look_flat(const struct sim *s, const struct wall *w,
                     const double (*plane)[WALL_LOOKS], struct wall_looks *l,
                     double (*arm)[WALL_LOOKS])
{
    come_in(s, w, l, plane);
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->x[c] - plane[0][c], y = l->y[c] - plane[1][c];
        const double z = l->z[c] - plane[2][c];
        const double nx = plane[3][c], ny = plane[4][c], nz = plane[5][c];
        const double h = x * nx + y * ny + z * nz;
        l->ax[c] = h * nx;
        l->ay[c] = h * ny;
        l->az[c] = h * nz;
        l->curvature[c] = 0.0;
    }
    go_out(w, l, arm);
}
