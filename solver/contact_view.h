/* contact_view.h - the contacts as analysis wants to see them: who touches whom, where, how hard.
 *
 * A view is taken when it is asked for, from the places of the grains and the force per slot that
 * the contact loop keeps where some part of the analysis watches (s->contacts->watched, set by
 * contact_view_wanted); a scene that asks for none of it pays nothing. Contacts stand in the order
 * of the slots, pairs first: the same on any number of threads. */
#ifndef CONTACT_VIEW_H
#define CONTACT_VIEW_H

#include "base.h"

struct sim;

struct seen {
    int i, j;   /* indices of the grains; j = -1: against a wall */
    int wall;   /* element of a wall, or -1 */
    vec3 point; /* m, of the contact; near grain i, perhaps outside of a periodic box */
    vec3
        branch; /* m, from the centre of j (nearest image; wall: from the point) to that of i */
    vec3 normal;         /* unit, from j to i */
    vec3 force;          /* N, on i */
    double normal_force; /* N, force . normal: > 0 pushes them apart */
    double depth;        /* m, overlap; < 0 a gap over which a law acts */
};

struct contact_view {
    size_t n, capacity;
    struct seen *seen;
    long taken; /* sub-step that it shows, from 1 on; 0: none yet */
};

/* The contacts after the last step; taken once per step. The view belongs to the sim's analysis
 * and is good until the next step. */
const struct contact_view *contact_view(struct sim *s);

/* To be called before the start by whoever will look. */
void contact_view_wanted(struct sim *s);

/* Fills `v` anew, where there is one contact a slot; its owner frees v->seen with xfree. */
void contact_view_slots(const struct sim *s, struct contact_view *v);
/* Room for n contacts. */
void contact_view_reserve(struct contact_view *v, size_t n);

#endif
