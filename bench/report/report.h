/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr report share: data.c makes the numbers of the page,
 * pictures.c makes its pictures. The page itself is under reports/. */
#ifndef HSR_BENCH_REPORT_REPORT_H
#define HSR_BENCH_REPORT_REPORT_H

#include "bench/command.h"
#include "bench/results/results.h"

struct report {
  const struct results *results;
  const char *folder;    /* where all files go */
  const char *reference; /* the algorithm by whose time others are divided */
  long most;             /* the most samples in a picture's row or column */
  long timeout;          /* seconds that a picture may take */
};

/* All members of window.hsr except "pictures", as a new reference; or NULL and
 * *err: HSR_E_NOMEM. */
json_t *report_data(const struct report *report, struct hsr_error *err);

/* Draws the pictures of every scene and view of the results, by every algorithm
 * whose cells have a picture. Writes them under the folder, with the data for
 * the page's probe. Returns "pictures" as a new reference, or NULL and *err:
 * HSR_E_NOMEM, HSR_E_INPUT (a scene is no longer there, or a file cannot be
 * written). */
json_t *report_pictures(const struct report *report, struct hsr_error *err);

/* Writes three things into folder/name: `before`, the value as compact JSON,
 * and `after`. Takes the reference to the value. HSR_E_INPUT if the file cannot
 * be written; HSR_E_NOMEM if the value is NULL. */
enum hsr_status report_write(const struct report *report, const char *name,
                             const char *before, json_t *value,
                             const char *after, struct hsr_error *err);

#endif
