/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The picture may be right for another camera. */
#include "bench/stranger/trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Other cameras -------------------------------------------------------- */

static enum hsr_status try_view(struct trial *t, const struct hsr_view *view,
                                enum stranger_kind kind, const char *words) {
  struct supposed s = *t->now;
  s.got = s.origin = NULL;
  s.view = *view;
  enum hsr_status status = studio_draw(t->studio, view, &s.wanted, t->err);
  if (!status && is_uniform(s.wanted, s.all))
    drop(&s); /* no camera is to blame for that */
  else if (!status)
    try_this(t, &s, kind, words);
  return status;
}

enum hsr_status try_places(struct trial *t) {
  static const struct {
    double x, y;
    const char *words;
  } moves[] = {
      {-.5, -.5,
       "samples at the upper left corners of the pixels, half a "
       "sample off in x and y"},
      {.5, .5,
       "samples at the lower right corners of the pixels, half a "
       "sample off in x and y"},
      {-.5, .5,
       "samples at the lower left corners of the pixels, half a "
       "sample off in x and y"},
      {.5, -.5,
       "samples at the upper right corners of the pixels, half a "
       "sample off in x and y"},
      {-.5, 0, "samples half a sample to the left, in x"},
      {.5, 0, "samples half a sample to the right, in x"},
      {0, -.5, "samples half a sample up, in y"},
      {0, .5, "samples half a sample down, in y"},
  };
  enum hsr_status status = HSR_OK;
  struct hsr_view view = t->now->view;
  if (view.offset_x != 0 || view.offset_y != 0)
    return HSR_OK; /* they have been moved already */
  for (size_t k = 0; k < sizeof moves / sizeof *moves && !status; k++) {
    view.offset_x = moves[k].x;
    view.offset_y = moves[k].y;
    status = try_view(t, &view, STRANGER_PLACES, moves[k].words);
  }
  return status;
}

/* Samples from border to border: of a picture with a column and a row less,
 * they are the corners of the pixels. */
enum hsr_status try_borders(struct trial *t) {
  const struct hsr_view *view = &t->now->view;
  const int m = view->m, n = view->n;
  struct supposed s = *t->now;
  bool out_of_memory = false;
  if (m < 2 || n < 2 || view->offset_x != 0 || view->offset_y != 0)
    return HSR_OK;
  s.got = s.origin = NULL;
  enum hsr_status status =
      studio_draw_corners(t->studio, view, false, &s.wanted, t->err);
  if (status)
    return status;
  for (int k = 0; k < 3; k++) {
    s.view.R[k] *= (double)m / (m - 1);
    s.view.U[k] *= (double)n / (n - 1);
  }
  s.to_borders = true;
  if (hsr_exact_view_matrices(&s.view, &out_of_memory))
    try_this(t, &s, STRANGER_PLACES,
             "the outermost samples lie on the border of the picture, not half "
             "a sample inside");
  else
    drop(&s);
  return out_of_memory ? hsr_fail_nomem(t->err) : HSR_OK;
}

/* How well the picture fits what is right dx columns to the right and dy rows
 * below: the samples that differ, where there is anything to compare. */
static uint64_t misfits(const struct supposed *now, int dx, int dy) {
  const int x0 = dx < 0 ? -dx : 0, x1 = now->m - (dx > 0 ? dx : 0);
  const int y0 = dy < 0 ? -dy : 0, y1 = now->n - (dy > 0 ? dy : 0);
  uint64_t n = 0;
  for (int j = y0; j < y1; j++)
    for (int i = x0; i < x1; i++) {
      size_t k = (size_t)j * (size_t)now->m + (size_t)i;
      size_t right = (size_t)(j + dy) * (size_t)now->m + (size_t)(i + dx);
      n += now->got[k] != now->wanted[right];
    }
  return n;
}

static void say_shift(int dx, int dy, char *words, size_t size) {
  char across[60] = "", down[60] = "";
  if (dx)
    snprintf(across, sizeof across, "%d column%s too far to the %s", abs(dx),
             abs(dx) == 1 ? "" : "s", dx > 0 ? "left" : "right");
  if (dy)
    snprintf(down, sizeof down, "%d row%s too %s", abs(dy),
             abs(dy) == 1 ? "" : "s", dy > 0 ? "high" : "low");
  snprintf(words, size, "shifted: all is %s%s%s", across,
           dx && dy ? ", and " : "", down);
}

