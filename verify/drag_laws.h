/* verify/drag_laws.h - every law of drag, loaded and ready to call; for tests, figures. */
#ifndef DRAG_LAWS_H
#define DRAG_LAWS_H

#include "../drag/drag.h"
#include "answers.h"

static const double law_d = 1.237e-3; /* m, of the grain in every call */

struct law {
    char name[64];
    double (*factor)(const struct drag_point *p);
    void (*init)(struct scene *s);
    void (*prepare)(struct drag_grain *grain);
    const struct key *keys;
    const struct about *about;
    struct drag_limits limits; /* a copy, which outlives the loaded answer */
    struct drag_grain grain;
    double y;
};

/* The symbols of an answer, and a sphere that falls in a liquid. */
static inline bool law_load(struct law *law, const char *name, void *answer)
{
    *law = (struct law){.y = 1.0,
                        .grain = {.sphericity = 1.0,
                                  .crosswise = 1.0,
                                  .lengthwise = 1.0,
                                  .circularity = 1.0,
                                  .density_ratio = 2.65,
                                  .d10 = 0.737e-3}};
    snprintf(law->name, sizeof law->name, "%s", name);
    const struct drag_limits *limits = NULL;
    const bool good =
        answers_symbol(answer, "drag_factor", &law->factor, sizeof law->factor) &&
        answers_symbol(answer, "drag_init", &law->init, sizeof law->init) &&
        answers_symbol(answer, "drag_prepare", &law->prepare, sizeof law->prepare) &&
        answers_symbol(answer, "drag_keys", &law->keys, sizeof law->keys) &&
        answers_symbol(answer, "drag_about", &law->about, sizeof law->about) &&
        answers_symbol(answer, "drag_limits", &limits, sizeof limits);
    if (good)
        law->limits = *limits;
    return good;
}

/* Reads the law's keys, with their standard values or the overrides; keys that must be given and
 * are not get a permeability (the one kind that there is): Carman's at eps = 0.4. */
static inline void law_init(struct law *law, int n, char **overrides)
{
    char *all[16];
    int m = 0;
    for (const struct key *k = law->keys; k->section; k++)
        if (!k->standard)
            all[m++] = xprintf("%s.%s=%.17g %s", k->section, k->name,
                               0.064 * law_d * law_d / (180.0 * 0.36), k->unit);
    const int added = m;
    for (int i = 0; i < n; i++)
        all[m++] = overrides[i]; /* later ones win */
    struct scene *const s = scene_load(NULL, m, all);
    scene_declare(s, law->keys);
    law->init(s);
    check(scene_errors(s) == 0, "%s: its keys read without error", law->name);
    scene_free(s);
    for (int i = 0; i < added; i++)
        xfree(all[i]);
    law->prepare(&law->grain);
}

/* The law of grains of another shape. */
static inline struct law law_shaped(const struct law *law, double sphericity, double crosswise)
{
    struct law other = *law;
    other.grain.sphericity = sphericity;
    other.grain.crosswise = other.grain.lengthwise = crosswise;
    other.prepare(&other.grain);
    return other;
}

static inline double law_factor(const struct law *law, double eps, double re)
{
    return law->factor(&(struct drag_point){
        .eps = eps, .re = re, .d = law_d, .y = law->y, .grain = &law->grain});
}

/* m2; permeability that the law implies for a bed of such grains. */
static inline double law_permeability(const struct law *law, double eps, double re)
{
    return eps * law_d * law_d / (18.0 * (1.0 - eps) * law_factor(law, eps, re));
}

static inline bool law_holds(const struct law *law, double eps, double re)
{
    const struct drag_limits *const l = &law->limits;
    return eps >= l->eps_min && eps <= l->eps_max && re >= l->re_min &&
           re <= (l->per_solid ? l->re_max * (1.0 - eps) : l->re_max);
}

struct law_jump {
    double size, eps, re; /* relative; where */
};

/* What remains of the change of Fhat between two points when they close in on it. */
static inline struct law_jump law_jump_between(const struct law *law, double eps0, double re0,
                                               double eps1, double re1)
{
    double f0 = law_factor(law, eps0, re0), f1 = law_factor(law, eps1, re1);
    for (int i = 0; i < 44; i++) {
        const double eps = 0.5 * (eps0 + eps1), re = 0.5 * (re0 + re1);
        const double f = law_factor(law, eps, re);
        if (fabs(f - f0) > fabs(f - f1)) {
            eps1 = eps;
            re1 = re;
            f1 = f;
        } else {
            eps0 = eps;
            re0 = re;
            f0 = f;
        }
    }
    return (struct law_jump){fabs(f1 - f0) / fmax(f0, f1), eps0, re0};
}

enum { JUMP_LINES = 15, JUMP_POINTS = 20000 };

static inline double law_line_at(bool along_eps, int k)
{
    return along_eps ? 0.3 + 0.7 * k / JUMP_POINTS : pow(10.0, -8.0 + 14.0 * k / JUMP_POINTS);
}

/* The largest jump along one line: where the change between two points is not that between
 * their neighbours, the two close in on it. */
static inline struct law_jump law_line_jump(const struct law *law, bool along_eps, double other,
                                            bool in_range)
{
    struct law_jump worst = {0.0, 0.0, 0.0};
    double f[3];
    for (int k = 0; k <= JUMP_POINTS; k++) {
        const double x = law_line_at(along_eps, k);
        f[k % 3] = along_eps ? law_factor(law, x, other) : law_factor(law, other, x);
        if (k < 2)
            continue;
        const double now = f[k % 3] - f[(k - 1) % 3], before = f[(k - 1) % 3] - f[(k - 2) % 3];
        if (fabs(now - before) < 1e-5 * f[k % 3])
            continue;
        const double last = law_line_at(along_eps, k - 1);
        const struct law_jump j = along_eps ? law_jump_between(law, last, other, x, other)
                                            : law_jump_between(law, other, last, other, x);
        if (j.size > worst.size && (!in_range || law_holds(law, j.eps, j.re)))
            worst = j;
    }
    return worst;
}

/* The largest jump for eps from 0.3 to 1, Re from 1e-8 to 1e6, or of that where the law holds. */
static inline struct law_jump law_largest_jump(const struct law *law, bool in_range)
{
    struct law_jump worst = {0.0, 0.0, 0.0};
    for (int i = 0; i < JUMP_LINES; i++)
        for (int along = 0; along < 2; along++) {
            const double re = pow(10.0, i - 8.0), eps = 0.3 + 0.0499 * i;
            const struct law_jump j = law_line_jump(law, along, along ? re : eps, in_range);
            if (j.size > worst.size)
                worst = j;
        }
    return worst;
}

#endif
