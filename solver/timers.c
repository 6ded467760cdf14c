/* timers.c - where the time goes. */
#include "timers.h"

#include "base.h"

const char *const timer_name[TIMERS] = {"sense",  "fluid",  "load",  "motion",
                                        "sort",   "search", "lists", "contacts",
                                        "gather", "ledger", "output"};

double timer_add(struct timers *t, enum timer which, double since)
{
    const double now = wall_clock();
    t->seconds[which] += now - since;
    return now;
}
