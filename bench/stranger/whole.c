/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faults of a picture as a whole: suppositions are tried one after the other,
 * and the one that leaves the fewest samples wrong is put right. */
#include "bench/stranger/parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is tried, and the best so far. */
struct trial {
  const struct studio *studio;
  const struct supposed *now;
  struct supposed best; /* its arrays: NULL where they are those of *now */
  struct stranger_reason reason;
  uint64_t left; /* what the best leaves wrong */
  struct hsr_error *err;
};

static void drop(struct supposed *s) {
  free(s->got);
  free(s->wanted);
  free(s->origin);
  s->got = s->wanted = s->origin = NULL;
}

uint64_t count_differing(const uint32_t *a, const uint32_t *b, size_t n) {
  uint64_t differing = 0;
  for (size_t k = 0; k < n; k++)
    differing += a[k] != b[k];
  return differing;
}

bool is_uniform(const uint32_t *ids, size_t n) {
  return n < 2 || !memcmp(ids, ids + 1, (n - 1) * sizeof *ids);
}

/* Takes a supposition if it is the best so far. Its arrays are taken over, or
 * freed. */
static void try_this(struct trial *t, struct supposed *s,
                     enum stranger_kind kind, const char *words) {
  const struct supposed *now = t->now;
  const uint32_t *got = s->got ? s->got : now->got;
  const uint32_t *wanted = s->wanted ? s->wanted : now->wanted;
  uint64_t left = count_differing(got, wanted, now->all);
  if (left >= t->left) {
    drop(s);
    return;
  }
  drop(&t->best);
  t->best = *s;
  t->left = left;
  t->reason.kind = kind;
  snprintf(t->reason.words, sizeof t->reason.words, "%s",
           words ? words : stranger_kinds[kind].words);
}

static uint32_t *new_ids(const struct trial *t) {
  return malloc(t->now->all * sizeof(uint32_t));
}

/* --- Rows and columns ----------------------------------------------------- */

static enum hsr_status try_turn(struct trial *t, enum stranger_kind kind,
                                bool over, bool mirror, bool transpose) {
  const struct supposed *now = t->now;
  struct supposed s = *now;
  const int m = now->m, n = now->n;
  s.wanted = NULL;
  s.got = new_ids(t);
  s.origin = new_ids(t);
  if (!s.got || !s.origin) {
    drop(&s);
    return hsr_fail_nomem(t->err);
  }
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      size_t x = (size_t)(mirror ? m - 1 - i : i);
      size_t y = (size_t)(over ? n - 1 - j : j);
      size_t from = transpose ? x * (size_t)m + y : y * (size_t)m + x;
      size_t to = (size_t)j * (size_t)m + (size_t)i;
      s.got[to] = now->got[from];
      s.origin[to] = now->origin[from];
    }
  try_this(t, &s, kind, NULL);
  return HSR_OK;
}

static enum hsr_status try_turns(struct trial *t) {
  enum hsr_status status = try_turn(t, STRANGER_TURNED, true, false, false);
  if (!status)
    status = try_turn(t, STRANGER_MIRRORED, false, true, false);
  if (!status)
    status = try_turn(t, STRANGER_HALF_TURN, true, true, false);
  if (!status && t->now->m == t->now->n)
    status = try_turn(t, STRANGER_TRANSPOSED, false, false, true);
  return status;
}

/* --- Numbers of faces ----------------------------------------------------- */

/* An id that is no face, and is not meant for one. */
#define NOTHING 0xfffffffdu

/* How ids are changed: id + by, but `none` may also mean no face. */
struct change {
  int64_t by;
  bool has_none;
  uint32_t none;
  const uint32_t *face; /* or: the face of each of n numbers */
  uint32_t n;
};

static uint32_t changed(const struct change *c, uint32_t id, uint32_t wanted,
                        uint32_t n_faces) {
  if (c->has_none && id == c->none && wanted == HSR_NO_FACE)
    return HSR_NO_FACE;
  if (id == HSR_NO_FACE)
    /* One below face 0 looks like it. */
    return c->by > 0 && wanted == 0 ? 0 : id;
  if (c->face)
    return id < c->n ? c->face[id] : NOTHING;
  int64_t face = (int64_t)id + c->by;
  if (face >= 0 && face < (int64_t)n_faces)
    return (uint32_t)face;
  return c->by ? NOTHING : id;
}

static enum hsr_status try_change(struct trial *t, const struct change *c,
                                  enum stranger_kind kind, const char *words) {
  const struct supposed *now = t->now;
  struct supposed s = *now;
  s.wanted = s.origin = NULL;
  s.got = new_ids(t);
  if (!s.got)
    return hsr_fail_nomem(t->err);
  for (size_t k = 0; k < now->all; k++)
    s.got[k] =
        changed(c, now->got[k], now->wanted[k], t->studio->world->n_faces);
  try_this(t, &s, kind, words);
  return HSR_OK;
}

/* The id that is most often where there is no face; HSR_NO_FACE if it is
 * that. */
static uint32_t usual_none(const struct supposed *now) {
  uint32_t usual = HSR_NO_FACE;
  uint64_t votes = 0; /* Boyer and Moore: the majority, if there is one */
  for (size_t k = 0; k < now->all; k++) {
    if (now->wanted[k] != HSR_NO_FACE)
      continue;
    if (!votes)
      usual = now->got[k];
    if (now->got[k] == usual)
      votes++;
    else
      votes--;
  }
  return usual;
}

