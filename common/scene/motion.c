/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct hsr_motion hsr_motion_unknown(void) {
  return (struct hsr_motion){.speed = INFINITY,
                             .lo = {-INFINITY, -INFINITY, -INFINITY},
                             .hi = {INFINITY, INFINITY, INFINITY}};
}

static struct hsr_motions *motions_of(struct hsr_scene *scene) {
  if (!scene->motions)
    scene->motions = calloc(1, sizeof *scene->motions);
  return scene->motions;
}

enum hsr_status hsr_scene_set_frame(struct hsr_scene *scene, long frame) {
  struct hsr_motions *motions = motions_of(scene);
  if (!motions)
    return HSR_E_NOMEM;
  motions->frame = frame;
  return HSR_OK;
}

long hsr_scene_frame(const struct hsr_scene *scene) {
  return scene->motions ? scene->motions->frame : 0;
}

/* Room for n items. */
static bool reserve(void **array, uint32_t *cap, uint32_t n, size_t size) {
  if (n <= *cap)
    return true;
  size_t larger = 2 * (size_t)n + 16;
  void *moved = larger > UINT32_MAX ? NULL : realloc(*array, larger * size);
  if (!moved)
    return false;
  *array = moved;
  *cap = (uint32_t)larger;
  return true;
}

static bool make_room(struct hsr_motions *m, uint32_t n, uint32_t n_keys) {
  void *of = m->of, *key = m->key;
  bool good = reserve(&of, &m->cap, n, sizeof *m->of);
  m->of = of;
  good = good && reserve(&key, &m->cap_keys, n_keys, sizeof *m->key);
  m->key = key;
  return good;
}

enum hsr_status hsr_scene_set_motion(struct hsr_scene *scene,
                                     const struct hsr_motion *motion,
                                     const struct hsr_key *key,
                                     uint32_t n_keys) {
  struct hsr_motions *m = motions_of(scene);
  uint32_t n = scene->n_instances;
  if (!n || !scene->objects[scene->instances[n - 1].object].moves)
    return HSR_E_INPUT;
  for (uint32_t k = 1; k < n_keys; k++)
    if (!(key[k - 1].frame < key[k].frame))
      return HSR_E_INPUT;
  if (!m || !make_room(m, n, m->n_keys + n_keys))
    return HSR_E_NOMEM;
  while (m->n < n)
    m->of[m->n++] = hsr_motion_unknown();
  m->of[n - 1] = *motion;
  m->of[n - 1].first_key = m->n_keys;
  m->of[n - 1].n_keys = n_keys;
  if (n_keys)
    memcpy(m->key + m->n_keys, key, n_keys * sizeof *key);
  m->n_keys += n_keys;
  return HSR_OK;
}

struct hsr_motion hsr_scene_motion(const struct hsr_scene *scene, uint32_t i) {
  const struct hsr_motions *m = scene->motions;
  return m && i < m->n ? m->of[i] : hsr_motion_unknown();
}

/* --- A way ---------------------------------------------------------------- */

static void widen(const double *at_lo, const double *at_hi, double *lo,
                  double *hi) {
  for (int a = 0; a < 3; a++) {
    lo[a] = fmin(lo[a], at_lo[a]);
    hi[a] = fmax(hi[a], at_hi[a]);
  }
}

/* The last of n keys that is not after a time; the first key if all are. */
static uint32_t key_before(const struct hsr_key *key, uint32_t n,
                           double frame) {
  uint32_t first = 0;
  while (n > 1) {
    uint32_t half = n / 2;
    if (key[first + half].frame <= frame) {
      first += half;
      n -= half;
    } else {
      n = half;
    }
  }
  return first;
}

/* Widens lo .. hi by the box at a time from key k on, up to the next key. */
static void widen_between(const struct hsr_key *k, double frame, double *lo,
                          double *hi) {
  double at_lo[3], at_hi[3];
  double part =
      frame > k->frame ? (frame - k->frame) / (k[1].frame - k->frame) : 0;
  if (part == 0) {
    widen(k->lo, k->hi, lo, hi);
    return;
  }
  for (int a = 0; a < 3; a++) {
    at_lo[a] = k->lo[a] + part * (k[1].lo[a] - k->lo[a]);
    at_hi[a] = k->hi[a] + part * (k[1].hi[a] - k->hi[a]);
  }
  widen(at_lo, at_hi, lo, hi);
}

