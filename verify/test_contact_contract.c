/* verify/test_contact_contract.c - what every answer of contact/ must obey: no force without
 * overlap, no pull, the same force in every lane, a rotated pair feels the rotated force, and
 * no energy made by springs, dashpots and sliders over closed paths. */
#include "answers.h"
#include "../contact/contact.h"

struct law {
    void (*init)(struct scene *, const struct materials *);
    void (*forces)(struct touch *, real (*)[TOUCH]);
    const struct key *keys;
    const int *history;
};

/* A value for a key that a law demands, whatever the law: moduli and stiffnesses by their unit,
 * pure numbers within their interval. */
static const char *plausible(const struct key *k)
{
    if (strcmp(k->name, "poisson") == 0)
        return "0.27";
    if (strcmp(k->unit, "Pa") == 0)
        return "3.7e7 Pa";
    if (strcmp(k->unit, "N m-1") == 0)
        return "2.9e4 N/m";
    return "0.61";
}

static struct law start(void *answer, const char *restitution)
{
    struct law law = {0};
    answers_symbol(answer, "contact_init", &law.init, sizeof law.init);
    answers_symbol(answer, "contact_forces", &law.forces, sizeof law.forces);
    answers_symbol(answer, "contact_keys", &law.keys, sizeof law.keys);
    answers_symbol(answer, "contact_history", &law.history, sizeof law.history);
    char *set[64];
    int n = 0;
    for (const struct key *k = law.keys; k->section && n < 64; k++)
        if (strcmp(k->section, "material") == 0 &&
            (!k->standard || strcmp(k->name, "restitution") == 0))
            set[n++] =
                xprintf("material m.%s=%s", k->name,
                        strcmp(k->name, "restitution") == 0 ? restitution : plausible(k));
    struct scene *const scene = scene_load(NULL, n, set);
    const char *const name = "m";
    scene_declare(scene, law.keys);
    law.init(scene, &(struct materials){.n = 1, .name = &name});
    check(scene_errors(scene) == 0, "parameters are accepted");
    scene_free(scene);
    for (int i = 0; i < n; i++)
        xfree(set[i]);
    return law;
}

static void put(struct touch *t, int c, double depth, vec3 n, vec3 v)
{
    t->pair[c] = 0;
    t->depth[c] = depth;
    t->r_i[c] = 3.1e-3;
    t->r_j[c] = 4.7e-3;
    t->r_eff[c] = 3.1e-3 * 4.7e-3 / 7.8e-3;
    t->m_eff[c] = 1.7e-4;
    t->nx[c] = n.x;
    t->ny[c] = n.y;
    t->nz[c] = n.z;
    t->vx[c] = v.x;
    t->vy[c] = v.y;
    t->vz[c] = v.z;
    t->vn[c] = v3_dot(n, v);
    t->start[c] = 1.0;
    t->wx[c] = t->wy[c] = t->wz[c] = 0.0;
}

static vec3 force(const struct touch *t, int c)
{
    return v3(t->fx[c], t->fy[c], t->fz[c]);
}

