/* verify/test_neighbours.c - the pair list against brute force, over rebuilds, sorting,
 * periodic sides and two sizes of grains; bits on 1, 2, 3, 7 and 16 threads. */
/* slots: contact/hertz_mindlin */
#include <omp.h>
#include "check.h"
#include "harness.h"

#define SCENE                                                                                  \
    "[grains a]\ndiameter = 3 mm\ndensity = 2385 kg/m3\nfill = random\ncount = 150\n"          \
    "velocity = 1 0.3 -0.2 m/s\nmaterial = m\n"                                                \
    "[grains b]\ndiameter = 1.3 mm\ndensity = 1723 kg/m3\nfill = random\ncount = 900\n"        \
    "velocity = -1 -0.7 0.4 m/s\nspin = 100 30 7 rad/s\nmaterial = m\n"                        \
    "[grains c]\ndiameter = 1 mm\ndensity = 1723 kg/m3\nfill = random\ncount = 50\n"           \
    "frozen = yes\nmaterial = m\n"                                                             \
    "[domain]\nsize = 20 21 32 mm\nx = periodic\ny = periodic\n"                               \
    "[material m]\nyoung = 2e7 Pa\npoisson = 0.3\nrestitution = 0.7\nfriction = 0.4\n"         \
    "[run]\nend = 1 s\nsubsteps = 50\ndt = 3 us\noverlap_max = 0.3\n"

/* Contacts by brute force: every pair, every wall. */
static long brute(const struct sim *s)
{
    const struct grains *const g = &s->grains;
    long touching = 0;
    for (int i = 0; i < g->n; i++) {
        for (int j = 0; j < i; j++) {
            const vec3 r = domain_minimum_image(&s->domain, v3_sub(g->pos[i], g->pos[j]));
            const bool move = g->inv_mass[i] + g->inv_mass[j] > 0.0;
            touching += move && v3_norm(r) < g->radius[i] + g->radius[j];
        }
        for (int e = 0; e < s->walls.n; e++) /* planes: an element each */
            touching += g->inv_mass[i] > 0.0 &&
                        v3_norm(wall_see(s, e, g->pos[i]).view.away) < g->radius[i];
    }
    return touching;
}

static unsigned long bits(int threads)
{
    omp_set_num_threads(threads);
    struct sim *const s = sim_from(SCENE);
    ledger_start(s);
    for (int k = 0; k < 60; k++)
        step(s);
    const unsigned long h = sim_bits(s);
    sim_free(s);
    return h;
}

int main(void)
{
    struct sim *const s = sim_from(SCENE);
    ledger_start(s);
    long most = 0, wrong = 0;
    for (int k = 0; k < 200; k++) {
        step(s);
        most = s->neighbours.touching > most ? s->neighbours.touching : most;
        wrong += s->neighbours.touching != brute(s);
    }
    check(wrong == 0, "the list finds every contact: %ld of 200 looks differ", wrong);
    check(most > 50, "there are contacts to find: up to %ld", most);
    check(s->neighbours.builds > 5, "the list was rebuilt %ld times", s->neighbours.builds);
    check(s->ledger.momentum_error < 1e-12,
          "momentum with walls and frozen grains closes: %.3g", s->ledger.momentum_error);
    check(s->ledger.dissipated_least >= -1e-3 * s->ledger.dissipated,
          "contacts make no energy: %.3g J", s->ledger.dissipated_least);
    sim_free(s);
    const unsigned long one = bits(1);
    const int threads[] = {2, 3, 7, 16};
    for (int i = 0; i < 4; i++)
        check(bits(threads[i]) == one, "the same bits on 1 and %d threads", threads[i]);
    return check_end();
}
