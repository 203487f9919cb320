/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How lines are drawn on paper: a list of rules, of which a later one overrules
 * an earlier one. A rule names lines, by class, visibility and object, and says
 * something of their pen. docs/drawings.md shows how people write rules. */
#ifndef HSR_COMMON_PAPER_LINE_STYLE_H
#define HSR_COMMON_PAPER_LINE_STYLE_H

#include "common/base/status.h"
#include "common/lines/drawing.h"
#include "common/paper/lines/line_class.h"
#include "common/scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A pen. Lengths are millimetres on paper. */
struct hsr_line_pen {
  bool draws;           /* false: such lines are left out */
  double width;         /* > 0 */
  unsigned char rgb[3]; /* sRGB */
  double dash, gap;     /* both > 0, or both 0: solid */
};

/* How many faces hide a line: 0, 1, 2, or 3 and more. */
enum { HSR_LINE_LEVELS = 4 };
static inline int hsr_line_level(uint32_t invisibility) {
  return invisibility < HSR_LINE_LEVELS ? (int)invisibility
                                        : HSR_LINE_LEVELS - 1;
}

struct hsr_line_rule {
  unsigned classes; /* 1 << HSR_LINE_..., of the lines that it is about */
  unsigned levels;  /* 1 << level, likewise */
  char object[64];  /* a pattern of names, as of fnmatch; "": all objects */
  bool sets_draws, sets_width, sets_rgb, sets_dash;
  struct hsr_line_pen pen; /* what is set */
};
#define HSR_ALL_LINES ((1u << HSR_N_LINE_CLASSES) - 1)
#define HSR_FLAT_LINES (1u << HSR_LINE_SEAM | 1u << HSR_LINE_SMOOTH)
#define HSR_VISIBLE_LINES 1u
#define HSR_HIDDEN_LINES 14u
#define HSR_ALL_LEVELS 15u

/* What the top-level groups of a drawing are. */
enum hsr_layers { HSR_LAYERS_VISIBILITY, HSR_LAYERS_CLASS, HSR_LAYERS_OBJECT };

enum { HSR_MOST_LINE_RULES = 64 };
struct hsr_line_style {
  double crease; /* degrees, 0 to 180: two planes make a crease if they differ
                    by more. Negative: they do if they differ at all */
  enum hsr_layers layers;
  bool by_pen_travel;        /* strokes are in an order of little pen travel */
  bool cuts_dashes;          /* each dash is a line of its own */
  struct hsr_line_pen hatch; /* of hatched faces: its width and colour */
  size_t n_rules;
  struct hsr_line_rule rule[HSR_MOST_LINE_RULES];
};

/* Makes a standard style: "screen", "iso" (line types and widths of ISO 128) or
 * "plotter". False if there is none of that name. */
bool hsr_line_style_named(const char *name, struct hsr_line_style *style);
/* The same, or reads a style from a file that ends in .json. HSR_E_USAGE if it is
 * neither; else as hsr_line_style_read. */
enum hsr_status hsr_line_style_find(const char *name,
                                    struct hsr_line_style *style,
                                    struct hsr_error *err);
/* The names, for messages. */
#define HSR_LINE_STYLES "screen, iso or plotter"

/* Words of styles. False if a word is none: "#rrggbb"; "visibility", "class",
 * "object". */
bool hsr_line_colour(const char *word, unsigned char rgb[3]);
const char *hsr_line_layers_name(enum hsr_layers layers);
bool hsr_line_layers_named(const char *word, enum hsr_layers *layers);

/* Appends a rule. HSR_E_INPUT if there are too many. */
enum hsr_status hsr_line_style_add(struct hsr_line_style *style,
                                   const struct hsr_line_rule *rule,
                                   struct hsr_error *err);

/* Those of HSR_FLAT_LINES that are left out where they are visible, of objects
 * that no rule names. */
unsigned hsr_line_style_left_out(const struct hsr_line_style *style);

/* Appends the rules that draw hidden lines in one of the standard ways. Lines of
 * one plane that are left out where they are visible stay left out where they
 * are hidden. HSR_E_INPUT if there are too many. */
enum hsr_status hsr_line_style_hide(struct hsr_line_style *style,
                                    enum hsr_hidden hidden,
                                    struct hsr_error *err);

/* Makes the style "screen" with hidden lines drawn in one of those ways. */
void hsr_line_style_plain(struct hsr_line_style *style, enum hsr_hidden hidden);

/* Sets the angle of creases, 0 to 180 degrees, and leaves out lines of planes
 * that differ by no more. A negative angle leaves out none. To be called before
 * hsr_line_style_hide. HSR_E_INPUT if there are too many rules. */
enum hsr_status hsr_line_style_crease(struct hsr_line_style *style,
                                      double degrees, struct hsr_error *err);

/* Whether lines of a class are drawn which so many faces hide, of objects that
 * no rule names. */
bool hsr_line_style_draws(const struct hsr_line_style *style,
                          enum hsr_line_class line_class, int level);

/* Whether any hidden line is drawn, of objects that no rule names. */
bool hsr_line_style_draws_hidden(const struct hsr_line_style *style);

/* Reads a style from a file: docs/schemas/style.schema.json. HSR_E_INPUT with
 * what is wrong; HSR_E_NOMEM. */
enum hsr_status hsr_line_style_read(const char *path,
                                    struct hsr_line_style *style,
                                    struct hsr_error *err);

/* --- The pens of a scene -------------------------------------------------- */

/* The pens that a style gives to the lines of a scene. No two are equal. They
 * are in the order of drawing: a pen of more hidden lines comes before that of
 * others, and that of later classes before that of earlier ones. Pen numbers are
 * by object, class and level. Freed by hsr_line_pens_free. */
#define HSR_NO_PEN 0xffffffffu
struct hsr_line_pens {
  struct hsr_line_pen *pen;
  uint32_t n;
  uint32_t *of; /* n_objects x HSR_N_LINE_CLASSES x HSR_LINE_LEVELS; HSR_NO_PEN:
                   such lines are left out */
};

/* *pens is written in full, and is freed also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_line_pens_init(struct hsr_line_pens *pens,
                                   const struct hsr_line_style *style,
                                   const struct hsr_scene *scene,
                                   struct hsr_error *err);
void hsr_line_pens_free(struct hsr_line_pens *pens);

/* Whether every line has a pen. */
bool hsr_line_pens_draw_all(const struct hsr_line_pens *pens,
                            const struct hsr_scene *scene);

/* The number of a line's pen, or HSR_NO_PEN. */
static inline uint32_t hsr_line_pen_of(const struct hsr_line_pens *pens,
                                       uint32_t object,
                                       enum hsr_line_class line_class,
                                       uint32_t invisibility) {
  const size_t row = (size_t)object * HSR_N_LINE_CLASSES + (size_t)line_class;
  return pens->of[row * HSR_LINE_LEVELS + (size_t)hsr_line_level(invisibility)];
}

#ifdef __cplusplus
}
#endif
#endif
