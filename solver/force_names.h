/* force_names.h - a list of answers of forces/ as text: "brownian+magnus" for "magnus, brownian". */
#ifndef FORCE_NAMES_H
#define FORCE_NAMES_H

/* Sorted, each once, joined by "+"; "none" where there is none. Free with xfree. */
char *force_names(const char *text);

#endif
