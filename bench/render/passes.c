/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An answer while it becomes better: what hsr render writes after each pass. */
#include "bench/modules/variant.h"
#include "bench/options/words.h"
#include "bench/render/render.h"
#include "common/base/clock.h"
#include "common/files/image.h"

#include <stdlib.h>

enum hsr_status check_passes(const struct render_options *o,
                             const struct hsr_variant *variant,
                             struct hsr_error *err) {
  const char *files[] = {o->passes, o->uncertainty, o->certain};
  static const char *const option[] = {"--passes", "--uncertainty",
                                       "--certain"};
  char name[MOST_FILE_NAME];
  for (int k = 0; k < 3; k++) {
    const struct hsr_answer_type *kind = variant->choice.form.type;
    if (!files[k])
      continue;
    if (!kind->uncertainty)
      return hsr_fail(err, HSR_E_USAGE, "%s is not for %s, which %s draws",
                      option[k], kind->draws, variant->name);
    if (o->threads > 1 || variant->choice.window || is_series(o))
      return hsr_fail(err, HSR_E_USAGE,
                      "%s is for one picture, on one thread, without windows",
                      option[k]);
    if (!series_name(files[k], 1, name))
      return hsr_fail(err, HSR_E_USAGE,
                      "%.200s: a name must have one %%d in the place of the "
                      "pass, as in p%%02d.png",
                      files[k]);
  }
  return HSR_OK;
}

/* How uncertain each pixel is: the caller frees it; NULL for lack of memory. */
static float *find_uncertainty(const struct hsr_answer *answer) {
  float *share = malloc((size_t)answer->m * (size_t)answer->n * sizeof *share);
  if (share)
    answer->form.type->uncertainty(answer, share);
  return share;
}

/* Makes what is too uncertain green. */
static void mark(float *rgb, const float *share, size_t n) {
  for (size_t k = 0; k < n; k++)
    if (share[k] > 1) {
      rgb[3 * k] = rgb[3 * k + 2] = 0;
      rgb[3 * k + 1] = 1;
    }
}

/* With `share`, what is too uncertain is marked. */
static enum hsr_status write_colours(const struct render *r,
                                     const struct hsr_answer *answer,
                                     const float *share, const char *name,
                                     struct hsr_error *err) {
  struct hsr_showing showing = showing_of(r);
  struct hsr_shaded shaded = {NULL, NULL};
  enum hsr_status status =
      answer->form.type->shade(answer, &showing, &shaded, err);
  if (!status && share)
    mark(shaded.rgb, share, (size_t)answer->m * (size_t)answer->n);
  if (!status)
    status = answer->form.type->write(answer, &showing, &shaded, name, err);
  hsr_shaded_free(&shaded);
  return status;
}

/* The map of what is uncertain, and the picture of what is not; `share` is
 * changed. */
static enum hsr_status write_maps(const struct render *r,
                                  const struct hsr_answer *answer, int pass,
                                  float *share, struct hsr_error *err) {
  const struct render_options *o = r->options;
  char name[MOST_FILE_NAME];
  enum hsr_status status = HSR_OK;
  if (o->certain && series_name(o->certain, pass, name))
    status = write_colours(r, answer, share, name, err);
  if (status || !o->uncertainty || !series_name(o->uncertainty, pass, name))
    return status;
  for (size_t k = 0; k < (size_t)answer->m * (size_t)answer->n; k++)
    share[k] = share[k] < 1 ? share[k] : 1;
  return hsr_image_write_ramp(name, answer->m, answer->n, share, err);
}

static enum hsr_status write_files(const struct render *r,
                                   const struct hsr_answer *answer, int pass,
                                   struct hsr_error *err) {
  const struct render_options *o = r->options;
  char name[MOST_FILE_NAME];
  if (o->passes && series_name(o->passes, pass, name)) {
    enum hsr_status status = write_colours(r, answer, NULL, name, err);
    if (status)
      return status;
  }
  if (!o->uncertainty && !o->certain)
    return HSR_OK;
  float *share = find_uncertainty(answer);
  enum hsr_status status =
      share ? write_maps(r, answer, pass, share, err) : hsr_fail_nomem(err);
  free(share);
  return status;
}

void write_pass(void *whom, const struct hsr_answer *answer, int pass) {
  struct render *r = whom;
  struct hsr_showing showing = showing_of(r);
  double begin = hsr_seconds_now();
  printf("pass %d: ", pass);
  answer->form.type->print(answer, &showing, stdout);
  if (!r->pass_status)
    r->pass_status = write_files(r, answer, pass, &r->pass_err);
  r->write += hsr_seconds_now() - begin;
  r->draw -= hsr_seconds_now() - begin;
}
