// SPDX-License-Identifier: GPL-3.0-or-later
// The fuzz targets hold the code of hsr-vtk.so, so that it is sanitized too.
// They read no pictures, and write no polygons.
#include "common/files/image.h"
#include "common/files/library.h"
#include "common/files/vtk/vtk_library.h"
#include "common/lines/polygons.h"

#include <cstdlib>

extern "C" const struct hsr_vtk_library hsr_vtk;

enum hsr_status hsr_library_table(const char *, const char *,
                                  const void **table, struct hsr_error *) {
  *table = &hsr_vtk;
  return HSR_OK;
}

enum hsr_status hsr_image_read(const char *, bool, uint32_t[2], float **value,
                               struct hsr_error *err) {
  *value = nullptr;
  return hsr_fail(err, HSR_E_INPUT, "no pictures here");
}

void hsr_polygon_points(const struct hsr_polygons *, const struct hsr_view *,
                        double *) {
  std::abort();
}
