/* mesh_read.c - STL, binary and ASCII [StereoLithography89].
 *
 * Binary: 80 bytes of anything, the number of triangles, and 50 bytes for each: normal, three corners,
 * two bytes. ASCII: "solid", facets of three vertices, "endsolid"; several solids make one surface. Many
 * binary files begin with "solid" all the same, so the size decides. Normals are not read: they follow
 * from the corners. */
#include "mesh.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { HEAD = 84, FACET = 50, TRIANGLES_MOST = 20000000 };

static uint32_t little(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double little_float(const unsigned char *b)
{
    const uint32_t bits = little(b);
    float f;
    memcpy(&f, &bits, sizeof f);
    return (double)f;
}

static vec3 *read_binary(const unsigned char *data, int *n)
{
    vec3 *const corner = xalloc(3 * (size_t)*n, sizeof *corner);
    for (int t = 0; t < *n; t++)
        for (int k = 0; k < 3; k++) {
            const unsigned char *const at =
                data + HEAD + (size_t)FACET * (size_t)t + 12 * (k + 1);
            corner[3 * t + k] =
                v3(little_float(at), little_float(at + 4), little_float(at + 8));
        }
    return corner;
}

/* What an ASCII file is read with: the next word, and where it stands. */
struct words {
    const char *at;
    int line;
    char word[64];
};

static bool next_word(struct words *w)
{
    while (*w->at == ' ' || *w->at == '\t' || *w->at == '\r' || *w->at == '\n')
        w->line += *w->at++ == '\n';
    const size_t n = strcspn(w->at, " \t\r\n");
    snprintf(w->word, sizeof w->word, "%.*s", (int)(n < 63 ? n : 63), w->at);
    for (char *c = w->word; *c; c++)
        if (*c >= 'A' && *c <= 'Z')
            *c = (char)(*c + 'a' - 'A');
    w->at += n;
    return n > 0;
}

static char *expected(const char *path, const struct words *w, const char *what)
{
    if (w->word[0] == '\0')
        return xprintf("%s: is truncated: it ends in line %d, where %s is expected", path,
                       w->line, what);
    return xprintf("%s:%d: \"%.40s\" where %s is expected", path, w->line, w->word, what);
}

static char *read_vertex(struct words *w, const char *path, vec3 *out)
{
    double x[3];
    if (!next_word(w) || strcmp(w->word, "vertex") != 0)
        return expected(path, w, "vertex");
    for (int k = 0; k < 3; k++) {
        char *end = NULL;
        if (!next_word(w))
            return expected(path, w, "a number");
        x[k] = strtod(w->word, &end);
        if (*end != '\0')
            return expected(path, w, "a number");
    }
    *out = v3(x[0], x[1], x[2]);
    return NULL;
}

static char *read_words(struct words *w, const char *path, const char *const *list)
{
    for (; *list; list++)
        if (!next_word(w) || (strcmp(*list, "*") != 0 && strcmp(w->word, *list) != 0))
            return expected(path, w, strcmp(*list, "*") == 0 ? "a number" : *list);
    return NULL;
}

/* To the facets of the next solid; false if none follows. Names may hold blanks: they end with their line. */
static bool next_solid(struct words *w)
{
    w->at += strcspn(w->at, "\n");
    if (!next_word(w) || strcmp(w->word, "solid") != 0)
        return false;
    w->at += strcspn(w->at, "\n");
    return true;
}

/* The facets after the line "solid NAME", of all solids of the file. */
static char *read_ascii(const char *text, const char *path, vec3 **corner, int *n)
{
    static const char *const before[] = {"normal", "*", "*", "*", "outer", "loop", NULL};
    static const char *const after[] = {"endloop", "endfacet", NULL};
    struct words w = {.at = text + strcspn(text, "\n"), .line = 1};
    int room = 0;
    char *why = NULL;
    *n = 0;
    while (!why) {
        if (!next_word(&w))
            return expected(path, &w, "facet or endsolid");
        if (strcmp(w.word, "endsolid") == 0) {
            if (!next_solid(&w))
                return w.word[0] ? expected(path, &w, "solid") : NULL;
            continue;
        }
        if (strcmp(w.word, "facet") != 0)
            return expected(path, &w, "facet or endsolid");
        if (*n == room) {
            const int more = 2 * room + 256;
            *corner = xrealloc(*corner, 3 * (size_t)room, 3 * (size_t)more, sizeof **corner);
            room = more;
        }
        why = read_words(&w, path, before);
        for (int k = 0; k < 3 && !why; k++)
            why = read_vertex(&w, path, &(*corner)[3 * *n + k]);
        if (!why)
            why = read_words(&w, path, after);
        ++*n;
    }
    return why;
}

/* The whole file, with a zero after it. */
static char *read_all(const char *path, unsigned char **data, size_t *size)
{
    struct stat info;
    FILE *const file = fopen(path, "rb");
    if (!file)
        return xprintf("%s: %s", path, strerror(errno));
    if (fstat(fileno(file), &info) != 0 || !S_ISREG(info.st_mode)) {
        fclose(file);
        return xprintf("%s: is not a file", path);
    }
    *size = (size_t)info.st_size;
    *data = xalloc(*size + 1, 1);
    const size_t got = fread(*data, 1, *size, file);
    fclose(file);
    return got == *size ? NULL : xprintf("%s: cannot be read", path);
}

static char *wrong_size(const char *path, size_t size, double wanted, double triangles)
{
    return xprintf("%s: %s: its head says %.0f triangles, which take %.0f bytes; it has %zu",
                   path,
                   wanted > (double)size ? "is truncated" : "has a wrong count of triangles",
                   triangles, wanted, size);
}

static char *read_data(const unsigned char *data, size_t size, const char *path, vec3 **corner,
                       int *n)
{
    const bool solid = size >= 6 && strncasecmp((const char *)data, "solid", 5) == 0;
    const bool text = solid && memchr(data, '\0', size) == NULL;
    const double triangles = size >= HEAD ? (double)little(data + 80) : 0.0;
    const double wanted = HEAD + FACET * triangles;
    if (size >= HEAD && (double)size == wanted && triangles <= TRIANGLES_MOST) {
        *n = (int)triangles;
        *corner = read_binary(data, n);
        return NULL;
    }
    if (text)
        return read_ascii((const char *)data, path, corner, n);
    if (size < HEAD)
        return xprintf("%s: is truncated: %zu bytes are no STL, whose head takes %d", path,
                       size, HEAD);
    if (triangles > TRIANGLES_MOST)
        return xprintf("%s: its head says %.0f triangles: no STL, or more than %d", path,
                       triangles, TRIANGLES_MOST);
    return wrong_size(path, size, wanted, triangles);
}

vec3 *mesh_read_stl(const char *path, int *n, char **why)
{
    unsigned char *data = NULL;
    size_t size = 0;
    vec3 *corner = NULL;
    *n = 0;
    *why = read_all(path, &data, &size);
    if (!*why)
        *why = read_data(data, size, path, &corner, n);
    if (!*why && *n == 0)
        *why = xprintf("%s: holds no triangle", path);
    xfree(data);
    if (*why) {
        xfree(corner);
        corner = NULL;
    }
    return corner;
}
