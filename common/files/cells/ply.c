/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .ply files in full precision: VTK's writer rounds coordinates to floats.
 *
 * Source      G. Turk, "The PLY Polygon File Format", 1994 */
#include "common/files/cells/cells.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"
#include "common/scene/pieces.h"

#include <math.h>
#include <string.h>

/* The least significant byte first, on every machine. */
static void put_bytes(uint64_t bits, int n, FILE *out) {
  for (int k = 0; k < n; k++)
    fputc((int)(bits >> 8 * k & 255), out);
}

static void put_real(double x, FILE *out) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  put_bytes(bits, 8, out);
}

/* Many readers take no more than 255 corners; where there are more, a face says
 * so in four bytes. */
static void put_header(const struct hsr_world *world, bool wide, bool colour,
                       bool alpha, FILE *out) {
  fprintf(out,
          "ply\nformat binary_little_endian 1.0\n"
          "element vertex %u\n"
          "property double x\nproperty double y\nproperty double z\n"
          "element face %u\n"
          "property list %s int vertex_indices\n"
          "%s%s"
          "property uchar one_sided\n"
          "end_header\n",
          world->mesh.n_vertices, world->n_faces, wide ? "uint" : "uchar",
          colour ? "property uchar red\nproperty uchar green\n"
                   "property uchar blue\n"
                 : "",
          alpha ? "property uchar alpha\n" : "");
}

/* Of a piece, all is said of its parent. */
static void put_look(const struct hsr_world *world, uint32_t f, bool colour,
                     bool alpha, FILE *out) {
  const struct hsr_place place =
      hsr_place_of(world, hsr_world_parent(world, f));
  const float *rgb = hsr_face_rgb(place.object, place.face);
  for (int k = 0; k < 3 && colour; k++)
    fputc(hsr_srgb_byte(rgb[k]), out);
  if (alpha)
    fputc((int)lrintf(255 * hsr_face_opacity(place.object, place.face)), out);
  fputc(world->mesh.one_sided[f], out);
}

enum hsr_status hsr_world_write_ply(const struct hsr_world *world,
                                    const char *path, struct hsr_error *err) {
  const struct hsr_mesh *mesh = &world->mesh;
  const bool wide = hsr_most_corners(world) > 255;
  const bool alpha = hsr_scene_is_transparent(world->roster.scene);
  const bool colour = alpha || hsr_scene_has_colours(world->roster.scene);
  struct hsr_whole_file file;
  if (mesh->n_vertices > INT32_MAX)
    return hsr_fail(err, HSR_E_INPUT,
                    "%.200s: cannot be written: %u vertices are too many", path,
                    mesh->n_vertices);
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  put_header(world, wide, colour, alpha, file.stream);
  for (uint32_t v = 0; v < mesh->n_vertices; v++) {
    put_real(mesh->x[v], file.stream);
    put_real(mesh->y[v], file.stream);
    put_real(mesh->z[v], file.stream);
  }
  for (uint32_t f = 0; f < world->n_faces; f++) {
    put_bytes(hsr_face_size(world, f), wide ? 4 : 1, file.stream);
    for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++)
      put_bytes(mesh->vertex[k], 4, file.stream);
    put_look(world, f, colour, alpha, file.stream);
  }
  return hsr_whole_file_close(&file, HSR_OK, err);
}
