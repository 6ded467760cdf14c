/* verify/test_law_values.c - each law of contact, rolling, cohesion, lubrication and bonds at single
 * values: the published formula evaluated here once more, and the tables of verify/reference. */
#include "laws.h"

static const char *program;
static struct touch t;
static real h[HISTORY_MAX][TOUCH];

/* The answer of a slot, started with these keys besides plausible ones; the memory is cleared. */
static struct law get(const char *slot, const char *name, const char *const *extra)
{
    static struct law laws[32];
    for (int k = 0; k < LAW_SLOTS; k++) {
        if (strcmp(law_slots[k].name, slot) != 0)
            continue;
        const int n = laws_open(program, &law_slots[k], laws, 32);
        for (int i = 0; i < n; i++)
            if (strcmp(laws[i].about->name, name) == 0) {
                law_start(&laws[i], 1, extra);
                memset(h, 0, sizeof h);
                return laws[i];
            }
    }
    check(false, "%s = %s is missing", slot, name);
    return (struct law){0};
}

/* One contact in every lane. */
static void put(struct law_pair p)
{
    t.n = TOUCH_LANES;
    for (int c = 0; c < TOUCH_LANES; c++)
        law_put(&t, c, &p);
}

static struct law_pair pair(double depth, vec3 v)
{
    return (struct law_pair){.r_i = 3.17e-3,
                             .r_j = 5.29e-3,
                             .m_i = 2.3e-4,
                             .m_j = 7.9e-4,
                             .depth = depth,
                             .n = v3(0.0, 0.6, 0.8),
                             .v = v};
}

static const double r_eff = 3.17e-3 * 5.29e-3 / 8.46e-3, m_eff = 2.3e-4 * 7.9e-4 / 10.2e-4;
static const vec3 normal = {0.0, 0.6, 0.8}, side = {1.0, 0.0, 0.0};

#define YOUNG   3.7e7
#define POISSON 0.27

static double e_star(void)
{
    return YOUNG / (2.0 * (1.0 - POISSON * POISSON));
}

static double g_star(void)
{
    return YOUNG / (4.0 * (2.0 - POISSON) * (1.0 + POISSON));
}

/* One step of a Hertz law: normal force with its dashpot, the first tangential increment. */
static void check_hertz_family(const char *name)
{
    static const char *const extra[] = {"material a.restitution=none",
                                        "material a.damping_ratio=0.213", NULL};
    static const char *const slippery[] = {"material a.restitution=none",
                                           "material a.damping_ratio=0.213",
                                           "material a.friction=0.417", NULL};
    const bool tangential = strcmp(name, "hertz") != 0;
    const struct law l = get("contact", name, tangential ? slippery : extra);
    const double depth = 2.385e-5, vn = -0.0173, vt = 0.00931, dt = 1.7e-6;
    t.dt = dt;
    put(pair(depth, v3_add(v3_scale(vn, normal), v3_scale(vt, side))));
    l.forces(&t, h);
    const double a = sqrt(r_eff * depth), zeta = 0.213;
    const double elastic = 4.0 / 3.0 * e_star() * a * depth;
    const double fn =
        elastic - 2.0 * sqrt(5.0 / 6.0) * zeta * sqrt(2.0 * e_star() * a * m_eff) * vn;
    const double tsuji = elastic - sqrt(5.0) * zeta *
                                       sqrt(m_eff * 4.0 / 3.0 * e_star() * sqrt(r_eff)) *
                                       pow(depth, 0.25) * vn;
    char *const text = xprintf("%s: normal force, N", name);
    check_rel(v3_dot(law_force(&t, 0), normal), fn, 1e-12, text);
    check_rel(fn, tsuji, 1e-12, "Tsuji's form of it");
    xfree(text);
    if (strcmp(name, "hertz_mindlin") == 0) {
        const double kt = 8.0 * g_star() * a;
        check_rel(v3_dot(law_force(&t, 0), side),
                  -kt * vt * dt - 2.0 * sqrt(5.0 / 6.0) * zeta * sqrt(kt * m_eff) * vt, 1e-12,
                  "hertz_mindlin: first tangential force, N");
    }
    if (strcmp(name, "hertz_mindlin_liu") != 0)
        return;
    const double mu = 0.417, s_max = mu * depth * (2.0 - POISSON) / (2.0 - 2.0 * POISSON);
    put(pair(depth, v3_scale(0.37 * s_max / dt, side)));
    t.start[0] = 0.0; /* no dashpot */
    memset(h, 0, sizeof h);
    for (int c = 0; c < TOUCH_LANES; c++)
        h[3][c] = (real)depth; /* it does not load */
    l.forces(&t, h);
    check_rel(v3_dot(law_force(&t, 0), side), -mu * elastic * (1.0 - pow(0.63, 1.5)), 1e-12,
              "hertz_mindlin_liu: force at s = 0.37 s_max, N");
    put(pair(depth, v3_scale(0.2 * s_max / dt, side)));
    for (int c = 0; c < TOUCH_LANES; c++) {
        h[0][c] = (real)(0.17 * s_max);
        h[1][c] = h[2][c] = 0.0;
        h[3][c] = (real)depth;
    }
    l.forces(&t, h);
    const double zeta_t = zeta / (2.0 * (1.0 + POISSON));
    const double ct = zeta_t * sqrt(6.0 * mu * m_eff * elastic * sqrt(0.63) / s_max);
    const double asked = mu * elastic * (1.0 - pow(0.63, 1.5)) + ct * 0.2 * s_max / dt;
    check_rel(v3_dot(law_force(&t, 1), side), -fmin(asked, mu * (double)t.fn[1]), 1e-12,
              "hertz_mindlin_liu: with its dashpot, N");
}

