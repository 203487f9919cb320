// SPDX-License-Identifier: GPL-3.0-or-later
// Masked Occlusion Culling, Intel's software culler: it draws no picture, but
// tells what need not be drawn.
//
// Source      J. Hasselgren, M. Andersson and T. Akenine-Moeller, "Masked Software
//             Occlusion Culling", HPG 2016. Our own hzbuffer has its pyramid as
//             `pyramid=masked`.
// Groups      A program culls objects. Ours are groups of at most 32 faces
//             that lie together (culler_groups.h), since many scenes are one
//             object.
// A frame     The groups are taken from front to back, by the nearest corners of
//             their boxes. The box of each is tested. If it may be seen, the
//             group's triangles are drawn into the culler's buffer.
// Sides       The culler drops the backs of one-sided triangles itself.
// Judged      against the oracle's picture. A group is wrong if the culler calls it
//             hidden and one of its faces is visible at a sample.
// Refused     parallel projection: the culler compares 1/w. And pictures whose
//             width is no multiple of 8 or whose height is none of 4: its buffer
//             would have other samples than the picture.
#include "config.h"

#include "algorithms/setup.h"
#include "bench/modules/modules.h"
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/projection.h"
#include "bench/peers/surfaces/culler_groups.h"
#include "common/answers/kinds/ids.h"
#include "common/scene/pieces.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include <MaskedOcclusionCulling.h>
#pragma GCC diagnostic pop

namespace {

using culler::Group;
using Masked = MaskedOcclusionCulling;

enum { MOST = 32 }; // faces of a group

struct Culler {
  const hsr_world *world;
  culler::Groups groups;
  std::vector<float> xyz;      // of the vertices
  std::vector<unsigned> index; // 3 for each of groups.triangle
  std::vector<double> depth;   // of each group, its nearest
  std::vector<uint32_t> order; // of the groups, front to back
  std::vector<bool> may_be_seen;
  Masked *masked = nullptr;

