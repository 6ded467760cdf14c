/* bench/walls.c [PART] - what a contact with a wall costs beside one between grains. 4,900 grains that
 * touch nothing, each other in pairs, or one wall each; then a layer in which each touches its four
 * neighbours and the wall. All are at rest, with a time step so short that nothing moves. ns per
 * contact: the processor's time of a step less that of the same grains without the wall (without each other),
 * over the contacts; medians of rounds in which the cases take turns. PART: only the walls whose
 * names hold it. */
/* slots: contact/hertz_mindlin */
#include <time.h>
#include "../verify/harness.h"

enum { SIDE = 70, GRAINS = SIDE * SIDE, ROUNDS = 11, STEPS = 200, CASES = 40 };

#define PI   3.14159265358979323846
#define EDGE 1.2371e-3 /* m between grains of 1 mm: no multiple of an edge of the meshes */
#define DIP  1e-6      /* m, of grains into each other and into the wall */

static char folder[] = "/tmp/silt-bench-XXXXXX";

struct layout {
    const char *name;
    char *wall; /* its section of the scene */
    void (*put)(int i, double *x);
    int base; /* the case without these contacts */
    long contacts;
    double cost[ROUNDS];
    struct sim *sim;
};

static void apart(int i, double *x)
{
    x[0] = 2.13e-3 + EDGE * (i % SIDE);
    x[1] = 2.37e-3 + EDGE * (i / SIDE);
    x[2] = 50e-3;
}

static void pairs(int i, double *x)
{
    apart(i / 2 * 2, x);
    x[2] += i % 2 * (1e-3 - DIP);
}

/* Askew, so that the grains lie all over the triangles. */
static void layer(int i, double *x)
{
    const double u = (1e-3 - DIP) * (i % SIDE - 0.5 * (SIDE - 1)), c = cos(0.3);
    const double v = (1e-3 - DIP) * (i / SIDE - 0.5 * (SIDE - 1)), d = sin(0.3);
    x[0] = 45e-3 + c * u - d * v;
    x[1] = 45e-3 + d * u + c * v;
    x[2] = 20.5e-3 - DIP;
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

/* Rows along y on the inside of a drum of this radius at y = 0, wider by 1/1000 a metre. */
static void around(int i, double radius, double wider, double *x)
{
    const double angle = 2.0 * PI * (i % SIDE) / SIDE, y = 2e-3 + EDGE * (i / SIDE);
    const double r = radius + wider * y - (0.5e-3 - DIP) * sqrt(1.0 + wider * wider);
    x[0] = 45e-3 + r * cos(angle);
    x[2] = 45e-3 + r * sin(angle);
    x[1] = y;
}

static void drum(int i, double *x)
{
    around(i, 44e-3, 0.0, x);
}

static void cone(int i, double *x)
{
    around(i, 30e-3, 0.15, x);
}

static char *floor_path(double edge)
{
    return xprintf("%s/floor-%g.stl", folder, edge);
}

static char *write_floor(double edge)
{
    char *const path = floor_path(edge);
    FILE *const file = fopen(path, "w");
    const int n = (int)(90.0 / edge + 0.5);
    if (!file)
        abort();
    fprintf(file, "solid floor\n");
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const double x = edge * i, y = edge * j, u = x + edge, v = y + edge;
            fprintf(file,
                    "facet normal 0 0 1\nouter loop\nvertex %g %g 20\nvertex %g %g 20\n"
                    "vertex %g %g 20\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                    "vertex %g %g 20\nvertex %g %g 20\nvertex %g %g 20\nendloop\nendfacet\n",
                    x, y, u, y, u, v, x, y, u, v, x, v);
        }
    fprintf(file, "endsolid floor\n");
    fclose(file);
    return path;
}

