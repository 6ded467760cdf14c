/* progress.c - the progress line, on stderr. */
#include "progress.h"

#include <stdio.h>
#include <unistd.h>
#include "base.h"

#define BETWEEN      0.2      /* s between updates on a terminal */
#define CLEAR_TO_END "\033[K" /* of the line */

static void show(const struct progress *p, double now, double part, double elapsed)
{
    const double left = part > 0.0 ? elapsed * (1.0 - part) / part : 0.0;
    fprintf(stderr,
            "%s%s %3.0f %%  at %.4g of %.4g  %.3g M grain and cell steps/s  %.0f s left%s",
            p->terminal ? "\r" : "", p->what, 100.0 * part, now, p->end,
            elapsed > 0.0 ? 1e-6 * p->work / elapsed : 0.0, left,
            p->terminal ? CLEAR_TO_END : "\n");
    fflush(stderr);
}

void progress_start(struct progress *p, double begin, double end, const char *what)
{
    const double now = wall_clock();
    *p =
        (struct progress){.what = what, .begin = begin, .end = end, .start = now, .shown = now};
    p->terminal = isatty(STDERR_FILENO) == 1;
    if (!p->terminal)
        fprintf(stderr, "%s   0 %%\n", what);
}

void progress_update(struct progress *p, double now, double work)
{
    const double clock = wall_clock();
    const double part =
        p->end > p->begin ? fmax(0.0, fmin(1.0, (now - p->begin) / (p->end - p->begin))) : 1.0;
    p->work += work;
    if (p->terminal && clock - p->shown >= BETWEEN) {
        p->shown = clock;
        show(p, now, part, clock - p->start);
    } else if (!p->terminal && (int)(10.0 * part) > p->tenth) {
        p->tenth = (int)(10.0 * part);
        show(p, now, part, clock - p->start);
    }
}

void progress_end(struct progress *p)
{
    const double elapsed = wall_clock() - p->start;
    fprintf(stderr, "%s%s done in %.2f s, %.3g M grain and cell steps/s%s\n",
            p->terminal ? "\r" : "", p->what, elapsed,
            elapsed > 0.0 ? 1e-6 * p->work / elapsed : 0.0, p->terminal ? CLEAR_TO_END : "");
}
