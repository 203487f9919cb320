/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging anybody's picture of face ids, and saying what is wrong with it.
 *
 * Right       what docs/correct-picture.md defines: hsr_judge_ids decides.
 * Kinds       kinds.def. A fault of the whole picture is a supposition: the
 *             picture would be right if its rows ran the other way, if the
 *             camera were another. It holds if it explains at least half of the
 *             wrong samples. Then the picture is judged once more as it was
 *             supposed, and what is still wrong is looked at again. At last
 *             each sample that is left gets a kind of its own, by the faces
 *             that are over it.
 * Exact       the supposed pictures are the oracle's, with another camera. Which
 *             faces are over a sample, and in what order, the predicates of
 *             common/exact say. */
#ifndef HSR_BENCH_STRANGER_H
#define HSR_BENCH_STRANGER_H

#include "bench/library/library.h"

#include <stdio.h>

enum stranger_kind {
#define HSR_SAMPLE(id, key, words, rgb, colour) STRANGER_##id,
#include "bench/stranger/kinds.def"
#undef HSR_SAMPLE
#undef HSR_WHOLE
  STRANGER_KINDS
};

struct stranger_kind_info {
  const char *key, *words;
  uint32_t rgb;
  const char *colour;
};
extern const struct stranger_kind_info stranger_kinds[STRANGER_KINDS];

/* A reason, and how much it explains. */
struct stranger_reason {
  enum stranger_kind kind;
  char words[240];      /* what is said of it */
  uint64_t samples;     /* wrong ones that it explains */
  uint32_t place;       /* the first of those, j * m + i */
  uint32_t got, wanted; /* what is there; HSR_NO_FACE: no face */
};

enum { STRANGER_MOST_WHOLE = 3, STRANGER_MOST = STRANGER_KINDS };

struct stranger_verdict {
  int m, n;
  uint64_t compared, differing;
  int box[4];      /* x0, y0, x1, y1: it holds all samples that differ */
  char first[200]; /* the first that differs, in words */
  /* The reasons: those of the picture as a whole in the order in which they
   * were found, then those of samples, by how much they explain. */
  struct stranger_reason whole[STRANGER_MOST_WHOLE], sample[STRANGER_MOST];
  int n_whole, n_sample;
  uint64_t left;        /* wrong samples after all that is put right */
  unsigned char *kind;  /* of each sample, 1 + its kind; 0: it is right */
  char no_reasons[480]; /* why none are looked for; "" */
};

/* What is judged: m n ids for the camera and the size of a request. All
 * borrowed. */
struct stranger_question {
  struct lib_scene *scene;
  const struct hsr_request *request;
  const uint32_t *ids;
  const struct lib_scene
      *own; /* the same scene with its own views, where `scene`
                                  has others instead; NULL: it has not */
  /* Called before each kind of reason is tried, when `done` of `all` kinds have
   * been; with `context` of the request. NULL: nobody is told. */
  void (*tell)(void *context, int done, int all);
};

/* An id that is one less than that of face 0. */
#define STRANGER_BELOW_0 0xfffffffdu

/* Judges. *verdict is freed by stranger_free, also after a failure. Errors as
 * hsr_judge_ids. */
enum hsr_status stranger_judge(const struct stranger_question *question,
                               struct stranger_verdict *verdict,
                               struct hsr_error *err);
void stranger_free(struct stranger_verdict *verdict);

#endif
