// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .vtp files: VTK's XML of polygons and triangle strips.
//
// Source      "VTK XML Formats", docs.vtk.org; what it leaves open, from
//             vtkXMLPolyDataReader and vtkXMLDataParser of VTK 9.1
// Safety      VTK's own reader believes what it reads: sizes, counts, offsets.
//             This one decodes and checks each value (xml_array.h), and gives
//             it to the builder.
// Memory      at once: the file, 8 bytes a number in it, and the object
// Departures  zlib is the only compressor; vertices and lines as cells are
//             refused; point and cell data, fields and time steps are not read,
//             but for those that hsr export writes of polygons: "colour", three
//             bytes; beside it "rgb", the same as three linear floats, and
//             "opacity"; and "instance", by which faces are of several objects.
//             All pieces have each of them or none. All pieces have points of
//             one type.
#include "common/files/srgb.h"
#include "common/files/vtk/xml_scan.h"

#include <cfloat>

namespace hsr {
namespace {

constexpr size_t MOST_PIECES = 1000;
/* Deflate makes nothing more than 1032 times as small. */
constexpr size_t MOST_PACKED = 1032;

class Vtp_reader final : public Xml_scan {
public:
  Vtp_reader(Mesh_file &file, Mesh_builder &builder)
      : Xml_scan(file, {"PolyData", "polygonal data"}), builder_(builder) {}
  void read();

private:
  static constexpr size_t NONE = SIZE_MAX;
  /* Which of arrays_[]. */
  struct Cells {
    size_t connectivity = NONE, offsets = NONE;
  };
  struct Piece {
    size_t points = NONE;
    size_t looks[4] = {NONE, NONE, NONE, NONE}; /* as LOOKS */
    Cells polys, strips;
  };

  void scan_data(Tag &tag) override;
  void piece(Tag &tag);
  void points(const Tag &tag, size_t n);
  Cells cells(const Tag &tag, size_t n, size_t n_points);
  void looks(const Tag &tag, size_t n);
  void keep(Tag &tag, Array array);
  void check_offsets(const Cells &cells) const;
  void check_looks() const;
  void give(const Piece &piece);
  const std::vector<double> *look(const Piece &piece, size_t which) const;
  bool has_instances() const;
  void begin_instance(double number);
  void give_polygon(size_t cell, const Piece &piece);
  void give_strip();

