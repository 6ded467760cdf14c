/* verify/test_forces.c - every answer of forces/ by itself.
 *
 * Contract of all: finite; turns with the frame; nothing where the grain moves and spins with the fluid
 * (but for thermal agitation, which is recognised by its depending on the step); a torque's rate is
 * positive; opposite slip, opposite force. By name: published values and limits. */
#include <stdint.h>
#include "../forces/force.h"
#include "answers.h"
#include "csv.h"

static const struct force *load(const char *name, void *object)
{
    const struct force *force = NULL;
    char symbol[128];
    snprintf(symbol, sizeof symbol, "force_%s", name);
    return answers_symbol(object, symbol, &force, sizeof force) ? force : NULL;
}

static void read_keys(const struct force *f, char *override)
{
    struct scene *const s = scene_load(NULL, override ? 1 : 0, &override);
    scene_declare(s, f->keys);
    if (f->read)
        f->read(s);
    scene_free(s);
}

static struct force_view sample(void)
{
    return (struct force_view){.d = 0.731e-3,
                               .mass = 5.3e-7,
                               .rho = 913.0,
                               .mu = 2.37e-3,
                               .eps = 0.83,
                               .dt = 3.1e-4,
                               .slip = v3(0.0213, -0.0471, 0.0137),
                               .curl = v3(11.3, -7.1, 23.9),
                               .spin = v3(-3.7, 17.3, 5.9),
                               .id = 4711,
                               .step = 1303,
                               .seed = 17};
}

/* A rotation about (1, 2, 3) by some angle. */
static vec3 turned(vec3 a)
{
    const double w = 0.839, c = cos(w), s = sin(w);
    const vec3 n = v3_scale(1.0 / sqrt(14.0), v3(1.0, 2.0, 3.0));
    return v3_add(v3_axpy(v3_scale(c, a), s, v3_cross(n, a)),
                  v3_scale((1.0 - c) * v3_dot(n, a), n));
}

static void test_contract(const struct force *f)
{
    const char *const name = f->about.name;
    struct force_view v = sample(), other = v;
    if (f->spin_rate) {
        bool good = true;
        for (int k = -30; k <= 30; k++) {
            v.spin = v3_scale(pow(10.0, 0.2 * k), v3(0.6, 0.8, 0.0));
            good = good && isfinite(f->spin_rate(&v)) && f->spin_rate(&v) > 0.0;
        }
        v.spin = v3_scale(0.5, v.curl);
        check(good && f->spin_rate(&v) > 0.0, "%s: rate of the torque finite and positive",
              name);
    }
    if (f->added_mass)
        check(f->added_mass() >= 0.0, "%s: added mass %g", name, f->added_mass());
    if (!f->act)
        return;
    v = sample();
    other.step++;
    const vec3 force = f->act(&v);
    const bool thermal = v3_norm(v3_sub(f->act(&other), force)) > 0.0;
    check(isfinite(v3_norm(force)) && v3_norm(force) > 0.0, "%s: %.3g N", name, v3_norm(force));
    other = v;
    other.slip = v3(0.0, 0.0, 0.0);
    other.spin = v3_scale(0.5, v.curl);
    check(thermal || v3_norm(f->act(&other)) == 0.0, "%s: nothing where nothing is relative",
          name);
    other = v;
    other.slip = turned(v.slip);
    other.curl = turned(v.curl);
    other.spin = turned(v.spin);
    check(thermal || v3_norm(v3_sub(f->act(&other), turned(force))) < 1e-13 * v3_norm(force),
          "%s: turns with the frame", name);
    other = v;
    other.slip = v3_scale(-1.0, v.slip);
    check(thermal || v3_norm(v3_add(f->act(&other), force)) < 1e-14 * v3_norm(force),
          "%s: opposite slip, opposite force", name);
    other = v;
    other.curl = other.spin = v3(0.0, 0.0, 0.0);
    check(thermal || v3_norm(f->act(&other)) == 0.0, "%s: no lift without shear and spin",
          name);
}

/* The published form of 1965 is in the radius: 6.46 mu a^2 U sqrt(shear/nu), towards the faster fluid
 * for a grain that lags. */
