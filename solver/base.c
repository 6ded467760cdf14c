/* base.c - memory, the end of a bad run, clocks, reproducible sums. */
#define _DEFAULT_SOURCE /* madvise */
#include "base.h"

#include <malloc.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

void (*die_hook)(int code, const char *message);

_Noreturn void die(int code, const char *format, ...)
{
    static char message[2048]; /* the hook may run when memory is short */
    static int first;          /* the cause, where the hook dies too */
    first = first ? first : code;
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    fflush(stdout);
    fprintf(stderr, "silt: %s\n", message);
    void (*const hook)(int, const char *) = die_hook;
    die_hook = NULL; /* a hook that dies must not call itself */
    if (hook)
        hook(code, message);
    exit(first);
}

/* Large arrays lie on huge pages where the system has them: what reads at random in an array of many
 * small pages waits for their addresses. */
enum { LINE = 64, HUGE_PAGE = 1 << 21 };

void memory_open(void)
{
#ifdef M_MMAP_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

void *xalloc(size_t count, size_t size)
{
    if (size > 0 && count > ((size_t)-1 - LINE) / size)
        die(EXIT_WRITE, "out of memory: %zu times %zu bytes", count, size);
    const size_t bytes = (count * size + LINE) / LINE * LINE;
    const bool huge = bytes >= 2 * (size_t)HUGE_PAGE;
    void *p = NULL;
    if (posix_memalign(&p, huge ? HUGE_PAGE : LINE, bytes) != 0)
        die(EXIT_WRITE, "out of memory: %zu bytes", bytes);
#ifdef MADV_HUGEPAGE
    if (huge)
        madvise(p, bytes, MADV_HUGEPAGE); /* advice: nothing is lost where it is not taken */
#endif
    memset(p, 0, bytes);
    return p;
}

void *xrealloc(void *old, size_t old_count, size_t count, size_t size)
{
    void *const p = xalloc(count, size);
    if (old)
        memcpy(p, old, (old_count < count ? old_count : count) * size);
    free(old);
    return p;
}

void xfree(void *p)
{
    free(p);
}

char *xstrdup(const char *text)
{
    const size_t n = strlen(text) + 1;
    return memcpy(xalloc(n, 1), text, n);
}

char *xprintf(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *const text = xalloc((size_t)n + 1, 1);
    va_start(args, format);
    vsnprintf(text, (size_t)n + 1, format, args);
    va_end(args);
    return text;
}

void sort_few(int *x, int n)
{
    for (int i = 1; i < n; i++) {
        const int v = x[i];
        int j = i;
        for (; j > 0 && x[j - 1] > v; j--)
            x[j] = x[j - 1];
        x[j] = v;
    }
}

double wall_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Sum over i of x[i] y[i] (y NULL: of x[i]): each block by one thread, the blocks in order. */
static double sum_products(const double *x, const double *y, size_t n)
{
    const size_t blocks = (n + SUM_BLOCK - 1) / SUM_BLOCK;
    double local[256], *const part = blocks <= 256 ? local : xalloc(blocks, sizeof *part);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        const size_t end = (b + 1) * SUM_BLOCK < n ? (b + 1) * SUM_BLOCK : n;
        double lane[8] = {0}; /* eight sums, added in order: the compiler may vectorise them */
        size_t i = b * SUM_BLOCK;
        for (; i + 8 <= end; i += 8)
            for (size_t k = 0; k < 8; k++)
                lane[k] += y ? x[i + k] * y[i + k] : x[i + k];
        double sum = 0.0;
        for (size_t k = 0; k < 8; k++)
            sum += lane[k];
        for (; i < end; i++)
            sum += y ? x[i] * y[i] : x[i];
        part[b] = sum;
    }
    double sum = 0.0;
    for (size_t b = 0; b < blocks; b++)
        sum += part[b];
    if (part != local)
        xfree(part);
    return sum;
}

double sum_blocks(const double *x, size_t n)
{
    return sum_products(x, NULL, n);
}

double dot_blocks(const double *x, const double *y, size_t n)
{
    return sum_products(x, y, n);
}

double max_abs(const double *x, size_t n)
{
    double most = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double a = fabs(x[i]);
        if (!(a <= most)) { /* larger, or not a number */
            most = a;
            if (isnan(a))
                break;
        }
    }
    return most;
}
