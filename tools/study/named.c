/* named.c - axes by the field's names, each put into keys of the scene at hand. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include "study.h"
#include "../../solver/scene.h"
#include "view.h"

static const double pi = 3.14159265358979323846;

const struct named_axis named_axes[] = {
    {"density_ratio", "1e-3:1e4:8", "density of the grains over that of the fluid"},
    {"stiffness", "1e3:1e12:10",
     "Pa: Young's modulus of every material (Poisson's ratio 0.3 where none is given); contact "
     "= "
     "linear: times the grain's diameter, N/m"},
    {"restitution", "0.01,0.05,0.2,0.5,0.8,0.95,1", "of every material"},
    {"friction", "0,0.01,0.1,0.5,1,3,10", "of every material"},
    {"size_ratio", "1:100:5",
     "diameter of the first species over that of the second; of one: log-normal sizes below "
     "its own"},
    {"void_fraction", "0.26,0.3,0.4,0.6,0.9,0.99,0.999,0.9999",
     "of a box of two fcc unit cells in each direction, a cell of the grid each"},
    {"cell_d", "0.25,0.5,1,2,4,8,10", "edge of a cell of the fluid's grid over the diameter"},
    {"reynolds", "1e-8:1e6:8",
     "of a grain: by the inflow, or else by the viscosity in which it falls so"},
    {"viscosity", "1e-9:1e3:7", "Pa s: of the fluid"},
    {"grain_step", "0.01:10:7", "step of the grains over its limit"},
    {"fluid_step", "0.01:10:7", "step of the fluid over its limit"},
    {"drag_dt", "1e-4:1e8:7",
     "drag rate of a grain times the fluid's step, by the viscosity, which is implicit then"},
    {"contrast", "1:1e8:5", "conductivity of one layer of a Darcy column over the other's"},
    {"case", "empty,one_grain,one_cell,touching,jammed",
     "no grains; one; one cell; one that touches a side; all touching (fcc, porosity 0.2595)"},
    {0},
};

/* What is written while an axis is put into keys. */
struct expansion {
    struct study *study;
    struct view v;
    char *const *overrides;
    int n_overrides;
    double x;
    const char *word;
    char **out;
    int n;
    char *why;
};

__attribute__((format(printf, 2, 3))) static void put(struct expansion *e, const char *format,
                                                      ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (e->n < MOST_EXPANSION)
        e->out[e->n++] = xstrdup(text);
}

static bool refuse(struct expansion *e, const char *why)
{
    e->why = xstrdup(why);
    return false;
}

/* The first species that moves, or else the first; NULL without grains of one diameter. */
static const struct species_view *main_species(const struct view *v)
{
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < v->n; i++)
            if ((pass == 1 || !v->species[i].frozen) && v->species[i].d > 0.0)
                return &v->species[i];
    return NULL;
}

static bool density_ratio(struct expansion *e)
{
    if (!e->v.fluid)
        return refuse(e, "the scene has no fluid");
    for (int i = 0; i < e->v.n; i++)
        if (!e->v.species[i].frozen)
            put(e, "grains %s.density=%.9g kg/m3", e->v.species[i].name, e->x * e->v.rho);
    return e->n > 0 || refuse(e, "no grain moves");
}

static bool stiffness(struct expansion *e)
{
    const struct species_view *const sp = main_species(&e->v);
    if (!sp)
        return refuse(e, "the scene has no grains of one diameter");
    for (int i = 0; i < e->v.n_materials; i++)
        if (e->v.linear)
            put(e, "material %s.stiffness=%.9g N/m", e->v.material[i], e->x * sp->d);
        else
            put(e, "material %s.young=%.9g Pa", e->v.material[i], e->x);
    for (int i = 0; i < e->v.n_materials && !e->v.linear; i++)
        if (!scene_given(e->v.scene, "material", e->v.material[i], "poisson"))
            put(e, "material %s.poisson=0.3", e->v.material[i]);
    return e->n > 0 || refuse(e, "the scene has no material");
}

