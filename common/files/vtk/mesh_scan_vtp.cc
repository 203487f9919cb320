// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .vtp files: VTK's XML of polygons and triangle strips.
//
// Source      "VTK XML Formats", docs.vtk.org; what it leaves open, from
//             vtkXMLPolyDataReader and vtkXMLDataParser of VTK 9.1
// Safety      VTK believes what it reads: sizes, counts, offsets. So it gets to
//             see no elements and attributes but those named below; all others
//             become spaces, and no byte moves. Every value of every array is
//             decoded and checked here first (common/files/vtk/mesh_array.h).
// Departures  zlib is the only compressor; vertices and lines as cells are
//             refused; point and cell data, fields and time steps are not read;
//             all pieces have points of one type.
#include "common/files/vtk/mesh_array.h"

#include <algorithm>
#include <cfloat>

namespace hsr {
namespace {

/* An element takes VTK 2 kB, and a piece has up to nine. */
constexpr size_t MOST_PIECES = 1000;
/* Deflate makes nothing more than 1032 times as small. */
constexpr size_t MOST_PACKED = 1032;

class Vtp_scan {
public:
  explicit Vtp_scan(Mesh_file &file) : file_(file), markup_(file) {}
  Mesh_extent scan();

private:
  static constexpr size_t NONE = SIZE_MAX;
  struct Cells {
    size_t connectivity = NONE, offsets = NONE; /* which of arrays_[] */
  };

  void root();
  void attributes_of_root(Tag &tag);
  void appended_data(Tag &tag);
  void poly_data(const Tag &tag);
  void piece(Tag &tag);
  void points(const Tag &tag, size_t n);
  void cells(const Tag &tag, size_t n, size_t n_points);
  size_t count(Tag &tag, const char *name, size_t most) const;
  void array(Tag &tag, Array array);
  void format(Tag &tag, Array &array) const;
  void content(const Tag &tag, Array &array);

  void place_appended(Array &array) const;
  void check_arrays();
  void check_offsets();

