// SPDX-License-Identifier: GPL-3.0-or-later
// Reads volumes, and writes files, through hsr-vtk.so.
#include "common/files/library.h"
#include "common/files/vtk/vtk_library.h"

#include <cstdlib>

namespace {

const hsr_vtk_library *load(struct hsr_error *err) {
  return static_cast<const hsr_vtk_library *>(
      hsr_library_table("hsr-vtk.so", "hsr_vtk", err));
}

} // namespace

bool hsr_exchange_has_vtk(void) {
  return true;
}

enum hsr_status hsr_drawing_write_vtp(const struct hsr_drawing *drawing,
                                      const char *path, struct hsr_error *err) {
  const hsr_vtk_library *vtk = load(err);
  return vtk ? vtk->write_vtp(drawing, path, err) : HSR_E_INPUT;
}

enum hsr_status hsr_polygons_write_vtp(const struct hsr_polygons *polygons,
                                       const struct hsr_view *view,
                                       const char *path,
                                       struct hsr_error *err) {
  const hsr_vtk_library *vtk = load(err);
  if (!vtk)
    return HSR_E_INPUT;
  double *point = static_cast<double *>(
      std::malloc((3 * polygons->n_sides + 1) * sizeof *point));
  if (!point)
    return hsr_fail_nomem(err);
  hsr_polygon_points(polygons, view, point);
  const enum hsr_status status =
      vtk->write_polygons(polygons, point, path, err);
  std::free(point);
  return status;
}

enum hsr_status hsr_voxels_write_vti(const struct hsr_solid_voxels *voxels,
                                     const char *path, struct hsr_error *err) {
  const hsr_vtk_library *vtk = load(err);
  return vtk ? vtk->write_vti(voxels, path, err) : HSR_E_INPUT;
}

enum hsr_status hsr_volume_open_vtk(struct hsr_volume *volume,
                                    const struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  *volume = {};
  const hsr_vtk_library *vtk = load(err);
  return vtk ? vtk->open_volume(volume, file, err) : HSR_E_INPUT;
}
