/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a suite, and judges the results picture by picture. Those that are equal
 * to the right ones cost no more than reading. */
#include "bench/stranger/picture.h"
#include "bench/stranger/suite/suite.h"
#include "bench/terminal/terminal.h"
#include "common/files/npy.h"

#include <errno.h>
#include <sha2.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PATH = 4600 };

static const char *path_in(char path[MOST_PATH], const char *folder,
                           const char *room, const char *name,
                           const char *suffix) {
  snprintf(path, MOST_PATH, "%s/%s%s%s", folder, room, name, suffix);
  return path;
}

/* --- The suite ------------------------------------------------------------ */

static enum hsr_status load(const char *path, json_t **all,
                            struct hsr_error *err) {
  json_error_t why;
  *all = json_load_file(path, JSON_REJECT_DUPLICATES, &why);
  return *all ? HSR_OK
              : hsr_fail(err, HSR_E_INPUT, "%.300s: %.100s", path, why.text);
}

static enum hsr_status check_file(const char *suite, const json_t *file,
                                  struct hsr_error *err) {
  char path[MOST_PATH], sum[SHA256_DIGEST_STRING_LENGTH];
  const char *name = json_string_value(json_object_get(file, "name"));
  const char *wanted = json_string_value(json_object_get(file, "sha256"));
  if (!name || !wanted)
    return hsr_fail(err, HSR_E_INPUT,
                    "%.300s/manifest.json: a file without name or sha256",
                    suite);
  path_in(path, suite, "", name, "");
  if (!SHA256File(path, sum))
    return errno == ENOMEM
               ? hsr_fail_nomem(err)
               : hsr_fail(err, HSR_E_INPUT, "%.300s: cannot be read: %s", path,
                          strerror(errno));
  return strcmp(sum, wanted)
             ? hsr_fail(err, HSR_E_INPUT,
                        "%.300s: is not the file that the manifest names", path)
             : HSR_OK;
}

/* Whether each file of the manifest is there, as it was made. */
static enum hsr_status check_suite(const char *suite, struct hsr_error *err) {
  char path[MOST_PATH];
  json_t *manifest;
  path_in(path, suite, "", "manifest.json", "");
  if (access(path, R_OK))
    return hsr_fail(err, HSR_E_INPUT,
                    "%.300s: is no suite: it has no manifest.json", suite);
  enum hsr_status status = load(path, &manifest, err);
  if (status)
    return status;
  const json_t *files = json_object_get(manifest, "files");
  for (size_t k = 0; k < json_array_size(files) && !status; k++)
    status = check_file(suite, json_array_get(files, k), err);
  if (!status && !json_array_size(files))
    status = hsr_fail(err, HSR_E_INPUT, "%.300s: names no files", path);
  json_decref(manifest);
  return status;
}

static const char *text_of(const json_t *about, const char *key) {
  const char *text = json_string_value(json_object_get(about, key));
  return text ? text : "";
}

static enum hsr_status take_case(struct suite_result *r, const json_t *about,
                                 struct hsr_error *err) {
  *r = (struct suite_result){
      .name = text_of(about, "name"),
      .scene = text_of(about, "scene"),
      .group = text_of(about, "group"),
      .view = (uint32_t)json_integer_value(json_object_get(about, "view")) - 1,
      .m = (int)json_integer_value(json_object_get(about, "width")),
      .n = (int)json_integer_value(json_object_get(about, "height"))};
  if (!*r->name || !*r->scene || r->m < 1 || r->n < 1 || r->m > HSR_MAX_SIZE ||
      r->n > HSR_MAX_SIZE || r->view == UINT32_MAX)
    return hsr_fail(err, HSR_E_INPUT,
                    "cases.json: the case '%.60s' lacks something", r->name);
  return HSR_OK;
}

static enum hsr_status take_cases(struct suite_judgement *j,
                                  struct hsr_error *err) {
  char path[MOST_PATH];
  enum hsr_status status =
      load(path_in(path, j->suite, "", "cases.json", ""), &j->about, err);
  const json_t *cases = json_object_get(j->about, "cases");
  if (!status && !json_array_size(cases))
    status = hsr_fail(err, HSR_E_INPUT, "%.300s: has no cases", path);
  if (status)
    return status;
  j->n = json_array_size(cases);
  j->result = calloc(j->n, sizeof *j->result);
  if (!j->result)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < j->n && !status; k++)
    status = take_case(&j->result[k], json_array_get(cases, k), err);
  return status;
}

/* --- One picture ---------------------------------------------------------- */

/* The scene that is open: pictures of one follow one another. */
struct desk {
  const struct suite_judgement *judgement;
  struct lib_scene *scene;
  const char *name;
};

static enum hsr_status open_scene_of(struct desk *desk,
                                     const struct suite_result *r,
                                     struct hsr_error *err) {
  char path[MOST_PATH];
  if (desk->name && !strcmp(desk->name, r->scene))
    return HSR_OK;
  hsr_close(desk->scene);
  desk->scene = NULL;
  desk->name = r->scene;
  path_in(path, desk->judgement->suite, "scenes/", r->scene, ".scene.json");
  return hsr_open(path, NULL, &desk->scene, err);
}

