/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr lesson: algorithms at work on one view, step by step, as one page. */
#include "bench/lesson/lesson.h"
#include "bench/list.h"
#include "bench/report/page.h"
#include "bench/terminal/terminal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define STANDARD_SIZE "128x128"
enum { MOST_ALGORITHMS = 48, MOST_FACES = 20000, MOST_SIDE = 1024 };
enum { EVENTS = 0x200, SURVEY, STANDARD_EVENTS = 2000000 };

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  int n;
  struct hsr_variant variant[MOST_ALGORITHMS];
  const char *output;
  long events;
  bool survey;
};

/* The lessons through the survey. */
static const struct {
  const char *algorithm, *scene;
  int size;
} lessons[] = {
#define LESSON(algorithm, scene, size) {algorithm, scene, size},
#include "bench/lesson/survey.def"
#undef LESSON
};
enum { N_LESSONS = sizeof lessons / sizeof *lessons };

/* --- Options -------------------------------------------------------------- */

static error_t add_algorithm(struct options *o, const char *name,
                             size_t length) {
  char text[HSR_MOST_VARIANT + 1];
  snprintf(text, sizeof text, "%.*s", (int)length, name);
  if (o->n == MOST_ALGORITHMS)
    return option_fail(&o->base, "lesson: at most %d algorithms",
                       (int)MOST_ALGORITHMS);
  struct hsr_error err;
  struct hsr_variant *variant = &o->variant[o->n++];
  enum hsr_status status = hsr_variant_parse(text, variant, &err);
  if (!status)
    status = trace_check(variant, &err);
  return status ? option_fail(&o->base, "%s", err.text) : 0;
}

static error_t add_algorithms(struct options *o, const char *names) {
  error_t error = 0;
  while (!error && *names) {
    size_t length = strcspn(names, ",");
    error = add_algorithm(o, names, length);
    names += length + (names[length] == ',');
  }
  return error;
}

/* The scene, and where to look from. */
static error_t parse_place_option(struct options *o, int key, char *arg) {
  error_t error = parse_scene_option(&o->scene, key, arg, "lesson", &o->base);
  return error == ARGP_ERR_UNKNOWN
             ? parse_view_option(&o->view, key, arg, &o->base)
             : error;
}

static error_t check_output(struct options *o) {
  return o->output
             ? 0
             : option_fail(&o->base, "lesson: which file? (-o FILE.html)");
}

static error_t check_options(struct options *o) {
  if (o->survey && (o->n || o->scene.name))
    return option_fail(&o->base, "lesson: --survey has scenes and algorithms "
                                 "of its own");
  if (o->survey)
    return check_output(o);
  error_t error =
      parse_scene_option(&o->scene, ARGP_KEY_END, NULL, "lesson", &o->base);
  if (error && error != ARGP_ERR_UNKNOWN)
    return error;
  if (!o->n)
    return option_fail(&o->base, "lesson: which algorithms? (-a A,B,...)");
  if (o->view.m > MOST_SIDE || o->view.n > MOST_SIDE)
    return option_fail(&o->base, "lesson: a page shows %d x %d samples at most",
                       (int)MOST_SIDE, (int)MOST_SIDE);
  return check_output(o);
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 'o':
    if (o->output)
      return option_fail(&o->base, "lesson: one -o, not also '%s'", arg);
    o->output = arg;
    return 0;
  case EVENTS:
    if (!parse_count(arg, 1, 10000000, &o->events))
      return option_fail(&o->base, "--events %s: must be 1 to 10000000", arg);
    return 0;
  case SURVEY:
    o->survey = true;
    return 0;
  case ARGP_KEY_END:
    return check_options(o);
  default:
    return parse_place_option(o, key, arg);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,...", 0,
         "the algorithms, in the order of the page", 0},
        {"output", 'o', "FILE.html", 0, "write the page here", 0},
        {"events", EVENTS, "N", 0,
         "of an algorithm of more steps, only the first N can be stepped "
         "through (standard: 2000000)",
         0},
        {"survey", SURVEY, NULL, 0,
         "instead of SCENE and -a: lessons through the survey, each algorithm "
         "on a scene that shows its idea",
         0},
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS_OF(STANDARD_SIZE),
        {0}},
    parse,
    "SCENE\n--survey",
    "Makes one page on which algorithms can be watched at work on a scene, "
    "step "
    "by step, forward and back, beside their pseudocode and their counts. The "
    "page holds everything: it opens from disk and needs no network.\v"
    "  hsr lesson house -a watkins -o watkins.html\n"
    "  hsr lesson house -a bouknight,watkins,warnock -o three.html\n"
    "  hsr lesson --survey -o lessons.html\n"
    "  hsr lesson cyclic-overlap -a newell -s 64x64 -o newell.html",
    NULL,
    NULL,
    NULL};

/* --- One algorithm -------------------------------------------------------- */

/* What is drawn, and by which algorithm. All borrowed. */
struct subject {
  const struct scene_options *scene;
  const struct view_options *view;
  const struct hsr_variant *variant;
};

