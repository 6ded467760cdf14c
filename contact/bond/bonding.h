/* contact/bond/bonding.h - what bonds share: when they are made, and how what they hold turns. */
#ifndef BONDING_H
#define BONDING_H

#include "../../solver/materials.h"
#include "../spring.h"

/* Rows for the key tables of bonds. */
#define BOND_KEYS                                                                              \
    {"bond",                                                                                   \
     "time",                                                                                   \
     KEY_REAL,                                                                                 \
     "s",                                                                                      \
     "(-inf, inf)",                                                                            \
     "0 s",                                                                                    \
     "when bonds are made; settling is before 0"},                                             \
        {"bond", "gap", KEY_REAL, "m", "[0, inf)", "0 m", "largest gap that is bonded"},       \
        {"bond",                                                                               \
         "damping",                                                                            \
         KEY_REAL,                                                                             \
         "1",                                                                                  \
         "[0, inf)",                                                                           \
         "0",                                                                                  \
         "damping ratio of dashpots beside the bond's springs"},                               \
    {                                                                                          \
        "bond", "stretch", KEY_REAL, "m", "auto | [0, inf)", "auto",                           \
            "gap up to which a bond is followed, beyond bond.gap; auto: strength over "        \
            "stiffness"                                                                        \
    }

struct bonding {
    double time, gap, damping;
    double range; /* m */
};

/* Reads the keys. `stretch` [m]: how far a bond of each pair goes before it breaks; INFINITY if it
 * cannot, 0 if it is none. */
static inline void bonding_read(struct scene *s, const struct materials *m,
                                const double *stretch, struct bonding *b)
{
    b->time = scene_real(s, "bond", NULL, "time");
    b->gap = scene_real(s, "bond", NULL, "gap");
    b->damping = scene_real(s, "bond", NULL, "damping");
    double most = 0.0;
    for (int p = 0; p < m->n * m->n; p++)
        most = fmax(most, stretch[p]);
    if (!scene_word(s, "bond", NULL, "stretch", "auto"))
        most = scene_real(s, "bond", NULL, "stretch");
    else if (isinf(most))
        scene_error(s, "bond", NULL, "stretch", "must be given for unbreakable bonds, in m");
    b->range = b->gap + 1.001 * most;
}

/* Bonds are made in the one step whose state is nearest to the time. */
static inline bool bonding_now(const struct bonding *b, const struct touch *t)
{
    return t->time >= b->time - 0.5 * t->dt && t->time < b->time + 0.5 * t->dt;
}

/* Mean spin of the two grains about the normal: a bond turns with them, about it too. */
SPRING_INLINE real bonding_roll(const struct touch *t, int c, struct arrow n)
{
    const struct arrow mean =
        arrow_axpy((struct arrow){t->sx[c], t->sy[c], t->sz[c]}, -0.5, touch_spin(t, c));
    return arrow_dot(mean, n);
}

/* What a bond holds in its plane, turned into the plane of n and by `angle` about n. */
SPRING_INLINE struct arrow bonding_turn(struct arrow held, struct arrow n, real angle)
{
    return spring_turn(arrow_axpy(held, angle, arrow_cross(n, held)), n,
                       inverse_root(1.0 + angle * angle), 1.0);
}

#endif
