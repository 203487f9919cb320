/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faults of a picture as a whole: suppositions are tried one after the other,
 * and the one that leaves the fewest samples wrong is put right. */
#include "bench/stranger/trial.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- A supposition -------------------------------------------------------- */

void drop(struct supposed *s) {
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

void try_this(struct trial *t, struct supposed *s, enum stranger_kind kind,
              const char *words) {
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

uint32_t *new_ids(const struct trial *t) {
  return malloc(t->now->all * sizeof(uint32_t));
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
  now->m = best->m;
  now->n = best->n;
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
      try_turns,   try_numbers, try_views,  try_places,
      try_borders, try_shifts,  try_fields, try_depths};
  enum { N_TRIES = sizeof tries / sizeof *tries };
  const struct stranger_question *question = t->studio->question;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < N_TRIES && !status; k++) {
    if (question->tell)
      question->tell(question->request->context, k, N_TRIES);
    status = tries[k](t);
  }
  return status || 2 * t->left < t->now->left ? status : try_pairs(t);
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
