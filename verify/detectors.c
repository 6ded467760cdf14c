/* verify/detectors.c - what the detectors of contacts between dilated polyhedra give: the distance of
 * the cores [Gilbert88], the same with crowned faces (detector = gjk; geometry/crown.h) and the
 * smoothed envelope for many k (detector = envelope) [LiLiuJi23, eqs 12-13].
 *
 * detectors FOLDER prints and writes, lengths over the volume-equivalent radius, forces by Hertz:
 *   errors.dat  two cubes face to face, edge to edge, vertex to face, each at 1,000 random turns,
 *               dilated by 0.1, 0.02 deep: mean and most of the errors of depth, normal (rad) and
 *               force (relative) against brute force; ns a pair, as in a run that goes on from
 *               the last step: medians of rounds in which the detectors take turns;
 *   jumps.dat   sweeps of one body along another: the largest change of force and of torque from one
 *               step of the sweep to the next over the largest force, for ever finer steps. Where the
 *               force is continuous it falls with the step; a true jump stays. */
/* slots: shapes/multi_dilated_polyhedron */
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <stdlib.h>
#include <time.h>
#include "../shapes/geometry/dilated.h"
#include "polyhedra.h"

enum { TURNS = 1000, ROUNDS = 9, POINTS = 64, LETTER_T = 14 };

#define DILATION 0.1 /* twentieth of the diameter, the default */
#define DEPTH    0.02
#define TILT     0.01
#define CROWNED  0.0  /* in place of k */
#define EXACT    -1.0 /* likewise */

static struct dilated *body(int form)
{
    struct solid solid = {0};
    char *why = NULL;
    solid_named(&solid, form, 4);
    struct dilated *const d = dilated_create(&solid, DILATION, 0.05, &why);
    if (!d)
        die(EXIT_UNSTABLE, "%s", why);
    solid_free(&solid);
    return d;
}

/* Columns are the axes. */
static struct mat3 turn_of(const vec3 a[3])
{
    return (struct mat3){
        {{a[0].x, a[1].x, a[2].x}, {a[0].y, a[1].y, a[2].y}, {a[0].z, a[1].z, a[2].z}}};
}

static struct shape_pose pose(vec3 centre, const vec3 axes[3], double size)
{
    return (struct shape_pose){.size = size, .centre = centre, .turn = turn_of(axes)};
}

/* The whole of what a pair feels: force on i and torque about x_i for F = depth^1.5; the depth and normal
 * of the force. */
struct felt {
    vec3 force, torque, normal;
    double depth;
};

static struct felt feel(const struct dilated *i, const struct dilated *j, double k,
                        const struct shape_pair *pair)
{
    const struct detection how = {k > 0.0 ? DETECTOR_ENVELOPE : DETECTOR_GJK, TILT, k};
    struct shape_point p[POINTS];
    struct felt all = {.depth = -1.0};
    const int n = dilated_points(i, j, &how, pair, DILATED_KEPT, POINTS, p);
    for (int c = 0; c < n && c < POINTS; c++) {
        const double f = p[c].depth > 0.0 ? p[c].share * p[c].depth * sqrt(p[c].depth) : 0.0;
        all.force = v3_axpy(all.force, f, p[c].normal);
        all.torque = v3_axpy(all.torque, f, v3_cross(p[c].at_i, p[c].normal));
        all.depth = fmax(all.depth, p[c].depth);
        all.normal = v3_axpy(all.normal, p[c].share, p[c].normal);
    }
    return all;
}

/* ---- errors and cost ---- */

struct sample {
    struct shape_pair pair;
    real memory[DILATED_KEPT * DILATED_MEMORY];
    double depth; /* by brute force */
    vec3 normal;
    struct placed a, b;
};

static double side_of(const struct dilated *d)
{
    const struct polyhedron *const p = d->part[0].core;
    double most = 0.0;
    for (int v = 0; v < p->n_vertices; v++)
        most = fmax(most, fabs(p->x[v]));
    return 2.0 * most;
}

/* A pair that meets as it should, and no further. */
static bool meets(const struct sample *s)
{
    return fabs(s->depth - DEPTH) < 1e-9;
}

