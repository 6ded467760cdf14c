/* pareto.c - what is not beaten; medians; Richardson's estimate [Richardson11]. */
#include <stdlib.h>
#include <string.h>
#include "study.h"

void pareto_front(int n, const int *group, const double *cost, const double *error, bool *front)
{
    for (int i = 0; i < n; i++) {
        front[i] = isfinite(cost[i]) && isfinite(error[i]);
        for (int k = 0; k < n && front[i]; k++)
            if (k != i && (!group || group[k] == group[i]) && isfinite(cost[k]) &&
                isfinite(error[k]) && cost[k] <= cost[i] && error[k] <= error[i] &&
                (cost[k] < cost[i] || error[k] < error[i] || k < i)) /* of equals the first */
                front[i] = false;
    }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double median(const double *x, int n)
{
    if (n == 0)
        return (double)NAN;
    double *const sorted = xalloc((size_t)n, sizeof *sorted);
    memcpy(sorted, x, (size_t)n * sizeof *sorted);
    qsort(sorted, (size_t)n, sizeof *sorted, by_size);
    const double m = 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
    xfree(sorted);
    return m;
}

/* (h0^p - h1^p)/(h1^p - h2^p): the ratio of differences that order p gives */
static double ratio_of(const double h[3], double p)
{
    return (pow(h[0], p) - pow(h[1], p)) / (pow(h[1], p) - pow(h[2], p));
}

double richardson(const double h[3], const double f[3], double *order, double *doubt)
{
    const double low = 0.3, high = 6.0;
    const double ratio = (f[0] - f[1]) / (f[1] - f[2]);
    double a = low, b = high, limit = f[2];
    *order = (double)NAN;
    *doubt = fabs(f[1] - f[2]);
    if (isfinite(ratio) && ratio > ratio_of(h, low) && ratio < ratio_of(h, high)) {
        for (int i = 0; i < 60; i++) {
            const double p = 0.5 * (a + b);
            if (ratio_of(h, p) < ratio)
                a = p;
            else
                b = p;
        }
        *order = 0.5 * (a + b);
        const double c = (f[1] - f[2]) / (pow(h[1], *order) - pow(h[2], *order));
        limit = f[2] - c * pow(h[2], *order);
        *doubt = fabs(limit - f[2]);
    }
    return limit;
}
