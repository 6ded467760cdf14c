/* contact/none.c - grains pass through each other. Also the template for new laws. */
#include "contact.h"

const struct about contact_about = {.name = "none",
                                    .summary = "no contact forces",
                                    .equation = "F = 0",
                                    .source = "",
                                    .range = "dilute or frozen grains"};
const struct key contact_keys[] = {{0}};
const int contact_history = 0;

void contact_init(struct scene *s, const struct materials *m)
{
    (void)s;
    (void)m;
}

void contact_forces(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    for (int c = 0; c < t->n; c++)
        t->fx[c] = t->fy[c] = t->fz[c] = t->fn[c] = t->kn[c] = 0.0;
}

void contact_damping(const struct touch *t, real *c)
{
    for (int k = 0; k < t->n; k++)
        c[k] = 0.0;
}

void contact_energy(struct touch *t, real (*history)[TOUCH])
{
    (void)history;
    for (int c = 0; c < t->n; c++)
        t->energy[c] = 0.0;
}

double contact_duration(int a, int b, double m_eff, double r_eff, double v)
{
    (void)a;
    (void)b;
    (void)m_eff;
    (void)r_eff;
    (void)v;
    return (double)INFINITY;
}

double contact_rayleigh(int a, double radius, double density)
{
    (void)a;
    (void)radius;
    (void)density;
    return (double)INFINITY;
}
