/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/lines/clipped.h"

#include "bench/peers/lines/lines.h"

#include <algorithm>
#include <cmath>

uint64_t pair_of(uint32_t a, uint32_t b) {
  return uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

namespace {

bool is_in_picture(const struct hsr_view *view, const double image[3]) {
  double w = hsr_view_w(view, image);
  return image[0] >= 0 && image[0] <= w * view->m && image[1] >= 0 &&
         image[1] <= w * view->n;
}

void place_vertices(std::vector<Corner> &corner, const struct hsr_mesh &mesh,
                    const struct hsr_view *view) {
  double least = INFINITY, farthest = 0;
  for (uint32_t v = 0; v < mesh.n_vertices; v++) {
    Corner c = {};
    c.place[0] = mesh.x[v], c.place[1] = mesh.y[v], c.place[2] = mesh.z[v];
    c.a = c.b = UINT32_MAX;
    hsr_view_project(view, c.place, c.image);
    farthest = std::max(farthest, c.image[2]);
    if (c.image[2] > 0 && is_in_picture(view, c.image))
      least = std::min(least, c.image[2]);
    corner.push_back(c);
  }
  double nearest = view->near;
  if (!view->parallel)
    nearest = std::max(nearest, std::min(least / 2, farthest / 1000));
  for (Corner &c : corner)
    c.depth = c.image[2] - nearest;
}

using Cuts = std::unordered_map<uint64_t, uint32_t>; /* of edges, by ends */

/* The corner at which the edge from a to b is cut. */
uint32_t cut_of(std::vector<Corner> &corner, Cuts &cuts, uint32_t a,
                uint32_t b) {
  auto found = cuts.emplace(pair_of(a, b), corner.size());
  if (!found.second)
    return found.first->second;
  Corner c = {};
  c.a = std::min(a, b), c.b = std::max(a, b);
  const Corner &from = corner[c.a], &to = corner[c.b];
  c.t = from.depth / (from.depth - to.depth);
  for (int k = 0; k < 3; k++) {
    c.place[k] = from.place[k] + c.t * (to.place[k] - from.place[k]);
    c.image[k] = from.image[k] + c.t * (to.image[k] - from.image[k]);
  }
  corner.push_back(c);
  return found.first->second;
}

/* What lies of a face beyond the nearest plane. */
std::vector<uint32_t> clip_face(std::vector<Corner> &corner, Cuts &cuts,
                                const uint32_t *vertex, uint32_t n) {
  std::vector<uint32_t> kept;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t a = vertex[k], b = vertex[(k + 1) % n];
    bool in = corner[a].depth > 0;
    if (in)
      kept.push_back(a);
    if (in != (corner[b].depth > 0))
      kept.push_back(cut_of(corner, cuts, a, b));
  }
  return kept;
}

/* 1/t or, in parallel, -t: it is linear on the screen. */
double height_of(const Corner &c, const struct hsr_view *view) {
  return view->parallel ? -c.image[2] : 1 / c.image[2];
}

void transform(Clipped &clipped, const struct hsr_view *view) {
  double least = INFINITY, most = -INFINITY;
  for (const ClippedFace &face : clipped.face)
    for (uint32_t c : face.corner) {
      least = std::min(least, height_of(clipped.corner[c], view));
      most = std::max(most, height_of(clipped.corner[c], view));
    }
  double scale = most > least ? view->m / (most - least) : 1;
  for (Corner &c : clipped.corner) {
    c.weight = hsr_view_w(view, c.image);
    c.point[0] = c.image[0] / c.weight;
    c.point[1] = -c.image[1] / c.weight;
    c.point[2] = scale * (height_of(c, view) - least);
  }
}

} // namespace

Clipped clip_world(const struct hsr_world *world, const struct hsr_view *view) {
  Clipped clipped;
  Cuts cuts;
  const struct hsr_mesh &mesh = world->mesh;
  place_vertices(clipped.corner, mesh, view);
  for (uint32_t f = 0; f < world->n_faces; f++) {
    if (!lines_face_exists(world, view, f))
      continue;
    ClippedFace face = {f, clip_face(clipped.corner, cuts,
                                     mesh.vertex + mesh.start[f],
                                     mesh.start[f + 1] - mesh.start[f])};
    if (!face.corner.empty())
      clipped.face.push_back(face);
  }
  transform(clipped, view);
  return clipped;
}
