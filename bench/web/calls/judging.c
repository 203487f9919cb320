/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judge: answers beside the oracle's. */
#include "bench/web/web.h"
#include "common/files/json/json.h"

enum { MOST_PLACES = 10000 };

static uint32_t places[MOST_PLACES];

static struct hsr_verdict empty_verdict(void) {
  return (struct hsr_verdict){
      .size = sizeof(struct hsr_verdict), .place = places, .room = MOST_PLACES};
}

static json_t *places_json(const struct hsr_verdict *verdict) {
  json_t *all = json_array();
  for (size_t k = 0; k < verdict->n_places; k++)
    hsr_json_append(&all, json_integer((json_int_t)verdict->place[k]));
  return all;
}

static enum hsr_status end(enum hsr_status status,
                           const struct hsr_verdict *verdict) {
  if (status)
    return web_end(status, NULL);
  return web_end(HSR_OK,
                 json_pack("{sI sI ss so}", "compared",
                           (json_int_t)verdict->compared, "differing",
                           (json_int_t)verdict->differing, "first",
                           verdict->first, "places", places_json(verdict)));
}

/* The ids of anybody, n of them by rows. */
WEB_CALL enum hsr_status web_judge(const struct lib_scene *scene,
                                   const char *text, const uint32_t *ids,
                                   uint32_t n) {
  struct hsr_error *err = web_begin();
  struct hsr_verdict verdict = empty_verdict();
  struct web_request request;
  enum hsr_status status = web_request_read(&request, text, err);
  const struct hsr_request *r = &request.request;
  if (!status && (double)r->m * r->n != n)
    status =
        hsr_fail(err, HSR_E_USAGE, "%u ids are not %d x %d", n, r->m, r->n);
  if (!status)
    status = hsr_judge_ids(scene, r, ids, &verdict, err);
  web_request_free(&request);
  return end(status, &verdict);
}

/* What an algorithm draws, of any kind. */
WEB_CALL enum hsr_status web_judge_algorithm(const struct lib_scene *scene,
                                             const char *text) {
  struct hsr_error *err = web_begin();
  struct hsr_verdict verdict = empty_verdict();
  struct web_request request;
  struct lib_answer *answer = NULL;
  enum hsr_status status = web_request_read(&request, text, err);
  if (!status)
    status = hsr_draw(scene, &request.request, &answer, err);
  if (!status)
    status = hsr_judge(answer, &verdict, err);
  hsr_free(answer);
  web_request_free(&request);
  return end(status, &verdict);
}
