/* surface_file.h - the surfaces of grains that are no spheres, once per species: in run.nc, from which
 * pictures are drawn, and as STL files for ParaView, which puts one at every grain (representation 3D
 * Glyphs: glyph type from the STL, orientation by quaternion, scale by radius). */
#ifndef SURFACE_FILE_H
#define SURFACE_FILE_H

struct output_file;
struct sim;

/* surface_corner: three in a row are a triangle, in the body's frame, units of the bounding radius;
 * surface_species: of each corner. Nothing where the grains are spheres. */
void surface_file_define(const struct output_file *f, const struct sim *s);
void surface_file_write(const struct output_file *f, const struct sim *s);

/* DIR/surface_SPECIES.stl */
void surface_file_stl(const struct sim *s);

#endif
