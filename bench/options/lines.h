/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of how lines are drawn: which, by what pens, in what layers. */
#ifndef HSR_BENCH_OPTIONS_LINES_H
#define HSR_BENCH_OPTIONS_LINES_H

#include "bench/options/parser.h"
#include "common/paper/lines/line_style.h"

enum { MOST_LINE_OPTIONS = 32, MOST_PEN = 80 };
struct line_options {
  const char *style; /* a name or a file; NULL: "screen" */
  bool has_crease;
  double crease;      /* if so, degrees; negative: all edges are drawn */
  const char *hidden; /* a word of enum hsr_hidden; or NULL */
  bool has_layers, by_pen_travel;
  enum hsr_layers layers; /* if has_layers */
  struct line_pen_option {
    int key; /* LINE_SILHOUETTE ... */
    char words[MOST_PEN];
    struct hsr_line_rule rule;
  } pen[MOST_LINE_OPTIONS]; /* a later one overrules an earlier one */
  size_t n_pens;
  struct hsr_line_rule hatch; /* what is said of the pen of hatches */
};

/* Entries for an argp option array, and their parser. ARGP_ERR_UNKNOWN if `key`
 * is none of them. */
enum {
  LINE_STYLE = 0x600,
  LINE_SILHOUETTE,
  LINE_BOUNDARY,
  LINE_INTERSECTION,
  LINE_CREASE,
  LINE_COLOUR,
  LINE_SEAM,
  LINE_SMOOTH,
  LINE_HIDDEN,
  LINE_LAYERS,
  LINE_ORDER
};
#define LINE_ARGP_OPTIONS(group)                                               \
  {"style",                                                                    \
   LINE_STYLE,                                                                 \
   "screen|iso|plotter|FILE",                                                  \
   0,                                                                          \
   "how lines are drawn: screen (standard), iso (line types and widths of "    \
   "ISO 128), plotter (one pen, little travel), or a .json file",              \
   group},                                                                     \
      {"hidden",                                                               \
       LINE_HIDDEN,                                                            \
       "none|dashed|thin|all|PEN",                                             \
       0,                                                                      \
       "how hidden lines are drawn: none (standard: left out), dashed, thin "  \
       "(and lighter the more faces hide them), or all (like visible ones); "  \
       "or a pen, as .18mm,dashed",                                            \
       group},                                                                 \
      {"crease",                                                               \
       LINE_CREASE,                                                            \
       "all|DEG|PEN",                                                          \
       0,                                                                      \
       "leave out lines whose two faces turn by at most DEG degrees, except "  \
       "silhouettes; all: leave out none; the pen of those that turn more; "   \
       "or both, as 20,.25mm",                                                 \
       group},                                                                 \
      {"silhouette",                                                           \
       LINE_SILHOUETTE,                                                        \
       "PEN",                                                                  \
       0,                                                                      \
       "the pen of contour edges. A PEN is one or more of WIDTH (as .5mm, "    \
       "1pt), #rrggbb, solid, dashed, none (left out, hidden ones too), with " \
       "commas between",                                                       \
       group},                                                                 \
      {"boundary", LINE_BOUNDARY, "PEN", 0, "the pen of edges of one face",    \
       group},                                                                 \
      {"intersection",                                                         \
       LINE_INTERSECTION,                                                      \
       "PEN",                                                                  \
       0,                                                                      \
       "the pen of lines where faces penetrate",                               \
       group},                                                                 \
      {"colour-line",                                                          \
       LINE_COLOUR,                                                            \
       "PEN",                                                                  \
       0,                                                                      \
       "the pen of lines between faces of one plane and two colours",          \
       group},                                                                 \
      {"seam",                                                                 \
       LINE_SEAM,                                                              \
       "PEN",                                                                  \
       0,                                                                      \
       "the pen of lines between objects that are flush",                      \
       group},                                                                 \
      {"smooth",                                                               \
       LINE_SMOOTH,                                                            \
       "PEN",                                                                  \
       0,                                                                      \
       "the pen of lines within a plane, or whose faces turn by no more than " \
       "--crease",                                                             \
       group},                                                                 \
      {"layers",                                                               \
       LINE_LAYERS,                                                            \
       "visibility|class|object",                                              \
       0,                                                                      \
       "layers by visibility (standard), class or object",                     \
       group},                                                                 \
  {                                                                            \
    "order", LINE_ORDER, "pen", 0, "strokes in an order of little pen travel", \
        group                                                                  \
  }
/* The name of the option: "--style". */
const char *line_option_name(int key);
/* The option of the pen of a class. */
int line_option_of(enum hsr_line_class line_class);
error_t parse_line_option(struct line_options *options, int key,
                          const char *arg, struct option_base *base);
/* Parses a pen of hatches: a width, a colour, or both. */
error_t parse_hatch_option(struct line_options *options, const char *arg,
                           struct option_base *base);

/* Makes the style. HSR_E_USAGE, HSR_E_INPUT, HSR_E_NOMEM: the file cannot be
 * read. */
enum hsr_status line_options_style(const struct line_options *options,
                                   struct hsr_line_style *style,
                                   struct hsr_error *err);

#endif
