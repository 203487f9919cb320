/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kinds of single samples. A sample may be of several kinds; the kind that
 * explains most samples gets all that it explains, then the next. A hidden face
 * is the kind of what is left after that, since it says least of the cause.
 *
 * A fault of every comparison shows wherever there is something to compare. So it
 * is not supposed if many samples are right where it would make them wrong. */
#include "bench/stranger/over.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_KIND = STRANGER_TIE, SURROUNDINGS = 8 };

/* A fault of every comparison may have one exception for as many samples that it
 * explains. */
enum { FOR_AN_EXCEPTION = 8 };
#define KIND(kind) (1u << (STRANGER_##kind - FIRST_KIND))

struct looking {
  struct overlook over;
  const struct supposed *now;
  double unit;                    /* of q, in 24 bits of depth */
  uint32_t *beside[SURROUNDINGS]; /* what is right half a sample away */
  bool is_empty;                  /* one id is everywhere */
  uint16_t *kinds;                /* of each sample that differs */
  /* Of each kind of fault of every comparison: the samples that are right, but
   * would not be. */
  uint64_t against[STRANGER_WRONG - FIRST_KIND];
};

/* --- Depth ---------------------------------------------------------------- */

/* A unit of the last of 24 bits, if depths are kept as OpenGL does, from the
 * near plane to the farthest face that is seen. Where there is no near plane,
 * the nearest face takes its place. */
static enum hsr_status find_unit(struct looking *l, const struct studio *studio,
                                 struct hsr_error *err) {
  const struct supposed *now = l->now;
  float *depth = malloc(now->all * sizeof *depth);
  double least = INFINITY, most = 0;
  if (!depth)
    return hsr_fail_nomem(err);
  hsr_picture_depth(studio->world, &now->view, now->wanted, depth);
  for (size_t k = 0; k < now->all; k++) {
    double t = (double)depth[k];
    least = t < least ? t : least;
    most = isfinite(t) && t > most ? t : most;
  }
  if (now->view.near > 0)
    least = now->view.near;
  l->unit = 0;
  if (least < most)
    l->unit = now->view.parallel ? most - least : 1 / least - 1 / most;
  l->unit *= 0x1p-24;
  free(depth);
  return HSR_OK;
}

/* Whether p is nearer than g by less than a unit, or than a float can tell. */
static bool is_within_unit(struct looking *l, uint32_t p, uint32_t g, int i,
                           int j) {
  const struct hsr_screen *s = &l->over.screen;
  double near = hsr_depth(s, p, i, j), far = hsr_depth(s, g, i, j);
  double unit = fmax(l->unit, fabs(far) * 0x1p-23);
  return near - far <= unit + s->plane[p].error + s->plane[g].error;
}

/* --- A sample ------------------------------------------------------------- */

/* What is over a sample, what is seen there, and what should be. */
struct case_ {
  int i, j;
  uint32_t got;
  const struct over *over;
  size_t n;
};

static size_t find(const struct case_ *c, uint32_t face) {
  size_t k = 0;
  while (k < c->n && c->over[k].face != face)
    k++;
  return k;
}

/* Whether each face that exists before number `end` has the property. */
static bool all_before(struct looking *l, const struct case_ *c, size_t end,
                       bool (*has)(struct looking *l, uint32_t p, uint32_t g,
                                   int i, int j)) {
  for (size_t k = 0; k < end; k++)
    if (c->over[k].exists && !has(l, c->over[k].face, c->got, c->i, c->j))
      return false;
  return true;
}

static bool is_tied(struct looking *l, uint32_t p, uint32_t g, int i, int j) {
  return is_tie(&l->over, p, g, i, j);
}

static bool has_edge(struct looking *l, uint32_t p, uint32_t g, int i, int j) {
  (void)g;
  return has_edge_near(&l->over, p, i, j);
}

/* The first face for which a test holds; HSR_NO_FACE if there is none. */
enum test { ANY, TURNED, FRONT };
static uint32_t first_of(const struct case_ *c, enum test test) {
  for (size_t k = 0; k < c->n; k++) {
    const struct over *o = &c->over[k];
    bool holds = test == ANY      ? true
                 : test == TURNED ? o->turned
                                  : o->exists && !o->turned;
    if (holds)
      return o->face;
  }
  return HSR_NO_FACE;
}

/* The number of the first face, or the last, that exists; n if none does. */
static size_t existing(const struct case_ *c, bool last) {
  size_t found = c->n;
  for (size_t k = 0; k < c->n && (last || found == c->n); k++)
    if (c->over[k].exists)
      found = k;
  return found;
}

/* Kinds of sides. `w` is the number of what is right. */
static unsigned sides(const struct case_ *c, size_t w, size_t g) {
  unsigned kinds = 0;
  bool turned = w < c->n && c->over[w].turned;
  if (g < c->n && !c->over[g].exists && c->got == first_of(c, ANY))
    kinds |= KIND(BACK);
  if (w < c->n && !turned && c->got == first_of(c, TURNED))
    kinds |= KIND(FRONT_CULLED);
  if (turned && c->got == first_of(c, FRONT))
    kinds |= KIND(BACK_CULLED);
  return kinds;
}