static void check_linear(void)
{
    static const char *const extra[] = {"material a.restitution=none",
                                        "material a.damping=0.51 N s/m",
                                        "material a.damping_tangential=0.083 N s/m",
                                        "material a.stiffness=2.9e4 N/m",
                                        "pair a-a.stiffness_ratio=0.31",
                                        "material a.friction=7",
                                        NULL};
    const struct law l = get("contact", "linear", extra);
    const double depth = 2.385e-5, vn = -0.173, vt = 0.931, dt = 1.7e-6;
    t.dt = dt;
    put(pair(depth, v3_add(v3_scale(vn, normal), v3_scale(vt, side))));
    l.forces(&t, h);
    check_rel(v3_dot(law_force(&t, 0), normal), 1.45e4 * depth - 0.51 * vn, 1e-12,
              "linear: two springs in series and a dashpot, N");
    check_rel(v3_dot(law_force(&t, 0), side), -0.31 * 1.45e4 * vt * dt - 0.083 * vt, 1e-12,
              "linear: tangential, N");
}

/* One step of a rolling law under fn, kn as given: torque over relative spin. */
static void roll(const struct law *l, vec3 w_i, vec3 w_j, double fn, double kn)
{
    struct law_pair p = pair(2.385e-5, v3(0, 0, 0));
    p.spin_i = w_i;
    p.spin_j = w_j;
    put(p);
    for (int c = 0; c < TOUCH_LANES; c++) {
        t.fn[c] = (real)fn;
        t.kn[c] = (real)kn;
    }
    l->forces(&t, h);
}

