// SPDX-License-Identifier: GPL-3.0-or-later
// .vti and .vtr files: what VTK's own writers wrote, in any encoding and of any
// type of numbers, is read to the last bit; and so are odd files written by
// hand. Bad ones are refused. More of those are in tests/bad.
#include "common/files/volume/volume_data.h"
#include "tests/tap.h"
#include "tests/unit/files/folder.h"
#include "tests/unit/files/vtk_ways.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

/* A volume as it is read; empty if it is refused, with the message. */
struct Read {
  std::vector<double> position[3];
  std::vector<float> sample;
  std::string message;
  enum hsr_status status = HSR_OK;
};

void take(Read &read, const hsr_volume &volume) {
  const size_t slice = size_t{volume.n[0]} * volume.n[1];
  for (int a = 0; a < 3; a++)
    read.position[a].assign(volume.position[a],
                            volume.position[a] + volume.n[a]);
  read.sample.resize(slice * volume.n[2]);
  for (uint32_t k = 0; k < volume.n[2]; k++)
    if (volume.slice(volume.data, k, read.sample.data() + k * slice, nullptr))
      std::exit(99);
}

Read read(const std::string &text, bool rectilinear) {
  const std::string path = file(rectilinear ? "a.vtr" : "a.vti", text);
  hsr_volume_file file = {};
  file.format = rectilinear ? HSR_VTK_GRID : HSR_VTK_IMAGE;
  file.path = path.c_str();
  hsr_volume volume = {};
  hsr_error err = {HSR_OK, ""};
  Read result;
  result.status = hsr_volume_check(&file, &err);
  if (!result.status)
    result.status = hsr_volume_open_vtk(&volume, &file, &err);
  if (!result.status)
    take(result, volume);
  for (double *position : volume.position)
    std::free(position);
  if (volume.close)
    volume.close(volume.data);
  std::free(file.text);
  result.message = err.text;
  return result;
}

/* ---- Files written by VTK ---- */

constexpr int EXTENT[6] = {10, 14, -3, 0, 7, 9};
constexpr int N[3] = {5, 4, 3}, SAMPLES = 60;
constexpr double ORIGIN[3] = {0.1, -7, 1e3}, SPACING[3] = {1, 1.0 / 3, 0.7};
constexpr int TYPES[] = {
    VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,     VTK_UNSIGNED_SHORT,
    VTK_INT,         VTK_UNSIGNED_INT,  VTK_LONG_LONG, VTK_UNSIGNED_LONG_LONG,
    VTK_FLOAT,       VTK_DOUBLE};

struct Way : Encoding {
  bool is_named;
  int type; /* of the samples; of the coordinates: the next one */
};

bool is_real(int type) {
  return type == VTK_FLOAT || type == VTK_DOUBLE;
}

bool is_signed(int type) {
  return type == VTK_SIGNED_CHAR || type == VTK_SHORT || type == VTK_INT ||
         type == VTK_LONG_LONG || is_real(type);
}

/* Of sample k. Those that are not finite cannot be written as text. */
double sample(const Way &way, int k) {
  if (is_real(way.type) && way.mode != Way::TEXT && k % 20 == 7)
    return k < 20 ? NAN : k < 40 ? INFINITY : -INFINITY;
  const double whole = k * 37 % SAMPLES;
  if (!is_signed(way.type))
    return whole;
  return is_real(way.type) ? (whole - 30) / 3 : whole - 30;
}

double coordinate(int type, int axis, int k) {
  const double whole = k * k + 2 * k + axis - (is_signed(type) ? 3 : 0);
  return is_real(type) ? whole / 3 : whole;
}

vtkSmartPointer<vtkDataArray> new_array(int type) {
  return vtkSmartPointer<vtkDataArray>::Take(
      vtkDataArray::CreateDataArray(type));
}

int type_of_coordinates(const Way &way) {
  for (size_t k = 0; k + 1 < std::size(TYPES); k++)
    if (TYPES[k] == way.type)
      return TYPES[k + 1];
  return TYPES[0];
}

