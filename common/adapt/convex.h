// SPDX-License-Identifier: GPL-3.0-or-later
// Convex pieces of faces, and the exact side of a plane on which they lie.
//
// Source      J. Bernstein, D. Fussell, "Fast, exact, linear booleans",
//             Symposium on Geometry Processing, 2009: a polygon is represented
//             by the planes of its sides.
// Corner      two sides meet at a corner. It is a vertex of the face, or the
//             point where an edge of the face or a cut meets another cut. So
//             planes of the scene define every corner exactly, however often a
//             piece is cut. Its coordinates are approximate, within `error`.
// Planes      a plane's number is its class (common/scene/world.h). Its front
//             is that of the first face that lies in it. Many planes lie across
//             an axis. For these, the sign of one subtraction is the exact side
//             of a vertex. More planes across an axis may be added, to cut
//             pieces.
// Not flat    a face that is not flat keeps the corners of the whole face,
//             however it is cut. Their error is `reach`, the greatest distance
//             of a drawn point of the face from their hull
//             (common/scene/clusters.h). If that leaves a side uncertain, the
//             side is UNSURE.
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

// A corner, and the side from it to the next corner. The side lies on the edge
// from vertex a to vertex b or, if b is NO_VERTEX, in plane a.
const uint32_t NO_VERTEX = UINT32_MAX;
struct Corner {
  Point at;
  double error; // of each coordinate
  uint32_t a, b;
  // The exact point, if it has been computed. Pieces with this corner share it.
  mutable std::shared_ptr<const Homogeneous<Exact>> exact{};
};

// A convex piece of a face.
struct Convex {
  uint32_t from;   // the face of the world of which it is a piece, or all
  uint32_t parent; // that face's parent
  uint32_t plane;  // the class of its plane
  std::vector<Corner> corners;
  std::vector<hsr_cut> cuts; // `face` is a plane here
};

// The sides of a plane on which a piece has points, strictly. UNSURE: the piece
// is not flat, and the side is not certain. 0: all points are on the plane.
enum : unsigned { FRONT = 1, BEHIND = 2, BOTH = FRONT | BEHIND, UNSURE = 4 };

// A plane across an axis, where the coordinate `axis` is `at`.
struct Level {
  size_t axis;
  double at;
  int front; // +1: its front is where the coordinate is greater; -1: where it
             // is less; 0: the plane is not across an axis
};

// The planes of a world, and the questions about them. It caches exact planes
// and exact corners. Several threads may ask for the sides of pieces, and may
// divide pieces of their own. A lock lets one of them at a time use exact
// numbers. All functions may throw std::bad_alloc.
class Convex_pieces {
public:
  // `world` is laid out, perhaps of pieces, and borrowed.
  explicit Convex_pieces(const hsr_world &world);
  // A copy, for a thread of its own. It shares the planes, also those that are
  // added to either later. It starts with an empty cache. The pieces of both
  // must share no exact corner.
  Convex_pieces(const Convex_pieces &other);
  Convex_pieces &operator=(const Convex_pieces &) = delete;

  // Adds the plane where coordinate `axis` is `at`. Its front is where the
  // coordinate is greater. Returns its number.
  uint32_t add_level(size_t axis, double at) {
    level_.push_back({axis, at, 1});
    return uint32_t(level_.size() - 1);
  }

  // Sets `piece` to face f of the world, which is convex. False if that is a
  // piece without any point.
  bool make(uint32_t f, Convex &piece) const;

  // Whether the plane of face g of the scene passes through a piece. True also
  // if that is uncertain, as it may be if the piece is not flat.
  bool may_cross(const Piece &piece, uint32_t g) const;

  // Returns the sides of a plane on which the piece lies: FRONT, BEHIND, UNSURE
  // or several of them.
  unsigned about(const Convex &piece, uint32_t plane) const;

  // The same for many pieces and one plane. Columns hold the corners of the
  // pieces; those of piece k begin at first[k]. clear() empties them, and add()
  // appends a piece. look() finds the side of each corner in doubles. about()
  // returns the sides of piece k, which is `piece`.
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

  // Returns the part of a piece on one side of a plane, +1 in front or -1
  // behind. The piece must have points on both sides.
  Convex part(const Convex &piece, uint32_t plane, int side) const;

  // Returns the piece as a Piece of common/adapt/division.h. All its cuts must
  // be by planes of faces. Sets with_outline to whether its outline is of use.
  Piece finished(const Convex &piece, bool &with_outline) const;

  const Level &level(uint32_t plane) const { return level_[plane]; }
  // The first face of the scene in a plane that was not added.
  uint32_t face_of(uint32_t plane) const { return face_of_[plane]; }
  // +1 if the front of the face is that of its plane, else -1.
  int turned(uint32_t parent) const { return turned_[parent]; }
  // See "Not flat"; world units; 0 if the face is flat.
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
