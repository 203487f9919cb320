/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing files for other programs: cells (polygons, lines, boxes or polyhedra)
 * with data through VTK, as .vtp .vtu .stl; and whole scenes as .obj, .ply and
 * .glb. */
#ifndef HSR_COMMON_CELLS_H
#define HSR_COMMON_CELLS_H

#include "common/scene/world.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The kind of all cells of a file, and how the point numbers of a cell are
 * listed. Polygon, line: in order. Box: eight points, point k with bit 0 of k
 * set on the side of greater x, bit 1 of greater y, bit 2 of greater z.
 * Polyhedron: the number of its faces; then for each face the number of its
 * points, and the points. */
enum hsr_cell_kind {
  HSR_CELL_POLYGON,
  HSR_CELL_LINE,
  HSR_CELL_BOX,
  HSR_CELL_POLYHEDRON
};

/* Data with one value for each cell. */
enum hsr_cell_type {
  HSR_CELL_NUMBERS, /* a value is a uint32_t */
  HSR_CELL_REALS,   /* a double */
  HSR_CELL_COLOURS, /* 3 bytes, sRGB-encoded */
  HSR_CELL_RGB      /* 3 floats, linear */
};
struct hsr_cell_data {
  const char *name;
  enum hsr_cell_type type;
  const void *value; /* n values; borrowed */
};

/* Cells with their data. Cell k is listed in point[start[k]], ...,
 * point[start[k+1] - 1]. All borrowed. */
enum { HSR_MOST_CELL_DATA = 12 };
struct hsr_cells {
  enum hsr_cell_kind kind;
  uint32_t n_points, n;          /* points, and cells */
  const double *xyz;             /* 3 * n_points, world units */
  const uint32_t *start, *point; /* start: n + 1 offsets */
  struct hsr_cell_data data[HSR_MOST_CELL_DATA];
  int n_data;
};

/* Whether a file of this name can hold cells of this kind, by its suffix. .vtu
 * holds all kinds, .vtp polygons and lines, .stl triangles in single precision,
 * without data. */
bool hsr_cells_fit(enum hsr_cell_kind kind, const char *path);

/* Whether a file of this name keeps all data of cells, as .vtp and .vtu do. */
bool hsr_cells_keep_data(const char *path);

/* Writes cells in the format of the suffix. The file is written completely or
 * not at all. HSR_E_INPUT if it cannot be written or this build has no VTK;
 * HSR_E_NOMEM; HSR_E_INTERNAL if VTK fails. */
enum hsr_status hsr_cells_write(const struct hsr_cells *cells, const char *path,
                                struct hsr_error *err);

/* --- Scenes --------------------------------------------------------------- */

/* The distinct colours of the faces of some objects, with their opacities. */
struct hsr_colours {
  float *rgba; /* 4 * n, linear, 0..1, ascending */
  uint32_t n;
  uint32_t *of; /* by face, object by object: the index of its colour */
};

/* Whether a face has another colour than that which nothing has given it. */
bool hsr_scene_has_colours(const struct hsr_scene *scene);

/* Finds the colours of the faces of n_objects objects. *colours is written in
 * full, and is freed with hsr_colours_free also after a failure.
 * HSR_E_NOMEM. */
enum hsr_status hsr_colours_of(struct hsr_colours *colours,
                               const struct hsr_object *objects,
                               uint32_t n_objects, struct hsr_error *err);
void hsr_colours_free(struct hsr_colours *colours);

/* Writes a world that is laid out as .obj, in full precision. Polygons stay
 * polygons, each instance is an object, and each colour is a material. The
 * materials are in a file with the same name and the suffix .mtl. HSR_E_INPUT
 * if a file cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_world_write_obj(const struct hsr_world *world,
                                    const char *path, struct hsr_error *err);

/* Writes a world that is laid out as binary .ply, with coordinates in full
 * precision: polygons in the order of their ids, and of each whether it is
 * one-sided; its colour, if the scene has colours, or opacities below 1; and its
 * opacity, if one is below 1. Colours and opacities are rounded to bytes.
 * HSR_E_INPUT if the file cannot be written, or there are more than 2^31 - 1
 * vertices. */
enum hsr_status hsr_world_write_ply(const struct hsr_world *world,
                                    const char *path, struct hsr_error *err);

/* The frame of a glTF file, whose unit is the metre and whose y axis is up. */
struct hsr_glb_frame {
  double metres; /* the length of the scene's unit, in metres */
  bool z_up;     /* z is up in the scene: it becomes y, and y becomes -z */
  bool plain;    /* coordinates are rounded as they are, without an offset */
};

/* Writes a finished scene as binary glTF 2.0, with a mesh for each object, a
 * node for each instance, a material for each colour and opacity, and a camera
 * for each view. Faces are divided into triangles. Coordinates are floats: those
 * of an object far from its origin are written from a point nearby, and the
 * matrices of its nodes have that offset. So they are exact to a float of the
 * object's size. *change becomes the most by which a coordinate in the world
 * may differ; it may be NULL. The matrices of nodes also bring all into the
 * frame.
 *
 * The attribute _FACE of a vertex is the number of its face in the object, whose
 * corners follow one another. `extras` of a node have its instance and the id of
 * its first face. Those of the file have the frame, the offsets of meshes, the
 * matrices of instances and the views. By these, hsr reads the same scene again.
 * HSR_E_INPUT if the file cannot be written or would be larger than
 * 4 GB; HSR_E_REFUSED if a face cannot be divided into triangles; HSR_E_NOMEM. */
enum hsr_status hsr_scene_write_glb(struct hsr_scene *scene,
                                    struct hsr_glb_frame frame,
                                    const char *path, double *change,
                                    struct hsr_error *err);

/* Divides the faces of a world that are not triangles, by the adapter of
 * HSR_TR. If there are none, *changed is false and *out is empty. *out is freed
 * with hsr_world_free, also after a failure.
 * HSR_E_NOMEM; HSR_E_REFUSED if a face cannot be divided. */
enum hsr_status hsr_world_triangulate(const struct hsr_world *world,
                                      struct hsr_world *out, bool *changed,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
