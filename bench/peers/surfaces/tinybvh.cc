// SPDX-License-Identifier: GPL-3.0-or-later
// tinybvh: one ray for each sample, through its hierarchy of eight boxes a node.
//
// Vertices    floats, four for each corner of each triangle.
// Sides       Rays hit both sides of every face. If a closed solid lies in front of
//             the eye, no ray meets a back first. In parallel projection rays
//             begin on a plane, which may cut solids. If it cuts the scene, a ray
//             that meets the back of a one-sided face begins again behind it.
// Processor   tinybvh takes this hierarchy only with AVX2 and FMA.
#include "config.h"

#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/projection.h"
#include "common/scene/pieces.h"

#include <cstdio>
#include <new>
#include <vector>

#define TINYBVH_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <tiny_bvh.h>
#pragma GCC diagnostic pop

namespace {

struct Tinybvh {
  const hsr_world *world;
  uint32_t *ids;
  box bounds;
  std::vector<tinybvh::bvhvec4> corner; // 3 for each triangle
  tinybvh::BVH8_CPU tree;
};

void add_corners(Tinybvh &t) {
  const hsr_mesh &mesh = t.world->mesh;
  const size_t n = 3 * static_cast<size_t>(t.world->n_faces);
  t.corner.reserve(n);
  for (size_t c = 0; c < n; c++) {
    const uint32_t v = mesh.vertex[c];
    t.corner.emplace_back(static_cast<float>(mesh.x[v]),
                          static_cast<float>(mesh.y[v]),
                          static_cast<float>(mesh.z[v]), 0.f);
  }
}

hsr_status setup(const peer *, const peer_canvas *canvas, void **state,
                 hsr_error *err) {
  try {
    Tinybvh *t = new Tinybvh();
    *state = t;
    t->world = canvas->setup->world;
    t->ids = canvas->ids;
    t->bounds = box_of_world(t->world);
    if (!t->world->n_faces)
      return HSR_OK;
    add_corners(*t);
    t->tree.Build(t->corner.data(), t->world->n_faces);
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  }
}

// Whether parallel rays begin behind the nearest part of the scene's box.
bool begins_within(const Tinybvh &t, const hsr_view *view) {
  return view->parallel && box_nearest(&t.bounds, view) < view->near;
}

tinybvh::bvhvec3 vector_of(const double v[3]) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]),
          static_cast<float>(v[2])};
}

// Whether a ray of this direction meets the back of a one-sided triangle.
bool is_back(const hsr_mesh &mesh, uint32_t f, const double D[3]) {
  return mesh.one_sided[f] &&
         mesh.nx[f] * D[0] + mesh.ny[f] * D[1] + mesh.nz[f] * D[2] > 0;
}

uint32_t trace(const Tinybvh &t, const hsr_view *view, bool pass_backs, int i,
               int j) {
  const double sx = hsr_sample_x(view, i), sy = hsr_sample_y(view, j);
  double P[3], D[3];
  for (int k = 0; k < 3; k++) {
    const double across =
        view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    D[k] = view->parallel ? view->F[k] : across;
    P[k] =
        (view->parallel ? view->E[k] + across : view->E[k]) + view->near * D[k];
  }
  tinybvh::Ray ray(vector_of(P), vector_of(D));
  for (;;) {
    t.tree.Intersect(ray);
    if (!(ray.hit.t < BVH_FAR))
      return HSR_BACKGROUND;
    if (!pass_backs || !is_back(t.world->mesh, ray.hit.prim, D))
      return hsr_world_parent(t.world, ray.hit.prim);
    const float past = ray.hit.t * (1 + 0x1p-20f) + 0x1p-60f;
    ray = tinybvh::Ray(ray.O + past * ray.D, ray.D);
  }
}

hsr_status draw(void *state, const hsr_view *view, hsr_error *) {
  const Tinybvh &t = *static_cast<Tinybvh *>(state);
  const bool pass_backs = begins_within(t, view);
  for (int j = 0; j < view->n; j++)
    for (int i = 0; i < view->m; i++)
      t.ids[static_cast<size_t>(j) * static_cast<size_t>(view->m) +
            static_cast<size_t>(i)] =
          t.world->n_faces ? trace(t, view, pass_backs, i, j) : HSR_BACKGROUND;
  return HSR_OK;
}

void release(void *state) {
  delete static_cast<Tinybvh *>(state);
}

void version(char *text) {
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    snprintf(text, PEER_VERSION, "%d.%d.%d", TINY_BVH_VERSION_MAJOR,
             TINY_BVH_VERSION_MINOR, TINY_BVH_VERSION_SUB);
}

peer make_peer() {
  peer p{};
  p.name = "tinybvh";
  p.title = "tinybvh, single rays, eight boxes a node";
  p.source = "J. Bikker, tinybvh, https://github.com/jbikker/tinybvh; the "
             "traversal: V. Fuetterling et al., \"Accelerated Single Ray "
             "Tracing for Wide Vector Units\", HPG 2017";
  p.what = "Ray tracing, one ray at a time. A frame aims and traces a ray a "
           "sample and writes the ids. Set-up, which is not part of a frame, "
           "copies the corners as floats and builds the hierarchy of boxes.";
  p.kind = "ids";
  p.demands = &takes_triangles;
  p.version = version;
  p.setup = setup;
  p.draw = draw;
  p.release = release;
  return p;
}

} // namespace

extern const peer peer_tinybvh;
const peer peer_tinybvh = make_peer();
