/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Line drawings against pictures: the surface oracle is asked about points of
 * each interval of a drawing. At a point of a visible interval it must see
 * nothing nearer than the edge; at a point of a hidden one, something nearer.
 *
 * Beside     A sample cannot lie on an edge. In the definition it is displaced
 *            by a little to the right and by less down. Here the displacement
 *            is BESIDE and BESIDE^2 pixels, and only intervals much longer than
 *            that are checked.
 * Own        If the edge lies in a face's plane, that face does not hide it,
 *            and the sample may see that face. If the edge is off that plane by
 *            roundings only, the face may exactly hide the edge, and yet not be
 *            in front of it at the sample. Such points are not decided; they
 *            are counted.
 *
 * usage: lines_and_surfaces_test [SCENE...] */
#include "bench/modules/modules.h"
#include "common/answers/kinds/segments.h"
#include "common/exact/predicates.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 512, N = 384, POINTS = 100 };
static const double BESIDE = 0x1p-14;         /* pixels */
static const double SHORTEST = 400 * 0x1p-14; /* pixels */
static const double SAME_DEPTH = 1e-6;        /* of the depth */

static const char *const standard[] = {
    "house",           "penetration",   "cyclic-overlap", "coplanar",
    "nested-solids",   "one-sided",     "t-junction",     "shared-edges",
    "collinear-edges", "non-convex",    "behind-eye",     "near-plane",
    "eye-in-plane",    "sub-pixel-gap", "soup:40:1"};

struct asked {
  const struct hsr_world *world;
  const struct hsr_setup *oracle;
  struct hsr_view view;
  struct hsr_arena scratch;
  struct hsr_tally tally;
  uint32_t *ids;
  uint64_t points, wrong, undecided;
};

/* The place of a point on the screen; w is its depth. */
static void project(const struct hsr_view *view, const double p[3], double *sx,
                    double *sy, double *w) {
  double h[3];
  for (int row = 0; row < 3; row++) {
    h[row] = 0;
    for (int k = 0; k < 3; k++)
      h[row] += view->screen[row][k] * (p[k] - view->E[k]);
  }
  *sx = h[0] / h[2];
  *sy = h[1] / h[2];
  *w = h[2];
}

/* The sample at a screen point. */
static uint32_t look(struct asked *q, double sx, double sy) {
  struct hsr_view view = q->view;
  int i = (int)floor(sx), j = (int)floor(sy);
  struct hsr_error err;
  view.offset_x = sx - (i + 0.5);
  view.offset_y = sy - (j + 0.5);
  view.window = (struct hsr_window){i, j, i + 1, j + 1};
  hsr_arena_reset(&q->scratch);
  struct hsr_answer answer = hsr_answer_of_ids(q->ids, M, N);
  struct hsr_job job = {.view = &view,
                        .scratch = &q->scratch,
                        .tally = &q->tally,
                        .answer = &answer};
  if (hsr_setup_render(q->oracle, &job, &err))
    bail("%s", err.text);
  return q->ids[(size_t)j * M + (size_t)i];
}

/* The distance of a point in front of face f's plane. */
static double height(const struct hsr_world *w, uint32_t f, const double p[3]) {
  return (w->mesh.nx[f] * (p[0] - w->mesh.px[f]) +
          w->mesh.ny[f] * (p[1] - w->mesh.py[f]) +
          w->mesh.nz[f] * (p[2] - w->mesh.pz[f])) /
         sqrt(w->mesh.nx[f] * w->mesh.nx[f] + w->mesh.ny[f] * w->mesh.ny[f] +
              w->mesh.nz[f] * w->mesh.nz[f]);
}

enum relation { APART, OWN, NEARLY };

/* OWN: the edge is one of the face's sides, or lies exactly in its plane;
 * NEARLY: it is off that plane by roundings only. */
static enum relation relation(const struct asked *q,
                              const struct hsr_segment *s, uint32_t f) {
  const struct hsr_world *w = q->world;
  if (s->edge.implied && (s->edge.a == f || s->edge.b == f))
    return OWN;
  uint32_t before = w->mesh.vertex[w->mesh.start[f + 1] - 1];
  for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
    uint32_t v = w->mesh.vertex[k];
    if (!s->edge.implied && ((before == s->edge.a && v == s->edge.b) ||
                             (before == s->edge.b && v == s->edge.a)))
      return OWN;
    before = v;
  }
  double size = fabs(s->from[0]) + fabs(s->from[1]) + fabs(s->from[2]) +
                fabs(s->to[0]) + fabs(s->to[1]) + fabs(s->to[2]);
  if (fabs(height(w, f, s->from)) > 1e-12 * size ||
      fabs(height(w, f, s->to)) > 1e-12 * size)
    return APART;
  if (s->edge.implied)
    return NEARLY;
  bool out_of_memory = false;
  struct hsr_loop face = hsr_face_loop(w, f);
  const double a[3] = {w->mesh.x[s->edge.a], w->mesh.y[s->edge.a],
                       w->mesh.z[s->edge.a]};
  const double b[3] = {w->mesh.x[s->edge.b], w->mesh.y[s->edge.b],
                       w->mesh.z[s->edge.b]};
  return hsr_exact_plane_side(face, a, &out_of_memory) ||
                 hsr_exact_plane_side(face, b, &out_of_memory)
             ? NEARLY
             : OWN;
}

