// SPDX-License-Identifier: GPL-3.0-or-later
// .vtp and .vti files: line drawings and voxels are written as VTK reads them.
// A mesh that VTK's own writer wrote, in any encoding, is read as that mesh.
// Hostile files are in tests/bad.
#include "common/files/mesh/exchange.h"
#include "common/voxels/voxels.h"
#include "tests/tap.h"
#include "tests/unit/files/folder.h"
#include "tests/unit/files/vtk_ways.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/* The one object of a text, or NULL. The scene is the caller's. */
const struct hsr_object *read(struct hsr_scene *scene,
                              const std::string &text) {
  const std::string path = file("mesh.vtp", text);
  struct hsr_error err = {HSR_OK, ""};
  if (!hsr_mesh_read(scene, path.c_str(), nullptr, &err))
    return &scene->objects[0];
  std::printf("# %s\n", err.text);
  return nullptr;
}

/* ---- Files written by VTK ---- */

/* A wavy sheet of N x N squares: its first half as squares, its second half as
 * strips; and arrays of all kinds, which must not be read. */
constexpr int N = 40;

struct Way : Encoding {
  bool doubles, long_ids;
};

double height(int i, int j) {
  return 0.1 * ((i * 7 + j * 13) % 11);
}

void make_sheet(vtkPolyData *sheet, const Way &way) {
  vtkNew<vtkPoints> points;
  points->SetDataType(way.doubles ? VTK_DOUBLE : VTK_FLOAT);
  for (int i = 0; i <= N; i++)
    for (int j = 0; j <= N; j++)
      points->InsertNextPoint(0.1 * i, 0.1 * j, height(i, j));
  vtkNew<vtkCellArray> polys, strips;
  for (vtkCellArray *cells : {polys.Get(), strips.Get()})
    if (way.long_ids)
      cells->Use64BitStorage();
    else
      cells->Use32BitStorage();
  const auto id = [](int i, int j) { return vtkIdType{i * (N + 1) + j}; };
  for (int i = 0; i < N; i++) {
    if (i >= N / 2)
      strips->InsertNextCell(2 * (N + 1));
    for (int j = 0; j <= N; j++) {
      const vtkIdType square[4] = {id(i, j), id(i + 1, j), id(i + 1, j + 1),
                                   id(i, j + 1)};
      if (i >= N / 2) {
        strips->InsertCellPoint(square[0]);
        strips->InsertCellPoint(square[1]);
      } else if (j < N) {
        polys->InsertNextCell(4, square);
      }
    }
  }
  sheet->SetPoints(points);
  sheet->SetPolys(polys);
  sheet->SetStrips(strips);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("a > b");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points->GetNumberOfPoints());
  normals->Fill(1);
  sheet->GetPointData()->SetNormals(normals);
  vtkNew<vtkDoubleArray> area;
  area->SetName("area");
  area->SetNumberOfTuples(sheet->GetNumberOfCells());
  area->Fill(2);
  sheet->GetCellData()->AddArray(area);
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  words->InsertNextValue("<AppendedData encoding=\"raw\">_");
  sheet->GetFieldData()->AddArray(words);
}

std::string write(vtkPolyData *data, const Way &way) {
  return write_by_vtk<vtkXMLPolyDataWriter>(data, way, 4096);
}

bool is_sheet(const struct hsr_object *object, bool doubles) {
  if (!object || object->n_vertices != (N + 1) * (N + 1) ||
      object->n_faces != N / 2 * N + N / 2 * 2 * N)
    return false;
  for (int i = 0; i <= N; i++)
    for (int j = 0; j <= N; j++) {
      const double p[3] = {0.1 * i, 0.1 * j, height(i, j)};
      for (int k = 0; k < 3; k++)
        if (object->xyz[3 * (i * (N + 1) + j) + k] !=
            (doubles ? p[k] : static_cast<double>(static_cast<float>(p[k]))))
          return false;
    }
  const uint32_t n_squares = N / 2 * N;
  for (uint32_t f = 0; f < object->n_faces; f++) {
    const bool square = f < n_squares;
    const uint32_t t = (f - n_squares) % (2 * N); /* triangle in its strip */
    const uint32_t i =
        square ? f / N : N / 2 + (f - n_squares) / (2 * N) + t % 2;
    const uint32_t j = square ? f % N : t / 2;
    if (object->start[f + 1] - object->start[f] != (square ? 4 : 3) ||
        object->vertex[object->start[f]] != i * (N + 1) + j)
      return false;
  }
  return true;
}

