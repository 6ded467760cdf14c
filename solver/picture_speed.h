/* picture_speed.h - colours of speed, their scale below a picture, and ticks that have room. */
#ifndef PICTURE_SPEED_H
#define PICTURE_SPEED_H

#include <stdbool.h>
#include "picture.h"

/* "#9cc3e0" to red, green, blue, each in [0, 255]. */
void hex_colour(const char *hex, double out[3]);

/* The colour of a speed, as part of the fastest, as the scale has it; in [0, 255]. */
void speed_colour(double part, double out[3]);

/* Sets the palette, and draws the scale from 0 to `fastest` (m/s) with its lower left corner at
 * x, y (pixels); `above`: with the note that a few grains are faster. */
void speed_bar(const struct picture *p, int x, int y, double fastest, bool above);

/* Between ticks of an axis from `low` to `high` that is `across` pixels long: 1, 2 or 5 times a power of
 * ten, such that their labels stay apart and are not more than ten. */
double tick_step(double low, double high, int across);

#endif
