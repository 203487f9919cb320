// SPDX-License-Identifier: GPL-3.0-or-later
// In place of common/files/vtk/vtk.cc in a build without VTK.
#include "common/files/mesh/exchange.h"
#include "common/files/mesh/mesh_file.h"
#include "common/files/volume/volume_data.h"
#include "common/lines/polygons.h"
#include "common/voxels/voxels.h"

bool hsr_exchange_has_vtk(void) {
  return false;
}

enum hsr_status hsr_drawing_write_vtp(const struct hsr_drawing *,
                                      const struct hsr_drawing_facts *,
                                      const char *path, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT,
                  "%s: this build of hsr, without VTK, does not write .vtp",
                  path);
}

enum hsr_status hsr_polygons_write_vtp(const struct hsr_polygons *,
                                       const struct hsr_view *,
                                       const char *path,
                                       struct hsr_error *err) {
  return hsr_drawing_write_vtp(nullptr, nullptr, path, err);
}

enum hsr_status hsr_voxels_write_vti(const struct hsr_solid_voxels *,
                                     const char *path, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT,
                  "%s: this build of hsr, without VTK, does not write .vti",
                  path);
}

void hsr::vtp_read(Mesh_file &file, Mesh_builder &) {
  file.refuse(0, "this build of hsr, without VTK, does not read .vtp");
}

enum hsr_status hsr_volume_scan_xml(struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT,
                  "%.200s: this build of hsr, without VTK, does not read it",
                  file->path);
}

enum hsr_status hsr_volume_open_vtk(struct hsr_volume *volume,
                                    const struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  *volume = {};
  return hsr_fail(err, HSR_E_INPUT,
                  "%.200s: this build of hsr, without VTK, does not read it",
                  file->path);
}