static void check_rolling(void)
{
    const double fn = 0.0317, kn = 2.11e4, dt = 1.3e-7;
    const double inertia = 1.0 / (1.0 / (1.4 * 2.3e-4 * 3.17e-3 * 3.17e-3) +
                                  1.0 / (1.4 * 7.9e-4 * 5.29e-3 * 5.29e-3));
    const vec3 wi = v3(1.7, 0, 0), wj = v3(-0.43, 0, 0);
    t.dt = dt;
    struct law l = get("rolling", "constant_torque",
                       (const char *const[]){"material a.rolling_friction=0.0713", NULL});
    roll(&l, wi, wj, fn, kn);
    check_rel((double)t.mx[0], -0.0713 * r_eff * fn, 1e-12, "constant_torque: M, N m");
    l = get("rolling", "constant_torque",
            (const char *const[]){"material a.rolling_friction=0.0713", "rolling.form=weighted",
                                  NULL});
    roll(&l, wi, wj, fn, kn);
    check_rel((double)t.mx[0], -0.0713 * r_eff * kn * 2.385e-5, 1e-12,
              "constant_torque, weighted: M, N m");
    l = get("rolling", "viscous",
            (const char *const[]){"material a.rolling_viscosity=0.0831 s/m", NULL});
    roll(&l, wi, wj, fn, kn);
    check_rel((double)t.mx[0], -0.0831 * r_eff * fn * (1.7 * 3.17e-3 + 0.43 * 5.29e-3), 1e-12,
              "viscous: M, N m");
    l = get("rolling", "epsd",
            (const char *const[]){"material a.rolling_friction=0.0713", "rolling.damping=0.27",
                                  NULL});
    const double kr = 2.25 * kn * pow(0.0713 * r_eff, 2.0);
    roll(&l, wi, wj, fn, kn);
    check_rel((double)t.mx[0], -kr * 2.13 * dt - 2.0 * 0.27 * sqrt(inertia * kr) * 2.13, 1e-12,
              "epsd: spring and dashpot, N m");
    for (int k = 0; k < 20000; k++)
        roll(&l, wi, wj, fn, kn);
    check_rel((double)t.mx[0], -0.0713 * r_eff * fn, 1e-12, "epsd: at its limit, N m");
    l = get("rolling", "epsd",
            (const char *const[]){"material a.rolling_friction=0.0713", "rolling.damping=0.27",
                                  "rolling.form=disc", NULL});
    roll(&l, wi, wj, fn, kn);
    check_rel((double)t.mx[0],
              -kr * 3.0 / 2.25 * 2.13 * dt -
                  2.0 * 0.27 * sqrt(inertia * kr * 3.0 / 2.25) * 2.13,
              1e-12, "epsd, discs: spring and dashpot, N m");
    l = get("rolling", "matter",
            (const char *const[]){"material a.rolling_friction=0.0713",
                                  "material a.torsion_friction=0.0291",
                                  "material a.rolling_stiffness=0.0017 N m",
                                  "material a.torsion_stiffness=0.0007 N m", NULL});
    const vec3 turning = v3_add(wi, v3_scale(3.1, normal));
    roll(&l, turning, wj, fn, kn);
    check_rel((double)t.mx[0], -0.0017 * 2.13 * dt, 1e-12, "matter: rolling spring, N m");
    check_rel(v3_dot(law_moment(&t, 0), normal), -0.0007 * 3.1 * dt, 1e-12,
              "matter: torsion spring, N m");
    for (int k = 0; k < 200000; k++)
        roll(&l, turning, wj, fn, kn);
    check_rel((double)t.mx[0], -0.0713 * r_eff * fn, 1e-12, "matter: rolling limit, N m");
    check_rel(v3_dot(law_moment(&t, 0), normal), -0.0291 * r_eff * fn, 1e-12,
              "matter: torsion limit, N m");
    l = get("rolling", "jiang",
            (const char *const[]){"material a.shape_parameter=0.213", "material a.crushing=1.9",
                                  "material a.friction=0.47", "rolling.damping=0",
                                  "rolling.shear_ratio=0.71", NULL});
    const double radius = 0.213 * 2.0 * r_eff;
    roll(&l, turning, wj, fn, kn);
    check_rel((double)t.mx[0], -0.25 * kn * radius * radius * 2.13 * dt, 1e-12,
              "jiang: rolling spring, N m");
    check_rel(v3_dot(law_moment(&t, 0), normal), -0.5 * 0.71 * kn * radius * radius * 3.1 * dt,
              1e-12, "jiang: twist, N m");
    for (int k = 0; k < 20000; k++)
        roll(&l, turning, wj, fn, kn);
    check_rel((double)t.mx[0], -0.25 * 1.9 * fn * radius, 1e-12, "jiang: rolling limit, N m");
    check_rel(v3_dot(law_moment(&t, 0), normal), -0.65 * 0.47 * fn * radius, 1e-12,
              "jiang: twisting limit, N m");
    l = get("rolling", "jiang",
            (const char *const[]){"material a.shape_parameter=0.213", "rolling.form=disc",
                                  "material a.friction=0.47", "rolling.damping=0", NULL});
    roll(&l, turning, wj, fn, kn);
    check_rel((double)t.mx[0], -kn * radius * radius / 12.0 * 2.13 * dt, 1e-12,
              "jiang, discs: rolling spring over the width, N m");
    check_abs(v3_dot(law_moment(&t, 0), normal), 0.0, 1e-25, "jiang, discs: no twist, N m");
    for (int k = 0; k < 20000; k++)
        roll(&l, turning, wj, fn, kn);
    check_rel((double)t.mx[0], -fn * radius / 6.0, 1e-12, "jiang, discs: rolling limit, N m");
}

