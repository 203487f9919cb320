/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows as a LaTeX table, which needs the package booktabs. What has no time is
 * said in the columns of times, as in the table of the terminal. */
#include "bench/times/rows.h"

#include <stdlib.h>
#include <string.h>

/* Puts text in which LaTeX's own characters stand for themselves. */
static void put_text(const char *text) {
  static const char *const as[128] = {['\\'] = "\\textbackslash{}",
                                      ['~'] = "\\textasciitilde{}",
                                      ['^'] = "\\textasciicircum{}",
                                      ['<'] = "\\textless{}",
                                      ['>'] = "\\textgreater{}",
                                      ['|'] = "\\textbar{}",
                                      ['"'] = "\\textquotedbl{}",
                                      ['_'] = "\\_",
                                      ['#'] = "\\#",
                                      ['$'] = "\\$",
                                      ['%'] = "\\%",
                                      ['&'] = "\\&",
                                      ['{'] = "\\{",
                                      ['}'] = "\\}"};
  for (const unsigned char *c = (const unsigned char *)text; *c; c++)
    if (*c < 128 && as[*c])
      fputs(as[*c], stdout);
    else
      putchar(*c);
}

/* "$1.23$", or with a power of ten "$1.23 \cdot 10^{6}$". */
static void put_number(double x, int digits) {
  char text[40], *exponent;
  bool whole = x >= 1000 && x < 1e6;
  snprintf(text, sizeof text, whole ? "%.*f" : "%.*g", whole ? 0 : digits, x);
  exponent = strchr(text, 'e');
  if (exponent)
    *exponent++ = '\0';
  printf("$%s", text);
  if (exponent)
    printf(" \\cdot 10^{%d}", atoi(exponent));
  putchar('$');
}

static void put_interval(const struct figure *figure, double scale) {
  if (!figure_has_interval(figure))
    return;
  putchar('[');
  put_number(figure->low * scale, 4);
  fputs(", ", stdout);
  put_number(figure->high * scale, 4);
  putchar(']');
}

/* Milliseconds in all rows, so that they can be compared. */
static void put_times(const struct rows *rows, const struct row *row) {
  put_number(row->median.value * 1e3, 4);
  fputs(" & ", stdout);
  put_interval(&row->median, 1e3);
  fputs(" & ", stdout);
  if (row->has_ratio)
    put_number(row->ratio.value, 3);
  fputs(rows_is_alike(rows, row) ? "\\rlap{$^\\ast$} & " : " & ", stdout);
  if (rows_has_few_starts(rows, row))
    fputs("too few starts", stdout);
  else if (row->has_ratio && !rows_is_reference(rows, row))
    put_interval(&row->ratio, 1);
}

static void put_row(const struct rows *rows, const struct row *row) {
  long threads = results_number(row->cell, "threads");
  put_text(results_text(row->cell, "algorithm"));
  if (threads > 1)
    printf(" (%ld threads)", threads);
  fputs(" & ", stdout);
  if (row->timed)
    put_times(rows, row);
  else {
    char status[ROWS_STATUS];
    rows_say_status(row, status);
    fputs("\\multicolumn{4}{l}{", stdout);
    put_text(*status ? status : "ok, not timed");
    putchar('}');
  }
  puts(" \\\\");
}

static void put_heading(const struct row *row) {
  char key[RESULTS_KEY];
  rows_name_place(row, key);
  fputs("\\midrule\n\\multicolumn{5}{l}{\\textbf{", stdout);
  put_text(key);
  puts("}} \\\\");
}

void rows_print_latex(const struct rows *rows) {
  puts("% \\usepackage{booktabs}\n"
       "\\begin{tabular}{lrlrl}\n"
       "\\toprule\n"
       "algorithm & median, ms & 95\\,\\% interval & ratio & 99\\,\\% interval "
       "\\\\");
  bool marked = false;
  for (size_t k = 0; k < rows->n; k++) {
    marked |= rows->row[k].timed && rows_is_alike(rows, &rows->row[k]);
    if (!k || !rows_same_place(&rows->row[k - 1], &rows->row[k]))
      put_heading(&rows->row[k]);
    put_row(rows, &rows->row[k]);
  }
  fputs("\\bottomrule\n\\end{tabular}\n% Ratios are to the time of ", stdout);
  puts(rows->reference);
  if (marked)
    puts("% An asterisk: not distinguishable from it.");
}
