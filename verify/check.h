/* verify/check.h - checks in the manner of gsl_test: one line each, a count at the end.
 * A test program is a main that calls these and returns check_end(). */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

#define PI 3.14159265358979323846

static int check_passed, check_failed;
static bool check_quiet; /* what is good is not printed: for programs that are no tests */

__attribute__((format(printf, 2, 3))) static bool check(bool good, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    if (!good || !check_quiet) {
        printf("%s ", good ? "ok  " : "FAIL");
        vprintf(format, args);
        putchar('\n');
    }
    va_end(args);
    if (good)
        check_passed++;
    else
        check_failed++;
    return good;
}

/* |got - want| <= tolerance |want| */
static inline bool check_rel(double got, double want, double tolerance, const char *text)
{
    return check(fabs(got - want) <= tolerance * fabs(want), "%s: %.10g, want %.10g within %g",
                 text, got, want, tolerance);
}

static inline bool check_abs(double got, double want, double tolerance, const char *text)
{
    return check(fabs(got - want) <= tolerance, "%s: %.10g, want %.10g +- %g", text, got, want,
                 tolerance);
}

static inline int check_end(void)
{
    printf("%d passed, %d failed\n", check_passed, check_failed);
    return check_failed != 0;
}

#endif
