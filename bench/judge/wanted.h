/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is right: which places of a picture are compared, and what the oracle
 * shows there. */
#ifndef HSR_BENCH_WANTED_H
#define HSR_BENCH_WANTED_H

#include "algorithms/setup.h"

/* The oracle of a kind of answer; NULL if there is none. That of a kind which is
 * folded draws the pictures that its judge folds (bench/judge/folded.def). */
const struct hsr_algorithm *oracle_of(const struct hsr_answer_type *kind);

/* How many faces a scene may have to be laid out for an algorithm or for the
 * oracle of what it is asked for; 0: neither needs that. */
uint32_t most_to_judge(const struct hsr_listed *listed,
                       const struct hsr_choice *choice);

/* How many places of each picture to compare, 0: all. Unless the user wants a
 * number, all, but of scenes whose faces are too many to be laid out. */
enum { SAMPLES_OF_MANY_FACES = 20000, MOST_SAMPLES = 1 << 28 };
long samples_to_compare(const struct hsr_world *world,
                        const struct hsr_form *form, long wanted);

/* Chooses `wanted` of the m x n places of the view with this number, from 0:
 * the same ones in every run. *place is the caller's to free, j * m + i,
 * ascending, *n of them; NULL, and all of them, if all are wanted or 0.
 * HSR_E_NOMEM. */
enum hsr_status choose_places(int number, int m, int n, size_t wanted,
                              uint32_t **place, size_t *n_places);

/* What the oracle makes of a view. */
struct wanted {
  struct hsr_answer answer;
  uint32_t *sample; /* those that it was asked for, number j * m + i, ascending;
                       NULL: all */
  size_t n;         /* how many */
  struct hsr_world world; /* of a frame, which the answer may refer to; else
                             empty */
};

struct group; /* bench/judge/judge.h */

/* Asks for all views of a group: wanted[k] is of view k. They are to be freed
 * also after a failure, which is HSR_E_NOMEM or the oracle's. */
enum hsr_status ask_oracle(const struct group *group,
                           const struct hsr_algorithm *oracle,
                           struct wanted *wanted, struct hsr_error *err);

/* NULL is allowed. */
void free_wanted(const struct group *group, struct wanted *wanted);

/* An empty answer for a view, which shows what an algorithm does not write. To
 * be freed by hsr_answer_free. HSR_E_NOMEM. */
enum hsr_status clean_answer(struct hsr_answer *answer,
                             const struct hsr_setup *setup,
                             const struct hsr_view *view,
                             struct hsr_error *err);

#endif
