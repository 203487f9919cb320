/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/stranger/say.h"
#include "bench/terminal/terminal.h"
#include "common/files/image.h"
#include "common/files/json/json.h"
#include "common/files/srgb.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* --- Text ----------------------------------------------------------------- */

static const char *say_id(uint32_t id, char text[24]) {
  if (id == HSR_NO_FACE)
    return "background";
  if (id == STRANGER_BELOW_0)
    return "face -1";
  snprintf(text, 24, "face %u", id);
  return text;
}

/* "  120 samples  turned over: ..." and the first of them. */
static void say_reason(const struct stranger_verdict *v,
                       const struct stranger_reason *r, bool colours) {
  char number[TERMINAL_NUMBER], text[500], got[24], wanted[24];
  const uint32_t m = (uint32_t)v->m;
  int used = printf("  %-16s ", terminal_number(r->samples, "samples", number));
  snprintf(text, sizeof text, "%s; first (%u, %u): %s, not %s%s%s", r->words,
           r->place % m, r->place / m, say_id(r->got, got),
           say_id(r->wanted, wanted), colours ? "; in the picture: " : "",
           colours ? stranger_kinds[r->kind].colour : "");
  terminal_wrap(stdout, used, 19, text);
}

static void say_reasons(const struct stranger_verdict *v, bool colours) {
  char number[TERMINAL_NUMBER];
  if (*v->no_reasons)
    printf("no reasons are looked for: %s\n", v->no_reasons);
  if (v->n_whole + v->n_sample)
    puts("most likely:");
  for (int k = 0; k < v->n_whole; k++)
    say_reason(v, &v->whole[k], colours);
  if (v->n_whole && !v->left)
    puts("with that put right, all samples are right");
  if (v->n_whole && v->left)
    printf("with that put right, %s %s left:\n",
           terminal_number(v->left, "samples", number),
           v->left == 1 ? "is" : "are");
  for (int k = 0; k < v->n_sample; k++)
    say_reason(v, &v->sample[k], colours);
}

void say_text(const struct judged *judged, bool colours) {
  const struct stranger_verdict *v = judged->verdict;
  char scene[TERMINAL_NAME], picture[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d samples, %s: ",
         terminal_plain(judged->scene, scene, sizeof scene), judged->view, v->m,
         v->n, terminal_plain(judged->picture, picture, sizeof picture));
  if (!v->differing) {
    printf("all %llu are right\n", (unsigned long long)v->compared);
    return;
  }
  printf("%llu of %llu %s wrong (%.3g %%)\n", (unsigned long long)v->differing,
         (unsigned long long)v->compared, v->differing == 1 ? "is" : "are",
         100.0 * (double)v->differing / (double)v->compared);
  if (v->differing > 1)
    printf("they are in columns %d to %d of rows %d to %d\n", v->box[0],
           v->box[2] - 1, v->box[1], v->box[3] - 1);
  printf("the first is %s\n", v->first);
  say_reasons(v, colours);
}

/* --- JSON ----------------------------------------------------------------- */

static json_t *id_json(uint32_t id) {
  return id == HSR_NO_FACE        ? json_null()
         : id == STRANGER_BELOW_0 ? json_integer(-1)
                                  : json_integer(id);
}

static json_t *reason_json(const struct stranger_verdict *v,
                           const struct stranger_reason *r, bool whole) {
  const uint32_t m = (uint32_t)v->m;
  return json_pack("{s:s, s:b, s:s, s:I, s:[i,i], s:o, s:o}", "kind",
                   stranger_kinds[r->kind].key, "whole", (int)whole, "words",
                   r->words, "samples", (json_int_t)r->samples, "first",
                   (int)(r->place % m), (int)(r->place / m), "got",
                   id_json(r->got), "wanted", id_json(r->wanted));
}

static json_t *reasons_json(const struct stranger_verdict *v) {
  json_t *list = json_array();
  for (int k = 0; k < v->n_whole; k++)
    hsr_json_append(&list, reason_json(v, &v->whole[k], true));
  for (int k = 0; k < v->n_sample; k++)
    hsr_json_append(&list, reason_json(v, &v->sample[k], false));
  return list;
}

