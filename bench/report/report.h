/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr report share: data.c makes the numbers of the page,
 * pictures.c what there is to look at. The page itself is under reports/. */
#ifndef HSR_BENCH_REPORT_REPORT_H
#define HSR_BENCH_REPORT_REPORT_H

#include "bench/command.h"
#include "bench/results/results.h"

struct report {
  const struct results *results;
  const char *folder;    /* where all goes */
  const char *reference; /* whose time the others' are divided by */
  long most;             /* samples a row or column of a picture, at most */
  long timeout;          /* seconds that a picture may take */
};

/* The members of window.hsr but "pictures", as a new reference, or NULL and
 * *err: HSR_E_NOMEM. */
json_t *report_data(const struct report *report, struct hsr_error *err);

/* Draws the pictures of every scene and view of the results, by every algorithm
 * whose cells have a picture, and writes them under the folder, with what the
 * probe of the page needs. Returns "pictures" as a new reference, or NULL and
 * *err: HSR_E_NOMEM, HSR_E_INPUT (a scene is no longer there, or a file cannot
 * be written). */
json_t *report_pictures(const struct report *report, struct hsr_error *err);

/* Writes `before`, a value as compact JSON (NULL: nothing more) and `after`
 * into folder/name. Takes the reference to the value. */
enum hsr_status report_write(const struct report *report, const char *name,
                             const char *before, json_t *value,
                             const char *after, struct hsr_error *err);

#endif
