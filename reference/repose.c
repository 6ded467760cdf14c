/* reference/repose.c - a heap at rest and its angle.
 *
 * The verdict is on what can be told without a fit: the heap has come to rest (its angle, taken at
 * the samples, does not change over the last part of the run), its flank is straight (the points
 * scatter about the line by less than a grain), and the angle is steeper than nothing and no
 * steeper than friction alone could hold between two grains, atan(friction) + 30 degrees, the
 * angle of dilation of rough close layers [Rowe62]. Where the scene names an angle, the measured
 * one must lie within the tolerance of it. */
#include "reference.h"

#include "../solver/sim.h"
#include "../solver/surface.h"

const struct about reference_about = {
    .name = "repose",
    .summary = "a heap at rest: steady, straight, and at the angle expected",
    .equation = "h = c - tan(angle) r",
    .source = "[Rowe62]",
    .range = "a heap on a floor, measured by a [surface NAME]"};
const struct key reference_keys[] = {
    {"reference", "surface", KEY_TEXT, "", "", "heap", "the surface that is watched"},
    {"reference", "angle", KEY_REAL, "1", "none | (0, 90)", "none",
     "angle expected, in degrees"},
    {"reference", "tolerance", KEY_REAL, "1", "(0, 90)", "3", "of it, in degrees"},
    {"reference", "friction", KEY_REAL, "1", "(0, inf)", NULL, "of the grains"},
    {"reference", "rest", KEY_REAL, "1", "(0, 1)", "20 %",
     "last part of the run, over which the heap must be at rest"},
    {"reference", "drift", KEY_REAL, "1", "(0, 90)", "1",
     "degrees that the angle may change by at rest"},
    {0},
};

struct repose {
    const struct surface *surface;
    double angle, tolerance, friction, rest, drift;
    double least, most; /* degree, at rest */
};

void reference_create(struct sim *s, struct scene *scene)
{
    struct repose *const p = xalloc(1, sizeof *p);
    s->reference = p;
    p->surface = surface_find(s, scene_text(scene, "reference", NULL, "surface"));
    p->angle = scene_word(scene, "reference", NULL, "angle", "none")
                   ? (double)NAN
                   : scene_real(scene, "reference", NULL, "angle");
    p->tolerance = scene_real(scene, "reference", NULL, "tolerance");
    p->friction = scene_real(scene, "reference", NULL, "friction");
    p->rest = scene_real(scene, "reference", NULL, "rest");
    p->drift = scene_real(scene, "reference", NULL, "drift");
    p->least = (double)INFINITY;
    p->most = -(double)INFINITY;
    if (!p->surface)
        scene_error(scene, "reference", NULL, "surface", "there is no [surface %s]",
                    scene_text(scene, "reference", NULL, "surface"));
}

void reference_watch(struct sim *s)
{
    struct repose *const p = s->reference;
    if (s->t < (1.0 - p->rest) * s->run.end || p->surface->points == 0)
        return;
    p->least = fmin(p->least, p->surface->angle);
    p->most = fmax(p->most, p->surface->angle);
}

void reference_report(struct sim *s)
{
    struct repose *const p = s->reference;
    const struct surface *const f = p->surface;
    const double angle = f->angle,
                 d = s->grains.n_species > 0 ? s->grains.species[0].diameter : 0.0;
    const double steepest = atan(p->friction) * 180.0 / 3.14159265358979323846 + 30.0;
    const bool steady = p->most >= p->least && p->most - p->least <= p->drift;
    const bool straight = f->scatter < d;
    const bool possible = angle > 0.0 && angle < steepest;
    const bool expected = isnan(p->angle) || fabs(angle - p->angle) <= p->tolerance;
    const bool good = steady && straight && possible && expected;
    summary_number(&s->summary, "angle_of_repose", angle, "degree");
    summary_number(&s->summary, "angle_drift", p->most - p->least, "degree");
    summary_number(&s->summary, "surface_scatter", f->scatter, "m");
    summary_number(&s->summary, "surface_points", f->points, "1");
    if (!isnan(p->angle))
        summary_reference(&s->summary,
                          (struct comparison){.quantity = "angle of repose",
                                              .source = reference_about.source,
                                              .unit = "degree",
                                              .got = angle,
                                              .want = p->angle,
                                              .error = angle / p->angle - 1.0,
                                              .tolerance = p->tolerance / p->angle});
    summary_text(&s->summary, "verdict", good ? "pass" : "FAIL");
    printf("reference: %s angle of repose %.1f degrees over %d points, scatter %.2f d, drift "
           "%.2f degrees at rest%s%s%s%s\n",
           good ? "pass" : "FAIL", angle, f->points, d > 0.0 ? f->scatter / d : 0.0,
           p->most - p->least, steady ? "" : ", NOT STEADY", straight ? "" : ", NOT STRAIGHT",
           possible ? "" : ", IMPOSSIBLE", expected ? "" : ", NOT AS EXPECTED");
}

void reference_free(struct sim *s)
{
    xfree(s->reference);
}