static void test_saffman(const struct force *f)
{
    char limit[] = "forces.saffman=saffman";
    struct force_view v = sample();
    const double shear = 37.1, U = 1.3e-3, a = 0.5 * v.d;
    v.slip = v3(U, 0.0, 0.0);      /* it lags in x */
    v.curl = v3(0.0, 0.0, -shear); /* u = shear y */
    const double want = 6.46 * v.mu * a * a * U * sqrt(shear * v.rho / v.mu);
    read_keys(f, limit);
    check_rel(f->act(&v).y, want, 1e-14, "Saffman's lift, towards the faster fluid, N");
    read_keys(f, NULL);
    v.slip = v3_scale(1e-6, v.slip);
    const double re = v.rho * v.d * 1e-6 * U / v.mu, b = 0.5 * v.d * shear / (1e-6 * U);
    const double c = (1.0 - 0.3314 * sqrt(b)) * exp(-re / 10.0) + 0.3314 * sqrt(b);
    check_rel(f->act(&v).y, 1e-6 * want * c, 1e-13, "Mei's correction, small Re");
    check_abs(c, 1.0, 2e-3, "  which is 1 there");
    v.slip = v3(0.31, 0.0, 0.0);
    const double re2 = v.rho * v.d * 0.31 / v.mu, b2 = 0.5 * v.d * shear / 0.31;
    check_rel(f->act(&v).y, want / U * 0.31 * 0.0524 * sqrt(b2 * re2), 1e-13, "Mei, Re = 87");
    /* asymptotic theory, small Re, strong shear: J = 2.255 - 0.6463/e^2, e^2 = 2 b/Re, over Saffman's
     * 2.255 (6.46 = 9/pi 2.255) [McLaughlin91] */
    check_rel(4.0 * 1.615, 9.0 / PI * 2.255, 1e-4, "Saffman's coefficient is 9/pi J");
    static const double point[][2] = {{0.02, 0.4}, {0.05, 0.4}, {0.1, 0.4}, {0.05, 0.2}};
    for (int k = 0; k < 4; k++) {
        const double re_k = point[k][0], b_k = point[k][1];
        v.slip.x = re_k * v.mu / (v.rho * v.d);
        v.curl.z = -2.0 * b_k * v.slip.x / v.d;
        const double limit_k = 6.46 * v.mu * a * a * v.slip.x * sqrt(-v.curl.z * v.rho / v.mu);
        char *const what = xprintf("Mei, Re = %g, b = %g, against McLaughlin's J", re_k, b_k);
        check_rel(f->act(&v).y / limit_k, 1.0 - 0.6463 / 2.255 * re_k / (2.0 * b_k), 0.04,
                  what);
        xfree(what);
    }
    v.curl.z = -shear;
    double jump[2];
    for (int k = 0; k < 2; k++) {
        v.slip.x = 40.0 * (k ? 1.0 + 1e-12 : 1.0 - 1e-12) * v.mu / (v.rho * v.d);
        jump[k] = f->act(&v).y;
    }
    printf("    Mei's fit jumps by %.1f %% at Re = 40\n", 100.0 * (jump[1] / jump[0] - 1.0));
}

static void test_magnus(const struct force *f)
{
    char limit[] = "forces.magnus=rubinow_keller";
    struct force_view v = sample();
    v.curl = v3(0.0, 0.0, 0.0);
    v.slip = v3(-0.0021, 0.0, 0.0); /* it flies along +x */
    v.spin = v3(0.0, -41.0, 0.0);   /* its top turns backwards */
    const double a = 0.5 * v.d, want = PI * a * a * a * v.rho * 41.0 * 0.0021;
    read_keys(f, limit);
    check_rel(f->act(&v).z, want, 1e-14,
              "Rubinow and Keller: pi a^3 rho omega V, back-spin rises");
    read_keys(f, NULL);
    v.slip = v3_scale(1e-12, v.slip);
    check_rel(f->act(&v).z, 1e-12 * want, 1e-3, "Oesterle and Dinh tend to it");
    /* their own variables: the spin ratio a omega/V and Re, exponent 0.075 */
    const double re = 63.0, ratio = 2.7;
    v.slip = v3(-re * v.mu / (v.rho * v.d), 0.0, 0.0);
    v.spin = v3(0.0, ratio * v.slip.x / a, 0.0);
    const double lift =
        0.45 + (2.0 * ratio - 0.45) * exp(-0.075 * pow(ratio, 0.4) * pow(re, 0.7));
    const double size = 0.5 * v.rho * v.slip.x * v.slip.x * PI * a * a;
    check_rel(f->act(&v).z, lift * size, 5e-5, "Oesterle and Dinh, Re = 63, spin ratio 2.7");
}

/* Against solutions of the flow about a spinning sphere: from R = 20 on, where the fit of Dennis, Singh
 * and Ingham holds, to 0.3 %; below, where the law goes from the creeping form to the fit, to 5 %. */
static void test_torque_table(const struct force *f)
{
    struct force_view v = sample();
    const double a = 0.5 * v.d;
    const struct csv *const t = csv_read("rotating_sphere.csv");
    v.curl = v3(0.0, 0.0, 0.0);
    for (int i = 0; i < t->n; i++) {
        const double R = csv_value(t, i, "R"), w = R * v.mu / (v.rho * a * a);
        v.spin = v3_scale(w, v3(0.48, -0.6, 0.64));
        char *const what = xprintf("torque of a sphere spinning with R = %g", R);
        check_rel(f->spin_rate(&v) / (8.0 * PI * v.mu * a * a * a), csv_value(t, i, "torque"),
                  R < 20.0 ? 0.05 : 3e-3, what);
        xfree(what);
    }
}

