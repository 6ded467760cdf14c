/* verify/laws.h - a law of any slot of contacts, loaded and given parameters; for tests of the
 * contract and for timings. */
#ifndef LAWS_H
#define LAWS_H

#include "answers.h"
#include "../contact/bond/bond.h"
#include "../contact/cohesion/cohesion.h"
#include "../contact/contact.h"
#include "../contact/rolling/rolling.h"

/* The slots of contacts and their verbs. */
struct law_slot {
    const char *name, *folder, *verb;
};

static const struct law_slot law_slots[] = {
    {"contact", "contact", "forces"},
    {"cohesion", "contact/cohesion", "forces"},
    {"lubrication", "contact/lubrication", "forces"},
    {"rolling", "contact/rolling", "moments"},
    {"bond", "contact/bond", "forces"},
};

enum { LAW_SLOTS = sizeof law_slots / sizeof law_slots[0] };

struct law {
    const struct law_slot *slot;
    const struct about *about;
    const struct key *keys;
    void (*init)(struct scene *, const struct materials *);
    void (*forces)(struct touch *, real (*)[TOUCH]);
    void (*energy)(struct touch *, real (*)[TOUCH]);
    void (*damping)(const struct touch *, real *); /* of contact alone */
    double (*range)(void);                         /* NULL in contact and rolling */
    const int *history;
    const unsigned *needs; /* NULL in contact */
};

static inline void law_symbol(void *answer, const char *slot, const char *what, void *address,
                              size_t size)
{
    char name[64];
    snprintf(name, sizeof name, "%s_%s", slot, what);
    answers_symbol(answer, name, address, size);
}

static inline struct law law_load(const struct law_slot *slot, void *answer)
{
    struct law l = {.slot = slot};
    const char *const s = slot->name;
    law_symbol(answer, s, "about", &l.about, sizeof l.about);
    law_symbol(answer, s, "keys", &l.keys, sizeof l.keys);
    law_symbol(answer, s, "init", &l.init, sizeof l.init);
    law_symbol(answer, s, slot->verb, &l.forces, sizeof l.forces);
    law_symbol(answer, s, "energy", &l.energy, sizeof l.energy);
    law_symbol(answer, s, "history", &l.history, sizeof l.history);
    if (strcmp(s, "contact") == 0)
        law_symbol(answer, s, "damping", &l.damping, sizeof l.damping);
    else
        law_symbol(answer, s, "needs", &l.needs, sizeof l.needs);
    if (strcmp(s, "contact") != 0 && strcmp(s, "rolling") != 0)
        law_symbol(answer, s, "range", &l.range, sizeof l.range);
    return l;
}

/* Opens every answer of the slot beside the program, in order of name; returns how many. They stay
 * open. */
static inline int laws_open(const char *program, const struct law_slot *slot, struct law *law,
                            int most)
{
    char path[1024], file[2048], copy[1024];
    struct dirent **entry;
    int count = 0;
    snprintf(copy, sizeof copy, "%s", program);
    snprintf(path, sizeof path, "%s/../answers/%s", dirname(copy), slot->folder);
    const int n = scandir(path, &entry, answers_is_object, alphasort);
    for (int i = 0; i < n; i++) {
        snprintf(file, sizeof file, "%s/%s", path, entry[i]->d_name);
        void *const answer = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
        if (!answer)
            check(false, "%s: %s", file, dlerror());
        else if (count < most)
            law[count++] = law_load(slot, answer);
        free(entry[i]);
    }
    if (n >= 0)
        free(entry);
    if (count == 0)
        check(false, "no answers found in %s", path);
    return count;
}

/* A value for a key that a law demands, whatever the law: by its unit, pure numbers within their
 * interval. */
static inline const char *law_plausible(const struct key *k)
{
    static const struct {
        const char *key, *unit, *value;
    } known[] = {
        {"poisson", "1", "0.27"},
        {"restitution", "1", "0.61"},
        {NULL, "Pa", "3.7e7 Pa"},
        {NULL, "N m-1", "2.9e4 N/m"},
        {"bond_strength", "N", "0.31 N"},
        {"bond_strength_shear", "N", "0.23 N"},
        {NULL, "Pa m-1", "1.3e11 Pa/m"},
        {"rolling_stiffness", "N m", "1.7e-2 N m"},
        {"torsion_stiffness", "N m", "1.1e-2 N m"},
        {"rolling_viscosity", "s m-1", "0.83 s/m"},
        {"bridge_volume", "m3", "1.9e-11 m3"},
        {"contact_angle", "rad", "0.37 rad"},
        {"hamaker", "J", "7e-12 J"},
        {NULL, "m", "1.1e-4 m"},
        {NULL, "J m-2", "0.17 J/m2"},
        {NULL, "Pa s", "0.013 Pa s"},
    };
    if (strcmp(k->name, "gap_min") == 0 || strcmp(k->name, "separation_min") == 0)
        return "1.3e-6 m";
    if (strcmp(k->name, "surface_tension") == 0)
        return "0.0719 N/m";
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if ((!known[i].key || strcmp(known[i].key, k->name) == 0) &&
            strcmp(known[i].unit, k->unit) == 0)
            return known[i].value;
    return "0.61";
}

