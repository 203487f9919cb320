/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Styles of line drawings in files: docs/schemas/style.schema.json. */
#include "common/files/json/json_members.h"
#include "common/paper/lines/line_style.h"

#include <stdlib.h>
#include <string.h>

static const char SCHEMA[] = "hsr-style/1";

/* The rule at hand, of the style at hand. */
struct reading {
  struct hsr_line_style *style;
  struct hsr_line_rule rule;
};

/* --- Which lines ---------------------------------------------------------- */

static enum hsr_status take_class(const struct hsr_json_node *at, void *to) {
  const char *name = NULL;
  enum hsr_status status = hsr_json_string(at, &name);
  if (status)
    return status;
  const enum hsr_line_class found = hsr_line_class_named(name);
  if (found == HSR_N_LINE_CLASSES)
    return hsr_json_refuse(at,
                           "must be silhouette, boundary, intersection, "
                           "crease, colour, seam or smooth, not '%.40s'",
                           name);
  *(unsigned *)to |= 1u << found;
  return HSR_OK;
}

static enum hsr_status take_visibility(const struct hsr_json_node *at,
                                       void *to) {
  static const struct {
    const char *name;
    unsigned levels;
  } known[] = {{"visible", HSR_VISIBLE_LINES},
               {"hidden", HSR_HIDDEN_LINES},
               {"hidden-1", 2},
               {"hidden-2", 4},
               {"hidden-3", 8}};
  const char *name = NULL;
  enum hsr_status status = hsr_json_string(at, &name);
  for (size_t k = 0; k < sizeof known / sizeof *known && !status; k++)
    if (!strcmp(known[k].name, name)) {
      *(unsigned *)to |= known[k].levels;
      return HSR_OK;
    }
  return status ? status
                : hsr_json_refuse(at,
                                  "must be visible, hidden, hidden-1, hidden-2 "
                                  "or hidden-3, not '%.40s'",
                                  name);
}

/* One value, or an array of them. */
static enum hsr_status take_classes(const struct hsr_json_node *at, void *to) {
  *(unsigned *)to = 0;
  return json_is_array(at->value) ? hsr_json_elements(at, take_class, to)
                                  : take_class(at, to);
}

static enum hsr_status take_levels(const struct hsr_json_node *at, void *to) {
  *(unsigned *)to = 0;
  return json_is_array(at->value) ? hsr_json_elements(at, take_visibility, to)
                                  : take_visibility(at, to);
}

static enum hsr_status take_object(const struct hsr_json_node *at, void *to) {
  struct hsr_line_rule *rule = to;
  const char *name = NULL;
  enum hsr_status status = hsr_json_string(at, &name);
  if (!status && strlen(name) >= sizeof rule->object)
    status =
        hsr_json_refuse(at, "has more than %zu bytes", sizeof rule->object - 1);
  if (!status)
    strcpy(rule->object, name);
  return status;
}

/* --- What is set ---------------------------------------------------------- */

static enum hsr_status take_draw(const struct hsr_json_node *at, void *to) {
  struct hsr_line_rule *rule = to;
  rule->sets_draws = true;
  return hsr_json_bool(at, &rule->pen.draws);
}

/* A length on paper, at most `most`. */
static enum hsr_status take_length(const struct hsr_json_node *at, void *to) {
  enum { MOST = 1000 };
  enum hsr_status status = hsr_json_number(at, to);
  if (!status && !(*(double *)to > 0 && *(double *)to <= MOST))
    status = hsr_json_refuse(at, "must be above 0 and at most %d millimetres",
                             (int)MOST);
  return status;
}

static enum hsr_status take_width(const struct hsr_json_node *at, void *to) {
  struct hsr_line_rule *rule = to;
  rule->sets_width = true;
  return take_length(at, &rule->pen.width);
}

static enum hsr_status take_colour(const struct hsr_json_node *at, void *to) {
  struct hsr_line_rule *rule = to;
  const char *text = NULL;
  enum hsr_status status = hsr_json_string(at, &text);
  rule->sets_rgb = true;
  if (!status && !hsr_line_colour(text, rule->pen.rgb))
    status =
        hsr_json_refuse(at, "must be a colour, \"#rrggbb\", not '%.40s'", text);
  return status;
}

