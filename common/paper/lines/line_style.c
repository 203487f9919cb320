/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/lines/line_style.h"
#include "common/files/suffix.h"

#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>

/* The pen of hatches, of all standard styles. */
static const struct hsr_line_pen hatch = {.draws = true, .width = .25};

/* --- Standard styles ------------------------------------------------------ */

#define DRAWN .sets_draws = true
#define PIXEL (25.4 / 96) /* millimetres */
#define GREY(g)                                                                \
  { g, g, g }
#define EVERY(which)                                                           \
  .classes = HSR_ALL_LINES, .levels = which, .sets_draws = true,               \
  .sets_width = true, .sets_rgb = true, .sets_dash = true

static const struct hsr_line_rule screen[] = {
    {EVERY(HSR_VISIBLE_LINES), .pen = {.draws = true, .width = 1.25 * PIXEL}},
    {EVERY(HSR_HIDDEN_LINES), .pen = {.draws = false,
                                      .width = .75 * PIXEL,
                                      .rgb = GREY(89),
                                      .dash = 3 * PIXEL,
                                      .gap = 3 * PIXEL}}};

/* Wide 0.5, narrow 0.25: ISO 128-2:2020, line group 0.5. Visible edges and
 * outlines are continuous wide (01.2), hidden ones dashed narrow (02.1: dashes
 * of 12 widths, gaps of 3), and lines between colours continuous narrow
 * (01.1). */
static const struct hsr_line_rule iso[] = {
    {EVERY(HSR_VISIBLE_LINES), .pen = {.draws = true, .width = .5}},
    {EVERY(HSR_HIDDEN_LINES),
     .pen = {.draws = false, .width = .25, .dash = 3, .gap = .75}},
    {.classes = 1u << HSR_LINE_COLOUR | HSR_FLAT_LINES,
     .levels = HSR_VISIBLE_LINES,
     .sets_width = true,
     .pen = {.width = .25}},
    {.classes = HSR_FLAT_LINES, .levels = HSR_ALL_LEVELS, DRAWN}};

/* One pen for all. */
static const struct hsr_line_rule plotter[] = {
    {EVERY(HSR_VISIBLE_LINES), .pen = {.draws = true, .width = .3}},
    {EVERY(HSR_HIDDEN_LINES),
     .pen = {.draws = false, .width = .3, .dash = 1.5, .gap = 1}},
    {.classes = HSR_FLAT_LINES, .levels = HSR_ALL_LEVELS, DRAWN}};

static const struct {
  const char *name;
  const struct hsr_line_rule *rule;
  size_t n;
  double crease;
  bool by_pen_travel, cuts_dashes;
} standard[] = {{"screen", screen, 2, -1, false, false},
                {"iso", iso, 4, 20, false, false},
                {"plotter", plotter, 3, 20, true, true}};

bool hsr_line_style_named(const char *name, struct hsr_line_style *style) {
  for (size_t k = 0; k < sizeof standard / sizeof *standard; k++) {
    if (strcmp(name, standard[k].name) != 0)
      continue;
    style->crease = standard[k].crease;
    style->layers = HSR_LAYERS_VISIBILITY;
    style->by_pen_travel = standard[k].by_pen_travel;
    style->cuts_dashes = standard[k].cuts_dashes;
    style->hatch = hatch;
    style->n_rules = standard[k].n;
    memcpy(style->rule, standard[k].rule, standard[k].n * sizeof *style->rule);
    return true;
  }
  return false;
}

enum hsr_status hsr_line_style_find(const char *name,
                                    struct hsr_line_style *style,
                                    struct hsr_error *err) {
  if (hsr_line_style_named(name, style))
    return HSR_OK;
  if (hsr_ends_in(name, ".json"))
    return hsr_line_style_read(name, style, err);
  return hsr_fail(err, HSR_E_USAGE,
                  "style %.100s: must be " HSR_LINE_STYLES ", or a .json file",
                  name);
}

/* Lines of planes that differ by no more than the angle: left out, or drawn. */
static const struct hsr_line_rule flat = {.classes = HSR_FLAT_LINES,
                                          .levels = HSR_ALL_LEVELS,
                                          DRAWN},
                                  every = {.classes = HSR_FLAT_LINES,
                                           .levels = HSR_VISIBLE_LINES,
                                           DRAWN,
                                           .pen = {.draws = true}};

/* Ways to draw hidden lines. Each style has a dashed pen for them. */
static const struct hsr_line_rule not_drawn[] = {
    {.classes = HSR_ALL_LINES, .levels = HSR_HIDDEN_LINES, DRAWN}};