static bool are_ids(const struct hsr_npy *a, const struct suite_result *r) {
  return a->kind == 'u' && a->bytes == 4 && a->n_dimensions == 2 &&
         a->size[0] == (uint64_t)r->n && a->size[1] == (uint64_t)r->m;
}

static enum hsr_status read_right(const struct desk *desk,
                                  const struct suite_result *r,
                                  const char *suffix, struct hsr_npy *ids,
                                  struct hsr_error *err) {
  char path[MOST_PATH];
  path_in(path, desk->judgement->suite, "right/", r->name, suffix);
  enum hsr_status status = hsr_npy_read(path, ids, err);
  if (!status && !are_ids(ids, r))
    status = hsr_fail(err, HSR_E_INPUT, "%.300s: are no %d x %d ids", path,
                      r->m, r->n);
  return status;
}

/* Samples that are as they should be if vertices are rounded to floats. A
 * picture that is wrong as a whole has none. */
static enum hsr_status find_rounded(const struct desk *desk,
                                    const uint32_t *ids, struct suite_result *r,
                                    struct hsr_error *err) {
  char path[MOST_PATH];
  struct hsr_npy rounded = {.data = NULL};
  path_in(path, desk->judgement->suite, "right/", r->name, ".floats.npy");
  if (access(path, R_OK))
    return HSR_OK;
  enum hsr_status status = read_right(desk, r, ".floats.npy", &rounded, err);
  const uint32_t *wanted = rounded.data;
  for (size_t k = 0; k < (size_t)r->m * (size_t)r->n && !status; k++)
    if (r->kinds[k] && ids[k] == wanted[k])
      r->kinds[k] = 1 + STRANGER_FLOATS;
  hsr_npy_free(&rounded);
  return status;
}

static void count_kinds(struct suite_result *r) {
  for (size_t k = 0; k < (size_t)r->m * (size_t)r->n; k++)
    if (r->kinds[k])
      r->kind[r->kinds[k] - 1]++;
}

/* Takes the counts of a picture that was not compared before. */
static void take_verdict(const struct stranger_verdict *v,
                         struct suite_result *r) {
  r->state = v->differing ? SUITE_WRONG : SUITE_RIGHT;
  r->compared = v->compared;
  r->differing = v->differing;
  if (v->n_whole) {
    r->place = v->whole[0].place;
    r->got = v->whole[0].got;
    r->wanted = v->whole[0].wanted;
  }
}

/* Finds the kinds of what is wrong. */
static enum hsr_status explain(struct desk *desk, const uint32_t *ids,
                               struct suite_result *r, struct hsr_error *err) {
  const struct hsr_request request = {
      .size = sizeof request, .view = r->view, .m = r->m, .n = r->n};
  struct stranger_verdict verdict = {.kind = NULL};
  enum hsr_status status = open_scene_of(desk, r, err);
  if (!status)
    status = stranger_judge(&(struct stranger_question){.scene = desk->scene,
                                                        .request = &request,
                                                        .ids = ids},
                            &verdict, err);
  const bool is_compared = r->compared > 0;
  if (!status && is_compared && verdict.differing != r->differing)
    status = hsr_fail(err, HSR_E_INPUT,
                      "%.200s: right/%s.ids.npy is not the picture of this hsr",
                      desk->judgement->suite, r->name);
  if (!status) {
    if (!is_compared)
      take_verdict(&verdict, r);
    r->kinds = verdict.kind;
    verdict.kind = NULL;
    if (!verdict.n_whole)
      status = find_rounded(desk, ids, r, err);
    count_kinds(r);
  }
  stranger_free(&verdict);
  return status;
}

static void compare(const uint32_t *ids, const uint32_t *right,
                    struct suite_result *r) {
  r->compared = (uint64_t)r->m * (uint64_t)r->n;
  for (size_t k = 0; k < r->compared; k++)
    if (ids[k] != right[k] && !r->differing++) {
      r->place = (uint32_t)k;
      r->got = ids[k];
      r->wanted = right[k];
    }
  r->state = r->differing ? SUITE_WRONG : SUITE_RIGHT;
}

/* A picture whose sides are exchanged may have its rows and columns exchanged: it
 * has its own size then. */
static enum hsr_status judge_exchanged(struct desk *desk,
                                       const struct id_picture *picture,
                                       struct suite_result *r,
                                       struct hsr_error *err) {
  const struct suite_result as_asked = *r;
  r->m = picture->m;
  r->n = picture->n;
  enum hsr_status status = explain(desk, picture->ids, r, err);
  if (!status && r->kind[STRANGER_TRANSPOSED])
    return HSR_OK;
  free(r->kinds);
  *r = as_asked;
  return status ? status
                : hsr_fail(err, HSR_E_INPUT,
                           "%.200s/%s.npy: has %d x %d samples (columns x "
                           "rows), not %d x %d",
                           desk->judgement->results, r->name, picture->m,
                           picture->n, r->m, r->n);
}

