/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table that hsr bench and hsr times print. */
#include "bench/terminal/terminal.h"
#include "bench/times/rows.h"
#include "common/answers/answer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INTERVAL = 17 }; /* columns of one */

/* Whether there is room for two columns more. */
static bool is_wide(void) {
  int columns = terminal_columns(stdout);
  return !columns || columns >= 102;
}

/* A number of `digits` digits, or more if it is greater: never with an exponent
 * that would be wider than its column. */
static const char *number(double x, int digits, char text[24]) {
  bool whole = x >= 1000 && x < 1e6;
  snprintf(text, 24, whole ? "%.*f" : "%.*g", whole ? 0 : digits, x);
  return text;
}

/* "[1.231, 1.240]", in a column; empty where there is no interval. */
static void print_interval(double low, double high, double scale, int width) {
  char text[60] = "", from[24], to[24];
  if (!isnan(low))
    snprintf(text, sizeof text, "[%s, %s]", number(low * scale, 4, from),
             number(high * scale, 4, to));
  printf(" %-*s", width, text);
}

static double scale_of(double seconds) {
  return seconds < 1e-3 ? 1e6 : seconds < 1 ? 1e3 : 1;
}

static void print_heading(const struct row *row, bool first) {
  char key[RESULTS_KEY], plain[TERMINAL_NAME], title[TERMINAL_NAME];
  rows_name_place(row, key);
  snprintf(title, sizeof title, "%s", terminal_plain(key, plain, sizeof plain));
  printf("%s%-24s", first ? "" : "\n", title);
  if (strlen(title) > 24)
    printf("\n%24s", "");
  printf(" %10s %-17s %7s %-13s", "median", "95 % interval", "ratio",
         "99 % interval");
  if (is_wide())
    printf("  %10s %9s", "least", "memory");
  putchar('\n');
}

static void print_name(const json_t *cell) {
  char name[RESULTS_MOST_NAME + 40];
  long threads = results_number(cell, "threads");
  int length =
      snprintf(name, sizeof name, "%s", results_text(cell, "algorithm"));
  if (threads > 1)
    snprintf(name + length, sizeof name - (size_t)length, " (%ld threads)",
             threads);
  printf("  %-22s", name);
  if (strlen(name) > 22)
    printf("\n%24s", "");
}

static void print_times(const struct rows *rows, const struct row *row) {
  char text[ROWS_TIME];
  printf(" %10s", rows_time(row->median.value, text));
  print_interval(row->median.low, row->median.high, scale_of(row->median.value),
                 INTERVAL);
  if (!row->has_ratio)
    return;
  printf(" %6s%c", number(row->ratio.value, 3, text),
         rows_is_alike(rows, row) ? '~' : ' ');
  int width = is_wide() ? INTERVAL : 0;
  if (rows_has_few_starts(rows, row))
    printf(" %-*s", width, "too few starts");
  else
    print_interval(rows_is_reference(rows, row) ? NAN : row->ratio.low,
                   row->ratio.high, 1, width);
}

static void print_more(const struct row *row) {
  char text[ROWS_TIME];
  printf("%*s%10s", row->has_ratio ? 0 : 26, "", rows_time(row->least, text));
  if (row->memory_kb >= 0)
    printf(" %6.1f MB", (double)row->memory_kb / 1024);
}

/* The kind of answer of that name; NULL: there is none. */
static const struct hsr_answer_type *find_kind(const char *name) {
  int k = 0;
  while (hsr_answer_types[k] && strcmp(hsr_answer_types[k]->name, name))
    k++;
  return hsr_answer_types[k];
}

/* Says how many places were compared, if not all were. */
static void say_compared(const json_t *cell, char text[60]) {
  const struct hsr_answer_type *kind = find_kind(results_text(cell, "kind"));
  long compared = results_number(cell, "compared");
  long walk = results_number(cell, "walk");
  long all = results_number(cell, "width") * results_number(cell, "height") *
             (walk ? walk : 1);
  text[0] = '\0';
  if (compared && compared < all && kind && kind->by_places)
    snprintf(text, 60, " (judged at %ld %s)", compared, kind->places);
}