static void test_viscous_torque(const struct force *f)
{
    test_torque_table(f);
    struct force_view v = sample();
    const double a = 0.5 * v.d;
    v.curl = v3(0.0, 0.0, 0.0);
    v.spin = v3(0.0, 0.0, 0.013);
    check_rel(f->spin_rate(&v), 8.0 * PI * v.mu * a * a * a, 1e-14, "8 pi mu a^3, N m s");
    /* Dennis, Singh and Ingham on the radius: R = rho a^2 w/mu, M = 6.45/sqrt(R) + 32.1/R */
    const double R[] = {10.0, 100.0, 900.0};
    for (int k = 0; k < 3; k++) {
        const double w = R[k] * v.mu / (v.rho * a * a), M = 6.45 / sqrt(R[k]) + 32.1 / R[k];
        v.spin = v3(0.0, w, 0.0);
        check_rel(f->spin_rate(&v) * w, 0.5 * v.rho * pow(a, 5) * w * w * M, 1e-12,
                  "  torque at higher spin");
    }
}

/* Known answers of Philox 4x32-10, from its authors' table, through Box and Muller. */
static void test_brownian(const struct force *f)
{
    char kelvin[] = "forces.temperature=311.7 K";
    static const struct {
        uint64_t id, step, seed;
        uint32_t word[4];
    } known[] = {{0, 0, 0, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
                 {UINT64_C(0x05a308d3243f6a88) | UINT64_C(0x8000000000000000),
                  UINT64_C(0x0370734413198a2e),
                  UINT64_C(0x299f31d0a4093822),
                  {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}}};
    struct force_view v = sample();
    const double size = sqrt(6.0 * PI * v.mu * v.d * 1.380649e-23 * 311.7 / v.dt);
    read_keys(f, kelvin);
    for (int k = 0; k < 2; k++) {
        double u[4];
        for (int i = 0; i < 4; i++)
            u[i] = (known[k].word[i] + 0.5) / 4294967296.0;
        v.id = (long)known[k].id;
        v.step = (long)known[k].step;
        v.seed = known[k].seed;
        const vec3 got = f->act(&v);
        const double r = size * sqrt(-2.0 * log(u[0])), q = size * sqrt(-2.0 * log(u[2]));
        check_rel(got.x, r * cos(2.0 * PI * u[1]), 1e-13, "a known answer of Philox, x");
        check_rel(got.y, r * sin(2.0 * PI * u[1]), 1e-13, "  y");
        check_rel(got.z, q * cos(2.0 * PI * u[3]), 1e-13, "  z");
    }
    enum { N = 200000 };
    double mean = 0.0, square = 0.0, fourth = 0.0, next = 0.0, beside = 0.0;
    v = sample();
    for (int i = 0; i < N; i++) {
        v.id = i % 500;
        v.step = i / 500;
        const vec3 a = v3_scale(1.0 / size, f->act(&v));
        v.step++;
        const vec3 b = v3_scale(1.0 / size, f->act(&v));
        mean += (a.x + a.y + a.z) / (3.0 * N);
        square += v3_dot(a, a) / (3.0 * N);
        fourth += (pow(a.x, 4) + pow(a.y, 4) + pow(a.z, 4)) / (3.0 * N);
        next += v3_dot(a, b) / (3.0 * N);
        beside += (a.x * a.y + a.y * a.z + a.z * a.x) / (3.0 * N);
    }
    const double sigma = 1.0 / sqrt(3.0 * N);
    check_abs(mean, 0.0, 4.0 * sigma, "mean");
    check_abs(square, 1.0, 4.0 * sqrt(2.0) * sigma, "variance");
    check_abs(fourth, 3.0, 4.0 * sqrt(96.0) * sigma, "fourth moment");
    check_abs(next, 0.0, 4.0 * sigma, "correlation from step to step");
    check_abs(beside, 0.0, 4.0 * sigma, "correlation of components");
}

static void visit(const char *name, void *object)
{
    static const struct {
        const char *name;
        void (*test)(const struct force *f);
    } special[] = {{"saffman", test_saffman},
                   {"magnus", test_magnus},
                   {"viscous_torque", test_viscous_torque},
                   {"brownian", test_brownian}};
    const struct force *const f = load(name, object);
    if (!f)
        return;
    check(strcmp(f->about.name, name) == 0, "%s: its name is its file's", name);
    check(f->act || f->added_mass || f->spin_rate || f->of_pressure != 0.0 ||
              f->of_viscous != 0.0 || f->of_weight != 0.0,
          "%s does something", name);
    for (const char *word = strstr(FORCES_STANDARD, name); word; word = NULL)
        check(!f->act && !f->returned, "%s: a standard force, that the fluid's equation holds",
              name);
    read_keys(f, NULL);
    test_contract(f);
    for (size_t i = 0; i < sizeof special / sizeof special[0]; i++)
        if (strcmp(special[i].name, name) == 0)
            special[i].test(f);
}

int main(int argc, char **argv)
{
    (void)argc;
    answers_visit(argv[0], "forces", visit);
    return check_end();
}
