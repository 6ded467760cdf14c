/* test_scene.c - the scene reader: numbers and units arrive in SI, and every kind of mistake is
 * refused with its own words.
 *
 * A refusal ends the program, so each is tried in a child, whose stderr is compared as a whole.
 */
#define _DEFAULT_SOURCE /* mkdtemp */
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include "../solver/scene.h"
#include "check.h"
#include "keys.h"

static const char file[] = "a.ini";

static const struct key table[] = {
    {"fluid", "density", KEY_REAL, "kg m-3", "(0, inf)", NULL, "density"},
    {"fluid", "dt", KEY_REAL, "s", "auto | (0, inf)", "auto", "step"},
    {"fluid", "storage", KEY_REAL, "m-1", "[0, inf)", "0 1/m", "storage"},
    {"fluid", "part", KEY_REAL, "1", "(0, 1]", "25 %", "a part"},
    {"fluid", "angle", KEY_REAL, "rad", "(-inf, inf)", "0 deg", "an angle"},
    {"fluid", "levels", KEY_INT, "", "[1, 100]", "7", "levels"},
    {"fluid", "size", KEY_VECTOR, "m", "(0, 1e6]", "1 2 3 mm", "a box"},
    {"fluid", "cells", KEY_CELLS, "", "[1, 999]", "4 5 6", "cells"},
    {"fluid", "sides", KEY_CHOICE, "", "wall | slip | periodic", "slip", "sides"},
    {"fluid", "name", KEY_TEXT, "", "", "", "a name"},
    {"body", "mass", KEY_REAL, "kg", "(0, inf)", "1 g", "mass"},
    {0},
};

/* Reads every key of the table, as a program would. */
static void read_all(struct scene *s)
{
    const char *const *names;
    scene_declare(s, table);
    const int n = scene_names(s, "body", &names);
    for (const struct key *k = table; k->section; k++) {
        if (strcmp(k->section, "body") != 0)
            read_key(s, k, NULL);
        else
            for (int i = 0; i < n; i++)
                read_key(s, k, names[i]);
    }
}

static void write_file(const char *text, size_t length)
{
    FILE *const f = fopen(file, "wb");
    if (!f || fwrite(text, 1, length, f) != length || fclose(f) != 0)
        die(EXIT_WRITE, "%s cannot be written", file);
}

