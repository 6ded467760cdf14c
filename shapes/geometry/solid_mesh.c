/* shapes/geometry/solid_mesh.c - solids from files: STL (one part) or OBJ [Wavefront92] (a part per
 * object or group), each looked over before it is used.
 *
 * A part must bound a volume: no triangle without area, every edge met by two triangles that run
 * along it opposite ways, its normals outward, no two triangles through each other, and all of it
 * convex. What is wrong is said with the place where. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include "../../solver/mesh.h"
#include "dilated_species.h"

enum { LINE = 4096, CROSSING_MOST = 20000 };
#define SAME   1e-7  /* of the size: corners nearer than this are one */
#define THIN   1e-10 /* twice the area over the square of the longest side */
#define CONVEX 1e-6

/* Triangles of one part: three corners each, and their numbers once corners are joined. */
struct skin {
    int n, room;
    vec3 *corner;
    int *joined;
};

static void skin_free(struct skin *s)
{
    xfree(s->corner);
    xfree(s->joined);
    *s = (struct skin){0};
}

static void skin_add(struct skin *s, vec3 a, vec3 b, vec3 c)
{
    if (s->n == s->room) {
        const int more = 2 * s->room + 64;
        s->corner =
            xrealloc(s->corner, 3 * (size_t)s->room, 3 * (size_t)more, sizeof *s->corner);
        s->room = more;
    }
    s->corner[3 * s->n] = a;
    s->corner[3 * s->n + 1] = b;
    s->corner[3 * s->n++ + 2] = c;
}

static double skin_size(const struct skin *s)
{
    double most = 0.0;
    for (int k = 1; k < 3 * s->n; k++)
        most = fmax(most, v3_norm(v3_sub(s->corner[k], s->corner[0])));
    return most;
}

struct place {
    vec3 x;
    int from;
};

static int by_place(const void *a, const void *b)
{
    const struct place *const p = a, *const q = b;
    if (p->x.x != q->x.x)
        return p->x.x < q->x.x ? -1 : 1;
    return p->from - q->from;
}

/* Corners at the same place get the same number, that of the first. */
static void join(struct skin *s)
{
    const int n = 3 * s->n;
    const double near = SAME * skin_size(s);
    struct place *const p = xalloc((size_t)n, sizeof *p);
    s->joined = xalloc((size_t)n, sizeof *s->joined);
    for (int k = 0; k < n; k++)
        p[k] = (struct place){s->corner[k], k};
    qsort(p, (size_t)n, sizeof *p, by_place);
    for (int k = 0; k < n; k++) {
        s->joined[p[k].from] = p[k].from;
        for (int m = k - 1; m >= 0 && p[k].x.x - p[m].x.x <= near; m--)
            if (v3_norm(v3_sub(p[k].x, p[m].x)) <= near) {
                s->joined[p[k].from] = s->joined[p[m].from];
                break;
            }
    }
    xfree(p);
}

struct ends {
    int from, to, triangle;
};

static int by_ends(const void *a, const void *b)
{
    const struct ends *const p = a, *const q = b;
    if (p->from != q->from)
        return p->from < q->from ? -1 : 1;
    if (p->to != q->to)
        return p->to < q->to ? -1 : 1;
    return p->triangle - q->triangle;
}

static char *at_place(const char *what, vec3 x)
{
    return xprintf("%s at %.6g %.6g %.6g", what, x.x, x.y, x.z);
}

static char *find_thin(const struct skin *s)
{
    for (int t = 0; t < s->n; t++) {
        const vec3 *const c = &s->corner[3 * t];
        const vec3 u = v3_sub(c[1], c[0]), v = v3_sub(c[2], c[0]), w = v3_sub(c[2], c[1]);
        const double longest = fmax(v3_dot(u, u), fmax(v3_dot(v, v), v3_dot(w, w)));
        if (!(v3_norm(v3_cross(u, v)) > THIN * longest))
            return at_place("is degenerate: a triangle without area", c[0]);
    }
    return NULL;
}

