/* extremes_judge.c - one point: its run, its verdict, how near its limits it is. */
#include <netcdf.h>
#include <string.h>
#include "extremes.h"

const char *const verdict_name[VERDICTS] = {"none",    "right", "wrong", "refused",
                                            "stopped", "slow",  "broken"};

/* True if a variable of the last output holds something that is not finite. */
static bool not_finite(int nc, int var)
{
    int dims = 0, dim[NC_MAX_VAR_DIMS], time = -1;
    nc_type type = NC_NAT;
    size_t start[NC_MAX_VAR_DIMS] = {0}, count[NC_MAX_VAR_DIMS], n = 1;
    if (nc_inq_dimid(nc, "time", &time) != NC_NOERR ||
        nc_inq_var(nc, var, NULL, &type, &dims, dim, NULL) != NC_NOERR || dims < 2 ||
        dim[0] != time || type != NC_DOUBLE)
        return false;
    for (int i = 0; i < dims; i++) {
        nc_inq_dimlen(nc, dim[i], &count[i]);
        if (i == 0 && count[0] == 0)
            return false;
        if (i == 0) {
            start[0] = count[0] - 1;
            count[0] = 1;
        }
        n *= count[i];
    }
    double *const x = xalloc(n + 1, sizeof *x);
    bool bad = nc_get_vara_double(nc, var, start, count, x) != NC_NOERR;
    for (size_t i = 0; i < n && !bad; i++)
        bad = !isfinite(x[i]);
    xfree(x);
    return bad;
}

char *extremes_inspect(const char *folder)
{
    char *const path = xprintf("%s/run.nc", folder), *wrong = NULL;
    int nc, vars = 0;
    if (nc_open(path, NC_NOWRITE, &nc) != NC_NOERR) {
        wrong = xprintf("its run.nc cannot be read");
    } else {
        nc_inq_nvars(nc, &vars);
        for (int var = 0; var < vars && !wrong; var++) {
            char name[NC_MAX_NAME + 1] = "";
            nc_inq_varname(nc, var, name);
            if (not_finite(nc, var))
                wrong = xprintf("not finite at the end: %s", name);
        }
        nc_close(nc);
    }
    xfree(path);
    return wrong;
}

/* Of a run that ended well. */
static enum verdict judge_result(const struct extremes *x, const struct result *r,
                                 double *error)
{
    const struct summary_entry *const verdict = result_find(r, "verdict"), *const ledger =
                                                                               result_find(
                                                                                   r, "ledger");
    *error = fabs(result_number(r, x->error_key ? x->error_key : "reference_error"));
    if (ledger && strcmp(ledger->text, "closes") != 0)
        return POINT_WRONG;
    if (isfinite(x->within))
        return *error <= x->within ? POINT_RIGHT : POINT_WRONG;
    if (!verdict || strcmp(verdict->text, "none") == 0)
        return POINT_RIGHT;
    return strcmp(verdict->text, "pass") == 0 ? POINT_RIGHT : POINT_WRONG;
}

static void judge(struct extremes *x, struct point *p)
{
    static const enum verdict of[] = {POINT_NONE,    POINT_NONE, POINT_REFUSED,
                                      POINT_STOPPED, POINT_SLOW, POINT_BROKEN};
    p->error = (double)NAN;
    if (p->v->ending == RUN_GOOD)
        p->verdict = judge_result(x, &p->v->result, &p->error);
    else
        p->verdict = of[p->v->ending];
}

/* Index of a limit's name, added where it is new; -1 where there is no room. */
static int name_index(struct extremes *x, const struct limit *l)
{
    for (int i = 0; i < x->n_names; i++)
        if (strcmp(x->name[i], l->name) == 0)
            return i;
    if (x->n_names == MOST_NAMES)
        return -1;
    memcpy(x->name[x->n_names], l->name, sizeof x->name[0]);
    return x->n_names++;
}

static void predict(struct extremes *x, struct point *p)
{
    struct limit l[MOST_LIMITS];
    for (int i = 0; i < MOST_NAMES; i++)
        p->ratio[i] = (double)NAN;
    if (!p->v->binary || p->verdict == POINT_REFUSED)
        return;
    const int n = limits_read(&x->study, p->v->binary, p->v->overrides, p->v->n_overrides, l);
    for (int i = 0; i < n; i++) {
        const int k = name_index(x, &l[i]);
        if (k < 0)
            continue;
        p->ratio[k] = l[i].used / l[i].limit;
        p->binding[k] = l[i].binding;
        x->binds[k] = x->binds[k] || l[i].binding;
    }
}

struct point *extremes_find(const struct extremes *x, const int *choice)
{
    for (int i = 0; i < x->n; i++)
        if (memcmp(x->point[i].v->choice, choice, (size_t)x->study.n_axes * sizeof *choice) ==
            0)
            return &x->point[i];
    return NULL;
}

struct point *extremes_point(struct extremes *x, const int *choice, char **why)
{
    struct point *const old = extremes_find(x, choice);
    *why = NULL;
    if (old)
        return old;
    struct variant *const v = study_variant(&x->study, choice, why);
    if (!v)
        return NULL;
    study_run(&x->study, v);
    if (x->n == x->capacity) {
        const int more = x->capacity ? 2 * x->capacity : 64;
        x->point = xrealloc(x->point, (size_t)x->n, (size_t)more, sizeof *x->point);
        x->capacity = more;
    }
    struct point *const p = &x->point[x->n++];
    p->v = v;
    judge(x, p);
    predict(x, p);
    return p;
}

double extremes_ratio(const struct extremes *x, const struct point *p, int *which)
{
    double most = (double)NAN;
    *which = -1;
    for (int i = 0; i < x->n_names; i++)
        if (p->binding[i] && isfinite(p->ratio[i]) && !(p->ratio[i] <= most)) {
            most = p->ratio[i];
            *which = i;
        }
    return most;
}