static char *mesh(double edge, const char *more)
{
    char *const path = write_floor(edge);
    char *const text =
        xprintf("[wall w]\nkind = mesh\nfile = %s\nscale = 1 mm\n%s", path, more);
    xfree(path);
    return text;
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

static int n_cases;

static void add(struct layout *all, const char *name, int base, void (*put)(int i, double *x),
                char *wall)
{
    all[n_cases++] = (struct layout){.name = name, .put = put, .base = base, .wall = wall};
}

#define FLAT  "point = 0 0 20 mm\nnormal = 0 0 1\n"
#define PLATE "kind = rectangle\ncorner = 0 0 20 mm\nedge1 = 90 0 0 mm\nedge2 = 0 90 0 mm\n"
#define DRUM  "point = 45 0 45 mm\naxis = 0 1 0\nside = in\n"
#define TURN  "spin = 1 rad/s\nspin_axis = 0 1 0\nspin_point = 45 0 45 mm\n"
#define ROUND "spin = 1 rad/s\nspin_axis = 0 0 1\nspin_point = 45 45 20 mm\n"
#define SHAKE "direction = 0 0 1\namplitude = 1 um\nfrequency = 50 Hz\n"
#define DISC  "kind = disc\npoint = 45 45 20 mm\nnormal = 0 0 1\nradius = 64 mm\n"

static void write_cases(struct layout *all, const char *part)
{
    enum { APART, PAIRS, LAYER };
    const struct {
        const char *name;
        void (*put)(int i, double *x);
        char *wall;
    } walls[] = {
        {"side of the box", bottom, xstrdup("")},
        {"plane", low, xstrdup("[wall w]\n" FLAT)},
        {"plane that shakes", low, xstrdup("[wall w]\n" FLAT SHAKE)},
        {"box", low,
         xstrdup("[wall w]\nkind = box\nfrom = 0 0 20 mm\nto = 90 90 80 mm\nside = in\n")},
        {"rectangle", low, xstrdup("[wall w]\n" PLATE)},
        {"disc", low, xstrdup("[wall w]\n" DISC)},
        {"disc that turns", low, xstrdup("[wall w]\n" DISC ROUND)},
        {"cylinder", drum, xstrdup("[wall w]\nkind = cylinder\nradius = 44 mm\n" DRUM)},
        {"cylinder that turns", drum,
         xstrdup("[wall w]\nkind = cylinder\nradius = 44 mm\n" DRUM TURN)},
        {"cone", cone,
         xstrdup("[wall w]\nkind = cone\nradius = 30 mm\nradius_end = 43.5 mm\n"
                 "length = 90 mm\n" DRUM)},
        {"mesh, 90 mm wide", low, mesh(90.0, "")},
        {"mesh, 2 mm", low, mesh(2.0, "")},
        {"mesh, 2 mm, that turns", low, mesh(2.0, ROUND)},
        {"mesh, 0.5 mm", low, mesh(0.5, "")},
    };
    add(all, "no contact", APART, apart, xstrdup(""));
    add(all, "two grains", APART, pairs, xstrdup(""));
    add(all, "layer of grains", APART, layer, xstrdup(""));
    for (size_t k = 0; k < 2 * sizeof walls / sizeof *walls; k++) {
        const size_t of = k / 2;
        const bool bed = k % 2;
        if (strstr(walls[of].name, part) && (!bed || walls[of].put == low))
            add(all, walls[of].name, bed ? LAYER : APART, bed ? layer : walls[of].put,
                xstrdup(walls[of].wall));
    }
    for (size_t k = 0; k < sizeof walls / sizeof *walls; k++)
        xfree(walls[k].wall);
}

static int clear_up(void)
{
    const double edge[3] = {90.0, 2.0, 0.5};
    for (int k = 0; k < 3; k++) {
        char *const path = floor_path(edge[k]);
        unlink(path);
        xfree(path);
    }
    return rmdir(folder) != 0;
}

int main(int argc, char **argv)
{
    static struct layout all[CASES];
    double time[CASES], grains[3] = {1.0, 1.0, 1.0};
    if (!mkdtemp(folder))
        return 1;
    write_cases(all, argc > 1 ? argv[1] : "");
    for (int k = 0; k < n_cases; k++)
        open_case(&all[k]);
    for (int round = 0; round < ROUNDS; round++)
        for (int k = 0; k < n_cases; k++) {
            const clock_t start = clock();
            step_grains(all[k].sim, STEPS);
            all[k].cost[round] = (double)(clock() - start) / CLOCKS_PER_SEC / STEPS;
        }
    printf("contacts of %d grains            contacts   ns a contact   over the grains'\n",
           GRAINS);
    for (int k = 0; k < n_cases; k++)
        time[k] = median(all[k].cost);
    for (int k = 1; k < n_cases; k++) {
        const struct layout *const base = &all[all[k].base];
        const long contacts = all[k].contacts - base->contacts;
        const double ns = 1e9 * (time[k] - time[all[k].base]) / fmax(1.0, (double)contacts);
        const double own = k < 3 ? ns : grains[all[k].base];
        grains[k == 1 ? 0 : 2] = k < 3 ? ns : grains[2];
        printf("  %-23s %8s %8ld %14.1f %18.2f\n", all[k].name,
               k >= 3 && all[k].base > 0 ? "in a bed" : "", contacts, ns, ns / own);
    }
    for (int k = 0; k < n_cases; k++) {
        sim_free(all[k].sim);
        xfree(all[k].wall);
    }
    return clear_up();
}
