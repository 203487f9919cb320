// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of pieces, from which the adapters make a world of pieces.
#ifndef HSR_COMMON_DIVISION_H
#define HSR_COMMON_DIVISION_H

#include "common/adapt/adapt.h"

#include <array>
#include <new>
#include <vector>

namespace hsr {

using Point = std::array<double, 3>;

// A piece of a face (common/scene/pieces.h).
struct Piece {
  uint32_t parent;            // the face of the whole world
  std::vector<uint32_t> loop; // vertices of the whole world
  std::vector<hsr_cut> cuts;  // `face` is a face of the whole world
  std::vector<Point> outline; // empty: only the loop is known
};

// Thrown for a face that cannot be adapted.
struct Not_adapted {
  unsigned restriction; // HSR_TR, ...
  uint32_t face;        // its id
  const char *why;      // a clause: the text is "face id 7 " and this
};

// The world that was divided into the pieces of `world`; else `world` itself.
inline const hsr_world &whole_of(const hsr_world &world) {
  return world.pieces ? *world.pieces->whole : world;
}

// Vertex v of a world.
inline Point point_of(const hsr_world &world, uint32_t v) {
  return {world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]};
}

// Face f of any world as a piece of a face of the scene's world.
inline Piece piece_of(const hsr_world &world, uint32_t f) {
  Piece piece;
  piece.parent = hsr_world_parent(&world, f);
  piece.loop.assign(world.mesh.vertex + world.mesh.start[f],
                    world.mesh.vertex + world.mesh.start[f + 1]);
  if (const hsr_pieces *p = world.pieces) {
    for (uint32_t c = p->cut_start[f]; c < p->cut_start[f + 1]; c++)
      piece.cuts.push_back({p->parent[p->cut[c].face], p->cut[c].side});
    for (uint32_t k = p->outline_start[f]; k < p->outline_start[f + 1]; k++)
      piece.outline.push_back(point_of(world, p->outline[k]));
  }
  return piece;
}

// Pieces in flat arrays.
class List {
public:
  // Appends a copy of a piece, without its outline unless with_outline.
  void add(const Piece &piece, bool with_outline) {
    parent_.push_back(piece.parent);
    vertex_.insert(vertex_.end(), piece.loop.begin(), piece.loop.end());
    start_.push_back(uint32_t(vertex_.size()));
    cut_.insert(cut_.end(), piece.cuts.begin(), piece.cuts.end());
    cut_start_.push_back(uint32_t(cut_.size()));
    if (with_outline)
      for (const Point &p : piece.outline)
        outline_.insert(outline_.end(), p.begin(), p.end());
    outline_start_.push_back(uint32_t(outline_.size() / 3));
  }

  // The number of pieces.
  size_t size() const { return parent_.size(); }

  // Makes a world of the pieces, as hsr_world_of_pieces does.
  hsr_status make(hsr_world *out, const hsr_world &whole,
                  hsr_error *err) const {
    const hsr_piece_list list = {
        uint32_t(parent_.size()), parent_.data(),    start_.data(),
        vertex_.data(),           cut_start_.data(), cut_.data(),
        outline_start_.data(),    outline_.data()};
    return hsr_world_of_pieces(out, &whole, &list, err);
  }

private:
  std::vector<uint32_t> parent_, start_{0}, vertex_, cut_start_{0},
      outline_start_{0};
  std::vector<hsr_cut> cut_;
  std::vector<double> outline_;
};

// Returns the status of body(), which may throw. Turns exceptions into errors:
// HSR_E_REFUSED, HSR_E_NOMEM, HSR_E_INTERNAL.
template <class Body> hsr_status guarded(hsr_error *err, const Body &body) {
  try {
    return body();
  } catch (const Not_adapted &refused) {
    return hsr_fail(err, HSR_E_REFUSED, "%s: face id %u %s",
                    hsr_restriction_code(refused.restriction), refused.face,
                    refused.why);
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "adapting the scene failed");
  }
}

// Returns face f of a scene as convex polygons through its vertices: the face
// itself if it is convex, else triangles. The face must be flat and must not
// cross itself.
std::vector<std::vector<uint32_t>> convex_loops(const hsr_world &world,
                                                uint32_t f);

// The adapters that make clusters and give them priorities, as
// hsr_adapter::adapt.
hsr_status cluster(const hsr_world *in, hsr_world *out, bool *changed,
                   hsr_error *err);
hsr_status give_priorities(const hsr_world *in, hsr_world *out, bool *changed,
                           hsr_error *err);
// The same, as hsr_adapter::follow; `kept` may be NULL.
hsr_status keep_priorities(const hsr_world *in, hsr_kept_priorities *kept,
                           hsr_world *out, bool *changed, hsr_error *err);

} // namespace hsr

#endif
