/* shapes/clump.c - a grain is a rigid union of overlapping spheres.
 *
 * Two clumps touch where their spheres do: each pair of spheres that overlaps is a contact, with its
 * own radii, and so is each sphere on an element of a wall. Volume, centre and inertia are those of
 * the union, each part counted once (disc_union.c), not the sum over spheres that many codes take.
 * Where all clumps are of one sphere they go the way of spheres, to the last bit. Also the template for
 * shapes with more than one contact a pair. */
#include "../solver/ball_sets.h"
#include "../solver/ball_surface.h"
#include "../solver/bed_file.h"
#include "shape.h"

const struct about shape_about = {
    .name = "clump",
    .summary = "a rigid union of overlapping spheres, by name, from a list or a file",
    .equation = "contacts = overlaps of the spheres; mass properties of the union",
    .source = "exact",
    .range = "always"};
const struct key shape_keys[] = {
    {"grains", "clump", KEY_TEXT, "", "", "",
     "spheres by name (pair, rod, triangle, tetrahedron, cross, cube, tetrapod) or from a "
     "file, "
     "x y z r a line; any unit: `diameter` scales them"},
    {"grains", "spheres", KEY_TEXT, "", "", "",
     "in place of clump: x y z r, x y z r, ... in any unit"},
    {"grains", "contacts_most", KEY_REAL, "1", "auto | [1, 256]", "auto",
     "most contacts of two grains at a time that there is room for"},
    {0},
};

enum { SPHERES_MOST = 2000, LANES = 8 };

/* The spheres of a species in the frame of the principal axes, units of size; arrays are padded by
 * spheres that touch nothing. */
struct form {
    int n, padded;
    double *x, *y, *z, *r;
    struct shape_ball *ball;
    struct shape_form form;
    struct ball *as_ball;
};

static struct form *forms;
static int n_forms;

static struct ball *read_balls(struct scene *scene, const char *name, int *n)
{
    const char *const named = scene_text(scene, "grains", name, "clump");
    const char *const list = scene_text(scene, "grains", name, "spheres");
    char *why = NULL;
    struct ball *b = NULL;
    const char *const key = list[0] != '\0' ? "spheres" : "clump";
    if ((named[0] == '\0') == (list[0] == '\0')) {
        scene_error(scene, "grains", name, key, "give one of clump (%s, or a file) and spheres",
                    ball_set_names);
    } else if (list[0] != '\0') {
        b = ball_set_listed(list, n, &why);
    } else {
        char *const path = bed_file_path(named, scene_path(scene));
        b = ball_set_named(named, path, n, &why);
        xfree(path);
    }
    if (b && !ball_set_whole(b, *n)) {
        scene_error(scene, "grains", name, key, "the spheres do not hang together");
        xfree(b);
        b = NULL;
    }
    if (why)
        scene_error(scene, "grains", name, key, "%s", why);
    xfree(why);
    if (!b) { /* an error is on the list */
        b = xalloc(1, sizeof *b);
        b[0].r = 1.0;
        *n = 1;
    }
    return b;
}

/* A sphere within another one adds nothing. */
static int drop_inner(struct ball *b, int n)
{
    int kept = 0;
    for (int i = 0; i < n; i++) {
        bool inside = false;
        for (int k = 0; k < n && !inside; k++) {
            const double d = v3_norm(v3_sub(b[i].centre, b[k].centre));
            inside = k != i && b[k].r > 0.0 && d + b[i].r <= b[k].r &&
                     (k < i || d > 0.0 || b[k].r > b[i].r);
        }
        if (inside)
            b[i].r = 0.0;
    }
    for (int i = 0; i < n; i++)
        if (b[i].r > 0.0)
            b[kept++] = b[i];
    return kept;
}

/* Moments that differ by round-off alone are the same. */
static vec3 alike(vec3 j)
{
    const double mean = (j.x + j.y + j.z) / 3.0;
    return j.x - j.z < 1e-9 * mean ? v3(mean, mean, mean) : j;
}

/* Centre, axes and size of the union; the balls go to the frame of the principal axes. */
static void find_form(struct form *f, struct ball *b, int n)
{
    struct shape_form *const form = &f->form;
    if (n == 1) {
        b[0] = (struct ball){.centre = {0.0, 0.0, 0.0}, .r = 1.0};
        form->sphericity = 1.0;
        return;
    }
    const struct ball_union u = ball_union(b, n);
    const double size = cbrt(u.volume / (4.0 / 3.0 * 3.14159265358979323846));
    const vec3 inertia = alike(
        v3_scale(1.0 / (u.volume * size * size), rotation_principal(u.inertia, &form->axes)));
    if (inertia.x == inertia.z)
        form->axes = quat_one();
    const struct mat3 m = quat_matrix(form->axes);
    form->inertia = inertia;
    form->sphericity = 4.0 * 3.14159265358979323846 * size * size / u.area;
    form->bounding = 0.0;
    for (int i = 0; i < n; i++) {
        const vec3 c = mat3_back(&m, v3_scale(1.0 / size, v3_sub(b[i].centre, u.centre)));
        b[i] = (struct ball){c, b[i].r / size};
        form->bounding = fmax(form->bounding, v3_norm(c) + b[i].r);
    }
}