bool hsr_scene_way(const struct hsr_scene *scene, uint32_t i, double from,
                   double to, double lo[3], double hi[3]) {
  struct hsr_motion motion = hsr_scene_motion(scene, i);
  uint32_t n = motion.n_keys;
  if (!n)
    return false;
  const struct hsr_key *key = scene->motions->key + motion.first_key;
  if (from < key[0].frame || to > key[n - 1].frame)
    return false;
  for (int a = 0; a < 3; a++) {
    lo[a] = INFINITY;
    hi[a] = -INFINITY;
  }
  uint32_t first = key_before(key, n, from), last = key_before(key, n, to);
  widen_between(key + first, from, lo, hi);
  for (uint32_t k = first + 1; k <= last; k++)
    widen(key[k].lo, key[k].hi, lo, hi);
  widen_between(key + last, to, lo, hi);
  return true;
}

/* --- Another frame -------------------------------------------------------- */

bool hsr_scene_moves(const struct hsr_scene *scene) {
  bool any = false;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    any |= scene->objects[o].moves;
  return any;
}

bool hsr_scene_has_frame(const struct hsr_scene *a, const struct hsr_scene *b) {
  if (a->n_objects != b->n_objects || a->n_instances != b->n_instances)
    return false;
  for (uint32_t o = 0; o < a->n_objects; o++)
    if (a->objects[o].n_faces != b->objects[o].n_faces ||
        a->objects[o].n_vertices != b->objects[o].n_vertices)
      return false;
  for (uint32_t i = 0; i < a->n_instances; i++)
    if (a->instances[i].object != b->instances[i].object)
      return false;
  return true;
}

/* Arrays of n floats, or both NULL. */
static bool are_same_floats(const float *a, const float *b, size_t n) {
  return !a == !b && (!a || !memcmp(a, b, n * sizeof *a));
}

static bool has_colours(const struct hsr_object *a,
                        const struct hsr_object *b) {
  size_t n = a->n_faces;
  return a->opacity == b->opacity && are_same_floats(a->colour, b->colour, 3) &&
         are_same_floats(a->rgb, b->rgb, 3 * n) &&
         are_same_floats(a->face_opacity, b->face_opacity, n);
}

/* Objects with as many faces and vertices. */
static bool is_same_object(const struct hsr_object *a,
                           const struct hsr_object *b) {
  size_t n = a->n_faces;
  if (a->one_sided != b->one_sided || a->moves != b->moves)
    return false;
  if (!n)
    return true;
  return has_colours(a, b) &&
         !memcmp(a->xyz, b->xyz, 3 * (size_t)a->n_vertices * sizeof *a->xyz) &&
         !memcmp(a->start, b->start, (n + 1) * sizeof *a->start) &&
         !memcmp(a->vertex, b->vertex, a->start[n] * sizeof *a->vertex);
}

bool hsr_scene_has_objects(const struct hsr_scene *a,
                           const struct hsr_scene *b) {
  bool same = !a->grid && !b->grid && hsr_scene_has_frame(a, b);
  for (uint32_t o = 0; same && o < a->n_objects; o++)
    same = is_same_object(&a->objects[o], &b->objects[o]);
  return same;
}

bool hsr_scene_is_same(const struct hsr_scene *a, const struct hsr_scene *b) {
  bool same = hsr_scene_has_objects(a, b);
  for (uint32_t i = 0; same && i < a->n_instances; i++)
    same =
        !memcmp(a->instances[i].m, b->instances[i].m, sizeof a->instances[i].m);
  return same;
}

/* What one instance must satisfy in a frame. */
struct promise {
  struct hsr_motion motion;
  double most;         /* the most that a coordinate may have changed */
  double lo[3], hi[3]; /* the box of its way */
};