/* The whole picture is some columns or rows off. What is right is drawn for the
 * shift that fits best. */
enum hsr_status try_shifts(struct trial *t) {
  enum { MOST = 3 };
  const struct supposed *now = t->now;
  struct hsr_view view = now->view;
  uint64_t least = now->left;
  int best_x = 0, best_y = 0;
  char words[200];
  bool out_of_memory = false;
  for (int dy = -MOST; dy <= MOST; dy++)
    for (int dx = -MOST; dx <= MOST; dx++) {
      if (abs(dx) >= now->m || abs(dy) >= now->n)
        continue;
      uint64_t n = misfits(now, dx, dy);
      if (n < least) {
        least = n;
        best_x = dx;
        best_y = dy;
      }
    }
  if (!best_x && !best_y)
    return HSR_OK;
  view.left += best_x;
  view.top += best_y;
  say_shift(best_x, best_y, words, sizeof words);
  if (hsr_exact_view_matrices(&view, &out_of_memory))
    return try_view(t, &view, STRANGER_SHIFTED, words);
  return out_of_memory ? hsr_fail_nomem(t->err) : HSR_OK;
}

/* A picture with other vectors to its right and upwards. */
static enum hsr_status try_vectors(struct trial *t, const double R[3],
                                   const double U[3], double wide, double high,
                                   enum stranger_kind kind, const char *words) {
  struct hsr_view view = t->now->view;
  bool out_of_memory = false;
  for (int k = 0; k < 3; k++) {
    view.R[k] = wide * R[k];
    view.U[k] = high * U[k];
  }
  if (hsr_exact_view_matrices(&view, &out_of_memory))
    return try_view(t, &view, kind, words);
  return out_of_memory ? hsr_fail_nomem(t->err) : HSR_OK;
}

/* Another camera at the same place. */
static enum hsr_status try_camera(struct trial *t,
                                  const struct hsr_camera *camera,
                                  enum stranger_kind kind, const char *words) {
  struct hsr_view view;
  struct hsr_error none;
  enum hsr_status status =
      hsr_view_init(&view, camera, t->now->m, t->now->n, &none);
  if (status)
    return status == HSR_E_NOMEM ? hsr_fail_nomem(t->err) : HSR_OK;
  view.offset_x = t->now->view.offset_x;
  view.offset_y = t->now->view.offset_y;
  return try_view(t, &view, kind, words);
}

/* The views of a scene, which may be those that it has without any options. */
static enum hsr_status
try_views_of(struct trial *t, const struct hsr_scene *scene, bool are_own) {
  enum { MOST_VIEWS = 32 };
  enum hsr_status status = HSR_OK;
  char words[120];
  for (uint32_t k = 0; k < scene->n_views && k < MOST_VIEWS && !status; k++) {
    if (!memcmp(&scene->views[k], &t->now->view.camera, sizeof *scene->views))
      continue;
    snprintf(words, sizeof words, "it is the picture of %sview %u%s",
             are_own ? "the scene's own " : "", k + 1,
             are_own ? ", not of the camera that was given" : "");
    status = try_camera(t, &scene->views[k], STRANGER_VIEW, words);
  }
  return status;
}

enum hsr_status try_views(struct trial *t) {
  const struct studio *studio = t->studio;
  enum hsr_status status = try_views_of(t, studio->scene->scene, false);
  return status || !studio->own ? status
                                : try_views_of(t, studio->own->scene, true);
}

static enum hsr_status try_angles(struct trial *t) {
  struct hsr_camera camera = t->now->view.camera;
  const bool parallel = t->now->view.parallel;
  char words[120];
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < 2 && !status; k++) {
    const double times = k ? 2 : .5;
    struct hsr_camera other = camera;
    other.fov *= times;
    other.parallel *= times;
    if (!parallel && other.fov >= 180)
      continue;
    if (parallel)
      snprintf(words, sizeof words,
               "the height of the picture is %s: %g, not "
               "%g",
               k ? "doubled" : "halved", other.parallel, camera.parallel);
    else
      snprintf(words, sizeof words,
               "the angle of view is %s: %g degrees, not "
               "%g",
               k ? "doubled" : "halved", other.fov, camera.fov);
    status = try_camera(t, &other, STRANGER_FIELD, words);
  }
  return status;
}

