/* verify/test_shapes.c - the contract of shapes/, for every answer that gives points of contact.
 *
 * Action and reaction: the pair exchanged gives the opposite. The pair turned as a whole gives the
 * same, turned. Two bodies that collide without friction or dashpots keep their energy in the limit
 * of small steps, their momentum and angular momentum to round-off. The surface is closed; volume,
 * centre and principal inertia of what it holds, and of the parts, are those of the form. Shadows:
 * their mean over all directions is a quarter of the surface of a convex body, less of others
 * (Cauchy). How well each answer does is printed. */
#include <gsl/gsl_rng.h>
#include <unistd.h>
#include "../shapes/shape.h"
#include "../solver/base.h"
#include "../solver/scene.h"
#include "answers.h"

enum { POINTS = 300 };

/* What a shape needs besides its defaults, and how well energy is kept. */
static const struct asked {
    const char *name, *lines;
    double energy; /* relative error of a collision, at most */
    bool convex;
} all_asked[] = {
    {"clump", "clump = tetrapod\n", 1e-3, false},
    {"superquadric", "half_axes = 1 0.8 1.3\nblockiness = 4\nblockiness_across = 2\n", 1e-3,
     true},
    {"dilated_polyhedron", "form = cube\ndilation = 0.1 m\n", 1e-4, true},
    {"multi_dilated_polyhedron", "form = cube\ndilation = 0.1 m\n", 1e-4, true},
    {"level_set", "node_spacing = 0.04\n", 3e-2, true}, /* and its form */
};

static gsl_rng *rng;
static const struct shape *shape_at;
static struct shape_form form[1];
static int most, overfull;
static char stl[64];

static double uniform(double lo, double hi)
{
    return lo + (hi - lo) * gsl_rng_uniform(rng);
}

