// SPDX-License-Identifier: GPL-3.0-or-later
// In place of exchange_vtk.cc in a build without VTK.
#include "common/exchange.h"
#include "common/mesh_file.h"

bool hsr_exchange_has_vtk(void) {
  return false;
}

void hsr::vtp_read(Mesh_file &file, Mesh_builder &) {
  file.refuse(0, "this build of hsr, without VTK, does not read .vtp");
}
