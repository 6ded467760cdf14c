/* feasibility.h - can this scene run? Every limit as a ratio, the smallest named.
 *
 * A line says: what the limit is, its value, the value used, used/limit. Above 1 the scene is
 * refused (exit 2) unless [run] force = on. */
#ifndef FEASIBILITY_H
#define FEASIBILITY_H

#include <stdbool.h>
#include <stdio.h>

enum { FEASIBILITY_LINES = 40 };

struct feasibility {
    int n;
    struct {
        char name[64]; /* "Rayleigh's step, beads" */
        char unit[16];
        double limit, used;
        bool binding; /* above 1 means refused; otherwise advice only */
        char note[96];
    } line[FEASIBILITY_LINES];
};

void feasibility_add(struct feasibility *f, const char *name, const char *unit, double used,
                     double limit, bool binding, const char *note);

struct sim;
struct scene;
/* s; the shortest limit of the contact loop: Rayleigh's step, or a quarter of the duration of a
 * contact at the highest expected speed; INFINITY if nothing touches. */
double feasibility_grain_limit(const struct sim *s);
/* The first grain of a species that moves, or -1. */
int feasibility_grain(const struct sim *s, int species);
/* Of grains and fluid together (feasibility_coupling.c). */
void feasibility_relaxation(const struct sim *s, struct feasibility *f);
void feasibility_coupling(const struct sim *s, struct feasibility *f);
double feasibility_sinking(const struct sim *s, int species); /* m/s; INFINITY in no fluid */
void feasibility_fill(const struct sim *s, struct feasibility *f);
void feasibility_print(FILE *out, const struct sim *s, const struct feasibility *f);
/* Puts broken binding limits on the scene's list of errors. */
void feasibility_enforce(const struct sim *s, struct scene *scene, const struct feasibility *f);

#endif
