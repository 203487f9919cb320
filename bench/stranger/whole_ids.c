/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The picture may be right, but for the order of its samples or the numbers of its
 * faces. */
#include "bench/stranger/trial.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Rows and columns ----------------------------------------------------- */

struct turn {
  enum stranger_kind kind;
  bool over, mirror, transpose;
};
static const struct turn turns[] = {{STRANGER_TURNED, true, false, false},
                                    {STRANGER_MIRRORED, false, true, false},
                                    {STRANGER_HALF_TURN, true, true, false},
                                    {STRANGER_TRANSPOSED, false, false, true}};
enum { TURNS = sizeof turns / sizeof *turns };

/* What is right for a picture with rows and columns exchanged. *known is false if
 * there is no such view. */
static enum hsr_status draw_exchanged(const struct trial *t, struct supposed *s,
                                      bool *known) {
  struct hsr_error none;
  const struct hsr_view *view = &t->now->view;
  s->m = t->now->n;
  s->n = t->now->m;
  *known = !hsr_view_init(&s->view, &view->camera, s->m, s->n, &none);
  s->view.offset_x = view->offset_x;
  s->view.offset_y = view->offset_y;
  return *known ? studio_draw(t->studio, &s->view, &s->wanted, t->err) : HSR_OK;
}

/* Turns the picture. `s` has arrays of its own then, which drop() frees. */
static enum hsr_status turn_picture(const struct trial *t,
                                    const struct turn *turn, struct supposed *s,
                                    bool *known) {
  const struct supposed *now = t->now;
  enum hsr_status status = HSR_OK;
  *s = *now;
  *known = true;
  s->wanted = NULL;
  s->got = new_ids(t);
  s->origin = new_ids(t);
  if (!s->got || !s->origin)
    status = hsr_fail_nomem(t->err);
  else if (turn->transpose && now->m != now->n)
    status = draw_exchanged(t, s, known);
  if (status || !*known) {
    drop(s);
    return status;
  }
  for (int j = 0; j < s->n; j++)
    for (int i = 0; i < s->m; i++) {
      size_t x = (size_t)(turn->mirror ? s->m - 1 - i : i);
      size_t y = (size_t)(turn->over ? s->n - 1 - j : j);
      size_t from =
          turn->transpose ? x * (size_t)now->m + y : y * (size_t)now->m + x;
      size_t to = (size_t)j * (size_t)s->m + (size_t)i;
      s->got[to] = now->got[from];
      s->origin[to] = now->origin[from];
    }
  return HSR_OK;
}

enum hsr_status try_turns(struct trial *t) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < TURNS && !status; k++) {
    struct supposed s;
    bool known;
    status = turn_picture(t, &turns[k], &s, &known);
    if (!status && known)
      try_this(t, &s, turns[k].kind, NULL);
  }
  return status;
}

/* --- Numbers of faces ----------------------------------------------------- */

/* How ids are changed: id + by, but `none` may also mean no face. */
struct change {
  int64_t by;
  bool has_none;
  uint32_t none;
  const uint32_t *face; /* or: the face of each of n numbers */
  uint32_t n;
};

static uint32_t changed(const struct change *c, uint32_t id, uint32_t wanted) {
  if (c->has_none && id == c->none && wanted == HSR_NO_FACE)
    return HSR_NO_FACE;
  if (id == HSR_NO_FACE)
    /* One below face 0 looks like it. */
    return c->by > 0 && wanted == 0 ? 0 : id;
  if (c->face)
    return id < c->n ? c->face[id] : id;
  int64_t face = (int64_t)id + c->by;
  return face < 0 ? STRANGER_BELOW_0 : (uint32_t)face;
}

/* Of what numbers are tried: the picture as it is now, or turned. */
struct base {
  const struct supposed *picture;
  const struct turn *turn; /* NULL: it is as it is now */
};

