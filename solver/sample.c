/* sample.c - linear interpolation on the staggered grid; sums over a plane row by row. */
#include "sample.h"

/* Where x lies among the values of one direction: between lower and lower + 1. `first` is the
 * place of value 1 in cells, n the last value that there is. */
struct between {
    int lower;
    double part;
};

static struct between find(double x, double h, double first, int last)
{
    const double at = x / h - first + 1.0;
    struct between b = {(int)floor(at), 0.0};
    b.lower = b.lower < 0 ? 0 : b.lower > last - 1 ? last - 1 : b.lower;
    b.part = fmin(1.0, fmax(0.0, at - b.lower));
    return b;
}

/* A field of cells (face < 0), or of faces of direction `face`; ghosts filled. */
static double interpolate(const struct sim *s, const double *field, int face, vec3 x)
{
    const struct grid *const g = &s->grid;
    const double at[3] = {x.x, x.y, x.z};
    struct between b[3];
    double sum = 0.0;
    for (int a = 0; a < 3; a++)
        b[a] = find(at[a], g->h[a], a == face ? 0.0 : 0.5, g->n[a] + 1);
    for (int corner = 0; corner < 8; corner++) {
        double weight = 1.0;
        int c = 0;
        for (int a = 0; a < 3; a++) {
            const int up = corner >> a & 1;
            weight *= up ? b[a].part : 1.0 - b[a].part;
            c += (b[a].lower + up) * g->s[a];
        }
        sum += weight * (weight != 0.0 ? field[c] : 0.0);
    }
    return sum;
}

double sample_pressure(const struct sim *s, vec3 x)
{
    return interpolate(s, s->fluid.p, -1, x);
}

double sample_velocity(const struct sim *s, int a, vec3 x)
{
    return interpolate(s, s->fluid.u[a], a, x);
}

double sample_porosity(const struct sim *s, vec3 x)
{
    return s->fluid.eps ? interpolate(s, s->fluid.eps, -1, x) : 1.0;
}

/* Mean of a layer of cells or faces; of faces times the fluid fraction `eps` where it is not NULL. */
static double layer(const struct sim *s, const double *field, const double *eps, int axis,
                    int i)
{
    const struct grid *const g = &s->grid;
    const int b = (axis + 1) % 3, d = (axis + 2) % 3;
    double sum = 0.0;
    for (int k = 1; k <= g->n[d]; k++) {
        double row = 0.0;
        for (int j = 1; j <= g->n[b]; j++) {
            const int c = i * g->s[axis] + j * g->s[b] + k * g->s[d];
            row += eps ? grid_face(eps, c, g->s[axis]) * field[c] : field[c];
        }
        sum += row;
    }
    return sum / ((double)g->n[b] * g->n[d]);
}

static double plane(const struct sim *s, const double *field, const double *eps, int axis,
                    bool face, double at)
{
    const struct grid *const g = &s->grid;
    const struct between b = find(at, g->h[axis], face ? 0.0 : 0.5, g->n[axis] + 1);
    const double low = b.part < 1.0 ? layer(s, field, eps, axis, b.lower) : 0.0;
    const double high = b.part > 0.0 ? layer(s, field, eps, axis, b.lower + 1) : 0.0;
    return (1.0 - b.part) * low + b.part * high;
}

double plane_pressure(const struct sim *s, int axis, double at)
{
    return plane(s, s->fluid.p, NULL, axis, false, at);
}

double plane_flux(const struct sim *s, int axis, double at)
{
    return plane(s, s->fluid.u[axis], s->fluid.eps, axis, true, at);
}

double plane_porosity(const struct sim *s, int axis, double at)
{
    return s->fluid.eps ? plane(s, s->fluid.eps, NULL, axis, false, at) : 1.0;
}