static const char *broken_by(const struct promise *p, const double was[3],
                             const double is[3]) {
  for (int a = 0; a < 3; a++) {
    if (fabs(is[a] - was[a]) > p->most)
      return "moves too fast";
    if (is[a] < p->motion.lo[a] || is[a] > p->motion.hi[a])
      return "leaves its volume";
    if (is[a] < p->lo[a] || is[a] > p->hi[a])
      return "leaves its way";
  }
  return NULL;
}

/* Returns how an instance breaks its promise, for a message; NULL: it does
 * not. */
static const char *check_instance(const struct hsr_scene *scene,
                                  const struct hsr_scene *then, uint32_t i) {
  const struct hsr_object *object = &scene->objects[scene->instances[i].object];
  const double *old = scene->instances[i].m, *new = then->instances[i].m;
  if (!object->moves)
    return memcmp(old, new, 12 * sizeof *old) ? "does not move" : NULL;
  double frame = (double)hsr_scene_frame(then);
  double frames = fabs(frame - (double)hsr_scene_frame(scene));
  struct promise promise = {.motion = hsr_scene_motion(scene, i)};
  promise.most = frames > 0 ? promise.motion.speed * frames
                 : promise.motion.speed < INFINITY ? 0
                                                   : INFINITY;
  if (!hsr_scene_way(scene, i, frame, frame, promise.lo, promise.hi)) {
    struct hsr_motion anywhere = hsr_motion_unknown();
    memcpy(promise.lo, anywhere.lo, sizeof promise.lo);
    memcpy(promise.hi, anywhere.hi, sizeof promise.hi);
  }
  const char *broken = NULL;
  for (uint32_t v = 0; v < object->n_vertices && !broken; v++) {
    double was[3], is[3];
    hsr_instance_vertex(old, object->xyz + 3 * (size_t)v, was);
    hsr_instance_vertex(new, object->xyz + 3 * (size_t)v, is);
    broken = broken_by(&promise, was, is);
  }
  return broken;
}

static enum hsr_status check_all(const struct hsr_scene *scene,
                                 const struct hsr_scene *then,
                                 struct hsr_error *err) {
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const char *broken = check_instance(scene, then, i);
    if (broken)
      return hsr_fail(err, HSR_E_INPUT, "instance %u of object %s %s", i,
                      scene->objects[scene->instances[i].object].name, broken);
  }
  return HSR_OK;
}

enum hsr_status hsr_scene_check_motion(const struct hsr_scene *scene,
                                       struct hsr_error *err) {
  return scene->motions ? check_all(scene, scene, err) : HSR_OK;
}

enum hsr_status hsr_scene_follow(struct hsr_scene *scene,
                                 const struct hsr_scene *then,
                                 struct hsr_error *err) {
  if (!hsr_scene_has_frame(scene, then))
    return hsr_fail(err, HSR_E_INPUT, "%s is not a frame of %s", then->name,
                    scene->name);
  enum hsr_status status = check_all(scene, then, err);
  if (status)
    return status;
  if (hsr_scene_set_frame(scene, hsr_scene_frame(then)))
    return hsr_fail_nomem(err);
  memcpy(scene->instances, then->instances,
         scene->n_instances * sizeof *scene->instances);
  return HSR_OK;
}

/* --- For scene.c ---------------------------------------------------------- */

static void enlarge_box(double *lo, double *hi, int exponent) {
  for (int a = 0; a < 3; a++) {
    lo[a] = ldexp(lo[a], exponent);
    hi[a] = ldexp(hi[a], exponent);
  }
}

void hsr_motions_enlarge(struct hsr_motions *motions, int exponent) {
  for (uint32_t i = 0; motions && i < motions->n; i++) {
    struct hsr_motion *motion = &motions->of[i];
    motion->speed = ldexp(motion->speed, exponent);
    enlarge_box(motion->lo, motion->hi, exponent);
  }
  for (uint32_t k = 0; motions && k < motions->n_keys; k++)
    enlarge_box(motions->key[k].lo, motions->key[k].hi, exponent);
}

void hsr_motions_free(struct hsr_motions *motions) {
  if (motions) {
    free(motions->of);
    free(motions->key);
  }
  free(motions);
}
