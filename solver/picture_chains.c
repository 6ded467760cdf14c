/* picture_chains.c - force_chains.png: the contacts of the last output as lines between the centres
 * that they join, as wide and as dark as their normal force is large over the mean; drawn over the
 * outlines of the grains. The viewer looks along y; of a thick bed only a slice about its middle is
 * shown, three grains thick. Needs output.contacts = on. */
#include "picture_walls.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

enum { LEFT = 85, TOP = 80, BOTTOM = 145, MOST_LINES = 30000 };

struct chains {
    size_t n, first, contacts; /* grains; rows of the last output */
    double size[3], low[2], high[2], slice[2];
    size_t *row, ids; /* of a grain, by its id */
    double *radius, *pos, *grain, *force, *normal, *point, *branch;
    double mean; /* N, of the normal forces shown */
};

struct line {
    double x0, z0, x1, z1, force;
};

static int weakest_first(const void *a, const void *b)
{
    const double p = ((const struct line *)a)->force, q = ((const struct line *)b)->force;
    return (p > q) - (p < q);
}

/* The grains of the last output. Where grains come and go they are rows of `grain`, told apart by ids;
 * else the ids are the rows. */
static bool read_grains(const struct run_file *r, struct chains *c)
{
    const size_t records = run_length(r, "time");
    size_t n = 0, m = 0, got = 0, most = 0;
    double *const count = run_all(r, "grain_count", &n);
    c->radius =
        count ? run_record(r, "radius", records - 1, &c->n) : run_all(r, "radius", &c->n);
    c->pos = run_record(r, "position", records - 1, &got);
    double *const id = count ? run_record(r, "grain_id", records - 1, &m) : NULL;
    const bool good = c->radius && c->pos && got == 3 * c->n && (!count || (id && m == c->n));
    if (good && count && count[records - 1] < (double)c->n)
        c->n = (size_t)count[records - 1];
    xfree(count);
    for (size_t i = 0; good && i < c->n; i++) {
        const size_t one = id ? (size_t)id[i] : i;
        most = one > most ? one : most;
    }
    c->ids = most + 1;
    c->row = xalloc(c->ids, sizeof *c->row); /* 1 + row; 0: there is none of that id */
    for (size_t i = 0; good && i < c->n; i++)
        c->row[id ? (size_t)id[i] : i] = i + 1;
    xfree(id);
    return good;
}

static bool read_chains(const struct run_file *r, struct chains *c)
{
    size_t times = 0, rows = 0, got = 0;
    double *const listed = run_all(r, "contacts_listed", &times);
    if (!listed || times == 0) {
        xfree(listed);
        return false;
    }
    for (size_t t = 0; t + 1 < times; t++)
        c->first += (size_t)listed[t];
    c->contacts = (size_t)listed[times - 1];
    xfree(listed);
    c->grain = run_all(r, "contact_grain", &rows);
    c->force = run_all(r, "contact_force", &got);
    c->normal = run_all(r, "contact_normal", &got);
    c->point = run_all(r, "contact_point", &got);
    c->branch = run_all(r, "contact_branch", &got);
    return c->contacts > 0 && rows >= c->first + c->contacts && read_grains(r, c) &&
           nc_get_att_double(r->nc, NC_GLOBAL, "domain_size", c->size) == NC_NOERR;
}

/* What is shown: where the contacts are, and the slice along y. */
static void choose_view(struct chains *c)
{
    double widest = 0.0;
    c->low[0] = c->low[1] = HUGE_VAL;
    c->high[0] = c->high[1] = -HUGE_VAL;
    for (size_t i = 0; i < c->n; i++)
        widest = isfinite(c->radius[i]) ? fmax(widest, c->radius[i]) : widest;
    for (size_t k = c->first; k < c->first + c->contacts; k++)
        for (int a = 0; a < 2; a++) {
            c->low[a] = fmin(c->low[a], c->point[3 * k + 2 * a] - 2.0 * widest);
            c->high[a] = fmax(c->high[a], c->point[3 * k + 2 * a] + 2.0 * widest);
        }
    for (int a = 0; a < 2; a++) {
        c->low[a] = fmax(c->low[a], -widest);
        c->high[a] = fmin(c->high[a], c->size[2 * a] + widest);
    }
    c->slice[0] = 0.5 * c->size[1] - 3.0 * widest;
    c->slice[1] = 0.5 * c->size[1] + 3.0 * widest;
}

static double normal_force(const struct chains *c, size_t k)
{
    const double *const f = &c->force[3 * k], *const n = &c->normal[3 * k];
    return f[0] * n[0] + f[1] * n[1] + f[2] * n[2];
}

