/* bench/walls.c - what a contact with a wall costs beside one between grains: 4,900 grains that touch
 * nothing, each other in pairs, or one wall each, all at rest (a time step so short that nothing
 * moves). ns per contact: the time of a step less that without contacts, over the contacts; medians
 * of rounds in which the cases take turns. */
/* slots: contact/hertz_mindlin */
#include "../verify/harness.h"

enum { SIDE = 70, GRAINS = SIDE * SIDE, ROUNDS = 11, STEPS = 200, CASES = 9 };

#define PI   3.14159265358979323846
#define EDGE 1.2e-3 /* m between grains of 1 mm */
#define DIP  1e-6   /* m, into the wall */

static char folder[] = "/tmp/silt-bench-XXXXXX";

struct layout {
    const char *name, *wall; /* its section of the scene */
    void (*put)(int i, double *x);
    long contacts;
    double cost[ROUNDS];
    struct sim *sim;
};

static void apart(int i, double *x)
{
    x[0] = 2e-3 + EDGE * (i % SIDE);
    x[1] = 2e-3 + EDGE * (i / SIDE);
    x[2] = 50e-3;
}

static void pairs(int i, double *x)
{
    apart(i / 2 * 2, x);
    x[2] += i % 2 * (1e-3 - DIP);
}

static void low(int i, double *x)
{
    apart(i, x);
    x[2] = 20.5e-3 - DIP;
}

static void bottom(int i, double *x)
{
    apart(i, x);
    x[2] = 0.5e-3 - DIP;
}

/* Rows along y on the inside of a drum, or of a cone that is nearly one. */
static void drum(int i, double *x)
{
    const double angle = 2.0 * PI * (i % SIDE) / SIDE, r = 44e-3 - 0.5e-3 + DIP;
    x[0] = 45e-3 + r * cos(angle);
    x[2] = 45e-3 + r * sin(angle);
    x[1] = 2e-3 + EDGE * (i / SIDE);
}

static void write_floor(const char *path)
{
    FILE *const file = fopen(path, "w");
    if (!file)
        abort();
    fprintf(file, "solid floor\n");
    for (int i = 0; i < 45; i++)
        for (int j = 0; j < 45; j++) {
            const int x = 2 * i, y = 2 * j;
            fprintf(file,
                    "facet normal 0 0 1\nouter loop\nvertex %d %d 20\nvertex %d %d 20\n"
                    "vertex %d %d 20\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                    "vertex %d %d 20\nvertex %d %d 20\nvertex %d %d 20\nendloop\nendfacet\n",
                    x, y, x + 2, y, x + 2, y + 2, x, y, x + 2, y + 2, x, y + 2);
        }
    fprintf(file, "endsolid floor\n");
    fclose(file);
}

static void open_case(struct layout *p)
{
    char *const path = xprintf("%s/grains", folder);
    FILE *const file = fopen(path, "w");
    if (!file)
        abort();
    for (int i = 0; i < GRAINS; i++) {
        double x[3];
        p->put(i, x);
        fprintf(file, "%.17g %.17g %.17g 0.001\n", x[0], x[1], x[2]);
    }
    fclose(file);
    char *const text = xprintf(
        "[domain]\nsize = 90 90 90 mm\ngravity = 0 0 0 m/s2\n[grains a]\ndiameter = 1 mm\n"
        "density = 2500 kg/m3\nfill = file\nfile = %s\n[material a]\nyoung = 5 MPa\n"
        "poisson = 0.3\nrestitution = 0.5\nfriction = 0.4\n[run]\nend = 1 s\ndt = 1e-10 s\n%s",
        path, p->wall);
    p->sim = sim_from(text);
    step_grains(p->sim, STEPS);
    p->contacts = p->sim->neighbours.touching;
    unlink(path);
    xfree(text);
    xfree(path);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *x)
{
    qsort(x, ROUNDS, sizeof *x, by_value);
    return x[ROUNDS / 2];
}

int main(void)
{
    if (!mkdtemp(folder))
        return 1;
    char *const stl = xprintf("%s/floor.stl", folder);
    char *const mesh = xprintf("[wall w]\nkind = mesh\nfile = %s\nscale = 1 mm\n", stl);
    write_floor(stl);
#define DRUM "point = 45 0 45 mm\naxis = 0 1 0\nradius = 44 mm\nside = in\n"
    struct layout place[CASES] = {
        {.name = "no contact", .put = apart, .wall = ""},
        {.name = "two grains", .put = pairs, .wall = ""},
        {.name = "side of the box", .put = bottom, .wall = ""},
        {.name = "plane", .put = low, .wall = "[wall w]\npoint = 0 0 20 mm\nnormal = 0 0 1\n"},
        {.name = "rectangle",
         .put = low,
         .wall = "[wall w]\nkind = rectangle\ncorner = 0 0 20 mm\nedge1 = 90 0 0 mm\n"
                 "edge2 = 0 90 0 mm\n"},
        {.name = "disc",
         .put = low,
         .wall = "[wall w]\nkind = disc\npoint = 45 45 20 mm\nnormal = 0 0 1\n"
                 "radius = 64 mm\n"},
        {.name = "cylinder", .put = drum, .wall = "[wall w]\nkind = cylinder\n" DRUM},
        {.name = "turning cylinder",
         .put = drum,
         .wall = "[wall w]\nkind = cylinder\nspin = 1 rad/s\nspin_axis = 0 1 0\n"
                 "spin_point = 45 0 45 mm\n" DRUM},
        {.name = "mesh of 4,050 triangles", .put = low, .wall = mesh},
    };
    for (int k = 0; k < CASES; k++)
        open_case(&place[k]);
    for (int round = 0; round < ROUNDS; round++)
        for (int k = 0; k < CASES; k++) {
            const double start = wall_clock();
            step_grains(place[k].sim, STEPS);
            place[k].cost[round] = (wall_clock() - start) / STEPS;
        }
    const double none = median(place[0].cost);
    printf("contacts of %d grains            contacts   ns a contact   over two grains'\n",
           GRAINS);
    double grains = 1.0;
    for (int k = 1; k < CASES; k++) {
        const double ns =
            1e9 * (median(place[k].cost) - none) / fmax(1.0, (double)place[k].contacts);
        grains = k == 1 ? ns : grains;
        printf("  %-32s %8ld %14.1f %18.2f\n", place[k].name, place[k].contacts, ns,
               ns / grains);
        sim_free(place[k].sim);
    }
    sim_free(place[0].sim);
    unlink(stl);
    rmdir(folder);
    xfree(mesh);
    xfree(stl);
    return 0;
}
