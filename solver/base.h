/* base.h - what every file needs: memory, the end of a bad run, clocks, reproducible sums.
 *
 * Memory: all of it through xalloc, which is checked, zeroed and aligned to 64 bytes; who
 * creates frees (xfree). A failed allocation ends the program (exit 4).
 *
 * Threads: every sum over many terms goes over blocks of a fixed size, in order, so that its
 * bits do not depend on the number of threads. */
#ifndef BASE_H
#define BASE_H

#include <stddef.h>
#include "vec3.h"

/* Exit codes of the program. */
enum {
    EXIT_GOOD = 0,
    EXIT_SCENE = 2,    /* bad scene or usage */
    EXIT_UNSTABLE = 3, /* unstable or unphysical state */
    EXIT_WRITE = 4     /* could not write, or no memory */
};

enum { SUM_BLOCK = 1024 }; /* terms per block of a reproducible sum */

/* Prints the message on stderr, prefixed by "silt: ", and exits with the code. A `die_hook`, if
 * set, runs first (the run writes its last state there). */
_Noreturn void die(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));
extern void (*die_hook)(int code, const char *message);

/* At the start of the program: what is large goes back to the system when it is freed. Else the C
 * library, once a large block was freed, takes blocks of up to that size from a heap that is left with
 * holes (a tenth of the memory of a run of 100,000 grains). */
void memory_open(void);

void *xalloc(size_t count, size_t size);                                /* zeroed; never NULL */
void *xrealloc(void *old, size_t old_count, size_t count, size_t size); /* new part zeroed */
void xfree(void *p);
char *xstrdup(const char *text); /* free with xfree */
char *xprintf(const char *format, ...) __attribute__((format(printf, 1, 2))); /* xfree */

/* x, where it is more than the most so far; not a number is more than any, and stays. */
static inline double larger(double most, double x)
{
    return x <= most || most != most ? most : x;
}

/* In rising order; for few. */
void sort_few(int *x, int n);

double wall_clock(void); /* s, monotonic */

/* Sum of x[0..n-1], the same bits for any number of threads. */
double sum_blocks(const double *x, size_t n);
double dot_blocks(const double *x, const double *y, size_t n);
double max_abs(const double *x, size_t n); /* NaN if any is NaN */

#endif
