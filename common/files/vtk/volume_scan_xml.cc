// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .vti and .vtr files: VTK's XML of images and of rectilinear
// grids.
//
// Source      "VTK XML Formats", docs.vtk.org; what it leaves open, from
//             vtkXMLStructuredDataReader, vtkXMLImageDataReader and
//             vtkXMLRectilinearGridReader of VTK 9.1
// Safety      VTK believes what it reads: sizes, counts, offsets. So it sees no
//             elements and attributes but those named below, and no array but
//             those of the samples and the coordinates, which are decoded and
//             checked first. All else becomes spaces, and no byte moves.
// Departures  one piece; zlib is the only compressor; cell data, fields and time
//             steps are not read (of several arrays of one name, the first is).
#include "common/files/vtk/xml_scan.h"
#include "common/files/volume/volume_check.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <new>

namespace hsr {
namespace {

/* Of an index, so that VTK's differences of them are in range. */
constexpr long long MOST_INDEX = 1 << 30;
/* Along an axis. */
constexpr long long MOST_SAMPLES = HSR_VOLUME_MOST;

class Grid_scan final : public Xml_scan {
public:
  Grid_scan(Mesh_file &bytes, hsr_volume_file &volume)
      : Xml_scan(bytes, volume.is_rectilinear
                            ? Kind{"RectilinearGrid", "rectilinear grid"}
                            : Kind{"ImageData", "image data"}),
        volume_(volume) {}
  void scan();

private:
  void scan_data(Tag &tag) override;
  void extent(Tag &tag);
  void frame(Tag &tag);
  void turn(const char *place, const double origin[3], const double spacing[3],
            const double direction[9]);
  void piece(Tag &tag);
  void coordinates(const Tag &tag);
  void samples(const Tag &tag);
  bool are_samples(const Tag &tag, Word name) const;
  void add_samples(Tag &tag);
  bool has_one_component(const Tag &tag) const;
  void cell_data(const Tag &tag);
  void check_piece(const char *place) const;
  template <class Number, size_t N>
  bool numbers(Tag &tag, const char *name, Number (&to)[N]);
  bool read(Word word, long long &to) const { return read_integer(word, to); }
  bool read(Word word, double &to) { return read_real_(word, to); }

