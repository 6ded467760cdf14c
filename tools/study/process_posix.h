/* process_posix.h - what POSIX leaves to others: the end of a process with what it used, by
 * wait4(2), and an alarm that comes back. */
#ifndef PROCESS_POSIX_H
#define PROCESS_POSIX_H

#include <stdbool.h>
#include <sys/types.h>

struct process_end {
    int code, signal;
    double core, memory; /* s, user and system; bytes */
};

bool process_wait(pid_t child, struct process_end *end); /* false: a signal came first */
void process_alarm(bool on);                             /* SIGALRM every quarter of a second */

#endif