/* A rotation that moves every axis. */
static vec3 turn(vec3 a)
{
    static const double m[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
    return v3(m[0][0] * a.x + m[0][1] * a.y + m[0][2] * a.z,
              m[1][0] * a.x + m[1][1] * a.y + m[1][2] * a.z,
              m[2][0] * a.x + m[2][1] * a.y + m[2][2] * a.z);
}

static void check_no_pull(const struct law *law, const char *name)
{
    static struct touch t;
    static real h[HISTORY_MAX][TOUCH];
    memset(h, 0, sizeof h);
    t.n = TOUCH;
    t.dt = 1e-7;
    double pull = 0.0, apart = 0.0;
    for (int c = 0; c < TOUCH; c++)
        put(&t, c, (c % 2 ? 1.0 : -1.0) * 1e-5 * (1 + c % 7), v3(0.6, 0.0, 0.8),
            v3(0.3 * (c % 5 - 2), 0.1 * (c % 3 - 1), 1.9 * (c % 11 - 5)));
    law->forces(&t, h);
    for (int c = 0; c < TOUCH; c++) {
        pull = fmin(pull, v3_dot(force(&t, c), v3(0.6, 0.0, 0.8)));
        if (t.depth[c] <= 0.0)
            apart = fmax(apart, v3_norm(force(&t, c)) + fabs(t.fn[c]));
    }
    check(apart == 0.0, "%s: no force without overlap (%g N)", name, apart);
    check(pull >= -1e-12, "%s: never pulls (%g N)", name, pull);
}

/* Lane 0 and the last hold one pair, lane 1 the same pair rotated; a path of 400 steps. */
static void check_frame(const struct law *law, const char *name)
{
    static struct touch t;
    static real h[HISTORY_MAX][TOUCH];
    memset(h, 0, sizeof h);
    t.n = TOUCH;
    t.dt = 1e-6;
    double off = 0.0, largest = 0.0;
    bool lanes = true;
    for (int step = 0; step < 400; step++) {
        const double a = 0.02 * step;
        const vec3 n = v3(cos(0.1 * a), 0.0, sin(0.1 * a));
        const vec3 v = v3(0.11 * sin(a), 0.23 * cos(1.7 * a), -0.17 * sin(2.3 * a));
        const double depth = 2e-5 * (1.0 + 0.7 * sin(3.1 * a));
        for (int c = 0; c < t.n; c++)
            put(&t, c, depth, c == 1 ? turn(n) : n, c == 1 ? turn(v) : v);
        law->forces(&t, h);
        off = fmax(off, v3_norm(v3_sub(force(&t, 1), turn(force(&t, 0)))));
        largest = fmax(largest, v3_norm(force(&t, 0)));
        lanes = lanes && memcmp(&t.fx[0], &t.fx[TOUCH - 1], sizeof(double)) == 0 &&
                memcmp(&t.fz[0], &t.fz[TOUCH - 1], sizeof(double)) == 0;
    }
    check(off <= 1e-11 * largest, "%s: the rotated pair feels the rotated force (%g of %g N)",
          name, off, largest);
    check(lanes, "%s: every lane computes the same bits", name);
}

/* Work done by the contact over closed paths: pressed, sheared, released. It must not be
 * positive beyond the error of the step. */
static void check_energy(const struct law *law, const char *name, double shear, double phase)
{
    static struct touch t;
    static real h[HISTORY_MAX][TOUCH];
    memset(h, 0, sizeof h);
    t.n = 1;
    t.dt = 1e-7;
    const int steps = 20000;
    double work = 0.0, size = 0.0;
    for (int k = 0; k < steps; k++) {
        const double a = 2.0 * PI * k / steps, rate = 2.0 * PI / (steps * t.dt);
        const double depth = 2e-5 * (1.0 - cos(a)) - 1e-6;
        const vec3 v = v3(shear * rate * sin(2.0 * a + phase), 0.0, -2e-5 * rate * sin(a));
        put(&t, 0, depth, v3(0.0, 0.0, 1.0), v);
        law->forces(&t, h);
        if (depth <= 0.0)
            memset(h, 0, sizeof h);
        const double power = v3_dot(force(&t, 0), v) * t.dt;
        work += power;
        size += fabs(power);
    }
    check(work <= 2e-4 * size, "%s: a closed path (shear %g m) makes no energy: %.3g of %.3g J",
          name, shear, work, size);
}

static void visit(const char *name, void *answer)
{
    struct law law = start(answer, "0.61");
    check_no_pull(&law, name);
    check_frame(&law, name);
    check_energy(&law, name, 1e-6, 0.3);
    check_energy(&law, name, 5e-5, 1.1);
    law = start(answer, "1");
    check_energy(&law, name, 0.0, 0.0);
    check_energy(&law, name, 1e-6, 0.0);
    check_energy(&law, name, 1e-6, 2.1);
    check_energy(&law, name, 3e-5, 0.7);
}

int main(int argc, char **argv)
{
    (void)argc;
    answers_visit(argv[0], "contact", visit);
    return check_end();
}
