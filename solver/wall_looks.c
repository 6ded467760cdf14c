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

/* Points to their images; arms from the pivot. */
static void come_near(const struct sim *s, const struct wall *w, struct wall_looks *l,
                      const double (*point)[WALL_LOOKS], double (*arm)[WALL_LOOKS])
{
    const vec3 pivot = w->motion.pivot;
    if (w->pose.moved)
        shift(l->n, v3_scale(-1.0, w->pose.shift), l->x, l->y, l->z);
    if (s->walls.periodic) {
        double middle[3][WALL_LOOKS];
        middles(w, l, point, middle);
        nearest(&s->domain, l, middle);
    }
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        arm[0][c] = l->x[c] - pivot.x;
        arm[1][c] = l->y[c] - pivot.y;
        arm[2][c] = l->z[c] - pivot.z;
    }
}

void walls_look(const struct sim *s, const struct wall *w, struct wall_looks *l,
                double (*arm)[WALL_LOOKS])
{
    const struct wall_pose *const p = &w->pose;
    const vec3 pivot = w->motion.pivot;
    come_near(s, w, l, NULL, arm);
    if (p->turned) {
        shift(l->n, v3_scale(-1.0, pivot), l->x, l->y, l->z);
        turn(p->turn, true, l->n, l->x, l->y, l->z);
        shift(l->n, pivot, l->x, l->y, l->z);
    }
    memset(l->hollow, 0, sizeof l->hollow);
    if (w->kind->views)
        w->kind->views(w->shape, l);
    else
        by_one(w, l);
    if (p->turned)
        turn(p->turn, false, l->n, l->ax, l->ay, l->az);
}

/* Above planes through `from` with these normals. */
static void stand(struct wall_looks *l, const double (*from)[WALL_LOOKS],
                  const double (*normal)[WALL_LOOKS])
{
#pragma omp simd
    for (int c = 0; c < l->n; c++) {
        const double x = l->x[c] - from[0][c], y = l->y[c] - from[1][c];
        const double z = l->z[c] - from[2][c];
        const double nx = normal[0][c], ny = normal[1][c], nz = normal[2][c];
        const double h = x * nx + y * ny + z * nz;
        l->ax[c] = h * nx;
        l->ay[c] = h * ny;
        l->az[c] = h * nz;
        l->curvature[c] = 0.0;
    }
}

void walls_look_flat(const struct sim *s, const struct wall *w,
                     const double (*plane)[WALL_LOOKS], struct wall_looks *l,
                     double (*arm)[WALL_LOOKS])
{
    const struct wall_pose *const p = &w->pose;
    const vec3 pivot = w->motion.pivot;
    come_near(s, w, l, plane, arm);
    if (!p->turned) {
        stand(l, plane, plane + 3);
        return;
    }
    double turned[6][WALL_LOOKS]; /* the planes as they are now */
    memcpy(turned, plane, sizeof turned);
    shift(l->n, v3_scale(-1.0, pivot), turned[0], turned[1], turned[2]);
    turn(p->turn, false, l->n, turned[0], turned[1], turned[2]);
    shift(l->n, pivot, turned[0], turned[1], turned[2]);
    turn(p->turn, false, l->n, turned[3], turned[4], turned[5]);
    stand(l, (const double(*)[WALL_LOOKS])turned, (const double(*)[WALL_LOOKS])turned + 3);
}
