// SPDX-License-Identifier: GPL-3.0-or-later
// The table of hsr-vtk.so.
#include "common/files/vtk/vtk_parts.h"

extern "C" {
extern const struct hsr_vtk_library hsr_vtk;
const struct hsr_vtk_library hsr_vtk = {hsr::write_vtp, hsr::write_polygons,
                                        hsr::write_vti, hsr::open_volume};
}