static char *find_open(const struct skin *s)
{
    const int n = 3 * s->n;
    struct ends *const side = xalloc((size_t)n, sizeof *side);
    char *why = NULL;
    for (int t = 0; t < s->n; t++)
        for (int k = 0; k < 3; k++)
            side[3 * t + k] =
                (struct ends){s->joined[3 * t + k], s->joined[3 * t + (k + 1) % 3], t};
    qsort(side, (size_t)n, sizeof *side, by_ends);
    for (int k = 1; k < n && !why; k++)
        if (side[k].from == side[k - 1].from && side[k].to == side[k - 1].to)
            why =
                at_place("has two triangles that run the same way along an edge (a fold, or "
                         "normals that disagree)",
                         v3_scale(0.5, v3_add(s->corner[side[k].from], s->corner[side[k].to])));
    for (int k = 0; k < n && !why; k++) {
        const struct ends back = {side[k].to, side[k].from, 0};
        const vec3 at = v3_scale(0.5, v3_add(s->corner[back.from], s->corner[back.to]));
        int low = 0, high = n;
        while (low < high) {
            const int middle = (low + high) / 2;
            if (by_ends(&side[middle], &back) < 0)
                low = middle + 1;
            else
                high = middle;
        }
        if (low == n || side[low].from != back.from || side[low].to != back.to)
            why = at_place("is open: an edge with one triangle", at);
    }
    xfree(side);
    return why;
}

static char *find_inside_out(const struct skin *s)
{
    double volume = 0.0;
    for (int t = 0; t < s->n; t++) {
        const vec3 *const c = &s->corner[3 * t], o = s->corner[0];
        volume += v3_dot(v3_sub(c[0], o), v3_cross(v3_sub(c[1], o), v3_sub(c[2], o)));
    }
    return volume > 0.0 ? NULL : xprintf("is inside out: its normals point inward");
}

/* The segment goes through the inside of the triangle. */
static bool pierces(vec3 p, vec3 q, const vec3 *c)
{
    const vec3 d = v3_sub(q, p), u = v3_sub(c[1], c[0]), v = v3_sub(c[2], c[0]);
    const vec3 h = v3_cross(d, v), s = v3_sub(p, c[0]), k = v3_cross(s, u);
    const double det = v3_dot(u, h), edge = 1e-9 * fabs(det);
    if (fabs(det) < 1e-300)
        return false;
    const double a = v3_dot(s, h) / det, b = v3_dot(d, k) / det, t = v3_dot(v, k) / det;
    return a > edge && b > edge && a + b < 1.0 - edge && t > 1e-9 && t < 1.0 - 1e-9;
}

static bool boxes_meet(const vec3 *a, const vec3 *b)
{
    const double *const p = &a->x, *const q = &b->x;
    for (int k = 0; k < 3; k++)
        if (fmax(p[k], fmax(p[3 + k], p[6 + k])) < fmin(q[k], fmin(q[3 + k], q[6 + k])) ||
            fmax(q[k], fmax(q[3 + k], q[6 + k])) < fmin(p[k], fmin(p[3 + k], p[6 + k])))
            return false;
    return true;
}

static char *find_crossing(const struct skin *s)
{
    if (s->n > CROSSING_MOST)
        return xprintf("has %d triangles: %d at most", s->n, CROSSING_MOST);
    for (int i = 0; i < s->n; i++)
        for (int j = 0; j < s->n; j++) {
            const vec3 *const a = &s->corner[3 * i], *const b = &s->corner[3 * j];
            if (i == j || !boxes_meet(a, b))
                continue;
            for (int k = 0; k < 3; k++)
                if (pierces(a[k], a[(k + 1) % 3], b))
                    return at_place("crosses itself", b[0]);
        }
    return NULL;
}

static char *find_hollow(const struct skin *s)
{
    const double near = CONVEX * skin_size(s);
    for (int t = 0; t < s->n; t++) {
        const vec3 *const c = &s->corner[3 * t];
        vec3 n = v3_cross(v3_sub(c[1], c[0]), v3_sub(c[2], c[0]));
        n = v3_scale(1.0 / v3_norm(n), n);
        for (int k = 0; k < 3 * s->n; k++)
            if (v3_dot(n, v3_sub(s->corner[k], c[0])) > near)
                return at_place("is not convex (give convex parts, one object each of an OBJ "
                                "file, to shape = multi_dilated_polyhedron)",
                                c[0]);
    }
    return NULL;
}

static char *look_over(struct skin *s)
{
    char *(*const test[])(const struct skin *) = {find_thin, find_open, find_inside_out,
                                                  find_crossing, find_hollow};
    char *why = NULL;
    if (s->n == 0)
        return xprintf("holds no triangle");
    join(s);
    for (size_t k = 0; k < sizeof test / sizeof test[0] && !why; k++)
        why = test[k](s);
    return why;
}

/* The parts of a file as they come. */
struct skins {
    int n;
    struct skin skin[PARTS_MOST];
};

