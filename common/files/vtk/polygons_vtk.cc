// SPDX-License-Identifier: GPL-3.0-or-later
// Visible polygons as .vtp files, for ParaView and the like. VTK's polygons
// have no holes, so cycles are written as closed lines.
#include "common/files/vtk/vtk_parts.h"
#include "common/files/vtk/vtk_text.h"
#include "common/lines/polygons.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkXMLPolyDataWriter.h>

namespace {

struct Lines {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedIntArray> face, region;
  vtkNew<vtkUnsignedCharArray> hole;

  Lines() {
    points->SetDataTypeToDouble();
    face->SetName("face");
    region->SetName("region");
    hole->SetName("hole");
  }
};

void add_cycle(Lines &lines, const double *point,
               const hsr_polygon_cycle &cycle) {
  const vtkIdType first = lines.points->GetNumberOfPoints();
  const int n = static_cast<int>(cycle.n);
  lines.cells->InsertNextCell(n + 1);
  for (int k = 0; k < n; k++) {
    lines.points->InsertNextPoint(point + 3 * (cycle.first + size_t(k)));
    lines.cells->InsertCellPoint(first + k);
  }
  lines.cells->InsertCellPoint(first);
}

/* The file's text; empty if VTK cannot make it. */
std::string text_of(const hsr_polygons &polygons, const double *point) {
  Lines lines;
  for (size_t r = 0; r < polygons.n_regions; r++) {
    const hsr_polygon_region &region = polygons.region[r];
    for (size_t c = 0; c < region.n; c++) {
      add_cycle(lines, point, polygons.cycle[region.first + c]);
      lines.face->InsertNextValue(region.face);
      lines.region->InsertNextValue(static_cast<unsigned>(r));
      lines.hole->InsertNextValue(c > 0);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(lines.points);
  data->SetLines(lines.cells);
  data->GetCellData()->AddArray(lines.face);
  data->GetCellData()->AddArray(lines.region);
  data->GetCellData()->AddArray(lines.hole);
  return hsr::vtk_text<vtkXMLPolyDataWriter>(data.Get());
}

} // namespace

enum hsr_status hsr::write_polygons(const struct hsr_polygons *polygons,
                                    const double *point, const char *path,
                                    struct hsr_error *err) {
  return write_vtk_text(
      path, [&] { return text_of(*polygons, point); }, err);
}
