/* domain.c - reads the box and its sides, and checks that the sides do not contradict. */
#include "domain.h"

#include <stdlib.h>
#include <string.h>

#define KINDS "wall | slip | inflow | outflow | head | flux | periodic"

const struct key domain_keys[] = {
    {"domain", "size", KEY_VECTOR, "m", "(0, 1e6]", NULL, "edges of the box"},
    {"domain", "cells", KEY_CELLS, "", "[0, 100000]", "0 0 0", "cells of the fluid grid"},
    {"domain", "x", KEY_CHOICE, "", KINDS, "wall", "both sides in x"},
    {"domain", "y", KEY_CHOICE, "", KINDS, "wall", "both sides in y"},
    {"domain", "z", KEY_CHOICE, "", KINDS, "wall", "both sides in z"},
    {"domain", "x-", KEY_CHOICE, "", KINDS, "wall", "the side x = 0, in place of `x`"},
    {"domain", "x+", KEY_CHOICE, "", KINDS, "wall", "the side at the far end of x"},
    {"domain", "y-", KEY_CHOICE, "", KINDS, "wall", "the side y = 0, in place of `y`"},
    {"domain", "y+", KEY_CHOICE, "", KINDS, "wall", "the side at the far end of y"},
    {"domain", "z-", KEY_CHOICE, "", KINDS, "wall", "the side z = 0, in place of `z`"},
    {"domain", "z+", KEY_CHOICE, "", KINDS, "wall", "the side at the far end of z"},
    {"domain", "gravity", KEY_VECTOR, "m s-2", "[-1e6, 1e6]", "0 0 -9.81 m/s2",
     "acceleration of gravity"},
    {"side", "velocity", KEY_VECTOR, "m s-1", "(-inf, inf)", "0 0 0 m/s",
     "velocity of a wall in its own plane; the name of the side, \"z+\", names the section"},
    {"side", "grains", KEY_CHOICE, "", "wall | open", "wall",
     "what the side is for grains; open: those that leave are gone (insert.h)"},
    {"side", "material", KEY_TEXT, "", "", "",
     "what grains meet there; default: \"wall\" if there is one, or that of the first species"},
    {"side", "head", KEY_REAL, "m", "(-inf, inf)", "0 m",
     "total head held at a side of kind head"},
    {"side", "flux", KEY_REAL, "m s-1", "(-inf, inf)", "0 m/s",
     "superficial velocity into the box at a side of kind flux"},
    {"side", "inflow", KEY_REAL, "m s-1", "flow | (-inf, inf)", "flow",
     "superficial velocity into the box at a side of kind inflow; flow: that of [flow]"},
    {"side", "ramp", KEY_REAL, "s", "[0, inf)", "0 s",
     "time in which head, flux or inflow of the side grows from 0 at t = 0"},
    {"side", "table", KEY_TEXT, "", "", "",
     "CSV file of head, flux or inflow of the side: time in s, value in m or m/s"},
    {0},
};

