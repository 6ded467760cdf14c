/* labels.h - places for the labels of points in a picture with two logarithmic axes, so that they
 * cover neither each other nor the points. */
#ifndef LABELS_H
#define LABELS_H

struct labels {
    double low[2], high[2]; /* ranges of the axes */
    int pixels[2];          /* of the picture */
    double frame[4];        /* left, right, bottom, top of the axes, in parts of the picture */
    double (*taken)[4];     /* boxes in pixels: left, right, bottom, top; owned */
    int n, room;
};

/* What a label must not cover: a point with this radius in pixels. */
void labels_point(struct labels *l, double x, double y, double radius);
/* Likewise: a bar from x0 to x1. */
void labels_bar(struct labels *l, double x0, double x1, double y);
/* Where a text of so many pixels is put, as near to its point as there is room: left and middle of
 * it, from the point, in parts of the picture (gnuplot: offset screen). The place is then taken. */
void labels_place(struct labels *l, double x, double y, double width, double height,
                  double offset[2]);
void labels_free(struct labels *l);

#endif
