/* units.c - units of measure, by udunits2. The database is read at the first use.
 *
 * udunits2 takes more for convertible than a scene should: a unit and its reciprocal (s and
 * 1/s, by 1/x), and logarithmic units. Here both are a wrong dimension. It lacks some spellings
 * that a person writes; they are added. */
#include "units.h"

#include <math.h>
#include <stddef.h>
#include <udunits2.h>
#include "base.h"

static ut_system *database;

static void add_spelling(const char *spelling, const char *meaning)
{
    ut_unit *const unit = ut_parse(database, meaning, UT_UTF8);
    if (unit)
        ut_map_symbol_to_unit(spelling, UT_UTF8, unit);
    ut_free(unit);
}

static ut_system *units(void)
{
    if (!database) {
        ut_set_error_message_handler(ut_ignore);
        database = ut_read_xml(NULL);
        if (!database)
            die(EXIT_SCENE,
                "the units database of udunits2 cannot be read (package libudunits2-0)");
        add_spelling("deg", "degree");
        add_spelling("cP", "centipoise");
        add_spelling("dyn", "dyne");
    }
    return database;
}

enum unit_result units_convert(const char *unit, const char *si, double *factor, double *offset)
{
    ut_unit *const from = ut_parse(units(), unit, UT_UTF8), *const to =
                                                                ut_parse(units(), si, UT_UTF8);
    enum unit_result result = from && to ? UNIT_DIMENSION : UNIT_UNKNOWN;
    cv_converter *const c =
        from && to && ut_are_convertible(from, to) ? ut_get_converter(from, to) : NULL;
    if (c) {
        const double at_0 = cv_convert_double(c, 0.0), at_1 = cv_convert_double(c, 1.0);
        const double at_2 = cv_convert_double(c, 2.0), step = at_1 - at_0;
        if (isfinite(step) && fabs(at_2 - at_0 - 2.0 * step) <= 1e-9 * fabs(step)) {
            *offset = at_0;
            *factor = step;
            result = UNIT_GOOD;
        }
        cv_free(c);
    }
    ut_free(from);
    ut_free(to);
    return result;
}
