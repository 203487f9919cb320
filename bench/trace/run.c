/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/variant.h"
#include "bench/trace/trace.h"

/* An algorithm that takes instances gets a roster, as in hsr render. */
static enum hsr_status open_worlds(struct trace_run *r, struct hsr_error *err) {
  enum hsr_status status =
      hsr_world_open(&r->laid_out, r->scene, r->most_faces, err);
  if (status)
    return status;
  if (hsr_is_roster(&r->laid_out))
    return hsr_fail(err, HSR_E_REFUSED,
                    "%s: %u faces are more than the %u that a %s tells of",
                    r->command, r->laid_out.n_faces, r->most_faces, r->command);
  uint32_t most =
      hsr_most_laid_out(r->variant->listed->counting, &r->variant->choice);
  return r->laid_out.n_faces > most
             ? hsr_world_open(&r->instanced, r->scene, most, err)
             : HSR_OK;
}

enum hsr_status trace_run_begin(struct trace_run *r, struct hsr_error *err) {
  enum hsr_status status = open_worlds(r, err);
  if (!status)
    status = hsr_setup_init(
        &r->setup, r->variant->listed->counting, &r->variant->choice,
        r->instanced.roster.scene ? &r->instanced : &r->laid_out, err);
  if (!status)
    status = trace_answer_init(&r->answer, &r->setup, &r->view, err);
  return status;
}

void trace_run_end(struct trace_run *r) {
  trace_answer_free(&r->answer);
  if (r->setup.algorithm)
    hsr_setup_free(&r->setup);
  hsr_world_free(&r->instanced);
  hsr_world_free(&r->laid_out);
}

enum hsr_status trace_run_open(struct trace_run *r, struct hsr_error *err) {
  enum hsr_status status = open_scene(r->scene_options->name,
                                      r->scene_options->import, &r->scene, err);
  if (!status)
    status = choose_view(r->view_options, r->scene, 1, &r->view, err);
  return status ? status : trace_run_begin(r, err);
}

void trace_run_close(struct trace_run *r) {
  trace_run_end(r);
  hsr_scene_delete(r->scene);
}
