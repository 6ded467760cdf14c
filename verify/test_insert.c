/* verify/test_insert.c - grains that come and go: what was asked and what came to one grain, sizes,
 * the ledger, contacts cut by a removal, no room, the same on any number of threads. */
/* slots: contact/linear */
#include "check.h"
#include <omp.h>
#include <string.h>
#include <sys/wait.h>
#include "harness.h"

#define GRAINS                                                                                 \
    "[grains a]\ndensity = 2385 kg/m3\nmaterial = m\ncount = 0\nsizes = uniform\n"             \
    "diameter_min = 0.7 mm\ndiameter_max = 1.9 mm\n"
#define MATERIAL "[material m]\nstiffness = 1000 N/m\nrestitution = 0.6\nfriction = 0.3\n"
#define RUN      "[run]\nend = 0.0637 s\ndt = 14 us\nsubsteps = 10\n"

static struct sim *made(const char *box, const char *insert, const char *more)
{
    char *const text =
        xprintf("[domain]\nsize = %s\n" GRAINS MATERIAL RUN "%s%s", box, insert, more);
    struct sim *const s = sim_from(text);
    ledger_start(s);
    xfree(text);
    return s;
}

static void go(struct sim *s)
{
    while (s->t < s->run.end - 1e-9)
        step(s);
}

/* FNV-1a over the grains in order of id, whatever ids are left. */
static unsigned long bits(const struct sim *s)
{
    unsigned long h = 14695981039346656037ul;
    for (int id = 0; id < s->grains.next_id; id++) {
        const int i = grain_at(s, id);
        for (int f = 0; f < s->fields.n && i >= 0; f++) {
            const struct field *const field = &s->fields.field[f];
            const size_t size = kind_size(field->kind);
            const unsigned char *const data = *field->data;
            for (size_t b = 0; b < size && field->place == PLACE_GRAIN; b++)
                h = (h ^ data[(size_t)i * size + b]) * 1099511628211ul;
        }
    }
    return h;
}

#define RATE                                                                                   \
    "[insert rain]\nfrom = 1 1 5 mm\nto = 11 9 9.5 mm\nrate = 3713.7 1/s\n"                    \
    "velocity = 0 0 -0.2 m/s\nscatter = 0.05 m/s\nevery = 1.3 ms\n"

static void check_rate(void)
{
    struct sim *const s = made("12 10 10 mm", RATE, "");
    go(s);
    const struct source *const o = &s->traffic.source[0];
    check_abs(o->asked, floor(3713.7 * 0.0637), 0.0, "rate: grains asked by the end");
    check_abs(o->done, o->asked, 0.0, "rate: grains come by the end");
    check_abs(s->grains.n, o->done, 0.0, "rate: all of them are there");
    check(s->grains.n < (int)(o->asked + 1.0) && s->neighbours.touching > 10,
          "rate: %d grains lie in %ld contacts", s->grains.n, s->neighbours.touching);
    check_abs(s->ledger.momentum_error, 0.0, 1e-9, "rate: momentum closes");
    check_abs(s->ledger.mass / s->ledger.mass_start, 1.0, 1e-12, "rate: mass closes");
    check(s->ledger.dissipated > 0.0 &&
              -s->ledger.dissipated_least < 1e-3 * s->ledger.dissipated,
          "rate: contacts make no energy, %g of %g J", s->ledger.dissipated_least,
          s->ledger.dissipated);
    struct species *const k = &s->grains.species[0];
    check_rel(sizes_measured(k->made, (size_t)k->n_made, 0.5), 1.3e-3, 0.01,
              "rate: D50 by mass");
    check_rel(sizes_measured(k->made, (size_t)k->n_made, 0.1), 0.82e-3, 0.01,
              "rate: D10 by mass");
    sim_free(s);
}

static void check_flow(void)
{
    struct sim *const s = made(
        "12 10 20 mm",
        "[insert a]\nshape = disc\ncentre = 6 5 9 mm\nradius = 4 mm\nmass_flow = 3.17 g/s\n"
        "velocity = 0 0 -0.6 m/s\nstart = 0.0123 s\nend = 0.05 s\n",
        "");
    go(s);
    const struct source *const o = &s->traffic.source[0];
    const double most = 2385.0 * PI / 6.0 * 1.9e-3 * 1.9e-3 * 1.9e-3;
    check_rel(o->asked_mass, 3.17e-3 * (0.05 - 0.0123), 1e-12, "mass flow: mass asked");
    check_abs(o->done_mass, o->asked_mass, 0.5 * most, "mass flow: mass come, to half a grain");
    check_abs(s->ledger.mass, o->done_mass, 1e-12, "mass flow: the grains weigh it");
    sim_free(s);
}

static void check_limits(void)
{
    struct sim *s = made("12 10 20 mm",
                         "[insert a]\nshape = sphere\ncentre = 6 5 15 mm\nradius = 4.5 mm\n"
                         "rate = 2000 1/s\ncount = 71\nvelocity = 0 0 -0.1 m/s\n"
                         "[insert b]\nshape = cylinder\ncentre = 6 5 6 mm\naxis = 1 0.3 0\n"
                         "radius = 4 mm\nlength = 8 mm\nrate = 1000 1/s\nmass = 0.1 g\n",
                         "");
    go(s);
    check_abs(s->traffic.source[0].done, 71.0, 0.0, "a source stops at its count");
    check_abs(s->traffic.source[1].done_mass, 1e-4, 0.5 * 8.6e-6,
              "another at its mass, to half a grain");
    sim_free(s);
}

