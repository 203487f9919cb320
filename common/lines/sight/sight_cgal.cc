// SPDX-License-Identifier: GPL-3.0-or-later
// Setting up a sight, and its exact services on images and depth.
#include "common/lines/sight/sight_numbers.h"

#include <cmath>
#include <new>

using namespace hsr::sight;
using hsr::Exact;
using hsr::Interval;

// --- Images ------------------------------------------------------------------

int hsr_sight_side_exact(const struct hsr_sight *sight, uint32_t c, uint32_t d,
                         uint32_t p) {
  const Numbers &n = *sight->numbers;
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> P = n.point<T>(p);
    return side_value(n, n.point<T>(c), n.point<T>(d), P, P.w, along);
  });
}

int hsr_sight_line_side_exact(const struct hsr_sight *sight, uint32_t a,
                              uint32_t b, uint32_t p) {
  const Numbers &n = *sight->numbers;
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> A = n.point<T>(a), B = n.point<T>(b), P = n.point<T>(p);
    if (along == VALUE)
      return det(A.p, B.p, P.p);
    return det(change<T>(n, along), A.w * B.p - B.w * A.p, P.p);
  });
}

int hsr_sight_row_side_exact(const struct hsr_sight *sight, uint32_t p,
                             uint32_t q) {
  const Numbers &n = *sight->numbers;
  const int sign = displaced_sign(n, HSR_ASK_ROW, [&](auto t, int along) {
    using T = decltype(t);
    return row_value(n, n.point<T>(p), n.point<T>(q), along);
  });
  return sign ? sign : 1;
}

// --- Depth -------------------------------------------------------------------

bool hsr_sight_behind(const struct hsr_sight *sight, uint32_t f, uint32_t p) {
  return height_sign(*sight->numbers, f, p) == -sight->facing[f];
}

bool hsr_sight_nearer(const struct hsr_sight *sight, uint32_t e, uint32_t c) {
  const Numbers &n = *sight->numbers;
  const hsr_edges *edges = sight->edges;
  const uint32_t a = edges->a[e], b = edges->b[e];
  // If A'B' is scaled from the eye until it meets the edge, this volume becomes
  // zero. Before that, its sign tells the side on which D lies.
  const int volume = displaced_sign(n, HSR_ASK_DEPTH, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> A = n.point<T>(a), B = n.point<T>(b);
    const Point<T> C = n.point<T>(edges->a[c]), D = n.point<T>(edges->b[c]);
    const vec<T> CD = cross(C.p, D.p);
    if (along == VALUE)
      return A.d * dot(CD, B.p) - B.d * dot(CD, A.p) +
             dot(cross(A.p, B.p), C.d * D.p - D.d * C.p);
    const vec<T> by = change<T>(n, along);
    return (A.d * B.w - B.d * A.w) * dot(CD, by) +
           dot(cross(by, A.w * B.p - B.w * A.p), C.d * D.p - D.d * C.p);
  });
  return volume && volume == hsr_sight_line_side(sight, a, b, edges->b[c]);
}

// The side of the line c d that edge e is on, close to its end p.
static int side_of_beginning(const hsr_sight *sight, uint32_t c, uint32_t d,
                             uint32_t p, uint32_t other) {
  double bound, turn = hsr_sight_turn(sight, c, d, other, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  const Numbers &n = *sight->numbers;
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    return side_value(n, n.point<T>(c), n.point<T>(d), n.point<T>(other),
                      n.point<T>(p).w, along);
  });
}

