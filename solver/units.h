/* units.h - units of measure, by udunits2. */
#ifndef UNITS_H
#define UNITS_H

#include <stdbool.h>

enum unit_result { UNIT_GOOD, UNIT_UNKNOWN, UNIT_DIMENSION };

/* Factor and offset that take a value in `unit` to one in `si`: si = factor * value + offset.
 */
enum unit_result units_convert(const char *unit, const char *si, double *factor,
                               double *offset);

#endif
