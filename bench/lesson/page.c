/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lesson/lesson.h"
#include "bench/results/descriptor.h"
#include "bench/results/page.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

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

/* Where the laboratory shows the subject's view. */
static void put_lab(const struct lesson_subject *subject, const char *lab,
                    FILE *out) {
  const char *name = subject->scene->name;
  fputs("\" data-lab=\"", out);
  put_text(lab, out);
  fputs("#/?", out);
  if (!scene_is_made_by_name(subject->scene))
    return;
  fputs("s=", out);
  for (const unsigned char *c = (const unsigned char *)name; *c; c++)
    fprintf(out, isalnum(*c) || strchr("-._~", *c) ? "%c" : "%%%02X", *c);
  fprintf(out, "&amp;v=%ld", subject->view->view - 1);
}

static enum hsr_status write_run(const struct lesson_page *page,
                                 const struct lesson_subject *subject,
                                 FILE *out, struct hsr_error *err) {
  char *text = NULL;
  enum hsr_status status = lesson_draw(subject, &page->limits, &text, err);
  if (!status) {
    fputs("<script type=\"text/plain\" class=\"run\" data-name=\"", out);
    put_text(subject->variant->name, out);
    fputs("\" data-scene=\"", out);
    put_text(subject->scene->name, out);
    if (page->lab)
      put_lab(subject, page->lab, out);
    fprintf(out, "\">%s</script>\n", text);
  }
  free(text);
  return status;
}

/* Draws with each algorithm in turn, and writes its text. */
static enum hsr_status write_runs(const struct lesson_page *page, FILE *out,
                                  struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  struct progress progress = progress_begin(stderr);
  for (int k = 0; k < page->n && !status; k++) {
    progress_tell(&progress, (size_t)k, (size_t)page->n, "algorithms",
                  page->subject[k].variant->name);
    status = write_run(page, &page->subject[k], out, err);
  }
  progress_end(&progress);
  return status;
}

/* What the way in to the lessons shows: the algorithms and their sorts. */
static json_t *survey_json(const struct lesson_page *page) {
  json_t *survey = json_array();
  for (int k = 0; k < page->n; k++) {
    const struct hsr_algorithm *a = page->subject[k].variant->listed->plain;
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

static enum hsr_status write_survey(const struct lesson_page *page, FILE *out,
                                    struct hsr_error *err) {
  json_t *survivors = NULL;
  enum hsr_status status = lesson_survivors(&survivors, err);
  if (!status)
    status = put_page_json("survivors", survivors, out, err);
  return status ? status : put_page_json("survey", survey_json(page), out, err);
}

/* All that the page shows. */
static enum hsr_status put_all(const void *context, FILE *out,
                               struct hsr_error *err) {
  const struct lesson_page *page = context;
  enum hsr_status status =
      page->is_survey ? write_survey(page, out, err) : HSR_OK;
  return status ? status : write_runs(page, out, err);
}

enum hsr_status lesson_write(const struct lesson_page *page,
                             struct hsr_error *err) {
  char *built = NULL;
  enum hsr_status status = read_built_page("lesson.html", &built, err);
  if (!status)
    status =
        write_built_page(page->path, built, "<!--runs-->", put_all, page, err);
  free(built);
  return status;
}
