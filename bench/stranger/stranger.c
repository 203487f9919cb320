/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/stranger/parts.h"
#include "common/answers/kinds/ids.h"

#include <stdlib.h>
#include <string.h>

const struct stranger_kind_info stranger_kinds[STRANGER_KINDS] = {
#define HSR_SAMPLE(id, key, words, rgb, colour) {key, words, rgb, colour},
#include "bench/stranger/kinds.def"
#undef HSR_SAMPLE
#undef HSR_WHOLE
};

void stranger_free(struct stranger_verdict *verdict) {
  free(verdict->kind);
  verdict->kind = NULL;
}

static void free_supposed(struct supposed *s) {
  free(s->got);
  free(s->wanted);
  free(s->origin);
}

/* What is there, and what is right, before anything is supposed. */
static enum hsr_status begin(const struct studio *studio,
                             const struct hsr_view *view, const uint32_t *ids,
                             struct supposed *now, struct hsr_error *err) {
  now->m = view->m;
  now->n = view->n;
  now->all = (size_t)view->m * (size_t)view->n;
  now->view = *view;
  now->got = malloc(now->all * sizeof *now->got);
  now->origin = malloc(now->all * sizeof *now->origin);
  if (!now->got || !now->origin)
    return hsr_fail_nomem(err);
  memcpy(now->got, ids, now->all * sizeof *ids);
  for (size_t k = 0; k < now->all; k++)
    now->origin[k] = (uint32_t)k;
  enum hsr_status status = studio_draw(studio, view, &now->wanted, err);
  if (!status)
    now->left = count_differing(now->got, now->wanted, now->all);
  return status;
}

/* Whether the picture drawn quickly differs where the judge says. */
static enum hsr_status check(const struct supposed *now, const uint32_t *place,
                             const struct hsr_verdict *judged,
                             struct hsr_error *err) {
  bool same = now->left == judged->differing;
  for (size_t k = 0; same && k < judged->n_places; k++)
    same = now->got[place[k]] != now->wanted[place[k]];
  return same ? HSR_OK
              : hsr_fail(err, HSR_E_INTERNAL,
                         "the judge and the algorithm that looks for reasons "
                         "do not agree: %llu and %llu samples",
                         (unsigned long long)judged->differing,
                         (unsigned long long)now->left);
}

/* Samples that were wrong and are explained get the kind of what explains
 * them. */
static void mark_whole(struct stranger_verdict *v, const uint32_t *place) {
  for (size_t k = 0; v->n_whole && k < v->differing; k++)
    if (!v->kind[place[k]])
      v->kind[place[k]] = (unsigned char)(1 + v->whole[0].kind);
}

static enum hsr_status find_reasons(const struct studio *studio,
                                    struct supposed *now, const uint32_t *place,
                                    struct stranger_verdict *verdict,
                                    struct hsr_error *err) {
  uint64_t certain;
  enum hsr_status status = find_whole(studio, now, verdict, err);
  verdict->left = now->left;
  if (!status && now->left)
    status = find_samples(studio, now, verdict, &certain, err);
  if (!status)
    mark_whole(verdict, place);
  return status;
}

/* Looks for reasons. A scene that cannot be laid out has none. */
static enum hsr_status
explain(const struct stranger_question *question, const struct hsr_view *view,
        const uint32_t *place, const struct hsr_verdict *judged,
        struct stranger_verdict *verdict, struct hsr_error *err) {
  struct studio studio;
  struct supposed now = {.got = NULL};
  enum hsr_status status = studio_open(&studio, question, err);
  if (status == HSR_E_REFUSED) {
    memcpy(verdict->no_reasons, err->text, sizeof verdict->no_reasons);
    studio_close(&studio);
    return HSR_OK;
  }
  if (!status)
    status = begin(&studio, view, question->ids, &now, err);
  if (!status)
    status = check(&now, place, judged, err);
  if (!status)
    status = find_reasons(&studio, &now, place, verdict, err);
  free_supposed(&now);
  studio_close(&studio);
  return status;
}

static void find_box(struct stranger_verdict *v, const uint32_t *place) {
  int *box = v->box;
  box[0] = v->m;
  box[1] = v->n;
  for (size_t k = 0; k < v->differing; k++) {
    int i = (int)(place[k] % (uint32_t)v->m),
        j = (int)(place[k] / (uint32_t)v->m);
    box[0] = i < box[0] ? i : box[0];
    box[1] = j < box[1] ? j : box[1];
    box[2] = i >= box[2] ? i + 1 : box[2];
    box[3] = j >= box[3] ? j + 1 : box[3];
  }
}

static enum hsr_status judge(const struct stranger_question *question,
                             uint32_t *place, struct stranger_verdict *verdict,
                             struct hsr_error *err) {
  struct hsr_view view;
  struct hsr_error why = {.text = ""};
  struct hsr_verdict judged = {.size = sizeof judged,
                               .place = place,
                               .room = (size_t)verdict->m * (size_t)verdict->n};
  enum hsr_status status = hsr_judge_ids(question->scene, question->request,
                                         question->ids, &judged, &why);
  verdict->compared = judged.compared;
  verdict->differing = judged.differing;
  memcpy(verdict->first, judged.first, sizeof verdict->first);
  if (!status && judged.differing) {
    find_box(verdict, place);
    status = lib_view(question->scene, question->request, &hsr_answer_ids,
                      &view, &why);
    if (!status)
      status = explain(question, &view, place, &judged, verdict, &why);
  }
  return status ? hsr_fail(err, status, "%s", why.text) : HSR_OK;
}

enum hsr_status stranger_judge(const struct stranger_question *question,
                               struct stranger_verdict *verdict,
                               struct hsr_error *err) {
  const struct hsr_request *request = question->request;
  const size_t n = (size_t)request->m * (size_t)request->n;
  *verdict = (struct stranger_verdict){.m = request->m, .n = request->n};
  uint32_t *place = malloc(n * sizeof *place);
  verdict->kind = calloc(n, sizeof *verdict->kind);
  enum hsr_status status = place && verdict->kind
                               ? judge(question, place, verdict, err)
                               : hsr_fail_nomem(err);
  free(place);
  return status;
}
