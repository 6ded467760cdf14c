/* progress.h - how far, how fast, how long still: one line on a terminal, plain lines to a
 * file. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>

struct progress {
    const char *what;
    double begin, end;   /* s, simulated */
    double start, shown; /* s, wall clock */
    double work;         /* units done: grain steps and cell steps */
    int tenth;           /* last tenth printed to a file */
    bool terminal;
};

void progress_start(struct progress *p, double begin, double end, const char *what);
/* `now` is a time, or, where the end is not known beforehand, any measure between begin and end. */
void progress_update(struct progress *p, double now, double work);
void progress_end(struct progress *p);

#endif
