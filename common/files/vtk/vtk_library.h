/* SPDX-License-Identifier: GPL-3.0-or-later */
// What hsr-vtk.so offers; only for common/files/vtk.
#ifndef HSR_COMMON_VTK_LIBRARY_H
#define HSR_COMMON_VTK_LIBRARY_H

#include "common/files/mesh/exchange.h"
#include "common/files/volume/volume_data.h"
#include "common/voxels/voxels.h"

#include <cstddef>

namespace hsr {

struct Mesh_extent;

/* Takes what VTK reads. Its functions may throw. */
class Vtk_sink {
public:
  virtual ~Vtk_sink() = default;
  virtual void vertex(const double xyz[3]) = 0;
  /* rgb: sRGB, 3 bytes; or NULL */
  virtual void face(const uint32_t *vertices, size_t n,
                    const unsigned char *rgb) = 0;
  [[noreturn]] virtual void refuse(const char *why) = 0;
};

} // namespace hsr

/* read_vtp gives the mesh of a .vtp file in memory, which passed scan_vtp, to
 * the sink; it throws std::bad_alloc and what the sink throws. The others are
 * as in exchange.h and volume_data.h. */
struct hsr_vtk_library {
  void (*read_vtp)(char *begin, char *end, const hsr::Mesh_extent &extent,
                   hsr::Vtk_sink &sink);
  enum hsr_status (*write_vtp)(const struct hsr_drawing *drawing,
                               const char *path, struct hsr_error *err);
  /* point: three coordinates a side, where it begins */
  enum hsr_status (*write_polygons)(const struct hsr_polygons *polygons,
                                    const double *point, const char *path,
                                    struct hsr_error *err);
  enum hsr_status (*write_vti)(const struct hsr_solid_voxels *voxels,
                               const char *path, struct hsr_error *err);
  enum hsr_status (*open_volume)(struct hsr_volume *volume,
                                 const struct hsr_volume_file *file,
                                 struct hsr_error *err);
};

#endif
