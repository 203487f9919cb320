/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys that change how lines are drawn. Each changes the options of lines, as if
 * others had been given; the style is made of the options again. */
#include "bench/view/view.h"

#include <string.h>

/* --- What is drawn -------------------------------------------------------- */

static bool draws_lines(const struct player *p) {
  return p->is_ready && p->render.kind->lines;
}

static bool are_lines_shown(const struct viewer *v) {
  return v->has_lines || draws_lines(v->player[0]) ||
         (v->comparison != COMPARE_NONE && draws_lines(v->player[1]));
}

static bool is_drawn(const struct viewer *v, enum hsr_line_class line_class) {
  return hsr_line_style_draws(&v->style, line_class, 0);
}

/* How hidden lines are drawn: by a word, by a pen, or as the style has it. */
static const char *hidden_word(const struct viewer *v) {
  const struct line_options *o = &v->line_options;
  for (size_t k = o->n_pens; k-- > 0;)
    if (o->pen[k].key == LINE_HIDDEN)
      return o->pen[k].words;
  return o->hidden                                ? o->hidden
         : hsr_line_style_draws_hidden(&v->style) ? "as in the style"
                                                  : "none";
}

void lines_say(const struct viewer *v, char *text, size_t size) {
  const char *style = v->line_options.style ? v->line_options.style : "screen";
  char name[60], crease[40] = "all edges";
  *text = '\0';
  if (!are_lines_shown(v))
    return;
  if (v->style.crease >= 0)
    snprintf(crease, sizeof crease, "crease %g", v->style.crease);
  int n = snprintf(text, size, "lines %s, hidden %s, %s:",
                   terminal_plain(style, name, sizeof name), hidden_word(v),
                   crease);
  for (int c = 0; c < HSR_N_LINE_CLASSES && (size_t)n < size; c++)
    if (is_drawn(v, (enum hsr_line_class)c))
      n += snprintf(text + n, size - (size_t)n, " %s",
                    hsr_line_class_name((enum hsr_line_class)c));
  if ((size_t)n < size)
    snprintf(text + n, size - (size_t)n, "\n");
}

/* --- Words ---------------------------------------------------------------- */

/* Appends an option as a word of a shell. */
static void add_word(char words[MOST_LINE_WORDS], int key, const char *arg) {
  char word[TERMINAL_NAME];
  const size_t n = strlen(words);
  snprintf(words + n, MOST_LINE_WORDS - n, " %s=%s", line_option_name(key),
           terminal_word(arg, word, sizeof word));
}

void lines_words(const struct line_options *o, char words[MOST_LINE_WORDS]) {
  char degrees[32] = "all";
  *words = '\0';
  if (o->style)
    add_word(words, LINE_STYLE, o->style);
  if (o->hidden)
    add_word(words, LINE_HIDDEN, o->hidden);
  if (o->has_crease && o->crease >= 0)
    snprintf(degrees, sizeof degrees, "%.17g", o->crease);
  if (o->has_crease)
    add_word(words, LINE_CREASE, degrees);
  for (size_t k = 0; k < o->n_pens; k++)
    add_word(words, o->pen[k].key, o->pen[k].words);
  if (o->has_layers)
    add_word(words, LINE_LAYERS, hsr_line_layers_name(o->layers));
  if (o->by_pen_travel)
    add_word(words, LINE_ORDER, "pen");
}

/* --- Changes -------------------------------------------------------------- */

/* All players draw in the style of the new options. If there is none, says why,
 * and all stays as it was. */
static void change(struct viewer *v, const struct line_options *options) {
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_line_style style;
  if (line_options_style(options, &style, &err)) {
    viewer_say(v, "%s", err.text);
    return;
  }
  v->line_options = *options;
  v->style = style;
  struct player *const players[] = {v->player[0], v->player[1], &v->counter,
                                    &v->lines};
  for (size_t k = 0; k < sizeof players / sizeof *players; k++)
    players[k]->options.style = style;
  if (!are_lines_shown(v))
    viewer_say(v, "no lines are shown: l shows them");
}