/* Judges somebody's file. */
static enum hsr_status judge_ids(struct desk *desk, const uint32_t *right,
                                 struct suite_result *r,
                                 struct hsr_error *err) {
  char path[MOST_PATH];
  struct id_picture picture = {.ids = NULL};
  const struct picture_format format = {
      .path = path_in(path, desk->judgement->results, "", r->name, ".npy"),
      .m = r->m,
      .n = r->n};
  enum hsr_status status = picture_read(&format, UINT32_MAX, &picture, err);
  if (!status && picture.is_exchanged)
    status = judge_exchanged(desk, &picture, r, err);
  else if (!status) {
    compare(picture.ids, right, r);
    if (r->differing)
      status = explain(desk, picture.ids, r, err);
  }
  free(picture.ids);
  return status;
}

/* What is wrong with somebody's file is said of it; what is wrong with the suite
 * ends the judgement. */
static enum hsr_status judge_picture(struct desk *desk, struct suite_result *r,
                                     struct hsr_error *err) {
  char path[MOST_PATH];
  struct hsr_error why;
  struct hsr_npy right = {.data = NULL};
  r->state = SUITE_MISSING;
  enum hsr_status status = suite_judge_extras(desk->judgement, r, err);
  path_in(path, desk->judgement->results, "", r->name, ".npy");
  if (status || access(path, F_OK))
    return status;
  status = read_right(desk, r, ".ids.npy", &right, err);
  enum hsr_status read = status ? HSR_OK : judge_ids(desk, right.data, r, &why);
  if (read == HSR_E_NOMEM || read == HSR_E_INTERNAL)
    status = hsr_fail(err, read, "%s", why.text);
  else if (read) {
    r->state = SUITE_UNUSABLE;
    r->compared = r->differing = 0;
    memcpy(r->why, why.text, sizeof r->why);
  }
  hsr_npy_free(&right);
  return status;
}

/* --- All ------------------------------------------------------------------ */

static void add_extras(struct suite_judgement *j,
                       const struct suite_result *r) {
  for (int k = 0; k < SUITE_EXTRAS; k++) {
    const struct suite_extra *its = &r->extra[k];
    struct suite_extra *sum = &j->extra[k];
    sum->pictures += its->pictures;
    sum->compared += its->compared;
    sum->differing += its->differing;
    sum->largest = its->largest > sum->largest ? its->largest : sum->largest;
    if (!sum->first)
      sum->first = its->first;
    if (!*sum->why)
      memcpy(sum->why, its->why, sizeof sum->why);
  }
}

static void add_up(struct suite_judgement *j) {
  for (size_t k = 0; k < j->n; k++) {
    const struct suite_result *r = &j->result[k];
    j->state[r->state]++;
    add_extras(j, r);
    if (r->state == SUITE_MISSING || r->state == SUITE_UNUSABLE)
      continue;
    j->compared += r->compared;
    j->differing += r->differing;
    for (int kind = 0; kind < STRANGER_KINDS; kind++) {
      j->kind[kind] += r->kind[kind];
      j->pictures[kind] += r->kind[kind] > 0;
    }
  }
}

static enum hsr_status judge_all(struct suite_judgement *j,
                                 struct hsr_error *err) {
  struct desk desk = {.judgement = j};
  struct progress progress = progress_begin(stderr);
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < j->n && !status; k++) {
    progress_tell(&progress, k, j->n, "pictures", j->result[k].name);
    status = judge_picture(&desk, &j->result[k], err);
  }
  progress_end(&progress);
  hsr_close(desk.scene);
  return status;
}

enum hsr_status suite_judge(struct suite_judgement *judgement,
                            const char *suite, const char *results,
                            struct hsr_error *err) {
  *judgement = (struct suite_judgement){.suite = suite, .results = results};
  enum hsr_status status = check_suite(suite, err);
  if (!status)
    status = take_cases(judgement, err);
  if (!status)
    status = judge_all(judgement, err);
  if (status)
    return status;
  add_up(judgement);
  const struct suite_extra *extra = judgement->extra;
  if (judgement->state[SUITE_MISSING] == judgement->n &&
      !extra[SUITE_DEPTHS].pictures && !extra[SUITE_SEGMENTS].pictures)
    status = hsr_fail(err, HSR_E_INPUT,
                      "%.300s: has no picture of the suite, such as %s.npy",
                      results, judgement->result[0].name);
  return status;
}

void suite_free(struct suite_judgement *judgement) {
  for (size_t k = 0; k < judgement->n && judgement->result; k++)
    free(judgement->result[k].kinds);
  free(judgement->result);
  json_decref(judgement->about);
}

enum stranger_kind suite_worst(const uint64_t kind[STRANGER_KINDS]) {
  int worst = 0;
  for (int k = 1; k < STRANGER_KINDS; k++)
    if (kind[k] > kind[worst])
      worst = k;
  return (enum stranger_kind)worst;
}

bool suite_is_right(const struct suite_judgement *j) {
  bool right = j->state[SUITE_RIGHT] == j->n;
  for (int k = 0; k < SUITE_EXTRAS; k++)
    right = right && !j->extra[k].differing && !*j->extra[k].why;
  return right;
}
