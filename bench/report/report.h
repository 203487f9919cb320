/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr report share: data.c makes the numbers of the page,
 * from cells.c and ladders.c; pictures.c makes its pictures; lessons.c the pages
 * on which algorithms are watched; laboratory.c the laboratory beside them; errors.c takes in what hsr errors found. The
 * page itself is under reports/. */
#ifndef HSR_BENCH_REPORT_REPORT_H
#define HSR_BENCH_REPORT_REPORT_H

#include "bench/results/results.h"

struct report {
  const struct results *results;
  const char *const *errors; /* files of hsr errors --json */
  int n_errors;
  const char *folder;    /* where all files go */
  const char *reference; /* the algorithm by whose time others are divided */
  long most;             /* the most samples in a picture's row or column */
  long timeout;          /* seconds that a picture may take */
  long budget;           /* that all may take together; 0: none are made */
};

/* All members of window.hsr except those of the functions below, as a new
 * reference; or NULL and *err: HSR_E_NOMEM. */
json_t *report_data(const struct report *report, struct hsr_error *err);

/* Draws the scenes and views of the results, by every algorithm whose cells
 * have a picture, as long as there is time. Writes the pictures under the
 * folder, with the data for the page's probe. Sets "pictures" and "left_out" of
 * the data. HSR_E_NOMEM; HSR_E_INTERNAL if no process can be started. */
enum hsr_status report_pictures(const struct report *report, json_t *data,
                                struct hsr_error *err);

/* Writes the lessons of the survey, and pages of the first small scenes of the
 * results, on which those algorithms can be watched that drew them right. Sets
 * "lessons" of the data: [{file, scene or null, names of algorithms}, ...]. They lead
 * to the laboratory if report_laboratory has put it there. Fails
 * as lesson_survey; a scene that cannot be shown is left out. */
enum hsr_status report_lessons(const struct report *report, json_t *data,
                               struct hsr_error *err);

/* Copies the page of the laboratory into the folder, if it is built. Then it sets
 * "laboratory" of the data: {file, scenes: those of the results that the page makes
 * by their names}. HSR_E_INPUT if it cannot be copied; HSR_E_NOMEM. */
#define REPORT_LABORATORY "lab.html"
enum hsr_status report_laboratory(const struct report *report, json_t *data,
                                  struct hsr_error *err);

/* Sets "errors" of the data: what the files of hsr errors say. Copies their
 * pictures, if they are beside these files. HSR_E_INPUT: a file is not of that
 * kind, or cannot be read. HSR_E_NOMEM. */
enum hsr_status report_errors(const struct report *report, json_t *data,
                              struct hsr_error *err);

/* Joins the files, one after the other, into folder/name. HSR_E_INPUT. */
enum hsr_status report_join(const char *const *from, int n, const char *folder,
                            const char *name, struct hsr_error *err);

/* Writes a script into folder/name: `before`, the value, `after`. The value is
 * a text that the script parses: a browser reads that twice as fast as the same
 * value written as a literal, and takes no name in it for one of its own. Takes
 * the reference to the value. HSR_E_INPUT if the file cannot be written;
 * HSR_E_NOMEM if the value is NULL. */
enum hsr_status report_write(const struct report *report, const char *name,
                             const char *before, json_t *value,
                             const char *after, struct hsr_error *err);

#endif
