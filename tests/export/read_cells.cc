// SPDX-License-Identifier: GPL-3.0-or-later
// read_cells FILE: what VTK reads from a file, a line for each cell: its colour,
// if there is one; the other data of cells; and its points. A polyhedron has its
// volume instead of points.
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

namespace {

template <class Reader> vtkSmartPointer<vtkPointSet> read(const char *path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path);
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> read_any(const std::string &path) {
  const std::string suffix = path.substr(path.rfind('.') + 1);
  return suffix == "vtp"   ? read<vtkXMLPolyDataReader>(path.c_str())
         : suffix == "vtu" ? read<vtkXMLUnstructuredGridReader>(path.c_str())
         : suffix == "ply" ? read<vtkPLYReader>(path.c_str())
         : suffix == "obj" ? read<vtkOBJReader>(path.c_str())
                           : read<vtkSTLReader>(path.c_str());
}

/* Six times the volume of the tetrahedra from point o to a face's triangles. */
double volume(vtkCell *face, const double o[3]) {
  double sum = 0, p[3][3];
  for (vtkIdType k = 2; k < face->GetNumberOfPoints(); k++) {
    face->GetPoints()->GetPoint(0, p[0]);
    face->GetPoints()->GetPoint(k - 1, p[1]);
    face->GetPoints()->GetPoint(k, p[2]);
    for (auto &corner : p)
      for (int c = 0; c < 3; c++)
        corner[c] -= o[c];
    for (int c = 0; c < 3; c++) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      sum += p[0][c] * (p[1][d] * p[2][e] - p[1][e] * p[2][d]);
    }
  }
  return sum;
}

void print_data(vtkDataArray *array, vtkIdType cell) {
  std::printf("%s", array->GetName() ? array->GetName() : "?");
  for (int c = 0; c < array->GetNumberOfComponents(); c++)
    std::printf(" %.9g", array->GetComponent(cell, c));
  std::printf("; ");
}

void print_cell(vtkPointSet *set, vtkIdType k) {
  for (int a = 0; a < set->GetCellData()->GetNumberOfArrays(); a++)
    if (vtkDataArray *array = set->GetCellData()->GetArray(a))
      print_data(array, k);
  vtkCell *cell = set->GetCell(k);
  double p[3], sum = 0;
  if (cell->GetCellType() == VTK_POLYHEDRON) {
    cell->GetPoints()->GetPoint(0, p);
    for (int f = 0; f < cell->GetNumberOfFaces(); f++)
      sum += volume(cell->GetFace(f), p);
    std::printf("volume %.17g\n", std::fabs(sum) / 6);
    return;
  }
  for (vtkIdType v = 0; v < cell->GetNumberOfPoints(); v++) {
    cell->GetPoints()->GetPoint(v, p);
    for (double x : p)
      std::printf(" %.6g", x + 0.0 == 0 ? 0.0 : x);
  }
  std::printf("\n");
}

} // namespace

int main(int argc, char **argv) {
  if (argc != 2)
    return 2;
  const vtkSmartPointer<vtkPointSet> set = read_any(argv[1]);
  for (vtkIdType k = 0; k < set->GetNumberOfCells(); k++)
    print_cell(set, k);
  return set->GetNumberOfCells() ? 0 : 1;
}
