/* provenance_info.h - what made this binary and this run, for every output. */
#ifndef PROVENANCE_INFO_H
#define PROVENANCE_INFO_H

#include "base.h"

struct provenance {
    const char *key;
    char value[512];
};

enum { PROVENANCE_LINES = 24 };

/* Fills up to PROVENANCE_LINES lines: revision, compiler, flags, libraries, answers, host,
 * date, threads. Returns how many. */
int provenance(struct provenance line[PROVENANCE_LINES]);

#endif