/* The proportions of the picture are left out, or are taken the other way. */
static enum hsr_status try_proportions(struct trial *t) {
  const struct hsr_view *view = &t->now->view;
  const double tall = (double)view->n / view->m;
  struct hsr_view square;
  struct hsr_error none;
  if (view->m == view->n ||
      hsr_view_init(&square, &view->camera, view->n, view->n, &none))
    return HSR_OK;
  enum hsr_status status = try_vectors(
      t, square.R, view->U, 1, tall, STRANGER_FIELD,
      view->parallel ? "the height of the picture is taken as its width"
                     : "the angle of view is taken as that of the width; it "
                       "is that of the height");
  if (status)
    return status;
  return try_vectors(t, square.R, view->U, 1, 1, STRANGER_FIELD,
                     "stretched: drawn as if it were as wide as it is high");
}

enum hsr_status try_fields(struct trial *t) {
  enum hsr_status status = try_proportions(t);
  return status ? status : try_angles(t);
}

/* --- Near and far --------------------------------------------------------- */

struct deep {
  float depth;
  bool wrong;
};

static int compare_depths(const void *a, const void *b) {
  const struct deep *p = a, *q = b;
  return (p->depth > q->depth) - (p->depth < q->depth);
}

/* Divides the samples by depth, so that one side has the wrong ones: the near
 * side, or else the far one. *at becomes a depth between the two. False if
 * nothing is gained by that, or nothing would be left. */
static bool divide(const struct deep *sample, size_t n, bool near, double *at) {
  size_t wrong = 0, best_at = 0;
  for (size_t k = 0; k < n; k++)
    wrong += sample[k].wrong;
  /* Of a cut before sample k: what is on the wrong side. */
  size_t before_wrong = 0, least = wrong;
  bool found = false;
  for (size_t k = 0; k <= n; k++) {
    size_t before_right = k - before_wrong;
    size_t faults = near ? before_right + (wrong - before_wrong)
                         : before_wrong + (n - k - (wrong - before_wrong));
    bool is_cut = k == 0 || k == n || sample[k].depth > sample[k - 1].depth;
    if (is_cut && faults < least) {
      least = faults;
      best_at = k;
      found = true;
    }
    before_wrong += k < n && sample[k].wrong;
  }
  if (!found || best_at == 0 || (!near && best_at == n))
    return false;
  double low = best_at ? (double)sample[best_at - 1].depth : 0;
  double high = best_at < n ? (double)sample[best_at].depth : low + fabs(low);
  *at = low + (high - low) / 2;
  return true;
}

static enum hsr_status try_far(struct trial *t, const float *depth, double at) {
  struct supposed s = *t->now;
  char words[120];
  s.got = s.origin = NULL;
  s.wanted = new_ids(t);
  if (!s.wanted)
    return hsr_fail_nomem(t->err);
  for (size_t k = 0; k < s.all; k++)
    s.wanted[k] = (double)depth[k] > at ? HSR_NO_FACE : t->now->wanted[k];
  snprintf(words, sizeof words, "cut off by a far plane at about %.6g", at);
  try_this(t, &s, STRANGER_FAR, words);
  return HSR_OK;
}

static enum hsr_status try_near(struct trial *t, double near) {
  struct hsr_camera camera = t->now->view.camera;
  char words[120];
  snprintf(words, sizeof words, "a near plane at about %.6g, not at %g", near,
           camera.near);
  if (near == 0)
    snprintf(words, sizeof words, "no near plane; it is at %g", camera.near);
  camera.near = near;
  return try_camera(t, &camera, STRANGER_NEAR, words);
}

enum hsr_status try_depths(struct trial *t) {
  const struct supposed *now = t->now;
  float *depth = malloc(now->all * sizeof *depth);
  struct deep *sample = malloc(now->all * sizeof *sample);
  enum hsr_status status = HSR_OK;
  size_t n = 0;
  double at;
  if (!depth || !sample)
    status = hsr_fail_nomem(t->err);
  if (!status) {
    hsr_picture_depth(t->studio->world, &now->view, now->wanted, depth);
    for (size_t k = 0; k < now->all; k++)
      if (now->wanted[k] != HSR_NO_FACE)
        sample[n++] = (struct deep){depth[k], now->got[k] != now->wanted[k]};
    qsort(sample, n, sizeof *sample, compare_depths);
    if (divide(sample, n, false, &at))
      status = try_far(t, depth, at);
  }
  if (!status && divide(sample, n, true, &at) && at > 0)
    status = try_near(t, at);
  if (!status && now->view.camera.near > 0)
    status = try_near(t, 0);
  free(depth);
  free(sample);
  return status;
}
