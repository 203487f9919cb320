// SPDX-License-Identifier: GPL-3.0-or-later
// Reads volumes, and writes files, through hsr-vtk.so.
#include "common/files/library.h"
#include "common/files/vtk/vtk_library.h"
#include "common/lines/polygons.h"
#include "common/voxels/voxels.h"

#include <cstdlib>

namespace {

enum hsr_status load(const hsr_vtk_library *&vtk, struct hsr_error *err) {
  const void *table;
  enum hsr_status status =
      hsr_library_table("hsr-vtk.so", "hsr_vtk", &table, err);
  vtk = static_cast<const hsr_vtk_library *>(table);
  return status;
}

} // namespace

bool hsr_exchange_has_vtk(void) {
  return true;
}

enum hsr_status hsr_drawing_write_vtp(const struct hsr_drawing *drawing,
                                      const struct hsr_drawing_facts *facts,
                                      const char *path, struct hsr_error *err) {
  const hsr_vtk_library *vtk;
  enum hsr_status status = load(vtk, err);
  return status ? status : vtk->write_vtp(drawing, facts, path, err);
}

enum hsr_status hsr_polygons_write_vtp(const struct hsr_polygons *polygons,
                                       const struct hsr_view *view,
                                       const char *path,
                                       struct hsr_error *err) {
  const hsr_vtk_library *vtk;
  enum hsr_status status = load(vtk, err);
  if (status)
    return status;
  double *point = static_cast<double *>(
      std::malloc((3 * polygons->n_sides + 1) * sizeof *point));
  if (!point)
    return hsr_fail_nomem(err);
  hsr_polygon_points(polygons, view, point);
  status = vtk->write_polygons(polygons, point, path, err);
  std::free(point);
  return status;
}

enum hsr_status hsr_voxels_write_vti(const struct hsr_solid_voxels *voxels,
                                     const char *path, struct hsr_error *err) {
  const hsr_vtk_library *vtk;
  enum hsr_status status = load(vtk, err);
  return status ? status : vtk->write_vti(voxels, path, err);
}

enum hsr_status hsr_volume_open_vtk(struct hsr_volume *volume,
                                    const struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  *volume = {};
  const hsr_vtk_library *vtk;
  enum hsr_status status = load(vtk, err);
  return status ? status : vtk->open_volume(volume, file, err);
}
