/* forces/brownian.c - the fluid's thermal agitation, by fluctuation and dissipation [Einstein1905],
 * [Ermak78].
 *
 *   F = sqrt(6 pi mu d k T/dt) N(0,1)   per component, a new one each fluid step
 *
 * which with Stokes' drag 3 pi mu d gives a grain k T/m of <v^2> per component and the diffusivity
 * k T/(3 pi mu d): the latter at any step, the former where the step resolves the relaxation
 * (k T/m/(1 + theta/2) with theta = dt 3 pi mu d/m, drag being backward Euler).
 *
 * The lattice-Boltzmann paper prints sqrt(3 rho nu d k T/(sigma^2 dt)) times the Gaussian's density
 * instead of a random number: too weak by 2.5, and not of zero mean.
 *
 * Random numbers: Philox 4x32-10 [Salmon11], a function of run.seed, the grain's id and the step, so
 * they depend neither on threads nor on the order of the grains and need no state. Box and Muller make
 * normal ones of them. The reaction is not returned: the stress that agitates a grain is a fluctuation
 * of the fluid's own, which this program does not follow. */
#include "force.h"

#include <stdint.h>

static const struct key keys[] = {
    {"forces", "temperature", KEY_REAL, "K", "[0, inf)", "293.15 K", "of the fluid"},
    {0},
};

static const double boltzmann = 1.380649e-23; /* J/K, exact since 2019 */
static double temperature;

static void read_keys(struct scene *s)
{
    temperature = scene_real(s, "forces", NULL, "temperature");
}

static void philox(uint32_t c[4], uint32_t k0, uint32_t k1)
{
    for (int round = 0; round < 10; round++) {
        const uint64_t a = UINT64_C(0xD2511F53) * c[0], b = UINT64_C(0xCD9E8D57) * c[2];
        const uint32_t next[4] = {(uint32_t)(b >> 32) ^ c[1] ^ k0, (uint32_t)b,
                                  (uint32_t)(a >> 32) ^ c[3] ^ k1, (uint32_t)a};
        for (int i = 0; i < 4; i++)
            c[i] = next[i];
        k0 += UINT32_C(0x9E3779B9);
        k1 += UINT32_C(0xBB67AE85);
    }
}

/* In (0, 1). */
static double unit(uint32_t x)
{
    return (x + 0.5) * (1.0 / 4294967296.0);
}

static vec3 kick(const struct force_view *v)
{
    const double pi = 3.14159265358979323846;
    const uint64_t id = (uint64_t)v->id, step = (uint64_t)v->step, seed = v->seed;
    uint32_t c[4] = {(uint32_t)id, (uint32_t)(id >> 32), (uint32_t)step,
                     (uint32_t)(step >> 32)};
    philox(c, (uint32_t)seed, (uint32_t)(seed >> 32));
    const double r = sqrt(-2.0 * log(unit(c[0]))), q = sqrt(-2.0 * log(unit(c[2])));
    const double size = sqrt(6.0 * pi * v->mu * v->d * boltzmann * temperature / v->dt);
    return v3_scale(size, v3(r * cos(2.0 * pi * unit(c[1])), r * sin(2.0 * pi * unit(c[1])),
                             q * cos(2.0 * pi * unit(c[3]))));
}

const struct force force_brownian = {
    .about = {.name = "brownian",
              .summary =
                  "thermal agitation, from random numbers that depend on grain and step only",
              .equation = "F = sqrt(6 pi mu d k T/dt) N(0,1) per component",
              .source = "[Einstein1905]; [Ermak78]; [Salmon11]",
              .range = "grains that others do not crowd; Stokes' drag",
              .cost =
                  "Philox, two logarithms, three roots, sines and cosines of normal numbers"},
    .keys = keys,
    .read = read_keys,
    .act = kick,
};
