/* verify/test_laws.c - the contract of every answer of every slot of contacts, each alone and in
 * all combinations of slots: action and reaction, the rotated pair feels the rotated force, every
 * lane computes the same bits, only what was asked for is read, no pull unless cohesive, no force
 * out of nothing, and no energy made: what a contact does on its grains, over a path of pressing,
 * shearing, rolling and parting, is at most what it stored less. Prints the size of each law's
 * jumps. */
#include "laws.h"

enum { MOST = 32, STEPS = 4000 };

static struct law laws[LAW_SLOTS][MOST];
static int count[LAW_SLOTS];

static const char *const bonded[] = {"bond.gap=1 mm", "bond.damping=0.1", NULL};
static const char *const elastic[] = {"material a.restitution=1", "material b.restitution=1",
                                      NULL};

static bool has_key(const struct law *l, const char *name)
{
    for (const struct key *k = l->keys; k->section; k++)
        if (strcmp(k->name, name) == 0)
            return true;
    return false;
}

/* The slots' chosen answers and their memory. */
struct set {
    const struct law *law[LAW_SLOTS]; /* NULL: nothing of this slot */
};

static double set_rows(const struct set *s)
{
    int rows = 0;
    for (int k = 0; k < LAW_SLOTS; k++)
        rows += s->law[k] ? *s->law[k]->history : 0;
    return rows;
}

/* The loop's order of laws. Without a law of contact there is a plain normal force. */
static void apply(const struct set *s, struct touch *t, real (*h)[TOUCH])
{
    for (int c = 0; c < t->n; c++) {
        const real depth = t->depth[c] > 0.0 ? t->depth[c] : 0.0;
        t->kn[c] = 3e4;
        t->fn[c] = s->law[0] ? 0.0 : 3e4 * depth;
    }
    for (int k = 0; k < LAW_SLOTS; k++)
        if (s->law[k]) {
            s->law[k]->forces(t, h);
            h += *s->law[k]->history;
        }
}

static double stored(const struct set *s, struct touch *t, real (*h)[TOUCH])
{
    t->energy[0] = 0.0;
    for (int k = 0; k < LAW_SLOTS; k++)
        if (s->law[k]) {
            s->law[k]->energy(t, h);
            h += *s->law[k]->history;
        }
    return t->energy[0];
}

