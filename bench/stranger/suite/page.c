/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judgement of a suite as a page of HTML, which needs no other file and no
 * script. */
#include "bench/stranger/suite/suite.h"
#include "common/files/whole_file.h"

#include <string.h>

static void put_text(const char *text, FILE *out) {
  for (; *text; text++)
    if (*text == '<')
      fputs("&lt;", out);
    else if (*text == '&')
      fputs("&amp;", out);
    else if (*text == '"')
      fputs("&quot;", out);
    else
      fputc(*text, out);
}

static void put_head(const struct suite_judgement *j, FILE *out) {
  fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n"
        "<title>hsr judge --suite</title>\n<style>\n"
        "body { font: 15px/1.45 sans-serif; max-width: 70em; margin: 2em auto; "
        "padding: 0 1em; color: #222; background: #fff }\n"
        "table { border-collapse: collapse; margin: 1em 0 }\n"
        "th, td { padding: .15em .8em .15em 0; text-align: left; "
        "vertical-align: top }\n"
        "th { border-bottom: 1px solid #999 }\n"
        "td:first-child { white-space: nowrap }\n"
        ".n { text-align: right }\n"
        ".key { display: inline-block; width: .9em; height: .9em; "
        "border: 1px solid #555 }\n"
        "figure { display: inline-block; margin: 0 1em 1em 0; "
        "vertical-align: top; width: 200px; font-size: 12px }\n"
        "svg { background: #333; width: 192px; shape-rendering: crispEdges }\n"
        "</style>\n<h1>The pictures of ",
        out);
  put_text(j->results, out);
  fprintf(out,
          "</h1>\n<p>%zu pictures: %zu right, %zu wrong, %zu missing, %zu "
          "unusable. %llu of %llu samples are wrong.</p>\n",
          j->n, j->state[SUITE_RIGHT], j->state[SUITE_WRONG],
          j->state[SUITE_MISSING], j->state[SUITE_UNUSABLE],
          (unsigned long long)j->differing, (unsigned long long)j->compared);
}

static void put_key(int kind, FILE *out) {
  fprintf(out, "<span class=\"key\" style=\"background:#%06x\"></span> ",
          (unsigned)stranger_kinds[kind].rgb);
}

static void put_kinds(const struct suite_judgement *j, FILE *out) {
  uint64_t left[STRANGER_KINDS];
  memcpy(left, j->kind, sizeof left);
  if (!j->differing)
    return;
  fputs("<h2>By kind of fault</h2>\n<table>\n<tr><th>kind<th class=\"n\">"
        "samples<th class=\"n\">pictures<th>what it is\n",
        out);
  for (;;) {
    const int kind = (int)suite_worst(left);
    if (!left[kind])
      break;
    fputs("<tr><td>", out);
    put_key(kind, out);
    fprintf(out, "%s<td class=\"n\">%llu<td class=\"n\">%zu<td>",
            stranger_kinds[kind].key, (unsigned long long)left[kind],
            j->pictures[kind]);
    put_text(stranger_kinds[kind].words, out);
    fputc('\n', out);
    left[kind] = 0;
  }
  fputs("</table>\n", out);
}

/* Depths and segments, if there are any. */
static void put_extras(const struct suite_judgement *j, FILE *out) {
  for (enum suite_extra_kind k = SUITE_DEPTHS; k < SUITE_EXTRAS; k++) {
    const struct suite_extra *e = &j->extra[k];
    if (!e->pictures)
      continue;
    fprintf(out, "<p>Files of %s: %zu; %llu of %llu %s are wrong",
            suite_extra_name(k), e->pictures, (unsigned long long)e->differing,
            (unsigned long long)e->compared, suite_extra_places(k));
    if (k == SUITE_DEPTHS)
      fprintf(out, "; the largest relative error is %.2g", e->largest);
    fputs(e->first ? "; first in " : "", out);
    put_text(e->first ? e->first : "", out);
    fputs(".</p>\n", out);
    if (*e->why) {
      fputs("<p>", out);
      put_text(e->why, out);
      fputs("</p>\n", out);
    }
  }
}

/* What the scene is made to break. */
static const char *about_scene(const struct suite_judgement *j,
                               const char *scene) {
  const json_t *scenes = json_object_get(j->about, "scenes");
  for (size_t k = 0; k < json_array_size(scenes); k++) {
    const json_t *s = json_array_get(scenes, k);
    const char *name = json_string_value(json_object_get(s, "name"));
    const char *about = json_string_value(json_object_get(s, "about"));
    if (name && about && !strcmp(name, scene))
      return about;
  }
  return "";
}

/* The wrong samples, a rectangle for each run of one kind in a row. */
static void put_picture(const struct suite_result *r, FILE *out) {
  fprintf(out, "<svg viewBox=\"0 0 %d %d\">", r->m, r->n);
  for (int j = 0; j < r->n; j++) {
    const unsigned char *row = r->kinds + (size_t)j * (size_t)r->m;
    for (int i = 0, end; i < r->m; i = end) {
      for (end = i + 1; end < r->m && row[end] == row[i];)
        end++;
      if (row[i])
        fprintf(out,
                "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"1\" "
                "fill=\"#%06x\"/>",
                i, j, end - i, (unsigned)stranger_kinds[row[i] - 1].rgb);
    }
  }
  fputs("</svg>", out);
}

static void put_id(uint32_t id, FILE *out) {
  if (id == HSR_NO_FACE)
    fputs("background", out);
  else if (id == STRANGER_BELOW_0)
    fputs("face -1", out);
  else
    fprintf(out, "face %u", id);
}

static void put_wrong(const struct suite_result *r, FILE *out) {
  const uint32_t m = (uint32_t)r->m;
  fputs("<figure>", out);
  put_picture(r, out);
  fputs("<figcaption><b>", out);
  put_text(r->name, out);
  fprintf(out, "</b>: %llu of %llu wrong; first (%u, %u): ",
          (unsigned long long)r->differing, (unsigned long long)r->compared,
          r->place % m, r->place / m);
  put_id(r->got, out);
  fputs(", not ", out);
  put_id(r->wanted, out);
  for (int k = 0; k < STRANGER_KINDS; k++)
    if (r->kind[k]) {
      fputs("<br>", out);
      put_key(k, out);
      fprintf(out, "%s %llu", stranger_kinds[k].key,
              (unsigned long long)r->kind[k]);
    }
  fputs("</figcaption></figure>\n", out);
}

static void put_results(const struct suite_judgement *j, FILE *out) {
  const char *scene = "";
  for (size_t k = 0; k < j->n; k++) {
    const struct suite_result *r = &j->result[k];
    if (r->state == SUITE_RIGHT)
      continue;
    if (strcmp(scene, r->scene)) {
      scene = r->scene;
      fputs("<h2>", out);
      put_text(scene, out);
      fputs("</h2>\n<p>", out);
      put_text(about_scene(j, scene), out);
      fputs("</p>\n", out);
    }
    if (r->state == SUITE_WRONG) {
      put_wrong(r, out);
      continue;
    }
    fputs("<p>", out);
    put_text(r->name, out);
    fputs(": ", out);
    put_text(r->state == SUITE_MISSING ? "missing" : r->why, out);
    fputs("</p>\n", out);
  }
}

enum hsr_status suite_write_page(const struct suite_judgement *j,
                                 const char *path, struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  put_head(j, file.stream);
  put_extras(j, file.stream);
  put_kinds(j, file.stream);
  put_results(j, file.stream);
  fputs("</html>\n", file.stream);
  return hsr_whole_file_close(&file, HSR_OK, err);
}