/* Arrays that must not be read, and the samples. */
void add_data(vtkDataSet *data, const Way &way) {
  vtkNew<vtkFloatArray> normals;
  normals->SetName("a > b");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(SAMPLES);
  normals->Fill(1);
  data->GetPointData()->SetNormals(normals);
  vtkNew<vtkDoubleArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(SAMPLES);
  other->Fill(2);
  if (way.is_named)
    data->GetPointData()->AddArray(other);
  auto samples = new_array(way.type);
  samples->SetName("c > d");
  samples->SetNumberOfTuples(SAMPLES);
  for (int k = 0; k < SAMPLES; k++)
    samples->SetTuple1(k, sample(way, k));
  if (way.is_named)
    data->GetPointData()->SetScalars(samples);
  else
    data->GetPointData()->AddArray(samples);
  vtkNew<vtkDoubleArray> of_cells;
  of_cells->SetName("of cells");
  of_cells->SetNumberOfTuples(data->GetNumberOfCells());
  of_cells->Fill(2);
  data->GetCellData()->SetScalars(of_cells);
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  words->InsertNextValue("<AppendedData encoding=\"raw\">_");
  data->GetFieldData()->AddArray(words);
}

std::string write_image(const Way &way) {
  vtkNew<vtkImageData> image;
  image->SetExtent(const_cast<int *>(EXTENT));
  image->SetOrigin(ORIGIN);
  image->SetSpacing(SPACING);
  add_data(image, way);
  return write_by_vtk<vtkXMLImageDataWriter>(image.Get(), way, 64);
}

std::string write_grid(const Way &way) {
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetExtent(const_cast<int *>(EXTENT));
  const int type = type_of_coordinates(way);
  vtkSmartPointer<vtkDataArray> at[3];
  for (int a = 0; a < 3; a++) {
    at[a] = new_array(type);
    at[a]->SetNumberOfTuples(N[a]);
    for (int k = 0; k < N[a]; k++)
      at[a]->SetTuple1(k, coordinate(type, a, k));
  }
  grid->SetXCoordinates(at[0]);
  grid->SetYCoordinates(at[1]);
  grid->SetZCoordinates(at[2]);
  add_data(grid, way);
  return write_by_vtk<vtkXMLRectilinearGridWriter>(grid.Get(), way, 64);
}

double position(const Way &way, bool rectilinear, int axis, int k) {
  const int type = type_of_coordinates(way);
  if (!rectilinear)
    return ORIGIN[axis] + SPACING[axis] * (EXTENT[2 * axis] + k);
  const double exact = coordinate(type, axis, k);
  return type == VTK_FLOAT ? double{static_cast<float>(exact)} : exact;
}

bool is_volume(const Read &read, const Way &way, bool rectilinear) {
  if (read.status || read.sample.size() != SAMPLES) {
    std::printf("# %s\n", read.message.c_str());
    return false;
  }
  for (int a = 0; a < 3; a++) {
    if (read.position[a].size() != static_cast<size_t>(N[a]))
      return false;
    for (int k = 0; k < N[a]; k++)
      if (read.position[a][static_cast<size_t>(k)] !=
          position(way, rectilinear, a, k))
        return false;
  }
  for (int k = 0; k < SAMPLES; k++) {
    const float wanted = static_cast<float>(sample(way, k));
    const float found = read.sample[static_cast<size_t>(k)];
    if (found != wanted && !(std::isnan(found) && std::isnan(wanted)))
      return false;
  }
  return true;
}

