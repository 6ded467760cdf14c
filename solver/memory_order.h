/* memory_order.h - the order of the grains in memory: by cells of about one and a half of them, whatever
 * their sizes, so that who touches is at hand. */
#ifndef MEMORY_ORDER_H
#define MEMORY_ORDER_H

struct sim;

/* Wraps the grains into the box and sorts all that is kept per grain in the field table; those with
 * id < 0 leave. Returns order[new] = old; free with xfree. */
int *memory_order(struct sim *s);

#endif