static struct line *find_lines(struct chains *c, size_t *count)
{
    struct line *const line = xalloc(c->contacts, sizeof *line);
    double sum = 0.0;
    *count = 0;
    for (size_t k = c->first; k < c->first + c->contacts; k++) {
        const double *const p = &c->point[3 * k], *const b = &c->branch[3 * k];
        const double f = normal_force(c, k);
        const size_t id = (size_t)c->grain[k];
        if (p[1] < c->slice[0] || p[1] > c->slice[1] || !(f > 0.0) || id >= c->ids ||
            c->row[id] == 0)
            continue;
        /* from the centre of the grain, near the point, back along the branch */
        const double half = c->radius[c->row[id] - 1];
        const double *const n = &c->normal[3 * k];
        const double x = p[0] + half * n[0], z = p[2] + half * n[2];
        line[(*count)++] = (struct line){x, z, x - b[0], z - b[2], f};
        sum += f;
    }
    c->mean = *count > 0 ? sum / (double)*count : 1.0;
    qsort(line, *count, sizeof *line, weakest_first);
    return line;
}

static void send_grains(FILE *to, const struct chains *c)
{
    fprintf(to, "$g << END\n");
    for (size_t i = 0; i < c->n; i++) {
        const double *const x = &c->pos[3 * i];
        const double y = x[1] - c->size[1] * floor(x[1] / c->size[1]);
        if (y >= c->slice[0] && y <= c->slice[1] && isfinite(x[0]))
            fprintf(to, "%.6g %.6g %.6g\n", 1e3 * x[0], 1e3 * x[2], 1e3 * c->radius[i]);
    }
    fprintf(to, "END\n");
}

static void draw(const struct run_file *r, struct chains *c)
{
    size_t count;
    struct line *const line = find_lines(c, &count);
    const double wide = c->high[0] - c->low[0], tall = c->high[1] - c->low[1];
    const double scale = fmin(1000.0 / wide, 800.0 / tall);
    const int across = (int)(wide * scale), up = (int)(tall * scale);
    const int width = across + LEFT + 40 < 760 ? 760 : across + LEFT + 40;
    struct picture p = picture_open(r, "force_chains.png", width, up + TOP + BOTTOM);
    FILE *const to = p.gnuplot;
    char *const scene = picture_scene(r);
    char *const head = xprintf("%s: force chains at the end, mean %.3g N", scene, c->mean);
    picture_text(to, "title", head, "font ',15' noenhanced");
    send_grains(to, c);
    fprintf(to, "$f << END\n");
    for (size_t k = count > MOST_LINES ? count - MOST_LINES : 0; k < count; k++)
        fprintf(to, "%.6g %.6g %.6g %.6g %.4g\n", 1e3 * line[k].x0, 1e3 * line[k].z0,
                1e3 * (line[k].x1 - line[k].x0), 1e3 * (line[k].z1 - line[k].z0),
                line[k].force / c->mean);
    fprintf(to, "END\n");
    /* at the mean force a third of a grain's width */
    fprintf(to,
            "set lmargin at screen %g\nset rmargin at screen %g\nset bmargin at screen %g\n"
            "set tmargin at screen %g\nset xlabel 'x, mm'\nset ylabel 'z, mm'\nunset key\n"
            "unset grid\nset border 15\nset xrange [%g:%g]\nset yrange [%g:%g]\n"
            "set palette defined (0 '#c9d6e2', 1 '#4288c4', 2 '#8c2d6b', 4 '#c8102e')\n"
            "set cbrange [0:4]\nset colorbox horizontal user origin screen %g,%g "
            "size screen %g,%g\nset cbtics 1 scale 0.4\n"
            "set label 3 'normal force / mean' at screen %g,%g left\n",
            (double)LEFT / p.width, (double)(LEFT + across) / p.width,
            (double)BOTTOM / p.height, (double)(BOTTOM + up) / p.height, 1e3 * c->low[0],
            1e3 * c->high[0], 1e3 * c->low[1], 1e3 * c->high[1], (double)LEFT / p.width,
            42.0 / p.height, 220.0 / p.width, 12.0 / p.height, (LEFT + 235.0) / p.width,
            48.0 / p.height);
    struct picture_walls walls = picture_walls_read(r, run_length(r, "time") - 1);
    if (walls.n > 0)
        picture_walls_send(to, "w", &walls, PICTURE_CUT * c->size[1]);
    fprintf(to, "plot $g using 1:2:3 with circles fs solid 0.12 noborder lc '#8899aa'");
    for (int w = 0; w < 6; w++) /* classes of width, the widest last */
        fprintf(
            to,
            ", $f using 1:2:(int(1.5*sqrt($5))==%d%s ? $3 : 1/0):4:5 with vectors nohead lw "
            "%g lc palette",
            w, w == 5 ? "||$5>11" : "", 0.8 + 1.5 * w);
    if (walls.n > 0)
        picture_walls_cut(to, "w");
    fprintf(to, "\n");
    picture_walls_free(&walls);
    picture_close(&p);
    xfree(scene);
    xfree(head);
    xfree(line);
}

void picture_chains(const struct run_file *r)
{
    struct chains c = {0};
    if (read_chains(r, &c)) {
        choose_view(&c);
        draw(r, &c);
    }
    void *const all[] = {c.row, c.radius, c.pos, c.grain, c.force, c.normal, c.point, c.branch};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        xfree(all[i]);
}