/* Kinds of those who take a face by its number: the last one or the first one,
 * among those that exist, or among all. */
static unsigned numbers(const struct case_ *c) {
  bool last[2] = {true, true}, first[2] = {true, true};
  for (size_t k = 0; k < c->n; k++)
    for (int all = 0; all < 2; all++)
      if (all || c->over[k].exists) {
        last[all] &= c->over[k].face <= c->got;
        first[all] &= c->over[k].face >= c->got;
      }
  return (last[0] || last[1] ? KIND(LAST) : 0) |
         (first[0] || first[1] ? KIND(FIRST) : 0);
}

/* The face is seen half a sample away; or it would be seen here, if faces with
 * an edge within half a sample might cover the sample or not. */
static bool is_at_edge(struct looking *l, const struct case_ *c, size_t g) {
  size_t place = (size_t)c->j * (size_t)l->now->m + (size_t)c->i;
  for (int k = 0; k < SURROUNDINGS; k++)
    if (l->beside[k] && l->beside[k][place] == c->got)
      return true;
  if (c->got == HSR_NO_FACE || g < c->n)
    return all_before(l, c, g, has_edge);
  if (!exists(&l->over, c->got) || !has_edge_near(&l->over, c->got, c->i, c->j))
    return false;
  size_t end = 0;
  while (end < c->n && hsr_nearer(&l->over.screen, c->over[end].face, c->got,
                                  c->i, c->j, &l->over.tally))
    end++;
  return all_before(l, c, end, has_edge);
}

/* All kinds that the sample may be of. */
static unsigned kinds_of(struct looking *l, const struct case_ *c,
                         uint32_t wanted) {
  size_t w = existing(c, false), g = find(c, c->got);
  uint32_t n_faces = l->over.world->n_faces;
  if (c->got >= n_faces && c->got != HSR_NO_FACE)
    return KIND(NO_SUCH);
  if ((w < c->n ? c->over[w].face : HSR_NO_FACE) != wanted)
    return 0; /* what is right is only supposed */
  unsigned kinds = sides(c, w, g);
  if (g < c->n && c->over[g].exists) {
    if (all_before(l, c, g, is_tied))
      kinds |= KIND(TIE);
    if (all_before(l, c, g, is_within_unit))
      kinds |= KIND(DEPTH);
    if (g == existing(c, true))
      kinds |= KIND(FARTHEST);
    kinds |= KIND(HIDDEN);
  }
  if (is_at_edge(l, c, g))
    kinds |= KIND(EDGE);
  if (g < c->n)
    kinds |= numbers(c);
  return kinds;
}

/* --- All samples ---------------------------------------------------------- */

static enum hsr_status draw_beside(struct looking *l,
                                   const struct studio *studio,
                                   struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0, n = 0; k < 9 && !status; k++) {
    struct hsr_view view = l->now->view;
    if (k == 4)
      continue;
    view.offset_x += (k % 3 - 1) / 2.0;
    view.offset_y += (k / 3 - 1) / 2.0;
    if (fabs(view.offset_x) <= .5 && fabs(view.offset_y) <= .5)
      status = studio_draw(studio, &view, &l->beside[n++], err);
  }
  return status;
}

/* Counts a sample that is right against the faults that would make it wrong. */
static void count_against(struct looking *l, const struct case_ *c,
                          uint64_t samples) {
  unsigned would_be = numbers(c);
  if (existing(c, false) == existing(c, true))
    return;
  l->against[STRANGER_FARTHEST - FIRST_KIND] += samples;
  if (!(would_be & KIND(LAST)))
    l->against[STRANGER_LAST - FIRST_KIND] += samples;
  if (!(would_be & KIND(FIRST)))
    l->against[STRANGER_FIRST - FIRST_KIND] += samples;
}

/* Counts a sample that shows a hidden face against the faults of the whole
 * picture that would have shown another: the first face, the last, the farthest.
 */
static void count_hidden_against(struct looking *l, unsigned kinds,
                                 uint64_t samples) {
  static const enum stranger_kind whole[] = {STRANGER_FARTHEST, STRANGER_LAST,
                                             STRANGER_FIRST};
  if (kinds & KIND(HIDDEN) && !(kinds & (KIND(EDGE) | KIND(TIE) | KIND(DEPTH))))
    for (int k = 0; k < 3; k++)
      if (!(kinds & 1u << (whole[k] - FIRST_KIND)))
        l->against[whole[k] - FIRST_KIND] += samples;
}

