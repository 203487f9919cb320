/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An X-ray picture: all splats are added, in any order.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 1.2.4.1: a
 *             projection that is a plain sum is both faster and more exact by
 *             splatting than by casting rays.
 * Sums        of 32 bits, which are moved into sums of 64 bits before they can
 *             overflow
 *
 * Notation, invariant, ties, departures and cost are those of splats.h. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"

enum { MOST_SPLATS = 65536 };

struct model {
  struct hsr_splat_picture picture; /* since the last move */
  uint64_t (*all)[4];
  int drawn; /* since the last move */
};

static enum hsr_status open(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  if (hsr_splats_open_sums(s, tile, &m->picture))
    return HSR_E_NOMEM;
  m->all = hsr_arena_zeroed(s->job->scratch, m->picture.count, sizeof *m->all);
  return m->all ? HSR_OK : HSR_E_NOMEM;
}

static void move_sums(struct model *m) {
  uint32_t *sum = m->picture.sum[0];
  uint64_t *all = m->all[0];
  for (size_t k = 0; k < 4 * m->picture.count; k++) {
    all[k] += sum[k];
    sum[k] = 0;
  }
  m->drawn = 0;
}

static void draw(struct hsr_splats *s, struct hsr_splat_tile *tile,
                 const struct hsr_placed *p) {
  struct model *m = tile->model;
  hsr_splats_put(s, p, &m->picture, HSR_PUT_SUM);
  if (++m->drawn == MOST_SPLATS)
    move_sums(m);
}

/* Adds what was drawn to the sums of an answer that is made of parts. */
static void add_to(uint64_t *sums, struct hsr_splats *s,
                   const struct model *m) {
  const struct hsr_window *w = m->picture.window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      size_t at = hsr_splats_at(&m->picture, i, j);
      uint64_t *sum =
          sums + HSR_SPLAT_SUMS * ((size_t)j * (size_t)s->view->m + (size_t)i);
      for (int c = 0; c <= HSR_SPLAT_OPACITY; c++)
        sum[c] += m->all[at][c];
      if (m->picture.weight)
        sum[HSR_SPLAT_WEIGHT] += m->picture.weight[at];
    }
}

static void finish(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  const struct hsr_window *w = &tile->window;
  uint64_t *sums = hsr_answer_splat_sums_of(s->job->answer);
  move_sums(m);
  if (sums) {
    add_to(sums, s, m);
    return;
  }
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint64_t E[HSR_SPLAT_CHANNELS] = {0};
      size_t at = hsr_splats_at(&m->picture, i, j);
      for (int c = 0; c <= HSR_SPLAT_OPACITY; c++)
        E[c] = s->splatting.normalise
                   ? m->all[at][c]
                   : hsr_splat_exposed(m->all[at][c], s->splatting.exposure);
      if (s->splatting.normalise)
        E[HSR_SPLAT_WEIGHT] = m->picture.weight[at];
      hsr_splats_write(s, i, j, E);
    }
}

static const struct hsr_splats_module how = {
    .size = sizeof(struct model), .open = open, .draw = draw};

static enum hsr_status draw_frame(const struct hsr_job *job,
                                  struct hsr_error *err) {
  struct hsr_splats s;
  if (hsr_splats_begin(&s, job) || hsr_splats_divide(&s, &how))
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_splats_visit(&s, HSR_PBTF, 0, false, err);
  hsr_splats_each(&s, finish);
  return status;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_splats_accumulate(job, draw_frame, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_splats_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"for each row of samples; is its box out of the window? leave it",
     HSR_RAISES(HSR_SPLAT_ROWS)},
    {"  for each sample of it that is kept", HSR_RAISES(HSR_SPLAT_CELLS)},
    {"      find its footprint; is it out of sight? leave it",
     HSR_RAISES(HSR_SPLAT_SPLATS)},
    {"    for each pixel of the footprint, add weight times colour",
     HSR_RAISES(HSR_SPLAT_UPDATES)},
    {"write the pixels that are not empty", HSR_RAISES(HSR_SPLAT_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(splat_xray) = {
    .name = "splat-xray",
    .title = "Splatting of an X-ray picture",
    .authors = "L. Westover; J. E. Swan II",
    .year = 1990,
    .source = "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH "
              "1990; Swan, Object-Order Rendering of Discrete Objects, PhD "
              "thesis, Ohio State University, 1998",
    .taxonomy = HSR_VOLUME_SPACE,
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_XRAY, .how = HSR_SUMS}},
    .flags = HSR_INSTANCED | HSR_OWN_TILES,
    .parts = uses,
    .outline = outline,
    .render = render};
