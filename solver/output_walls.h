/* output_walls.h - the surfaces of the walls in run.nc. Nothing where there are none to be drawn. */
#ifndef OUTPUT_WALLS_H
#define OUTPUT_WALLS_H

#include "output_file.h"

void output_walls_define(struct output_file *f, const struct sim *s);
void output_walls_begin(const struct output_file *f, const struct sim *s);
void output_walls_record(const struct output_file *f, const struct sim *s);

#endif
