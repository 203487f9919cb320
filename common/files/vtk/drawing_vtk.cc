// SPDX-License-Identifier: GPL-3.0-or-later
// Line drawings as .vtp files, for ParaView and the like.
#include "common/files/vtk/vtk_parts.h"
#include "common/files/vtk/vtk_text.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace {

vtkIdType n_cells(const hsr_drawing &drawing) {
  return static_cast<vtkIdType>(drawing.n);
}

/* Adds a number a cell, `get` of its interval. */
template <class Array, class Get>
void add_data(vtkPolyData *data, const char *name, const hsr_drawing &drawing,
              const Get &get) {
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(n_cells(drawing));
  for (size_t k = 0; k < drawing.n; k++)
    array->SetValue(static_cast<vtkIdType>(k), get(drawing.segment[k]));
  data->GetCellData()->AddArray(array);
}

void add_lines(vtkPolyData *data, const hsr_drawing &drawing) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(2 * n_cells(drawing));
  for (size_t k = 0; k < drawing.n; k++) {
    const vtkIdType ends[2] = {static_cast<vtkIdType>(2 * k),
                               static_cast<vtkIdType>(2 * k + 1)};
    points->SetPoint(ends[0], drawing.segment[k].from);
    points->SetPoint(ends[1], drawing.segment[k].to);
    lines->InsertNextCell(2, ends);
  }
  data->SetPoints(points);
  data->SetLines(lines);
}

/* What the numbers of an array mean. */
void add_names(vtkPolyData *data, const char *name, const char *const *names,
               size_t n) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (size_t k = 0; k < n; k++)
    array->InsertNextValue(names[k]);
  data->GetFieldData()->AddArray(array);
}

void add_facts(vtkPolyData *data, const hsr_drawing &drawing,
               const hsr_drawing_facts &facts) {
  const auto number = [&](const hsr_segment &s) {
    return &s - drawing.segment;
  };
  add_data<vtkUnsignedCharArray>(
      data, "class", drawing,
      [&](const hsr_segment &s) { return facts.line_class[number(s)]; });
  add_data<vtkUnsignedIntArray>(
      data, "object", drawing,
      [&](const hsr_segment &s) { return facts.object[number(s)]; });
  add_names(data, "class_names", facts.class_name, facts.n_classes);
  add_names(data, "object_names", facts.object_name, facts.n_objects);
}

/* The file's text; empty if VTK cannot make it. */
std::string text_of(const hsr_drawing &drawing,
                    const hsr_drawing_facts *facts) {
  vtkNew<vtkPolyData> data;
  add_lines(data, drawing);
  using Interval = const hsr_segment &;
  add_data<vtkUnsignedIntArray>(data, "invisibility", drawing,
                                [](Interval s) { return s.invisibility; });
  add_data<vtkUnsignedIntArray>(data, "edge_a", drawing,
                                [](Interval s) { return s.edge.a; });
  add_data<vtkUnsignedIntArray>(data, "edge_b", drawing,
                                [](Interval s) { return s.edge.b; });
  add_data<vtkUnsignedIntArray>(data, "edge_part", drawing,
                                [](Interval s) { return s.edge.part; });
  add_data<vtkUnsignedCharArray>(data, "implied", drawing,
                                 [](Interval s) { return s.edge.implied; });
  if (facts)
    add_facts(data, drawing, *facts);
  return hsr::vtk_text<vtkXMLPolyDataWriter>(data.Get());
}

} // namespace

enum hsr_status hsr::write_vtp(const struct hsr_drawing *drawing,
                               const struct hsr_drawing_facts *facts,
                               const char *path, struct hsr_error *err) {
  return write_vtk_text(
      path, [&] { return text_of(*drawing, facts); }, err);
}
