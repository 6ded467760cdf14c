/* log.h - what a run says of itself before it starts. */
#ifndef LOG_H
#define LOG_H

#include <stdio.h>

struct sim;

/* Answers with their equations, grains and materials, grid, steps, and which forces act. */
void log_start(FILE *out, const struct sim *s);

#endif