  ~Culler() {
    if (masked)
      Masked::Destroy(masked);
  }
};

void add_mesh(Culler &c) {
  const hsr_mesh &mesh = c.world->mesh;
  for (size_t v = 0; v < mesh.n_vertices; v++)
    for (const double *axis : {mesh.x, mesh.y, mesh.z})
      c.xyz.push_back(static_cast<float>(axis[v]));
  for (const uint32_t f : c.groups.triangle)
    for (uint32_t k = mesh.start[f]; k < mesh.start[f + 1]; k++)
      c.index.push_back(mesh.vertex[k]);
}

hsr_status setup(const peer *, const peer_canvas *canvas, void **state,
                 hsr_error *err) {
  try {
    Culler *c = new Culler();
    *state = c;
    c->world = canvas->setup->world;
    c->groups = culler::make_groups(c->world, MOST);
    add_mesh(*c);
    const size_t n = c->groups.group.size();
    c->depth.resize(n);
    c->may_be_seen.resize(n);
    for (uint32_t g = 0; g < n; g++)
      c->order.push_back(g);
    c->masked = Masked::Create();
    if (!c->masked)
      return hsr_fail_nomem(err);
    if (canvas->m % 8 || canvas->n % 4)
      return hsr_fail(err, HSR_E_REFUSED,
                      "masked-culling: a width that is no multiple of 8, or a "
                      "height that is none of 4");
    c->masked->SetResolution(static_cast<unsigned>(canvas->m),
                             static_cast<unsigned>(canvas->n));
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  }
}

// --- A frame -----------------------------------------------------------------

double corner(const box &bounds, int which, int axis) {
  return which >> axis & 1 ? bounds.high[axis] : bounds.low[axis];
}

void sort_groups(Culler &c, const hsr_view *view) {
  for (size_t g = 0; g < c.groups.group.size(); g++)
    c.depth[g] = box_nearest(&c.groups.group[g].bounds, view);
  std::sort(c.order.begin(), c.order.end(), [&](uint32_t a, uint32_t b) {
    return c.depth[a] < c.depth[b] || (c.depth[a] == c.depth[b] && a < b);
  });
}

// Whether the box of a group is hidden or outside of the picture. A box that
// reaches before the near plane is not tested.
bool is_culled(const Masked &masked, const Group &g, const double matrix[16],
               double near) {
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  double least = INFINITY, most = -INFINITY;
  for (int which = 0; which < 8; which++) {
    double at[4];
    for (int r = 0; r < 4; r++) {
      at[r] = matrix[12 + r];
      for (int k = 0; k < 3; k++)
        at[r] += matrix[4 * k + r] * corner(g.bounds, which, k);
    }
    least = std::min(least, at[3]);
    most = std::max(most, at[3]);
    x0 = std::min(x0, at[0] / at[3]);
    x1 = std::max(x1, at[0] / at[3]);
    y0 = std::min(y0, at[1] / at[3]);
    y1 = std::max(y1, at[1] / at[3]);
  }
  if (most <= near)
    return true;
  if (least <= near)
    return false;
  return masked.TestRect(static_cast<float>(x0), static_cast<float>(y0),
                         static_cast<float>(x1), static_cast<float>(y1),
                         static_cast<float>(least)) != Masked::VISIBLE;
}

hsr_status draw(void *state, const hsr_view *view, hsr_error *err) {
  Culler &c = *static_cast<Culler *>(state);
  if (view->parallel)
    return hsr_fail(err, HSR_E_REFUSED,
                    "masked-culling: parallel projection has no 1/w");
  double matrix[16];
  float rounded[16];
  clip_matrix(view, view->near, 2 * view->near + 1, matrix);
  std::copy_n(matrix, 16, rounded);
  c.masked->SetNearClipPlane(static_cast<float>(view->near));
  c.masked->ClearBuffer();
  sort_groups(c, view);
  const Masked::VertexLayout layout(12, 4, 8);
  for (const uint32_t k : c.order) {
    const Group &g = c.groups.group[k];
    c.may_be_seen[k] = !is_culled(*c.masked, g, matrix, view->near);
    if (c.may_be_seen[k])
      c.masked->RenderTriangles(
          c.xyz.data(), &c.index[3 * size_t(g.first)], static_cast<int>(g.n),
          rounded, g.one_sided ? Masked::BACKFACE_CCW : Masked::BACKFACE_NONE,
          Masked::CLIP_PLANE_ALL, layout);
  }
  return HSR_OK;
}

// --- The judge ---------------------------------------------------------------

// Which faces of the scene the oracle shows.
hsr_status find_visible(const hsr_world *world, const hsr_view *view,
                        std::vector<bool> &visible, hsr_error *err) {
  const size_t n = static_cast<size_t>(view->m) * static_cast<size_t>(view->n);
  std::vector<uint32_t> ids(n);
  hsr_setup right;
  hsr_arena scratch = HSR_ARENA_EMPTY;
  hsr_tally tally{};
  hsr_answer answer = hsr_answer_of_ids(ids.data(), view->m, view->n);
  hsr_job job{};
  job.view = view;
  job.scratch = &scratch;
  job.tally = &tally;
  job.answer = &answer;
  hsr_status status = hsr_setup_init(
      &right, hsr_algorithm_find("oracle")->plain, nullptr, world, err);
  if (!status)
    status = hsr_setup_render(&right, &job, err);
  hsr_setup_free(&right);
  hsr_arena_free(&scratch);
  for (const uint32_t id : ids)
    if (!status && id != HSR_BACKGROUND)
      visible[id] = true;
  return status;
}

hsr_status judge(void *state, const hsr_view *view, json_t **verdict,
                 hsr_error *err) {
  const Culler &c = *static_cast<Culler *>(state);
  json_int_t wrong = 0, drawn = 0, needed = 0, left = 0;
  try {
    std::vector<bool> visible(c.world->n_faces); // there are no fewer triangles
    if (const hsr_status status = find_visible(c.world, view, visible, err))
      return status;
    for (size_t k = 0; k < c.groups.group.size(); k++) {
      const Group &g = c.groups.group[k];
      bool shows = false;
      for (uint32_t t = g.first; t < g.first + g.n && !shows; t++)
        shows = visible[hsr_world_parent(c.world, c.groups.triangle[t])];
      wrong += shows && !c.may_be_seen[k];
      needed += shows;
      drawn += c.may_be_seen[k];
      left += c.may_be_seen[k] ? g.n : 0;
    }
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  }
  *verdict = json_pack(
      "{sI sI sI sI sI sI}", "compared",
      static_cast<json_int_t>(c.groups.group.size()), "mismatches", wrong,
      "may_be_seen", drawn, "visible", needed, "triangles",
      static_cast<json_int_t>(c.groups.triangle.size()), "left", left);
  return *verdict ? HSR_OK : hsr_fail_nomem(err);
}

void release(void *state) {
  delete static_cast<Culler *>(state);
}

void version(char *text) {
  Masked *masked = Masked::Create();
  if (!masked)
    return;
  const Masked::Implementation built = masked->GetImplementation();
  strcpy(text, built == Masked::AVX512 ? "AVX-512"
               : built == Masked::AVX2 ? "AVX2"
                                       : "SSE");
  Masked::Destroy(masked);
}

peer make_peer() {
  peer p{};
  p.name = "masked-culling";
  p.title = "Masked Occlusion Culling, which tells what is hidden";
  p.source = "J. Hasselgren, M. Andersson and T. Akenine-Moeller, \"Masked "
             "Software Occlusion Culling\", HPG 2016; "
             "https://github.com/GameTechDev/MaskedOcclusionCulling";
  p.what = "Culling alone, without a picture: groups of at most 32 faces "
           "are sorted by depth, the box of each is tested, and those that may "
           "be seen are drawn into its buffer. Set-up, which is not part of a "
           "frame, makes the groups and copies the vertices as floats. A group "
           "is wrong if it is called hidden and shows a face.";
  p.kind = "groups";
  p.demands = &takes_triangles;
  p.version = version;
  p.setup = setup;
  p.draw = draw;
  p.judge = judge;
  p.release = release;
  return p;
}

} // namespace

extern const peer peer_masked_culling;
const peer peer_masked_culling = make_peer();
