/* timers.h - where the time goes: one clock per verb of the step. */
#ifndef TIMERS_H
#define TIMERS_H

enum timer {
    TIME_SENSE,
    TIME_FLUID,
    TIME_LOAD,
    TIME_MOTION,
    TIME_SORT,       /* grains in memory, with the search grid */
    TIME_SEARCH,     /* pairs and walls near each other, memory of contacts carried over */
    TIME_NEIGHBOURS, /* the rest of a rebuild: who gathers from where, room */
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
