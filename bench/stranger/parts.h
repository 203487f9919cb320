/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of bench/stranger/ that judge. */
#ifndef HSR_BENCH_STRANGER_PARTS_H
#define HSR_BENCH_STRANGER_PARTS_H

#include "bench/stranger/stranger.h"

/* The scene, ready to be drawn as anybody may have seen it. */
struct studio {
  const struct stranger_question *question;
  struct lib_scene *scene;
  const struct lib_scene *own;       /* the same with its own views; or NULL */
  const struct hsr_world *world;     /* laid out */
  const struct hsr_world *of_oracle; /* the world that suits the oracle */
  struct hsr_setup fast;             /* draws suppositions quickly */
  bool is_ready;
};

/* The scenes of a question; the first is held for reading until studio_close. To
 * be closed also after a failure. HSR_E_REFUSED if it cannot be laid out;
 * HSR_E_NOMEM. */
enum hsr_status studio_open(struct studio *studio,
                            const struct stranger_question *question,
                            struct hsr_error *err);
void studio_close(struct studio *studio);

/* Draw the ids of a view: by an algorithm that is quick, or by the oracle. The
 * caller frees *ids; NULL after a failure. HSR_E_NOMEM. */
enum hsr_status studio_draw(const struct studio *studio,
                            const struct hsr_view *view, uint32_t **ids,
                            struct hsr_error *err);
enum hsr_status studio_draw_right(const struct studio *studio,
                                  const struct hsr_view *view, uint32_t **ids,
                                  struct hsr_error *err);

/* Draws the ids at the corners of the pixels of a picture with a column and a row
 * less than the view: by the oracle if `right`. The view has at least two of
 * each, and no offset. Else as studio_draw. */
enum hsr_status studio_draw_corners(const struct studio *studio,
                                    const struct hsr_view *view, bool right,
                                    uint32_t **ids, struct hsr_error *err);

/* A picture, and the right one beside it, as they are supposed by now. */
struct supposed {
  int m, n;
  size_t all; /* m n */
  struct hsr_view view;
  bool to_borders; /* the outermost samples lie on the picture's border: the
                      view is rounded, `wanted` is exact */
  uint32_t *got, *wanted; /* owned */
  uint32_t
      *origin;   /* the sample of the picture that got[k] comes from; owned */
  uint64_t left; /* samples at which they differ */
};

/* How many samples differ. */
uint64_t count_differing(const uint32_t *a, const uint32_t *b, size_t n);

/* Whether one id is everywhere. */
bool is_uniform(const uint32_t *ids, size_t n);

/* Finds the faults of the picture as a whole, fills verdict->whole, and puts
 * them right in *now. Of a picture that is the same everywhere nothing is
 * supposed, since it is like any other that is nearly empty. HSR_E_NOMEM. */
enum hsr_status find_whole(const struct studio *studio, struct supposed *now,
                           struct stranger_verdict *verdict,
                           struct hsr_error *err);

/* Finds the kinds of the samples that differ: fills verdict->sample, and
 * verdict->kind there. *certain becomes the number of ties and backs. `verdict`
 * may be NULL. HSR_E_NOMEM. */
enum hsr_status find_samples(const struct studio *studio,
                             const struct supposed *now,
                             struct stranger_verdict *verdict,
                             uint64_t *certain, struct hsr_error *err);

#endif
