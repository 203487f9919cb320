/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "config.h"

#include "bench/trace/trace.h"
#include "common/answers/coded.h"
#include "common/files/json/json.h"
#include "common/view/picture.h"
#include "common/files/srgb.h"
#include "common/view/clip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Subjects ------------------------------------------------------------- */

static json_t *subjects_json(void) {
  json_t *subjects = json_array();
  for (int kind = 0; kind < HSR_N_SUBJECT_KINDS; kind++) {
    json_t *ids = json_array();
    for (int k = 0; hsr_subject_ids[kind][k]; k++)
      hsr_json_append(&ids, json_string(hsr_subject_ids[kind][k]));
    hsr_json_append(
        &subjects,
        json_pack("{ss so}", "name", hsr_subject_kind_name[kind], "ids", ids));
  }
  return subjects;
}

/* --- The algorithm -------------------------------------------------------- */

int trace_n_counters(const struct hsr_algorithm *a) {
  int n = 0;
  while (a->counters && n < HSR_MAX_COUNTERS && a->counters[n].name)
    n++;
  return n;
}

static json_t *counter_json(const struct hsr_algorithm *a, int k) {
  const struct hsr_counter *c = &a->counters[k];
  int line = hsr_line_of(a, k);
  json_t *outcome_keys =
      c->outcome_keys ? hsr_json_words(c->outcome_keys, '|') : NULL;
  return json_pack(
      "{ss ss* so* ss ss ss ss so so sb}", "name", c->name, "key", c->key,
      "outcome_keys", outcome_keys, "meaning", c->meaning, "kind",
      hsr_step_kind_name[c->kind], "a", hsr_subject_kind_name[c->a], "b",
      hsr_subject_kind_name[c->b], "outcomes", hsr_json_words(c->outcomes, '|'),
      "line", line ? json_integer(line) : json_null(), "computed", c->computed);
}

static json_t *counters_json(const struct hsr_algorithm *a) {
  json_t *counters = json_array();
  for (int k = 0; k < trace_n_counters(a); k++)
    hsr_json_append(&counters, counter_json(a, k));
  return counters;
}

static json_t *outline_json(const struct hsr_algorithm *a) {
  json_t *outline = json_array();
  for (const struct hsr_line *l = a->outline; l->text; l++)
    hsr_json_append(&outline, json_string(l->text));
  return outline;
}

static json_t *step_kinds_json(void) {
  json_t *kinds = json_array();
  for (int k = 0; k < HSR_N_STEP_KINDS; k++)
    hsr_json_append(&kinds, json_string(hsr_step_kind_name[k]));
  return kinds;
}

/* Adds a member to an object, as hsr_json_append adds to an array. */
static void add(json_t **object, const char *name, json_t *value) {
  if (json_object_set_new(*object, name, value)) {
    json_decref(*object);
    *object = NULL;
  }
}

/* Adds the values chosen for some options. */
static void add_options(json_t **to, const struct hsr_option *options,
                        const struct hsr_values *values) {
  for (int k = 0; options && options[k].name; k++) {
    const struct hsr_option *o = &options[k];
    long chosen = values->option[k];
    add(to, o->name,
        o->words  ? json_string(o->words[chosen].name)
        : o->real ? json_real(values->real[k])
                  : json_integer(chosen));
  }
}

/* The value chosen for every option; also for those of an answer that the
 * algorithm makes besides its own. */
static json_t *options_json(const struct hsr_algorithm *a,
                            const struct hsr_choice *choice) {
  json_t *options = json_object();
  add_options(&options, a->options, &choice->values);
  if (hsr_makes_also(a, choice->form.type))
    add_options(&options, choice->form.type->options, &choice->form.values);
  if (choice->window)
    add(&options, "window", json_integer(choice->window));
  return options;
}

static json_t *adaptations_json(const struct hsr_setup *setup) {
  json_t *adaptations = json_array();
  for (int k = 0; k < setup->n_adaptations; k++)
    hsr_json_append(&adaptations, json_string(setup->adaptation[k].name));
  return adaptations;
}

