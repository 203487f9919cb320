/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/programs/module.h"
#include "algorithms/setup.h"
#include "bench/programs/program.h"
#include "common/answers/kinds/segments.h"
#include "common/lines/edges.h"
#include "common/answers/kinds/ids.h"

#include <errno.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_PROGRAMS = 128 };

/* A program that was named. An algorithm learns which it is by what is chosen of
 * its only option. */
struct known {
  char *path;
  struct hsr_algorithm plain, counting;
  struct hsr_listed listed;
};
static struct known known[MOST_PROGRAMS];
static int n_known;
static double limit = 60;

void program_set_limit(double seconds) {
  limit = seconds;
}

/* --- As an algorithm ------------------------------------------------------ */

const struct hsr_algorithm program_demands = {.name = "triangles",
                                              .subjects = 1 << HSR_FACES,
                                              .makes = {{&hsr_answer_ids}},
                                              .restrictions = HSR_TR};

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  (void)option;
  struct hsr_setup *triangles = malloc(sizeof *triangles);
  *prepared = triangles;
  return triangles
             ? hsr_setup_init(triangles, &program_demands, NULL, world, err)
             : hsr_fail_nomem(err);
}

static void release(void *prepared) {
  hsr_setup_free(prepared);
  free(prepared);
}

static bool is_whole(const struct hsr_view *v) {
  return v->m == v->whole_m && v->n == v->whole_n && v->offset_x == 0 &&
         v->offset_y == 0;
}

/* The segments, with their places. */
static enum hsr_status read_segments(struct program *program,
                                     const struct hsr_job *job,
                                     struct hsr_error *err) {
  struct hsr_edges edges;
  enum hsr_status status = hsr_edges_init(&edges, job->world, err);
  if (!status)
    status = program_read_segments(program, &edges,
                                   hsr_answer_drawing_of(job->answer), err);
  hsr_edges_free(&edges);
  return status;
}

static enum hsr_status draw(struct program *program, const struct hsr_job *job,
                            char byte, struct hsr_error *err) {
  struct program_phases phases;
  enum hsr_status status = program_ready(program, limit, &phases, err);
  if (!status)
    status = program_unset(program, err);
  if (!status)
    status = program_draw(program, byte, 1, limit, NULL, NULL, err);
  if (!status)
    status = job->answer->ids ? program_read_ids(program, job->answer->ids, err)
                              : read_segments(program, job, err);
  return status;
}

static enum hsr_status run_program(const struct hsr_job *job, char byte,
                                   struct hsr_error *err) {
  const struct known *its = &known[job->option[0]];
  const struct hsr_setup *triangles = job->prepared;
  if (!is_whole(job->view))
    return hsr_fail(err, HSR_E_REFUSED,
                    "a program draws whole pictures, no tiles");
  struct program_job asked = {.path = its->path,
                              .name = its->plain.name,
                              .answer = its->plain.makes[0].kind->name,
                              .world = job->world,
                              .triangles = triangles->world,
                              .scene = job->world->roster.scene->name,
                              .view = job->view,
                              .n_views = 1,
                              .threads = 1};
  struct program *program;
  enum hsr_status status = program_start(&asked, &program, err);
  if (!status)
    status = draw(program, job, byte, err);
  if (!status)
    return program_end(program, err);
  program_kill(program);
  return status;
}

/* The program has its own limit of time, by which its last words are heard. So the
 * judge's stands still meanwhile. */
static enum hsr_status run(const struct hsr_job *job, char byte,
                           struct hsr_error *err) {
  unsigned left = alarm(0);
  enum hsr_status status = run_program(job, byte, err);
  alarm(left);
  return status;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return run(job, 'f', err);
}

static enum hsr_status render_counting(const struct hsr_job *job,
                                       struct hsr_error *err) {
  return run(job, 'c', err);
}

/* --- Finding one ---------------------------------------------------------- */

bool program_is(const struct hsr_algorithm *a) {
  return a->prepare == prepare;
}

const char *program_path(const struct hsr_algorithm *a) {
  for (int k = 0; k < n_known; k++)
    if (a == &known[k].plain || a == &known[k].counting)
      return known[k].path;
  return NULL;
}

static enum hsr_status check_file(const char *path, struct hsr_error *err) {
  struct stat about;
  if (stat(path, &about))
    return hsr_fail(err, HSR_E_USAGE, "%s: %s", path, strerror(errno));
  if (S_ISDIR(about.st_mode))
    return hsr_fail(err, HSR_E_USAGE, "%s: a folder, not a program", path);
  return access(path, X_OK)
             ? hsr_fail(err, HSR_E_USAGE, "%s: cannot be run: %s", path,
                        strerror(errno))
             : HSR_OK;
}

/* Before the kind of answer that a program is named with. */
#define ANSWER ":answer="

