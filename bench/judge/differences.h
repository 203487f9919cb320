/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What differs between two answers, as files to look at. */
#ifndef HSR_BENCH_DIFFERENCES_H
#define HSR_BENCH_DIFFERENCES_H

#include "common/answers/answer.h"

/* Where the files go, and what they are named after. All borrowed. */
struct compared_files {
  const char *folder; /* is there */
  const struct hsr_world *world;
  int view; /* from 1 */
  const char *algorithm;
  bool counts; /* it is the build that counts */
};

/* Writes FOLDER/SCENE-VIEW-MxN-ALGORITHM.png: the wanted picture, with what
 * differs marked. Where the kind of answer cannot be shown so, writes both
 * answers: ...-got and ...-wanted, as .svg or .vti. HSR_E_INPUT: a file cannot
 * be written; HSR_E_NOMEM. */
enum hsr_status write_difference(const struct compared_files *files,
                                 const struct hsr_comparison *comparison,
                                 struct hsr_error *err);

#endif