const char *const side_name[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
const char *const side_kind_name[] = {"periodic", "wall", "slip", "inflow",
                                      "outflow",  "head", "flux"};

/* The words of KINDS in their order there. */
static const enum side_kind kind_of_choice[] = {
    SIDE_WALL, SIDE_SLIP, SIDE_INFLOW, SIDE_OUTFLOW, SIDE_HEAD, SIDE_FLUX, SIDE_PERIODIC};

static void read_sides(struct domain *d, struct scene *s, int axis)
{
    const char both[2] = {(char)('x' + axis), '\0'};
    const bool given = scene_given(s, "domain", NULL, both);
    for (int end = 0; end < 2; end++) {
        const int side = 2 * axis + end;
        const char *key = side_name[side];
        if (scene_given(s, "domain", NULL, key)) {
            if (given)
                scene_error(s, "domain", NULL, key, "contradicts domain.%s: give either one",
                            both);
        } else {
            key = both;
        }
        d->side[side].kind = kind_of_choice[scene_choice(s, "domain", NULL, key)];
    }
    const bool lo = d->side[2 * axis].kind == SIDE_PERIODIC;
    const bool hi = d->side[2 * axis + 1].kind == SIDE_PERIODIC;
    if (lo != hi)
        scene_error(s, "domain", NULL, side_name[2 * axis + (hi ? 1 : 0)],
                    "periodic must hold for both sides (domain.%s = periodic)", both);
    d->periodic[axis] = lo && hi;
    d->image[axis] = d->periodic[axis] ? d->size[axis] : 0.0;
    d->inv_image[axis] = d->periodic[axis] && d->size[axis] > 0.0 ? 1.0 / d->size[axis] : 0.0;
}

/* A value in time of one side: `key`, or its table, with its ramp. */
static void read_course(struct course *c, struct scene *s, const char *name, const char *key,
                        enum side_kind asks, const struct side *side)
{
    if (scene_given(s, "side", name, key) && side->kind != asks)
        scene_error(s, "side", name, key, "only a side of kind %s takes it, %s is %s",
                    side_kind_name[asks], name, side_kind_name[side->kind]);
    if (side->kind != asks)
        return;
    if (!scene_word(s, "side", name, key, "flow"))
        c->value = scene_real(s, "side", name, key);
    c->ramp = scene_real(s, "side", name, "ramp");
    course_read_table(c, s, "side", name, "table");
    if (c->n > 0 && scene_given(s, "side", name, key))
        scene_error(s, "side", name, key, "contradicts the table of the side: give either one");
}

static void read_side(struct domain *d, struct scene *s, const char *name, int side)
{
    struct side *const e = &d->side[side];
    const bool timed = e->kind == SIDE_HEAD || e->kind == SIDE_FLUX || e->kind == SIDE_INFLOW;
    e->velocity = scene_vector(s, "side", name, "velocity");
    e->open = scene_choice(s, "side", name, "grains") == 1;
    if (e->open && e->kind == SIDE_PERIODIC)
        scene_error(s, "side", name, "grains", "a periodic side is no way out");
    read_course(&e->head, s, name, "head", SIDE_HEAD, e);
    read_course(&e->flux, s, name, "flux", SIDE_FLUX, e);
    read_course(&e->inflow, s, name, "inflow", SIDE_INFLOW, e);
    e->own_inflow = !scene_word(s, "side", name, "inflow", "flow") || e->inflow.n > 0;
    static const char *const of_time[] = {"ramp", "table"};
    for (int i = 0; i < 2; i++)
        if (scene_given(s, "side", name, of_time[i]) && !timed)
            scene_error(s, "side", name, of_time[i],
                        "only a side of kind head, flux or inflow takes it, %s is %s", name,
                        side_kind_name[e->kind]);
    const double normal = side < 2 ? e->velocity.x : side < 4 ? e->velocity.y : e->velocity.z;
    if (normal != 0.0)
        scene_error(s, "side", name, "velocity", "must lie in the plane of the side");
    if (v3_norm(e->velocity) > 0.0 && e->kind != SIDE_WALL)
        scene_error(s, "side", name, "velocity", "only a side of kind wall moves, %s is %s",
                    name, side_kind_name[e->kind]);
}

static void read_side_values(struct domain *d, struct scene *s)
{
    const char *const *names;
    const int n = scene_names(s, "side", &names);
    for (int i = 0; i < n; i++) {
        int side = 0;
        while (side < 6 && strcmp(names[i], side_name[side]) != 0)
            side++;
        if (side == 6)
            scene_error(s, "side", names[i], NULL, "no such side; there are x- x+ y- y+ z- z+");
        else
            read_side(d, s, names[i], side);
    }
}

void domain_free(struct domain *d)
{
    for (int i = 0; i < 6; i++) {
        course_free(&d->side[i].head);
        course_free(&d->side[i].flux);
        course_free(&d->side[i].inflow);
    }
}

void domain_read(struct domain *d, struct scene *s)
{
    scene_declare(s, domain_keys);
    const vec3 size = scene_vector(s, "domain", NULL, "size");
    d->size[0] = size.x;
    d->size[1] = size.y;
    d->size[2] = size.z;
    scene_cells(s, "domain", NULL, "cells", d->cells);
    d->gravity = scene_vector(s, "domain", NULL, "gravity");
    for (int axis = 0; axis < 3; axis++)
        read_sides(d, s, axis);
    read_side_values(d, s);
}

static double wrap(double x, double size)
{
    const double y = x - size * floor(x / size);
    return y < size ? y : 0.0; /* a tiny negative x rounds up to the size itself */
}

vec3 domain_wrap(const struct domain *d, vec3 x)
{
    if (d->periodic[0])
        x.x = wrap(x.x, d->size[0]);
    if (d->periodic[1])
        x.y = wrap(x.y, d->size[1]);
    if (d->periodic[2])
        x.z = wrap(x.z, d->size[2]);
    return x;
}