void try_ways(tap *t) {
  for (int mode = 0; mode < 4; mode++)
    for (int compressed = 0; compressed < 2; compressed++) {
      int n_good = 0;
      for (int bits = 0; bits < 16; bits++) {
        const Way way = {{static_cast<Way::Mode>(mode), compressed == 1,
                          (bits & 4) != 0, (bits & 8) != 0},
                         (bits & 1) != 0,
                         (bits & 2) != 0};
        vtkNew<vtkPolyData> sheet;
        make_sheet(sheet, way);
        struct hsr_scene *scene = hsr_scene_new("");
        n_good += is_sheet(read(scene, write(sheet, way)), way.doubles);
        hsr_scene_delete(scene);
      }
      ok(t, n_good == 16,
         "%s%s: Float32 and 64, Int32 and 64, UInt32 and 64, either end first",
         mode_names[mode], compressed ? ", compressed" : "");
    }
}

/* VTK reads the tags 4096 bytes at a time. Here the tag of the appended data
 * lies at every place around such a border. */
void try_borders(tap *t) {
  const Way way = {{Way::RAW, true, false, false}, true, true};
  vtkNew<vtkPolyData> sheet;
  make_sheet(sheet, way);
  const std::string text = write(sheet, way);
  const size_t place = text.find("  <PolyData>");
  int n_good = 0;
  for (size_t k = 0; k < 64; k++) {
    std::string moved = text;
    const size_t at =
        text.rfind("<AppendedData") - text.find("<VTKFile") + 48 - k;
    moved.insert(place, 8192 - at % 4096, ' ');
    struct hsr_scene *scene = hsr_scene_new("");
    n_good += is_sheet(read(scene, moved), true);
    hsr_scene_delete(scene);
  }
  ok(t, n_good == 64, "appended data about the end of a buffer of VTK's");
}

/* ---- Pieces ---- */

std::string array(const char *attributes, const std::string &values) {
  return std::string("<DataArray format='ascii' ") + attributes + ">" + values +
         "</DataArray>";
}

/* A triangle, as a polygon or as a strip. */
std::string piece(const char *kind, double z) {
  const std::string at = " " + std::to_string(z) + " ";
  return std::string("<Piece NumberOfPoints='3' NumberOf") + kind +
         "='1'><Points>" +
         array("type='Float32' NumberOfComponents='3'",
               "0 0" + at + "1 0" + at + "1 1" + at) +
         "</Points><" + kind + ">" +
         array("type='Int32' Name='connectivity'", "0 1 2") +
         array("type='Int64' Name='offsets'", "3") + "</" + kind + "></Piece>";
}

std::string file(const std::string &pieces) {
  return "<VTKFile type='PolyData'><PolyData>" + pieces +
         "</PolyData></VTKFile>";
}

/* VTK 9.1 itself wrongly gives the polygon the strip's points. */
void try_pieces(tap *t) {
  const std::string empty = "<Piece NumberOfPoints='0'><Points/></Piece>";
  struct hsr_scene *scene = hsr_scene_new("");
  const struct hsr_object *o =
      read(scene, file(empty + piece("Strips", 1) + empty + piece("Polys", 2)));
  bool good = o && o->n_vertices == 6 && o->n_faces == 2;
  for (uint32_t k = 0; good && k < 6; k++)
    good = o->vertex[k] == k && o->xyz[3 * k + 2] == (k < 3 ? 1 : 2);
  ok(t, good, "a piece's faces have the piece's points");
  hsr_scene_delete(scene);
}

/* ---- Line drawings, written by us and read by VTK ---- */

unsigned value(vtkPolyData *data, const char *name, vtkIdType cell) {
  vtkDataArray *array = data->GetCellData()->GetArray(name);
  return array ? static_cast<unsigned>(array->GetComponent(cell, 0)) : ~0u - 1;
}