void try_ways(tap *t) {
  for (int mode = 0; mode < 4; mode++)
    for (int kind = 0; kind < 4; kind++) {
      const bool rectilinear = kind / 2 == 1;
      int n_good = 0;
      for (int bits = 0; bits < 8; bits++)
        for (const int type : TYPES) {
          const Way way = {{static_cast<Way::Mode>(mode), kind % 2 == 1,
                            (bits & 1) != 0, (bits & 2) != 0},
                           (bits & 4) != 0,
                           type};
          const std::string text =
              rectilinear ? write_grid(way) : write_image(way);
          n_good += is_volume(read(text, rectilinear), way, rectilinear);
        }
      ok(t, n_good == 80,
         "%s: %s%s: 10 types, UInt32 and 64, either end first, named or not",
         rectilinear ? ".vtr" : ".vti", mode_names[mode],
         kind % 2 ? ", compressed" : "");
    }
}

/* ---- Files written by hand ---- */

/* An image of 2 x 2 x 1 samples, and a grid of as many. */
const char IMAGE[] =
    "<VTKFile type='ImageData'><ImageData WholeExtent='0 1 0 1 0 0' "
    "Origin='1 2 3' Spacing='1 2 4' Direction='1 0 0 0 1 0 0 0 1'>"
    "<Piece Extent='0 1 0 1 0 0'><PointData Scalars='s'>"
    "<DataArray type='Float32' Name='s' format='ascii'>1 2 3 4</DataArray>"
    "</PointData><CellData/></Piece></ImageData></VTKFile>";
const char GRID[] =
    "<VTKFile type='RectilinearGrid'><RectilinearGrid "
    "WholeExtent='0 1 0 1 0 0'><Piece Extent='0 1 0 1 0 0'><PointData>"
    "<DataArray type='Int16' Name='s' format='ascii'>1 2 3 4</DataArray>"
    "</PointData><Coordinates>"
    "<DataArray type='Float64' format='ascii'>0 0.5</DataArray>"
    "<DataArray type='UInt8' format='ascii'>7 9</DataArray>"
    "<DataArray type='Float32' format='ascii'>-1</DataArray>"
    "</Coordinates></Piece></RectilinearGrid></VTKFile>";

std::string with(const char *text, const char *from, const char *to) {
  std::string changed = text;
  const size_t at = changed.find(from);
  if (at == std::string::npos)
    std::exit(99);
  return changed.replace(at, std::strlen(from), to);
}

bool is_read(const std::string &text, bool rectilinear) {
  const Read r = read(text, rectilinear);
  const std::vector<float> wanted = {1, 2, 3, 4};
  const std::vector<double> x = {rectilinear ? 0.0 : 1, rectilinear ? 0.5 : 2},
                            y = {rectilinear ? 7.0 : 2, rectilinear ? 9.0 : 4},
                            z = {rectilinear ? -1.0 : 3};
  if (r.status)
    std::printf("# %s\n", r.message.c_str());
  return !r.status && r.sample == wanted && r.position[0] == x &&
         r.position[1] == y && r.position[2] == z;
}

void try_odd(tap *t) {
  ok(t, is_read(IMAGE, false) && is_read(GRID, true), "written by hand");
  ok(t,
     is_read("\xef\xbb\xbf<?xml version='1.0'?>\n<!-- a -->\n" +
                 std::string(IMAGE),
             false) &&
         is_read(" \n\n" + std::string(GRID) + "\n \n", true),
     "with a byte order mark, an instruction, a comment, lines");
  ok(t,
     is_read(with(IMAGE, " Direction='1 0 0 0 1 0 0 0 1'", ""), false) &&
         is_read(with(IMAGE, "Origin='1 2 3'", "Origin=' 1.0\n2 3e0 '"), false),
     "without a Direction, and with other white space");
  ok(t,
     is_read(with(IMAGE, "Scalars='s'>",
                  "Scalars='s'><DataArray type='Bit' Name='r'>1</DataArray>"),
             false) &&
         is_read(with(IMAGE, "</PointData>",
                      "<DataArray type='Int8' Name='s'>5</DataArray>"
                      "</PointData>"),
                 false),
     "arrays beside the scalars are not looked at");
  ok(t,
     is_read(with(GRID, "<PointData>",
                  "<PointData Scalars=''><DataArray type='Int8' Name='v' "
                  "NumberOfComponents='3'>1</DataArray>"),
             true) &&
         is_read(with(GRID, "Name='s'", "Name='&amp;' NumberOfComponents='1'"),
                 true) &&
         is_read(with(GRID, "type='Int16' Name='s'",
                      "type='UInt8' Name='vtkGhostLevels'"),
                 true),
     "without Scalars, the first array of one component, whatever its name");
  ok(t,
     is_read(with(IMAGE, "<Piece",
                  "<FieldData><DataArray type='Int8' "
                  "NumberOfTuples='99999999999'/></FieldData>"
                  "<Piece"),
             false) &&
         is_read(with(GRID, "<Coordinates>",
                      "<Coordinates a='&b;'><InformationKey name='a'/>"),
                 true),
     "what is not known is blanked");
}

