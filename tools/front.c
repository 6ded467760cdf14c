/* tools/front.c - what run.sh asks before there is a binary for the scene.
 *   front slots SCENE [section.key=value ...]   the answers that the scene asks for, as variables
 *                                               of make
 *   front modules [SLOT]                        every answer (of one slot), from the answers
 *   front keys                                  every key, likewise
 * Run from the project's folder. A scene that names what does not exist is refused here (exit
 * 2). */
#include <dirent.h>
#include <dlfcn.h>
#include <libgen.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../solver/analysis.h"
#include "../solver/coupling.h"
#include "../forces/force.h"
#include "../solver/domain.h"
#include "../solver/flow.h"
#include "../solver/force_names.h"
#include "../solver/grains.h"
#include "../solver/probes.h"
#include "../solver/insert.h"
#include "../solver/run.h"
#include "../solver/turning.h"
#include "../solver/walls.h"

struct folder {
    const char *slot, *variable, *path, *standard, *question;
};

static const struct folder folders[] = {
    {"shape", "SHAPE", "shapes", "sphere", "what is a grain?"},
    {"contact", "CONTACT", "contact", "none", "what force when grains touch?"},
    {"rolling", "ROLLING", "contact/rolling", "none", "what resists their rolling?"},
    {"bond", "BOND", "contact/bond", "none", "what holds them when they are glued?"},
    {"cohesion", "COHESION", "contact/cohesion", "none",
     "what pulls when they are wet or sticky?"},
    {"lubrication", "LUBRICATION", "contact/lubrication", "none",
     "what does the film between grains do?"},
    {"drag", "DRAG", "drag", "none", "what resists the flow?"},
    {"porosity", "POROSITY", "porosity", "none", "what does the grid see of a grain?"},
    {"fluid", "FLUID", "solver/fluid", "none", "what flows?"},
    {"reference", "REFERENCE", "reference", "none", "what should come out?"},
};

/* A scene may name several of these. */
static const struct folder force_folder = {"forces", "FORCES", "forces", "standard",
                                           "what else does the fluid do to a grain?"};

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

/* The forces that the scene asks for, each checked; in make's notation. Free with xfree. */
static char *read_forces(struct scene *scene, const char *allowed, bool fluid)
{
    const char *const text = scene_text(scene, "modules", NULL, "forces");
    char *const wrong = force_names_wrong(text, allowed);
    if (wrong)
        scene_error(scene, "modules", NULL, "forces", "%s is none of: %s", wrong, allowed);
    xfree(wrong);
    return force_names(text, fluid);
}

/* Has the answer that was chosen another name than "none"? */
static bool has_fluid(struct scene *scene)
{
    struct dirent **list;
    const int n = list_answers("solver/fluid", &list);
    const int chosen = scene_choice(scene, "modules", NULL, "fluid");
    const bool fluid = chosen >= 0 && chosen < n && strcmp(list[chosen]->d_name, "none") != 0;
    free_answers(list, n);
    return fluid;
}

/* Reads [modules] only; the other sections are for the binary to judge. */
static int print_slots(int argc, char **argv)
{
    static struct key keys[FOLDERS + 2];
    char *allowed[FOLDERS];
    int choice[FOLDERS];
    struct scene *const scene = scene_load(argv[0], argc - 1, argv + 1);
    for (int i = 0; i < FOLDERS; i++) {
        allowed[i] = answers_allowed(folders[i].path);
        keys[i] = (struct key){"modules",  folders[i].slot,     KEY_CHOICE,     "",
                               allowed[i], folders[i].standard, folders[i].path};
    }
    keys[FOLDERS] = (struct key){"modules", "forces", KEY_TEXT, "", "", "standard", "forces"};
    char *const all_forces = answers_allowed("forces");
    scene_declare(scene, keys);
    char *const asked = read_forces(scene, all_forces, has_fluid(scene));
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
    printf("FORCES=%s\n", asked);
    xfree(asked);
    xfree(all_forces);
    scene_free(scene);
    return EXIT_GOOD;
}