static int turn_of_corner(const hsr_sight *sight, uint32_t c, uint32_t d,
                          uint32_t p) {
  double bound, turn = hsr_sight_turn(sight, c, d, p, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  const Numbers &n = *sight->numbers;
  return sign_of(n, HSR_ASK_EDGE, [&](auto t) {
    using T = decltype(t);
    return det(n.point<T>(c).p, n.point<T>(d).p, n.point<T>(p).p);
  });
}

bool hsr_sight_corner_hides(const struct hsr_sight *sight, uint32_t e,
                            uint32_t p, struct hsr_corner corner) {
  const Numbers &n = *sight->numbers;
  const hsr_world *w = sight->world;
  const uint32_t f = corner.face, first = w->mesh.start[f],
                 last = w->mesh.start[f + 1];
  const uint32_t before =
      w->mesh.vertex[corner.k == first ? last - 1 : corner.k - 1];
  const uint32_t after =
      w->mesh.vertex[corner.k + 1 == last ? first : corner.k + 1];
  const uint32_t other =
      sight->edges->a[e] == p ? sight->edges->b[e] : sight->edges->a[e];
  const int inside = -sight->facing[f];
  const bool in_arriving =
      side_of_beginning(sight, before, p, p, other) == inside;
  const bool in_leaving =
      side_of_beginning(sight, p, after, p, other) == inside;
  const bool reflex = turn_of_corner(sight, before, p, after) == -inside;
  if (!(reflex ? in_arriving || in_leaving : in_arriving && in_leaving))
    return false;
  const int height = displaced_sign(n, HSR_ASK_VERTEX, [&](auto t, int along) {
    using T = decltype(t);
    return height_value(n, n.plane<T>(f), n.point<T>(other), n.point<T>(p).w,
                        along);
  });
  return height == -sight->facing[f];
}

// --- Setting up -------------------------------------------------------------

static void find_points(hsr_sight *sight) {
  const Numbers &n = *sight->numbers;
  for (uint32_t p = 0; p < sight->edges->n_points; p++)
    sight->ahead[p] = border_sign(n, NEAR, p) > 0;
}

static void find_faces(hsr_sight *sight) {
  const Numbers &n = *sight->numbers;
  const hsr_world *w = sight->world;
  for (uint32_t f = 0; f < w->n_faces; f++) {
    int facing = facing_sign(n, f);
    sight->exists[f] = facing > 0 || !w->mesh.one_sided[f];
    if (!sight->exists[f])
      facing = 0;
    sight->facing[f] = static_cast<signed char>(facing);
    bool regular = facing && sight->edges->simple[f];
    for (uint32_t k = w->mesh.start[f]; regular && k < w->mesh.start[f + 1];
         k++)
      regular = sight->ahead[w->mesh.vertex[k]];
    sight->regular[f] = regular;
    if (regular)
      sight->faces[sight->n_faces++] = f;
    else if (facing)
      sight->loose[sight->n_loose++] = f;
  }
}

// In parallel: q of all vertices.
static void find_depths(hsr_sight *sight) {
  const hsr_mesh &mesh = sight->world->mesh;
  const double *E = sight->view->E, *depth = sight->view->depth;
  double most = 0;
  for (uint32_t v = 0; v < mesh.n_vertices; v++) {
    const double at[3] = {mesh.x[v] - E[0], mesh.y[v] - E[1], mesh.z[v] - E[2]};
    double t = 0, size = 0;
    for (int k = 0; k < 3; k++) {
      t += depth[k] * at[k];
      size += std::fabs(depth[k] * at[k]);
    }
    sight->q[v] = -t;
    most = std::max(most, size);
  }
  sight->q_error = 0x1p-49 * most + 0x1p-960;
}

static hsr_status make_arrays(hsr_sight *sight, hsr_arena *arena) {
  const size_t np = sight->edges->n_points, nf = sight->world->n_faces;
  const auto array = [&](size_t n, size_t size) {
    return hsr_arena_array(arena, n, size);
  };
  sight->sx = static_cast<double *>(array(np, sizeof(double)));
  sight->sy = static_cast<double *>(array(np, sizeof(double)));
  sight->q = static_cast<double *>(array(np, sizeof(double)));
  sight->ahead = static_cast<bool *>(array(np, sizeof(bool)));
  sight->exists = static_cast<bool *>(array(nf, sizeof(bool)));
  sight->facing = static_cast<signed char *>(array(nf, 1));
  sight->regular = static_cast<bool *>(array(nf, sizeof(bool)));
  sight->faces = static_cast<uint32_t *>(array(nf, sizeof(uint32_t)));
  sight->loose = static_cast<uint32_t *>(array(nf, sizeof(uint32_t)));
  return sight->sx && sight->sy && sight->q && sight->ahead && sight->exists &&
                 sight->facing && sight->regular && sight->faces && sight->loose
             ? HSR_OK
             : HSR_E_NOMEM;
}

enum hsr_status hsr_sight_init(struct hsr_sight *sight,
                               const struct hsr_edges *edges,
                               const struct hsr_view *view,
                               struct hsr_arena *arena,
                               struct hsr_tally *tally) {
  *sight = hsr_sight();
  sight->edges = edges;
  sight->world = edges->world;
  sight->view = view;
  sight->tally = tally;
  hsr_screen screen;
  if (make_arrays(sight, arena) ||
      hsr_screen_init(&screen, edges->world, view, arena))
    return HSR_E_NOMEM;
  hsr_screen_vertices(&screen);
  std::copy(screen.sx, screen.sx + edges->world->mesh.n_vertices, sight->sx);
  std::copy(screen.sy, screen.sy + edges->world->mesh.n_vertices, sight->sy);
  std::copy(screen.q, screen.q + edges->world->mesh.n_vertices, sight->q);
  if (view->parallel)
    find_depths(sight);
  for (uint32_t p = edges->world->mesh.n_vertices; p < edges->n_points; p++)
    sight->sx[p] = sight->sy[p] = sight->q[p] = NAN;
  try {
    sight->numbers = new hsr_sight_numbers();
    Numbers &n = *sight->numbers;
    n.sight = sight;
    const int s = CGAL::sign(
        det(lift<Exact>(view->F), lift<Exact>(view->R), lift<Exact>(view->U)));
    n.exact.set(*view, s);
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      n.rough.set(*view, s);
    }
    n.find_rough();
  } catch (...) {
    return HSR_E_NOMEM;
  }
  find_points(sight);
  find_faces(sight);
  return tally->out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

void hsr_sight_free(struct hsr_sight *sight) {
  delete sight->numbers;
  sight->numbers = nullptr;
}