  Mesh_file &file_;
  Markup markup_;
  Mesh_extent extent_;
  Array_encoding encoding_;
  size_t n_pieces_ = 0;
  const Array_type *type_of_points_ = nullptr;
  std::vector<Array> arrays_;
  std::vector<Cells> cells_;
  Word appended_;
  bool is_appended_base64_ = false;
};

/* The value of an attribute, 0 if there is none. */
size_t Vtp_scan::count(Tag &tag, const char *name, size_t most) const {
  const Word *word = markup_.attribute(tag, name);
  if (!word)
    return 0;
  long long number;
  if (!read_integer(*word, number) || number < 0)
    markup_.refuse(word->data(), "%s is '%s', not a number from 0 on", name,
                   shown_word(*word).c_str());
  if (static_cast<size_t>(number) > most)
    markup_.refuse(word->data(), "%s is %lld, more than %zu bytes can hold",
                   name, number, file_.size());
  return static_cast<size_t>(number);
}

void Vtp_scan::attributes_of_root(Tag &tag) {
  const char *place = tag.text.data();
  const auto refuse = [&](const Word &word, const char *what) {
    markup_.refuse(place, "'%s' is not %s", shown_word(word).c_str(), what);
  };
  const Word *type = markup_.attribute(tag, "type");
  if (!type || *type != "PolyData")
    markup_.refuse(place, "holds no polygonal data");
  const Word *version = markup_.attribute(tag, "version");
  if (version &&
      (version->size() != 3 || (*version)[0] < '0' || (*version)[0] > '2' ||
       (*version)[1] != '.' || (*version)[2] < '0' || (*version)[2] > '9'))
    refuse(*version, "a version from 0.1 to 2.9");
  if (const Word *order = markup_.attribute(tag, "byte_order")) {
    encoding_.is_big_endian = *order == "BigEndian";
    if (!encoding_.is_big_endian && *order != "LittleEndian")
      refuse(*order, "a byte order");
  }
  if (const Word *header = markup_.attribute(tag, "header_type")) {
    if (*header == "UInt64")
      encoding_.header = {8, false, 0, 0x1p64};
    else if (*header != "UInt32")
      refuse(*header, "a type of headers");
  }
  if (const Word *compressor = markup_.attribute(tag, "compressor")) {
    encoding_.is_compressed = true;
    if (*compressor != "vtkZLibDataCompressor")
      refuse(*compressor, "a compressor that is read (vtkZLibDataCompressor)");
  }
  markup_.blank_others(tag);
}

void Vtp_scan::root() {
  Tag tag = markup_.tag();
  if (tag.kind == Tag::END || tag.name != "VTKFile")
    markup_.refuse(tag.text.data(), "is no VTK XML file");
  file_.begin += tag.text.data() - file_.begin;
  attributes_of_root(tag);
  bool has_data = false;
  for (Tag child; markup_.child(tag, child);) {
    if (child.name == "AppendedData") {
      appended_data(child);
    } else if (child.name != "PolyData") {
      markup_.skip(child);
    } else if (has_data) {
      markup_.refuse(child.text.data(), "a second element 'PolyData'");
    } else {
      has_data = true;
      poly_data(child);
    }
  }
  const Word rest = trimmed(markup_.rest());
  if (!rest.empty())
    markup_.refuse(rest.data(), "the file goes on after its last element");
}

/* VTK takes what follows the first '_', and looks no further for tags. */
void Vtp_scan::appended_data(Tag &tag) {
  const Word *encoding = markup_.attribute(tag, "encoding");
  if (!encoding || (*encoding != "raw" && *encoding != "base64"))
    markup_.refuse(tag.text.data(), "appended data neither raw nor base64");
  is_appended_base64_ = *encoding == "base64";
  markup_.blank_others(tag);
  const Word rest = markup_.rest();
  const size_t start = rest.find_first_not_of(" \t\r\n");
  const size_t end = rest.rfind("</AppendedData");
  if (tag.kind != Tag::START || end == Word::npos || start == end ||
      rest[start] != '_')
    markup_.refuse(tag.text.data(),
                   "appended data without their '_' or their end");
  appended_ = rest.substr(start + 1, end - start - 1);
  markup_.go_to(rest.data() + end);
  Tag child;
  markup_.child(tag, child);
}

void Vtp_scan::poly_data(const Tag &tag) {
  markup_.blank_others(tag);
  for (Tag child; markup_.child(tag, child);)
    if (child.name == "Piece")
      piece(child);
    else
      markup_.skip(child);
}

/* Pieces without points, and what is empty in the others, are blanked. */
void Vtp_scan::piece(Tag &tag) {
  const char *place = tag.text.data();
  const size_t most =
      encoding_.is_compressed ? MOST_PACKED * file_.size() : file_.size();
  const size_t n_points = count(tag, "NumberOfPoints", most);
  const size_t n_polys = count(tag, "NumberOfPolys", most);
  const size_t n_strips = count(tag, "NumberOfStrips", most);
  if (count(tag, "NumberOfVerts", most) || count(tag, "NumberOfLines", most))
    markup_.refuse(place, "holds vertices or lines as cells; only polygons and "
                          "triangle strips make faces");
  if (!n_points && (n_polys || n_strips))
    markup_.refuse(place, "a piece has faces but no points");
  if (!n_points) {
    markup_.skip(tag);
    return;
  }
  if (++n_pieces_ > MOST_PIECES)
    markup_.refuse(place, "has more than %zu pieces", MOST_PIECES);
  markup_.blank_others(tag);
  extent_.n_vertices += n_points;
  extent_.n_faces += n_polys + n_strips;

  size_t n_found[3] = {0, 0, 0};
  for (Tag child; markup_.child(tag, child);) {
    if (child.name == "Points" && ++n_found[0])
      points(child, n_points);
    else if (child.name == "Polys" && n_polys && ++n_found[1])
      cells(child, n_polys, n_points);
    else if (child.name == "Strips" && n_strips && ++n_found[2])
      cells(child, n_strips, n_points);
    else
      markup_.skip(child);
  }
  const size_t n_wanted[3] = {1, n_polys > 0, n_strips > 0};
  for (size_t k = 0; k < 3; k++)
    if (n_found[k] != n_wanted[k])
      markup_.refuse(place, "a piece has %zu elements '%s'", n_found[k],
                     k == 0   ? "Points"
                     : k == 1 ? "Polys"
                              : "Strips");
}

void Vtp_scan::points(const Tag &tag, size_t n) {
  markup_.blank_others(tag);
  const size_t n_before = arrays_.size();
  for (Tag child; markup_.child(tag, child);) {
    if (child.name != "DataArray") {
      markup_.skip(child);
      continue;
    }
    const char *place = child.text.data();
    if (arrays_.size() > n_before)
      markup_.refuse(place, "'Points' holds more than one array");
    const Word *size = markup_.attribute(child, "NumberOfComponents");
    if (!size || *size != "3")
      markup_.refuse(place, "has points of other than 3 coordinates");
    array(child, {"points", place, 3 * n, -DBL_MAX, DBL_MAX, false});
    if (!type_of_points_)
      type_of_points_ = arrays_.back().type;
    if (arrays_.back().type != type_of_points_)
      markup_.refuse(place, "has pieces with points of several types");
  }
  if (arrays_.size() == n_before)
    markup_.refuse(tag.text.data(), "'Points' holds no array");
}

void Vtp_scan::cells(const Tag &tag, size_t n, size_t n_points) {
  markup_.blank_others(tag);
  Cells cells;
  for (Tag child; markup_.child(tag, child);) {
    const Word *name = markup_.attribute(child, "Name");
    const bool is_offsets = name && *name == "offsets";
    if (child.name != "DataArray" || !name ||
        (*name != "connectivity" && !is_offsets)) {
      markup_.skip(child);
      continue;
    }
    const char *place = child.text.data();
    size_t &found = is_offsets ? cells.offsets : cells.connectivity;
    if (found != NONE)
      markup_.refuse(place, "'%s' has two arrays '%s'",
                     shown_word(tag.name).c_str(), shown_word(*name).c_str());
    const Word *size = markup_.attribute(child, "NumberOfComponents");
    if (size && *size != "1")
      markup_.refuse(place, "'%s' has other than 1 component",
                     shown_word(*name).c_str());
    found = arrays_.size();
    if (is_offsets)
      array(child, {"offsets", place, n, 0, double{MOST_VALUES}, true});
    else
      array(child, {"connectivity", place, Array::ANY, 0,
                    static_cast<double>(n_points - 1), false});
    if (arrays_.back().type->is_real)
      markup_.refuse(place, "'%s' is not of integers",
                     shown_word(*name).c_str());
  }
  if (cells.connectivity == NONE || cells.offsets == NONE)
    markup_.refuse(tag.text.data(), "'%s' lacks its connectivity or offsets",
                   shown_word(tag.name).c_str());
  cells_.push_back(cells);
}

void Vtp_scan::array(Tag &tag, Array array) {
  if (array.n_expected != Array::ANY && array.n_expected > MOST_VALUES)
    markup_.refuse(array.place, "%zu values are more than can be read",
                   array.n_expected);
  const Word *type = markup_.attribute(tag, "type");
  array.type = type ? find_array_type(*type) : nullptr;
  if (!array.type)
    markup_.refuse(array.place, "'%s' is not a type of numbers",
                   type ? shown_word(*type).c_str() : "");
  format(tag, array);
  markup_.blank_others(tag);
  content(tag, array);
  arrays_.push_back(array);
}

void Vtp_scan::format(Tag &tag, Array &array) const {
  const Word *format = markup_.attribute(tag, "format");
  const Word *offset = markup_.attribute(tag, "offset");
  if (!format || *format == "ascii")
    array.format = Array::TEXT;
  else if (*format == "binary")
    array.format = Array::BINARY;
  else if (*format == "appended")
    array.format = Array::APPENDED;
  else
    markup_.refuse(array.place, "'%s' is not a format",
                   shown_word(*format).c_str());
  if ((array.format == Array::APPENDED) != (offset != nullptr))
    markup_.refuse(array.place, "an array is appended without an offset, or "
                                "has one though it is not");
  if (offset)
    array.offset = count(tag, "offset", file_.size());
}

/* What is between the tags of an array; elements in it are blanked. */
void Vtp_scan::content(const Tag &tag, Array &array) {
  const char *start = markup_.at();
  if (tag.kind == Tag::START) {
    Tag child;
    while (markup_.child_or_text(tag, child))
      markup_.skip(child);
    array.data = trimmed(between(start, child.text.data()));
  }
  if (array.data.empty() != (array.format == Array::APPENDED))
    markup_.refuse(array.place, array.data.empty()
                                    ? "an array has no values"
                                    : "an appended array has values");
}

void Vtp_scan::place_appended(Array &array) const {
  if (array.offset >= appended_.size())
    markup_.refuse(array.place, "has its %s at %zu of %zu appended bytes",
                   array.what, array.offset, appended_.size());
  array.data = appended_.substr(array.offset);
  array.is_base64 = is_appended_base64_;
}

/* No two arrays share bytes, so that the work is bounded by the file's size. */
void Vtp_scan::check_arrays() {
  std::vector<Array *> by_place;
  for (Array &array : arrays_) {
    if (array.format == Array::APPENDED)
      place_appended(array);
    by_place.push_back(&array);
  }
  std::sort(by_place.begin(), by_place.end(),
            [](Array *a, Array *b) { return a->data.data() < b->data.data(); });
  Array_checker checker(markup_, encoding_);
  const char *end = file_.begin;
  for (Array *array : by_place) {
    if (array->data.data() < end)
      markup_.refuse(array->place, "has its %s where another array is",
                     array->what);
    end = checker.check(*array);
  }
}

/* The offset of a cell is where its corners end. */
void Vtp_scan::check_offsets() {
  for (const Cells &cells : cells_) {
    const Array &offsets = arrays_[cells.offsets];
    const size_t n_corners = arrays_[cells.connectivity].n;
    if (offsets.least != static_cast<double>(n_corners))
      markup_.refuse(offsets.place,
                     "the last of the offsets is %.0f, but the connectivity "
                     "has %zu values",
                     offsets.least, n_corners);
    extent_.n_corners += n_corners;
  }
}

Mesh_extent Vtp_scan::scan() {
  root();
  if (!extent_.n_faces)
    file_.refuse(0, "holds no face");
  check_arrays();
  check_offsets();
  return std::move(extent_);
}

} // namespace

Mesh_extent scan_vtp(Mesh_file &file) {
  skip_byte_order_mark(file);
  return Vtp_scan(file).scan();
}

} // namespace hsr
