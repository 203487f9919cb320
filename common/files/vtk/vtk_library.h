/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of hsr-vtk.so; only for common/files/vtk. */
#ifndef HSR_COMMON_VTK_LIBRARY_H
#define HSR_COMMON_VTK_LIBRARY_H

#include "common/files/mesh/exchange.h"
#include "common/files/volume/volume_data.h"
#include "common/lines/polygons.h"
#include "common/voxels/voxels.h"

/* As the functions of exchange.h and volume_data.h. */
struct hsr_vtk_library {
  enum hsr_status (*write_vtp)(const struct hsr_drawing *drawing,
                               const struct hsr_drawing_facts *facts,
                               const char *path, struct hsr_error *err);
  /* point: where each side begins, as of hsr_polygon_points */
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