/* The word after a word in a list that NULL ends; the first if it is not there
 * or the last. */
static const char *after(const char *word, const char *const *words) {
  for (int k = 0; words[k] && words[k + 1]; k++)
    if (!strcmp(words[k], word))
      return words[k + 1];
  return words[0];
}

void lines_next_style(struct viewer *v) {
  const char *const words[] = {"screen", "iso", "plotter", v->style_file, NULL};
  struct line_options options = v->line_options;
  options.style = after(options.style ? options.style : "screen", words);
  change(v, &options);
}

/* Takes away the pens of an option that have these words; NULL: any words. */
static void remove_pens(struct line_options *o, int key, const char *words) {
  size_t n = 0;
  for (size_t k = 0; k < o->n_pens; k++)
    if (o->pen[k].key != key || (words && strcmp(o->pen[k].words, words) != 0))
      o->pen[n++] = o->pen[k];
  o->n_pens = n;
}

void lines_next_hidden(struct viewer *v) {
  static const char *const words[] = {"none", "dashed", "thin", "all", NULL};
  struct line_options options = v->line_options;
  options.hidden = after(hidden_word(v), words);
  remove_pens(&options, LINE_HIDDEN, NULL);
  change(v, &options);
}

/* All edges, 0, 1, 5, 10, 15 ... 180. */
static void step_crease(struct viewer *v, int step) {
  enum { STEPS = 39 };
  const double now = v->style.crease;
  double degrees = now;
  for (int k = step > 0 ? 0 : STEPS - 1; k >= 0 && k < STEPS; k += step) {
    degrees = k < 3 ? k - 1 : 5 * (k - 2);
    if (step > 0 ? degrees > now : degrees < now)
      break;
  }
  struct line_options options = v->line_options;
  options.has_crease = true;
  options.crease = degrees;
  change(v, &options);
}
void lines_more_crease(struct viewer *v) {
  step_crease(v, 1);
}
void lines_less_crease(struct viewer *v) {
  step_crease(v, -1);
}

/* Lines that were switched off get the pen back that they had. */
static bool set_class(struct viewer *v, struct line_options *options,
                      enum hsr_line_class line_class, bool draws) {
  const int key = line_option_of(line_class);
  struct hsr_error err = {HSR_OK, ""};
  struct option_base base = {.err = &err};
  struct hsr_line_style style;
  remove_pens(options, key, "none");
  if (!line_options_style(options, &style, &err) &&
      hsr_line_style_draws(&style, line_class, 0) != draws)
    parse_line_option(options, key, draws ? "solid" : "none", &base);
  if (err.status)
    viewer_say(v, "%s", err.text);
  return !err.status;
}

static void switch_lines(struct viewer *v, enum hsr_line_class first,
                         enum hsr_line_class last) {
  struct line_options options = v->line_options;
  bool draws = true, done = true;
  for (int c = (int)first; c <= (int)last; c++)
    draws &= !is_drawn(v, (enum hsr_line_class)c);
  for (int c = (int)first; c <= (int)last && done; c++)
    done = set_class(v, &options, (enum hsr_line_class)c, draws);
  if (done)
    change(v, &options);
}
void lines_switch_silhouettes(struct viewer *v) {
  switch_lines(v, HSR_LINE_SILHOUETTE, HSR_LINE_SILHOUETTE);
}
void lines_switch_boundaries(struct viewer *v) {
  switch_lines(v, HSR_LINE_BOUNDARY, HSR_LINE_BOUNDARY);
}
void lines_switch_intersections(struct viewer *v) {
  switch_lines(v, HSR_LINE_INTERSECTION, HSR_LINE_INTERSECTION);
}
void lines_switch_creases(struct viewer *v) {
  switch_lines(v, HSR_LINE_CREASE, HSR_LINE_CREASE);
}
void lines_switch_colours(struct viewer *v) {
  switch_lines(v, HSR_LINE_COLOUR, HSR_LINE_COLOUR);
}
void lines_switch_flat(struct viewer *v) {
  switch_lines(v, HSR_LINE_SEAM, HSR_LINE_SMOOTH);
}