/* Returns how far the distance is from brute force. */
static double fill(gsl_rng *r, const struct dilated *cube, enum cubes_meet how,
                   struct sample *s)
{
    const struct polyhedron *const p = cube->part[0].core;
    const double side = side_of(cube);
    struct gap_memory memory = {0};
    struct gap gap;
    set_pair(r, how, (2.0 * DILATION - DEPTH) / side, 1.0, &s->a, &s->b);
    s->a.at = v3_scale(side, s->a.at);
    s->b.at = v3_scale(side, s->b.at);
    place(&s->a, p);
    place(&s->b, p);
    gap_find(&s->a.points, p, &s->b.points, p, s->b.axes, 1e9, &memory, &gap);
    const double brute = brute_distance(p, &s->a.points, p, &s->b.points);
    s->depth = 2.0 * DILATION - brute;
    s->normal = gap.normal;
    const vec3 none = {0.0, 0.0, 0.0};
    s->pair = (struct shape_pair){.i = pose(none, s->a.axes, 1.0),
                                  .j = pose(v3_sub(s->b.at, s->a.at), s->b.axes, 1.0),
                                  .reach = 0.5,
                                  .memory = s->memory};
    return fabs(gap.distance - brute);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* One detector on all samples. */
struct result {
    double k, mean[3], most[3], ns[ROUNDS];
};

static void measure(const struct dilated *cube, struct sample *s, struct result *out)
{
    for (int n = 0; n < TURNS; n++) {
        memset(s[n].memory, 0, sizeof s[n].memory);
        const struct felt f = feel(cube, cube, out->k, &s[n].pair);
        const vec3 want = v3_scale(s[n].depth * sqrt(s[n].depth), s[n].normal);
        const double error[3] = {fabs(f.depth - s[n].depth),
                                 v3_norm(v3_cross(f.normal, s[n].normal)) / v3_norm(f.normal),
                                 v3_norm(v3_sub(f.force, want)) / v3_norm(want)};
        for (int c = 0; c < 3; c++) {
            out->mean[c] += error[c] / TURNS;
            out->most[c] = fmax(out->most[c], error[c]);
        }
    }
}

static double seconds(const struct dilated *cube, struct sample *s, double k)
{
    const struct polyhedron *const p = cube->part[0].core;
    volatile double sum = 0.0;
    if (k == EXACT) {
        static struct gap_memory memory[TURNS];
        struct gap gap;
        double took = 0.0;
        for (int again = 0; again < 2; again++) { /* the second from memory */
            took = now();
            for (int n = 0; n < TURNS; n++) {
                gap_find(&s[n].a.points, p, &s[n].b.points, p, s[n].b.axes, 1e9, &memory[n],
                         &gap);
                sum += gap.distance;
            }
            took = now() - took;
        }
        return took;
    }
    for (int n = 0; n < TURNS; n++)
        memset(s[n].memory, 0, sizeof s[n].memory);
    for (int n = 0; n < TURNS; n++)
        sum += feel(cube, cube, k, &s[n].pair).depth;
    const double start = now();
    for (int n = 0; n < TURNS; n++)
        sum += feel(cube, cube, k, &s[n].pair).depth;
    return now() - start;
}

static const double ks[] = {EXACT, CROWNED, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3,
                            0.01,  0.02,    0.05, 0.1,  0.2,  0.5};
enum { KS = sizeof ks / sizeof ks[0] };

static void label(double k, char text[16])
{
    if (k > 0.0)
        snprintf(text, 16, "%g", k);
    else
        snprintf(text, 16, "%s", k == EXACT ? "exact" : "crowned");
}

static bool errors(FILE *file)
{
    static struct sample sample[TURNS];
    const enum cubes_meet how[] = {FACES, EDGES, CORNER};
    struct dilated *const cube = body(0);
    gsl_rng *const r = gsl_rng_alloc(gsl_rng_mt19937);
    bool good = true;
    gsl_rng_set(r, 61);
    printf("  %-8s %21s %21s %21s %10s\n", "k", "depth: mean, most", "normal (rad)",
           "force (relative)", "ns a pair");
    for (int h = 0; h < 3; h++) {
        struct result all[KS] = {{0.0}};
        double worst = 0.0;
        for (int n = 0; n < TURNS; n += meets(&sample[n]))
            worst = fmax(worst, fill(r, cube, how[h], &sample[n]));
        printf("  cubes %s, %d turns: GJK within %.2g of brute force\n",
               cubes_meet_name[how[h]], TURNS, worst);
        good = good && worst < 1e-10;
        for (int d = 0; d < KS; d++) {
            all[d].k = ks[d];
            if (ks[d] != EXACT)
                measure(cube, sample, &all[d]);
        }
        for (int round = 0; round < ROUNDS; round++)
            for (int d = 0; d < KS; d++)
                all[d].ns[round] = 1e9 / TURNS * seconds(cube, sample, ks[d]);
        for (int d = 0; d < KS; d++) {
            char text[16];
            label(ks[d], text);
            gsl_sort(all[d].ns, 1, ROUNDS);
            const double ns = all[d].ns[ROUNDS / 2];
            if (ks[d] == EXACT)
                printf("  %-8s %65s %10.0f\n", text, "", ns);
            else
                printf("  %-8s %10.2e %10.2e %10.2e %10.2e %10.2e %10.2e %10.0f\n", text,
                       all[d].mean[0], all[d].most[0], all[d].mean[1], all[d].most[1],
                       all[d].mean[2], all[d].most[2], ns);
            fprintf(file, "%d %g %g %g %g %g %g %g %g\n", h, ks[d], all[d].mean[0],
                    all[d].most[0], all[d].mean[1], all[d].most[1], all[d].mean[2],
                    all[d].most[2], ns);
        }
    }
    gsl_rng_free(r);
    dilated_free(cube);
    return good;
}

/* ---- sweeps ---- */

enum { SWEEPS = 7, FINENESS = 5, COARSE = 250 };

struct sweep {
    const char *name;
    const struct dilated *i, *j;
    vec3 axes_i[3], axes_j[3];
    vec3 from, way;     /* place of j as seen from i */
    vec3 about;         /* j turns about it by -angle to angle on the way */
    double angle, size; /* of j over i */
};

/* No number is a round one; none of the symmetries hold. */
static struct sweep sweep_of(int which, const struct dilated *cube,
                             const struct dilated *letter)
{
    const double half = 0.5 * side_of(cube), flat = half + DILATION,
                 roof = sqrt(2.0) * half + DILATION, tip = sqrt(3.0) * half + DILATION;
    const struct dilated_part *const stem = &letter->part[0], *const bar = &letter->part[1];
    const vec3 x = {1.0, 0.0, 0.0}, z = {0.0, 0.0, 1.0};
    const vec3 diagonal = v3_scale(1.0 / sqrt(3.0), v3(1.0, 1.0, 1.0));
    const vec3 tilt = v3_cross(diagonal, z);
    const double small = 0.4, wide = small * flat, deep = small * DEPTH;
    struct sweep s = {.i = cube, .j = cube, .about = x, .size = 1.0};
    turn_about(z, 0.0, s.axes_i);
    turn_about(z, 0.0, s.axes_j);
    switch (which) {
    case 0: /* an edge of j over the face of i and its borders */
        s.name = "face_over_edge";
        turn_about(x, 0.25 * PI, s.axes_j);
        turn_about(z, 0.3, s.axes_i);
        s.from = v3(0.11, -2.1 * half, flat + roof - DEPTH);
        s.way = v3(0.3, 4.2 * half, 0.0);
        break;
    case 1: /* an edge of j past a vertex of i */
        s.name = "edge_past_vertex";
        turn_about(v3_scale(1.0 / v3_norm(tilt), tilt), acos(diagonal.z), s.axes_i);
        turn_about(x, 0.25 * PI, s.axes_j);
        s.from = v3(0.13, -0.5 * half, tip + roof - 2.0 * DEPTH);
        s.way = v3(0.2, 1.0 * half, 0.0);
        break;
    case 2:
        s.name = "off_an_edge"; /* face on face */
        s.from = v3(0.05, 0.1, 2.0 * flat - DEPTH);
        s.way = v3(2.5 * half, 0.4, 0.0);
        break;
    case 3:
        s.name = "off_an_edge_askew"; /* almost face on face */
        turn_about(v3(0.8, 0.6, 0.0), 0.004, s.axes_i);
        turn_about(z, 0.5, s.axes_j);
        s.from = v3(0.05, 0.1, 2.0 * flat - DEPTH);
        s.way = v3(3.0 * half, 0.4, 0.0);
        break;
    case 4:
        s.name = "rocking_on_a_face";
        s.from = v3(0.02, 0.03, 2.0 * flat - DEPTH);
        s.about = v3(0.8, 0.6, 0.0);
        s.angle = 0.02;
        break;
    case 5: /* a small cube along the stem of a T, until it meets the bar */
        s.name = "corner_of_a_letter";
        s.i = letter;
        s.size = small;
        s.from = v3(bar->middle.x - bar->half.x - wide - 0.5,
                    stem->middle.y + stem->half.y + wide - deep, 0.03);
        s.way = v3(0.5 + 2.0 * deep, -0.5 * deep, 0.1);
        break;
    default: /* along the outside of the bar, where the stem ends in its middle */
        s.name = "seam_of_a_letter";
        s.i = letter;
        s.size = small;
        s.from = v3(bar->middle.x + bar->half.x + wide - deep, -bar->half.y - 1.2 * wide, 0.03);
        s.way = v3(0.0, 2.0 * bar->half.y + 2.4 * wide, 0.1);
        break;
    }
    return s;
}

static struct shape_pose pose_of_j(const struct sweep *s, double part)
{
    vec3 more[3], axes[3];
    turn_about(s->about, (2.0 * part - 1.0) * s->angle, more);
    for (int k = 0; k < 3; k++)
        axes[k] = turned_by(more, s->axes_j[k]);
    return pose(v3_axpy(s->from, part, s->way), axes, s->size);
}

/* With the distance of the cores as they are, along the line through the nearest points. */
static struct felt feel_sharp(const struct sweep *s, const struct shape_pair *p)
{
    static struct placed a, b;
    struct felt all = {.depth = -1.0};
    for (int k = 0; k < 3; k++) {
        a.axes[k] = s->axes_i[k];
        b.axes[k] = v3_scale(s->size, mat3_turn(&p->j.turn, v3(k == 0, k == 1, k == 2)));
    }
    a.at = v3(0.0, 0.0, 0.0);
    b.at = p->j.centre;
    for (int m = 0; m < s->i->n_parts; m++)
        for (int n = 0; n < s->j->n_parts; n++) {
            const struct polyhedron *const pa = s->i->part[m].core, *const pb =
                                                                        s->j->part[n].core;
            struct gap_memory none = {0};
            struct gap gap;
            place(&a, pa);
            place(&b, pb);
            gap_find(&a.points, NULL, &b.points, NULL, b.axes, 1e9, &none, &gap);
            const double depth = DILATION * (1.0 + s->size) - gap.distance;
            if (depth <= 0.0)
                continue;
            const double f = depth * sqrt(depth);
            all.force = v3_axpy(all.force, f, gap.normal);
            all.torque = v3_axpy(all.torque, f, v3_cross(gap.on_a, gap.normal));
        }
    return all;
}

struct jump {
    double force, torque, most; /* the first two over the last */
};

static struct jump jump_of(const struct sweep *s, double k, long steps)
{
    real memory[DILATED_KEPT * DILATED_MEMORY] = {0};
    struct shape_pair pair = {
        .i = pose(v3(0.0, 0.0, 0.0), s->axes_i, 1.0), .reach = 0.05, .memory = memory};
    struct felt before = {.depth = 0.0};
    struct jump j = {0.0};
    for (long n = 0; n <= steps; n++) {
        pair.j = pose_of_j(s, (double)n / (double)steps);
        const struct felt f = k == EXACT ? feel_sharp(s, &pair) : feel(s->i, s->j, k, &pair);
        j.most = fmax(j.most, v3_norm(f.force));
        if (n > 0) {
            j.force = fmax(j.force, v3_norm(v3_sub(f.force, before.force)));
            j.torque = fmax(j.torque, v3_norm(v3_sub(f.torque, before.torque)));
        }
        before = f;
    }
    j.force /= j.most;
    j.torque /= j.most * s->size;
    return j;
}

/* Continuous: with steps a quarter as long the largest change is less than half of what it was. */
static const char *verdict(double coarse, double fine)
{
    return fine < 1e-6 || fine < 0.5 * coarse ? "continuous" : "JUMPS";
}

static void jumps(FILE *file)
{
    static const double kinds[] = {CROWNED, 0.01, 1e-3, EXACT};
    struct dilated *const cube = body(0), *const letter = body(LETTER_T);
    printf("  largest change of force, and of torque over the size, from step to step of a "
           "sweep, over the "
           "largest force\n  %-24s %-8s",
           "", "k");
    for (int level = 0; level < FINENESS; level++)
        printf("  1/%-15ld", (long)COARSE << (2 * level));
    printf("\n");
    for (int which = 0; which < SWEEPS; which++) {
        const struct sweep s = sweep_of(which, cube, letter);
        for (size_t d = 0; d < sizeof kinds / sizeof kinds[0]; d++) {
            struct jump j[FINENESS];
            char text[16];
            label(kinds[d], text);
            printf("  %-24s %-8s", s.name, text);
            for (int level = 0; level < FINENESS; level++) {
                const long steps = (long)COARSE << (2 * level);
                j[level] = jump_of(&s, kinds[d], steps);
                printf("  %.2e %.2e", j[level].force, j[level].torque);
                fprintf(file, "%s %g %g %g %g\n", s.name, kinds[d], 1.0 / (double)steps,
                        j[level].force, j[level].torque);
            }
            printf("  force %s, torque %s\n",
                   verdict(j[FINENESS - 2].force, j[FINENESS - 1].force),
                   verdict(j[FINENESS - 2].torque, j[FINENESS - 1].torque));
        }
    }
    dilated_free(cube);
    dilated_free(letter);
}

static FILE *open_in(const char *folder, const char *name)
{
    char *const path = xprintf("%s/%s", folder, name);
    FILE *const f = fopen(path, "w");
    if (!f)
        die(EXIT_UNSTABLE, "%s cannot be written", path);
    xfree(path);
    return f;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: detectors FOLDER\n");
        return 2;
    }
    FILE *const e = open_in(argv[1], "errors.dat"), *const j = open_in(argv[1], "jumps.dat");
    const bool good = errors(e);
    jumps(j);
    fclose(e);
    fclose(j);
    return !good;
}
