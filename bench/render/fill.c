/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces under a line drawing: a second algorithm draws them, of the same view. */
#include "bench/programs/module.h"
#include "bench/render/render.h"
#include "bench/run/crew.h"
#include "common/answers/kinds/polygons.h"

/* The algorithm of --fill. It must draw visible polygons. */
static enum hsr_status choose(const struct render_options *o,
                              struct hsr_variant *variant,
                              struct hsr_error *err) {
  enum hsr_status status = program_variant_parse(o->fill, variant, err);
  if (!status && variant->choice.form.type != &hsr_answer_polygons)
    status = hsr_fail(err, HSR_E_USAGE,
                      "--fill=%s: draws %s, not visible polygons; "
                      "weiler-atherton draws them",
                      variant->name, variant->choice.form.type->draws);
  return status;
}

static enum hsr_status prepare(struct render *r, struct hsr_error *err) {
  struct hsr_variant variant;
  enum hsr_status status = choose(r->options, &variant, err);
  return status ? status
                : hsr_setup_init(&r->fill_setup, variant.listed->plain,
                                 &variant.choice, &r->world, err);
}

enum hsr_status draw_fill(struct render *r, struct hsr_error *err) {
  struct hsr_tally tally = {.work = NULL};
  enum hsr_status status = r->fill_setup.algorithm ? HSR_OK : prepare(r, err);
  hsr_answer_free(&r->fill);
  if (!status)
    status = answer_init(&r->fill, &r->fill_setup, &r->view, err);
  return status ? status
                : crew_render(r->crew, &r->fill_setup, &r->view, &r->fill,
                              &tally, err);
}

void forget_fill(struct render *r) {
  hsr_answer_free(&r->fill);
  if (r->fill_setup.algorithm)
    hsr_setup_free(&r->fill_setup);
  r->fill_setup = (struct hsr_setup){.algorithm = NULL};
}