static char *read_stl(const char *path, struct skins *out)
{
    char *why = NULL;
    int n = 0;
    vec3 *const corner = mesh_read_stl(path, &n, &why);
    if (!corner)
        return why;
    out->n = 1;
    for (int t = 0; t < n; t++)
        skin_add(&out->skin[0], corner[3 * t], corner[3 * t + 1], corner[3 * t + 2]);
    xfree(corner);
    return NULL;
}

/* What an OBJ file has told so far. */
struct obj {
    const char *path;
    int line, n, room;
    vec3 *vertex;
};

static char *obj_vertex(struct obj *o, const char *text)
{
    vec3 x;
    if (sscanf(text, "%lf %lf %lf", &x.x, &x.y, &x.z) != 3)
        return xprintf("%s:%d: three numbers are expected after v", o->path, o->line);
    if (o->n == o->room) {
        const int more = 2 * o->room + 64;
        o->vertex = xrealloc(o->vertex, (size_t)o->room, (size_t)more, sizeof *o->vertex);
        o->room = more;
    }
    o->vertex[o->n++] = x;
    return NULL;
}

/* "f 1/2/3 4/5/6 ...": the first number of each; negative ones count back. A fan of triangles. */
static char *obj_face(const struct obj *o, const char *text, struct skin *skin)
{
    int first = 0, last = 0, count = 0;
    for (const char *at = text; *at;) {
        char *end = NULL;
        const long index = strtol(at, &end, 10);
        if (end == at)
            break;
        const long k = index < 0 ? o->n + index : index - 1;
        if (k < 0 || k >= o->n)
            return xprintf("%s:%d: vertex %ld is not among the %d given before", o->path,
                           o->line, index, o->n);
        if (count == 0)
            first = (int)k;
        if (count >= 2)
            skin_add(skin, o->vertex[first], o->vertex[last], o->vertex[k]);
        last = (int)k;
        count++;
        at = end + strcspn(end, " \t\r\n");
        at += strspn(at, " \t\r\n");
    }
    return count >= 3 ? NULL : xprintf("%s:%d: a face takes three vertices", o->path, o->line);
}

static char *obj_line(struct obj *o, const char *line, struct skins *out)
{
    const char *const text = line + strspn(line, " \t");
    if (strncmp(text, "v ", 2) == 0)
        return obj_vertex(o, text + 2);
    if (strncmp(text, "f ", 2) == 0) {
        if (out->n == 0)
            out->n = 1;
        return obj_face(o, text + 2, &out->skin[out->n - 1]);
    }
    if (strncmp(text, "o ", 2) == 0 || strncmp(text, "g ", 2) == 0) {
        if (out->n == 0 || out->skin[out->n - 1].n > 0)
            out->n++;
        if (out->n > PARTS_MOST)
            return xprintf("%s:%d: has more than %d objects", o->path, o->line, PARTS_MOST);
    }
    return NULL;
}

static char *read_obj(const char *path, struct skins *out)
{
    struct obj o = {.path = path};
    char line[LINE], *why = NULL;
    FILE *const file = fopen(path, "r");
    if (!file)
        return xprintf("%s: %s", path, strerror(errno));
    while (!why && fgets(line, sizeof line, file)) {
        o.line++;
        if (!strchr(line, '\n') && !feof(file))
            why = xprintf("%s:%d: is longer than %d characters", path, o.line, LINE);
        else
            why = obj_line(&o, line, out);
    }
    fclose(file);
    xfree(o.vertex);
    if (!why && out->n > 0 && out->skin[out->n - 1].n == 0)
        out->n--;
    return !why && out->n == 0 ? xprintf("%s: holds no face", path) : why;
}

bool solid_of_mesh(struct solid *s, const char *path, bool convex, char **why)
{
    const size_t length = strlen(path);
    const bool obj = length > 4 && (strcmp(path + length - 4, ".obj") == 0 ||
                                    strcmp(path + length - 4, ".OBJ") == 0);
    struct skins *const all = xalloc(1, sizeof *all);
    *why = obj ? read_obj(path, all) : read_stl(path, all);
    if (!*why && convex && all->n > 1)
        *why = xprintf("%s: holds %d objects: shape = multi_dilated_polyhedron takes several",
                       path, all->n);
    for (int k = 0; k < all->n && !*why; k++) {
        char *const what = look_over(&all->skin[k]);
        if (what && all->n > 1)
            *why = xprintf("%s: object %d %s", path, k + 1, what);
        else if (what)
            *why = xprintf("%s: %s", path, what);
        else
            solid_add(s, all->skin[k].corner, 3 * all->skin[k].n);
        xfree(what);
    }
    for (int k = 0; k < PARTS_MOST; k++)
        skin_free(&all->skin[k]);
    xfree(all);
    return *why == NULL;
}