static bool material_key(struct expansion *e, const char *key)
{
    for (int i = 0; i < e->v.n_materials; i++)
        put(e, "material %s.%s=%.9g", e->v.material[i], key, e->x);
    return e->n > 0 || refuse(e, "the scene has no material");
}

/* Where the scene's reference expects a restitution, it expects this one. */
static bool restitution(struct expansion *e)
{
    if (scene_given(e->v.scene, "reference", NULL, "restitution"))
        put(e, "reference.restitution=%.9g", e->x);
    return material_key(e, "restitution");
}

static bool friction(struct expansion *e)
{
    return material_key(e, "friction");
}

static bool size_ratio(struct expansion *e)
{
    const struct species_view *const sp = main_species(&e->v);
    if (!sp)
        return refuse(e, "the scene has no grains of one diameter");
    if (e->v.n > 1) {
        put(e, "grains %s.diameter=%.9g m", e->v.species[1].name, e->v.species[0].d / e->x);
        return true;
    }
    if (e->x == 1.0)
        return true;
    put(e, "grains %s.sizes=lognormal", sp->name);
    put(e, "grains %s.spread=%.9g", sp->name, fmin(10.0, pow(e->x, 1.0 / 3.0)));
    put(e, "grains %s.diameter_min=%.9g m", sp->name, sp->d / e->x);
    put(e, "grains %s.diameter_max=%.9g m", sp->name, 1.001 * sp->d);
    return true;
}

/* fcc: four grains to a cell of edge a, 1 - eps = 4 (pi/6) (d/a)^3. The lowest lie a/4 above the cell's
 * side: sides that are walls stand off until they do not cut into grains. */
static void pack(struct expansion *e, const struct species_view *sp, double eps)
{
    const double a = sp->d * cbrt(4.0 * pi / 6.0 / (1.0 - eps));
    put(e, "grains %s.fill=unit_cell", sp->name);
    put(e, "grains %s.cell=fcc", sp->name);
    put(e, "grains %s.spacing=%.15g m", sp->name, a);
    double gap[3];
    for (int k = 0; k < 3; k++)
        gap[k] = e->v.periodic[k] ? 0.0 : fmax(0.0, 0.5 * sp->d - 0.25 * a);
    put(e, "grains %s.from=%.15g %.15g %.15g m", sp->name, gap[0], gap[1], gap[2]);
    put(e, "grains %s.to=%.15g %.15g %.15g m", sp->name, 2.0 * a + gap[0], 2.0 * a + gap[1],
        2.0 * a + gap[2]);
    put(e, "domain.size=%.15g %.15g %.15g m", 2.0 * (a + gap[0]), 2.0 * (a + gap[1]),
        2.0 * (a + gap[2]));
    if (e->v.fluid)
        put(e, "domain.cells=2 2 2");
}

static bool void_fraction(struct expansion *e)
{
    const struct species_view *const sp = main_species(&e->v);
    if (!sp || e->v.n > 1)
        return refuse(e, "for scenes with one species of one diameter");
    if (!(e->x > 0.0 && e->x < 1.0))
        return refuse(e, "a void fraction lies between 0 and 1");
    pack(e, sp, e->x);
    return true;
}

static bool cell_d(struct expansion *e)
{
    const struct species_view *const sp = main_species(&e->v);
    int n[3];
    if (!sp || !e->v.fluid)
        return refuse(e, "the scene has no fluid, or no grains of one diameter");
    for (int a = 0; a < 3; a++)
        n[a] = (int)fmax(1.0, rint(fmin(1e5, e->v.size[a] / (e->x * sp->d))));
    put(e, "domain.cells=%d %d %d", n[0], n[1], n[2]);
    return true;
}

/* Inflow: u = Re mu/(rho d). A falling grain: Ar = 18 Re (1 + 0.15 Re^0.687) [SchillerNaumann35],
 * Re > 1000: Ar = 0.33 Re^2; Ar = rho |rho_s - rho| g d^3/mu^2. */