/* Whether there is nothing to say of a row but that it is right. */
static bool is_counted_only(const struct row *row) {
  char status[ROWS_STATUS], compared[60];
  rows_say_status(row, status);
  say_compared(row->cell, compared);
  return !row->timed && !*status && !*compared;
}

/* Prints the names of such rows, out of the n rows of a place. */
static void print_counted(const struct row *row, size_t n) {
  char *names = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&names, &size);
  for (size_t k = 0; out && k < n; k++)
    if (is_counted_only(&row[k]))
      fprintf(out, "%s%s", ftell(out) ? ", " : "",
              results_text(row[k].cell, "algorithm"));
  if (out && !fclose(out) && size)
    terminal_wrap(stdout, printf("  %-22s  ", "ok, not timed"), 26, names);
  free(names);
}

static void print_row(const struct rows *rows, const struct row *row) {
  char status[ROWS_STATUS + 60], compared[60];
  print_name(row->cell);
  rows_say_status(row, status);
  say_compared(row->cell, compared);
  if (row->timed)
    print_times(rows, row);
  if (row->timed && is_wide())
    print_more(row);
  strcat(status, compared);
  if (!*status)
    putchar('\n');
  else if (row->timed)
    terminal_wrap(stdout, printf("\n%24s", "") - 1, 26, status);
  else
    terminal_wrap(stdout, 24 + printf("  "), 26, status);
}

/* --- Noise ---------------------------------------------------------------- */

static int compare_doubles(const void *a, const void *b) {
  const double *x = a, *y = b;
  return (*x > *y) - (*x < *y);
}

/* The median over all rows of half the width of an interval, as a part of its
 * median; NAN if there are none. */
static double noise_of(const struct rows *rows) {
  double *part = malloc((rows->n + 1) * sizeof *part), noise = NAN;
  size_t n = 0;
  for (size_t k = 0; part && k < rows->n; k++) {
    const struct figure *m = &rows->row[k].median;
    if (rows->row[k].timed && !isnan(m->low))
      part[n++] = (m->high - m->low) / (2 * m->value);
  }
  if (n) {
    qsort(part, n, sizeof *part, compare_doubles);
    noise = part[n / 2];
  }
  free(part);
  return noise;
}

static void print_notes(const struct rows *rows) {
  bool any = false, marked = false, few = false;
  for (size_t k = 0; k < rows->n; k++) {
    const struct row *row = &rows->row[k];
    any |= row->has_ratio;
    marked |= rows_is_alike(rows, row);
    few |= rows_has_few_starts(rows, row);
  }
  char text[300];
  snprintf(text, sizeof text, "ratio: to the time of %s%s", rows->reference,
           marked ? "; ~: not distinguishable from it" : "");
  if (any) {
    putchar('\n');
    terminal_wrap(stdout, 0, 2, text);
  }
  if (few)
    terminal_wrap(stdout, 0, 2,
                  "too few starts: a ratio has an interval from three starts "
                  "on. Ask for more --starts, or a longer --budget");
  double noise = noise_of(rows);
  if (isnan(noise))
    return;
  snprintf(text, sizeof text,
           "noise: half of the medians are known to +-%.1f %%%s", 100 * noise,
           noise > .03
               ? ". To know them better, end other programs, or ask for "
                 "more --starts"
               : "");
  terminal_wrap(stdout, 0, 2, text);
}

/* The rows of a place: the times first, then what else there is to say. */
static void print_place(const struct rows *rows, const struct row *row,
                        size_t n, bool first) {
  print_heading(row, first);
  for (int timed = 1; timed >= 0; timed--)
    for (size_t k = 0; k < n; k++)
      if (row[k].timed == timed && !is_counted_only(&row[k]))
        print_row(rows, &row[k]);
  print_counted(row, n);
}

/* Places with times come first. */
void rows_print(const struct rows *rows) {
  bool first = true;
  for (int timed = 1; timed >= 0; timed--)
    for (size_t k = 0, end; k < rows->n; k = end) {
      const struct row *row = rows->row;
      bool any = false;
      for (end = k; end < rows->n && rows_same_place(&row[k], &row[end]); end++)
        any |= row[end].timed;
      if (any != timed)
        continue;
      print_place(rows, &row[k], end - k, first);
      first = false;
    }
  print_notes(rows);
}
