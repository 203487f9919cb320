// SPDX-License-Identifier: GPL-3.0-or-later
// Voxels as .vti files, for ParaView and the like.
#include "common/exchange.h"
#include "common/voxel_solids.h"
#include "common/whole_file.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLImageDataWriter.h>

#include <new>
#include <string>

namespace {

/* VTK only reads the array, which it does not own. */
void add_solids(vtkImageData *data, const hsr_voxel_solids &voxels) {
  vtkNew<vtkUnsignedIntArray> array;
  array->SetName("solid");
  array->SetArray(voxels.solid, data->GetNumberOfCells(), 1);
  data->GetCellData()->SetScalars(array);
}

/* The file's text; empty if VTK cannot make it. */
std::string text_of(const hsr_voxel_solids &voxels) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  const hsr_voxel_grid &grid = voxels.grid;
  vtkNew<vtkImageData> data;
  data->SetDimensions(grid.n[0] + 1, grid.n[1] + 1, grid.n[2] + 1);
  data->SetOrigin(grid.lo[0], grid.lo[1], grid.lo[2]);
  data->SetSpacing(grid.size, grid.size, grid.size);
  add_solids(data, voxels);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  return writer->Write() && !writer->GetErrorCode() ? writer->GetOutputString()
                                                    : std::string();
}

enum hsr_status write(const hsr_voxel_solids &voxels, const char *path,
                      hsr_error *err) {
  const std::string text = text_of(voxels);
  if (text.empty())
    return hsr_fail(err, HSR_E_INTERNAL, "%s: VTK cannot make it", path);
  hsr_whole_file file;
  const enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  std::fwrite(text.data(), 1, text.size(), file.stream);
  return hsr_whole_file_close(&file, HSR_OK, err);
}

} // namespace

enum hsr_status hsr_voxels_write_vti(const struct hsr_voxel_solids *voxels,
                                     const char *path, struct hsr_error *err) {
  try {
    return write(*voxels, path, err);
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "VTK: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "VTK: failed");
  }
}