static uint32_t *copy_ids(const struct trial *t, const uint32_t *ids) {
  uint32_t *copy = new_ids(t);
  return copy ? memcpy(copy, ids, t->now->all * sizeof *copy) : NULL;
}

/* A picture with ids of its own, and copies of what the base has of its own. */
static enum hsr_status begin_change(const struct trial *t,
                                    const struct base *base,
                                    struct supposed *s) {
  const struct supposed *from = base->picture;
  const bool origin = base->turn, wanted = base->turn && from->wanted;
  *s = *from;
  s->got = new_ids(t);
  s->origin = origin ? copy_ids(t, from->origin) : NULL;
  s->wanted = wanted ? copy_ids(t, from->wanted) : NULL;
  if (s->got && (s->origin || !origin) && (s->wanted || !wanted))
    return HSR_OK;
  drop(s);
  return hsr_fail_nomem(t->err);
}

static enum hsr_status try_change(struct trial *t, const struct base *base,
                                  const struct change *c,
                                  enum stranger_kind kind, const char *words) {
  struct supposed s;
  char both[sizeof t->reason.words];
  const struct supposed *from = base->picture;
  const uint32_t *wanted = from->wanted ? from->wanted : t->now->wanted;
  enum hsr_status status = begin_change(t, base, &s);
  if (status)
    return status;
  for (size_t k = 0; k < s.all; k++)
    s.got[k] = changed(c, from->got[k], wanted[k]);
  words = words ? words : stranger_kinds[kind].words;
  if (base->turn) {
    kind = base->turn->kind;
    snprintf(both, sizeof both, "%s; and %s", stranger_kinds[kind].words,
             words);
    words = both;
  }
  try_this(t, &s, kind, words);
  return HSR_OK;
}

/* The id that is most often where there is no face; HSR_NO_FACE if it is
 * that. */
static uint32_t usual_none(const uint32_t *got, const uint32_t *wanted,
                           size_t n) {
  uint32_t usual = HSR_NO_FACE;
  uint64_t votes = 0; /* Boyer and Moore: the majority, if there is one */
  for (size_t k = 0; k < n; k++) {
    if (wanted[k] != HSR_NO_FACE)
      continue;
    if (!votes)
      usual = got[k];
    if (got[k] == usual)
      votes++;
    else
      votes--;
  }
  return usual;
}

static enum hsr_status try_numbers_of(struct trial *t,
                                      const struct base *base) {
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
    status =
        try_change(t, base, &shifts[k].change, STRANGER_IDS, shifts[k].words);
  const struct supposed *from = base->picture;
  const uint32_t none = usual_none(
      from->got, from->wanted ? from->wanted : t->now->wanted, from->all);
  if (status || none == HSR_NO_FACE)
    return status;
  char words[100];
  snprintf(words, sizeof words, "%u where there is no face, not %u", none,
           HSR_NO_FACE);
  const struct change change = {.has_none = true, .none = none};
  return try_change(t, base, &change, STRANGER_NO_FACE, words);
}

/* Polygons cut into fans, face by face. */
static enum hsr_status try_fans_of(struct trial *t, const struct base *base) {
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
  enum hsr_status status =
      try_change(t, base, &change, STRANGER_TRIANGLES, NULL);
  free(face);
  return status;
}

enum hsr_status try_numbers(struct trial *t) {
  const struct base base = {.picture = t->now};
  enum hsr_status status = try_numbers_of(t, &base);
  return status ? status : try_fans_of(t, &base);
}

enum hsr_status try_pairs(struct trial *t) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < TURNS && !status; k++) {
    struct supposed turned;
    const struct base base = {&turned, &turns[k]};
    bool known;
    status = turn_picture(t, &turns[k], &turned, &known);
    if (status || !known)
      continue;
    status = try_numbers_of(t, &base);
    if (!status)
      status = try_fans_of(t, &base);
    drop(&turned);
  }
  return status;
}
