/* picture_speed.c - colours of speed, their scale below a picture, and ticks that have room. */
#include "picture_speed.h"

#include <math.h>
#include <string.h>

enum { SPEED_STOPS = 4, BAR = 260, BAR_HIGH = 14, LETTER = 9, APART = 12, MOST_TICKS = 10 };
enum { BESIDE = 25, ONE_LINE = 460 }; /* pixels to the label, and of it with its note */

static const struct {
    double at;
    const char *colour;
} speed_stop[SPEED_STOPS] = {
    {0.0, "#e2e9f0"}, {0.3, "#9cc3e0"}, {0.65, "#4288c4"}, {1.0, "#0c3a78"}};

void hex_colour(const char *hex, double out[3])
{
    unsigned int rgb[3] = {0};
    sscanf(hex, "#%2x%2x%2x", &rgb[0], &rgb[1], &rgb[2]);
    for (int a = 0; a < 3; a++)
        out[a] = rgb[a];
}

void speed_colour(double x, double out[3])
{
    double low[3], high[3];
    int k = 1;
    while (k < SPEED_STOPS - 1 && x > speed_stop[k].at)
        k++;
    const double from = speed_stop[k - 1].at,
                 part = (fmin(x, 1.0) - from) / (speed_stop[k].at - from);
    hex_colour(speed_stop[k - 1].colour, low);
    hex_colour(speed_stop[k].colour, high);
    for (int a = 0; a < 3; a++)
        out[a] = low[a] + part * (high[a] - low[a]);
}

double tick_step(double low, double high, int across)
{
    static const double next[] = {2.0, 2.5, 2.0}; /* 1, 2, 5, 10 */
    const double range = high - low;
    double step = pow(10.0, floor(log10(range / MOST_TICKS)));
    for (int k = 0;; k++) {
        char label[32];
        snprintf(label, sizeof label, "%g", step * floor(high / step));
        const double room = LETTER * (double)strlen(label) + APART;
        if (step * MOST_TICKS >= range && step / range * across >= room)
            return step;
        step *= next[k % 3];
    }
}

void speed_bar(const struct picture *p, int x, int y, double fastest, bool above)
{
    const bool one = p->width >= x + BAR + BESIDE + ONE_LINE;
    FILE *const to = p->gnuplot;
    fprintf(to, "set palette defined (");
    for (int k = 0; k < SPEED_STOPS; k++)
        fprintf(to, "%s%g '%s'", k ? ", " : "", speed_stop[k].at, speed_stop[k].colour);
    fprintf(to,
            ")\nset cbrange [0:%g]\nset format cb '%%g'\nset cbtics %g scale 0.4\n"
            "set colorbox horizontal user origin screen %g,%g size screen %g,%g\n"
            "set label 3 \"speed, mm/s%s\" at screen %g,%g left\n",
            1e3 * fastest, tick_step(0.0, 1e3 * fastest, BAR), (double)x / p->width,
            (double)y / p->height, (double)BAR / p->width, (double)BAR_HIGH / p->height,
            !above ? ""
            : one  ? " (the fastest 1 % lie above the scale)"
                   : "\\n(1 % are faster)",
            (double)(x + BAR + BESIDE) / p->width, (double)(y + BAR_HIGH / 2) / p->height);
}
