/* units.c - units of measure, by udunits2. The database is read at the first use. */
#include "units.h"

#include <stddef.h>
#include <udunits2.h>
#include "base.h"

static ut_system *database;

static ut_system *units(void)
{
    if (!database) {
        ut_set_error_message_handler(ut_ignore);
        database = ut_read_xml(NULL);
        if (!database)
            die(EXIT_SCENE, "the units database of udunits2 cannot be read (package libudunits2-0)");
    }
    return database;
}

enum unit_result units_convert(const char *unit, const char *si, double *factor, double *offset)
{
    ut_unit *const from = ut_parse(units(), unit, UT_UTF8), *const to = ut_parse(units(), si, UT_UTF8);
    enum unit_result result = from && to ? UNIT_DIMENSION : UNIT_UNKNOWN;
    cv_converter *const c =
        from && to && ut_are_convertible(from, to) ? ut_get_converter(from, to) : NULL;
    if (c) {
        *offset = cv_convert_double(c, 0.0);
        *factor = cv_convert_double(c, 1.0) - *offset;
        result = UNIT_GOOD;
        cv_free(c);
    }
    ut_free(from);
    ut_free(to);
    return result;
}
