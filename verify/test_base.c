/* test_base.c - memory, the end of a bad run, reproducible sums. */
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "../solver/base.h"
#include "check.h"

static void test_sums(void)
{
    static double x[5 * SUM_BLOCK + 37], y[5 * SUM_BLOCK + 37];
    const size_t most = sizeof x / sizeof x[0];
    const size_t lengths[] = {0, 1, 7, SUM_BLOCK - 1, SUM_BLOCK, SUM_BLOCK + 1, most};
    unsigned long seed = 12345;
    for (size_t i = 0; i < most; i++) {
        seed = seed * 6364136223846793005UL + 1442695040888963407UL;
        x[i] = (double)(seed >> 11) / 9007199254740992.0 - 0.4;
        y[i] = ldexp(x[most - 1 - i < i ? i / 2 : i], (int)(seed % 60) - 30);
    }
    for (size_t l = 0; l < sizeof lengths / sizeof lengths[0]; l++) {
        const size_t n = lengths[l];
        long double sum = 0.0L, dot = 0.0L, size = 0.0L;
        for (size_t i = 0; i < n; i++) {
            sum += x[i];
            dot += (long double)x[i] * y[i];
            size += fabsl((long double)x[i] * y[i]);
        }
        omp_set_num_threads(1);
        const double one[2] = {sum_blocks(x, n), dot_blocks(x, y, n)};
        check(fabs(one[0] - (double)sum) <= 1e-13 * (double)n, "sum of %zu: %.17g", n, one[0]);
        check(fabsl(one[1] - dot) <= 1e-14L * size, "product of %zu: %.17g", n, one[1]);
        bool same = true;
        for (int threads = 2; threads <= 7; threads++) {
            omp_set_num_threads(threads);
            const double many[2] = {sum_blocks(x, n), dot_blocks(x, y, n)};
            same = same && memcmp(one, many, sizeof one) == 0;
        }
        check(same, "the same bits on 1 to 7 threads, %zu terms", n);
    }
    x[3] = -7.0;
    check(max_abs(x, most) == 7.0, "the largest of the absolute values");
    x[most - 2] = (double)NAN;
    check(isnan(max_abs(x, most)), "the largest of numbers with a NaN is NaN");
    check(max_abs(x, 0) == 0.0, "the largest of none is 0");
}

static void test_memory(void)
{
    bool aligned = true, zero = true;
    for (size_t n = 0; n < 300; n++) {
        char *const p = xalloc(n, 3);
        aligned = aligned && (uintptr_t)p % 64 == 0;
        for (size_t i = 0; i < 3 * n; i++)
            zero = zero && p[i] == 0;
        memset(p, 1, 3 * n);
        xfree(p);
    }
    check(aligned, "memory is aligned to 64 bytes");
    check(zero, "memory is zeroed");
    int *p = xalloc(10, sizeof *p);
    for (int i = 0; i < 10; i++)
        p[i] = i + 1;
    p = xrealloc(p, 10, 1000, sizeof *p);
    bool kept = (uintptr_t)p % 64 == 0;
    for (int i = 0; i < 1000; i++)
        kept = kept && p[i] == (i < 10 ? i + 1 : 0);
    p = xrealloc(p, 1000, 5, sizeof *p);
    check(kept && p[4] == 5,
          "memory that grows and shrinks keeps what it held, zeros after it");
    xfree(p);
    char *const text = xprintf("%s %.3f", "pi", 3.14159);
    check(strcmp(text, "pi 3.142") == 0, "xprintf: %s", text);
    xfree(text);
}

/* A hook that dies itself must not run twice, nor hide the cause. */
static void bad_hook(int code, const char *message)
{
    fprintf(stderr, "hook %d %s\n", code, message);
    die(EXIT_WRITE, "again");
}

static void last_words(void)
{
    die_hook = bad_hook;
    die(EXIT_UNSTABLE, "grain %d", 42);
}

static void out_of_memory(void)
{
    xalloc((size_t)-1 / 2, 16);
}

static void test_end(void (*child)(void), int code, const char *want)
{
    int tube[2], status = -1;
    char said[512];
    if (!check(pipe(tube) == 0, "a pipe"))
        return;
    fflush(stdout);
    if (fork() == 0) {
        dup2(tube[1], STDERR_FILENO);
        close(tube[0]);
        child();
        _exit(99);
    }
    close(tube[1]);
    size_t n = 0;
    for (ssize_t got = 1; got > 0; n += got > 0 ? (size_t)got : 0)
        got = read(tube[0], said + n, sizeof said - 1 - n);
    said[n] = '\0';
    close(tube[0]);
    wait(&status);
    check(WIFEXITED(status) && WEXITSTATUS(status) == code && strcmp(said, want) == 0,
          "exit %d: %s", code, said);
}

int main(void)
{
    char memory[128];
    snprintf(memory, sizeof memory, "silt: out of memory: %zu times 16 bytes\n",
             (size_t)-1 / 2);
    test_end(last_words, EXIT_UNSTABLE, "silt: grain 42\nhook 3 grain 42\nsilt: again\n");
    test_end(out_of_memory, EXIT_WRITE, memory);
    test_memory();
    test_sums();
    return check_end();
}
