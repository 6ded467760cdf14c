/* verify/test_wall_draw.c - the walls as triangles, for outputs and pictures: their areas, and where
 * they are when their walls move. */
/* slots: contact/linear */
#include "check.h"
#include "harness.h"
#include <string.h>
#include "../solver/wall_draw.h"

#define PI 3.14159265358979323846

static const char scene[] =
    "[domain]\nsize = 11 9 14 mm\ngravity = 0 0 0 m/s2\n"
    "[grains a]\ndiameter = 1.1 mm\ndensity = 2500 kg/m3\nmaterial = m\nfill = point\n"
    "position = 3.1 4.2 8.3 mm\n"
    "[material m]\nstiffness = 2e3 N/m\nrestitution = 0.8\nfriction = 0.3\n"
    "[run]\nend = 1 s\ndt = 1 us\n"
    "[wall roof]\nkind = plane\npoint = 1 1 13.3 mm\nnormal = 0 0 -1\nvelocity = 0 0 -0.7 m/s\n"
    "[wall slope]\nkind = plane\npoint = 0 4 0 mm\nnormal = -1 0 1\n"
    "[wall tube]\nkind = cylinder\npoint = 5.5 4.5 0 mm\naxis = 0 0 1\nradius = 3.9 mm\n"
    "[wall ring]\nkind = disc\npoint = 5.5 4.5 2.3 mm\nnormal = 0 0 1\nradius = 3.7 mm\n"
    "hole = 1.3 mm\n"
    "[wall crate]\nkind = box\nfrom = 9 7 10 mm\nto = 9.7 8.9 11.3 mm\nspin = 31 rad/s\n"
    "spin_axis = 0 0 1\nspin_point = 9 7 0 mm\n";

static double area(const struct wall_drawing *d, int wall)
{
    double sum = 0.0;
    for (int i = 0; i < d->n; i++)
        if (d->wall[i] == wall)
            sum += 0.5 * v3_norm(v3_cross(v3_sub(d->at[3 * i + 1], d->at[3 * i]),
                                          v3_sub(d->at[3 * i + 2], d->at[3 * i])));
    return sum;
}

/* The corner of a wall that is farthest along a direction. */
static vec3 farthest(const struct wall_drawing *d, int wall, vec3 way)
{
    vec3 best = v3(0.0, 0.0, 0.0);
    double most = -1e300;
    for (int i = 0; i < 3 * d->n; i++)
        if (d->wall[i / 3] == wall && v3_dot(d->at[i], way) > most) {
            most = v3_dot(d->at[i], way);
            best = d->at[i];
        }
    return best;
}

int main(void)
{
    struct sim *const s = sim_from(scene);
    struct wall_drawing d = walls_draw(s);
    const double facets = 96.0 / PI * sin(PI / 96.0);
    check_rel(area(&d, 0), 11e-3 * 9e-3, 1e-12, "a plane is cut off at the box");
    check_rel(area(&d, 1), sqrt(2.0) * 11e-3 * 9e-3, 1e-12, "a plane askew is");
    check_rel(area(&d, 2), 2.0 * PI * 3.9e-3 * 14e-3 * facets, 1e-12,
              "an endless tube of 96 facets ends at the box");
    check_rel(area(&d, 3),
              PI * (3.7e-3 * 3.7e-3 - 1.3e-3 * 1.3e-3) * 96.0 / (2.0 * PI) *
                  sin(2.0 * PI / 96.0),
              1e-12, "a disc with its hole");
    check_rel(area(&d, 4), 2.0 * (0.7 * 1.9 + 0.7 * 1.3 + 1.9 * 1.3) * 1e-6, 1e-12, "a box");
    wall_drawing_free(&d);
    step_grains(s, 2000);
    d = walls_draw(s);
    check_abs(farthest(&d, 0, v3(0, 0, 1)).z, 13.3e-3 - 0.7 * 2e-3, 1e-12,
              "the roof has come down by its velocity times the time");
    /* the far corner of the box turns by 0.062 about (9, 7) */
    const vec3 c = farthest(&d, 4, v3(1, 1, 0));
    check_abs(c.x, 9e-3 + 0.7e-3 * cos(0.062) - 1.9e-3 * sin(0.062), 1e-12, "the box turns, x");
    check_abs(c.y, 7e-3 + 0.7e-3 * sin(0.062) + 1.9e-3 * cos(0.062), 1e-12, "the box turns, y");
    check_rel(area(&d, 4), 2.0 * (0.7 * 1.9 + 0.7 * 1.3 + 1.9 * 1.3) * 1e-6, 1e-12,
              "and keeps its size");
    wall_drawing_free(&d);
    sim_free(s);
    return check_end();
}
