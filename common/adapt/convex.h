// SPDX-License-Identifier: GPL-3.0-or-later
// Convex pieces of faces, and on which side of a plane they lie, in exact
// terms.
//
// Source      A polygon is known by the planes of its sides: J. Bernstein, D.
//             Fussell, "Fast, exact, linear booleans", Symposium on Geometry
//             Processing, 2009.
// Corner      where two sides meet: a vertex of the face, or the point where an
//             edge of the face or a cut meets another cut. So every corner is
//             known exactly by planes of the scene, however often a piece is
//             cut. Its coordinates are approximate, within `error`.
// Planes      are numbered by their class (common/scene/world.h). A plane faces
//             the way of the first face that lies in it. Many planes lie across
//             an axis: there one subtraction, whose sign is exact, gives the
//             side of a vertex. More planes across an axis may be added, and
//             may make cuts.
// Not flat    a face that is not flat keeps the corners of the whole face,
//             however it is cut. Their error is `reach`: as far as what is seen
//             of the face may be from them (common/scene/clusters.h). If that
//             leaves a side uncertain, it stays so.
#ifndef HSR_COMMON_CONVEX_H
#define HSR_COMMON_CONVEX_H

#include "common/adapt/division.h"
#include "common/adapt/heights.h"
#include "common/exact/exact_plane.h"

#include <memory>
#include <mutex>
#include <unordered_map>

namespace hsr {

// The point p / w.
template <class T> struct Homogeneous {
  Vector3<T> p;
  T w;
};

// A corner, and the side from it to the next one. The side lies on the edge
// from vertex a to b or, if b is NO_VERTEX, in plane a.
const uint32_t NO_VERTEX = UINT32_MAX;
struct Corner {
  Point at;
  double error; // of each coordinate
  uint32_t a, b;
  // The exact point, once it was asked for. Pieces with this corner share it.
  mutable std::shared_ptr<const Homogeneous<Exact>> exact{};
};

struct Convex {
  uint32_t from;   // the face of the world that it is, or is a piece of
  uint32_t parent; // that face's parent
  uint32_t plane;  // its class
  std::vector<Corner> corners;
  std::vector<hsr_cut> cuts; // `face` is a plane here
};

// Where a piece lies about a plane: it has points strictly in front of it, or
// strictly behind it. UNSURE: the piece is not flat, and the side is uncertain.
enum : unsigned { FRONT = 1, BEHIND = 2, BOTH = FRONT | BEHIND, UNSURE = 4 };

// A plane across an axis: x, y or z = at, and the side that is its front.
struct Level {
  size_t axis;
  double at;
  int front; // +1 where x, y or z is greater; 0: the plane is another
};

// It keeps the exact planes that were asked for. Several threads may ask on which
// side a piece is, or divide pieces of their own; one at a time has exact numbers.
class Convex_pieces {
public:
  // Pieces of the faces of `world`, which is borrowed.
  explicit Convex_pieces(const hsr_world &world);
  // The same planes, also those that are added to either, but none that is exact
  // yet: for a thread of its own. Pieces of both must share no exact corner.
  Convex_pieces(const Convex_pieces &other);
  Convex_pieces &operator=(const Convex_pieces &) = delete;

  // Adds the plane x, y or z = at, whose front is where the coordinate is
  // greater. Returns its number.
  uint32_t add_level(size_t axis, double at) {
    level_.push_back({axis, at, 1});
    return uint32_t(level_.size() - 1);
  }

  // Makes face f a piece. False if it has no point.
  bool make(uint32_t f, Convex &piece) const;

  // Whether the plane of face g of the scene passes through a piece. True also
  // if that is uncertain, as it may be if the piece is not flat.
  bool may_cross(const Piece &piece, uint32_t g) const;

  unsigned about(const Convex &piece, uint32_t plane) const;

  // The same of many pieces. Columns hold them, piece k from first[k] on. look()
  // finds what is known by doubles of each corner, and about() what follows for
  // piece k of the columns, which is `piece`.
  struct Columns {
    std::vector<double> at[3], error;
    std::vector<int64_t> vertex, known;
    std::vector<size_t> first;
    std::vector<uint32_t> plane;
    std::vector<bool> is_flat;
  };
  void clear(Columns &columns) const;
  void add(const Convex &piece, Columns &columns) const;
  void look(Columns &columns, uint32_t plane) const;
  unsigned about(const Convex &piece, const Columns &columns, size_t k,
                 uint32_t plane) const {
    if (columns.plane[k] == plane)
      return 0;
    int64_t known = 0;
    for (size_t c = columns.first[k]; c < columns.first[k + 1]; c++)
      known |= columns.known[c];
    const unsigned where = unsigned(known) & BOTH;
    return columns.is_flat[k] && (where == BOTH || !(known & HSR_IS_CLOSE))
               ? where
               : closely_about(piece, columns, k, plane);
  }

  // The part of a piece on one side of a plane. The piece has points on both
  // sides.
  Convex part(const Convex &piece, uint32_t plane, int side) const;

  // The piece in the terms of common/adapt/division.h. All its cuts must be by
  // planes of faces. Sets with_outline to whether its outline is of use.
  Piece finished(const Convex &piece, bool &with_outline) const;

  const Level &level(uint32_t plane) const { return level_[plane]; }
  // The first face in a plane, which is no added one.
  uint32_t face_of(uint32_t plane) const { return face_of_[plane]; }
  // +1 if the face's front is its plane's front, -1 if it is the back.
  int turned(uint32_t parent) const { return turned_[parent]; }
  double reach(uint32_t parent) const { return reach_[parent]; }
  bool is_flat(const Convex &piece) const {
    return whole_.mesh.deviation[piece.parent] == 0;
  }

private:
  struct Tables {
    std::vector<uint32_t> face_of;   // a plane: the first face in it
    std::vector<signed char> turned; // a face of whole_
    std::vector<double> reach;       // a face of whole_
    std::vector<Level> level;        // a plane
  };
  const hsr_world &world_, &whole_;
  const std::shared_ptr<Tables> tables_; // of all copies
  std::vector<uint32_t> &face_of_ = tables_->face_of;
  std::vector<signed char> &turned_ = tables_->turned;
  std::vector<double> &reach_ = tables_->reach;
  std::vector<Level> &level_ = tables_->level;
  mutable std::unordered_map<uint32_t, FacePlane<Exact>> exact_; // a plane
  mutable std::mutex has_exact_; // guards exact_ and exact corners

  const FacePlane<Exact> &exact_plane(uint32_t plane) const;
  const Homogeneous<Exact> &exact_corner(const Convex &piece, size_t k) const;
  template <class T> FacePlane<T> plane_of(uint32_t plane) const;
  template <class T>
  Homogeneous<T> corner_of(const Convex &piece, size_t k) const;
  bool make(const Piece &given, Convex &piece) const;
  hsr_rounded_plane rounded(uint32_t plane) const;
  unsigned closely_about(const Convex &piece, const Columns &columns, size_t k,
                         uint32_t plane) const;
  double height(uint32_t plane, const Corner &corner, double &error) const;
  int side(const Convex &piece, size_t k, uint32_t plane, bool &sure) const;
  bool is_within(const Corner &side, uint32_t plane) const;
  int exact_side(const Convex &piece, size_t k, uint32_t plane) const;
  void locate(const Convex &piece, size_t k, Corner &corner) const;
  void clip(Convex &piece, uint32_t plane, int side) const;
};

} // namespace hsr

#endif