static bool reynolds(struct expansion *e)
{
    const struct view *const v = &e->v;
    const struct species_view *const sp = main_species(v);
    if (!sp || !v->fluid || !(v->mu > 0.0))
        return refuse(e, "the scene has no viscous fluid, or no grains of one diameter");
    if (v->inflow > 0.0) {
        put(e, "flow.velocity=%.12g m/s", e->x * v->mu / (v->rho * sp->d));
        return true;
    }
    const double ar =
        e->x > 1000.0 ? 0.33 * e->x * e->x : 18.0 * e->x * (1.0 + 0.15 * pow(e->x, 0.687));
    const double pull = v->rho * fabs(sp->rho - v->rho) * v->gravity * pow(sp->d, 3.0);
    if (!(pull > 0.0) || sp->frozen)
        return refuse(e, "nothing flows in and no grain falls");
    put(e, "fluid.viscosity=%.12g Pa s", sqrt(pull / ar));
    return true;
}

static bool viscosity(struct expansion *e)
{
    if (!e->v.fluid)
        return refuse(e, "the scene has no fluid");
    put(e, "fluid.viscosity=%.9g Pa s", e->x);
    return true;
}

/* The least limit whose name begins (or, with `not`, does not begin) so; 0 if there is none. */
static double least_limit(struct expansion *e, const char *const *begin, bool binding_only)
{
    struct limit l[MOST_LIMITS];
    enum ending ending;
    double least = HUGE_VAL;
    const struct built *const b =
        study_built(e->study, e->overrides, e->n_overrides, "double", &ending, &e->why);
    if (!b)
        return 0.0;
    const int n = limits_read(e->study, built_binary(b), e->overrides, e->n_overrides, l);
    for (int i = 0; i < n; i++)
        for (int k = 0; begin[k]; k++)
            if (strncmp(l[i].name, begin[k], strlen(begin[k])) == 0 &&
                (l[i].binding || !binding_only))
                least = fmin(least, l[i].limit);
    return isfinite(least) ? least : 0.0;
}

static bool no_limit(struct expansion *e)
{
    return e->why ? false : refuse(e, "check names no such limit of the scene");
}

static bool grain_step(struct expansion *e)
{
    static const char *const names[] = {"Rayleigh", "a quarter of a contact", NULL};
    const double limit = least_limit(e, names, true), dt = e->x * limit;
    if (limit == 0.0)
        return no_limit(e);
    put(e, "run.dt=%.12g s", dt);
    if (e->v.fluid && e->v.fluid_dt > 0.0 && e->v.fluid_dt < dt)
        put(e, "fluid.dt=%.12g s", dt);
    return true;
}

static bool fluid_step(struct expansion *e)
{
    static const char *const names[] = {"Courant", "explicit viscosity", "drag relaxation",
                                        NULL};
    const double limit = least_limit(e, names, true), dt = e->x * limit;
    if (limit == 0.0)
        return no_limit(e);
    put(e, "fluid.dt=%.12g s", dt);
    if (e->v.grain_dt > dt)
        put(e, "run.dt=%.12g s", dt);
    return true;
}

static bool drag_dt(struct expansion *e)
{
    static const char *const names[] = {"drag relaxation", NULL};
    const double limit = least_limit(e, names, false);
    if (!(limit > 0.0) || !(e->v.fluid_dt > 0.0) || !(e->v.mu > 0.0))
        return no_limit(e);
    put(e, "fluid.viscosity=%.9g Pa s", e->v.mu * e->x * limit / e->v.fluid_dt);
    if (e->v.navier_stokes)
        put(e, "fluid.viscous=implicit");
    return true;
}

/* One grain in the middle of a cubic unit cell of edge a: K ~ d^2 eps^3/(1 - eps)^2, with
 * 1 - eps = (pi/6) (d/a)^3. The first species is thinned until its layer conducts x times better.
 */
