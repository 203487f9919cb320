/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An answer while it becomes better: what hsr render writes after each pass. */
#include "bench/render/render.h"
#include "common/files/image.h"

#include <stdlib.h>

enum hsr_status check_passes(const struct render_options *o,
                             const struct hsr_variant *variant,
                             struct hsr_error *err) {
  const char *files[] = {o->passes, o->uncertainty};
  static const char *const option[] = {"--passes", "--uncertainty"};
  char name[MOST_FILE_NAME];
  for (int k = 0; k < 2; k++) {
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

static enum hsr_status write_colours(const struct render *r,
                                     const struct hsr_answer *answer,
                                     const char *name, struct hsr_error *err) {
  struct hsr_showing showing = showing_of(r);
  struct hsr_shaded shaded = {NULL, NULL};
  enum hsr_status status =
      answer->form.type->shade(answer, &showing, &shaded, err);
  if (!status)
    status = answer->form.type->write(answer, &showing, &shaded, name, err);
  hsr_shaded_free(&shaded);
  return status;
}

static enum hsr_status write_uncertainty(const struct hsr_answer *answer,
                                         const char *name,
                                         struct hsr_error *err) {
  float *share = malloc((size_t)answer->m * (size_t)answer->n * sizeof *share);
  if (!share)
    return hsr_fail_nomem(err);
  answer->form.type->uncertainty(answer, share);
  enum hsr_status status =
      hsr_image_write_ramp(name, answer->m, answer->n, share, err);
  free(share);
  return status;
}

void write_pass(void *whom, const struct hsr_answer *answer, int pass) {
  struct render *r = whom;
  const struct render_options *o = r->options;
  struct hsr_showing showing = showing_of(r);
  char name[MOST_FILE_NAME];
  double begin = seconds_now();
  printf("pass %d: ", pass);
  answer->form.type->print(answer, &showing, stdout);
  if (!r->pass_status && o->passes && series_name(o->passes, pass, name))
    r->pass_status = write_colours(r, answer, name, &r->pass_err);
  if (!r->pass_status && o->uncertainty &&
      series_name(o->uncertainty, pass, name))
    r->pass_status = write_uncertainty(answer, name, &r->pass_err);
  r->write += seconds_now() - begin;
  r->draw -= seconds_now() - begin;
}
