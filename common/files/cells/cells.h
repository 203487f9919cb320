/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons, lines, boxes and polyhedra with data, as files for other programs,
 * written through VTK: .vtp .vtu .ply .stl. The whole scene as .obj and .glb. */
#ifndef HSR_COMMON_CELLS_H
#define HSR_COMMON_CELLS_H

#include "common/scene/world.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What all cells of a file are. The points of a box are numbered by bits: bit 0
 * is set on the side of greater x, bit 1 of y, bit 2 of z. A polyhedron has the
 * number of its faces, then for each face the number of its points, and these.
 */
enum hsr_cell_kind {
  HSR_CELL_POLYGON,
  HSR_CELL_LINE,
  HSR_CELL_BOX,
  HSR_CELL_POLYHEDRON
};

/* A value for each cell. */
enum hsr_cell_type {
  HSR_CELL_NUMBERS, /* uint32_t */
  HSR_CELL_REALS,   /* double */
  HSR_CELL_COLOURS  /* 3 bytes, sRGB */
};
struct hsr_cell_data {
  const char *name;
  enum hsr_cell_type type;
  const void *value; /* one a cell, or 3 bytes */
};

/* Cell k is point[start[k]], ..., point[start[k+1] - 1]: numbers of points. All
 * borrowed. */
enum { HSR_MOST_CELL_DATA = 12 };
struct hsr_cells {
  enum hsr_cell_kind kind;
  uint32_t n_points, n;
  const double *xyz;             /* 3 * n_points, world units */
  const uint32_t *start, *point; /* start: n + 1 offsets */
  struct hsr_cell_data data[HSR_MOST_CELL_DATA];
  int n_data;
};

/* Whether a file of this name can hold such cells, by its suffix: .vtp polygons
 * and lines, .vtu all kinds; .ply and .stl polygons, as numbers of single
 * precision. .ply holds the first colours; .stl holds no data, and triangles
 * only. */
bool hsr_cells_fit(enum hsr_cell_kind kind, const char *path);

/* Whether it can hold their data as well. */
bool hsr_cells_keep_data(const char *path);

/* Writes cells. The file is whole, or is not there. HSR_E_INPUT: it cannot be
 * written, or this build has no VTK; HSR_E_NOMEM; HSR_E_INTERNAL: VTK failed.
 */
enum hsr_status hsr_cells_write(const struct hsr_cells *cells, const char *path,
                                struct hsr_error *err);

/* --- Scenes --------------------------------------------------------------- */

/* The linear colour, 0..1, of a face of an object. */
static inline const float *hsr_face_rgb(const struct hsr_object *object,
                                        uint32_t face) {
  return object->rgb ? object->rgb + 3 * (size_t)face : object->colour;
}

/* The distinct colours of faces, and which of them each face has. Freed by
 * hsr_colours_free, also after a failure. */
struct hsr_colours {
  float *rgb; /* 3 * n, ascending */
  uint32_t n;
  uint32_t *of; /* a face of the object */
};
/* HSR_E_NOMEM. */
enum hsr_status hsr_colours_of(struct hsr_colours *colours,
                               const struct hsr_object *objects,
                               uint32_t n_objects, struct hsr_error *err);
void hsr_colours_free(struct hsr_colours *colours);

/* Writes a world that is laid out as .obj, in full precision: polygons stay
 * polygons, each instance is an object, and each colour a material. These are
 * in a file beside it, whose suffix is .mtl. HSR_E_INPUT: a file cannot be
 * written; HSR_E_NOMEM. */
enum hsr_status hsr_world_write_obj(const struct hsr_world *world,
                                    const char *path, struct hsr_error *err);

/* Writes a finished scene as binary glTF 2.0. A mesh for each object, and a
 * node for each instance of it; a material for each colour; a camera for each
 * view. Faces are divided into triangles, which share no vertex. The attribute
 * _FACE of a vertex is the number of its face in the object, and a node's
 * `extras` tell the instance and the id of its first face. Coordinates are in
 * single precision. The matrices of nodes place them in the frame.
 * HSR_E_INPUT: the file cannot be written, or would be larger
 * than 4 GB; HSR_E_REFUSED: a face cannot be divided into triangles;
 * HSR_E_NOMEM. */
struct hsr_glb_frame {
  double metres; /* a unit of the scene; 1: coordinates stay as they are */
  bool z_up;     /* z becomes y, which is up in glTF, and y becomes -z */
};
enum hsr_status hsr_scene_write_glb(struct hsr_scene *scene,
                                    struct hsr_glb_frame frame,
                                    const char *path, struct hsr_error *err);

/* Divides the faces of a world that are no triangles, by the adapter of HSR_TR.
 * *changed is false if there are none; else *out is freed with hsr_world_free,
 * also after a failure.
 * HSR_E_NOMEM, HSR_E_REFUSED. */
enum hsr_status hsr_world_triangulate(const struct hsr_world *world,
                                      struct hsr_world *out, bool *changed,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