static json_t *algorithm_json(const struct trace_header *h) {
  const struct hsr_algorithm *a = h->run->setup.algorithm;
  return json_pack("{ss ss ss ss so ss ss so so}", "name", a->name, "variant",
                   h->run->variant->name, "title", a->title, "authors",
                   a->authors, "year",
                   a->year ? json_integer(a->year) : json_null(), "source",
                   a->source, "answer", h->run->answer.drawn.form.type->name,
                   "options", options_json(a, &h->run->setup.choice), "adapted",
                   adaptations_json(&h->run->setup));
}

/* --- The view ------------------------------------------------------------- */

static json_t *vector_json(const double v[3]) {
  return json_pack("[fff]", v[0], v[1], v[2]);
}

static json_t *view_json(const struct trace_header *h) {
  const struct hsr_camera *c = &h->run->view.camera;
  const struct hsr_window *w = &h->run->view.window;
  const double *l = h->run->view.light;
  json_t *light = h->run->answer.drawn.form.type->takes & 1 << HSR_LIGHTING
                      ? json_pack("[ffff]", l[0], l[1], l[2], l[3])
                      : NULL;
  return json_pack("{si si si s[iiii] so so so sf sf sf so*}", "number",
                   (int)h->run->view_options->view, "width", h->run->view.m,
                   "height", h->run->view.n, "window", w->x0, w->y0, w->x1,
                   w->y1, "eye", vector_json(c->eye), "at", vector_json(c->at),
                   "up", vector_json(c->up), "fov", c->fov, "near", c->near,
                   "parallel", c->parallel, "light", light);
}

/* --- Faces ---------------------------------------------------------------- */

static void vertex_of(const struct hsr_world *world, uint32_t v,
                      double point[3]) {
  point[0] = world->mesh.x[v];
  point[1] = world->mesh.y[v];
  point[2] = world->mesh.z[v];
}

/* If the algorithm got a scene laid out, these are the vertices that it got:
 * adapters add some to the scene's own. */
static json_t *vertices_json(const struct trace_header *h) {
  const struct hsr_world *world = hsr_is_roster(h->run->setup.world)
                                      ? &h->run->laid_out
                                      : h->run->setup.world;
  json_t *vertices = json_array();
  for (uint32_t v = 0; v < world->mesh.n_vertices; v++) {
    double point[3];
    vertex_of(world, v, point);
    hsr_json_append(&vertices, hsr_point_json(&h->run->view, point));
  }
  return vertices;
}

static json_t *objects_json(const struct hsr_scene *scene) {
  json_t *objects = json_array();
  for (uint32_t k = 0; k < scene->n_objects; k++)
    hsr_json_append(&objects, json_string(scene->objects[k].name));
  return objects;
}

/* "#rrggbb", in sRGB, as hsr render paints the face. */
static json_t *colour_json(const struct trace_header *h, uint32_t face) {
  float rgb[3];
  hsr_picture_colour(&h->run->laid_out, &h->run->view, face, HSR_SHADE_LAMBERT,
                     rgb);
  int byte[3];
  for (int c = 0; c < 3; c++)
    byte[c] = (int)lrintf(255 * hsr_srgb_encode(rgb[c]));
  return json_sprintf("#%02x%02x%02x", byte[0], byte[1], byte[2]);
}

static json_t *corners_json(const struct hsr_world *world, uint32_t face) {
  json_t *corners = json_array();
  for (uint32_t k = world->mesh.start[face]; k < world->mesh.start[face + 1];
       k++)
    hsr_json_append(&corners, json_integer(world->mesh.vertex[k]));
  return corners;
}

/* Room for one polygon, and for the polygon clipped. */
struct room {
  double (*in)[3], (*out)[3];
};

static int largest_face(const struct hsr_world *world) {
  uint32_t most = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (hsr_face_size(world, f) > most)
      most = hsr_face_size(world, f);
  return (int)most;
}