static vec3 turn(vec3 a)
{
    static const double m[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
    return v3(m[0][0] * a.x + m[0][1] * a.y + m[0][2] * a.z,
              m[1][0] * a.x + m[1][1] * a.y + m[1][2] * a.z,
              m[2][0] * a.x + m[2][1] * a.y + m[2][2] * a.z);
}

static struct law_pair rotated(struct law_pair p)
{
    p.n = turn(p.n);
    p.v = turn(p.v);
    p.spin_i = turn(p.spin_i);
    p.spin_j = turn(p.spin_j);
    return p;
}

static struct law_pair swapped(struct law_pair p)
{
    const struct law_pair q = p;
    p.r_i = q.r_j;
    p.r_j = q.r_i;
    p.m_i = q.m_j;
    p.m_j = q.m_i;
    p.n = v3_scale(-1.0, q.n);
    p.v = v3_scale(-1.0, q.v);
    p.spin_i = q.spin_j;
    p.spin_j = q.spin_i;
    p.pair = q.pair == 1 ? 2 : q.pair == 2 ? 1 : q.pair;
    return p;
}

/* The path at step k of `steps`: pressed and parted twice, sheared, rolled and twisted. */
struct path {
    double depth, gap, shear, spin; /* m, m, m, rad: amplitudes */
    bool plane;
};

static struct law_pair at(const struct path *path, double k, int steps, double dt)
{
    const double a = 2.0 * PI * k / steps, rate = 2.0 * PI / (steps * dt);
    const double swing = 0.5 * (path->depth + path->gap);
    return (struct law_pair){
        .r_i = 3.1e-3,
        .r_j = path->plane ? 0.0 : 4.7e-3,
        .m_i = 2.3e-4,
        .m_j = 7.9e-4,
        .depth = swing * (1.0 - cos(2.0 * a)) - path->gap,
        .n = v3(0.6, 0.0, 0.8),
        .v = v3_add(v3_scale(-2.0 * swing * rate * sin(2.0 * a), v3(0.6, 0.0, 0.8)),
                    v3(0.8 * path->shear * rate * sin(3.0 * a + 0.7),
                       path->shear * rate * cos(5.0 * a),
                       -0.6 * path->shear * rate * sin(3.0 * a + 0.7))),
        .spin_i = v3(path->spin * rate * sin(3.0 * a), path->spin * rate * cos(4.0 * a + 0.2),
                     path->spin * rate * 0.7),
        .spin_j = v3(-0.4 * path->spin * rate, path->spin * rate * sin(a), 0.0),
        .pair = 1};
}

/* What a law did not ask for it cannot rely on. */
static void spoil(const struct set *s, struct touch *t)
{
    unsigned needs = 0;
    for (int k = 0; k < LAW_SLOTS; k++)
        needs |= s->law[k] && s->law[k]->needs ? *s->law[k]->needs : 0;
    for (int c = 0; c < t->n; c++) {
        if (!(needs & TOUCH_SPIN))
            t->sx[c] = t->sy[c] = t->sz[c] = (real)NAN;
        if (!(needs & TOUCH_INERTIA))
            t->inertia[c] = (real)NAN;
    }
}

static unsigned needs_of(const struct set *s)
{
    unsigned needs = 0;
    for (int k = 0; k < LAW_SLOTS; k++)
        needs |= s->law[k] && s->law[k]->needs ? *s->law[k]->needs : 0;
    return needs;
}

struct findings {
    double frame, reaction;      /* of the largest force and moment */
    double moment, force;        /* largest, N m, N */
    double made;                 /* J, work beyond what was stored, of the work's size */
    double jump, jump_moment;    /* largest change within a step, of the largest value */
    bool lanes, finite, couples; /* couples only if asked for */
};

/* Lane 1 holds the pair rotated, lane 2 swapped, all others the pair itself. */
static struct findings walk(const struct set *s, const struct path *path, int steps, int n)
{
    static struct touch t;
    static real h[HISTORY_MAX][TOUCH];
    struct findings f = {.lanes = true, .finite = true, .couples = true};
    double work = 0.0, size = 0.0, least = 0.0, reaction = 0.0, frame = 0.0;
    double reaction_m = 0.0, frame_m = 0.0;
    vec3 force = v3(0, 0, 0), moment = v3(0, 0, 0);
    memset(h, 0, sizeof h);
    t.n = n;
    t.dt = 2e-3 / steps;
    double start = 0.0, range = 0.0;
    for (int k = 0; k < LAW_SLOTS; k++)
        if (s->law[k] && s->law[k]->range)
            range = fmax(range, s->law[k]->range());
    for (int k = 0; k < steps; k++) {
        const struct law_pair p = at(path, k, steps, t.dt);
        struct law_pair half = at(path, k - 0.5, steps, t.dt);
        half.depth = p.depth;
        t.time = k * t.dt;
        for (int c = 0; c < n; c++) {
            const struct law_pair q = c == 1                   ? rotated(half)
                                      : c == 2 && !path->plane ? swapped(half)
                                                               : half;
            law_put(&t, c, &q);
        }
        spoil(s, &t);
        apply(s, &t, h);
        if (p.depth <= -range)
            memset(h, 0, sizeof h); /* the loop forgets */
        const vec3 force_old = force, moment_old = moment;
        force = law_force(&t, 0);
        moment = law_moment(&t, 0);
        f.finite = f.finite && isfinite(v3_norm(force)) && isfinite(v3_norm(moment));
        f.couples = f.couples && (v3_norm(moment) == 0.0 || (needs_of(s) & TOUCH_COUPLES));
        frame = fmax(frame, v3_norm(v3_sub(law_force(&t, 1), turn(force))));
        frame_m = fmax(frame_m, v3_norm(v3_sub(law_moment(&t, 1), turn(moment))));
        if (!path->plane) {
            reaction = fmax(reaction, v3_norm(v3_add(law_force(&t, 2), force)));
            reaction_m = fmax(reaction_m, v3_norm(v3_add(law_moment(&t, 2), moment)));
        }
        for (int c = 3; c < n; c++)
            f.lanes = f.lanes && t.fx[c] == t.fx[0] && t.fy[c] == t.fy[0] &&
                      t.fz[c] == t.fz[0] && t.mx[c] == t.mx[0] && t.my[c] == t.my[0] &&
                      t.mz[c] == t.mz[0];
        f.force = fmax(f.force, v3_norm(force));
        f.moment = fmax(f.moment, v3_norm(moment));
        if (k > 0) {
            const vec3 w = v3_sub(half.spin_i, half.spin_j);
            const double done = 0.5 * t.dt *
                                (v3_dot(v3_add(force, force_old), half.v) +
                                 v3_dot(v3_add(moment, moment_old), w));
            work += done;
            size += fabs(done);
            f.jump = fmax(f.jump, v3_norm(v3_sub(force, force_old)));
            f.jump_moment = fmax(f.jump_moment, v3_norm(v3_sub(moment, moment_old)));
            const double gain = work + stored(s, &t, h) - start;
            f.made = fmax(f.made, gain - least);
            least = fmin(least, gain);
        } else {
            start = stored(s, &t, h);
        }
    }
    f.frame = fmax(frame / fmax(f.force, 1e-300), frame_m / fmax(f.moment, 1e-300));
    f.reaction = fmax(reaction / fmax(f.force, 1e-300), reaction_m / fmax(f.moment, 1e-300));
    f.made = size > 0.0 ? f.made / size : 0.0;
    f.jump = f.force > 0.0 ? f.jump / f.force : 0.0;
    f.jump_moment = f.moment > 0.0 ? f.jump_moment / f.moment : 0.0;
    return f;
}

static void start_set(const struct set *s, bool loses)
{
    for (int k = 0; k < LAW_SLOTS; k++)
        if (s->law[k])
            law_start(s->law[k], 2,
                      has_key(s->law[k], "gap")                     ? bonded
                      : !loses && has_key(s->law[k], "restitution") ? elastic
                                                                    : NULL);
}

static const struct path paths[] = {
    {.depth = 4e-5, .gap = 6e-5, .shear = 7e-7, .spin = 1e-4},
    {.depth = 4e-5, .gap = 6e-5, .shear = 6e-5, .spin = 2e-2},
    {.depth = 2e-5, .gap = 3e-4, .shear = 6e-5, .spin = 2e-2},
    {.depth = 4e-5, .gap = 6e-5, .shear = 2e-5, .spin = 4e-3, .plane = true},
};

enum { PATHS = sizeof paths / sizeof paths[0] };

static void judge(const struct set *s, const char *name)
{
    struct findings worst = {.lanes = true, .finite = true, .couples = true};
    for (int i = 0; i < 2 * PATHS; i++) {
        start_set(s, i < PATHS);
        const struct findings f = walk(s, &paths[i % PATHS], STEPS, TOUCH_LANES);
        worst.frame = fmax(worst.frame, f.frame);
        worst.reaction = fmax(worst.reaction, f.reaction);
        worst.made = fmax(worst.made, f.made);
        worst.lanes = worst.lanes && f.lanes;
        worst.finite = worst.finite && f.finite;
        worst.couples = worst.couples && f.couples;
        worst.force = fmax(worst.force, f.force);
        worst.moment = fmax(worst.moment, f.moment);
        worst.jump = fmax(worst.jump, f.jump);
        worst.jump_moment = fmax(worst.jump_moment, f.jump_moment);
    }
    check(worst.finite && worst.couples, "%s: finite, reads and writes what it asked for",
          name);
    check(worst.lanes, "%s: every lane computes the same bits", name);
    check(worst.frame < 1e-10, "%s: the rotated pair feels the rotated force (%.2g off)", name,
          worst.frame);
    check(worst.reaction < 1e-10, "%s: action and reaction (%.2g off)", name, worst.reaction);
    start_set(s, true);
    check(worst.made < 1e-3, "%s: no energy made (%.2g of what moves)", name, worst.made);
    printf("     %s: largest force %.3g N, couple %.3g N m; largest jumps %.2g, %.2g of them\n",
           name, worst.force, worst.moment, worst.jump, worst.jump_moment);
}

/* At rest and apart, at rest in touch, and parting fast. */
static void judge_pull(const struct set *s, const char *name)
{
    static struct touch t;
    static real h[HISTORY_MAX][TOUCH];
    const vec3 n = v3(0.6, 0.0, 0.8);
    double pull = 0.0, idle = 0.0;
    const bool normal = s->law[0] != NULL, film = s->law[2] != NULL;
    memset(h, 0, sizeof h);
    t.n = TOUCH;
    t.dt = 1e-7;
    t.time = 1.0;
    for (int c = 0; c < TOUCH; c++) {
        const bool still = c % 2;
        const struct law_pair p = {
            .r_i = 3.1e-3,
            .r_j = 4.7e-3,
            .m_i = 2.3e-4,
            .m_j = 7.9e-4,
            .depth = (c % 4 < 2 ? -1.0
                      : film    ? -0.5
                                : 1.0) *
                     1e-5 * (1 + c % 7),
            .n = n,
            .v = still ? v3(0, 0, 0)
                       : v3(0.3 * (c % 5 - 2), 0.1 * (c % 3 - 1), 1.9 * (c % 11 - 5)),
            .pair = c % 4};
        law_put(&t, c, &p);
    }
    spoil(s, &t);
    apply(s, &t, h);
    for (int c = 0; c < TOUCH; c++) {
        const double size = v3_norm(law_force(&t, c)) + v3_norm(law_moment(&t, c));
        pull = fmin(pull, v3_dot(law_force(&t, c), n));
        if (film ? c % 2 : t.depth[c] <= 0.0)
            idle = fmax(idle, size);
    }
    if (normal)
        check(pull >= -1e-12, "%s: never pulls (%g N)", name, pull);
    check(idle == 0.0,
          film ? "%s: no force at rest (%g N)" : "%s: no force without touch (%g N)", name,
          idle);
}

/* contact_damping is what the normal force falls by with the normal velocity. */
static void judge_damping(const struct set *s, const char *name)
{
    static struct touch t;
    static real h[HISTORY_MAX][TOUCH];
    real given[TOUCH], still[TOUCH];
    double worst = 0.0, most = 0.0;
    start_set(s, true);
    for (int moves = 0; moves < 2; moves++) {
        const double v = moves ? -3.7e-4 : 0.0;
        memset(h, 0, sizeof h);
        t.n = TOUCH;
        t.dt = 1e-7;
        for (int c = 0; c < TOUCH; c++) {
            const struct law_pair p = {.r_i = 3.1e-3,
                                       .r_j = 4.7e-3,
                                       .m_i = 2.3e-4,
                                       .m_j = 7.9e-4,
                                       .depth = 1e-6 * (c - 3) * (1 + c % 7),
                                       .n = v3(0.0, 0.0, 1.0),
                                       .v = v3(0.0, 0.0, v),
                                       .pair = c % 4};
            law_put(&t, c, &p);
        }
        spoil(s, &t);
        s->law[0]->damping(&t, given);
        s->law[0]->forces(&t, h);
        for (int c = 0; c < TOUCH && moves == 0; c++)
            still[c] = t.fn[c];
        for (int c = 0; c < TOUCH && moves == 1; c++) {
            const double found = ((double)t.fn[c] - (double)still[c]) / -v;
            worst = fmax(worst, fabs(found - (double)given[c]));
            most = fmax(most, found);
        }
    }
    check(worst <= 1e-9 * most,
          "%s: the dashpot that it tells of is that of its force (%.2g off)", name,
          worst / fmax(most, 1e-300));
}

static void each_alone(void)
{
    for (int k = 0; k < LAW_SLOTS; k++)
        for (int i = 0; i < count[k]; i++) {
            struct set s = {{NULL}};
            s.law[k] = &laws[k][i];
            char *const name = xprintf("%s = %s", law_slots[k].name, laws[k][i].about->name);
            judge(&s, name);
            if (strcmp(law_slots[k].name, "cohesion") != 0)
                judge_pull(&s, name);
            if (k == 0)
                judge_damping(&s, name);
            xfree(name);
        }
}

/* Every combination of the slots at once: one line for those of one law of contact. */
static void combinations(void)
{
    int total = 0, bad = 0, rows = 0;
    int at_slot[LAW_SLOTS] = {0};
    for (bool more_left = true; more_left;) {
        struct set s;
        for (int k = 0; k < LAW_SLOTS; k++)
            s.law[k] = &laws[k][at_slot[k]];
        const struct findings f = walk(&s, &paths[1], 200, TOUCH_LANES);
        const bool good = f.lanes && f.finite && f.frame < 1e-10 && f.reaction < 1e-10 &&
                          f.made < 0.05 && set_rows(&s) <= HISTORY_MAX;
        total++;
        rows = (int)fmax(rows, set_rows(&s));
        if (!good) {
            bad++;
            printf("     bad: %s %s %s %s %s: frame %.2g, reaction %.2g, made %.2g\n",
                   s.law[0]->about->name, s.law[1]->about->name, s.law[2]->about->name,
                   s.law[3]->about->name, s.law[4]->about->name, f.frame, f.reaction, f.made);
        }
        int k = 0;
        while (k < LAW_SLOTS && ++at_slot[k] == count[k])
            at_slot[k++] = 0;
        more_left = k < LAW_SLOTS;
    }
    check(bad == 0, "%d combinations of laws, %d bad; at most %d rows of history, room for %d",
          total, bad, rows, HISTORY_MAX);
}

int main(int argc, char **argv)
{
    (void)argc;
    for (int k = 0; k < LAW_SLOTS; k++)
        count[k] = laws_open(argv[0], &law_slots[k], laws[k], MOST);
    each_alone();
    for (int k = 0; k < LAW_SLOTS; k++)
        for (int i = 0; i < count[k]; i++) {
            struct set s = {{NULL}};
            s.law[k] = &laws[k][i];
            start_set(&s, true);
        }
    combinations();
    return check_end();
}
