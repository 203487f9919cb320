/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exposure of an X-ray picture for which the user chose none. With that of 1,
 * which docs/composited-picture.md has as the standard, a head is all white. */
#include "bench/render/render.h"
#include "bench/ranks/ranks.h"
#include "bench/run/crew.h"
#include "common/answers/kinds/composited.h"

#include <math.h>
#include <string.h>

static const double FIRST = 1.0 / 64, STEP = 64, BRIGHTEST = .98;
enum { MOST_TRIES = 4, LEAST = 1024, MOST = 65535 };

/* What gives the brightest channel of a picture by its exposure. */
struct meter {
  enum hsr_status (*read)(void *of, double exposure, int *most,
                          struct hsr_error *err);
  void *of;
};

/* 1 if the picture is empty, or as good as that. */
static enum hsr_status find(const struct meter *meter, double *exposure,
                            struct hsr_error *err) {
  double first = FIRST;
  *exposure = 0;
  for (int k = 0; k < MOST_TRIES && *exposure == 0; k++) {
    int most = 0;
    enum hsr_status status = meter->read(meter->of, first, &most, err);
    if (status)
      return status;
    if (most < MOST && most >= LEAST)
      *exposure = fmin(first * BRIGHTEST * MOST / most, 1000);
    first *= most == MOST ? 1 / STEP : STEP;
  }
  *exposure = *exposure > 0 ? *exposure : 1;
  return HSR_OK;
}

static bool is_wanted(const struct render *r, const struct hsr_form *form) {
  return form->type == HSR_COMPOSITED &&
         hsr_form_splatting(form).model == HSR_XRAY &&
         !hsr_form_splatting(form).normalise &&
         !strstr(r->options->algorithm, "exposure=");
}

/* --- By pictures ---------------------------------------------------------- */

static int brightest(const struct hsr_answer *answer) {
  const uint16_t *rgba = hsr_answer_rgba_of(answer);
  int most = 0;
  for (size_t k = 0; k < 4 * (size_t)answer->m * (size_t)answer->n; k++)
    if (k % 4 != 3 && rgba[k] > most)
      most = rgba[k];
  return most;
}

static enum hsr_status draw_and_read(void *of, double exposure, int *most,
                                     struct hsr_error *err) {
  struct render *r = of;
  struct hsr_answer answer;
  struct hsr_tally tally = {.work = NULL};
  hsr_form_expose(&r->setup.choice.form, exposure);
  enum hsr_status status = answer_init(&answer, &r->setup, &r->view, err);
  if (!status)
    status = crew_render(r->crew, &r->setup, &r->view, &answer, &tally, err);
  if (!status)
    *most = ranks_own() ? 0 : brightest(&answer); /* it is whole in rank 0 */
  hsr_answer_free(&answer);
  if (!status && ranks_count() > 1)
    ranks_unite(most, sizeof *most);
  return status;
}

enum hsr_status choose_exposure(struct render *r, struct hsr_error *err) {
  if (!is_wanted(r, &r->setup.choice.form))
    return HSR_OK;
  enum hsr_status status = HSR_OK;
  if (r->exposure == 0)
    status = find(&(struct meter){draw_and_read, r}, &r->exposure, err);
  hsr_form_expose(&r->setup.choice.form, r->exposure);
  return status;
}

/* --- By sums -------------------------------------------------------------- */

static enum hsr_status read_sums(void *of, double exposure, int *most,
                                 struct hsr_error *err) {
  const struct hsr_answer *answer = of;
  const uint64_t *sum = hsr_answer_splat_sums_of(answer);
  uint64_t by = (uint64_t)lrint(65536 * exposure), all = 0;
  (void)err;
  for (size_t k = 0; k < (size_t)answer->m * (size_t)answer->n; k++)
    for (int c = 0; c < 3; c++)
      all = sum[HSR_SPLAT_SUMS * k + (size_t)c] > all
                ? sum[HSR_SPLAT_SUMS * k + (size_t)c]
                : all;
  all = hsr_splat_exposed(all, by);
  *most = all < MOST ? (int)all : MOST;
  return HSR_OK;
}

void expose_sums(struct render *r, struct hsr_answer *sums) {
  if (!is_wanted(r, &sums->form))
    return;
  (void)find(&(struct meter){read_sums, sums}, &r->exposure, NULL);
  hsr_form_expose(&sums->form, r->exposure);
}