/* Rows "x,y,..." of a file of verify/reference; comments and the line of names are skipped. */
static int rows(const char *name, double (*row)[3], int most)
{
    char *const path = xprintf("verify/reference/%s", name);
    FILE *const file = fopen(path, "r");
    char line[1024];
    int n = 0;
    while (file && n < most && fgets(line, sizeof line, file)) {
        const int got = sscanf(line, "%lf,%lf,%lf", &row[n][0], &row[n][1], &row[n][2]);
        n += got >= 2;
    }
    if (file)
        fclose(file);
    check(n > 5, "%s: %d rows", path, n);
    xfree(path);
    return n;
}

/* Force beyond Hertz, plus Hertz, at contact radius a of the branch; and the whole table. */
static void check_jkr(void)
{
    static double row[64][3];
    const double w = 0.17, e = e_star(), unit = pow(w * w * r_eff / (e * e), 1.0 / 3.0);
    const struct law l =
        get("cohesion", "jkr",
            (const char *const[]){"material a.work_of_adhesion=0.17 J/m2", NULL});
    const int n = rows("jkr.csv", row, 64);
    double worst = 0.0, formula = 0.0, energy = 0.0, before = 0.0, was = 0.0;
    int on_branch = 0;
    for (int i = 0; i < n; i++) {
        const double x = row[i][0], a = x * pow(w * r_eff * r_eff / e, 1.0 / 3.0);
        const double depth = a * a / r_eff - sqrt(2.0 * PI * a * w / e);
        const double p = 4.0 * e * a * a * a / (3.0 * r_eff) - sqrt(8.0 * PI * w * e * a) * a;
        for (int c = 0; c < TOUCH_LANES; c++)
            h[0][c] = 1.0; /* joined */
        put(pair(depth, v3(0, 0, 0)));
        l.forces(&t, h);
        const double hertz = 4.0 / 3.0 * e * sqrt(r_eff) * pow(fmax(depth, 0.0), 1.5);
        const double f = v3_dot(law_force(&t, 0), normal) + hertz;
        if (x < 0.7323)
            continue; /* beyond the fold */
        on_branch++;
        formula = fmax(formula, fabs(f - p) / (w * r_eff));
        worst = fmax(worst, fabs(f / (w * r_eff) - row[i][1]));
        worst = fmax(worst, fabs(depth / unit - row[i][2]));
    }
    check(on_branch > 30 && formula < 1e-10, "jkr: %d forces off by %.2g w R*, at most 1e-10",
          on_branch, formula);
    check(worst < 1e-6, "jkr: the table's forces and depths within %.2g, at most 1e-6", worst);
    /* pull-off force, detachment, snapping in; energy is the integral of the force */
    double least = 0.0, off = 0.0;
    for (int c = 0; c < TOUCH_LANES; c++)
        h[0][c] = 0.0;
    put(pair(-0.01 * unit, v3(0, 0, 0)));
    l.forces(&t, h);
    check(v3_norm(law_force(&t, 0)) == 0.0, "jkr: nothing before the first touch");
    for (int k = 0; k <= 40000 && off == 0.0; k++) {
        const double depth = (1.0 - 1e-4 * k) * unit;
        put(pair(depth, v3(0, 0, 0)));
        l.forces(&t, h);
        const double hertz = 4.0 / 3.0 * e * sqrt(r_eff) * pow(fmax(depth, 0.0), 1.5);
        const double f = v3_dot(law_force(&t, 0), normal) + hertz;
        if (h[0][0] == 0.0)
            off = depth / unit;
        least = fmin(least, f / (w * r_eff));
        l.energy(&t, h);
        if (depth < 0.0 && depth > -1.5 * unit && was != 0.0)
            energy = fmax(energy,
                          fabs((double)t.energy[0] - was + 0.5 * (f + before) * 1e-4 * unit) /
                              (w * r_eff * unit));
        was = (double)t.energy[0];
        before = f;
    }
    check_rel(least, -1.5 * PI, 1e-7, "jkr: pull-off force over w R*");
    check_abs(off, -1.60877205, 1.1e-4,
              "jkr: comes off at this depth over (w^2 R*/E*^2)^(1/3)");
    check(energy < 1e-9, "jkr: energy is the integral of the force (%.2g off)", energy);
}

