/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/drawing_json.h"

#include "common/files/json/json_members.h"
#include "common/files/suffix.h"
#include "common/files/whole_file.h"

#include <math.h>
#include <stdlib.h>

static const char SCHEMA[] = "hsr-drawing/1";

/* --- Writing -------------------------------------------------------------- */

/* A name that is not UTF-8 is left out. */
static bool put_facts(FILE *out, const struct hsr_drawing_facts *facts,
                      size_t k) {
  json_t *name = json_string(facts->object_name[facts->object[k]]);
  fprintf(out, ", \"class\": \"%s\"", facts->class_name[facts->line_class[k]]);
  if (!name)
    return true;
  fputs(", \"object\": ", out);
  const bool good = !json_dumpf(name, out, JSON_ENCODE_ANY);
  json_decref(name);
  return good;
}

static void put_segment(FILE *out, const struct hsr_segment *s) {
  const struct hsr_edge_name *e = &s->edge;
  if (e->implied)
    fprintf(out, "{\"implied\": [%u, %u, %u]", e->a, e->b, e->part);
  else
    fprintf(out, "{\"edge\": [%u, %u]", e->a, e->b);
  fprintf(out, ", \"t\": [%.17g, %.17g], \"invisibility\": %u", s->t0, s->t1,
          s->invisibility);
}

/* False: out of memory. */
static bool put_drawing(FILE *out, const struct hsr_drawing *drawing,
                        const struct hsr_drawing_facts *facts, int m, int n) {
  bool good = true;
  fprintf(out, "{\"schema\": \"%s\", \"size\": [%d, %d], \"segments\": [",
          SCHEMA, m, n);
  for (size_t k = 0; k < drawing->n; k++) {
    fputs(k ? ",\n" : "\n", out);
    put_segment(out, &drawing->segment[k]);
    if (facts)
      good &= put_facts(out, facts, k);
    fputc('}', out);
  }
  fputs("]}\n", out);
  return good;
}

void hsr_drawing_json_print(FILE *out, const struct hsr_drawing *drawing, int m,
                            int n) {
  put_drawing(out, drawing, NULL, m, n);
}

enum hsr_status hsr_drawing_json_write(const char *path,
                                       const struct hsr_drawing *drawing,
                                       const struct hsr_drawing_facts *facts,
                                       int m, int n, struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  status = put_drawing(file.stream, drawing, facts, m, n) ? HSR_OK
                                                          : hsr_fail_nomem(err);
  return hsr_whole_file_close(&file, status, err);
}

/* --- Reading -------------------------------------------------------------- */

/* Whole numbers: the names of an edge. */
struct numbers {
  uint32_t value[3];
  size_t n; /* how many there must be */
  bool given;
};

static enum hsr_status take_number(const struct hsr_json_node *at, void *to) {
  double value = 0;
  enum hsr_status status = hsr_json_number(at, &value);
  if (!status && !(value >= 0 && value < UINT32_MAX && value == floor(value)))
    status = hsr_json_refuse(at, "must be a whole number from 0 to %u",
                             UINT32_MAX - 1);
  *(uint32_t *)to = status ? 0 : (uint32_t)value;
  return status;
}

static enum hsr_status take_numbers(const struct hsr_json_node *at, void *to) {
  struct numbers *numbers = to;
  enum hsr_status status = hsr_json_array(at, NULL);
  if (!status && json_array_size(at->value) != numbers->n)
    status = hsr_json_refuse(at, "must have %zu numbers", numbers->n);
  for (size_t k = 0; k < numbers->n && !status; k++) {
    struct hsr_json_node element = hsr_json_element(at, k);
    status = take_number(&element, &numbers->value[k]);
  }
  numbers->given = true;
  return status;
}

static enum hsr_status take_interval(const struct hsr_json_node *at, void *to) {
  double *t = to;
  enum hsr_status status = hsr_json_numbers(at, 2, hsr_json_share, t);
  return status || t[0] <= t[1] ? status
                                : hsr_json_refuse(at, "must not run backwards");
}

static void swap(struct hsr_segment *s) {
  const uint32_t a = s->edge.a;
  const double t0 = s->t0;
  s->edge.a = s->edge.b;
  s->edge.b = a;
  s->t0 = 1 - s->t1;
  s->t1 = 1 - t0;
}