/* Gives the law `n` materials named a, b, ... with plausible values; `extra` are more keys
 * ("material a.friction=0.3", later ones win), ended by NULL. Returns the errors. */
static inline int law_start(const struct law *l, int n, const char *const *extra)
{
    static const char *const names[] = {"a", "b", "c", "d"};
    char *set[256];
    int count = 0;
    for (const struct key *k = l->keys; k->section; k++) {
        const bool material = strcmp(k->section, "material") == 0;
        if (k->standard && strcmp(k->name, "restitution") != 0)
            continue;
        for (int m = 0; m < (material ? n : 1) && strcmp(k->section, "pair") != 0; m++)
            set[count++] = xprintf("%s%s%s.%s=%s", k->section, material ? " " : "",
                                   material ? names[m] : "", k->name, law_plausible(k));
    }
    for (int i = 0; extra && extra[i]; i++)
        set[count++] = xstrdup(extra[i]);
    struct scene *const scene = scene_load(NULL, count, set);
    scene_declare(scene, l->keys);
    l->init(scene, &(struct materials){.n = n, .name = names});
    const int errors = scene_errors(scene);
    if (errors > 0)
        check(false, "%s = %s: parameters are accepted", l->slot->name, l->about->name);
    scene_free(scene);
    for (int i = 0; i < count; i++)
        xfree(set[i]);
    return errors;
}

/* A contact c of unlike spheres: depth, normal, velocity at the contact point, spins. The loop's
 * own arithmetic, once more. */
struct law_pair {
    double r_i, r_j, m_i, m_j; /* m, kg; r_j = 0: a plane */
    double depth;
    vec3 n, v, spin_i, spin_j;
    int pair;
};

static inline void law_put(struct touch *t, int c, const struct law_pair *p)
{
    const double i_i = 1.4 * p->m_i * p->r_i * p->r_i, i_j = 1.4 * p->m_j * p->r_j * p->r_j;
    const bool plane = p->r_j == 0.0;
    t->pair[c] = p->pair;
    t->depth[c] = (real)p->depth;
    t->r_i[c] = (real)p->r_i;
    t->r_j[c] = (real)p->r_j;
    t->r_eff[c] = (real)(plane ? p->r_i : p->r_i * p->r_j / (p->r_i + p->r_j));
    t->m_eff[c] = (real)(plane ? p->m_i : p->m_i * p->m_j / (p->m_i + p->m_j));
    t->inertia[c] = (real)(plane ? i_i : i_i * i_j / (i_i + i_j));
    t->nx[c] = (real)p->n.x;
    t->ny[c] = (real)p->n.y;
    t->nz[c] = (real)p->n.z;
    t->vx[c] = (real)p->v.x;
    t->vy[c] = (real)p->v.y;
    t->vz[c] = (real)p->v.z;
    t->vn[c] = (real)v3_dot(p->n, p->v);
    t->start[c] = 1.0;
    t->wx[c] = (real)(p->spin_i.x - p->spin_j.x);
    t->wy[c] = (real)(p->spin_i.y - p->spin_j.y);
    t->wz[c] = (real)(p->spin_i.z - p->spin_j.z);
    t->sx[c] = (real)p->spin_i.x;
    t->sy[c] = (real)p->spin_i.y;
    t->sz[c] = (real)p->spin_i.z;
    t->fx[c] = t->fy[c] = t->fz[c] = t->mx[c] = t->my[c] = t->mz[c] = 0.0;
    t->fn[c] = t->kn[c] = 0.0;
    t->broke[c] = 0;
    t->energy[c] = 0.0;
}

static inline vec3 law_force(const struct touch *t, int c)
{
    return v3((double)t->fx[c], (double)t->fy[c], (double)t->fz[c]);
}

static inline vec3 law_moment(const struct touch *t, int c)
{
    return v3((double)t->mx[c], (double)t->my[c], (double)t->mz[c]);
}

#endif
