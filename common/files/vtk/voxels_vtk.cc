// SPDX-License-Identifier: GPL-3.0-or-later
// Voxels as .vti files, for ParaView and the like.
#include "common/files/vtk/vtk_parts.h"
#include "common/files/vtk/vtk_text.h"
#include "common/voxels/voxels.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLImageDataWriter.h>

namespace {

/* VTK only reads the array, which it does not own. */
void add_solids(vtkImageData *data, const hsr_solid_voxels &voxels) {
  vtkNew<vtkUnsignedIntArray> array;
  array->SetName("solid");
  array->SetArray(voxels.solid, data->GetNumberOfCells(), 1);
  data->GetCellData()->SetScalars(array);
}

/* The file's text; empty if VTK cannot make it. */
std::string text_of(const hsr_solid_voxels &voxels) {
  const hsr_voxel_grid &grid = voxels.grid;
  vtkNew<vtkImageData> data;
  data->SetDimensions(grid.n[0] + 1, grid.n[1] + 1, grid.n[2] + 1);
  data->SetOrigin(grid.lo[0], grid.lo[1], grid.lo[2]);
  data->SetSpacing(grid.size, grid.size, grid.size);
  add_solids(data, voxels);
  return hsr::vtk_text<vtkXMLImageDataWriter>(data.Get());
}

} // namespace

enum hsr_status hsr::write_vti(const struct hsr_solid_voxels *voxels,
                               const char *path, struct hsr_error *err) {
  return write_vtk_text(
      path, [&] { return text_of(*voxels); }, err);
}