/* Checks the name of an edge, and brings its vertices into their order. */
static enum hsr_status set_edge(const struct hsr_json_node *at,
                                const struct numbers *edge,
                                const struct numbers *implied,
                                struct hsr_segment *s) {
  const struct numbers *name = edge->given ? edge : implied;
  if (!name->given)
    return hsr_json_refuse(at, "must have an \"edge\", or an \"implied\" one");
  if (name->value[0] == name->value[1])
    return hsr_json_refuse(at, "must name two %s",
                           edge->given ? "vertices" : "faces");
  if (implied->given && name->value[0] > name->value[1])
    return hsr_json_refuse(at, "must name the lower face first");
  s->edge =
      (struct hsr_edge_name){implied->given, name->value[0], name->value[1],
                             implied->given ? name->value[2] : 0};
  if (s->edge.a > s->edge.b)
    swap(s);
  return HSR_OK;
}

static enum hsr_status take_segment(const struct hsr_json_node *at, void *to) {
  struct numbers edge = {.n = 2}, implied = {.n = 3};
  struct hsr_segment s = {.invisibility = 0};
  double t[2];
  const struct hsr_json_rule rules[] = {
      {"edge", take_numbers, &edge, false, {"implied", NULL}},
      {"implied", take_numbers, &implied, false, {NULL}},
      {"t", take_interval, t, true, {NULL}},
      {"invisibility", take_number, &s.invisibility, true, {NULL}},
      {.key = "class"},
      {.key = "object"},
      {.key = NULL}};
  enum hsr_status status = hsr_json_object(at, rules);
  if (status)
    return status;
  s.t0 = t[0];
  s.t1 = t[1];
  status = set_edge(at, &edge, &implied, &s);
  if (!status && hsr_drawing_add(to, &s))
    status = hsr_json_nomem(at);
  return status;
}

static enum hsr_status take_size(const struct hsr_json_node *at, void *to) {
  int *size = to;
  enum hsr_status status = hsr_json_array(at, NULL);
  if (!status && json_array_size(at->value) != 2)
    status = hsr_json_refuse(at, "must have 2 numbers");
  for (size_t k = 0; k < 2 && !status; k++) {
    struct hsr_json_node element = hsr_json_element(at, k);
    status = hsr_json_whole(&element, 1, 16384, &size[k]);
  }
  return status;
}

enum hsr_status hsr_drawing_json_read(const char *path,
                                      struct hsr_drawing *drawing, int size[2],
                                      struct hsr_error *err) {
  static const char *const lists[] = {"segments", NULL};
  static const hsr_json_levels levels[] = {lists, NULL};
  const bool svg = hsr_ends_in(path, ".svg");
  const struct hsr_json_input input = {.path = path,
                                       .err = err,
                                       .begin = svg ? HSR_DRAWING_IN_SVG : NULL,
                                       .end =
                                           svg ? HSR_DRAWING_IN_SVG_END : NULL};
  struct hsr_json_part list[HSR_JSON_MOST_LISTS] = {{.text = NULL}};
  char *text = NULL;
  json_t *value = NULL;
  *drawing = (struct hsr_drawing){.segment = NULL};
  size[0] = size[1] = 0;
  enum hsr_status status = hsr_json_open(&input, levels, list, &text, &value);
  const struct hsr_json_node root = {.input = &input, .value = value};
  const struct hsr_json_rule rules[] = {
      {"schema", NULL, NULL, true, {NULL}},
      {"size", take_size, size, false, {NULL}},
      {"segments", hsr_json_array, NULL, true, {NULL}},
      {.key = NULL}};
  if (!status)
    status = hsr_json_check_schema(&root, SCHEMA);
  if (!status)
    status = hsr_json_object(&root, rules);
  if (!status) {
    struct hsr_json_node segments = hsr_json_member(&root, "segments");
    status = hsr_json_list(&segments, list[0], levels + 1, NULL, take_segment,
                           drawing);
  }
  if (!status && hsr_drawing_gather(drawing))
    status = hsr_fail_nomem(err);
  json_decref(value);
  free(text);
  return status;
}
