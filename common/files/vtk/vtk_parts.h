// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of hsr-vtk.so, each in a file of its own. They are as in
// vtk_library.h.
#ifndef HSR_COMMON_VTK_PARTS_H
#define HSR_COMMON_VTK_PARTS_H

#include "common/files/vtk/vtk_library.h"
#include "common/lines/polygons.h"
#include "common/voxels/voxels.h"

namespace hsr {

enum hsr_status write_vtp(const struct hsr_drawing *drawing,
                          const struct hsr_drawing_facts *facts,
                          const char *path, struct hsr_error *err);
enum hsr_status write_polygons(const struct hsr_polygons *polygons,
                               const double *point, const char *path,
                               struct hsr_error *err);
enum hsr_status write_vti(const struct hsr_solid_voxels *voxels,
                          const char *path, struct hsr_error *err);
enum hsr_status open_volume(struct hsr_volume *volume,
                            const struct hsr_volume_file *file,
                            struct hsr_error *err) noexcept;

} // namespace hsr

#endif