/* Whether line k of the data is the interval. */
bool is_line(vtkPolyData *data, vtkIdType k, const hsr_segment &s) {
  vtkNew<vtkIdList> ends;
  data->GetLines()->GetCellAtId(k, ends);
  if (ends->GetNumberOfIds() != 2)
    return false;
  double from[3], to[3];
  data->GetPoint(ends->GetId(0), from);
  data->GetPoint(ends->GetId(1), to);
  return !std::memcmp(from, s.from, sizeof from) &&
         !std::memcmp(to, s.to, sizeof to) &&
         value(data, "invisibility", k) == s.invisibility &&
         value(data, "edge_a", k) == s.edge.a &&
         value(data, "edge_b", k) == s.edge.b &&
         value(data, "edge_part", k) == s.edge.part &&
         value(data, "implied", k) == s.edge.implied;
}

void try_drawing(tap *t) {
  hsr_segment segments[] = {
      {{false, 3, 0x89abcdef, 0}, 0, 0, 0.1, {0.1, 1e-300, -3}, {1, 2, 3}},
      {{false, 3, 0x89abcdef, 0}, 300, 0.1, 1, {1, 2, 3}, {4, 5, 1e30}},
      {{true, 0, 7, 2}, 1, 0, 1, {1.0 / 3, 0, 0}, {0, 1.0 / 7, 0}}};
  hsr_drawing drawing = {segments, 3, 3};
  const std::string path = directory + "/lines.vtp";
  hsr_error err = {HSR_OK, ""};
  ok(t, !hsr_drawing_write_vtp(&drawing, nullptr, path.c_str(), &err),
     "a drawing is written");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData *data = reader->GetOutput();
  bool good = data->GetNumberOfLines() == 3;
  for (vtkIdType k = 0; k < 3; k++)
    good = good && is_line(data, k, segments[k]);
  ok(t, good, "VTK reads every bit of it");
  drawing.n = 0;
  ok(t, !hsr_drawing_write_vtp(&drawing, nullptr, path.c_str(), &err),
     "an empty drawing is written");
  ok(t,
     hsr_drawing_write_vtp(&drawing, nullptr,
                           (directory + "/none/a.vtp").c_str(),
                           &err) == HSR_E_INPUT,
     "a folder that is not there: %s", err.text);
}

void try_voxels(tap *t) {
  uint32_t solid[24];
  for (uint32_t k = 0; k < 24; k++)
    solid[k] = k % 5 ? 0xfffffff0u + k % 5 : 0;
  hsr_solid_voxels voxels = {};
  voxels.grid = {{-1, 1.0 / 3, 1e-9}, 0.1, {2, 3, 4}};
  voxels.solid = solid;
  const std::string path = directory + "/voxels.vti";
  hsr_error err = {HSR_OK, ""};
  ok(t, !hsr_voxels_write_vti(&voxels, path.c_str(), &err),
     "voxels are written");
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData *data = reader->GetOutput();
  vtkDataArray *read = data->GetCellData()->GetArray("solid");
  bool good = read && data->GetNumberOfCells() == 24;
  for (vtkIdType k = 0; good && k < 24; k++)
    good = read->GetTuple1(k) == solid[k];
  for (int k = 0; k < 3; k++)
    good = good && data->GetOrigin()[k] == voxels.grid.lo[k] &&
           data->GetSpacing()[k] == voxels.grid.size &&
           data->GetDimensions()[k] == voxels.grid.n[k] + 1;
  ok(t, good, "VTK reads every bit of them");
  ok(t,
     hsr_voxels_write_vti(&voxels, (directory + "/none/a.vti").c_str(), &err) ==
         HSR_E_INPUT,
     "a folder that is not there: %s", err.text);
}

} // namespace

int main() {
  if (!make_directory())
    return 99;
  struct tap t = plan(8 + 1 + 1 + 4 + 3);
  try_ways(&t);
  try_borders(&t);
  try_pieces(&t);
  try_drawing(&t);
  try_voxels(&t);
  return finish(&t) | !remove_directory();
}