  hsr_volume_file &volume_;
  Number_reader read_real_;
  long long extent_[6] = {};
  bool has_piece_ = false, has_coordinates_ = false, has_samples_ = false;
  bool has_point_data_ = false, has_cell_data_ = false;
};

/* Takes the first word of a text; empty if there is none. */
Word take_word(Word &text) {
  text = trimmed(text);
  const char *end = std::find_if(text.begin(), text.end(), is_xml_space);
  const Word word = text.substr(0, static_cast<size_t>(end - text.begin()));
  text.remove_prefix(word.size());
  return word;
}

/* The N numbers of an attribute; false if it is not there. */
template <class Number, size_t N>
bool Grid_scan::numbers(Tag &tag, const char *name, Number (&to)[N]) {
  const Word *text = markup_.attribute(tag, name);
  if (!text)
    return false;
  Word rest = *text;
  bool good = true;
  for (Number &number : to)
    good = good && read(take_word(rest), number);
  if (!good || !trimmed(rest).empty())
    markup_.refuse(text->data(), "%s is '%s', not %zu %snumbers", name,
                   shown_word(*text).c_str(), N,
                   std::is_integral_v<Number> ? "whole " : "");
  return true;
}

/* The indices of the first and the last sample along each axis. */
void Grid_scan::extent(Tag &tag) {
  const char *place = tag.text.data();
  if (!numbers(tag, "WholeExtent", extent_))
    markup_.refuse(place, "has no WholeExtent");
  for (size_t a = 0; a < 3; a++) {
    const long long first = extent_[2 * a], last = extent_[2 * a + 1];
    if (first < -MOST_INDEX || last > MOST_INDEX || last < first ||
        last - first >= MOST_SAMPLES)
      markup_.refuse(place,
                     "has samples %lld to %lld along axis %zu; from 1 to %lld "
                     "of them can be read",
                     first, last, a, MOST_SAMPLES);
    volume_.n[a] = static_cast<uint32_t>(last - first + 1);
  }
}

/* Where an image is, and how large. */
void Grid_scan::frame(Tag &tag) {
  const char *place = tag.text.data();
  double origin[3] = {0, 0, 0}, spacing[3] = {1, 1, 1}, direction[9];
  numbers(tag, "Origin", origin);
  if (numbers(tag, "Spacing", spacing))
    for (const double step : spacing)
      if (!(step > 0))
        markup_.refuse(place, "has a spacing of %g, which is not positive",
                       step);
  if (!numbers(tag, "Direction", direction))
    return;
  bool is_turned = false;
  for (size_t k = 0; k < 9; k++)
    is_turned = is_turned || direction[k] != (k % 4 == 0 ? 1 : 0);
  if (is_turned)
    turn(place, origin, spacing, direction);
}

/* Column f of the matrix is the direction of axis f. */
void Grid_scan::turn(const char *place, const double origin[3],
                     const double spacing[3], const double direction[9]) {
  hsr_volume_frame frame;
  for (size_t a = 0; a < 3; a++) {
    frame.origin[a] = origin[a];
    for (size_t f = 0; f < 3; f++) {
      frame.step[f][a] = direction[3 * a + f] * spacing[f];
      frame.origin[a] += frame.step[f][a] * static_cast<double>(extent_[2 * f]);
    }
  }
  hsr_error why;
  if (hsr_volume_settle(&volume_, &frame, &why))
    markup_.refuse(place, "has a Direction whose axes are no frame");
}

void Grid_scan::scan_data(Tag &tag) {
  const char *place = tag.text.data();
  extent(tag);
  if (!volume_.is_rectilinear)
    frame(tag);
  markup_.blank_others(tag);
  for (Tag child; markup_.child(tag, child);)
    if (child.name == "Piece")
      piece(child);
    else
      markup_.skip(child);
  if (!has_piece_)
    markup_.refuse(place, "holds no piece");
}

void Grid_scan::piece(Tag &tag) {
  const char *place = tag.text.data();
  if (has_piece_)
    markup_.refuse(place, "has several pieces; a file of one is read");
  has_piece_ = true;
  long long extent[6];
  if (!numbers(tag, "Extent", extent) ||
      !std::equal(extent, extent + 6, extent_))
    markup_.refuse(place, "has a piece that is not the whole: its Extent is "
                          "not the WholeExtent");
  markup_.blank_others(tag);
  for (Tag child; markup_.child(tag, child);)
    if (child.name == "PointData")
      samples(child);
    else if (child.name == "Coordinates" && volume_.is_rectilinear)
      coordinates(child);
    else if (child.name == "CellData")
      cell_data(child);
    else
      markup_.skip(child);
  check_piece(place);
}

void Grid_scan::check_piece(const char *place) const {
  if (!has_samples_)
    markup_.refuse(place, "%s",
                   has_cell_data_
                       ? "has data of its cells; samples are expected at points"
                       : "has no array of one number for each point");
  if (volume_.is_rectilinear && !has_coordinates_)
    markup_.refuse(place, "has no coordinates");
}

void Grid_scan::coordinates(const Tag &tag) {
  static constexpr const char *WHAT[] = {"x coordinates", "y coordinates",
                                         "z coordinates"};
  const char *place = tag.text.data();
  if (has_coordinates_)
    markup_.refuse(place, "a second element 'Coordinates'");
  has_coordinates_ = true;
  markup_.blank_others(tag);
  size_t n = 0;
  for (Tag child; markup_.child(tag, child);) {
    if (child.name != "DataArray") {
      markup_.skip(child);
      continue;
    }
    if (n == 3 || !has_one_component(child))
      markup_.refuse(child.text.data(),
                     "the coordinates are not three arrays of one component");
    Array array{WHAT[n],  child.text.data(), volume_.n[n],
                -DBL_MAX, DBL_MAX,           Array::ASCENDING};
    add_array(child, array);
    n++;
  }
  if (n < 3)
    markup_.refuse(place, "has coordinates along %zu axes", n);
}

/* Keeps one array of points, and blanks the others. */
void Grid_scan::samples(const Tag &tag) {
  const char *place = tag.text.data();
  if (has_point_data_)
    markup_.refuse(place, "a second element 'PointData'");
  has_point_data_ = true;
  const Word *scalars = markup_.find(tag, "Scalars");
  const std::string name(scalars ? *scalars : Word());
  markup_.blank_others(tag);
  for (Tag child; markup_.child(tag, child);)
    if (!has_samples_ && are_samples(child, name))
      add_samples(child);
    else
      markup_.skip(child);
  if (!has_samples_ && !name.empty())
    markup_.refuse(place, "its scalars, '%s', are not there",
                   shown_word(name).c_str());
}

/* If the scalars have no name, the first array of one component is taken. */
bool Grid_scan::are_samples(const Tag &tag, Word name) const {
  if (tag.name != "DataArray")
    return false;
  if (name.empty())
    return has_one_component(tag);
  const Word *own = markup_.find(tag, "Name");
  return own && *own == name;
}

/* VTK does not read an array of points without a name, and changes the values
 * of arrays with some names. So this one gets a name that means nothing. */
void Grid_scan::add_samples(Tag &tag) {
  const char *place = tag.text.data();
  has_samples_ = true;
  const Word *name = markup_.attribute(tag, "Name");
  if (!name || name->empty())
    markup_.refuse(place, "the array of the samples has no name");
  if (!has_one_component(tag))
    markup_.refuse(place, "'%s' has not one number a sample",
                   shown_word(*name).c_str());
  overwrite_lines(*name, 'a');
  const size_t n = size_t{volume_.n[0]} * volume_.n[1] * volume_.n[2];
  Array array{"samples", place, n, -INFINITY, INFINITY, Array::ANY_ORDER};
  array.can_be_nan = true;
  add_array(tag, array);
}

bool Grid_scan::has_one_component(const Tag &tag) const {
  const Word *n = markup_.find(tag, "NumberOfComponents");
  return !n || *n == "1";
}

/* Blanks the data, and notes whether there are some. */
void Grid_scan::cell_data(const Tag &tag) {
  for (Tag child; markup_.child(tag, child);) {
    has_cell_data_ = true;
    markup_.skip(child);
  }
  blank_lines(between(tag.text.data(), markup_.at()));
}

void Grid_scan::scan() {
  scan_root();
  if (!has_piece_)
    file_.refuse(0, "holds no data");
  check_arrays();
}

} // namespace
} // namespace hsr

/* VTK is to see the text from its root on. */
enum hsr_status hsr_volume_scan_xml(struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  try {
    hsr::Mesh_file bytes{file->path, nullptr, file->text,
                         file->text + file->size};
    hsr::skip_byte_order_mark(bytes);
    hsr::Grid_scan(bytes, *file).scan();
    file->size = bytes.size();
    std::memmove(file->text, bytes.begin, file->size);
    return HSR_OK;
  } catch (const hsr::Refused &refused) {
    if (err)
      *err = refused.error;
    return refused.error.status;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "%.200s: a reader failed", file->path);
  }
}