static const struct hsr_line_rule drawn[] = {{.classes = HSR_ALL_LINES,
                                              .levels = HSR_HIDDEN_LINES,
                                              DRAWN,
                                              .pen = {.draws = true}}};
static const struct hsr_line_rule thin[] = {
    {EVERY(2), .pen = {.draws = true, .width = .8 * PIXEL, .rgb = GREY(128)}},
    {EVERY(4), .pen = {.draws = true, .width = .6 * PIXEL, .rgb = GREY(166)}},
    {EVERY(8), .pen = {.draws = true, .width = .45 * PIXEL, .rgb = GREY(199)}}};
static const struct hsr_line_rule alike[] = {{.classes = HSR_ALL_LINES,
                                              .levels = HSR_ALL_LEVELS,
                                              .sets_width = true,
                                              .sets_rgb = true,
                                              .sets_dash = true,
                                              .pen = {.width = PIXEL}},
                                             {.classes = HSR_ALL_LINES,
                                              .levels = HSR_HIDDEN_LINES,
                                              DRAWN,
                                              .pen = {.draws = true}}};

unsigned hsr_line_style_left_out(const struct hsr_line_style *style) {
  unsigned classes = 0;
  for (int c = 0; c < HSR_N_LINE_CLASSES; c++)
    if (HSR_FLAT_LINES & 1u << c &&
        !hsr_line_style_draws(style, (enum hsr_line_class)c, 0))
      classes |= 1u << c;
  return classes;
}

enum hsr_status hsr_line_style_hide(struct hsr_line_style *style,
                                    enum hsr_hidden hidden,
                                    struct hsr_error *err) {
  static const struct {
    const struct hsr_line_rule *rule;
    size_t n;
  } way[] = {[HSR_HIDDEN_NONE] = {not_drawn, 1},
             [HSR_HIDDEN_DASHED] = {drawn, 1},
             [HSR_HIDDEN_THIN] = {thin, 3},
             [HSR_HIDDEN_ALL] = {alike, 2}};
  const struct hsr_line_rule stays = {.classes = hsr_line_style_left_out(style),
                                      .levels = HSR_HIDDEN_LINES,
                                      DRAWN};
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < way[hidden].n && !status; k++)
    status = hsr_line_style_add(style, &way[hidden].rule[k], err);
  if (!status && stays.classes)
    status = hsr_line_style_add(style, &stays, err);
  return status;
}

void hsr_line_style_plain(struct hsr_line_style *style,
                          enum hsr_hidden hidden) {
  hsr_line_style_named("screen", style);
  hsr_line_style_hide(style, hidden, NULL); /* there is room */
}

enum hsr_status hsr_line_style_crease(struct hsr_line_style *style,
                                      double degrees, struct hsr_error *err) {
  style->crease = degrees;
  return hsr_line_style_add(style, degrees < 0 ? &every : &flat, err);
}

enum hsr_status hsr_line_style_add(struct hsr_line_style *style,
                                   const struct hsr_line_rule *rule,
                                   struct hsr_error *err) {
  if (style->n_rules == HSR_MOST_LINE_RULES)
    return hsr_fail(err, HSR_E_INPUT, "a style has at most %d rules",
                    (int)HSR_MOST_LINE_RULES);
  style->rule[style->n_rules++] = *rule;
  return HSR_OK;
}

/* --- Words ---------------------------------------------------------------- */

bool hsr_line_colour(const char *word, unsigned char rgb[3]) {
  if (*word != '#' || strlen(word) != 7 ||
      strspn(word + 1, "0123456789abcdefABCDEF") != 6)
    return false;
  const unsigned long value = strtoul(word + 1, NULL, 16);
  for (int c = 0; c < 3; c++)
    rgb[c] = (unsigned char)(value >> (16 - 8 * c) & 255);
  return true;
}

static const char *const layers_words[] = {[HSR_LAYERS_VISIBILITY] =
                                               "visibility",
                                           [HSR_LAYERS_CLASS] = "class",
                                           [HSR_LAYERS_OBJECT] = "object"};

const char *hsr_line_layers_name(enum hsr_layers layers) {
  return layers_words[layers];
}

bool hsr_line_layers_named(const char *word, enum hsr_layers *layers) {
  for (size_t k = 0; k < sizeof layers_words / sizeof *layers_words; k++)
    if (!strcmp(layers_words[k], word)) {
      *layers = (enum hsr_layers)k;
      return true;
    }
  return false;
}