static void store(struct form *f, const struct ball *b, int n)
{
    f->n = n;
    f->padded = (n + LANES - 1) / LANES * LANES;
    double **const array[] = {&f->x, &f->y, &f->z, &f->r};
    for (int a = 0; a < 4; a++)
        *array[a] = xalloc((size_t)f->padded, sizeof(double));
    f->ball = xalloc((size_t)n, sizeof *f->ball);
    for (int i = 0; i < f->padded; i++) {
        const struct ball one = i < n ? b[i] : (struct ball){{0.0, 0.0, 0.0}, -1e6};
        f->x[i] = one.centre.x;
        f->y[i] = one.centre.y;
        f->z[i] = one.centre.z;
        f->r[i] = one.r;
        if (i < n)
            f->ball[i] = (struct shape_ball){one.centre, one.r};
    }
}

static void init(struct scene *scene, const struct grains *g, struct shape_form *out)
{
    int largest = 1;
    n_forms = g->n_species;
    forms = xalloc((size_t)n_forms + 1, sizeof *forms);
    for (int k = 0; k < n_forms; k++) {
        int n = 1;
        struct ball *const b = read_balls(scene, g->species[k].name, &n);
        n = drop_inner(b, n);
        forms[k].form = out[k];
        find_form(&forms[k], b, n);
        store(&forms[k], b, n);
        forms[k].as_ball = b;
        largest = n > largest ? n : largest;
    }
    for (int k = 0; k < n_forms; k++) {
        const char *const name = g->species[k].name;
        const int n = forms[k].n, pairs = n * largest < 256 ? n * largest : 256;
        const int usual = 2 * n + 4 < 64 ? 2 * n + 4 : 64;
        forms[k].form.points_most = pairs < usual ? pairs : usual;
        if (!scene_word(scene, "grains", name, "contacts_most", "auto"))
            forms[k].form.points_most = (int)scene_real(scene, "grains", name, "contacts_most");
        out[k] = forms[k].form;
    }
}

static void release(void)
{
    for (int k = 0; k < n_forms; k++) {
        void *const all[] = {forms[k].x, forms[k].y,    forms[k].z,
                             forms[k].r, forms[k].ball, forms[k].as_ball};
        for (size_t a = 0; a < sizeof all / sizeof all[0]; a++)
            xfree(all[a]);
    }
    xfree(forms);
    forms = NULL;
    n_forms = 0;
}

/* Spheres as seen from x_i, WIDE at a time. */
enum { WIDE = 64 };

struct seen_spheres {
    _Alignas(64) double x[WIDE], y[WIDE], z[WIDE], r[WIDE];
};

/* n: a multiple of LANES; loops of that fixed length are what the compiler turns into plain vectors. */
static void place(const struct form *f, const struct shape_pose *p, int from, int n,
                  struct seen_spheres *s)
{
    const struct mat3 m = p->turn;
    const vec3 centre = p->centre;
    const double size = p->size;
    for (int b = 0; b < n; b += LANES) {
        const double *const fx = &f->x[from + b], *const fy = &f->y[from + b],
                            *const fz = &f->z[from + b], *const fr = &f->r[from + b];
#pragma omp simd
        for (int k = 0; k < LANES; k++) {
            const double x = size * fx[k], y = size * fy[k], z = size * fz[k];
            s->x[b + k] = m.row[0].x * x + m.row[0].y * y + m.row[0].z * z + centre.x;
            s->y[b + k] = m.row[1].x * x + m.row[1].y * y + m.row[1].z * z + centre.y;
            s->z[b + k] = m.row[2].x * x + m.row[2].y * y + m.row[2].z * z + centre.z;
            s->r[b + k] = size * fr[k];
        }
    }
}

/* Which of n spheres come within `bound` of a point: their numbers. */
static inline int within(const struct seen_spheres *s, int n, vec3 c, double bound,
                         unsigned char *out)
{
    int count = 0;
    for (int b = 0; b < n; b += LANES) {
        double gap[LANES], least = 0.0;
#pragma omp simd reduction(min : least)
        for (int k = 0; k < LANES; k++) {
            const double x = c.x - s->x[b + k], y = c.y - s->y[b + k], z = c.z - s->z[b + k];
            const double sum = bound + s->r[b + k], cut = sum > 0.0 ? sum : 0.0;
            gap[k] = x * x + y * y + z * z - cut * cut;
            least = gap[k] < least ? gap[k] : least;
        }
        for (int k = 0; k < LANES && least < 0.0; k++) {
            out[count] = (unsigned char)(b + k);
            count += gap[k] < 0.0;
        }
    }
    return count;
}