/* Whether the events are as many as the counters say, and make the answer. */
static enum hsr_status check_events(struct lesson_recorder *recorder,
                                    const struct hsr_tally *tally,
                                    struct hsr_error *err) {
  const struct hsr_algorithm *a = recorder->run->setup.algorithm;
  char text[240];
  for (int k = 0; k < trace_n_counters(a); k++)
    if (recorder->count[k] != (a->counters[k].computed ? 0 : tally->count[k]))
      return hsr_fail(err, HSR_E_INTERNAL, "%s: %s: not as many events",
                      a->name, a->counters[k].name);
  enum hsr_status status =
      trace_answer_compare(&recorder->run->answer, text, sizeof text);
  if (status == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  return status ? hsr_fail(err, HSR_E_INTERNAL,
                           "%s: its events do not rebuild its answer: %s",
                           a->name, text)
                : HSR_OK;
}

static bool predicts(const struct hsr_algorithm *a) {
  bool any = false;
  for (const struct hsr_step *s = a->steps; s && s->label; s++)
    any = any || s->predict;
  return any;
}

/* The text of all that was recorded, to be freed. NULL: HSR_E_NOMEM. */
static char *pack(const struct lesson_recorder *recorder, json_t *description) {
  enum { FLAGS = JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9) };
  char *json = description ? json_dumps(description, FLAGS) : NULL;
  json_decref(description);
  if (!json)
    return NULL;
  struct lesson_bytes all = {.at = NULL};
  size_t length = strlen(json);
  for (int k = 0; k < 4; k++)
    lesson_add(&all, &(unsigned char){(unsigned char)(length >> 8 * k)}, 1);
  lesson_add(&all, json, length);
  free(json);
  lesson_add(&all, recorder->counters.at, recorder->counters.n);
  all.failed = all.failed || recorder->counters.failed;
  int n = trace_n_counters(recorder->run->setup.algorithm);
  for (int c = 0; c < n; c++)
    for (int k = 0; k < LESSON_N_FIELDS; k++) {
      const struct lesson_bytes *field = &recorder->column[c].field[k];
      lesson_add(&all, field->at, field->n);
      all.failed = all.failed || field->failed;
    }
  char *text = lesson_squeeze(&all);
  lesson_bytes_free(&all);
  return text;
}

static enum hsr_status record(struct lesson_recorder *recorder, char **text,
                              struct hsr_error *err) {
  struct trace_run *run = recorder->run;
  struct hsr_trace trace = {.listen = lesson_listen, .context = recorder};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_table1 table;
  enum hsr_status status =
      trace_answer_draw(&run->answer, &run->setup, &tally, err);
  if (!status)
    status = check_events(recorder, &tally, err);
  bool has_table = predicts(run->setup.algorithm);
  if (!status && has_table)
    status = measure_table1(&run->laid_out, &run->view, &table, err);
  if (status)
    return status;
  *text = pack(recorder,
               lesson_describe(recorder, &tally, has_table ? &table : NULL));
  return *text ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status run_one(const struct subject *subject, long events,
                               char **text, struct hsr_error *err) {
  struct trace_run run = {.command = "lesson",
                          .scene_options = subject->scene,
                          .view_options = subject->view,
                          .variant = subject->variant,
                          .most_faces = MOST_FACES};
  struct lesson_recorder *recorder = calloc(1, sizeof *recorder);
  if (!recorder)
    return hsr_fail_nomem(err);
  recorder->run = &run;
  recorder->most = (uint64_t)events;
  recorder->parts = json_array();
  enum hsr_status status = trace_run_open(&run, err);
  if (!status)
    status = record(recorder, text, err);
  if (!status && recorder->kept < recorder->events)
    fprintf(stderr,
            "hsr: %s: only the first %llu of %llu steps can be stepped "
            "through (--events)\n",
            run.variant->name, (unsigned long long)recorder->kept,
            (unsigned long long)recorder->events);
  lesson_recorder_free(recorder);
  free(recorder);
  trace_run_close(&run);
  return status;
}

/* --- The page ------------------------------------------------------------- */

static enum hsr_status read_page(char **page, struct hsr_error *err) {
  static const char name[] = "lesson.html";
  char folder[PAGE_FOLDER], path[PAGE_FOLDER + sizeof name];
  find_page(name, folder);
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "rb");
  size_t n = 0, room = 1 << 20;
  *page = malloc(room + 1);
  if (file && *page)
    n = fread(*page, 1, room, file);
  bool read = file && *page && !ferror(file);
  if (file)
    fclose(file);
  if (!read)
    return hsr_fail(err, HSR_E_INPUT, "%.400s: %s", path, strerror(errno));
  (*page)[n] = '\0';
  return HSR_OK;
}

/* The text in an attribute or an element. */
static void put_text(const char *text, FILE *out) {
  for (; *text; text++)
    switch (*text) {
    case '<':
      fputs("&lt;", out);
      break;
    case '&':
      fputs("&amp;", out);
      break;
    case '"':
      fputs("&quot;", out);
      break;
    default:
      putc(*text, out);
    }
}

