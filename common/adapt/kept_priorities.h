// SPDX-License-Identifier: GPL-3.0-or-later
// Priorities within clusters, kept from frame to frame while clusters move.
//
// Source      Sutherland et al. 1974, on Schumacker et al. 1969: he "will
//             tolerate motion of clusters in the environment provided they
//             remain linearly separable". The face priorities are a property of
//             the cluster alone; the cluster priority is computed again in every
//             frame.
// Frames      one scene, whose instances may be in other places in each frame.
//             Separating planes are found anew in each: none is transformed.
// Stands      a group of pieces of which nothing has moved since the last frame,
//             nor what cuts them, has the ranking that it had then.
// Moves       A group of whole triangles of one instance is known by the faces
//             of its object. Its ranking holds for all instances of the object,
//             wherever they are placed, if it would hold for every group whose
//             points are within SLACK of the object's.
//             Why: a place is an affine map M with a positive determinant, and
//             each coordinate is rounded. So a placed vertex is M (v + r), with
//             |r| at most the rounding error times |1 / M|. M leaves all points
//             on the sides of planes where they were. If |r| <= SLACK, the
//             placed group is the exact image of one of those.
// Steady      Let a vertex v be off the plane of the triangle a by a
//             determinant of more than 37 SLACK size^2, where size is the
//             greatest extent of the group. Then it is on the same side for all
//             of them: each of the six products of three differences changes by
//             at most 6 SLACK (size + 2 SLACK)^2. A corner that both triangles
//             have stays on both planes. And two triangles that share an edge,
//             seen from the same side, never hide one another: both are in front
//             of one another's planes or both behind.
// Close       Pairs of faces of which that does not tell whether one hides the
//             other: they touch, or are in one plane. They are compared anew in
//             every frame, exactly; first those of which the lower one may come
//             to hide the higher one. If it does, the group is sorted anew, by
//             what is steady and by comparing the close pairs. If there is a
//             circuit now, as rounding has made faces that touch penetrate, the
//             group is divided.
// Exact       If no coordinate is rounded, the placed group is the exact image of
//             the object's. An order that held in one such frame holds in all:
//             not even the close pairs are compared.
// Forgotten   A group that has not been of use in MOST_IDLE frames is forgotten.
// Not kept    Groups with cuts that move, and groups of several instances. They
//             are compared anew.
#ifndef HSR_COMMON_KEPT_PRIORITIES_H
#define HSR_COMMON_KEPT_PRIORITIES_H

#include "common/adapt/priority_graph.h"

#include <map>

namespace hsr {

// What the priority graph of a group tells. Members are places in the group. The
// number 2 k is member k as seen from its front, 2 k + 1 as seen from behind.
struct Ranking {
  bool has_order = false;
  std::vector<uint32_t> order, thick; // by descending priority; in no order
  std::vector<uint32_t> circuits; // the members to blame, if it has no order
};

using Key = std::vector<uint32_t>;

} // namespace hsr

// What is kept of the frames of a scene.
struct hsr_kept_priorities {
  // A group that may move. Its nodes are the oriented members.
  struct Own {
    double size = 0;
    bool is_exact = false; // the order holds where nothing is rounded
    uint64_t used = 0;     // the last frame in which it was of use
    std::vector<uint32_t> nodes;
    std::vector<uint8_t>
        about; // of two members: where the first lies about the
               // plane of the second, steadily
    std::vector<uint32_t> order; // by descending priority; empty: none
    std::vector<std::pair<uint32_t, uint32_t>> close; // of it: lower, higher
  };
  std::map<hsr::Key, hsr::Ranking> last, now; // of that frame and this
  std::map<hsr::Key, Own> own;                // of groups that may move
  std::vector<double> places;                 // of the instances, last frame
  uint32_t n_faces = 0;
  uint64_t frame = 0; // counted from the first one
};

namespace hsr {

// One frame. Everything is borrowed.
class Kept_frame {
public:
  Kept_frame(hsr_kept_priorities &kept, const hsr_world &world,
             const Convex_pieces &shapes, const std::vector<Convex> &pieces);

  // Finds the ranking of a group, if it is known from an earlier frame, or of
  // another instance.
  bool recall(const Group &group, Ranking &ranking);

  // Keeps the ranking of a group. Of equally right orders it may choose another,
  // of which more is steady.
  void keep(const Group &group, Priority_graph &graph, Ranking &ranking);

  // Ends the frame: the next one begins with what is kept.
  void end();

  uint64_t n_kept() const { return n_kept_; }   // oriented faces
  uint64_t n_close() const { return n_close_; } // pairs compared anew

private:
  hsr_kept_priorities &kept_;
  const hsr_world &world_, &whole_;
  const Convex_pieces &shapes_;
  const std::vector<Convex> &pieces_;
  std::vector<bool> moved_;   // by instance
  std::vector<double> slack_; // by instance; negative: not known yet
  uint64_t n_kept_ = 0, n_close_ = 0;

  uint32_t instance_of(uint32_t parent) const {
    return whole_.mesh.instance[parent];
  }
  bool may_move(const Group &group) const;
  bool has_moved(const Group &group) const;
  Key key_of(const Group &group) const;
  Key own_key_of(const Group &group) const;
  double slack_of(uint32_t instance);
  bool hides(const Group &group, uint32_t a, uint32_t b) const;
  bool recall_own(const Group &group, Ranking &ranking);
  bool know(const Group &group, hsr_kept_priorities::Own &own);
};

} // namespace hsr

#endif
