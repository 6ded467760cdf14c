/* timers.h - where the time goes: one clock per verb of the step. */
#ifndef TIMERS_H
#define TIMERS_H

enum timer {
    TIME_SENSE,
    TIME_FLUID,
    TIME_LOAD,
    TIME_MOTION,
    TIME_NEIGHBOURS,
    TIME_CONTACTS,
    TIME_GATHER,
    TIME_LEDGER,
    TIME_OUTPUT,
    TIMERS
};

struct timers {
    double seconds[TIMERS];
};

extern const char *const timer_name[TIMERS];

/* Adds the time since `since` (wall_clock) to a timer; returns now. */
double timer_add(struct timers *t, enum timer which, double since);

#endif