/* Least distance of n spheres from a ball. */
static double gap_to(const struct seen_spheres *s, int n, vec3 c, double r)
{
    double least = (double)INFINITY;
    for (int b = 0; b < n; b += LANES)
#pragma omp simd reduction(min : least)
        for (int k = 0; k < LANES; k++) {
            const double x = c.x - s->x[b + k], y = c.y - s->y[b + k], z = c.z - s->z[b + k];
            const double gap = sqrt(x * x + y * y + z * z) - s->r[b + k] - r;
            least = gap < least ? gap : least;
        }
    return least;
}

/* How far apart two clumps are: exactly where they are of few spheres, else at least. */
static double gap_between(const struct shape_pair *p, const struct form *i,
                          const struct form *j)
{
    struct seen_spheres s, t;
    double least = (double)INFINITY;
    const bool few = i->padded <= LANES && j->padded <= LANES;
    if (few)
        place(j, &p->j, 0, LANES, &t);
    for (int start = 0; start < i->padded; start += WIDE) {
        const int n_i = i->padded - start < WIDE ? i->padded - start : WIDE;
        place(i, &p->i, start, n_i, &s);
        for (int k = 0; few && k < i->n; k++)
            least = fmin(least, gap_to(&t, LANES, v3(s.x[k], s.y[k], s.z[k]), s.r[k]));
        if (!few)
            least = fmin(least, gap_to(&s, n_i, p->j.centre, p->j.size * j->form.bounding));
    }
    return least;
}

static int points(const struct shape_pair *p, int most, struct shape_point *out)
{
    const struct form *const i = &forms[p->i.species], *const j = &forms[p->j.species];
    const vec3 origin = v3(0.0, 0.0, 0.0);
    const double bound_i = p->i.size * i->form.bounding, bound_j = p->j.size * j->form.bounding;
    int count = 0;
    for (int start = 0; start < i->padded; start += WIDE) {
        const int n_i = i->padded - start < WIDE ? i->padded - start : WIDE;
        unsigned char of_i[WIDE + 1], of_j[WIDE + 1], with[WIDE + 1];
        struct seen_spheres s, t;
        place(i, &p->i, start, n_i, &s);
        const int near_i = within(&s, n_i, p->j.centre, bound_j + p->reach, of_i);
        for (int from = 0; from < j->padded && near_i > 0; from += WIDE) {
            const int n_j = j->padded - from < WIDE ? j->padded - from : WIDE;
            place(j, &p->j, from, n_j, &t);
            if (within(&t, n_j, origin, bound_i + p->reach, of_j) == 0)
                continue;
            for (int a = 0; a < near_i; a++) {
                const int m = of_i[a];
                const vec3 c = v3(s.x[m], s.y[m], s.z[m]);
                const int touching = within(&t, n_j, c, s.r[m] + p->reach, with);
                for (int k = 0; k < touching; k++, count++) {
                    const int q = with[k];
                    const vec3 at = v3(t.x[q], t.y[q], t.z[q]);
                    if (count < most)
                        shape_balls_touch(&out[count], c, s.r[m], v3_sub(at, p->j.centre),
                                          t.r[q], v3_sub(c, at), (start + m) * j->n + from + q);
                }
            }
        }
    }
    if (count == 0 && p->apart)
        *p->apart = gap_between(p, i, j);
    return count;
}

static const struct shape_ball *balls(int species, int *n)
{
    *n = forms[species].n;
    return forms[species].ball;
}

static void surface(int species, struct shape_canvas *c)
{
    ball_surface(forms[species].as_ball, forms[species].n, c);
}

static struct shape_part *parts(int species, double spacing, int *n)
{
    return ball_parts(forms[species].as_ball, forms[species].n, spacing, n);
}

/* The shadow is the union of the discs that the spheres throw. */
static double crosswise(int species, vec3 flow)
{
    const struct form *const f = &forms[species];
    const vec3 e = v3_across(flow), g = v3_cross(flow, e);
    struct disc *const d = xalloc((size_t)f->n, sizeof *d);
    for (int k = 0; k < f->n; k++) {
        const vec3 c = f->ball[k].centre;
        d[k] = (struct disc){v3_dot(c, e), v3_dot(c, g), f->ball[k].radius};
    }
    const double area = disc_union(d, f->n, NULL).area;
    xfree(d);
    return 3.14159265358979323846 / area;
}

const struct shape shape = {.path = &contact_round,
                            .init = init,
                            .free = release,
                            .overlaps = shape_spheres_overlap,
                            .points = points,
                            .balls = balls,
                            .surface = surface,
                            .parts = parts,
                            .crosswise = crosswise};
