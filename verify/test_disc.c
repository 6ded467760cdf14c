/* verify/test_disc.c - discs: mass and inertia, rebound, rolling down a plane; all in the plane. */
/* slots: shapes/disc contact/linear */
#include "check.h"
#include "harness.h"

#define PI 3.14159265358979323846

/* Discs in a thin box fall, collide and come to rest: nothing leaves the plane. */
static void test_plane(void)
{
    struct sim *const s = sim_from(
        "[domain]\nsize = 60 4.3 60 mm\n[grains a]\ndiameter = 4.3 mm\ndensity = 2385 kg/m3\n"
        "fill = lattice\nspacing = 5.3 mm\ncount = 90\nvelocity = 0.3 0 -0.2 m/s\n"
        "spin = 0 7 0 rad/s\nmaterial = m\n[material m]\nstiffness = 1e5 N/m\nrestitution = "
        "0.5\n"
        "friction = 0.4\n[run]\nend = 1 s\nsubsteps = 100\n");
    const struct grains *const g = &s->grains;
    const double m = 2385.0 * 0.25 * PI * 4.3e-3 * 4.3e-3 * 4.3e-3;
    check_rel(g->mass[0], m, 1e-14, "mass of a disc");
    check_rel(1.0 / g->inv_inertia[0], m * 4.3e-3 * 4.3e-3 / 8.0, 1e-14, "its inertia");
    long touched = 0;
    double off = 0.0, out = 0.0;
    for (int k = 0; k < 100; k++) {
        step(s);
        touched += s->neighbours.touching;
    }
    for (int i = 0; i < g->n; i++) {
        off = fmax(off, fabs(g->pos[i].y - 2.15e-3));
        out = fmax(out, fabs(g->vel[i].y) + fabs(g->spin[i].x) + fabs(g->spin[i].z));
    }
    check(touched > 100, "the discs touch: %ld", touched);
    check_abs(off, 0.0, 0.0, "they stay in the plane");
    check_abs(out, 0.0, 0.0, "velocities and spins stay in it");
    sim_free(s);
}

/* A disc that slides on the floor ends up rolling with 2/3 of its velocity (a sphere: 5/7). */
static void test_rolling(void)
{
    struct sim *const s = sim_from(
        "[domain]\nsize = 400 4.3 60 mm\n[grains a]\ndiameter = 4.3 mm\ndensity = 2385 kg/m3\n"
        "fill = point\nposition = 20 2.15 2.1499 mm\nvelocity = 0.2 0 0 m/s\n"
        "material = m\n[material m]\nstiffness = 1e5 N/m\nrestitution = 0.5\n"
        "friction = 0.4\n[run]\nend = 1 s\nsubsteps = 100\n");
    while (s->t < 0.15)
        step(s);
    check_rel(s->grains.vel[0].x, 0.2 * 2.0 / 3.0, 2e-3, "a sliding disc rolls in the end");
    check_rel(s->grains.spin[0].y * 2.15e-3, s->grains.vel[0].x, 2e-3, "its spin");
    sim_free(s);
}

/* Discs of two sizes in a box thicker than either, at random and inserted, all lie in one plane and stay
 * there, and their amount is that of cylinders. */
static void test_sizes(void)
{
    struct sim *const s = sim_from(
        "[domain]\nsize = 90 4.6 120 mm\n[grains a]\ndiameter = 4.3 mm\ndensity = 2385 kg/m3\n"
        "fill = random\nporosity = 0.61\nto = 90 4.6 60 mm\nmaterial = m\n"
        "[grains b]\ndiameter = 2.7 mm\ndensity = 1870 kg/m3\nfill = random\ncount = 31\n"
        "from = 0 0 60 mm\nmaterial = m\nvelocity = 0.3 0 -0.2 m/s\n"
        "[insert c]\nspecies = b\nfrom = 0 0 100 mm\nmass_flow = 7 g/s\nscatter = 0.3 m/s\n"
        "[wall slope]\nkind = rectangle\ncorner = 10 -3 40 mm\nedge1 = 50 0 -30 mm\n"
        "edge2 = 0 11 0 mm\n"
        "[material m]\nstiffness = 1e4 N/m\nrestitution = 0.5\nfriction = 0.4\n"
        "[run]\nend = 1 s\nsubsteps = 100\n");
    const struct grains *const g = &s->grains;
    const double room = 0.39 * 90e-3 * 60e-3, one = 0.25 * PI * 4.3e-3 * 4.3e-3;
    int n = 0;
    long touched = 0;
    double off = 0.0, out = 0.0;
    for (int i = 0; i < g->n; i++)
        n += g->kind[i] == 0;
    check(fabs(n * one - room) <= 0.5 * one, "porosity of discs counts cylinders: %d of %g", n,
          room / one);
    while (s->t < 0.1) {
        step(s);
        touched += s->neighbours.touching;
    }
    for (int i = 0; i < g->n; i++) {
        off = fmax(off, fabs(g->pos[i].y - 2.3e-3));
        out = fmax(out, fabs(g->vel[i].y) + fabs(g->spin[i].x) + fabs(g->spin[i].z));
    }
    const double mass = 1870.0 * 0.25 * PI * 2.7e-3 * 2.7e-3 * 4.6e-3;
    check(fabs(s->traffic.mass_in - 7e-3 * s->t) <= 1.5 * mass, "mass of inserted discs");
    check(touched > 1000, "discs of two sizes touch: %ld", touched);
    check_abs(off, 0.0, 0.0, "discs of two sizes stay in the plane");
    check_abs(out, 0.0, 0.0, "their velocities and spins stay in it");
    sim_free(s);
}

int main(void)
{
    test_plane();
    test_sizes();
    test_rolling();
    return check_end();
}