/* An answer's own file, loaded. */
static void *load_answer(const char *where, const char *path, const char *name)
{
    char *const file = xprintf("%s/answers/%s/%s.so", where, path, name);
    void *const answer = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
    if (!answer)
        die(EXIT_SCENE, "%s: %s", file, dlerror());
    xfree(file);
    return answer;
}

static void *find_symbol(void *answer, const char *end, const char *begin)
{
    char *const symbol = xprintf("%s%s", begin, end);
    void *const found = dlsym(answer, symbol);
    if (!found)
        die(EXIT_SCENE, "%s", dlerror());
    xfree(symbol);
    return found;
}

/* Calls `visit` with what each answer of each slot says of itself, and each force. */
static void visit_answers(const char *program,
                          void (*visit)(const char *slot, const struct about *,
                                        const struct key *))
{
    char *const copy = xstrdup(program);
    const char *const where = dirname(copy);
    struct dirent **list;
    for (int f = 0; f < FOLDERS; f++) {
        const int n = list_answers(folders[f].path, &list);
        for (int i = 0; i < n; i++) {
            void *const answer = load_answer(where, folders[f].path, list[i]->d_name);
            visit(folders[f].slot, find_symbol(answer, "_about", folders[f].slot),
                  find_symbol(answer, "_keys", folders[f].slot));
        }
        free_answers(list, n);
    }
    const int n = list_answers("forces", &list);
    for (int i = 0; i < n; i++) {
        const struct force *const force = find_symbol(
            load_answer(where, "forces", list[i]->d_name), list[i]->d_name, "force_");
        visit("forces", &force->about, force->keys);
    }
    free_answers(list, n);
    xfree(copy);
}

enum { WIDTH = 96, INDENT = 18 };

/* The text after its title, broken between words. */
static void print_wrapped(int margin, const char *title, const char *text)
{
    int column = printf("%*s%-*s ", margin, "", INDENT - margin - 1, title);
    bool first = true;
    while (*text) {
        const int word = (int)strcspn(text, " ");
        if (!first && column + 1 + word > WIDTH) {
            column = printf("\n%*s", INDENT, "") - 1;
            first = true;
        }
        column += printf("%s%.*s", first ? "" : " ", word, text);
        first = false;
        text += word;
        text += strspn(text, " ");
    }
    putchar('\n');
}

/* The keys of a table, with unit (none for 1), and what they are without being given. */
static void print_module_keys(const struct key *keys)
{
    char *text = xstrdup("");
    for (const struct key *k = keys; k->section; k++) {
        const bool unit = k->unit[0] && strcmp(k->unit, "1") != 0;
        char *const longer =
            xprintf("%s%s%s.%s%s%s%s", text, k == keys ? "" : ", ", k->section, k->name,
                    unit ? " [" : "", unit ? k->unit : "", unit ? "]" : "");
        xfree(text);
        text = longer;
    }
    print_wrapped(6, "keys", text);
    xfree(text);
}

static const char *only_slot; /* of `front modules`; NULL: all */

static void print_module(const char *slot, const struct about *a, const struct key *keys)
{
    static const struct folder *last;
    const struct folder *f = &force_folder;
    if (only_slot && strcmp(only_slot, slot) != 0)
        return;
    for (int i = 0; i < FOLDERS; i++)
        if (strcmp(folders[i].slot, slot) == 0)
            f = &folders[i];
    if (f != last)
        printf("%s%s: %s  (%s/, default %s)\n", last ? "\n" : "", f->slot, f->question, f->path,
               f->standard);
    last = f;
    const bool fits = strlen(a->name) + 4 < INDENT;
    printf(fits ? "\n" : "\n  %s\n", a->name);
    print_wrapped(2, fits ? a->name : "", a->summary);
    if (a->equation[0])
        print_wrapped(6, "equation", a->equation);
    if (a->source[0])
        print_wrapped(6, "source", a->source);
    if (a->range[0])
        print_wrapped(6, "range", a->range);
    if (keys->section)
        print_module_keys(keys);
}

