/* labels.c - places for labels (labels.h): rings of places around the point, the nearest that is
 * free; where none is, the one that covers least. */
#include "labels.h"

#include <math.h>
#include "../../solver/base.h"

enum { RINGS = 8, WAYS = 12 };

#define STEP 9.0 /* pixels from ring to ring */

static void take(struct labels *l, const double box[4])
{
    if (l->n == l->room) {
        const int room = 2 * l->room + 64;
        l->taken = xrealloc(l->taken, (size_t)l->room, (size_t)room, sizeof *l->taken);
        l->room = room;
    }
    for (int i = 0; i < 4; i++)
        l->taken[l->n][i] = box[i];
    l->n++;
}

/* Pixels of a value on axis 0 or 1. */
static double pixel(const struct labels *l, int axis, double value)
{
    const double part = log(value / l->low[axis]) / log(l->high[axis] / l->low[axis]);
    const double *const f = l->frame + 2 * axis;
    return l->pixels[axis] * (f[0] + part * (f[1] - f[0]));
}

static double overlap(const double a[4], const double b[4])
{
    const double width = fmin(a[1], b[1]) - fmax(a[0], b[0]);
    const double height = fmin(a[3], b[3]) - fmax(a[2], b[2]);
    return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

/* Square pixels of a box that are taken, or out of the axes. */
static double covered(const struct labels *l, const double box[4])
{
    const double frame[4] = {l->pixels[0] * l->frame[0], l->pixels[0] * l->frame[1],
                             l->pixels[1] * l->frame[2], l->pixels[1] * l->frame[3]};
    double sum = (box[1] - box[0]) * (box[3] - box[2]) - overlap(box, frame);
    for (int i = 0; i < l->n; i++)
        sum += overlap(box, l->taken[i]);
    return sum;
}

void labels_point(struct labels *l, double x, double y, double radius)
{
    const double at[2] = {pixel(l, 0, x), pixel(l, 1, y)};
    take(l, (double[4]){at[0] - radius, at[0] + radius, at[1] - radius, at[1] + radius});
}

void labels_bar(struct labels *l, double x0, double x1, double y)
{
    const double up = pixel(l, 1, y);
    take(l, (double[4]){pixel(l, 0, x0), pixel(l, 0, x1), up - 1.0, up + 1.0});
}

void labels_place(struct labels *l, double x, double y, double width, double height,
                  double offset[2])
{
    const double at[2] = {pixel(l, 0, x), pixel(l, 1, y)}, pi = 3.14159265358979323846;
    double best[4] = {0.0}, least = HUGE_VAL;
    for (int ring = 1; ring <= RINGS && least > 0.0; ring++) {
        for (int way = 0; way < WAYS && least > 0.0; way++) {
            /* first right and above, then around by turns to either side */
            const double turn = 2.0 * pi / WAYS * ((way + 1) / 2) * (way % 2 ? 1 : -1);
            const double c = cos(pi / 6.0 + turn), s = sin(pi / 6.0 + turn);
            const double middle = at[0] + STEP * ring * c + 0.5 * width * c;
            const double up = at[1] + STEP * ring * s;
            const double box[4] = {middle - 0.5 * width, middle + 0.5 * width,
                                   up - 0.5 * height, up + 0.5 * height};
            const double now = covered(l, box);
            if (now >= least)
                continue;
            least = now;
            for (int i = 0; i < 4; i++)
                best[i] = box[i];
        }
    }
    take(l, best);
    offset[0] = (best[0] - at[0]) / l->pixels[0];
    offset[1] = (0.5 * (best[2] + best[3]) - at[1]) / l->pixels[1];
}

void labels_free(struct labels *l)
{
    xfree(l->taken);
    l->taken = NULL;
    l->n = l->room = 0;
}
