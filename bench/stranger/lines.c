/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/stranger/lines.h"
#include "bench/judge/judge.h"
#include "bench/judge/wanted.h"
#include "common/answers/kinds/segments.h"

#include <math.h>
#include <stdlib.h>

static const struct {
  const char *key, *words;
} kinds[LINE_KINDS] = {
    {"visible-only", "hidden parts are left out; what is visible is right"},
    {"hidden-or-not", "hidden parts are right, but not by how many faces they "
                      "are hidden"},
    {"count", "the intervals are right, but not by how many faces they are "
              "hidden"},
    {"ends", "the ends of intervals are off by less than 1e-5 of the edge"},
    {"missing", "the edge is not there"},
    {"extra", "no such edge is to be drawn"},
    {"wrong", "plain wrong: none of these"}};

const char *line_key(enum line_kind kind) {
  return kinds[kind].key;
}

const char *line_words(enum line_kind kind) {
  return kinds[kind].words;
}

/* --- One edge ------------------------------------------------------------- */

/* The intervals of an edge. */
struct run {
  const struct hsr_segment *first;
  size_t n;
};

/* The intervals from `at` on that are of one edge; none at the end. */
static struct run take_run(const struct hsr_drawing *drawing, size_t at) {
  struct run run = {drawing->segment + at, 0};
  while (at + run.n < drawing->n &&
         !hsr_edge_name_compare(&run.first[0].edge, &run.first[run.n].edge))
    run.n++;
  return run;
}

static bool ends_agree(const struct hsr_segment *a, const struct hsr_segment *b,
                       double tolerance) {
  return fabs(a->t0 - b->t0) <= tolerance && fabs(a->t1 - b->t1) <= tolerance;
}

/* Whether the intervals are the same, with ends to a tolerance. */
static bool is_same(struct run got, struct run wanted, double tolerance,
                    bool counts) {
  bool same = got.n == wanted.n;
  for (size_t k = 0; same && k < got.n; k++)
    same =
        ends_agree(&got.first[k], &wanted.first[k], tolerance) &&
        (!counts || got.first[k].invisibility == wanted.first[k].invisibility);
  return same;
}

/* Whether what is got are the visible intervals of what is wanted. */
static bool is_visible_only(struct run got, struct run wanted) {
  size_t at = 0;
  bool same = true;
  for (size_t k = 0; same && k < wanted.n; k++) {
    if (wanted.first[k].invisibility)
      continue;
    same = at < got.n && !got.first[at].invisibility &&
           ends_agree(&got.first[at], &wanted.first[k], HSR_DRAWING_TOLERANCE);
    at++;
  }
  return same && at == got.n;
}

/* Whether hidden and visible parts are told apart rightly. */
static bool is_hidden_or_not(struct run got, struct run wanted) {
  size_t at = 0;
  bool same = true;
  for (size_t k = 0; same && k < wanted.n; at++) {
    const size_t first = k;
    const bool hidden = wanted.first[k].invisibility > 0;
    while (k < wanted.n && (wanted.first[k].invisibility > 0) == hidden)
      k++;
    const struct hsr_segment whole = {.t0 = wanted.first[first].t0,
                                      .t1 = wanted.first[k - 1].t1};
    same = at < got.n && (got.first[at].invisibility > 0) == hidden &&
           ends_agree(&got.first[at], &whole, HSR_DRAWING_TOLERANCE);
  }
  return same && at == got.n;
}

/* The kind of an edge that is wrong. */
static enum line_kind kind_of(struct run got, struct run wanted) {
  if (!wanted.n)
    return LINE_EXTRA;
  if (is_visible_only(got, wanted))
    return LINE_VISIBLE_ONLY;
  if (!got.n)
    return LINE_MISSING;
  if (is_hidden_or_not(got, wanted))
    return LINE_HIDDEN_OR_NOT;
  if (is_same(got, wanted, HSR_DRAWING_TOLERANCE, false))
    return LINE_COUNT;
  return is_same(got, wanted, LINE_LITTLE, true) ? LINE_ENDS : LINE_WRONG;
}

/* --- All edges ------------------------------------------------------------ */

/* Whether the judge itself finds a difference in this edge. */
static bool differs(struct run got, struct run wanted) {
  const struct hsr_drawing one = {(struct hsr_segment *)got.first, got.n, 0},
                           other = {(struct hsr_segment *)wanted.first,
                                    wanted.n, 0};
  struct hsr_drawing_difference found;
  hsr_drawing_compare(&one, &other, false, &found);
  return found.differing;
}

static void note(struct line_verdict *verdict, enum line_kind kind,
                 const struct hsr_edge_name *edge) {
  struct line_reason *reason = &verdict->reason[kind];
  if (!reason->edges++)
    reason->first = *edge;
  reason->kind = kind;
}

static int compare_reasons(const void *a, const void *b) {
  const struct line_reason *p = a, *q = b;
  return (p->edges < q->edges) - (p->edges > q->edges);
}

static void compare(const struct hsr_drawing *got,
                    const struct hsr_drawing *wanted,
                    struct line_verdict *verdict) {
  size_t g = 0, w = 0;
  while (g < got->n || w < wanted->n) {
    struct run here = take_run(got, g), there = take_run(wanted, w);
    int order = !here.n    ? 1
                : !there.n ? -1
                           : hsr_edge_name_compare(&here.first->edge,
                                                   &there.first->edge);
    if (order > 0)
      here.n = 0;
    if (order < 0)
      there.n = 0;
    const struct hsr_edge_name *edge =
        &(here.n ? here.first : there.first)->edge;
    if (differs(here, there))
      note(verdict, kind_of(here, there), edge);
    g += here.n;
    w += there.n;
  }
  qsort(verdict->reason, LINE_KINDS, sizeof *verdict->reason, compare_reasons);
  while (verdict->n_reasons < LINE_KINDS &&
         verdict->reason[verdict->n_reasons].edges)
    verdict->n_reasons++;
}

static enum hsr_status
judge(struct lib_scene *scene, const struct hsr_world *world,
      const struct hsr_view *view, const struct hsr_drawing *drawing,
      struct line_verdict *verdict, struct hsr_error *err) {
  const int number = 0;
  struct hsr_drawing_difference found;
  struct group group = {.world = world,
                        .form = hsr_form_standard(&hsr_answer_segments),
                        .view = view,
                        .number = &number,
                        .n_views = 1};
  struct wanted *wanted = calloc(1, sizeof *wanted);
  if (!wanted)
    return hsr_fail_nomem(err);
  lib_scene_read(scene);
  enum hsr_status status =
      ask_oracle(&group, oracle_of(&hsr_answer_segments), wanted, err);
  if (!status) {
    const struct hsr_drawing *right = hsr_answer_lines(&wanted->answer);
    hsr_drawing_compare(drawing, right, false, &found);
    verdict->compared = found.edges;
    verdict->differing = found.differing;
    compare(drawing, right, verdict);
  }
  lib_scene_leave(scene);
  free_wanted(&group, wanted);
  return status;
}

enum hsr_status lines_judge(struct lib_scene *scene,
                            const struct hsr_request *request,
                            const struct hsr_drawing *drawing,
                            struct line_verdict *verdict,
                            struct hsr_error *err) {
  struct hsr_view view;
  const struct hsr_world *world;
  *verdict = (struct line_verdict){.n_reasons = 0};
  enum hsr_status status =
      lib_view(scene, request, &hsr_answer_segments, &view, err);
  if (!status)
    status = lib_scene_world(scene, oracle_of(&hsr_answer_segments), NULL,
                             &world, err);
  return status ? status : judge(scene, world, &view, drawing, verdict, err);
}
