/* verify/letters.c - the six letters of [LiLiuJi23, figs 10 to 12], and places for them to fall from.
 *
 * The core of a letter is 100 wide, 30 thick and 180 high in mm, of strokes as wide as asked, and dilated
 * by r. Strokes are quadrilaterals in the plane y, z; those of the whole letter pushed in by r
 * are the cores, and volume and centre come from the plane: at a distance d outside of the cores
 * the letter is 30 + 2 sqrt(r^2 - d^2) thick, summed over squares of half a millimetre.
 *
 * letters FOLDER LETTER STROKE DILATION COUNT SEED BASE HEIGHT (mm): FOLDER/LETTER.obj, a part a stroke;
 * FOLDER/LETTER.places for fill = file; prints the volume-equivalent diameter, mm, and, of as many
 * letters in the space, the solid fraction. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include "random_boxes.h"

#define PI   3.14159265358979323846
#define FINE 0.5 /* mm */

enum { STROKES_MOST = 4 };

/* Corners y, z in order: bottom left, bottom right, top right, top left. */
struct stroke {
    double y[4], z[4];
};

struct letter {
    double wide, thick, high; /* mm, edges and all */
    int n;
    struct stroke core[STROKES_MOST];
    double r, volume, y, z; /* of the centre of mass */
};

/* Strokes as wide as the letter's own, between two heights; each is pushed in by r. */
static void add(struct letter *l, double left0, double left1, double wide, double z0, double z1)
{
    const double tilt = (left1 - left0) / (z1 - z0), in = l->r * sqrt(1.0 + tilt * tilt);
    struct stroke *const s = &l->core[l->n++];
    for (int k = 0; k < 4; k++) {
        const double z = k < 2 ? z0 + l->r : z1 - l->r, left = left0 + tilt * (z - z0);
        s->y[k] = k == 0 || k == 3 ? left + in : left + wide - in;
        s->z[k] = z;
    }
}

static bool make_letter(struct letter *l, char name, double core, double r)
{
    const double more = 2.0 * r;
    *l = (struct letter){
        .wide = 100.0 + more, .thick = 30.0 + more, .high = 180.0 + more, .r = r};
    const double y = 0.5 * l->wide, z = 0.5 * l->high, t = core + more, bar = -40.0 - r;
    switch (name) {
    case 'O':
        add(l, y - t, y - t, t, -z, z); /* and as C */ /* fall through */
    case 'C':
        add(l, -y, -y, t, -z, z);
        add(l, -y, -y, l->wide, -z, -z + t);
        add(l, -y, -y, l->wide, z - t, z);
        return true;
    case 'T':
        add(l, -0.5 * t, -0.5 * t, t, -z, z);
        add(l, -y, -y, l->wide, z - t, z);
        return true;
    case 'Z':
        add(l, -y, -y, l->wide, -z, -z + t);
        add(l, -y, -y, l->wide, z - t, z);
        add(l, -y, y - t, t, -z, z);
        return true;
    case 'K':
        add(l, -y, -y, t, -z, z);
        add(l, -y, y - t, t, 0.0, z);
        add(l, y - t, -y, t, -z, 0.0);
        return true;
    case 'A':
        add(l, -y, -0.5 * t, t, -z, z);
        add(l, y - t, -0.5 * t, t, -z, z);
        add(l, -0.5 * y, -0.5 * y, y, bar, bar + t);
        return true;
    default:
        return false;
    }
}

/* How far outside of a core, 0 inside. */
static double outside(const struct stroke *s, double y, double z)
{
    double best = (double)INFINITY;
    bool in = true;
    for (int k = 0; k < 4; k++) {
        const int m = (k + 1) % 4;
        const double ey = s->y[m] - s->y[k], ez = s->z[m] - s->z[k];
        const double py = y - s->y[k], pz = z - s->z[k];
        const double u = fmin(fmax((py * ey + pz * ez) / (ey * ey + ez * ez), 0.0), 1.0);
        best = fmin(best, hypot(py - u * ey, pz - u * ez));
        in = in && ey * pz - ez * py >= 0.0;
    }
    return in ? 0.0 : best;
}

static void weigh(struct letter *l)
{
    const int across = (int)(l->wide / FINE), up = (int)(l->high / FINE);
    for (int i = 0; i < across; i++)
        for (int j = 0; j < up; j++) {
            const double y = (i + 0.5) * FINE - 0.5 * l->wide,
                         z = (j + 0.5) * FINE - 0.5 * l->high;
            double d = (double)INFINITY;
            for (int k = 0; k < l->n; k++)
                d = fmin(d, outside(&l->core[k], y, z));
            if (d >= l->r)
                continue;
            const double v =
                FINE * FINE * (l->thick - 2.0 * l->r + 2.0 * sqrt(l->r * l->r - d * d));
            l->volume += v;
            l->y += v * y;
            l->z += v * z;
        }
    l->y /= l->volume;
    l->z /= l->volume;
}

static FILE *open_in(const char *folder, char name, const char *end)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%c.%s", folder, name, end);
    FILE *const f = fopen(path, "w");
    if (!f) {
        perror(path);
        exit(4);
    }
    return f;
}

static void write_obj(const struct letter *l, FILE *f)
{
    static const int face[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                   {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (int k = 0; k < l->n; k++) {
        fprintf(f, "o stroke%d\n", k);
        for (int v = 0; v < 8; v++)
            fprintf(f, "v %.9g %.9g %.9g\n", (v < 4 ? -0.5 : 0.5) * (l->thick - 2.0 * l->r),
                    l->core[k].y[v % 4], l->core[k].z[v % 4]);
        for (int q = 0; q < 6; q++)
            fprintf(f, "f %d %d %d %d\n", 8 * k + 1 + face[q][0], 8 * k + 1 + face[q][1],
                    8 * k + 1 + face[q][2], 8 * k + 1 + face[q][3]);
    }
}

int main(int argc, char **argv)
{
    struct letter l;
    if (argc != 9 || !make_letter(&l, argv[2][0], atof(argv[3]), atof(argv[4]))) {
        fprintf(stderr, "letters FOLDER LETTER STROKE DILATION COUNT SEED BASE HEIGHT\n");
        return 2;
    }
    const int count = atoi(argv[5]);
    const double base = atof(argv[7]), height = atof(argv[8]);
    weigh(&l);
    FILE *f = open_in(argv[1], argv[2][0], "obj");
    write_obj(&l, f);
    fclose(f);
    f = open_in(argv[1], argv[2][0], "places");
    const struct box_kind about = {.half = {0.5 * l.thick, 0.5 * l.wide, 0.5 * l.high},
                                   .offset = {0.0, -l.y, -l.z},
                                   .base = base,
                                   .height = height};
    const double d = cbrt(6.0 / PI * l.volume); /* mm */
    const bool all = boxes_place(&about, count, strtoul(argv[6], NULL, 10), v3(0.0, 0.0, 0.0),
                                 1e-3, 1e-3 * d, f);
    fclose(f);
    if (!all) {
        fprintf(stderr, "%d letters find no room in %g x %g x %g mm\n", count, base, base,
                height);
        return 2;
    }
    printf("%.4f %.4f\n", d, count * l.volume / (base * base * height));
    return 0;
}