/* "solid", or the lengths of a dash and a gap. */
static enum hsr_status take_dash(const struct hsr_json_node *at, void *to) {
  struct hsr_line_rule *rule = to;
  const char *text = json_string_value(at->value);
  double length[2] = {0, 0};
  enum hsr_status status = HSR_OK;
  rule->sets_dash = true;
  if (text && !strcmp(text, "solid"))
    return HSR_OK;
  if (!json_is_array(at->value))
    return hsr_json_wrong_kind(at, "\"solid\" or [DASH, GAP]");
  status = hsr_json_numbers(at, 2, take_length, length);
  rule->pen.dash = length[0];
  rule->pen.gap = length[1];
  return status;
}

static enum hsr_status take_rule(const struct hsr_json_node *at, void *to) {
  struct reading *reading = to;
  struct hsr_line_rule *rule = &reading->rule;
  *rule = (struct hsr_line_rule){.classes = HSR_ALL_LINES,
                                 .levels = HSR_ALL_LEVELS};
  const struct hsr_json_rule members[] = {
      {.key = "class", .take = take_classes, .to = &rule->classes},
      {.key = "visibility", .take = take_levels, .to = &rule->levels},
      {.key = "object", .take = take_object, .to = rule},
      {.key = "draw", .take = take_draw, .to = rule},
      {.key = "width", .take = take_width, .to = rule},
      {.key = "colour", .take = take_colour, .to = rule},
      {.key = "dash", .take = take_dash, .to = rule},
      {.key = NULL}};
  enum hsr_status status = hsr_json_object(at, members);
  return status ? status
                : hsr_line_style_add(reading->style, rule, at->input->err);
}

static enum hsr_status take_hatch(const struct hsr_json_node *at, void *to) {
  struct hsr_line_rule set = {.pen = *(struct hsr_line_pen *)to};
  const struct hsr_json_rule members[] = {
      {.key = "width", .take = take_width, .to = &set},
      {.key = "colour", .take = take_colour, .to = &set},
      {.key = NULL}};
  enum hsr_status status = hsr_json_object(at, members);
  *(struct hsr_line_pen *)to = set.pen;
  return status;
}

/* --- The file ------------------------------------------------------------- */

static enum hsr_status take_base(const struct hsr_json_node *at, void *to) {
  const char *name = NULL;
  enum hsr_status status = hsr_json_string(at, &name);
  if (!status && !hsr_line_style_named(name, to))
    status =
        hsr_json_refuse(at, "must be " HSR_LINE_STYLES ", not '%.40s'", name);
  return status;
}

static enum hsr_status take_crease(const struct hsr_json_node *at, void *to) {
  double degrees = 0;
  enum hsr_status status = hsr_json_number(at, &degrees);
  if (!status && !(degrees >= 0 && degrees <= 180))
    status = hsr_json_refuse(at, "must be degrees, 0 to 180");
  if (!status)
    hsr_line_style_crease(to, degrees, NULL); /* there is room */
  return status;
}

static enum hsr_status take_layers(const struct hsr_json_node *at, void *to) {
  const char *name = NULL;
  enum hsr_status status = hsr_json_string(at, &name);
  if (!status && !hsr_line_layers_named(name, to))
    status = hsr_json_refuse(
        at, "must be visibility, class or object, not '%.40s'", name);
  return status;
}

static enum hsr_status take_rules(const struct hsr_json_node *at, void *to) {
  return hsr_json_elements(at, take_rule, &(struct reading){.style = to});
}

static enum hsr_status read_style(const struct hsr_json_node *root,
                                  struct hsr_line_style *style) {
  const struct hsr_json_rule members[] = {
      {.key = "schema"},
      {.key = "base", .take = take_base, .to = style},
      {.key = "crease", .take = take_crease, .to = style},
      {.key = "layers", .take = take_layers, .to = &style->layers},
      {.key = "little-pen-travel",
       .take = hsr_json_bool,
       .to = &style->by_pen_travel},
      {.key = "cut-dashes", .take = hsr_json_bool, .to = &style->cuts_dashes},
      {.key = "hatch", .take = take_hatch, .to = &style->hatch},
      {.key = "rules", .take = take_rules, .to = style},
      {.key = NULL}};
  hsr_line_style_named("screen", style);
  enum hsr_status status = hsr_json_check_schema(root, SCHEMA);
  return status ? status : hsr_json_object(root, members);
}

enum hsr_status hsr_line_style_read(const char *path,
                                    struct hsr_line_style *style,
                                    struct hsr_error *err) {
  const struct hsr_json_input input = {.path = path, .err = err};
  struct hsr_json_node root = {.input = &input};
  static const hsr_json_levels whole = NULL;
  char *text = NULL;
  enum hsr_status status =
      hsr_json_open(&input, &whole, NULL, &text, &root.value);
  if (!status)
    status = read_style(&root, style);
  json_decref(root.value);
  free(text);
  return status;
}