static enum hsr_status write_run(const struct subject *subject, long events,
                                 FILE *out, struct hsr_error *err) {
  char *text = NULL;
  enum hsr_status status = run_one(subject, events, &text, err);
  if (!status) {
    fputs("<script type=\"text/plain\" class=\"run\" data-name=\"", out);
    put_text(subject->variant->name, out);
    fputs("\" data-scene=\"", out);
    put_text(subject->scene->name, out);
    fprintf(out, "\">%s</script>\n", text);
  }
  free(text);
  return status;
}

/* Draws with each algorithm in turn, and writes its text. */
static enum hsr_status write_runs(const struct options *o, FILE *out,
                                  struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  struct progress progress = progress_begin(stderr);
  for (int k = 0; k < o->n && !status; k++) {
    struct subject subject = {&o->scene, &o->view, &o->variant[k]};
    progress_tell(&progress, (size_t)k, (size_t)o->n, "algorithms",
                  o->variant[k].name);
    status = write_run(&subject, o->events, out, err);
  }
  progress_end(&progress);
  return status;
}

static enum hsr_status write_lesson(const struct options *o, int k, FILE *out,
                                    struct hsr_error *err) {
  struct view_options view = VIEW_OPTIONS_STANDARD;
  view.m = view.n = lessons[k].size;
  struct scene_options scene = {.name = lessons[k].scene};
  struct hsr_variant variant;
  struct subject subject = {&scene, &view, &variant};
  enum hsr_status status =
      hsr_variant_parse(lessons[k].algorithm, &variant, err);
  return status ? status : write_run(&subject, o->events, out, err);
}

/* What the way in to the lessons shows: the algorithms and their sorts. */
static json_t *survey_json(void) {
  json_t *survey = json_array();
  for (int k = 0; k < N_LESSONS; k++) {
    const struct hsr_algorithm *a =
        hsr_algorithm_find(lessons[k].algorithm)->plain;
    struct taxonomy place = taxonomy(a->taxonomy);
    hsr_json_append(
        &survey, json_pack("{ss ss ss si ss ss? ss? ss? so}", "name", a->name,
                           "title", a->title, "authors", a->authors, "year",
                           a->year, "taxonomy", place.class, "branch",
                           place.branch, "sort_order", a->sort_order,
                           "coherence", a->coherence, "sorts", sorts_json(a)));
  }
  return survey;
}

static enum hsr_status write_survey(const struct options *o, FILE *out,
                                    struct hsr_error *err) {
  json_t *survey = survey_json();
  char *text =
      survey ? json_dumps(survey, JSON_COMPACT | JSON_ENSURE_ASCII) : NULL;
  json_decref(survey);
  if (!text)
    return hsr_fail_nomem(err);
  fputs("<script type=\"application/json\" id=\"survey\">", out);
  for (const char *c = text; *c; c++)
    *c == '<' ? fputs("\\u003c", out) : putc(*c, out);
  fputs("</script>\n", out);
  free(text);
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < N_LESSONS && !status; k++)
    status = write_lesson(o, k, out, err);
  return status;
}

static enum hsr_status write_page(const struct options *o, const char *page,
                                  FILE *out, struct hsr_error *err) {
  static const char mark[] = "<!--runs-->";
  const char *here = strstr(page, mark);
  if (!here)
    return hsr_fail(err, HSR_E_INTERNAL, "lesson: the page has no '%s'", mark);
  fwrite(page, 1, (size_t)(here - page), out);
  enum hsr_status status =
      o->survey ? write_survey(o, out, err) : write_runs(o, out, err);
  fputs(here + strlen(mark), out);
  if (!status && ferror(out))
    status = hsr_fail(err, HSR_E_INPUT, "%s: cannot be written: %s", o->output,
                      strerror(errno));
  return status;
}

static enum hsr_status make_page(const struct options *o,
                                 struct hsr_error *err) {
  char *page = NULL;
  struct hsr_whole_file file;
  enum hsr_status status = read_page(&page, err);
  if (!status)
    status = hsr_whole_file_open(&file, o->output, err);
  if (!status) {
    status = write_page(o, page, file.stream, err);
    status = hsr_whole_file_close(&file, status, err);
  }
  free(page);
  if (!status)
    printf("open %s\n", o->output);
  return status;
}

enum hsr_status command_lesson(int argc, char **argv, struct hsr_error *err) {
  struct options *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  o->view = (struct view_options)VIEW_OPTIONS_STANDARD;
  o->events = STANDARD_EVENTS;
  parse_size(STANDARD_SIZE, &o->view.m, &o->view.n);
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  if (!status && !HSR_HAVE_REPORT)
    status = hsr_fail(err, HSR_E_USAGE,
                      "lesson: built without its page (configure needs node "
                      "and npm)");
  if (!status && !o->survey)
    status = aim_scene(&o->scene, &o->view, err);
  if (!status)
    status = make_page(o, err);
  free(o);
  return status;
}
