// SPDX-License-Identifier: GPL-3.0-or-later
// Cells through VTK's writers: all of hsr-cells.so.
#include "common/files/cells/cells_library.h"
#include "common/files/suffix.h"
#include "common/files/vtk/vtk_text.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstdio>
#include <cstring>
#include <fstream>
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

/* The first colours of the cells, for a .ply file. */
void set_colours(vtkPLYWriter *writer, vtkPolyData *set,
                 const hsr_cells &cells) {
  for (int k = 0; k < cells.n_data; k++)
    if (cells.data[k].type == HSR_CELL_COLOURS) {
      writer->SetArrayName(cells.data[k].name);
      set->GetCellData()->SetActiveScalars(cells.data[k].name);
      return;
    }
}

void begin(vtkPLYWriter *writer, vtkPolyData *set, const hsr_cells &cells) {
  writer->SetDataByteOrderToLittleEndian();
  writer->SetColorModeToDefault();
  set_colours(writer, set, cells);
}

void begin(vtkSTLWriter *writer, vtkPolyData *, const hsr_cells &) {
  writer->SetHeader("hsr");
}

/* vtkPLYWriter says nothing where the disk is full. So the size must be that of
 * the header and of what it announces: points of three floats; polygons of a
 * byte, four bytes a point and, with a colour, three more. */
bool is_all_there(vtkPLYWriter *, vtkPolyData *set, const std::string &name) {
  std::ifstream file(name, std::ios::binary);
  std::string line;
  bool has_colours = false;
  while (std::getline(file, line) && line != "end_header")
    has_colours |= line == "property uchar red";
  const std::streamoff header = file.tellg();
  const vtkIdType polygons = set->GetNumberOfPolys();
  const vtkIdType records = 12 * set->GetNumberOfPoints() +
                            (has_colours ? 4 : 1) * polygons +
                            4 * set->GetPolys()->GetNumberOfConnectivityIds();
  file.seekg(0, std::ios::end);
  return file && file.tellg() - header == records;
}

/* vtkSTLWriter checks what it writes. */
bool is_all_there(vtkSTLWriter *, vtkPolyData *, const std::string &) {
  return true;
}

/* VTK writes these by a file's name only: that of the part of the whole
 * file. */
template <class Writer>
enum hsr_status write_by_name(const hsr_cells &cells, const char *path,
                              struct hsr_error *err) {
  hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  try {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    vtkNew<vtkPolyData> set;
    fill(set.Get(), cells);
    vtkNew<Writer> writer;
    begin(writer.Get(), set.Get(), cells);
    writer->SetInputData(set);
    writer->SetFileTypeToBinary();
    /* VTK adds the suffix .ply to a name without it. */
    const std::string name = std::string(file.part) + ".ply";
    writer->SetFileName(name.c_str());
    if (!writer->Write() || writer->GetErrorCode() ||
        !is_all_there(writer.Get(), set.Get(), name) ||
        std::rename(name.c_str(), file.part))
      status = hsr_fail(err, HSR_E_INPUT, "%s: cannot be written", path);
    if (status)
      std::remove(name.c_str());
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
    return write_by_name<vtkSTLWriter>(*cells, path, err);
  if (hsr_ends_in(path, ".ply"))
    return write_by_name<vtkPLYWriter>(*cells, path, err);
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