struct Fault {
  bool rectilinear;
  const char *from, *to, *words;
};

constexpr Fault FAULTS[] = {
    {false, "type='ImageData'", "type='PolyData'", "holds no image data"},
    {true, "type='Rect", "type='Wrect", "holds no rectilinear grid"},
    {false, "<ImageData", "<ImageDate", "a tag is|ends where|holds no data"},
    {false, "WholeExtent", "WholeExtant", "has no WholeExtent"},
    {false, "'0 1 0 1 0 0'", "'0 1 0 1 0'", "not 6 whole numbers"},
    {false, "'0 1 0 1 0 0'", "'0 1 0 1 0 0 0'", "not 6 whole numbers"},
    {false, "'0 1 0 1 0 0'", "'0 1 0 1.5 0 0'", "not 6 whole numbers"},
    {false, "'0 1 0 1 0 0'", "'0 1 0 1 0 -1'", "samples 0 to -1 along axis 2"},
    {false, "'0 1 0 1 0 0'", "'0 1048576 0 0 0 0'",
     "0 to 1048576 along axis 0"},
    {false, "'0 1 0 1 0 0'", "'0 0 1073741824 1073741825 0 0'", "along axis 1"},
    {false, "'0 1 0 1 0 0'", "'-9999999999 -9999999999 0 0 0 0'",
     "along axis 0"},
    {false, "'0 1 0 1 0 0'", "'0 3 0 0 0 0'", "not the whole"},
    {false, " Extent='0 1 0 1 0 0'", "", "not the whole"},
    {false, "<Piece Extent='0 1 0 1 0 0'>", "<Peace>", "Piece|no piece"},
    {false, "Origin='1 2 3'", "Origin='1 2 inf'", "Origin is '1 2 inf', not 3"},
    {false, "Origin='1 2 3'", "Origin='1 2'", "Origin is '1 2', not 3"},
    {false, "Spacing='1 2 4'", "Spacing='1 0 4'", "a spacing of 0"},
    {false, "Spacing='1 2 4'", "Spacing='1 2 -4'", "a spacing of -4"},
    {false, "Spacing='1 2 4'", "Spacing='1 2 nan'", "not 3 numbers"},
    {false, "'1 0 0 0 1 0 0 0 1'", "'1 0 0'", "not 9 numbers"},
    {false, "Scalars='s'", "Scalars='r'", "its scalars, 'r', are not there"},
    {false, "Name='s'", "Name='s' NumberOfComponents='2'", "'s' has not one"},
    {true, "Name='s'", "", "no name"},
    {true, "Name='s'", "Name=''", "no name"},
    {false, "</PointData>", "</PointData><PointData/>", "a second element"},
    {false, "</Piece>", "</Piece><Piece Extent='0 1 0 1 0 0'/>", "several"},
    {false, "<CellData/></Piece></ImageData>",
     "<CellData/></Piece></ImageData><ImageData/>", "a second element"},
    {false, "Float32", "Float16", "not a type"},
    {false, "Float32", "Bit", "not a type"},
    {false, "1 2 3 4", "1 2 3", "has 3 values as samples, not 4"},
    {false, "1 2 3 4", "1 2 3 4 5", "has 5 values as samples, not 4"},
    {false, "1 2 3 4", "1 2 nan 4", "value 2 of the samples"},
    {true, "1 2 3 4", "1 2 3 40000", "value 3 of the samples"},
    {true, "0 0.5", "0 0", "value 1 of the x coordinates is 0, not more than"},
    {true, "7 9", "9 7", "value 1 of the y coordinates is 7, not more than"},
    {true, "0 0.5", "0 nan", "value 1 of the x coordinates"},
    {true, "7 9", "7 9 11", "has 3 values as y coordinates, not 2"},
    {true, ">-1<", "><", "an array has no values"},
    {true, "<DataArray type='Float32' format='ascii'>-1</DataArray>", "",
     "coordinates along 2 axes"},
    {true, "</Coordinates>",
     "<DataArray type='Int8'>1</DataArray></Coordinates>", "not three arrays"},
    {true, "type='UInt8'", "type='UInt8' NumberOfComponents='2'",
     "not three arrays"},
    {true, "</Coordinates>", "</Coordinates><Coordinates/>",
     "a second element"},
    {true, "<PointData>", "<PointDate>",
     "no array of one number for each point"}};

