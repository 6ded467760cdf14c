/* extremes.h - where a scene breaks: the parts of tools/extremes.c. */
#ifndef EXTREMES_H
#define EXTREMES_H

#include "study.h"

/* How a point is judged. */
enum verdict {
    POINT_NONE,    /* a named axis does not apply there */
    POINT_RIGHT,   /* ran to its end, within the tolerance of the scene's reference (or of
                      --within); without a reference: its ledger closes */
    POINT_WRONG,   /* ran to its end, beyond the tolerance */
    POINT_REFUSED, /* a message before it started */
    POINT_STOPPED, /* a guard named what was wrong */
    POINT_SLOW,    /* had not ended in its time, but ended properly when asked to */
    POINT_BROKEN,  /* not finite, crash, hang: a defect of silt */
    VERDICTS
};
extern const char *const verdict_name[VERDICTS];

enum { MOST_NAMES = 24, MOST_EDGES = 512 };

struct point {
    struct variant *v;
    enum verdict verdict;
    double error;             /* NaN: none */
    double ratio[MOST_NAMES]; /* step over limit, by limit; NaN: not named by `check` there */
    bool binding[MOST_NAMES]; /* not of accuracy only */
};

/* Between two points of a line the verdict changes. */
struct edge {
    int axis;
    struct variant *left, *right; /* nearest to it on both sides */
    enum verdict before, after;
    double found,
        predicted;     /* value of the axis; predicted NaN: no limit is passed on the line */
    const char *limit; /* that predicts it, or "" */
};

struct extremes {
    struct study study;
    bool no_edges;
    bool standard; /* no axes were given: all that apply */
    double within; /* NaN: the reference's own verdict */
    const char *error_key;
    int n, capacity;
    struct point *point; /* in the order in which they were run */
    int n_names;
    char name[MOST_NAMES][64]; /* of limits */
    bool binds[MOST_NAMES];    /* at some point */
    int n_edges;
    struct edge edge[MOST_EDGES];
    int shown[MOST_AXES]; /* values of each axis that were asked for: the first so many */
    bool grid;            /* two axes, every combination; else each axis alone */
};

/* Runs and judges the variant with these choices; NULL: an axis does not apply, *why tells. The
 * pointer holds until the next call. */
struct point *extremes_point(struct extremes *x, const int *choice, char **why);
struct point *extremes_find(const struct extremes *x, const int *choice); /* or NULL */
char *extremes_inspect(const char *folder); /* what is not finite in a run.nc, or NULL; xfree */
/* The highest ratio of a binding limit; *which its index (or -1). */
double extremes_ratio(const struct extremes *x, const struct point *p, int *which);

/* Looks for edges along an axis, the others as in `choice`, and halves each until 5 %. */
void extremes_edges(struct extremes *x, int axis, const int *choice);

void extremes_write(const struct extremes *x); /* extremes.csv, edges.csv, extremes.nc */
void extremes_draw(const struct extremes *x);  /* extremes.png */

#endif
