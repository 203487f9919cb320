// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .vtp files: VTK's XML of polygons and triangle strips.
//
// Source      "VTK XML Formats", docs.vtk.org; what it leaves open, from
//             vtkXMLPolyDataReader and vtkXMLDataParser of VTK 9.1
// Safety      VTK believes what it reads: sizes, counts, offsets. So it gets to
//             see no elements and attributes but those named below; all others
//             become spaces, and no byte moves. Every value of every array is
//             decoded and checked here first (common/files/vtk/xml_array.h).
// Departures  zlib is the only compressor; vertices and lines as cells are
//             refused; point and cell data, fields and time steps are not read,
//             but for the colours that hsr export writes: cell data "colour",
//             three bytes a polygon, which all pieces have or none; all pieces
//             have points of one type.
#include "common/files/vtk/xml_scan.h"

#include <cfloat>

namespace hsr {
namespace {

/* An element takes VTK 2 kB, and a piece has up to nine. */
constexpr size_t MOST_PIECES = 1000;
/* Deflate makes nothing more than 1032 times as small. */
constexpr size_t MOST_PACKED = 1032;

class Vtp_scan final : public Xml_scan {
public:
  explicit Vtp_scan(Mesh_file &file)
      : Xml_scan(file, {"PolyData", "polygonal data"}) {}
  Mesh_extent scan();

private:
  static constexpr size_t NONE = SIZE_MAX;
  struct Cells {
    size_t connectivity = NONE, offsets = NONE; /* which of arrays_[] */
  };

  void scan_data(Tag &tag) override;
  void piece(Tag &tag);
  void points(const Tag &tag, size_t n);
  void cells(const Tag &tag, size_t n, size_t n_points);
  void colours(const Tag &tag, size_t n);
  void check_offsets();

  Mesh_extent extent_;
  size_t n_pieces_ = 0, n_coloured_ = 0;
  const Array_type *type_of_points_ = nullptr;
  std::vector<Cells> cells_;
};

void Vtp_scan::scan_data(Tag &tag) {
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

  size_t n_found[4] = {0, 0, 0, 0};
  for (Tag child; markup_.child(tag, child);) {
    if (child.name == "Points" && ++n_found[0])
      points(child, n_points);
    else if (child.name == "Polys" && n_polys && ++n_found[1])
      cells(child, n_polys, n_points);
    else if (child.name == "Strips" && n_strips && ++n_found[2])
      cells(child, n_strips, n_points);
    else if (child.name == "CellData" && n_polys && !n_strips && !n_found[3]++)
      colours(child, n_polys);
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
    add_array(child,
              {"points", place, 3 * n, -DBL_MAX, DBL_MAX, Array::ANY_ORDER});
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
      add_array(child,
                {"offsets", place, n, 0, double{MOST_VALUES}, Array::RISING});
    else
      add_array(child, {"connectivity", place, Array::ANY, 0,
                        static_cast<double>(n_points - 1), Array::ANY_ORDER});
    if (arrays_.back().type->is_real)
      markup_.refuse(place, "'%s' is not of integers",
                     shown_word(*name).c_str());
  }
  if (cells.connectivity == NONE || cells.offsets == NONE)
    markup_.refuse(tag.text.data(), "'%s' lacks its connectivity or offsets",
                   shown_word(tag.name).c_str());
  cells_.push_back(cells);
}

/* sRGB, of each polygon. */
void Vtp_scan::colours(const Tag &tag, size_t n) {
  bool found = false;
  markup_.blank_others(tag);
  for (Tag child; markup_.child(tag, child);) {
    const Word *name = markup_.attribute(child, "Name");
    const Word *size = markup_.attribute(child, "NumberOfComponents");
    const Word *type = markup_.attribute(child, "type");
    if (found || child.name != "DataArray" || !name || *name != "colour" ||
        !size || *size != "3" || !type || *type != "UInt8") {
      markup_.skip(child);
      continue;
    }
    found = true;
    add_array(child, {"colours", child.text.data(), 3 * n, 0, UINT8_MAX,
                      Array::ANY_ORDER});
  }
  n_coloured_ += found;
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
  scan_root();
  if (!extent_.n_faces)
    file_.refuse(0, "holds no face");
  if (n_coloured_ && n_coloured_ < n_pieces_)
    file_.refuse(0,
                 "%zu of its %zu pieces have cell data 'colour'; all must, "
                 "or none",
                 n_coloured_, n_pieces_);
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
