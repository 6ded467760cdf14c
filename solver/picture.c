/* picture.c - a picture of a run: one style for all, a temporary name until it is complete. */
#include "picture.h"

#include <netcdf.h>
#include <string.h>

const char *const picture_colour[PICTURE_COLOURS] = {
    "#1f5fa8", "#c8502b", "#3f8f4f", "#8a5aa8", "#b8912a", "#3a9aa8", "#777777", "#222222"};

char *picture_quoted(const char *text)
{
    char *const q = xalloc(2 * strlen(text) + 3, 1), *to = q;
    *to++ = '\'';
    for (const char *c = text; *c; c++) {
        if (*c == '\'')
            *to++ = '\'';
        *to++ = (unsigned char)*c < ' ' ? ' ' : *c;
    }
    *to = '\'';
    return q;
}

void picture_text(FILE *to, const char *what, const char *text, const char *options)
{
    char *const q = picture_quoted(text);
    fprintf(to, "set %s %s %s\n", what, q, options);
    xfree(q);
}

char *picture_scene(const struct run_file *r)
{
    char *const file = run_text(r, NC_GLOBAL, "scene_file");
    const char *const slash = strrchr(file, '/'), *const name = slash ? slash + 1 : file;
    const char *const dot = strrchr(name, '.');
    char *const scene = xprintf("%.*s", (int)(dot ? dot - name : (long)strlen(name)), name);
    xfree(file);
    return scene;
}

struct picture picture_open_in(const char *directory, const char *name, int width, int height)
{
    struct picture p = {
        .path = xprintf("%s/%s", directory, name), .width = width, .height = height};
    p.part = xprintf("%s.part", p.path);
    p.gnuplot = popen("gnuplot", "w");
    if (!p.gnuplot)
        die(EXIT_WRITE, "gnuplot cannot be started (package gnuplot-nox)");
    FILE *const to = p.gnuplot;
    fprintf(to,
            "set terminal pngcairo size %d,%d enhanced font 'DejaVu Sans,13' background "
            "'#ffffff'\n",
            width, height);
    picture_text(to, "output", p.part, "");
    fprintf(to, "set border 3 lc '#444444'\nset tics nomirror out scale 0.6 tc '#333333'\n"
                "set format '%%g'\nset grid lt 1 lc '#dcdcdc' lw 0.7\n"
                "set key tc '#333333' Left reverse samplen 2.6 spacing 1.3 noenhanced\n");
    return p;
}

struct picture picture_open(const struct run_file *r, const char *name, int width, int height)
{
    struct picture p = picture_open_in(r->directory, name, width, height);
    char *const revision = run_text(r, NC_GLOBAL, "revision");
    char *const footer = xprintf("silt %s", revision);
    picture_text(p.gnuplot, "label 1", footer,
                 "at screen 0.992,0.014 right font ',9' tc '#888888' noenhanced");
    xfree(revision);
    xfree(footer);
    return p;
}

void picture_close(struct picture *p)
{
    if (pclose(p->gnuplot) != 0 || rename(p->part, p->path) != 0) {
        remove(p->part);
        die(EXIT_WRITE, "%s: gnuplot could not draw it", p->path);
    }
    printf("%s\n", p->path);
    xfree(p->path);
    xfree(p->part);
}