static struct quat any_turn(void)
{
    return quat_unit(
        (struct quat){uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
}

/* An ellipsoid of axes 1, 0.8, 0.7 as an ASCII STL file, in the folder at hand. */
static void write_stl(const char *path)
{
    enum { N = 16 };
    FILE *const f = fopen(path, "w");
    if (!f)
        abort();
    fputs("solid ellipsoid\n", f);
    for (int o = 0; o < 8; o++)
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N - i; j++) {
                const bool back = (o & 1) ^ (o >> 1 & 1) ^ (o >> 2 & 1);
                vec3 p[4];
                for (int k = 0; k < 4; k++) {
                    const int u = i + (k == 1 || k == 3), v = j + (k == 2 || k == 3);
                    const vec3 x = v3((o & 1 ? -1 : 1) * u, (o & 2 ? -1 : 1) * v,
                                      (o & 4 ? -1 : 1) * (N - u - v));
                    p[k] = v3_scale(1 / v3_norm(x), x);
                }
                for (int t = 0; t < (i + j + 2 <= N ? 2 : 1); t++) {
                    fputs("facet normal 0 0 0\nouter loop\n", f);
                    for (int k = 0; k < 3; k++) {
                        const int one[3] = {0, 1, 2}, two[3] = {3, 2, 1};
                        const int at = (t ? two : one)[back && k ? 3 - k : k];
                        fprintf(f, "vertex %.9g %.9g %.9g\n", p[at].x, 0.8 * p[at].y,
                                0.7 * p[at].z);
                    }
                    fputs("endloop\nendfacet\n", f);
                }
            }
    fputs("endsolid\n", f);
    fclose(f);
}

static struct shape_pose pose(vec3 centre, struct quat q, double size)
{
    return (struct shape_pose){.size = size, .centre = centre, .q = q, .turn = quat_matrix(q)};
}

/* Force on i and torques about the centres, of springs of 1 N/m; the energy that they hold. */
struct wrench {
    int n;
    vec3 force, on_i, on_j;
    double energy, deepest;
};

static struct wrench meet(struct shape_pose i, struct shape_pose j, real *memory)
{
    struct shape_point p[POINTS];
    struct wrench w = {0};
    struct shape_pair pair = {.i = i, .j = j, .reach = 0.0, .memory = memory};
    pair.j.centre = v3_sub(j.centre, i.centre);
    pair.i.centre = v3(0, 0, 0);
    const int n = shape_at->points(&pair, most, p);
    overfull += n < 0 || n > most;
    for (int k = 0; k < n && k < most; k++) {
        const double share = p[k].share > 0 ? p[k].share : 1;
        if (!(p[k].depth > 0))
            continue;
        const vec3 f = v3_scale(share * p[k].depth, p[k].normal);
        w.n++;
        w.force = v3_add(w.force, f);
        w.on_i = v3_add(w.on_i, v3_cross(p[k].at_i, f));
        w.on_j = v3_sub(w.on_j, v3_cross(p[k].at_j, f));
        w.energy += 0.5 * share * p[k].depth * p[k].depth;
        w.deepest = fmax(w.deepest, p[k].depth);
    }
    return w;
}

static double apart_of(vec3 a, vec3 b)
{
    return v3_norm(v3_sub(a, b));
}

static real *memory_new(void)
{
    return xalloc((size_t)shape_at->memory + 16, sizeof(real));
}

/* j comes along the line of centres until it overlaps by some 1 % of the size. */
static bool approach(const struct shape_pose *i, struct shape_pose *j, struct wrench *w)
{
    const vec3 way = v3_scale(1 / v3_norm(j->centre), j->centre);
    real *const memory = memory_new();
    double far = 2.1 * form->bounding;
    for (*w = (struct wrench){0}; w->deepest < 0.005 && far > 0.5; far -= 0.004) {
        j->centre = v3_scale(far, way);
        *w = meet(*i, *j, memory);
    }
    xfree(memory);
    return w->n > 0 && w->deepest < 0.05;
}

static void test_pairs(const char *name)
{
    double swapped = 0, turned = 0, fresh = 0;
    int met = 0;
    for (int k = 0; k < 60; k++) {
        const struct quat frame = any_turn();
        const struct mat3 m = quat_matrix(frame);
        struct shape_pose i = pose(v3(0, 0, 0), any_turn(), 1);
        const struct mat3 way = quat_matrix(any_turn());
        struct shape_pose j = pose(way.row[0], any_turn(), 0.8);
        struct wrench w;
        if (!approach(&i, &j, &w))
            continue;
        met++;
        real *const memory[3] = {memory_new(), memory_new(), memory_new()};
        const struct wrench again = meet(i, j, memory[2]), s = meet(j, i, memory[0]);
        const struct shape_pose ti = pose(v3(0, 0, 0), quat_mul(frame, i.q), 1);
        const struct shape_pose tj = pose(mat3_turn(&m, j.centre), quat_mul(frame, j.q), 0.8);
        const struct wrench t = meet(ti, tj, memory[1]);
        const double size = v3_norm(w.force);
        fresh = fmax(fresh, apart_of(w.force, again.force) / size);
        swapped = fmax(swapped, (v3_norm(v3_add(w.force, s.force)) + apart_of(w.on_i, s.on_j) +
                                 apart_of(w.on_j, s.on_i)) /
                                    size);
        turned = fmax(turned, (apart_of(mat3_turn(&m, w.force), t.force) +
                               apart_of(mat3_turn(&m, w.on_i), t.on_i) +
                               apart_of(mat3_turn(&m, w.on_j), t.on_j)) /
                                  size);
        for (int q = 0; q < 3; q++)
            xfree(memory[q]);
    }
    check(met > 30, "%s: %d pairs brought to touch", name, met);
    check(fresh < 1e-6, "%s: without its memory the same force to %.1e", name, fresh);
    check(swapped < 1e-6, "%s: action and reaction, exchanged: to %.1e", name, swapped);
    check(turned < 1e-6, "%s: turned as a whole: the same to %.1e", name, turned);
}

/* A body in motion; mass 1 kg, size 1 m. */
struct mover {
    vec3 x, v, l;
    struct quat q;
};

static double kinetic(const struct mover *b)
{
    const struct mat3 m = quat_matrix(b->q);
    return 0.5 * v3_dot(b->v, b->v) +
           0.5 * v3_dot(b->l, rotation_spin(&m, b->l, form->inertia));
}

static vec3 angular(const struct mover *b)
{
    return v3_add(b->l, v3_cross(b->x, b->v));
}

static struct wrench kick(struct mover b[2], real *memory, double stiffness, double h)
{
    struct wrench w = meet(pose(b[0].x, b[0].q, 1), pose(b[1].x, b[1].q, 1), memory);
    const double k = stiffness * h;
    b[0].v = v3_axpy(b[0].v, k, w.force);
    b[1].v = v3_axpy(b[1].v, -k, w.force);
    b[0].l = v3_axpy(b[0].l, k, w.on_i);
    b[1].l = v3_axpy(b[1].l, k, w.on_j);
    return w;
}

/* Relative change of the energy by one collision at that step; NAN: they missed each other. */
static double collide(struct mover b[2], double dt, double *momentum)
{
    const double stiffness = 2000, before = kinetic(&b[0]) + kinetic(&b[1]);
    const vec3 l = v3_add(angular(&b[0]), angular(&b[1]));
    real *const memory = memory_new();
    struct wrench w = {0};
    bool touched = false;
    for (double t = 0; t < 1.5; t += dt) {
        for (int k = 0; k < 2; k++) {
            b[k].x = v3_axpy(b[k].x, 0.5 * dt, b[k].v);
            b[k].q = rotation_free(b[k].q, b[k].l, form->inertia, 0.5 * dt).q;
        }
        w = kick(b, memory, stiffness, dt);
        touched = touched || w.n > 0;
        for (int k = 0; k < 2; k++) {
            b[k].x = v3_axpy(b[k].x, 0.5 * dt, b[k].v);
            b[k].q = rotation_free(b[k].q, b[k].l, form->inertia, 0.5 * dt).q;
        }
    }
    xfree(memory);
    *momentum = apart_of(l, v3_add(angular(&b[0]), angular(&b[1])));
    const double after = kinetic(&b[0]) + kinetic(&b[1]) + stiffness * w.energy;
    return touched ? fabs(after / before - 1) : (double)NAN;
}

static void test_energy(const char *name, double allowed)
{
    double mean[2] = {0}, angular_most = 0;
    int n = 0;
    for (int k = 0; k < 24; k++) {
        const vec3 aim = v3(uniform(-0.4, 0.4), uniform(-0.4, 0.4), 0);
        struct mover start[2] = {
            {.x = v3(0, 0, -0.5 - form->bounding), .v = v3(0, 0, 1), .q = any_turn()},
            {.x = v3(aim.x, aim.y, 0.5 + form->bounding), .v = v3(0, 0, -1), .q = any_turn()}};
        start[0].l = v3(uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(-0.2, 0.2));
        double error[2], l = 0;
        for (int fine = 0; fine < 2; fine++) {
            struct mover b[2] = {start[0], start[1]};
            error[fine] = collide(b, fine ? 5e-4 : 2e-3, &l);
        }
        if (isnan(error[0]) || isnan(error[1]))
            continue;
        n++;
        mean[0] += error[0];
        mean[1] += error[1];
        angular_most = fmax(angular_most, l);
    }
    check(n > 10, "%s: %d collisions", name, n);
    check(mean[1] / n < allowed,
          "%s: energy changes by %.1e, with a quarter of the step by %.1e (allowed %.0e)", name,
          mean[0] / n, mean[1] / n, allowed);
    if (allowed <= 1e-3) /* the order is 2: a sixteenth */
        check(mean[1] < mean[0] / 6, "%s: a quarter of the step makes a %.2gth of the error",
              name, mean[0] / mean[1]);
    check(angular_most < 1e-10, "%s: angular momentum stays to %.1e", name, angular_most);
}

/* Integrals over what the triangles enclose: tetrahedra with the origin. */
struct solid {
    struct shape_canvas canvas;
    double volume, area, xx, yy, zz, xy, yz, zx;
    vec3 moment, closed;
};

static void take(struct shape_canvas *canvas, vec3 a, vec3 b, vec3 c)
{
    struct solid *const s = (struct solid *)canvas;
    const vec3 cross = v3_cross(v3_sub(b, a), v3_sub(c, a)), d = v3_add(a, v3_add(b, c));
    const double six = v3_dot(a, v3_cross(b, c));
    s->volume += six / 6;
    s->area += 0.5 * v3_norm(cross);
    s->closed = v3_add(s->closed, cross);
    s->moment = v3_axpy(s->moment, six / 24, d);
    const double k = six / 120;
    s->xx += k * (a.x * a.x + b.x * b.x + c.x * c.x + d.x * d.x);
    s->yy += k * (a.y * a.y + b.y * b.y + c.y * c.y + d.y * d.y);
    s->zz += k * (a.z * a.z + b.z * b.z + c.z * c.z + d.z * d.z);
    s->xy += k * (a.x * a.y + b.x * b.y + c.x * c.y + d.x * d.y);
    s->yz += k * (a.y * a.z + b.y * b.z + c.y * c.z + d.y * d.z);
    s->zx += k * (a.z * a.x + b.z * b.x + c.z * c.x + d.z * d.x);
}

/* Unions may be drawn ball by ball, with what of them lies in others. */
static void test_surface(const char *name, bool convex)
{
    struct solid s = {.canvas = {.triangle = take}};
    if (!shape_at->surface)
        return;
    shape_at->surface(0, &s.canvas);
    const double unit = 4 * PI / 3, off = fabs(s.volume / unit - 1);
    check(v3_norm(s.closed) < 1e-6 * s.area, "%s: its surface is closed to %.1e", name,
          v3_norm(s.closed) / s.area);
    check(off < (convex ? 0.05 : 0.1), "%s: triangles hold the volume to %.1e", name, off);
    check(v3_norm(s.moment) / s.volume < 0.02, "%s: their centre of mass to %.1e", name,
          v3_norm(s.moment) / s.volume);
    const double ix = (s.yy + s.zz) / s.volume, iy = (s.zz + s.xx) / s.volume,
                 iz = (s.xx + s.yy) / s.volume;
    const double worst =
        fmax(fabs(ix / form->inertia.x - 1),
             fmax(fabs(iy / form->inertia.y - 1), fabs(iz / form->inertia.z - 1)));
    check(worst < 0.05, "%s: their inertia to %.1e", name, worst);
    const double mixed = fmax(fabs(s.xy), fmax(fabs(s.yz), fabs(s.zx))) / s.volume;
    check(mixed < 0.01, "%s: axes are principal to %.1e", name, mixed);
    if (isfinite(form->sphericity))
        check_rel(form->sphericity, 4 * PI / s.area, convex ? 0.03 : 0.15,
                  "sphericity by the triangles");
}

static void test_parts(const char *name)
{
    int n = 0;
    double sum = 0, xx = 0, yy = 0, zz = 0;
    vec3 centre = v3(0, 0, 0);
    if (!shape_at->parts)
        return;
    struct shape_part *const part = shape_at->parts(0, 2.0 / 16, &n);
    for (int k = 0; k < n; k++) {
        const double own = pow(part[k].volume, 2.0 / 3.0) / 12, v = part[k].volume;
        sum += v;
        centre = v3_axpy(centre, v, part[k].at);
        xx += v * (part[k].at.x * part[k].at.x + own);
        yy += v * (part[k].at.y * part[k].at.y + own);
        zz += v * (part[k].at.z * part[k].at.z + own);
    }
    xfree(part);
    check_rel(sum, 4 * PI / 3, 1e-9, "volume of the parts");
    check(v3_norm(centre) / sum < 5e-3, "%s: %d parts, their centre to %.1e", name, n,
          v3_norm(centre) / sum);
    const double worst = fmax(fabs((yy + zz) / sum / form->inertia.x - 1),
                              fmax(fabs((zz + xx) / sum / form->inertia.y - 1),
                                   fabs((xx + yy) / sum / form->inertia.z - 1)));
    check(worst < 0.04, "%s: their inertia to %.1e", name, worst);
}

static void test_shadows(const char *name, bool convex)
{
    enum { N = 800 };
    double mean = 0;
    if (!shape_at->crosswise || !isfinite(form->sphericity))
        return;
    for (int k = 0; k < N; k++) {
        const double z = 1 - (2 * k + 1) / (double)N, r = sqrt(1 - z * z), a = 2.39996323 * k;
        mean += 1 / shape_at->crosswise(0, v3(r * cos(a), r * sin(a), z)) / N;
    }
    const double ratio = mean * form->sphericity;
    check(convex ? fabs(ratio - 1) < 0.03 : ratio < 1.03,
          "%s: mean shadow over a quarter of the surface: %.4f", name, ratio);
}

static void visit(const char *name, void *answer)
{
    struct asked asked = {.name = name, .lines = "", .energy = 5e-2};
    const struct key *keys = NULL;
    shape_at = NULL;
    if (!answers_symbol(answer, "shape", &shape_at, sizeof shape_at) ||
        !answers_symbol(answer, "shape_keys", &keys, sizeof keys))
        return;
    if (!shape_at->points)
        return;
    for (size_t k = 0; k < sizeof all_asked / sizeof all_asked[0]; k++)
        if (strcmp(all_asked[k].name, name) == 0)
            asked = all_asked[k];
    char path[] = "/tmp/silt-test-XXXXXX";
    const int fd = mkstemp(path);
    FILE *const f = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (!f)
        abort();
    fprintf(f, "[grains a]\n%s", asked.lines);
    if (strcmp(name, "level_set") == 0)
        fprintf(f, "form = %s\n", stl);
    fclose(f);
    struct scene *const scene = scene_load(path, 0, NULL);
    struct species species = {.name = "a", .diameter = 2, .density = 1};
    const struct grains g = {.n_species = 1, .species = &species};
    scene_declare(scene, keys);
    form[0] = (struct shape_form){.bounding = 1,
                                  .inertia = {0.4, 0.4, 0.4},
                                  .axes = quat_one(),
                                  .sphericity = (double)NAN,
                                  .points_most = 1};
    if (shape_at->init)
        shape_at->init(scene, &g, form);
    if (scene_errors(scene) > 0) {
        check(asked.lines[0] == '\0', "%s: wants keys that this test does not give; left out",
              name);
    } else {
        most = form->points_most < POINTS ? form->points_most : POINTS;
        test_pairs(name);
        test_energy(name, asked.energy);
        test_surface(name, asked.convex);
        test_parts(name);
        test_shadows(name, asked.convex);
        check(overfull == 0, "%s: never more than %d points", name, most);
    }
    if (shape_at->free)
        shape_at->free();
    scene_free(scene);
    unlink(path);
}

int main(int argc, char **argv)
{
    (void)argc;
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    snprintf(stl, sizeof stl, "/tmp/silt-test-%d.stl", (int)getpid());
    write_stl(stl);
    answers_visit(argv[0], "shapes", visit);
    unlink(stl);
    gsl_rng_free(rng);
    return check_end();
}
