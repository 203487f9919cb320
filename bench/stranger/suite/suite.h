/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging all pictures of a suite (hsr suite) that somebody has drawn. */
#ifndef HSR_BENCH_STRANGER_SUITE_H
#define HSR_BENCH_STRANGER_SUITE_H

#include "bench/stranger/stranger.h"

#include <jansson.h>

enum suite_state { SUITE_RIGHT, SUITE_WRONG, SUITE_MISSING, SUITE_UNUSABLE };

/* What may be judged beside the ids, if there is a file of it. */
enum suite_extra_kind { SUITE_DEPTHS, SUITE_SEGMENTS, SUITE_EXTRAS };

/* Of one picture, or of all of them. */
struct suite_extra {
  size_t pictures;              /* that have a file of it */
  uint64_t compared, differing; /* samples; edges */
  double largest;    /* relative error of a depth, where both are finite */
  const char *first; /* a picture in which something differs; NULL */
  char why[480];     /* a file is unusable; "" */
};

/* "depths": the word of its files, NAME.depths.npy; and "depths", "edges". */
const char *suite_extra_name(enum suite_extra_kind kind);
const char *suite_extra_places(enum suite_extra_kind kind);

/* What became of one picture. The texts are the suite's. */
struct suite_result {
  const char *name, *scene, *group;
  uint32_t view; /* of the scene's file, from 0 */
  int m, n;
  enum suite_state state;
  uint64_t compared, differing;
  uint64_t kind[STRANGER_KINDS]; /* wrong samples of each */
  uint32_t place;                /* the first that is wrong, j m + i */
  uint32_t got, wanted;          /* there; HSR_NO_FACE: no face */
  unsigned char *kinds;          /* m n: 1 + the kind of each; 0: right. NULL
                                    unless it is wrong */
  char why[480];                 /* it is unusable */
  struct suite_extra extra[SUITE_EXTRAS];
};

struct suite_judgement {
  const char *suite, *results; /* folders; borrowed */
  json_t *about;               /* cases.json */
  struct suite_result *result;
  size_t n;
  /* Of all pictures: */
  size_t state[SUITE_UNUSABLE + 1];
  uint64_t compared, differing, kind[STRANGER_KINDS];
  size_t pictures[STRANGER_KINDS]; /* that have each */
  struct suite_extra extra[SUITE_EXTRAS];
};

/* Whether all pictures are right, and all depths and segments that are there. */
bool suite_is_right(const struct suite_judgement *judgement);

/* Judges the depths and the segments of a picture, if there are files of them
 * (suite/extras.c). What is wrong with somebody's file is said in `why`.
 * HSR_E_INPUT if a file of the suite is wrong; HSR_E_NOMEM. */
enum hsr_status suite_judge_extras(const struct suite_judgement *judgement,
                                   struct suite_result *result,
                                   struct hsr_error *err);

/* Judges the files NAME.npy in a folder. Those that are missing or unusable are
 * counted as such. To be freed also after a failure. HSR_E_INPUT if the suite is
 * not whole, or the folder has none of its pictures; HSR_E_NOMEM. */
enum hsr_status suite_judge(struct suite_judgement *judgement,
                            const char *suite, const char *results,
                            struct hsr_error *err);
void suite_free(struct suite_judgement *judgement);

/* The kind that most wrong samples of a picture are of. */
enum stranger_kind suite_worst(const uint64_t kind[STRANGER_KINDS]);

void suite_say_text(const struct suite_judgement *judgement);

/* Prints one JSON object. HSR_E_NOMEM. */
enum hsr_status suite_say_json(const struct suite_judgement *judgement,
                               struct hsr_error *err);

/* Writes a page that needs no other file. Errors as hsr_whole_file_open. */
enum hsr_status suite_write_page(const struct suite_judgement *judgement,
                                 const char *path, struct hsr_error *err);

#endif
