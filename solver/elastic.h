/* elastic.h - what laws of elastic bodies read: moduli, damping, and the times that follow. */
#ifndef ELASTIC_H
#define ELASTIC_H

#include "materials.h"

/* Rows for the key tables of laws: moduli, and damping (from restitution or given). */
#define ELASTIC_KEYS                                                                           \
    {"material", "young", KEY_REAL, "Pa", "(0, inf)", NULL, "Young's modulus"},                \
        {"material", "poisson", KEY_REAL, "1", "(-1, 0.5]", NULL, "Poisson's ratio"},          \
        {"material",                                                                           \
         "e_star",                                                                             \
         KEY_REAL,                                                                             \
         "Pa",                                                                                 \
         "moduli | (0, inf)",                                                                  \
         "moduli",                                                                             \
         "E* of a contact, instead of that from young and poisson"},                           \
        {"material",                                                                           \
         "g_star",                                                                             \
         KEY_REAL,                                                                             \
         "Pa",                                                                                 \
         "moduli | (0, inf)",                                                                  \
         "moduli",                                                                             \
         "G* of a contact, instead of that from young and poisson"},                           \
        {"pair",  "e_star",         KEY_REAL, "Pa", "mixed | moduli | (0, inf)",               \
         "mixed", "E* of a contact"},                                                          \
    {                                                                                          \
        "pair", "g_star", KEY_REAL, "Pa", "mixed | moduli | (0, inf)", "mixed",                \
            "G* of a contact"                                                                  \
    }

#define DAMPING_KEYS                                                                           \
    {"material",                                                                               \
     "restitution",                                                                            \
     KEY_REAL,                                                                                 \
     "1",                                                                                      \
     "none | (0, 1]",                                                                          \
     "none",                                                                                   \
     "rebound speed over impact speed; or give the damping"},                                  \
        {"material",                                                                           \
         "damping_ratio",                                                                      \
         KEY_REAL,                                                                             \
         "1",                                                                                  \
         "none | [0, inf)",                                                                    \
         "none",                                                                               \
         "damping ratio of a contact, instead of restitution"},                                \
        {"pair",                                                                               \
         "restitution",                                                                        \
         KEY_REAL,                                                                             \
         "1",                                                                                  \
         "mixed | none | (0, 1]",                                                              \
         "mixed",                                                                              \
         "restitution of a contact"},                                                          \
    {                                                                                          \
        "pair", "damping_ratio", KEY_REAL, "1", "mixed | none | [0, inf)", "mixed",            \
            "damping ratio of a contact"                                                       \
    }

#define FRICTION_KEYS                                                                          \
    {"material", "friction", KEY_REAL, "1", "[0, inf)", NULL, "Coulomb's coefficient"},        \
    {                                                                                          \
        "pair", "friction", KEY_REAL, "1", "mixed | [0, inf)", "mixed",                        \
            "friction of a contact"                                                            \
    }

struct elastic {
    int n;                                               /* materials */
    double young[MATERIALS_MAX], poisson[MATERIALS_MAX]; /* Pa, 1 */
    double e_star[PAIRS_MAX], g_star[PAIRS_MAX];         /* Pa, of pairs */
    double zeta[PAIRS_MAX];                              /* 0, or set by the law */
};

/* Reads moduli; wrong ones go on the scene's list.
 *   1/E* = sum (1 - nu^2)/E,  1/G* = sum 2 (2 - nu)(1 + nu)/E */
void elastic_read(struct scene *s, const struct materials *m, struct elastic *e);

/* Damping ratio of each pair, from restitution (see restitution.h) or as given; where neither
 * is, `otherwise`: a number, or NAN, which is an error unless `may_lack`. */
void elastic_damping(struct scene *s, const struct materials *m, double otherwise,
                     bool may_lack, double *zeta);

/* s; [Hertz1882]: t_c = 2.87 (m*^2/(R* E*^2 v))^(1/5), or less where the dashpot asks for shorter
 * steps (duration_damped) */
double elastic_duration(const struct elastic *e, int a, int b, double m_eff, double r_eff,
                        double v);

/* s; of a contact of undamped duration t: a quarter of it must be a step that its dashpot bears, with
 * a margin of a quarter (restitution.h); shorter for restitutions below 0.2 only. Without it
 * contacts of restitution 0.05 and less gain energy at half of the limit (./run.sh extremes). */
double duration_damped(double t, double zeta);

/* s; [LiXuThornton05]: pi r sqrt(rho/G)/(0.1631 nu + 0.8766) */
double elastic_rayleigh(const struct elastic *e, int a, double radius, double density);

#endif