static bool contrast(struct expansion *e)
{
    const struct view *const v = &e->v;
    if (!v->darcy || v->n < 2 || !v->species[0].unit_cell || !(v->species[1].d > 0.0))
        return refuse(e, "for Darcy scenes of two species in unit cells");
    const double a = v->size[0] / fmax(1.0, v->cells[0]), d1 = v->species[1].d;
    double low = 1e-6 * d1, high = d1;
    for (int i = 0; i < 200; i++) {
        const double d = sqrt(low * high), s0 = pi / 6.0 * pow(d / a, 3.0),
                     s1 = pi / 6.0 * pow(d1 / a, 3.0);
        const double k0 = d * d * pow(1.0 - s0, 3.0) / (s0 * s0),
                     k1 = d1 * d1 * pow(1.0 - s1, 3.0) / (s1 * s1);
        if (k0 / k1 > e->x)
            low = d;
        else
            high = d;
    }
    put(e, "grains %s.diameter=%.15g m", v->species[0].name, sqrt(low * high));
    return true;
}

static bool special_case(struct expansion *e)
{
    const struct species_view *const sp = main_species(&e->v);
    const double *const size = e->v.size;
    if (!sp)
        return refuse(e, "the scene has no grains of one diameter");
    if (strcmp(e->word, "empty") == 0) {
        for (int i = 0; i < e->v.n; i++) {
            put(e, "grains %s.fill=random", e->v.species[i].name);
            put(e, "grains %s.count=0", e->v.species[i].name);
        }
    } else if (strcmp(e->word, "one_grain") == 0) {
        put(e, "grains %s.fill=point", sp->name);
        put(e, "grains %s.count=1", sp->name);
        put(e, "grains %s.position=%.9g %.9g %.9g m", sp->name, 0.5 * size[0], 0.5 * size[1],
            0.5 * size[2]);
    } else if (strcmp(e->word, "one_cell") == 0) {
        if (!e->v.fluid)
            return refuse(e, "the scene has no fluid");
        put(e, "domain.cells=1 1 1");
    } else if (strcmp(e->word, "touching") == 0) {
        put(e, "grains %s.fill=point", sp->name);
        put(e, "grains %s.count=1", sp->name);
        put(e, "grains %s.position=%.15g %.15g %.15g m", sp->name, 0.5 * sp->d, 0.5 * sp->d,
            0.5 * sp->d);
    } else if (strcmp(e->word, "jammed") == 0) {
        if (e->v.n > 1)
            return refuse(e, "for scenes with one species");
        pack(e, sp, 1.0 - pi / sqrt(18.0));
    } else {
        return refuse(e, "there are empty, one_grain, one_cell, touching, jammed");
    }
    return true;
}

static bool (*const expand[])(struct expansion *) = {
    density_ratio, stiffness, restitution, friction,   size_ratio, void_fraction, cell_d,
    reynolds,      viscosity, grain_step,  fluid_step, drag_dt,    contrast,      special_case};

static int find(const char *name)
{
    for (int i = 0; named_axes[i].name; i++)
        if (strcmp(named_axes[i].name, name) == 0)
            return i;
    return -1;
}

bool named_is(const char *name)
{
    return find(name) >= 0;
}

int named_expand(struct study *s, const char *name, const char *value, double number,
                 char *const *overrides, int n_overrides, char *out[MOST_EXPANSION], char **why)
{
    const int k = find(name);
    struct expansion e = {.study = s,
                          .v = view_read(s->scene, overrides, n_overrides),
                          .overrides = overrides,
                          .n_overrides = n_overrides,
                          .x = number,
                          .word = value,
                          .out = out};
    bool good = strcmp(name, "case") == 0 || isfinite(number);
    good = good ? expand[k](&e) : refuse(&e, "its values are numbers");
    view_free(&e.v);
    if (good)
        return e.n;
    for (int i = 0; i < e.n; i++)
        xfree(out[i]);
    *why = xprintf("%s: %s", name, e.why);
    xfree(e.why);
    return -1;
}