/* Whether a message has one of some words, between which a '|' stands. */
bool has_words(const std::string &message, const std::string &words) {
  for (size_t at = 0; at != std::string::npos;) {
    const size_t end = words.find('|', at);
    if (message.find(words.substr(at, end - at)) != std::string::npos)
      return true;
    at = end == std::string::npos ? end : end + 1;
  }
  return false;
}

bool is_refused(const std::string &text, bool rectilinear, const char *words) {
  const Read r = read(text, rectilinear);
  const bool good = r.status == HSR_E_INPUT && has_words(r.message, words) &&
                    r.message.find('\n') == std::string::npos;
  if (!good)
    std::printf("# status %d: %s\n", static_cast<int>(r.status),
                r.message.c_str());
  return good;
}

void try_faults(tap *t) {
  for (const Fault &f : FAULTS)
    ok(t,
       is_refused(with(f.rectilinear ? GRID : IMAGE, f.from, f.to),
                  f.rectilinear, f.words),
       "refused: %s", f.to);
  std::string cells = with(IMAGE, "PointData Scalars='s'", "CellData");
  cells = with(cells.c_str(), "</PointData><CellData/>", "</CellData>");
  ok(t, is_refused(cells, false, "samples are expected at points"),
     "refused: data of cells alone");
  std::string none = GRID;
  const size_t at = none.find("<Coordinates>");
  none.erase(at, none.find("</Piece>") - at);
  ok(t, is_refused(none, true, "has no coordinates"),
     "refused: a grid without coordinates");
  ok(t, is_refused("", false, "") && is_refused("<", true, ""),
     "refused: what is empty or cut");
}

/* Cut anywhere, a file is refused, or nothing but its end is missing. */
void try_cuts(tap *t) {
  bool good = true;
  for (int kind = 0; kind < 2; kind++) {
    const Way way = {{Way::RAW, true, true, false}, false, VTK_FLOAT};
    const std::string text = kind ? write_grid(way) : write_image(way);
    for (size_t n = 0; n < text.size(); n += 7) {
      const Read r = read(text.substr(0, n), kind == 1);
      good = good && (r.status == HSR_E_INPUT ||
                      (n + 12 > text.size() && is_volume(r, way, kind == 1)));
    }
  }
  ok(t, good, "files that are cut");
}

} // namespace

int main() {
  if (!make_directory())
    return 99;
  struct tap t = plan(16 + 6 + std::size(FAULTS) + 3 + 1);
  try_ways(&t);
  try_odd(&t);
  try_faults(&t);
  try_cuts(&t);
  return finish(&t) | !remove_directory();
}
