/* verify/answers.h - every answer of a slot, loaded one after the other: a contract is tested
 * against whatever files there are in the slot's folder. */
#ifndef ANSWERS_H
#define ANSWERS_H

#include <dirent.h>
#include <dlfcn.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "check.h"

static int answers_is_object(const struct dirent *e)
{
    const size_t n = strlen(e->d_name);
    return n > 3 && strcmp(e->d_name + n - 3, ".so") == 0;
}

/* Visits every answer of the folder ("drag") beside the test's program, in order of name. */
static inline int answers_visit(const char *program, const char *folder,
                                void (*visit)(const char *name, void *answer))
{
    char path[1024], file[2048], copy[1024];
    struct dirent **entry;
    snprintf(copy, sizeof copy, "%s", program);
    snprintf(path, sizeof path, "%s/../answers/%s", dirname(copy), folder);
    const int n = scandir(path, &entry, answers_is_object, alphasort);
    for (int i = 0; i < n; i++) {
        snprintf(file, sizeof file, "%s/%s", path, entry[i]->d_name);
        void *const answer = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
        entry[i]->d_name[strlen(entry[i]->d_name) - 3] = '\0';
        if (check(answer != NULL, "%s/%s loads%s%s", folder, entry[i]->d_name,
                  answer ? "" : ": ", answer ? "" : dlerror()))
            visit(entry[i]->d_name, answer);
        if (answer)
            dlclose(answer);
        free(entry[i]);
    }
    if (n >= 0)
        free(entry);
    check(n > 0, "%d answers found in %s", n, path);
    return n;
}

/* The address of a symbol of an answer; a missing one is a failed check. The result is stored
 * through a pointer, since C has no conversion from object to function pointers. */
static inline bool answers_symbol(void *answer, const char *name, void *address, size_t size)
{
    void *const found = dlsym(answer, name);
    memcpy(address, &found, size);
    return found != NULL || check(false, "symbol %s is missing", name);
}

#endif
