// SPDX-License-Identifier: GPL-3.0-or-later
// Cells through VTK's writers: all of hsr-cells.so.
#include "common/files/cells/cells_library.h"
#include "common/files/suffix.h"
#include "common/files/vtk/vtk_text.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstring>
#include <string>
#include <vector>

namespace {

template <class Array>
void add_array(vtkDataSet *set, const hsr_cell_data &data, uint32_t n,
               int components) {
  vtkNew<Array> array;
  array->SetName(data.name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(n));
  std::memcpy(array->GetVoidPointer(0), data.value,
              size_t{n} * static_cast<size_t>(components) *
                  sizeof(*array->GetPointer(0)));
  set->GetCellData()->AddArray(array);
}

void add_data(vtkDataSet *set, const hsr_cells &cells) {
  for (int k = 0; k < cells.n_data; k++) {
    const hsr_cell_data &data = cells.data[k];
    if (data.type == HSR_CELL_NUMBERS)
      add_array<vtkUnsignedIntArray>(set, data, cells.n, 1);
    else if (data.type == HSR_CELL_REALS)
      add_array<vtkDoubleArray>(set, data, cells.n, 1);
    else if (data.type == HSR_CELL_RGB)
      add_array<vtkFloatArray>(set, data, cells.n, 3);
    else
      add_array<vtkUnsignedCharArray>(set, data, cells.n, 3);
  }
}

void add_points(vtkPointSet *set, const hsr_cells &cells) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(cells.n_points));
  for (uint32_t v = 0; v < cells.n_points; v++)
    points->SetPoint(static_cast<vtkIdType>(v), cells.xyz + 3 * size_t{v});
  set->SetPoints(points);
}

/* The numbers of cell k, as VTK has them. */
void take(const hsr_cells &cells, uint32_t k, std::vector<vtkIdType> &ids) {
  ids.assign(cells.point + cells.start[k], cells.point + cells.start[k + 1]);
}

void fill(vtkPolyData *set, const hsr_cells &cells) {
  vtkNew<vtkCellArray> array;
  std::vector<vtkIdType> ids;
  for (uint32_t k = 0; k < cells.n; k++) {
    take(cells, k, ids);
    array->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  }
  add_points(set, cells);
  if (cells.kind == HSR_CELL_LINE)
    set->SetLines(array);
  else
    set->SetPolys(array);
  add_data(set, cells);
}

/* A polyhedron's ids start with the number of its faces. */
void fill(vtkUnstructuredGrid *set, const hsr_cells &cells) {
  static const int type[] = {VTK_POLYGON, VTK_LINE, VTK_VOXEL, VTK_POLYHEDRON};
  std::vector<vtkIdType> ids;
  add_points(set, cells);
  set->Allocate(static_cast<vtkIdType>(cells.n));
  for (uint32_t k = 0; k < cells.n; k++) {
    take(cells, k, ids);
    if (cells.kind == HSR_CELL_POLYHEDRON)
      set->InsertNextCell(VTK_POLYHEDRON, ids[0], ids.data() + 1);
    else
      set->InsertNextCell(type[cells.kind], static_cast<vtkIdType>(ids.size()),
                          ids.data());
  }
  add_data(set, cells);
}

template <class Writer, class Set> std::string xml(const hsr_cells &cells) {
  vtkNew<Set> set;
  fill(set.Get(), cells);
  return hsr::vtk_text<Writer>(set.Get());
}

/* VTK writes it by a file's name only: that of the part of the whole file. It
 * checks what it writes. */
enum hsr_status write_stl(const hsr_cells &cells, const char *path,
                          struct hsr_error *err) {
  hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  try {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkNew<vtkPolyData> set;
    fill(set.Get(), cells);
    vtkNew<vtkSTLWriter> writer;
    writer->SetHeader("hsr");
    writer->SetInputData(set);
    writer->SetFileTypeToBinary();
    writer->SetFileName(file.part);
    if (!writer->Write() || writer->GetErrorCode())
      status = hsr_fail(err, HSR_E_INPUT, "%s: cannot be written", path);
  } catch (const std::bad_alloc &) {
    status = hsr_fail_nomem(err);
  } catch (...) {
    status = hsr_fail(err, HSR_E_INTERNAL, "VTK: failed");
  }
  return hsr_whole_file_close(&file, status, err);
}

enum hsr_status write(const struct hsr_cells *cells, const char *path,
                      struct hsr_error *err) {
  if (hsr_ends_in(path, ".stl"))
    return write_stl(*cells, path, err);
  return hsr::write_vtk_text(
      path,
      [&] {
        return hsr_ends_in(path, ".vtp")
                   ? xml<vtkXMLPolyDataWriter, vtkPolyData>(*cells)
                   : xml<vtkXMLUnstructuredGridWriter, vtkUnstructuredGrid>(
                         *cells);
      },
      err);
}

} // namespace

extern "C" {
extern const struct hsr_cells_library hsr_cells;
const struct hsr_cells_library hsr_cells = {write};
}
