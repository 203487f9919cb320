/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing, and what was drawn. */
#include "bench/web/hash.h"
#include "bench/web/web.h"
#include "common/files/json/json.h"
#include "common/files/srgb.h"

#include <stdlib.h>
#include <string.h>

/* --- The answer as JSON --------------------------------------------------- */

/* As .png files have it: bench/web/core.js gives it to a canvas. */
static unsigned char byte_of(float encoded) {
  const float all = encoded * 255 + 0.5f;
  return (unsigned char)(all < 0 ? 0 : all > 255 ? 255 : all);
}

/* The picture, 4 bytes a pixel. NULL: the kind has no colours, or *err says what
 * is wrong. */
static unsigned char *paint(const struct lib_answer *answer, size_t n,
                            struct hsr_error *err) {
  float *rgb = malloc(3 * n * sizeof *rgb);
  unsigned char *rgba = malloc(4 * n);
  if (!rgb || !rgba)
    hsr_fail_nomem(err);
  else if (!hsr_get_colours(answer, HSR_COLOUR_LAMBERT, rgb, 3 * n, err))
    for (size_t k = 0; k < n; k++) {
      for (size_t c = 0; c < 3; c++)
        rgba[4 * k + c] = byte_of(hsr_srgb_encode(rgb[3 * k + c]));
      rgba[4 * k + 3] = 255;
    }
  free(rgb);
  if (err->status) {
    free(rgba);
    rgba = NULL;
  }
  if (err->status == HSR_E_USAGE) /* it has none */
    err->status = HSR_OK;
  return web_keep(rgba);
}

static json_t *vector_json(const double v[3]) {
  return json_pack("[fff]", v[0], v[1], v[2]);
}

static json_t *segment_json(const struct lib_segment *s) {
  return json_pack("{sb sI sI sI sI sf sf so so}", "isImplied", s->is_implied,
                   "a", (json_int_t)s->a, "b", (json_int_t)s->b, "part",
                   (json_int_t)s->part, "invisibility",
                   (json_int_t)s->invisibility, "t0", s->t0, "t1", s->t1,
                   "from", vector_json(s->from), "to", vector_json(s->to));
}

/* null: it is no line drawing. */
static json_t *segments_json(const struct lib_answer *answer) {
  const struct lib_segment *segment;
  size_t n;
  if (hsr_get_segments(answer, &segment, &n, NULL))
    return json_null();
  json_t *segments = json_array();
  for (size_t k = 0; k < n; k++)
    hsr_json_append(&segments, segment_json(&segment[k]));
  return segments;
}

/* null: it is no picture of polygons. Sizes have 32 bits here. */
static json_t *polygons_json(const struct lib_answer *answer) {
  struct hsr_polygon_arrays p = {.size = sizeof p};
  if (hsr_get_polygons(answer, &p, NULL))
    return json_null();
  return json_pack("{sI sI sI so so so so}", "nRegions",
                   (json_int_t)p.n_regions, "nCycles", (json_int_t)p.n_cycles,
                   "nPoints", (json_int_t)p.n_points, "face",
                   web_address(p.face), "cycle", web_address(p.cycle), "point",
                   web_address(p.point), "xy", web_address(p.xy));
}

/* null: they were not asked for. */
static json_t *counts_json(const struct lib_answer *answer) {
  const uint64_t *count;
  size_t n;
  if (hsr_get_counts(answer, &count, &n, NULL))
    return json_null();
  json_t *counts = json_array();
  for (size_t k = 0; k < n; k++)
    hsr_json_append(&counts, json_integer((json_int_t)count[k]));
  return counts;
}

static json_t *ids_json(const struct lib_answer *answer) {
  const uint32_t *ids;
  return web_address(hsr_get_ids(answer, &ids, NULL) ? NULL : ids);
}

static json_t *work_json(const struct lib_answer *answer) {
  const float *work;
  return web_address(hsr_get_work(answer, &work, NULL) ? NULL : work);
}

/* A line, or "". */
static void summarise(const struct lib_answer *answer, char *text,
                      size_t size) {
  *text = '\0';
  hsr_get_summary(answer, text, size, NULL);
}

static enum hsr_status answer_json(const struct lib_answer *answer,
                                   json_t **json, struct hsr_error *err) {
  struct hsr_answer_info info = {.size = sizeof info};
  char summary[300], hash[HASH_TEXT];
  hsr_get_answer(answer, &info, err);
  const unsigned char *rgba =
      paint(answer, (size_t)info.m * (size_t)info.n, err);
  if (err->status)
    return err->status;
  summarise(answer, summary, sizeof summary);
  hash_answer(answer, hash);
  *json = json_pack(
      "{ss si si s[iiii] so so so so so so s{sf sf sf} ss ss ss}", "kind",
      info.kind_name, "m", info.m, "n", info.n, "window", info.window[0],
      info.window[1], info.window[2], info.window[3], "ids", ids_json(answer),
      "rgba", web_address(rgba), "segments", segments_json(answer), "polygons",
      polygons_json(answer), "counts", counts_json(answer), "work",
      work_json(answer), "seconds", "adapt", info.adapt_seconds, "prepare",
      info.prepare_seconds, "draw", info.draw_seconds, "adapted", info.adapted,
      "summary", summary, "hash", hash);
  return *json ? HSR_OK : hsr_fail_nomem(err);
}

/* --- Calls ---------------------------------------------------------------- */

WEB_CALL enum hsr_status web_draw(const struct lib_scene *scene,
                                  const char *text) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  struct lib_answer *answer = NULL;
  json_t *json = NULL;
  enum hsr_status status = web_request_read(&request, text, err);
  if (!status)
    status = hsr_draw(scene, &request.request, &answer, err);
  if (!status)
    status = answer_json(answer, &json, err);
  web_request_free(&request);
  web_keep_answer(answer);
  return web_end(status, json);
}

/* A drawer, and its last answer, which is drawn over if the size is the same. */
struct web_drawer {
  struct hsr_drawer *drawer;
  struct lib_answer *answer;
  int m, n;
};

WEB_CALL enum hsr_status web_release(struct web_drawer *drawer) {
  web_begin();
  if (drawer) {
    hsr_free(drawer->answer);
    hsr_release(drawer->drawer);
  }
  free(drawer);
  return web_end(HSR_OK, json_true());
}

WEB_CALL enum hsr_status web_prepare(const struct lib_scene *scene,
                                     const char *text) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  struct web_drawer *made = calloc(1, sizeof *made);
  enum hsr_status status = made ? HSR_OK : hsr_fail_nomem(err);
  if (!status) {
    status = web_request_read(&request, text, err);
    if (!status)
      status = hsr_prepare(scene, &request.request, &made->drawer, err);
    web_request_free(&request);
  }
  if (status)
    free(made);
  return web_end(status, status ? NULL : web_address(made));
}

static enum hsr_status redraw(struct web_drawer *drawer,
                              const struct hsr_request *request,
                              struct hsr_error *err) {
  if (request->m != drawer->m || request->n != drawer->n) {
    hsr_free(drawer->answer);
    drawer->answer = NULL;
  }
  drawer->m = request->m;
  drawer->n = request->n;
  return hsr_redraw(drawer->drawer, request, &drawer->answer, err);
}

WEB_CALL enum hsr_status web_redraw(struct web_drawer *drawer,
                                    const char *text) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  json_t *json = NULL;
  enum hsr_status status = web_request_read(&request, text, err);
  if (!status)
    status = redraw(drawer, &request.request, err);
  if (!status)
    status = answer_json(drawer->answer, &json, err);
  web_request_free(&request);
  return web_end(status, json);
}