/* The depth of face f's plane at a screen point. */
static double depth(const struct asked *q, uint32_t f, double sx, double sy) {
  const struct hsr_world *w = q->world;
  const struct hsr_view *v = &q->view;
  double n[3] = {w->mesh.nx[f], w->mesh.ny[f], w->mesh.nz[f]};
  double p[3] = {w->mesh.px[f], w->mesh.py[f], w->mesh.pz[f]};
  double along = 0, offset = 0;
  for (int k = 0; k < 3; k++) {
    along += n[k] * (v->ray[0][k] + sx * v->ray[1][k] + sy * v->ray[2][k]);
    offset += n[k] * (p[k] - v->E[k]);
  }
  return offset / along;
}

static bool is_long_enough(const struct hsr_view *view,
                           const struct hsr_segment *s) {
  double x0, y0, x1, y1, w0, w1;
  project(view, s->from, &x0, &y0, &w0);
  project(view, s->to, &x1, &y1, &w1);
  return hypot(x1 - x0, y1 - y0) >= SHORTEST;
}

static void ask_segment(struct asked *q, const struct hsr_segment *s) {
  if (!is_long_enough(&q->view, s))
    return;
  for (int k = 0; k < POINTS; k++) {
    double t = (k + 0.5) / POINTS, p[3], sx, sy, w;
    for (int c = 0; c < 3; c++)
      p[c] = s->from[c] + t * (s->to[c] - s->from[c]);
    project(&q->view, p, &sx, &sy, &w);
    sx += BESIDE;
    sy += BESIDE * BESIDE;
    if (!(sx >= 0 && sx < M && sy >= 0 && sy < N))
      continue;
    uint32_t seen = look(q, sx, sy);
    enum relation to_seen =
        seen == HSR_BACKGROUND ? APART : relation(q, s, seen);
    q->points++;
    q->undecided += to_seen == NEARLY;
    if (to_seen == NEARLY)
      continue;
    bool hidden = seen != HSR_BACKGROUND && to_seen == APART &&
                  depth(q, seen, sx, sy) < w * (1 - SAME_DEPTH);
    if (hidden != (s->invisibility > 0) && q->wrong++ < 3)
      printf("# edge %u %u %u, t %g in [%g, %g], invisibility %u: sees face %u "
             "at %.9g, the edge is at %.9g\n",
             s->edge.a, s->edge.b, s->edge.part, t, s->t0, s->t1,
             s->invisibility, seen,
             seen == HSR_BACKGROUND ? 0 : depth(q, seen, sx, sy), w);
  }
}

static void ask_view(struct asked *q, const struct hsr_setup *lines) {
  struct hsr_drawing drawing = {.n = 0};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_error err;
  struct hsr_answer answer = hsr_answer_of_drawing(&drawing, M, N);
  struct hsr_job job = {.view = &q->view,
                        .scratch = &scratch,
                        .tally = &q->tally,
                        .answer = &answer};
  if (hsr_setup_render(lines, &job, &err))
    bail("%s", err.text);
  for (size_t k = 0; k < drawing.n; k++)
    ask_segment(q, &drawing.segment[k]);
  hsr_drawing_free(&drawing);
  hsr_arena_free(&scratch);
}

static void ask_scene(struct tap *tap, const char *name) {
  struct hsr_import import = {.strict = true};
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup oracle, lines;
  struct hsr_error err;
  if (hsr_scene_open(name, &import, &scene, &err))
    bail("%s", err.text);
  must_world(&world, scene);
  must_setup(&oracle, hsr_algorithm_find("oracle")->plain, NULL, &world);
  must_setup(&lines, hsr_algorithm_find("line-oracle")->plain, NULL, &world);
  struct asked q = {.world = &world, .oracle = &oracle};
  q.ids = malloc((size_t)M * N * sizeof *q.ids);
  if (!q.ids)
    bail("no view");
  must_view(&q.view, &scene->views[0], M, N);
  ask_view(&q, &lines);
  ok(tap, !q.wrong && q.undecided < q.points / 10,
     "%s: %llu points of lines are hidden just where a face is nearer", name,
     (unsigned long long)q.points);
  if (q.wrong || q.undecided)
    printf("# %llu points are wrong, %llu are not decided\n",
           (unsigned long long)q.wrong, (unsigned long long)q.undecided);
  free(q.ids);
  hsr_arena_free(&q.scratch);
  hsr_setup_free(&lines);
  hsr_setup_free(&oracle);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(int argc, char **argv) {
  int n = argc > 1 ? argc - 1 : (int)(sizeof standard / sizeof *standard);
  struct tap tap = plan(n);
  for (int k = 0; k < n; k++)
    ask_scene(&tap, argc > 1 ? argv[k + 1] : standard[k]);
  return finish(&tap);
}
