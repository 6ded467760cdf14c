/* provenance.c - versions, flags, answers, machine. */
#include "provenance_info.h"

#include <gsl/gsl_version.h>
#include <netcdf.h>
#include <omp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include "modules.h"
#include "provenance.h" /* made by the Makefile */

__attribute__((format(printf, 4, 5))) static void put(struct provenance *line, int *n,
                                                      const char *key, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    line[*n].key = key;
    vsnprintf(line[*n].value, sizeof line[*n].value, format, args);
    va_end(args);
    (*n)++;
}

int provenance(struct provenance line[PROVENANCE_LINES])
{
    static const char *const module_key[SLOTS] = {
        "module_shape",    "module_contact",     "module_rolling", "module_bond",
        "module_cohesion", "module_lubrication", "module_drag",    "module_porosity",
        "module_fluid",    "module_reference"};
    int n = 0;
    struct utsname host;
    char date[64] = "";
    const time_t now = time(NULL);
    strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime(&now));
    put(line, &n, "program", "silt");
    put(line, &n, "revision", "%s", SILT_REVISION);
    put(line, &n, "compiler", "%s", SILT_COMPILER);
    put(line, &n, "flags", "%s", SILT_FLAGS);
    put(line, &n, "library_netcdf", "%s", nc_inq_libvers());
    put(line, &n, "library_gsl", "%s", gsl_version);
    put(line, &n, "date", "%s", date);
    put(line, &n, "threads", "%d", omp_get_max_threads());
    if (uname(&host) == 0)
        put(line, &n, "host", "%.100s, %.100s %.100s, %.60s", host.nodename, host.sysname,
            host.release, host.machine);
    for (int i = 0; i < SLOTS; i++)
        put(line, &n, module_key[i], "%s", slots[i].about->name);
    char *const built = forces_built();
    put(line, &n, "module_forces", "%s", built);
    xfree(built);
    return n;
}
