/* reference/lid_cavity.c - the steady flow in a square cavity whose lid moves.
 *
 * Velocities on the two centre lines, u(1/2, y) and v(x, 1/2), against values converged by
 * Richardson's extrapolation of a stream-function solution of second order (128^2, 256^2), in
 * verify/reference/lid_cavity.csv, which also holds the table of [Ghia82]: its values at
 * Re = 100 are 2 to 4 % low, and some are misprints. Re = rho U L/mu is 100 or 1000. The
 * lid is the side y+, its velocity along x. Compared at the end of the run, which must be steady. */
#include "reference.h"

#include <stdlib.h>
#include <string.h>
#include "../solver/sample.h"
#include "../solver/sim.h"

const struct about reference_about = {
    .name = "lid_cavity",
    .summary = "steady cavity with a moving lid: velocities on the centre lines",
    .equation = "u(1/2, y), v(x, 1/2) at Re = rho U L/mu",
    .source = "[Ghia82], converged values",
    .range = "Re = 100, 1000; a square in x and y, thin in z"};
const struct key reference_keys[] = {
    {"reference", "tolerance", KEY_REAL, "1", "(0, inf)", "0.01",
     "of the velocities, in parts of the lid's"},
    {"reference", "file", KEY_TEXT, "", "", "verify/reference/lid_cavity.csv",
     "the values to compare with"},
    {0},
};

enum { COLUMNS = 7, POINTS_MOST = 128 };

static const struct table pattern = {
    .name = "cavity",
    .title = "centre lines of the cavity",
    .n_columns = COLUMNS,
    .column = {{"coordinate", "1", "y/L on the vertical, x/L on the horizontal line"},
               {"u", "1", "u/U on the vertical line, simulated"},
               {"u_converged", "1", "u/U, converged"},
               {"v", "1", "v/U on the horizontal line, simulated"},
               {"v_converged", "1", "v/U, converged"},
               {"ghia", "1", "as tabulated by Ghia et al."},
               {"error", "1", "(simulated - converged)/U"}},
    .figure = {.file = "cavity.png",
               .title = "velocities on the centre lines",
               .x = "coordinate",
               .x_label = "y/L or x/L",
               .y_label = "velocity over that of the lid",
               .n_curves = 4,
               .curve = {{"u", "line", "u on the vertical line"},
                         {"u_converged", "points", "u, converged"},
                         {"v", "line", "v on the horizontal line"},
                         {"v_converged", "points", "v, converged"}}}};

struct point {
    bool vertical;
    double at, ghia, converged;
};

struct lid_cavity {
    double tolerance, U, L;
    int n;
    struct point point[POINTS_MOST];
    struct table *table;
};

/* "100,u_on_x=0.5_at_y,0.9765625,0.84123,0.84348,..." of this Reynolds number. */
static void read_line(struct lid_cavity *p, const char *line, double re)
{
    char name[32];
    double of, at, ghia, converged;
    if (line[0] == '#' || p->n == POINTS_MOST ||
        sscanf(line, "%lf,%31[^,],%lf,%lf,%lf", &of, name, &at, &ghia, &converged) != 5)
        return;
    if (fabs(of / re - 1.0) < 0.01)
        p->point[p->n++] = (struct point){name[0] == 'u', at, ghia, converged};
}

static void read_values(struct lid_cavity *p, struct scene *scene, double re)
{
    FILE *const file = fopen(scene_text(scene, "reference", NULL, "file"), "r");
    char line[256];
    if (!file) {
        scene_error(scene, "reference", NULL, "file", "no such file");
        return;
    }
    while (fgets(line, sizeof line, file))
        read_line(p, line, re);
    fclose(file);
    if (p->n == 0)
        scene_error(scene, "reference", NULL, "file", "holds no values for Re = %g", re);
}

void reference_create(struct sim *s, struct scene *scene)
{
    struct lid_cavity *const p = xalloc(1, sizeof *p);
    const double *const size = s->domain.size;
    s->reference = p;
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    p->U = s->domain.side[Y_HI].velocity.x;
    p->L = size[0];
    if (!(p->U > 0.0))
        scene_error(scene, "side", "y+", "velocity",
                    "lid_cavity needs a lid that moves along x");
    if (fabs(size[0] - size[1]) > 1e-9 * size[0])
        scene_error(scene, "domain", NULL, "size", "lid_cavity needs a square in x and y");
    if (!s->fluid.exists)
        scene_error(scene, "modules", NULL, "reference", "lid_cavity needs a fluid");
    if (scene_errors(scene) > 0)
        return;
    read_values(p, scene, s->fluid.rho * p->U * p->L / s->fluid.mu);
    p->table = tables_add(&s->tables, &pattern);
}

void reference_watch(struct sim *s)
{
    (void)s; /* the end of the run is compared */
}

void reference_report(struct sim *s)
{
    struct lid_cavity *const p = s->reference;
    double worst = 0.0;
    for (int i = 0; i < p->n; i++) {
        const struct point *const q = &p->point[i];
        const double z = 0.5 * s->domain.size[2], at = q->at * p->L, half = 0.5 * p->L;
        const vec3 x = q->vertical ? v3(half, at, z) : v3(at, half, z);
        const double got = sample_velocity(s, q->vertical ? 0 : 1, x) / p->U;
        const double none = (double)NAN, error = got - q->converged;
        const double row[COLUMNS] = {q->at,
                                     q->vertical ? got : none,
                                     q->vertical ? q->converged : none,
                                     q->vertical ? none : got,
                                     q->vertical ? none : q->converged,
                                     q->ghia,
                                     error};
        table_row(p->table, row);
        worst = fabs(error) <= worst ? worst : fabs(error);
    }
    const bool good = worst <= p->tolerance;
    summary_number(&s->summary, "cavity_error", worst, "1");
    summary_reference(
        &s->summary,
        (struct comparison){.quantity = "velocity on the centre lines, largest difference",
                            .source = reference_about.source,
                            .unit = "1",
                            .got = (double)NAN,
                            .want = (double)NAN,
                            .error = worst,
                            .tolerance = p->tolerance});
    summary_text(&s->summary, "verdict", good ? "pass" : "FAIL");
    printf("reference: %s largest error on the centre lines %.2e of the lid's velocity, "
           "tolerance %g\n",
           good ? "pass" : "FAIL", worst, p->tolerance);
}

void reference_free(struct sim *s)
{
    xfree(s->reference);
}
