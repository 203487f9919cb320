/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of results with their figures, a row each, and the ways to print
 * them: as a table, as CSV or JSON, or as a plot. */
#ifndef HSR_BENCH_TIMES_ROWS_H
#define HSR_BENCH_TIMES_ROWS_H

#include "bench/results/figures.h"
#include "bench/results/results.h"

/* A cell of the results. Seconds and ratios are NAN where there are none. */
struct row {
  const json_t *cell; /* borrowed from the results */
  bool timed;
  struct figure median; /* seconds, with a 95 % interval */
  double least;         /* seconds */
  struct figure ratio;  /* to the reference, with a 99 % interval */
  bool has_ratio;
  long memory_kb; /* the peak of its processes, above what they held before the
                     scene was opened; -1: not known */
};

struct rows {
  const char *reference; /* the algorithm by whose time others are divided */
  struct row *row;       /* in the order of the results */
  size_t n;
};

/* Makes the rows of all cells, which the caller frees also after a failure.
 * `reference` is borrowed; if it was not timed, the first algorithm that was
 * takes its place, whose name is that of `results`. HSR_E_NOMEM. */
enum hsr_status rows_make(struct rows *rows, const struct results *results,
                          const char *reference, struct hsr_error *err);
void rows_free(struct rows *rows);

/* Whether two rows are of one scene, view and size. */
bool rows_same_place(const struct row *a, const struct row *b);

/* Whether the row is of the algorithm by whose time the others are divided. */
bool rows_is_reference(const struct rows *rows, const struct row *row);

/* Whether the interval of a row's ratio says that its time may be the
 * reference's. */
bool rows_is_alike(const struct rows *rows, const struct row *row);

/* Why a row lacks a figure or an interval, in a few words; "" if it lacks none. */
const char *rows_why_empty(const struct rows *rows, const struct row *row);

/* Whether a row has a ratio whose interval is not known for lack of starts. */
bool rows_has_few_starts(const struct rows *rows, const struct row *row);

/* A time in words, in the unit that `seconds` suggests: "1.234 ms". Returns
 * `text`. */
enum { ROWS_TIME = 24 };
char *rows_time(double seconds, char text[ROWS_TIME]);

/* Prints a table that fits the terminal. Below it, says how noisy the machine
 * was. */
void rows_print(const struct rows *rows);

/* What there is to say of a row besides times: "wrong: 417 of 512 differ"; "":
 * nothing. */
enum { ROWS_STATUS = 900 };
void rows_say_status(const struct row *row, char text[ROWS_STATUS]);

/* Names a row's scene, view and size: "house 1 512x512". */
void rows_name_place(const struct row *row, char name[RESULTS_KEY]);

/* Print on stdout. HSR_E_NOMEM, HSR_E_INPUT. */
void rows_print_csv(const struct rows *rows);
void rows_print_latex(const struct rows *rows);
enum hsr_status rows_print_json(const struct rows *rows, struct hsr_error *err);

/* Writes a plot of the times, sorted, with their intervals; a panel for each
 * scene, view and size: .svg, .pdf or .png. HSR_E_INPUT, also if there is
 * nothing to plot; HSR_E_NOMEM. */
enum hsr_status rows_plot(const struct rows *rows, const char *path,
                          struct hsr_error *err);
bool rows_plot_fits(const char *path);

#endif
