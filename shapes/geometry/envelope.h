/* shapes/geometry/envelope.h - the smoothed envelope of a dilated polyhedron as a way to find
 * contacts.
 *
 * f(x) = (1 - k) (sum_f <n_f x - d_f>^2 / r^2 - 1) + k (x^2 / R^2 - 1), <y> = max(y, 0), R the
 * radius of the ball about its middle that holds the body: f < 0 inside [LiLiuJi23, eq. 12;
 * Houlsby09]. For k -> 0 it is the dilated polyhedron on faces and at right-angled edges and
 * vertices; it is blunter where faces meet at sharper angles and sharper at wider ones, and k
 * rounds and shrinks it. */
#ifndef ENVELOPE_H
#define ENVELOPE_H

#include "patch.h"

/* One contact of two bodies dilated by ra and rb: minimises f_a + f_b on f_a = f_b [LiLiuJi23, eq. 13]
 * from the gap that is given (of the cores), then goes from that point along the common normal to both
 * envelopes. Sets distance (of the cores: that of the envelopes + ra + rb), normal, on_a and on_b. */
void envelope_gap(const struct patch_body *a, double ra, const struct patch_body *b, double rb,
                  double k, struct gap *gap);

#endif
