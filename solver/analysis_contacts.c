/* analysis_contacts.c - every contact with its force, at each output time, in run.nc: a ragged
 * array [CF-1.10, 9.3.3] on the dimension `contact`; contacts_listed(time) says how many of its
 * rows belong to which output. Walls have negative numbers: -1 - index, by the attribute `walls`
 * of contact_other. */
#include <netcdf.h>
#include <string.h>
#include "analysis.h"
#include "output_file.h"
#include "sim.h"

static const struct key keys[] = {
    {"output", "contacts", KEY_CHOICE, "", "off | on", "off",
     "every contact with its force, at each output time; draws force_chains.png"},
    {0},
};

enum { GRAIN, OTHER, INTS, FORCE = 0, POINT, NORMAL, BRANCH, VECTORS };

struct list {
    int listed, whole[INTS], vector[VECTORS], overlap;
    size_t rows, times;
};

static void *create(struct sim *s, struct scene *scene)
{
    if (scene_choice(scene, "output", NULL, "contacts") != 1)
        return NULL;
    contact_view_wanted(s);
    return xalloc(1, sizeof(struct list));
}

static char *wall_names(const struct sim *s)
{
    char *names = xstrdup("");
    for (int k = 0; k < s->walls.n; k++) {
        char *const more = xprintf("%s%s%s", names, k ? " " : "", s->walls.wall[k].name);
        xfree(names);
        names = more;
    }
    return names;
}

static void define(struct sim *s, void *state, struct output_file *f)
{
    struct list *const l = state;
    static const struct {
        const char *name, *unit, *text;
    } vector[VECTORS] = {{"contact_force", "N", "force on the grain by the other"},
                         {"contact_point", "m", "point of contact"},
                         {"contact_normal", "1", "unit normal, from the other to the grain"},
                         {"contact_branch", "m",
                          "from the centre of the other (wall: the point) to the grain's"}};
    int dim[2] = {0, f->dim[DIM_COMPONENT]};
    if (s->grains.n == 0 && !insert_changes(s))
        return;
    output_check(f, nc_def_dim(f->nc, "contact", NC_UNLIMITED, &dim[0]));
    l->listed = output_define(f, "contacts_listed", NC_INT, 1, &f->dim[DIM_TIME], "1",
                              "contacts of this output");
    output_text(f, l->listed, "sample_dimension", "contact");
    l->whole[GRAIN] = output_define(f, "contact_grain", NC_INT, 1, dim, "1", "id of the grain");
    l->whole[OTHER] = output_define(f, "contact_other", NC_INT, 1, dim, "1",
                                    "id of the other grain; -1 - index of a wall");
    char *const names = wall_names(s);
    output_text(f, l->whole[OTHER], "walls", names);
    xfree(names);
    for (int k = 0; k < VECTORS; k++)
        l->vector[k] =
            output_define(f, vector[k].name, NC_DOUBLE, 2, dim, vector[k].unit, vector[k].text);
    l->overlap = output_define(f, "contact_overlap", NC_DOUBLE, 1, dim, "m",
                               "overlap; negative: a gap across which a law acts");
}

static vec3 vector_of(const struct seen *v, int which)
{
    switch (which) {
    case FORCE:
        return v->force;
    case POINT:
        return v->point;
    case NORMAL:
        return v->normal;
    default:
        return v->branch;
    }
}

static void record(struct sim *s, void *state, struct output_file *f)
{
    struct list *const l = state;
    if (s->grains.n == 0 && !insert_changes(s))
        return;
    const struct contact_view *const v = contact_view(s);
    const size_t start[2] = {l->rows, 0}, count[2] = {v->n, 3};
    int *const whole = xalloc(v->n + 1, sizeof *whole);
    double *const x = xalloc(3 * v->n + 1, sizeof *x);
    const int listed = (int)v->n;
    output_check(f, nc_put_var1_int(f->nc, l->listed, &l->times, &listed));
    for (int which = 0; which < INTS; which++) {
        for (size_t k = 0; k < v->n; k++) {
            const struct seen *const c = &v->seen[k];
            whole[k] = which == GRAIN ? s->grains.id[c->i]
                       : c->j >= 0    ? s->grains.id[c->j]
                                      : -1 - c->wall;
        }
        if (v->n > 0)
            output_check(f, nc_put_vara_int(f->nc, l->whole[which], start, count, whole));
    }
    for (int which = 0; which < VECTORS && v->n > 0; which++) {
        for (size_t k = 0; k < v->n; k++) {
            const vec3 a = vector_of(&v->seen[k], which);
            memcpy(&x[3 * k], &a, sizeof a);
        }
        output_check(f, nc_put_vara_double(f->nc, l->vector[which], start, count, x));
    }
    for (size_t k = 0; k < v->n; k++)
        x[k] = v->seen[k].depth;
    if (v->n > 0)
        output_check(f, nc_put_vara_double(f->nc, l->overlap, start, count, x));
    l->rows += v->n;
    l->times++;
    xfree(whole);
    xfree(x);
}

const struct analysis_part analysis_contacts = {.name = "contacts",
                                                .keys = keys,
                                                .create = create,
                                                .define = define,
                                                .record = record,
                                                .free = xfree};
