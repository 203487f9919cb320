/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/lines.h"
#include "bench/options/page.h"
#include "bench/options/words.h"

#include <string.h>

/* One word of a pen. */
static bool parse_pen_word(const char *word, struct hsr_line_rule *rule) {
  double width;
  if (hsr_line_colour(word, rule->pen.rgb))
    rule->sets_rgb = true;
  else if (parse_length(word, &width)) {
    rule->sets_width = true;
    rule->pen.width = width;
  } else if (!strcmp(word, "none"))
    rule->pen.draws = false;
  else if (!strcmp(word, "solid"))
    rule->sets_dash = true;
  else if (!strcmp(word, "dashed")) {
    rule->sets_dash = true;
    rule->pen.dash = rule->pen.gap = -1; /* by the width: below */
  } else
    return false;
  return true;
}

/* A word of --crease that is an angle, or "all". */
static bool parse_crease(const char *word, double *degrees) {
  if (!strcmp(word, "all")) {
    *degrees = -1;
    return true;
  }
  return parse_number(word, degrees) && *degrees >= 0 && *degrees <= 180;
}

/* Lines that are given a pen are drawn. Those of the pen "none" are left out
 * where they are hidden, too. */
static error_t add_pen(struct line_options *o, struct line_pen_option *pen,
                       const char *option, struct option_base *base) {
  struct hsr_line_rule *rule = &pen->rule;
  if (!rule->pen.draws)
    rule->levels |= HSR_HIDDEN_LINES;
  /* Dashes of ISO 128-2: 12 widths, and gaps of 3. */
  if (rule->pen.dash < 0) {
    const double width = rule->sets_width ? rule->pen.width : .25;
    rule->pen.dash = 12 * width;
    rule->pen.gap = 3 * width;
  }
  if (o->n_pens == MOST_LINE_OPTIONS)
    return option_fail(base, "%s: at most %d pens", option,
                       (int)MOST_LINE_OPTIONS);
  o->pen[o->n_pens++] = *pen;
  return 0;
}

/* A pen, whose words are separated by commas. Words of --crease may be an angle
 * as well. */
static error_t parse_pen(struct line_options *o, int key, unsigned classes,
                         unsigned levels, const char *arg,
                         struct option_base *base) {
  struct line_pen_option pen = {.key = key,
                                .rule = {.classes = classes,
                                         .levels = levels,
                                         .sets_draws = true,
                                         .pen = {.draws = true}}};
  const char *option = line_option_name(key);
  char text[MOST_PEN], *rest = text;
  if (strlen(arg) >= sizeof text)
    return option_fail(base, "%s: too long", option);
  strcpy(text, arg);
  for (char *word; (word = strsep(&rest, ","));) {
    double degrees;
    if (key == LINE_CREASE && parse_crease(word, &degrees)) {
      o->has_crease = true;
      o->crease = degrees;
      continue;
    }
    if (key == LINE_CREASE && parse_number(word, &degrees))
      return option_fail(base,
                         "--crease %s: must be degrees, 0 to 180, or all, or a "
                         "pen, as 20,.25mm",
                         arg);
    if (!parse_pen_word(word, &pen.rule))
      return option_fail(base,
                         "%s %s: must be a width, as .5mm, #rrggbb, solid, "
                         "dashed or none, or several with commas between",
                         option, arg);
    strcat(strcat(pen.words, *pen.words ? "," : ""), word);
  }
  return *pen.words ? add_pen(o, &pen, option, base) : 0;
}

static const char *const ways[] = {[HSR_HIDDEN_NONE] = "none",
                                   [HSR_HIDDEN_DASHED] = "dashed",
                                   [HSR_HIDDEN_THIN] = "thin",
                                   [HSR_HIDDEN_ALL] = "all",
                                   NULL};
/* The index of a word in `words`, which NULL ends; -1 if it is not there. */
static int choose(const char *word, const char *const *words) {
  for (int k = 0; words[k]; k++)
    if (!strcmp(word, words[k]))
      return k;
  return -1;
}

static error_t parse_hidden(struct line_options *o, const char *arg,
                            struct option_base *base) {
  if (choose(arg, ways) >= 0) {
    o->hidden = arg;
    return 0;
  }
  if (parse_pen(o, LINE_HIDDEN, HSR_ALL_LINES, HSR_HIDDEN_LINES, arg, base) ==
      0)
    return 0;
  return option_fail(
      base,
      "--hidden %s: must be none, dashed, thin or all, or a pen, "
      "as .18mm,dashed",
      arg);
}

