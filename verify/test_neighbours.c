/* verify/test_neighbours.c - the pair list against brute force, over rebuilds, sorting,
 * periodic sides, sizes of 3:1 and of 20:1, grains that all drift and a few that do not, a moving wall;
 * bits on 1, 2, 3, 7 and 16 threads. */
/* slots: contact/hertz_mindlin */
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>
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

/* No frozen grain: the skins leave out the drift, which is most of the motion, walls see all of it. */
#define DRIFT                                                                                  \
    "[grains a]\nsizes = uniform\nsizes_by = number\ndiameter_min = 0.35 mm\n"                 \
    "diameter_max = 7 mm\ndensity = 2385 kg/m3\nfill = random\ncount = 90\n"                   \
    "velocity = 0.7 -0.4 -3.1 m/s\nmaterial = m\n"                                             \
    "[grains b]\ndiameter = 0.37 mm\ndensity = 1723 kg/m3\nfill = random\ncount = 900\n"       \
    "velocity = 0.6 -0.5 -2.9 m/s\nmaterial = m\n"                                             \
    "[grains c]\ndiameter = 0.41 mm\ndensity = 1723 kg/m3\nfill = random\ncount = 17\n"        \
    "velocity = -2 1 3 m/s\nmaterial = m\n"                                                    \
    "[domain]\nsize = 26 25 44 mm\nx = periodic\ny = periodic\n"                               \
    "[wall lid]\npoint = 0 0 43.9 mm\nnormal = 0 0 -1\nvelocity = 0 0 -0.9 m/s\n"              \
    "[material m]\nyoung = 5e8 Pa\npoisson = 0.3\nrestitution = 0.7\nfriction = 0.4\n"         \
    "[run]\nend = 1 s\nsubsteps = 50\ndt = 1 us\noverlap_max = 0.9\n"

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

/* Looks at the contacts of a run after each of its records. */
static struct sim *look(const char *scene, int looks, long most_least)
{
    struct sim *const s = sim_from(scene);
    ledger_start(s);
    long most = 0, wrong = 0;
    for (int k = 0; k < looks; k++) {
        step(s);
        most = s->neighbours.touching > most ? s->neighbours.touching : most;
        wrong += s->neighbours.touching != brute(s);
    }
    check(wrong == 0, "the list finds every contact: %ld of %d looks differ", wrong, looks);
    check(most > most_least, "there are contacts to find: up to %ld", most);
    check(s->neighbours.builds > 5, "the list was rebuilt %ld times", s->neighbours.builds);
    return s;
}

/* A grain whose velocity is no number stops the run at once, wherever it stands among the others. */
static void check_lost(int i)
{
    int status = 0;
    fflush(stdout);
    const pid_t pid = fork();
    if (pid == 0) {
        struct sim *const s = sim_from(SCENE);
        if (!freopen("/dev/null", "w", stderr))
            _exit(99);
        ledger_start(s);
        step(s);
        s->grains.vel[i].y = (double)NAN;
        step(s);
        _exit(0);
    }
    const bool ended = pid > 0 && waitpid(pid, &status, 0) == pid && WIFEXITED(status);
    check(ended && WEXITSTATUS(status) == EXIT_UNSTABLE,
          "velocity of grain %d not a number: exit status %d", i, WEXITSTATUS(status));
}

int main(void)
{
    check(isnan(larger(larger(larger(0.0, 2.0), (double)NAN), 3.0)) && larger(2.0, 1.0) == 2.0,
          "the largest of numbers and one that is none is none");
    check_lost(0);
    check_lost(7);
    struct sim *s = look(DRIFT, 100, 10);
    check(s->neighbours.drift_speed > 1.0, "the grains drift at %.3g m/s",
          s->neighbours.drift_speed);
    sim_free(s);
    s = look(SCENE, 200, 50);
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