json_t *trace_polygon_json(const struct hsr_view *view, const double (*in)[3],
                           int n, double (*out)[3]) {
  static const double by_depth[3] = {0, 0, 1};
  double deepest = 0;
  for (int k = 0; k < n; k++)
    deepest = fmax(deepest, in[k][2]);
  double near = fmax(view->near, view->parallel ? 0 : 1e-6 * deepest);
  json_t *polygon = json_array();
  if (deepest > near)
    n = hsr_clip(in, n, by_depth, -near, out);
  for (int k = 0; deepest > near && k < n; k++)
    hsr_json_append(&polygon, hsr_image_json(view, out[k]));
  return polygon;
}

static json_t *face_json(const struct trace_header *h, uint32_t face,
                         const struct room *room) {
  const struct hsr_world *world = &h->run->laid_out;
  int n = (int)hsr_face_size(world, face);
  for (int k = 0; k < n; k++) {
    double point[3];
    vertex_of(world, world->mesh.vertex[world->mesh.start[face] + (uint32_t)k],
              point);
    hsr_view_project(&h->run->view, point, room->in[k]);
  }
  return trace_polygon_json(&h->run->view, (const double(*)[3])room->in, n,
                            room->out);
}

static json_t *faces_json(const struct trace_header *h) {
  size_t most = (size_t)largest_face(&h->run->laid_out);
  struct room room = {.in = malloc(most * sizeof *room.in),
                      .out = malloc((most + most / 2 + 1) * sizeof *room.out)};
  json_t *faces = room.in && room.out ? json_array() : NULL;
  for (uint32_t f = 0; faces && f < h->run->laid_out.n_faces; f++)
    hsr_json_append(
        &faces, json_pack("[I I o o o]", (json_int_t)f,
                          (json_int_t)h->run->laid_out.mesh.object[f],
                          colour_json(h, f), corners_json(&h->run->laid_out, f),
                          face_json(h, f, &room)));
  free(room.in);
  free(room.out);
  return faces;
}

/* --- All ------------------------------------------------------------------ */

static json_t *filter_json(const struct trace_filter *filter,
                           const struct hsr_algorithm *a) {
  json_t *window = json_null(), *counters = json_null();
  if (filter->has_window)
    window = json_pack("[iiii]", filter->window.x0, filter->window.y0,
                       filter->window.x1, filter->window.y1);
  if (filter->has_counters)
    counters = json_array();
  for (int k = 0; filter->has_counters && k < trace_n_counters(a); k++)
    if (filter->counters >> k & 1)
      hsr_json_append(&counters, json_integer(k));
  return json_pack("{so so si}", "window", window, "counters", counters,
                   "every", (int)filter->every);
}

/* The meaning of each place in the arrays. */
static json_t *places_json(void) {
  return json_pack(
      "{so so so so}", "event",
      hsr_json_words("number counter a b window outcome part", ' '), "segment",
      hsr_json_words("edge invisibility t0 t1 from to image_from image_to",
                     ' '),
      "face", hsr_json_words("id object colour corners polygon", ' '), "window",
      hsr_json_words("x0 y0 x1 y1", ' '));
}

json_t *trace_header_json(const struct trace_header *h) {
  const struct hsr_algorithm *a = h->run->setup.algorithm;
  return json_pack("{ss ss ss ss so so so si so so so so so so so so so}",
                   "record", "header", "schema", "hsr-trace/1", "version",
                   PACKAGE_VERSION, "scene", h->run->scene_options->name,
                   "view", view_json(h), "algorithm", algorithm_json(h), "kept",
                   filter_json(h->filter, a), "keyframe",
                   (int)h->filter->keyframe, "outline", outline_json(a),
                   "counters", counters_json(a), "step_kinds",
                   step_kinds_json(), "subjects", subjects_json(), "places",
                   places_json(), "background", colour_json(h, HSR_BACKGROUND),
                   "objects", objects_json(h->run->laid_out.roster.scene),
                   "vertices", vertices_json(h), "faces", faces_json(h));
}