/* Rain through a box without a floor, and a bed out of which a ball is cut. */
static void check_outflow(void)
{
    struct sim *s = made("12 10 10 mm", RATE, "[side z-]\ngrains = open\n");
    go(s);
    struct traffic *const t = &s->traffic;
    check(t->sink[0].removed > 60.0, "open side: %g left", t->sink[0].removed);
    check_abs(t->inserted - t->removed, s->grains.n, 0.0,
              "open side: who did not leave is there");
    check_rel(t->mass_in - t->mass_out, s->ledger.mass, 1e-12, "open side: mass closes");
    check_abs(s->ledger.momentum_error, 0.0, 1e-9, "open side: momentum closes");
    check_abs(s->grains.next_id, t->inserted, 0.0, "open side: no id is given twice");
    sim_free(s);
    s = made("12 10 10 mm", RATE,
             "[delete hole]\nshape = sphere\ncentre = 6 5 1 mm\nradius = 1.7 mm\n");
    long cut = 0; /* contacts in the bed when grains were taken from it */
    while (s->t < s->run.end - 1e-9) {
        const long touching = s->neighbours.touching;
        const double before = s->traffic.removed;
        step(s);
        cut += s->traffic.removed > before ? touching : 0;
    }
    check(s->traffic.sink[0].removed > 15.0 && cut > 20,
          "a hole in a bed: %g gone, from among %ld contacts", s->traffic.sink[0].removed, cut);
    check_abs(s->ledger.momentum_error, 0.0, 1e-9, "a hole in a bed: momentum closes");
    check(s->ledger.dissipated > 0.0, "a hole in a bed: contacts make no energy");
    sim_free(s);
}

/* All of them go; then others come. */
static void check_empty(void)
{
    struct sim *const s = made("12 10 20 mm",
                               "[insert a]\nrate = 1000 1/s\nend = 0.01 s\nto = 12 10 19 mm\n"
                               "[insert b]\nrate = 1000 1/s\nstart = 0.06 s\nto = 12 10 19 mm\n"
                               "velocity = 0 0 1 m/s\n",
                               "[side z-]\ngrains = open\n"
                               "[delete under]\nshape = plane\ncentre = 0 0 3 mm\n");
    bool empty = false;
    while (s->t < s->run.end - 1e-9) {
        step(s);
        empty = empty || (s->t > 0.02 && s->grains.n == 0);
    }
    check(empty && s->grains.n > 0, "a box that empties and fills again, %d grains at the end",
          s->grains.n);
    check_abs(s->traffic.source[0].done, 10.0, 0.0, "the first ten came");
    sim_free(s);
}

static void leave(int code, const char *message)
{
    (void)message;
    _exit(code);
}

/* How a run with this source ends. */
static int ends(const char *box, const char *source, const char *rest)
{
    int status = 0;
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        die_hook = leave;
        go(made(box, source, rest));
        _exit(0);
    }
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void check_no_room(void)
{
    const int full =
        ends("4 4 6 mm", "[insert a]\nrate = 5000 1/s\nevery = 0.2 ms\npatience = 10 ms\n", "");
    check(full == EXIT_UNSTABLE, "a box that is full stops the run: exit %d", full);
#define NARROW "from = 4 3 14 mm\nto = 8 7 19 mm\nevery = 0.2 ms\npatience = 10 ms\n"
    const char *const drain = "[side z-]\ngrains = open\n";
    int late = ends("12 10 20 mm", "[insert a]\nrate = 12000 1/s\n" NARROW, drain);
    check(late == EXIT_UNSTABLE, "so does a debt that grows though grains come: exit %d", late);
    late = ends("12 10 20 mm", "[insert a]\nmass_flow = 57 g/s\n" NARROW, drain);
    check(late == EXIT_UNSTABLE, "and one of mass: exit %d", late);
    late = ends("12 10 20 mm", "[insert a]\nrate = 700 1/s\n" NARROW, drain);
    check(late == 0, "a source that keeps up does not: exit %d", late);
}

static void check_threads(void)
{
    static const int threads[4] = {1, 2, 3, 7};
    unsigned long h[4];
    for (int k = 0; k < 4; k++) {
        omp_set_num_threads(threads[k]);
        struct sim *const s = made("12 10 10 mm", RATE,
                                   "[delete hole]\nshape = sphere\ncentre = 6 5 1 mm\n"
                                   "radius = 3 mm\n");
        s->run.end = 0.02;
        go(s);
        h[k] = bits(s);
        sim_free(s);
    }
    check(h[0] == h[1] && h[0] == h[2] && h[0] == h[3],
          "the same bits on 1, 2, 3 and 7 threads while grains come and go");
}

int main(void)
{
    check_no_room();
    omp_set_num_threads(1);
    check_rate();
    check_flow();
    check_limits();
    check_outflow();
    check_empty();
    check_threads();
    return check_end();
}