  Mesh_builder &builder_;
  size_t n_faces_ = 0, n_vertices_ = 0; /* n_vertices_: given so far */
  bool has_instances_ = false;
  double instance_ = -1; /* of the face that was given last */
  const Array_type *type_of_points_ = nullptr;
  std::vector<Piece> pieces_;
  std::vector<uint32_t> corners_; /* of the current cell */
};

void Vtp_reader::scan_data(Tag &tag) {
  for (Tag child; markup_.child(tag, child);)
    if (child.name == "Piece")
      piece(child);
    else
      markup_.skip(child);
}

/* Pieces without points, and what is empty in the others, are passed over. */
void Vtp_reader::piece(Tag &tag) {
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
  if (pieces_.size() == MOST_PIECES)
    markup_.refuse(place, "has more than %zu pieces", MOST_PIECES);
  pieces_.emplace_back();
  n_faces_ += n_polys + n_strips;

  size_t n_found[4] = {0, 0, 0, 0};
  for (Tag child; markup_.child(tag, child);) {
    if (child.name == "Points" && ++n_found[0])
      points(child, n_points);
    else if (child.name == "Polys" && n_polys && ++n_found[1])
      pieces_.back().polys = cells(child, n_polys, n_points);
    else if (child.name == "Strips" && n_strips && ++n_found[2])
      pieces_.back().strips = cells(child, n_strips, n_points);
    else if (child.name == "CellData" && n_polys && !n_strips && !n_found[3]++)
      looks(child, n_polys);
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

void Vtp_reader::points(const Tag &tag, size_t n) {
  size_t &found = pieces_.back().points;
  for (Tag child; markup_.child(tag, child);) {
    if (child.name != "DataArray") {
      markup_.skip(child);
      continue;
    }
    const char *place = child.text.data();
    if (found != NONE)
      markup_.refuse(place, "'Points' holds more than one array");
    const Word *size = markup_.attribute(child, "NumberOfComponents");
    if (!size || *size != "3")
      markup_.refuse(place, "has points of other than 3 coordinates");
    found = arrays_.size();
    keep(child, {"points", place, 3 * n, -DBL_MAX, DBL_MAX, Array::ANY_ORDER});
    if (!type_of_points_)
      type_of_points_ = arrays_.back().type;
    if (arrays_.back().type != type_of_points_)
      markup_.refuse(place, "has pieces with points of several types");
  }
  if (found == NONE)
    markup_.refuse(tag.text.data(), "'Points' holds no array");
}

/* The offset of a cell is where its corners end. */
Vtp_reader::Cells Vtp_reader::cells(const Tag &tag, size_t n, size_t n_points) {
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
      keep(child, {"offsets", place, n, 0, double{MOST_VALUES}, Array::RISING});
    else
      keep(child, {"connectivity", place, Array::ANY, 0,
                   static_cast<double>(n_points - 1), Array::ANY_ORDER});
    if (arrays_.back().type->is_real)
      markup_.refuse(place, "'%s' is not of integers",
                     shown_word(*name).c_str());
  }
  if (cells.connectivity == NONE || cells.offsets == NONE)
    markup_.refuse(tag.text.data(), "'%s' lacks its connectivity or offsets",
                   shown_word(tag.name).c_str());
  return cells;
}

/* What is known of each polygon. */
struct Look {
  const char *name, *n_numbers, *type;
  double least, most;
};
enum { COLOUR, RGB, OPACITY, INSTANCE, N_LOOKS };
constexpr Look LOOKS[N_LOOKS] = {{"colour", "3", "UInt8", 0, UINT8_MAX},
                                 {"rgb", "3", "Float32", -DBL_MAX, DBL_MAX},
                                 {"opacity", "1", "Float64", -DBL_MAX, DBL_MAX},
                                 {"instance", "1", "UInt32", 0, UINT32_MAX}};

void Vtp_reader::looks(const Tag &tag, size_t n) {
  for (Tag child; markup_.child(tag, child);) {
    const Word *name = markup_.attribute(child, "Name");
    const Word *size = markup_.attribute(child, "NumberOfComponents");
    const Word *type = markup_.attribute(child, "type");
    const Word n_numbers = size ? *size : Word("1");
    size_t k = 0;
    while (k < N_LOOKS &&
           (pieces_.back().looks[k] != NONE || child.name != "DataArray" ||
            !name || *name != LOOKS[k].name ||
            n_numbers != LOOKS[k].n_numbers || !type || *type != LOOKS[k].type))
      k++;
    if (k == N_LOOKS) {
      markup_.skip(child);
      continue;
    }
    pieces_.back().looks[k] = arrays_.size();
    keep(child, {LOOKS[k].name, child.text.data(), k < OPACITY ? 3 * n : n,
                 LOOKS[k].least, LOOKS[k].most, Array::ANY_ORDER});
  }
}

void Vtp_reader::keep(Tag &tag, Array array) {
  array.is_kept = true;
  add_array(tag, array);
}

void Vtp_reader::check_offsets(const Cells &cells) const {
  if (cells.offsets == NONE)
    return;
  const Array &offsets = arrays_[cells.offsets];
  const size_t n_corners = arrays_[cells.connectivity].n;
  if (offsets.least != static_cast<double>(n_corners))
    markup_.refuse(offsets.place,
                   "the last of the offsets is %.0f, but the connectivity has "
                   "%zu values",
                   offsets.least, n_corners);
}

void Vtp_reader::check_looks() const {
  for (size_t k = 0; k < N_LOOKS; k++) {
    size_t n = 0;
    for (const Piece &piece : pieces_)
      n += piece.looks[k] != NONE;
    if (n && n < pieces_.size())
      file_.refuse(0,
                   "%zu of its %zu pieces have cell data '%s'; all must, or "
                   "none",
                   n, pieces_.size(), LOOKS[k].name);
  }
}

/* The array of a piece; NULL if it is not there, or not of hsr. */
const std::vector<double> *Vtp_reader::look(const Piece &piece,
                                            size_t which) const {
  return piece.looks[COLOUR] == NONE || piece.looks[which] == NONE
             ? nullptr
             : &arrays_[piece.looks[which]].values;
}

/* Whether the faces are of several instances, in their order. */
bool Vtp_reader::has_instances() const {
  double first = -1, last = -1;
  for (const Piece &piece : pieces_) {
    if (piece.looks[INSTANCE] == NONE)
      return false;
    for (const double number : arrays_[piece.looks[INSTANCE]].values) {
      if (number < last)
        return false;
      first = first < 0 ? number : first;
      last = number;
    }
  }
  return last > first;
}

/* Objects have no names in the file. */
void Vtp_reader::begin_instance(double number) {
  if (number == instance_)
    return;
  instance_ = number;
  builder_.group("object " + std::to_string(static_cast<long>(number)));
}

static float share(double x) {
  return static_cast<float>(x > 0 ? x < 1 ? x : 1 : 0);
}

void Vtp_reader::give_polygon(size_t cell, const Piece &piece) {
  const std::vector<double> *colour = look(piece, COLOUR);
  const std::vector<double> *exact = look(piece, RGB);
  const std::vector<double> *opacity = look(piece, OPACITY);
  float rgb[3];
  for (size_t k = 0; k < 3 && colour; k++)
    rgb[k] = exact ? share((*exact)[3 * cell + k])
                   : hsr_srgb_decode(
                         static_cast<float>((*colour)[3 * cell + k]) / 255.0f);
  if (has_instances_)
    begin_instance(arrays_[piece.looks[INSTANCE]].values[cell]);
  builder_.face(corners_.data(), corners_.size(), colour ? rgb : nullptr);
  if (opacity)
    builder_.opacity(share((*opacity)[cell]));
}

/* Every second triangle of a strip is wound the other way round. */
void Vtp_reader::give_strip() {
  for (size_t k = 2; k < corners_.size(); k++) {
    const uint32_t triangle[3] = {corners_[k - 2], corners_[k - 1 + k % 2],
                                  corners_[k - k % 2]};
    builder_.face(triangle, 3);
  }
}

void Vtp_reader::give(const Piece &piece) {
  const size_t first = n_vertices_;
  const std::vector<double> &xyz = arrays_[piece.points].values;
  for (size_t k = 0; k < xyz.size(); k += 3, n_vertices_++)
    builder_.vertex(xyz[k], xyz[k + 1], xyz[k + 2]);
  for (const Cells *cells : {&piece.polys, &piece.strips}) {
    if (cells->offsets == NONE)
      continue;
    const std::vector<double> &vertex = arrays_[cells->connectivity].values;
    const std::vector<double> &end = arrays_[cells->offsets].values;
    for (size_t c = 0, at = 0; c < end.size(); c++) {
      corners_.clear();
      for (; at < static_cast<size_t>(end[c]); at++)
        corners_.push_back(
            static_cast<uint32_t>(first + static_cast<size_t>(vertex[at])));
      if (cells == &piece.polys)
        give_polygon(c, piece);
      else
        give_strip();
    }
  }
}

void Vtp_reader::read() {
  scan_root();
  if (!n_faces_)
    file_.refuse(0, "holds no face");
  check_looks();
  check_arrays();
  for (const Piece &piece : pieces_) {
    check_offsets(piece.polys);
    check_offsets(piece.strips);
  }
  has_instances_ = has_instances();
  for (const Piece &piece : pieces_)
    give(piece);
}

} // namespace

void vtp_read(Mesh_file &file, Mesh_builder &builder) {
  skip_byte_order_mark(file);
  Vtp_reader(file, builder).read();
}

} // namespace hsr