/* A new reference; NULL: memory ran out. */
static json_t *whole_json(const struct judged *judged) {
  const struct stranger_verdict *v = judged->verdict;
  json_t *reasons = reasons_json(v);
  if (!reasons)
    return NULL;
  json_t *all =
      json_pack("{s:s, s:s, s:s, s:I, s:[i,i], s:I, s:I, s:o}", "schema",
                "hsr-judge/1", "scene", judged->scene, "picture",
                judged->picture, "view", (json_int_t)judged->view, "size", v->m,
                v->n, "compared", (json_int_t)v->compared, "wrong",
                (json_int_t)v->differing, "reasons", reasons);
  if (!all || !v->differing)
    return all;
  if (json_object_set_new(
          all, "box",
          json_pack("[i,i,i,i]", v->box[0], v->box[1], v->box[2], v->box[3])) ||
      json_object_set_new(all, "first", json_string(v->first)) ||
      json_object_set_new(all, "left", json_integer((json_int_t)v->left)) ||
      (*v->no_reasons &&
       json_object_set_new(all, "no_reasons", json_string(v->no_reasons)))) {
    json_decref(all);
    return NULL;
  }
  return all;
}

enum hsr_status say_json(const struct judged *judged, struct hsr_error *err) {
  json_t *all = whole_json(judged);
  if (!all)
    return hsr_fail_nomem(err);
  json_dumpf(all, stdout, JSON_INDENT(1));
  putchar('\n');
  json_decref(all);
  return HSR_OK;
}

/* --- A picture ------------------------------------------------------------ */

enum hsr_status say_picture(const struct judged *judged, const char *path,
                            struct hsr_error *err) {
  static const uint32_t right = 0x202020;
  const struct stranger_verdict *v = judged->verdict;
  const size_t n = (size_t)v->m * (size_t)v->n;
  float *rgb = malloc(3 * n * sizeof *rgb);
  if (!rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++) {
    uint32_t colour = v->kind[k] ? stranger_kinds[v->kind[k] - 1].rgb : right;
    for (int c = 0; c < 3; c++)
      rgb[3 * k + (size_t)c] =
          hsr_srgb_decode((float)(colour >> (16 - 8 * c) & 0xff) / 255);
  }
  struct hsr_picture picture = {.m = v->m, .n = v->n, .rgb = rgb};
  enum hsr_status status = hsr_image_write(path, &picture, NULL, err);
  free(rgb);
  return status;
}

/* --- Line drawings -------------------------------------------------------- */

static void say_edge(const struct hsr_edge_name *e, char text[100]) {
  if (e->implied)
    snprintf(text, 100, "number %u where faces %u and %u penetrate", e->part,
             e->a, e->b);
  else
    snprintf(text, 100, "from vertex %u to %u", e->a, e->b);
}

void say_lines(const struct judged *judged, const struct line_verdict *v, int m,
               int n) {
  char scene[TERMINAL_NAME], picture[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d, %s: ",
         terminal_plain(judged->scene, scene, sizeof scene), judged->view, m, n,
         terminal_plain(judged->picture, picture, sizeof picture));
  if (!v->differing) {
    printf("all %llu edges are right\n", (unsigned long long)v->compared);
    return;
  }
  printf("%llu of %llu edges are wrong\nmost likely:\n",
         (unsigned long long)v->differing, (unsigned long long)v->compared);
  for (int k = 0; k < v->n_reasons; k++) {
    char number[TERMINAL_NUMBER], edge[100], text[300];
    int used = printf("  %-16s ",
                      terminal_number(v->reason[k].edges, "edges", number));
    say_edge(&v->reason[k].first, edge);
    snprintf(text, sizeof text, "%s; first: %s", line_words(v->reason[k].kind),
             edge);
    terminal_wrap(stdout, used, 19, text);
  }
}

static json_t *line_json(const struct line_reason *r) {
  const struct hsr_edge_name *e = &r->first;
  json_t *first =
      e->implied
          ? json_pack("{s:[I,I,I]}", "implied", (json_int_t)e->a,
                      (json_int_t)e->b, (json_int_t)e->part)
          : json_pack("{s:[I,I]}", "edge", (json_int_t)e->a, (json_int_t)e->b);
  return json_pack("{s:s, s:s, s:I, s:o}", "kind", line_key(r->kind), "words",
                   line_words(r->kind), "edges", (json_int_t)r->edges, "first",
                   first);
}

enum hsr_status say_lines_json(const struct judged *judged,
                               const struct line_verdict *v, int m, int n,
                               struct hsr_error *err) {
  json_t *reasons = json_array();
  for (int k = 0; k < v->n_reasons; k++)
    hsr_json_append(&reasons, line_json(&v->reason[k]));
  json_t *all =
      json_pack("{s:s, s:s, s:s, s:I, s:[i,i], s:I, s:I, s:o}", "schema",
                "hsr-judge/1", "scene", judged->scene, "picture",
                judged->picture, "view", (json_int_t)judged->view, "size", m, n,
                "compared", (json_int_t)v->compared, "wrong",
                (json_int_t)v->differing, "reasons", reasons);
  if (!all)
    return hsr_fail_nomem(err);
  json_dumpf(all, stdout, JSON_INDENT(1));
  putchar('\n');
  json_decref(all);
  return HSR_OK;
}