static enum hsr_status look_at_row(struct looking *l, int j,
                                   struct hsr_error *err) {
  const struct supposed *now = l->now;
  const size_t begin = (size_t)j * (size_t)now->m;
  size_t differing =
      count_differing(now->got + begin, now->wanted + begin, (size_t)now->m);
  enum hsr_status status = differing ? overlook_row(&l->over, j, err) : HSR_OK;
  const size_t step = 1 + now->all / RIGHT_LOOKED_AT;
  for (int i = 0; differing && i < now->m && !status; i++) {
    size_t k = begin + (size_t)i;
    bool right = now->got[k] == now->wanted[k];
    if (!is_looked_at(now, k))
      continue;
    struct case_ c = {.i = i, .j = j, .got = now->got[k]};
    c.over = overlook_sample(&l->over, i, j, &c.n);
    if (c.over && right)
      count_against(l, &c, step);
    else if (c.over) {
      unsigned kinds = kinds_of(l, &c, now->wanted[k]);
      count_hidden_against(l, kinds, step);
      l->kinds[k] = (uint16_t)(kinds | (l->is_empty ? KIND(EMPTY) : 0));
    }
    if (!c.over || l->over.tally.out_of_memory)
      status = hsr_fail_nomem(err);
  }
  return status;
}

static enum hsr_status look(struct looking *l, const struct studio *studio,
                            const struct supposed *now, struct hsr_error *err) {
  l->now = now;
  l->is_empty = now->all > 1 && is_uniform(now->got, now->all);
  l->kinds = calloc(now->all, sizeof *l->kinds);
  enum hsr_status status = overlook_open(&l->over, studio, now, err);
  if (!status && !l->kinds)
    status = hsr_fail_nomem(err);
  if (!status)
    status = find_unit(l, studio, err);
  if (!status)
    status = draw_beside(l, studio, err);
  for (int j = 0; j < now->n && !status; j++)
    status = look_at_row(l, j, err);
  return status;
}

static void stop_looking(struct looking *l) {
  overlook_close(&l->over);
  for (int k = 0; k < SURROUNDINGS; k++)
    free(l->beside[k]);
  free(l->kinds);
}

/* --- The kinds ------------------------------------------------------------ */

/* Gives a kind to all samples that may be of it and have none yet. */
static void assign(struct looking *l, enum stranger_kind kind,
                   struct stranger_verdict *verdict) {
  const struct supposed *now = l->now;
  struct stranger_reason *reason = &verdict->sample[verdict->n_sample++];
  *reason = (struct stranger_reason){.kind = kind};
  snprintf(reason->words, sizeof reason->words, "%s",
           stranger_kinds[kind].words);
  for (size_t k = 0; k < now->all; k++) {
    bool is_of =
        kind == STRANGER_WRONG || l->kinds[k] & 1u << (kind - FIRST_KIND);
    if (now->got[k] == now->wanted[k] || !is_of ||
        verdict->kind[now->origin[k]])
      continue;
    verdict->kind[now->origin[k]] = (unsigned char)(1 + kind);
    l->kinds[k] = 0;
    if (!reason->samples++) {
      reason->place = now->origin[k];
      reason->got = now->got[k];
      reason->wanted = now->wanted[k];
    }
  }
}

/* The kind that most of the samples left may be of, and how many. */
static enum stranger_kind usual_kind(const struct looking *l, uint64_t *most) {
  enum { KINDS = STRANGER_HIDDEN - FIRST_KIND };
  uint64_t n[KINDS + 1] = {0};
  int best = 0;
  for (size_t k = 0; k < l->now->all; k++)
    for (int kind = 0; l->kinds[k] >> kind; kind++)
      n[kind] += l->kinds[k] >> kind & 1;
  for (int kind = 0; kind < KINDS; kind++)
    if (l->against[kind] > n[kind] / FOR_AN_EXCEPTION)
      n[kind] = 0;
  for (int kind = 1; kind < KINDS; kind++)
    if (n[kind] > n[best])
      best = kind;
  *most = n[best];
  return (enum stranger_kind)(FIRST_KIND + best);
}

static int compare_reasons(const void *a, const void *b) {
  const struct stranger_reason *p = a, *q = b;
  return (p->samples < q->samples) - (p->samples > q->samples);
}

static void name_kinds(struct looking *l, struct stranger_verdict *verdict) {
  uint64_t most;
  enum stranger_kind kind;
  while ((kind = usual_kind(l, &most), most))
    assign(l, kind, verdict);
  for (kind = STRANGER_HIDDEN; kind <= STRANGER_WRONG; kind++) {
    assign(l, kind, verdict);
    if (!verdict->sample[verdict->n_sample - 1].samples)
      verdict->n_sample--;
  }
  qsort(verdict->sample, (size_t)verdict->n_sample, sizeof *verdict->sample,
        compare_reasons);
}

enum hsr_status find_samples(const struct studio *studio,
                             const struct supposed *now,
                             struct stranger_verdict *verdict,
                             uint64_t *certain, struct hsr_error *err) {
  struct looking *l = calloc(1, sizeof *l);
  const unsigned sure =
      KIND(TIE) | KIND(BACK) | KIND(FRONT_CULLED) | KIND(BACK_CULLED);
  *certain = 0;
  if (!l)
    return hsr_fail_nomem(err);
  enum hsr_status status = look(l, studio, now, err);
  for (size_t k = 0; k < now->all && !status; k++)
    *certain += (l->kinds[k] & sure) != 0;
  if (!status && verdict)
    name_kinds(l, verdict);
  stop_looking(l);
  free(l);
  return status;
}
