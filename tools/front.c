/* tools/front.c - what run.sh asks before there is a binary for the scene.
 *   front slots SCENE [section.key=value ...]   the answers that the scene asks for, as make
 * variables front modules | front keys                  every answer / every key, from the
 * answers themselves Run from the project's folder. A scene that names what does not exist is
 * refused here (exit 2). */
#include <dirent.h>
#include <dlfcn.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../solver/coupling.h"
#include "../solver/domain.h"
#include "../solver/flow.h"
#include "../solver/grains.h"
#include "../solver/run.h"
#include "../solver/walls.h"

struct folder {
    const char *slot, *variable, *path, *standard;
};

static const struct folder folders[] = {
    {"shape", "SHAPE", "shapes", "sphere"},
    {"contact", "CONTACT", "contact", "none"},
    {"rolling", "ROLLING", "contact/rolling", "none"},
    {"bond", "BOND", "contact/bond", "none"},
    {"cohesion", "COHESION", "contact/cohesion", "none"},
    {"drag", "DRAG", "drag", "none"},
    {"porosity", "POROSITY", "porosity", "none"},
    {"fluid", "FLUID", "solver/fluid", "none"},
    {"reference", "REFERENCE", "reference", "none"},
};

enum { FOLDERS = sizeof folders / sizeof folders[0] };

static int is_answer(const struct dirent *e)
{
    const size_t n = strlen(e->d_name);
    return n > 2 && strcmp(e->d_name + n - 2, ".c") == 0;
}

/* The answers of a folder in order of name; the names lose their ".c". */
static int list_answers(const char *path, struct dirent ***list)
{
    const int n = scandir(path, list, is_answer, alphasort);
    if (n < 0)
        die(EXIT_SCENE, "%s: no such folder; run from the project's folder", path);
    for (int i = 0; i < n; i++)
        (*list)[i]->d_name[strlen((*list)[i]->d_name) - 2] = '\0';
    return n;
}

static void free_answers(struct dirent **list, int n)
{
    for (int i = 0; i < n; i++)
        free(list[i]);
    free(list);
}

/* The words "a | b | c" of a folder's answers, as the `allowed` of a choice. */
static char *answers_allowed(const char *path)
{
    struct dirent **list;
    const int n = list_answers(path, &list);
    char *text = xstrdup("");
    for (int i = 0; i < n; i++) {
        char *const longer = xprintf("%s%s%s", text, i ? " | " : "", list[i]->d_name);
        xfree(text);
        text = longer;
    }
    free_answers(list, n);
    return text;
}

/* Reads [modules] only; the other sections are for the binary to judge. */
static int print_slots(int argc, char **argv)
{
    static struct key keys[FOLDERS + 1];
    char *allowed[FOLDERS];
    int choice[FOLDERS];
    struct scene *const scene = scene_load(argv[0], argc - 1, argv + 1);
    for (int i = 0; i < FOLDERS; i++) {
        allowed[i] = answers_allowed(folders[i].path);
        keys[i] = (struct key){"modules",  folders[i].slot,     KEY_CHOICE,     "",
                               allowed[i], folders[i].standard, folders[i].path};
    }
    scene_declare(scene, keys);
    for (int i = 0; i < FOLDERS; i++)
        choice[i] = scene_choice(scene, "modules", NULL, folders[i].slot);
    scene_finish_section(scene, "modules");
    for (int i = 0; i < FOLDERS; i++) {
        struct dirent **list;
        const int n = list_answers(folders[i].path, &list);
        printf("%s=%s ", folders[i].variable, list[choice[i]]->d_name);
        free_answers(list, n);
        xfree(allowed[i]);
    }
    putchar('\n');
    scene_free(scene);
    return EXIT_GOOD;
}

/* Calls `visit` with what each answer of each slot says of itself. */
static void visit_answers(const char *program,
                          void (*visit)(const struct folder *, const struct about *,
                                        const struct key *))
{
    char *const copy = xstrdup(program);
    const char *const where = dirname(copy);
    for (int f = 0; f < FOLDERS; f++) {
        struct dirent **list;
        const int n = list_answers(folders[f].path, &list);
        for (int i = 0; i < n; i++) {
            char *const file =
                xprintf("%s/answers/%s/%s.so", where, folders[f].path, list[i]->d_name);
            char *const about = xprintf("%s_about", folders[f].slot);
            char *const keys = xprintf("%s_keys", folders[f].slot);
            void *const answer = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
            if (!answer || !dlsym(answer, about) || !dlsym(answer, keys))
                die(EXIT_SCENE, "%s: %s", file, dlerror());
            visit(&folders[f], dlsym(answer, about), dlsym(answer, keys));
            xfree(file);
            xfree(about);
            xfree(keys);
        }
        free_answers(list, n);
    }
    xfree(copy);
}

static void print_module(const struct folder *f, const struct about *a, const struct key *keys)
{
    printf("%s = %s\n    %s\n", f->slot, a->name, a->summary);
    if (a->equation[0])
        printf("    equation  %s\n", a->equation);
    if (a->source[0])
        printf("    source    %s\n", a->source);
    if (a->range[0])
        printf("    range     %s\n", a->range);
    for (const struct key *k = keys; k->section; k++)
        printf("%s%s.%s", k == keys ? "    keys      " : ", ", k->section, k->name);
    printf("%s\n", keys->section ? "\n" : "");
}

static void print_answer_keys(const struct folder *f, const struct about *a,
                              const struct key *keys)
{
    char *const title = xprintf("\n%s = %s", f->slot, a->name);
    keys_print(stdout, title, keys);
    xfree(title);
}

static int print_keys(const char *program)
{
    printf("  %-28s %-8s %-34s %-14s %s\n", "key", "unit", "allowed", "default", "meaning");
    keys_print(stdout, "\nin every scene", domain_keys);
    keys_print(stdout, "", run_keys);
    keys_print(stdout, "\ngrains", grains_keys);
    keys_print(stdout, "\nwalls", wall_keys);
    keys_print(stdout, "\nwith a fluid", flow_keys);
    keys_print(stdout, "", coupling_keys);
    keys_print(stdout, "", drag_grains_keys);
    visit_answers(program, print_answer_keys);
    return EXIT_GOOD;
}

int main(int argc, char **argv)
{
    if (argc >= 3 && strcmp(argv[1], "slots") == 0)
        return print_slots(argc - 2, argv + 2);
    if (argc == 2 && strcmp(argv[1], "modules") == 0) {
        visit_answers(argv[0], print_module);
        return EXIT_GOOD;
    }
    if (argc == 2 && strcmp(argv[1], "keys") == 0)
        return print_keys(argv[0]);
    fprintf(stderr, "usage: front slots SCENE [section.key=value ...] | modules | keys\n");
    return EXIT_SCENE;
}