/* The pull of a pair r_j = 19 um at a gap, of gamma (mN/m), V (1e-19 m3), theta = 10 deg. */
static double bridge(const char *form, double r_i, double gamma, double volume, double gap)
{
    char *const key[3] = {xprintf("material a.surface_tension=%g mN/m", gamma),
                          xprintf("material a.bridge_volume=%ge-19 m3", volume),
                          xprintf("cohesion.form=%s", form)};
    const struct law l = get(
        "cohesion", "capillary",
        (const char *const[]){key[0], key[1], key[2], "material a.contact_angle=10 deg", NULL});
    struct law_pair p = pair(-gap, v3(0, 0, 0));
    p.r_i = r_i;
    p.r_j = 19e-6;
    for (int c = 0; c < TOUCH_LANES; c++)
        h[0][c] = 1.0;
    put(p);
    l.forces(&t, h);
    for (int i = 0; i < 3; i++)
        xfree(key[i]);
    return -v3_dot(law_force(&t, 0), normal);
}

/* What YADE's own check prints (scripts/checks-and-tests, capillary models) for three pairs that have been
 * drawn apart alike: the gap from Willett's force must give Rabinovich's with both terms. */
static void check_yade_bridges(void)
{
    double low = 0.0, high = 1e-6;
    for (int k = 0; k < 60; k++) {
        const double gap = 0.5 * (low + high);
        *(bridge("willett", 32.5e-6, 24.0, 12.0, gap) > 6.78192074e-7 ? &low : &high) = gap;
    }
    check_abs(low, 2.5e-7, 2.5e-9, "capillary: the gap of YADE's check, m (250 steps of 1 nm)");
    /* 5e-4: each pair is slowed by its own pull, so the gaps are not quite alike */
    check_rel(bridge("rabinovich_ring", 27.5e-6, 28.0, 36.0, low), 1.58617796928e-6, 5e-4,
              "capillary, rabinovich_ring: YADE's force at it, N");
    const struct law l = get("cohesion", "capillary",
                             (const char *const[]){"material a.surface_tension=0.0719 N/m",
                                                   "material a.contact_angle=0.37 rad",
                                                   "material a.bridge_volume=1.9e-11 m3",
                                                   "cohesion.form=rabinovich_ring", NULL});
    double energy[2];
    for (int k = 0; k < 2; k++) {
        for (int c = 0; c < TOUCH_LANES; c++)
            h[0][c] = 1.0;
        put(pair(-3.77e-5 - (k ? 1e-8 : -1e-8), v3(0, 0, 0)));
        memset(t.energy, 0, sizeof t.energy);
        l.energy(&t, h);
        energy[k] = t.energy[0];
    }
    put(pair(-3.77e-5, v3(0, 0, 0)));
    l.forces(&t, h);
    check_rel((energy[1] - energy[0]) / 2e-8, -v3_dot(law_force(&t, 0), normal), 1e-6,
              "capillary, rabinovich_ring: its energy rises by the pull, N");
}

static void check_capillary(void)
{
    static double row[64][3];
    static const char *const table[] = {"material a.surface_tension=0.072 N/m",
                                        "material a.bridge_volume=0.01 mm3",
                                        "cohesion.form=rabinovich", NULL};
    struct law l = get("cohesion", "capillary", table);
    const int n = rows("capillary.csv", row, 64);
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        struct law_pair p = pair(-row[i][0], v3(0, 0, 0));
        p.r_i = p.r_j = 1e-3;
        for (int c = 0; c < TOUCH_LANES; c++)
            h[0][c] = 1.0;
        put(p);
        l.forces(&t, h);
        const double rupture = pow(1e-11, 1.0 / 3.0);
        const double want = row[i][0] <= rupture ? row[i][1] : 0.0;
        worst = fmax(worst, fabs(-v3_dot(law_force(&t, 0), normal) - want));
    }
    check(worst < 1e-11, "capillary, rabinovich: the table within %.2g N, at most 1e-11",
          worst);
    check_yade_bridges();
    l = get("cohesion", "capillary",
            (const char *const[]){"material a.surface_tension=0.0719 N/m",
                                  "material a.contact_angle=0.37 rad",
                                  "material a.bridge_volume=1.9e-11 m3", NULL});
    const double gap = 3.77e-5, r = 2.0 * r_eff, s = gap * sqrt(r / 1.9e-11);
    put(pair(-gap, v3(0, 0, 0)));
    l.forces(&t, h);
    check(v3_norm(law_force(&t, 0)) == 0.0, "capillary: no bridge before the first touch");
    put(pair(1e-9, v3(0, 0, 0)));
    l.forces(&t, h);
    check_rel(-v3_dot(law_force(&t, 0), normal), 2.0 * PI * r * 0.0719 * cos(0.37), 1e-12,
              "capillary: in touch, N");
    put(pair(-gap, v3(0, 0, 0)));
    l.forces(&t, h);
    check_rel(-v3_dot(law_force(&t, 0), normal),
              2.0 * PI * r * 0.0719 * cos(0.37) / (1.0 + 1.05 * s + 2.5 * s * s), 1e-12,
              "capillary, willett: across a gap, N");
    const double rupture = (1.0 + 0.185) * cbrt(1.9e-11);
    check_rel(l.range(), rupture, 1e-12, "capillary: rupture distance, m");
    put(pair(-1.001 * rupture, v3(0, 0, 0)));
    l.forces(&t, h);
    put(pair(-gap, v3(0, 0, 0)));
    l.forces(&t, h);
    check(v3_norm(law_force(&t, 0)) == 0.0, "capillary: ruptured, it does not come back");
}

