/* extremes_output.c - extremes.csv (points), edges.csv, extremes.nc (both). */
#include <errno.h>
#include <netcdf.h>
#include <string.h>
#include "extremes.h"
#include "study_nc.h"

static FILE *open_part(const char *part)
{
    FILE *const to = fopen(part, "w");
    if (!to)
        die(EXIT_WRITE, "%s: %s", part, strerror(errno));
    return to;
}

static void close_part(FILE *to, const char *part, const char *path)
{
    if (fclose(to) != 0 || rename(part, path) != 0)
        die(EXIT_WRITE, "%s: %s", path, strerror(errno));
}

static void write_points(const struct extremes *x)
{
    const struct study *const s = &x->study;
    char *const path = study_path(s, "extremes.csv"), *const part = xprintf("%s.part", path);
    FILE *const to = open_part(part);
    fprintf(to, "number");
    for (int a = 0; a < s->n_axes; a++) {
        fputc(',', to);
        csv_field(to, s->axis[a].name);
    }
    fprintf(to, ",verdict,error,wall,memory");
    for (int i = 0; i < x->n_names; i++) {
        fputc(',', to);
        char *const name = xprintf("step over limit: %s", x->name[i]);
        csv_field(to, name);
        xfree(name);
    }
    fprintf(to, ",reason,command\n");
    for (int i = 0; i < x->n; i++) {
        const struct point *const p = &x->point[i];
        fprintf(to, "%d", p->v->number);
        for (int a = 0; a < s->n_axes; a++) {
            fputc(',', to);
            csv_field(to, p->v->choice[a] < 0 ? "" : s->axis[a].value[p->v->choice[a]]);
        }
        fprintf(to, ",%s,%.10g,%.6g,%.0f", verdict_name[p->verdict], p->error,
                p->v->n_runs > 0 ? p->v->run[0].wall : (double)NAN,
                p->v->n_runs > 0 ? p->v->run[0].memory : (double)NAN);
        for (int k = 0; k < x->n_names; k++)
            fprintf(to, ",%.6g", p->ratio[k]);
        fputc(',', to);
        csv_field(to, p->v->reason);
        fputc(',', to);
        csv_field(to, p->v->command);
        fputc('\n', to);
    }
    close_part(to, part, path);
    xfree(path);
    xfree(part);
}

static void write_edges(const struct extremes *x)
{
    const struct study *const s = &x->study;
    char *const path = study_path(s, "edges.csv"), *const part = xprintf("%s.part", path);
    FILE *const to = open_part(part);
    fprintf(to, "axis,found,predicted,limit,before,after,last before,first after\n");
    for (int i = 0; i < x->n_edges; i++) {
        const struct edge *const e = &x->edge[i];
        csv_field(to, s->axis[e->axis].name);
        fprintf(to, ",%.6g,%.6g,", e->found, e->predicted);
        csv_field(to, e->limit);
        fprintf(to, ",%s,%s,", verdict_name[e->before], verdict_name[e->after]);
        csv_field(to, e->left->label);
        fputc(',', to);
        csv_field(to, e->right->label);
        fputc('\n', to);
    }
    close_part(to, part, path);
    xfree(path);
    xfree(part);
}

static void put_edges(struct study_nc *f, const struct extremes *x)
{
    struct study_nc e = study_nc_dim(f, "edge", (size_t)x->n_edges);
    double *const found = xalloc(e.n + 1, sizeof *found), *const predicted =
                                                              xalloc(e.n + 1, sizeof *found);
    const char **const text = xalloc(e.n + 1, sizeof *text);
    for (int i = 0; i < x->n_edges; i++) {
        found[i] = x->edge[i].found;
        predicted[i] = x->edge[i].predicted;
        text[i] = x->study.axis[x->edge[i].axis].name;
    }
    study_nc_text(&e, "edge_axis", "axis along which the verdict changes", text);
    study_nc_real(&e, "edge_found", "", "value at which it changes, to 5 %", found);
    study_nc_real(&e, "edge_predicted", "", "value at which a limit of check is passed",
                  predicted);
    for (int i = 0; i < x->n_edges; i++)
        text[i] = x->edge[i].limit;
    study_nc_text(&e, "edge_limit", "that limit", text);
    for (int i = 0; i < x->n_edges; i++)
        text[i] = verdict_name[x->edge[i].before];
    study_nc_text(&e, "edge_before", "verdict below", text);
    for (int i = 0; i < x->n_edges; i++)
        text[i] = verdict_name[x->edge[i].after];
    study_nc_text(&e, "edge_after", "verdict above", text);
    xfree(found);
    xfree(predicted);
    xfree(text);
}

/* Points in the order of variants: every variant is a point. */
static void write_nc(const struct extremes *x)
{
    struct study_nc f = study_nc_create(&x->study, "extremes.nc", "point", (size_t)x->n);
    double *const y = xalloc((size_t)x->n + 1, sizeof *y);
    const char **const text = xalloc((size_t)x->n + 1, sizeof *text);
    for (int i = 0; i < x->n; i++) {
        text[i] = verdict_name[x->point[i].verdict];
        y[i] = x->point[i].error;
    }
    study_nc_text(&f, "verdict", "right, wrong, refused, stopped, slow or broken", text);
    study_nc_real(&f, "error", "1", "error against the scene's reference", y);
    for (int k = 0; k < x->n_names; k++) {
        char name[80];
        snprintf(name, sizeof name, "ratio_%s", x->name[k]);
        for (char *c = name; *c; c++)
            if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') ||
                  (*c >= '0' && *c <= '9')))
                *c = '_';
        for (int i = 0; i < x->n; i++)
            y[i] = x->point[i].ratio[k];
        study_nc_real(&f, name, "1", x->name[k], y);
    }
    study_nc_variants(&f, &x->study);
    put_edges(&f, x);
    study_nc_close(&f);
    xfree(y);
    xfree(text);
}

void extremes_write(const struct extremes *x)
{
    write_points(x);
    write_edges(x);
    write_nc(x);
}
