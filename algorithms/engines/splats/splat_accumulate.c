/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion blur by an accumulation buffer: the mean of frames. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"
#include "common/base/arena_mark.h"
#include "common/view/path.h"

enum { CHANNELS = HSR_SPLAT_OPACITY + 1 };

struct buffer {
  const struct hsr_job *job;
  int frame, frames;         /* the present one, from 0; all */
  uint32_t (*sum)[CHANNELS]; /* of the pixels of the window, row after row */
};

/* --- Progress ------------------------------------------------------------- */

static bool tell(void *whom, double share) {
  const struct buffer *b = whom;
  const struct hsr_watch *watch = b->job->watch;
  return watch->tell(watch->whom, (b->frame + share) / b->frames);
}

/* --- Pixels --------------------------------------------------------------- */

static uint16_t *pixel_at(const struct hsr_job *job, int i, int j) {
  return hsr_answer_rgba_of(job->answer) +
         CHANNELS * ((size_t)j * (size_t)job->view->m + (size_t)i);
}

static void add_frame(const struct buffer *b) {
  const struct hsr_window *w = &b->job->view->window;
  uint32_t(*sum)[CHANNELS] = b->sum;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++, sum++)
      for (int c = 0; c < CHANNELS; c++)
        (*sum)[c] += pixel_at(b->job, i, j)[c];
}

/* A pixel that is empty in the mean may have been written in a frame. So it is
 * written once more. */
static void take_mean(const struct buffer *b) {
  const struct hsr_window *w = &b->job->view->window;
  uint32_t(*sum)[CHANNELS] = b->sum;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++, sum++) {
      uint16_t *rgba = pixel_at(b->job, i, j);
      bool any = false;
      for (int c = 0; c < CHANNELS; c++) {
        rgba[c] = (uint16_t)((*sum)[c] / (uint32_t)b->frames);
        any |= (*sum)[c] > 0;
      }
      if (any)
        HSR_ACCEPTED(b->job->tally, HSR_SPLAT_WRITES, HSR_NOTHING,
                     HSR_THE_WINDOW, HSR_AT(i, j), rgba);
    }
}

/* --- Frames --------------------------------------------------------------- */

static enum hsr_status add_frames(struct buffer *b, hsr_splats_frame *frame,
                                  struct hsr_error *err) {
  const struct hsr_job *job = b->job;
  const struct hsr_watch watch = {tell, b};
  const struct hsr_arena_mark mark = hsr_arena_mark(job->scratch);
  struct hsr_view view;
  struct hsr_job one = *job;
  one.view = &view;
  one.watch = job->watch ? &watch : NULL;
  enum hsr_status status = HSR_OK;
  for (b->frame = 0; b->frame < b->frames && !status; b->frame++) {
    hsr_arena_return(job->scratch, &mark);
    status = hsr_view_between(job->view, b->frame, b->frames - 1, &view, err);
    if (!status)
      status = frame(&one, err);
    add_frame(b);
  }
  return status;
}

enum hsr_status hsr_splats_accumulate(const struct hsr_job *job,
                                      hsr_splats_frame *frame,
                                      struct hsr_error *err) {
  const struct hsr_splatting how = hsr_form_splatting(&job->answer->form);
  if (how.blur != HSR_BLUR_ACCUMULATE || !hsr_view_has_path(job->view))
    return frame(job, err);
  const struct hsr_window *w = &job->view->window;
  size_t n = (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0);
  struct buffer b = {.job = job, .frames = how.frames};
  b.sum = hsr_arena_zeroed(job->scratch, n, sizeof *b.sum);
  if (!b.sum)
    return hsr_fail_nomem(err);
  enum hsr_status status = add_frames(&b, frame, err);
  if (!status)
    take_mean(&b);
  return status;
}