static void check_van_der_waals(void)
{
    const struct law l = get("cohesion", "van_der_waals",
                             (const char *const[]){"material a.hamaker=7.3e-20 J",
                                                   "cohesion.separation_min=0.4 nm",
                                                   "cohesion.range=83 nm", NULL});
    put(pair(-3.17e-9, v3(0, 0, 0)));
    l.forces(&t, h);
    check_rel(-v3_dot(law_force(&t, 0), normal), 7.3e-20 * r_eff / (6.0 * 3.17e-9 * 3.17e-9),
              1e-12, "van_der_waals: across a gap, N");
    put(pair(1e-7, v3(0, 0, 0)));
    l.forces(&t, h);
    check_rel(-v3_dot(law_force(&t, 0), normal), 7.3e-20 * r_eff / (6.0 * 0.4e-9 * 0.4e-9),
              1e-12, "van_der_waals: in touch, N");
    put(pair(-83.1e-9, v3(0, 0, 0)));
    l.forces(&t, h);
    check(v3_norm(law_force(&t, 0)) == 0.0, "van_der_waals: nothing beyond the range");
}

/* Against Jeffrey and Onishi's functions for unequal spheres and Goldman's for a plane. */
static void check_lubrication(void)
{
    const double mu = 0.0173, gap = 7.1e-6, range = 6.3e-4, log_gap = log(range / gap);
    const struct law l =
        get("lubrication", "squeeze",
            (const char *const[]){"fluid.viscosity=0.0173 Pa s", "lubrication.gap_min=1 um",
                                  "lubrication.range=0.63 mm", NULL});
    const double a = 3.17e-3, beta = 5.29 / 3.17, b1 = 1.0 + beta;
    t.dt = 1e-15; /* no bound */
    put(pair(-gap, v3_scale(0.31, normal)));
    l.forces(&t, h);
    const double g1 = beta * beta / (b1 * b1),
                 g2 = beta * (1.0 + 7.0 * beta + beta * beta) / (5.0 * b1 * b1 * b1);
    check_rel(v3_dot(law_force(&t, 0), normal),
              -6.0 * PI * mu * a * (g1 * (a / gap - a / range) + g2 * log_gap) * 0.31, 1e-9,
              "squeeze: X^A of unequal spheres, N");
    put(pair(-gap, v3_scale(0.31, side)));
    l.forces(&t, h);
    const double y = 4.0 / 15.0 * beta * (2.0 + beta + 2.0 * beta * beta) / (b1 * b1 * b1);
    check_rel((double)t.fx[0], -6.0 * PI * mu * a * y * log_gap * 0.31, 1e-9,
              "squeeze: Y^A of unequal spheres, N");
    struct law_pair p = pair(-gap, v3_scale(0.31, side));
    p.r_j = 0.0;
    p.m_j = 0.0;
    put(p);
    l.forces(&t, h);
    const double scale = 6.0 * PI * mu * a * log_gap;
    /* torque about the centre: couple and the lever of the force, -a n x F */
    const vec3 torque =
        v3_add(law_moment(&t, 0), v3_cross(v3_scale(-a, normal), law_force(&t, 0)));
    check_rel((double)t.fx[0], -8.0 / 15.0 * scale * 0.31, 1e-9,
              "squeeze: translation along a plane, N");
    check_rel(v3_norm(torque), 2.0 / 15.0 * scale * a * 0.31, 1e-9, "squeeze: its torque, N m");
    const vec3 spin = v3_scale(1.0, v3_cross(normal, side)), arm = v3_scale(-a, normal);
    p.v = v3_cross(spin, arm);
    p.spin_i = spin;
    put(p);
    l.forces(&t, h);
    const vec3 turning =
        v3_add(law_moment(&t, 0), v3_cross(v3_scale(-a, normal), law_force(&t, 0)));
    check_rel(v3_dot(turning, spin), -8.0 * PI * mu * a * a * a * 0.4 * log_gap, 1e-9,
              "squeeze: rotation near a plane, torque, N m");
    t.dt = 1.0;
    put(pair(-gap, v3_scale(-0.31, normal)));
    l.forces(&t, h);
    check(v3_dot(law_force(&t, 0), normal) * t.dt <= 0.31 * m_eff,
          "squeeze: a step of a second turns no grain round");
}