/* Cuts ":answer=KIND" off, and finds the kind. */
static enum hsr_status choose_kind(char *path, struct hsr_made *made,
                                   struct hsr_error *err) {
  static const struct {
    const char *name;
    struct hsr_made made;
  } all[] = {{"ids", {.kind = &hsr_answer_ids}},
             {"segments", {.kind = &hsr_answer_segments}},
             {"visible-segments", {&hsr_answer_segments, 0, HSR_VISIBLE_ONLY}}};
  char *at = strstr(path, ANSWER);
  const char *name = at ? at + sizeof ANSWER - 1 : all[0].name;
  if (at)
    *at = '\0';
  for (size_t k = 0; k < sizeof all / sizeof *all; k++)
    if (!strcmp(name, all[k].name)) {
      *made = all[k].made;
      return HSR_OK;
    }
  return hsr_fail(err, HSR_E_USAGE,
                  "%s: answer=%.40s: must be ids, segments or visible-segments",
                  path, name);
}

/* Notes a program; its path becomes the list's. */
static const struct known *add(char *path, const char *text,
                               const struct hsr_made *made) {
  struct known *k = &known[n_known];
  k->path = path;
  k->plain = (struct hsr_algorithm){.name = strdup(text),
                                    .title = "A program",
                                    .authors = "",
                                    .source = path,
                                    .taxonomy = HSR_YARDSTICK,
                                    .subjects = 1 << HSR_FACES,
                                    .makes = {*made},
                                    .flags = HSR_FRAME_STATE,
                                    .prepare = prepare,
                                    .render = render,
                                    .release = release};
  memset(k->plain.base, HSR_MAX_COUNTERS, sizeof k->plain.base);
  k->counting = k->plain;
  k->counting.render = render_counting;
  k->listed = (struct hsr_listed){&k->plain, &k->counting};
  n_known += k->plain.name != NULL;
  return k->plain.name ? k : NULL;
}

static const struct known *find(const char *text) {
  for (int k = 0; k < n_known; k++)
    if (!strcmp(known[k].plain.name, text))
      return &known[k];
  return NULL;
}

/* The program that a text names, which may be known already. */
static enum hsr_status find_or_add(const char *text, const struct known **found,
                                   struct hsr_error *err) {
  struct hsr_made made = {.kind = NULL};
  *found = find(text);
  if (*found)
    return HSR_OK;
  if (n_known == MOST_PROGRAMS)
    return hsr_fail(err, HSR_E_USAGE, "at most %d programs",
                    (int)MOST_PROGRAMS);
  char *path = strdup(text);
  enum hsr_status status =
      path ? choose_kind(path, &made, err) : hsr_fail_nomem(err);
  if (!status)
    status = check_file(path, err);
  if (!status && !(*found = add(path, text, &made)))
    status = hsr_fail_nomem(err);
  if (status)
    free(path);
  return status;
}

enum hsr_status program_variant_parse(const char *text,
                                      struct hsr_variant *variant,
                                      struct hsr_error *err) {
  if (!strchr(text, '/') || strlen(text) > HSR_MOST_VARIANT)
    return hsr_variant_parse(text, variant, err);
  const struct known *found;
  enum hsr_status status = find_or_add(text, &found, err);
  if (status)
    return status;
  *variant = hsr_variant_standard(&found->listed);
  variant->choice.values.option[0] = found - known;
  return HSR_OK;
}

/* --- Patterns ------------------------------------------------------------- */

static bool is_program_file(const char *path) {
  struct hsr_error ignored;
  return !check_file(path, &ignored);
}

/* Calls take() for the programs among files, each with `rest` behind its path. */
static enum hsr_status add_found(const glob_t *found, const char *rest,
                                 enum hsr_status (*take)(void *, const char *,
                                                         struct hsr_error *),
                                 void *data, size_t *n, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < found->gl_pathc && !status; k++) {
    char text[HSR_MOST_VARIANT + 1];
    snprintf(text, sizeof text, "%s%s", found->gl_pathv[k], rest);
    if (!is_program_file(found->gl_pathv[k]))
      continue;
    ++*n;
    status = take(data, text, err);
  }
  return status;
}

enum hsr_status program_each(const char *text,
                             enum hsr_status (*take)(void *data,
                                                     const char *text,
                                                     struct hsr_error *err),
                             void *data, struct hsr_error *err) {
  if (!strchr(text, '/') || !strpbrk(text, "*?["))
    return take(data, text, err);
  const char *rest = strstr(text, ANSWER);
  char *pattern = strndup(text, rest ? (size_t)(rest - text) : strlen(text));
  if (!pattern)
    return hsr_fail_nomem(err);
  glob_t found = {.gl_pathc = 0};
  size_t n = 0;
  int end = glob(pattern, 0, NULL, &found);
  enum hsr_status status = HSR_OK;
  if (!end)
    status = add_found(&found, rest ? rest : "", take, data, &n, err);
  if (end == GLOB_NOSPACE)
    status = hsr_fail_nomem(err);
  else if (!n)
    status = hsr_fail(err, HSR_E_USAGE, "no program matches '%.200s'", pattern);
  globfree(&found);
  free(pattern);
  return status;
}