static enum hsr_status try_numbers(struct trial *t) {
  static const struct {
    struct change change;
    const char *words;
  } shifts[] = {
      {{.by = -1}, "ids are one too high"},
      {{.by = -1, .has_none = true, .none = 0},
       "ids are one too high, and 0 is no face"},
      {{.by = 1}, "ids are one too low"},
  };
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < sizeof shifts / sizeof *shifts && !status; k++)
    status = try_change(t, &shifts[k].change, STRANGER_IDS, shifts[k].words);
  const uint32_t none = usual_none(t->now);
  if (status || none == HSR_NO_FACE)
    return status;
  char words[100];
  snprintf(words, sizeof words, "%u where there is no face, not %u", none,
           HSR_NO_FACE);
  const struct change change = {.has_none = true, .none = none};
  return try_change(t, &change, STRANGER_NO_FACE, words);
}

/* Polygons cut into fans, face by face. */
static enum hsr_status try_fans(struct trial *t) {
  const struct hsr_world *world = t->studio->world;
  const size_t n = (size_t)world->mesh.n_corners - 2 * (size_t)world->n_faces;
  if (n == world->n_faces || n > UINT32_MAX - 2)
    return HSR_OK; /* all are triangles */
  uint32_t *face = malloc(n * sizeof *face);
  if (!face)
    return hsr_fail_nomem(t->err);
  size_t at = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    for (uint32_t k = 2; k < hsr_face_size(world, f); k++)
      face[at++] = f;
  const struct change change = {.face = face, .n = (uint32_t)n};
  enum hsr_status status = try_change(t, &change, STRANGER_TRIANGLES, NULL);
  free(face);
  return status;
}

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

static enum hsr_status try_places(struct trial *t) {
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
static enum hsr_status try_borders(struct trial *t) {
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

/* The other views of the scene. */
static enum hsr_status try_views(struct trial *t) {
  enum { MOST_VIEWS = 32 };
  const struct hsr_scene *scene = t->studio->scene->scene;
  enum hsr_status status = HSR_OK;
  char words[60];
  for (uint32_t k = 0; k < scene->n_views && k < MOST_VIEWS && !status; k++) {
    if (!memcmp(&scene->views[k], &t->now->view.camera, sizeof *scene->views))
      continue;
    snprintf(words, sizeof words, "it is the picture of view %u", k + 1);
    status = try_camera(t, &scene->views[k], STRANGER_VIEW, words);
  }
  return status;
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

static enum hsr_status try_fields(struct trial *t) {
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

static enum hsr_status try_depths(struct trial *t) {
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

/* --- All of them ---------------------------------------------------------- */

/* Puts the best supposition in the place of *now. Of another camera, the oracle
 * says what is right. */
static enum hsr_status adopt(struct trial *t, struct supposed *now) {
  struct supposed *best = &t->best;
  enum stranger_kind kind = t->reason.kind;
  if (best->wanted && kind != STRANGER_FAR) {
    free(best->wanted);
    enum hsr_status status =
        best->to_borders && !now->to_borders
            ? studio_draw_corners(t->studio, &now->view, true, &best->wanted,
                                  t->err)
            : studio_draw_right(t->studio, &best->view, &best->wanted, t->err);
    if (status)
      return status;
  }
  uint32_t **own[] = {&now->got, &now->wanted, &now->origin};
  uint32_t **new[] = {&best->got, &best->wanted, &best->origin};
  for (int k = 0; k < 3; k++) {
    if (!*new[k])
      continue;
    free(*own[k]);
    *own[k] = *new[k];
    *new[k] = NULL;
  }
  now->view = best->view;
  now->to_borders = best->to_borders;
  now->left = count_differing(now->got, now->wanted, now->all);
  return HSR_OK;
}

/* The first sample that differs. */
static void note_first(struct stranger_reason *reason,
                       const struct supposed *now) {
  size_t k = 0;
  while (k < now->all && now->got[k] == now->wanted[k])
    k++;
  reason->place = now->origin[k];
  reason->got = now->got[k];
  reason->wanted = now->wanted[k];
}

static enum hsr_status try_all(struct trial *t) {
  static enum hsr_status (*const tries[])(struct trial * t) = {
      try_turns,  try_numbers, try_fans,   try_views,
      try_places, try_borders, try_fields, try_depths};
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < sizeof tries / sizeof *tries && !status; k++)
    status = tries[k](t);
  return status;
}

/* Finds one fault. *found: there is one that explains at least half of what is
 * wrong, and more than ties and backs of single samples do. That a few samples
 * are like those of another picture means nothing, unless all are. */
enum { FEW = 10 };

static enum hsr_status find_one(const struct studio *studio,
                                struct supposed *now,
                                struct stranger_verdict *verdict, bool *found,
                                struct hsr_error *err) {
  struct trial t = {
      .studio = studio, .now = now, .left = now->left, .err = err};
  const uint64_t before = now->left;
  uint64_t certain = 0;
  enum hsr_status status = try_all(&t);
  uint64_t explained = before - t.left;
  if (!status && t.left && 2 * explained >= before)
    status = find_samples(studio, now, NULL, &certain, err);
  *found = !status && explained > certain && 2 * explained >= before &&
           (!t.left || explained >= FEW);
  if (*found) {
    struct stranger_reason *reason = &verdict->whole[verdict->n_whole++];
    *reason = t.reason;
    note_first(reason, now);
    status = adopt(&t, now);
    reason->samples = before > now->left ? before - now->left : 0;
  }
  drop(&t.best);
  return status;
}

enum hsr_status find_whole(const struct studio *studio, struct supposed *now,
                           struct stranger_verdict *verdict,
                           struct hsr_error *err) {
  bool found =
      !is_uniform(now->got, now->all) || is_uniform(now->wanted, now->all);
  enum hsr_status status = HSR_OK;
  while (found && now->left && verdict->n_whole < STRANGER_MOST_WHOLE &&
         !status)
    status = find_one(studio, now, verdict, &found, err);
  return status;
}