/* What a child says on stderr; its exit status. */
static int overhear(void (*child)(void *), void *what, char *said, size_t size)
{
    int tube[2], status = -1;
    if (pipe(tube) != 0)
        die(EXIT_WRITE, "no pipe");
    fflush(stdout);
    const pid_t id = fork();
    if (id == 0) {
        dup2(tube[1], STDERR_FILENO);
        close(tube[0]);
        child(what);
        fflush(stderr);
        _exit(EXIT_GOOD);
    }
    close(tube[1]);
    size_t n = 0;
    for (ssize_t got = 1; got > 0 && n + 1 < size; n += got > 0 ? (size_t)got : 0)
        got = read(tube[0], said + n, size - 1 - n);
    said[n] = '\0';
    close(tube[0]);
    waitpid(id, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void load_file(void *what)
{
    (void)what;
    struct scene *const s = scene_load(file, 0, NULL);
    read_all(s);
    scene_finish(s);
    scene_free(s);
}

static void load_override(void *what)
{
    char *argument[] = {what};
    struct scene *const s = scene_load(file, 1, argument);
    read_all(s);
    scene_finish(s);
    scene_free(s);
}

static void judge(int status, const char *said, const char *want, const char *text)
{
    const bool same = strcmp(said, want) == 0;
    check(same && status == (want[0] ? EXIT_SCENE : EXIT_GOOD), "%s: exit %d, %.*s%s%s", text,
          status, (int)strcspn(said, "\n"), said, same ? "" : "; want ", same ? "" : want);
}

/* A scene of this text must be refused with just these words ("": must be taken). */
static void refused(const char *text, const char *want)
{
    char said[8192], name[64];
    int n = 0;
    for (const char *c = text; *c && n < 60; c++)
        name[n++] = (char)(*c == '\n' ? '/' : *c < ' ' ? '?' : *c);
    name[n] = '\0';
    write_file(text, strlen(text));
    const int status = overhear(load_file, NULL, said, sizeof said);
    judge(status, said, want, name);
}

static void override(const char *argument, const char *want)
{
    char said[8192], *const copy = xstrdup(argument);
    write_file("[fluid]\ndensity = 1 kg/m3\n", 26);
    const int status = overhear(load_override, copy, said, sizeof said);
    judge(status, said, want, argument);
    xfree(copy);
}

#define GOOD "[fluid]\ndensity = 1 kg/m3\n" /* the next line is the third */

static void test_lines(void)
{
    refused(GOOD, "");
    refused(
        "\xEF\xBB\xBF; \xC2\xB5m\r\n[ fluid ]  ; here\r\n  density = 1 kg/m3 ; there\r\n#\r\n",
        "");
    refused("[fluid]\ndensity=1kg/m3 ; so;so", "");
    refused("", "a.ini: the file holds no [section]\n");
    refused("; nothing\n\n", "a.ini: the file holds no [section]\n");
    refused(GOOD "x\001y = 3\nwhat\n",
            "a.ini:3: the file is not text (it holds control bytes)\n");
    refused(GOOD "levels 3\n",
            "a.ini:3: \"levels 3\": neither a [section], nor key = value, nor a ; comment\n");
    refused(GOOD "= 3\n", "a.ini:3: \"= 3\": a value without a key\n");
    refused("levels = 3\n" GOOD, "a.ini:1: levels = 3: stands before the first [section]\n");
    refused(GOOD "[body a\n",
            "a.ini:3: \"[body a\": a [section] without its closing bracket\n");
    refused(GOOD "[body a] mass\n",
            "a.ini:3: \"[body a] mass\": something follows the [section]\n");
    refused(GOOD "[ ]\n", "a.ini:3: \"[ ]\": a [section] without a name\n");
    refused(GOOD "levels = 3\n\nlevels = 4\n",
            "a.ini:5: fluid.levels = 4: given twice, first in line 3\n");
    refused(GOOD "[body a]\n[fluid]\nlevels = 3\n",
            "a.ini:4: [fluid]: given twice, first in line 1\n");
    refused(GOOD "[body]\nmass = 1 kg\n", "a.ini:3: [body]: needs a name, as in [body NAME]\n");
    refused(GOOD "[bodi a]\nmass = 1 kg\n",
            "a.ini:3: [bodi a]: no such section (did you mean body?)\n");
    refused(GOOD "[fluid two]\nlevels = 3\n",
            "a.ini:3: [fluid two]: takes no name, or nothing in this scene uses it\n");
    refused(GOOD "levls = 3\n",
            "a.ini:3: fluid.levls = 3: no such key (did you mean fluid.levels?)\n");
    refused(GOOD "quite_else = 3\n", "a.ini:3: fluid.quite_else = 3: no such key\n");
    refused(GOOD "[body a]\nmas = 3 kg\n",
            "a.ini:4: body a.mas = 3 kg: no such key (did you mean body a.mass?)\n");
    refused("[fluid]\nlevels = 3\n",
            "a.ini:1: fluid.density: must be given (density), in units of "
            "kg m-3, (0, inf)\n");
}

static void test_values(void)
{
    refused(GOOD "dt = 5\n", "a.ini:3: fluid.dt = 5: needs a unit, as in s\n");
    refused(
        GOOD "dt = 5 sec5\n",
        "a.ini:3: fluid.dt = 5 sec5: \"sec5\" has the wrong dimension; it needs that of s\n");
    refused(GOOD "dt = 5 blink\n",
            "a.ini:3: fluid.dt = 5 blink: \"blink\" is not a unit; it needs one as in s\n");
    refused(GOOD "dt = 5 1/s\n",
            "a.ini:3: fluid.dt = 5 1/s: \"1/s\" has the wrong dimension; it needs that of s\n");
    refused(
        GOOD "storage = 1 m\n",
        "a.ini:3: fluid.storage = 1 m: \"m\" has the wrong dimension; it needs that of m-1\n");
    refused(GOOD "dt = 1 lg(re 1 s)\n",
            "a.ini:3: fluid.dt = 1 lg(re 1 s): \"lg(re 1 s)\" has the "
            "wrong dimension; it needs that of s\n");
    refused(GOOD "dt = soon\n",
            "a.ini:3: fluid.dt = soon: must be auto or one number with a unit, as in s\n");
    refused(GOOD "dt = nan s\n",
            "a.ini:3: fluid.dt = nan s: must be auto or one number with a unit, as in s\n");
    refused(GOOD "dt = 1e999 s\n",
            "a.ini:3: fluid.dt = 1e999 s: must be auto or one number with a unit, as in s\n");
    refused(GOOD "dt = 0x10 s\n",
            "a.ini:3: fluid.dt = 0x10 s: must be auto or one number with a unit, as in s\n");
    refused(GOOD "dt = 1 2 s\n",
            "a.ini:3: fluid.dt = 1 2 s: must be auto or one number with a unit, as in s\n");
    refused(GOOD "dt =\n",
            "a.ini:3: fluid.dt = : must be auto or one number with a unit, as in s\n");
    refused(GOOD "dt = -1 ms\n", "a.ini:3: fluid.dt = -1 ms: must lie in (0, inf) s\n");
    refused(GOOD "dt = 1e308 Ys\n", "a.ini:3: fluid.dt = 1e308 Ys: must lie in (0, inf) s\n");
    refused(GOOD "part = 1.0000001\n", "a.ini:3: fluid.part = 1.0000001: must lie in (0, 1]\n");
    refused(GOOD "part = 0\n", "a.ini:3: fluid.part = 0: must lie in (0, 1]\n");
    refused(GOOD "part = 1\n", "");
    refused(GOOD "part = 100.1 %%\n",
            "a.ini:3: fluid.part = 100.1 %%: \"%%\" follows the number; it is a pure number\n");
    refused(GOOD "part = 100.1 %\n", "a.ini:3: fluid.part = 100.1 %: must lie in (0, 1]\n");
    refused(GOOD "part = 0.3 m\n",
            "a.ini:3: fluid.part = 0.3 m: \"m\" follows the number; it is a pure number\n");
    refused(GOOD "part = 0.3 deg\n",
            "a.ini:3: fluid.part = 0.3 deg: is a pure number: it takes no unit (deg)\n");
    refused(GOOD "levels = 2.5\n", "a.ini:3: fluid.levels = 2.5: must be one whole number\n");
    refused(GOOD "levels = 3 m\n", "a.ini:3: fluid.levels = 3 m: must be one whole number\n");
    refused(GOOD "levels = 3e9\n", "a.ini:3: fluid.levels = 3e9: must be one whole number\n");
    refused(GOOD "levels = 101\n", "a.ini:3: fluid.levels = 101: must lie in [1, 100]\n");
    refused(GOOD "cells = 1 2\n", "a.ini:3: fluid.cells = 1 2: must be three whole numbers\n");
    refused(GOOD "cells = 1 2 0\n", "a.ini:3: fluid.cells = 1 2 0: must lie in [1, 999]\n");
    refused(GOOD "size = 1 2 mm\n",
            "a.ini:3: fluid.size = 1 2 mm: must be three numbers with a unit, as in m\n");
    refused(GOOD "size = 1 2 3 4 mm\n",
            "a.ini:3: fluid.size = 1 2 3 4 mm: must be three numbers with a unit, as in m\n");
    refused(GOOD "size = 1 -2 3 mm\n",
            "a.ini:3: fluid.size = 1 -2 3 mm: must lie in (0, 1e6] m\n");
    refused(GOOD "sides = wal\n", "a.ini:3: fluid.sides = wal: must be one of wall | slip | "
                                  "periodic (did you mean wall?)\n");
    refused(GOOD "[body a]\nmass = 5 m\n",
            "a.ini:4: body a.mass = 5 m: \"m\" has the wrong dimension; it needs that of kg\n");
}

static void test_overrides(void)
{
    override("fluid.density=2 g/cm3", "");
    override("body new.mass = 3 g", "");
    override("fluid.part = 2", "command line: fluid.part = 2: must lie in (0, 1]\n");
    override("fluid.densty=2 kg/m3",
             "command line: fluid.densty = 2 kg/m3: no such key (did you mean "
             "fluid.density?)\n");
    override("flujd.x=2", "command line: [flujd]: no such section (did you mean fluid?)\n");
    override("density=2", "command line: density=2: must read section.key=value\n");
    override(".density=2", "command line: .density=2: must read section.key=value\n");
    override("fluid.=2", "command line: fluid.=2: must read section.key=value\n");
}

/* All errors at once, in order of line, no more than fifty; a binary file gives one only. */
static void test_many(void)
{
    char text[4096] = "[fluid]\ndensity = 0 kg/m3\n", said[16384];
    size_t n = strlen(text);
    for (int i = 0; i < 70; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "k%d = 1\n", i);
    write_file(text, n);
    const int status = overhear(load_file, NULL, said, sizeof said);
    int lines = 0, last = 0, ordered = 1;
    for (const char *c = said; *c; c += strcspn(c, "\n") + 1, lines++) {
        int line;
        if (sscanf(c, "a.ini:%d:", &line) == 1) {
            ordered = ordered && line > last;
            last = line;
        }
    }
    check(status == EXIT_SCENE && lines == 51 && ordered && strstr(said, "\n... and 21 more\n"),
          "71 errors: %d lines, in order %d, the last: %.20s", lines, ordered,
          n > 0 && strlen(said) > 16 ? said + strlen(said) - 16 : said);
    const char noise[] = "\177ELF\0\0\n\0\n\0=\n[\n";
    write_file(noise, sizeof noise);
    judge(overhear(load_file, NULL, said, sizeof said), said,
          "a.ini:1: the file is not text (it holds control bytes)\n", "binary file");
}

static double value(const char *key, const char *text)
{
    char *argument[] = {xprintf("fluid.%s=%s", key, text)};
    struct scene *const s = scene_load(NULL, 1, argument);
    scene_declare(s, table);
    const double x = scene_real(s, "fluid", NULL, key);
    check(scene_errors(s) == 0, "%s = %s is taken", key, text);
    scene_free(s);
    xfree(argument[0]);
    return x;
}

static void test_units(void)
{
    const struct {
        const char *key, *text;
        double want;
    } list[] = {
        {"density", "1234.5678901234567 kg/m3", 1234.5678901234567},
        {"density", "2.7182818284590451 g/cm3", 2718.2818284590451},
        {"density", "2.7182818284590451 kg m-3", 2.7182818284590451},
        {"density", "2.7182818284590451 kg/m^3", 2.7182818284590451},
        {"density", "3.1415926535897931 t/m3", 3141.5926535897931},
        {"dt", "7.3890560989306504 us", 7.3890560989306504e-6},
        {"dt", "7.3890560989306504 \xC2\xB5s", 7.3890560989306504e-6},
        {"dt", "1.6180339887498949ms", 1.6180339887498949e-3},
        {"dt", "+.57721566490153287e1 min", 346.32939894091972},
        {"storage", "1.4142135623730951 1/mm", 1414.2135623730951},
        {"storage", "1.4142135623730951e-3 cm-1", 0.14142135623730951},
        {"part", "33.333333333333336 %", 0.33333333333333336},
        {"part", "0.69314718055994529", 0.69314718055994529},
        {"angle", "-57.295779513082323 deg", -1.0},
        {"angle", "0.57295779513082323 rad", 0.57295779513082323},
    };
    for (size_t i = 0; i < sizeof list / sizeof list[0]; i++)
        check_rel(value(list[i].key, list[i].text), list[i].want, 1e-15 * 4.0, list[i].text);
}

static void test_resolved(void)
{
    char *arguments[] = {xstrdup("fluid.levels=8"), xstrdup("fluid.levels=9"),
                         xstrdup("body z.mass=2 mg")};
    write_file(GOOD "levels = 3\n[body y]\n", strlen(GOOD "levels = 3\n[body y]\n"));
    struct scene *const s = scene_load(file, 3, arguments);
    const char *const *names;
    int cells[3];
    read_all(s);
    scene_finish(s);
    check(scene_int(s, "fluid", NULL, "levels") == 9, "the last override wins");
    check(scene_names(s, "body", &names) == 2 && strcmp(names[0], "y") == 0 &&
              strcmp(names[1], "z") == 0,
          "instances of the file, then those of the command line");
    check_rel(scene_real(s, "body", "y", "mass"), 1e-3, 4e-15, "default of a named section");
    check_rel(scene_real(s, "body", "z", "mass"), 2e-6, 4e-15, "override of a named section");
    check_rel(scene_vector(s, "fluid", NULL, "size").z, 3e-3, 4e-15, "default of a vector");
    scene_cells(s, "fluid", NULL, "cells", cells);
    check(cells[0] == 4 && cells[1] == 5 && cells[2] == 6, "default of cells");
    check(scene_choice(s, "fluid", NULL, "sides") == 1, "default of a choice");
    check(scene_word(s, "fluid", NULL, "dt", "auto"), "default that is a word");
    check(!scene_given(s, "fluid", NULL, "dt") && scene_given(s, "fluid", NULL, "levels"),
          "given or not");
    char *const text = scene_resolved(s);
    check(strcmp(text, "fluid.density = 1 kg/m3\nfluid.dt = auto\nfluid.storage = 0 1/m\n"
                       "fluid.part = 25 %\nfluid.angle = 0 deg\nfluid.levels = 9\n"
                       "fluid.size = 1 2 3 mm\nfluid.cells = 4 5 6\nfluid.sides = slip\n"
                       "fluid.name = \nbody y.mass = 1 g\nbody z.mass = 2 mg\n") == 0,
          "the scene as resolved:\n%s", text);
    xfree(text);
    scene_free(s);
    for (int i = 0; i < 3; i++)
        xfree(arguments[i]);
}

int main(void)
{
    char folder[] = "/tmp/silt-scene-XXXXXX";
    if (!mkdtemp(folder) || chdir(folder) != 0)
        die(EXIT_WRITE, "%s cannot be made", folder);
    test_units();
    test_lines();
    test_values();
    test_overrides();
    test_many();
    test_resolved();
    unlink(file);
    if (chdir("/") == 0)
        rmdir(folder);
    return check_end();
}