/* --- The pens of a scene -------------------------------------------------- */

static bool is_about(const struct hsr_line_rule *rule, const char *object,
                     int line_class, int level) {
  return rule->classes & 1u << line_class && rule->levels & 1u << level &&
         (!*rule->object || !fnmatch(rule->object, object, 0));
}

static struct hsr_line_pen pen_for(const struct hsr_line_style *style,
                                   const char *object, int line_class,
                                   int level) {
  struct hsr_line_pen pen = {.width = PIXEL};
  for (size_t k = 0; k < style->n_rules; k++) {
    const struct hsr_line_rule *rule = &style->rule[k];
    if (!is_about(rule, object, line_class, level))
      continue;
    if (rule->sets_draws)
      pen.draws = rule->pen.draws;
    if (rule->sets_width)
      pen.width = rule->pen.width;
    if (rule->sets_rgb)
      memcpy(pen.rgb, rule->pen.rgb, sizeof pen.rgb);
    if (rule->sets_dash) {
      pen.dash = rule->pen.dash;
      pen.gap = rule->pen.gap;
    }
  }
  return pen;
}

bool hsr_line_style_draws(const struct hsr_line_style *style,
                          enum hsr_line_class line_class, int level) {
  return pen_for(style, "", (int)line_class, level).draws;
}

bool hsr_line_style_draws_hidden(const struct hsr_line_style *style) {
  for (int c = 0; c < HSR_N_LINE_CLASSES; c++)
    for (int level = 1; level < HSR_LINE_LEVELS; level++)
      if (hsr_line_style_draws(style, (enum hsr_line_class)c, level))
        return true;
  return false;
}

static bool is_equal(const struct hsr_line_pen *a,
                     const struct hsr_line_pen *b) {
  return a->width == b->width && !memcmp(a->rgb, b->rgb, sizeof a->rgb) &&
         a->dash == b->dash && a->gap == b->gap;
}

/* The number of a pen, which is appended if it is new. */
static uint32_t number_of(struct hsr_line_pens *pens,
                          const struct hsr_line_pen *pen) {
  if (!pen->draws)
    return HSR_NO_PEN;
  uint32_t k = 0;
  while (k < pens->n && !is_equal(&pens->pen[k], pen))
    k++;
  if (k == pens->n)
    pens->pen[pens->n++] = *pen;
  return k;
}

/* Whether a rule names objects. */
static bool by_object(const struct hsr_line_style *style) {
  for (size_t k = 0; k < style->n_rules; k++)
    if (*style->rule[k].object)
      return true;
  return false;
}

enum hsr_status hsr_line_pens_init(struct hsr_line_pens *pens,
                                   const struct hsr_line_style *style,
                                   const struct hsr_scene *scene,
                                   struct hsr_error *err) {
  enum { ROW = HSR_N_LINE_CLASSES * HSR_LINE_LEVELS };
  const size_t n = (size_t)scene->n_objects + 1;
  const bool apart = by_object(style);
  *pens = (struct hsr_line_pens){
      .pen = malloc((apart ? n : 1) * ROW * sizeof *pens->pen),
      .of = malloc(n * ROW * sizeof *pens->of)};
  if (!pens->pen || !pens->of)
    return hsr_fail_nomem(err);
  /* Those of the most hidden lines come first. */
  for (int level = HSR_LINE_LEVELS - 1; level >= 0; level--)
    for (size_t o = 0; o < n; o++)
      for (int c = HSR_N_LINE_CLASSES - 1; c >= 0; c--) {
        const size_t k = (size_t)c * HSR_LINE_LEVELS + (size_t)level;
        const char *name = o < scene->n_objects ? scene->objects[o].name : "";
        const struct hsr_line_pen pen = pen_for(style, name, c, level);
        pens->of[o * ROW + k] =
            o && !apart ? pens->of[k] : number_of(pens, &pen);
      }
  return HSR_OK;
}

bool hsr_line_pens_draw_all(const struct hsr_line_pens *pens,
                            const struct hsr_scene *scene) {
  const size_t n =
      (size_t)scene->n_objects * HSR_N_LINE_CLASSES * HSR_LINE_LEVELS;
  for (size_t k = 0; k < n; k++)
    if (pens->of[k] == HSR_NO_PEN)
      return false;
  return true;
}

void hsr_line_pens_free(struct hsr_line_pens *pens) {
  free(pens->pen);
  free(pens->of);
  *pens = (struct hsr_line_pens){.n = 0};
}