error_t parse_hatch_option(struct line_options *o, const char *arg,
                           struct option_base *base) {
  char text[MOST_PEN], *rest = text;
  bool good = strlen(arg) < sizeof text;
  o->hatch.pen.draws = true;
  if (good)
    strcpy(text, arg);
  for (char *word; good && (word = strsep(&rest, ","));)
    good = parse_pen_word(word, &o->hatch) &&
           (o->hatch.sets_width || o->hatch.sets_rgb) && !o->hatch.sets_dash &&
           o->hatch.pen.draws;
  return good ? 0
              : option_fail(base,
                            "--hatch=%.40s: must be a width, as .3mm, or "
                            "#rrggbb, or both with a comma between",
                            arg);
}

/* In the order of their keys. */
static const struct {
  const char *name;
  int line_class; /* -1: it is not about the pen of one */
} names[] = {{"--style", -1},
             {"--silhouette", HSR_LINE_SILHOUETTE},
             {"--boundary", HSR_LINE_BOUNDARY},
             {"--intersection", HSR_LINE_INTERSECTION},
             {"--crease", HSR_LINE_CREASE},
             {"--colour-line", HSR_LINE_COLOUR},
             {"--seam", HSR_LINE_SEAM},
             {"--smooth", HSR_LINE_SMOOTH},
             {"--hidden", -1},
             {"--layers", -1},
             {"--order", -1}};
enum { N_NAMES = sizeof names / sizeof *names };

const char *line_option_name(int key) {
  return names[key - LINE_STYLE].name;
}

int line_option_of(enum hsr_line_class line_class) {
  int k = 0;
  while (names[k].line_class != (int)line_class)
    k++;
  return LINE_STYLE + k;
}

error_t parse_line_option(struct line_options *o, int key, const char *arg,
                          struct option_base *base) {
  const int k = key - LINE_STYLE;
  if (k < 0 || k >= N_NAMES)
    return ARGP_ERR_UNKNOWN;
  if (names[k].line_class >= 0)
    return parse_pen(o, key, 1u << names[k].line_class, HSR_VISIBLE_LINES, arg,
                     base);
  switch (key) {
  case LINE_STYLE:
    o->style = arg;
    return 0;
  case LINE_HIDDEN:
    return parse_hidden(o, arg, base);
  case LINE_LAYERS:
    o->has_layers = true;
    return hsr_line_layers_named(arg, &o->layers)
               ? 0
               : option_fail(base,
                             "--layers %s: must be visibility, class or object",
                             arg);
  default:
    o->by_pen_travel = true;
    return !strcmp(arg, "pen")
               ? 0
               : option_fail(base, "--order %s: must be pen", arg);
  }
}

/* --- The style ------------------------------------------------------------ */

enum hsr_status line_options_style(const struct line_options *o,
                                   struct hsr_line_style *style,
                                   struct hsr_error *err) {
  enum hsr_status status =
      hsr_line_style_find(o->style ? o->style : "screen", style, err);
  if (!status && o->has_crease)
    status = hsr_line_style_crease(style, o->crease, err);
  if (!status && o->hidden)
    status = hsr_line_style_hide(style,
                                 (enum hsr_hidden)choose(o->hidden, ways), err);
  for (size_t k = 0; k < o->n_pens && !status; k++) {
    struct hsr_line_rule rule = o->pen[k].rule;
    /* The pen of --hidden draws no lines of one plane, if they are left out. */
    if (rule.levels == HSR_HIDDEN_LINES)
      rule.classes &= ~hsr_line_style_left_out(style);
    status = hsr_line_style_add(style, &rule, err);
  }
  if (status)
    return status;
  if (o->hatch.sets_width)
    style->hatch.width = o->hatch.pen.width;
  if (o->hatch.sets_rgb)
    memcpy(style->hatch.rgb, o->hatch.pen.rgb, sizeof style->hatch.rgb);
  if (o->has_layers)
    style->layers = o->layers;
  style->by_pen_travel |= o->by_pen_travel;
  return HSR_OK;
}
