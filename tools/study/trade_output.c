/* trade_output.c - trade.csv and trade.nc: every variant with its axes, error, cost, spread, end
 * and the command that repeats it. */
#include <errno.h>
#include <netcdf.h>
#include <string.h>
#include "study_nc.h"
#include "trade.h"

const char *trade_cost_unit(const struct trade *t)
{
    return t->by == BY_MEMORY ? "MiB"
           : t->by == BY_CORE ? "core s per simulated s"
                              : "s per simulated s";
}

static void write_csv(const struct trade *t)
{
    const struct study *const s = &t->study;
    char *const path = study_path(s, "trade.csv"), *const part = xprintf("%s.part", path);
    FILE *const to = fopen(part, "w");
    if (!to)
        die(EXIT_WRITE, "%s: %s", part, strerror(errno));
    fprintf(to, "number");
    for (int a = 0; a < s->n_axes; a++) {
        fputc(',', to);
        csv_field(to, s->axis[a].name);
    }
    for (int q = 0; q < t->n_quantities; q++)
        fprintf(to, ",%s", t->quantity[q]);
    fprintf(to,
            ",error,scatter,cost,cost_least,cost_most,cost_of,core_per_simulated,wall,memory,"
            "runs,front,recommended,end,reason,command\n");
    for (int i = 0; i < s->n; i++) {
        const struct variant *const v = s->variant[i];
        fprintf(to, "%d", v->number);
        for (int a = 0; a < s->n_axes; a++) {
            fputc(',', to);
            csv_field(to, v->choice[a] < 0 ? "" : s->axis[a].value[v->choice[a]]);
        }
        for (int q = 0; q < t->n_quantities; q++)
            fprintf(to, ",%.10g", t->value[i * t->n_quantities + q]);
        fprintf(to, ",%.10g,%.3g,%.6g,%.6g,%.6g,%s,%.6g,%.6g,%.0f,%d,%d,%d,%s,", t->error[i],
                t->scatter[i], t->cost[i], t->low[i], t->high[i], trade_cost_unit(t),
                t->core[i], t->wall[i], t->memory[i], v->n_runs, t->front[i],
                t->best[trade_group(t, v->choice)] == i, ending_name[v->ending]);
        csv_field(to, v->reason);
        fputc(',', to);
        csv_field(to, v->command);
        fputc('\n', to);
    }
    if (fclose(to) != 0 || rename(part, path) != 0)
        die(EXIT_WRITE, "%s: %s", path, strerror(errno));
    xfree(path);
    xfree(part);
}

static void write_nc(const struct trade *t)
{
    const struct study *const s = &t->study;
    const size_t n = (size_t)s->n;
    const char *const unit = t->by == BY_MEMORY ? "MiB" : "1"; /* s per s */
    const struct {
        const char *name, *unit, *long_name;
        const double *x;
    } list[] = {
        {"error", "1", "error against what the study compares with", t->error},
        {"scatter", "1", "standard error of the mean over repetitions, over the mean",
         t->scatter},
        {"cost", unit, "what the study counts as cost, median of the runs", t->cost},
        {"cost_least", unit, "cost of the cheapest run", t->low},
        {"cost_most", unit, "cost of the dearest run", t->high},
        {"core", "1", "core time per simulated time, median of the runs", t->core},
        {"wall", "s", "wall time of a run, median", t->wall},
        {"memory", "byte", "most memory that was resident", t->memory},
    };
    struct study_nc f = study_nc_create(s, "trade.nc", "variant", n);
    for (size_t k = 0; k < sizeof list / sizeof list[0]; k++)
        study_nc_real(&f, list[k].name, list[k].unit, list[k].long_name, list[k].x);
    double *const x = xalloc(n + 1, sizeof *x);
    for (size_t i = 0; i < n; i++)
        x[i] = t->front[i];
    study_nc_real(&f, "front", "1", "1: on the Pareto front of error and cost", x);
    for (int q = 0; q < t->n_quantities; q++) {
        for (size_t i = 0; i < n; i++)
            x[i] = t->value[i * (size_t)t->n_quantities + (size_t)q];
        study_nc_real(&f, t->quantity[q], "",
                      "quantity that is compared, in the unit of the summary", x);
    }
    xfree(x);
    study_nc_variants(&f, s);
    study_nc_close(&f);
}

void trade_write(const struct trade *t)
{
    write_csv(t);
    write_nc(t);
}
