/* course.h - a value in time: constant, ramped up from zero, or from a table.
 *
 * For what is given at the sides of the box: velocity, head, flux. A table is a CSV file of two
 * columns, time in s and the value in its SI unit, with # for comments and a head line allowed;
 * linear between its lines, constant before the first and after the last. */
#ifndef COURSE_H
#define COURSE_H

#include "scene.h"

struct course {
    double value; /* SI; what a ramp ends at, or a constant */
    double ramp;  /* s; the value grows from 0 at t = 0 to `value`; 0: at once */
    int n;        /* lines of the table; 0: none */
    double *time, *level;
};

double course_at(const struct course *c, double t);
double course_most(const struct course *c); /* largest absolute value, for limits */

/* Reads the table `key` names, "" for none; a relative path is looked up beside the scene, then
 * from here. What is wrong with it goes on the scene's list. */
void course_read_table(struct course *c, struct scene *s, const char *section, const char *name,
                       const char *key);
void course_free(struct course *c);

#endif
