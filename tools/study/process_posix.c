/* process_posix.c - see the header. */
#define _GNU_SOURCE
#include "process_posix.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>

static double seconds(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

bool process_wait(pid_t child, struct process_end *end)
{
    struct rusage used;
    int status;
    if (wait4(child, &status, 0, &used) != child)
        return false;
    *end = (struct process_end){.code = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                                .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                                .core = seconds(used.ru_utime) + seconds(used.ru_stime),
                                .memory = 1024.0 * (double)used.ru_maxrss};
    return true;
}

void process_alarm(bool on)
{
    const struct timeval every = {0, on ? 250000 : 0};
    const struct itimerval timer = {every, every};
    setitimer(ITIMER_REAL, &timer, NULL);
}