static void print_walls(void)
{
    printf("\nwall: what surface?  (solver/walls/, several in a scene: [wall NAME], kind = "
           "...)\n");
    for (int k = 0; wall_kinds[k]; k++)
        printf("  %-15s %s\n", wall_kinds[k]->name, wall_kinds[k]->summary);
}

static int print_modules(const char *program, const char *slot)
{
    if (slot && strcmp(slot, "wall") == 0) {
        print_walls();
        return EXIT_GOOD;
    }
    bool known = !slot || strcmp(slot, force_folder.slot) == 0;
    for (int f = 0; f < FOLDERS; f++)
        known = known || strcmp(slot, folders[f].slot) == 0;
    if (!known) {
        fprintf(stderr, "silt: no such slot: %s; there are", slot);
        for (int f = 0; f < FOLDERS; f++)
            fprintf(stderr, " %s,", folders[f].slot);
        fprintf(stderr, " %s, wall\n", force_folder.slot);
        return EXIT_SCENE;
    }
    only_slot = slot;
    visit_answers(program, print_module);
    if (!slot)
        print_walls();
    printf("\nIn a scene: [modules], slot = answer. Symbols and sources: NOTATION.md; keys: "
           "./run.sh keys.\n");
    return EXIT_GOOD;
}

static void print_answer_keys(const char *slot, const struct about *a, const struct key *keys)
{
    char *const title = xprintf("\n%s = %s", slot, a->name);
    keys_print(stdout, title, keys);
    xfree(title);
}

static int print_keys(const char *program)
{
    printf("  %-28s %-8s %-34s %-14s %s\n", "key", "unit", "allowed", "default", "meaning");
    keys_print(stdout, "\nin every scene", domain_keys);
    keys_print(stdout, "", run_keys);
    keys_print(stdout, "\ngrains", grains_keys);
    keys_print(stdout, "", sizes_keys);
    keys_print(stdout, "\nof shapes that are no spheres", turning.keys);
    keys_print(stdout, "\ngrains that come and go", insert_keys);
    keys_print(stdout, "\nwalls", wall_keys);
    keys_print(stdout, "", wall_motion_keys);
    for (int k = 0; wall_kinds[k]; k++) {
        char *const title =
            xprintf("\nwall, kind = %s: %s", wall_kinds[k]->name, wall_kinds[k]->summary);
        if (wall_kinds[k]->keys && wall_kinds[k]->keys->section)
            keys_print(stdout, title, wall_kinds[k]->keys);
        else
            printf("%s\n", title);
        xfree(title);
    }
    for (int k = 0; analysis_parts[k]; k++)
        keys_print(stdout, k == 0 ? "\nwhat is measured" : "", analysis_parts[k]->keys);
    keys_print(stdout, "\nwith a fluid", flow_keys);
    keys_print(stdout, "", coupling_keys);
    keys_print(stdout, "", probe_keys);
    keys_print(stdout, "", drag_grains_keys);
    visit_answers(program, print_answer_keys);
    return EXIT_GOOD;
}

int main(int argc, char **argv)
{
    if (argc >= 3 && strcmp(argv[1], "slots") == 0)
        return print_slots(argc - 2, argv + 2);
    if ((argc == 2 || argc == 3) && strcmp(argv[1], "modules") == 0)
        return print_modules(argv[0], argv[2]);
    if (argc == 2 && strcmp(argv[1], "keys") == 0)
        return print_keys(argv[0]);
    fprintf(stderr,
            "usage: front slots SCENE [section.key=value ...] | modules [SLOT] | keys\n");
    return EXIT_SCENE;
}