/* A bond made at its time from a gap, stretched, sheared, bent, twisted, each till it breaks. */
static void check_bonds(void)
{
    static const char *const parallel[] = {"material a.bond_stiffness=1.3e11 Pa/m",
                                           "material a.bond_stiffness_shear=0.7e11 Pa/m",
                                           "material a.bond_strength=3.1 MPa",
                                           "material a.bond_strength_shear=1.7 MPa",
                                           "bond.radius=0.77",
                                           "bond.gap=20 um",
                                           NULL};
    static const char *const contact[] = {"material a.bond_stiffness=1.3e5 N/m",
                                          "material a.bond_stiffness_shear=0.7e5 N/m",
                                          "material a.bond_strength=3.1 N",
                                          "material a.bond_strength_shear=1.7 N",
                                          "bond.gap=20 um",
                                          NULL};
    const double r = 0.77 * 3.17e-3, area = PI * r * r, inertia = 0.25 * area * r * r;
    for (int which = 0; which < 2; which++)
        for (int mode = 0; mode < (which == 0 ? 4 : 2); mode++) {
            static const char *const modes[] = {"stretched", "sheared", "bent", "twisted"};
            const char *const name = which == 0 ? "parallel_bond" : "contact_bond";
            const struct law l = get("bond", name, which == 0 ? parallel : contact);
            double u = 0.0, force = 0.0, moment = 0.0;
            int broke = 0, steps = 0;
            t.dt = 1e-6;
            for (; steps < 100000 && !broke; steps++) {
                struct law_pair p = pair(-1.3e-5 - (mode == 0 ? u : 0.0), v3(0, 0, 0));
                if (mode == 1)
                    p.v = v3_scale(1e-3, side);
                if (mode == 2)
                    p.spin_i = v3_scale(0.31, side);
                if (mode == 3)
                    p.spin_i = v3_scale(0.31, normal);
                t.time = steps * t.dt;
                put(p);
                l.forces(&t, h);
                broke = t.broke[0];
                if (!broke) {
                    force = v3_norm(law_force(&t, 0));
                    moment = v3_norm(law_moment(&t, 0));
                }
                u += 1e-9;
            }
            const double want_force = which == 1  ? (mode == 0 ? 3.1 : 1.7)
                                      : mode == 0 ? 3.1e6 * area
                                      : mode == 1 ? 1.7e6 * area
                                                  : 0.0;
            const double want_moment = mode == 2   ? 3.1e6 * inertia / r
                                       : mode == 3 ? 1.7e6 * 2.0 * inertia / r
                                                   : 0.0;
            char *const text = xprintf("%s, %s: %s at the break", name, modes[mode],
                                       mode < 2 ? "force, N" : "moment, N m");
            check_rel(mode < 2 ? force : moment, mode < 2 ? want_force : want_moment, 5e-3,
                      text);
            check(broke == (mode == 0 || mode == 2 ? BROKE_TENSION : BROKE_SHEAR),
                  "%s, %s: the mode of its breaking", name, modes[mode]);
            xfree(text);
            put(pair(-1.3e-5, v3(0, 0, 0)));
            l.forces(&t, h);
            check(v3_norm(law_force(&t, 0)) == 0.0 && !t.broke[0], "%s: broken, it stays so",
                  name);
        }
}

int main(int argc, char **argv)
{
    (void)argc;
    program = argv[0];
    check_hertz_family("hertz");
    check_hertz_family("hertz_mindlin");
    check_hertz_family("hertz_mindlin_liu");
    check_linear();
    check_rolling();
    check_jkr();
    check_capillary();
    check_van_der_waals();
    check_lubrication();
    check_bonds();
    return check_end();
}
