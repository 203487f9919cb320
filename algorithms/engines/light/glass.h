/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What algorithms need to draw transparent faces, here called glass: the tints
 * of the faces; and for list-priority algorithms, the samples at which the list
 * does not tell the order.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", 1972, in the words of Sutherland et al.
 *             1974: "partial overwriting"; docs/transparent-picture.md.
 * Disputed    A list-priority algorithm paints faces over one another from back
 *             to front. A face that is not flat may have no place in its list;
 *             then the algorithm compares depths at the samples. That suffices
 *             for an opaque face. But a transparent one may belong between two
 *             faces that are already combined. Such a sample is disputed: at
 *             the end, all faces over it are sorted by depth and combined anew.
 *             These comparisons count as the algorithm's own comparisons in
 *             depth. */
#ifndef HSR_ALGORITHMS_GLASS_H
#define HSR_ALGORITHMS_GLASS_H

#include "algorithms/algorithm.h"
#include "common/answers/kinds/transparent.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_glass {
  const struct hsr_job *job;
  uint16_t *colours; /* of the answer: three a sample, by rows of the picture */
  enum hsr_mix mix;
  struct hsr_tint *tint; /* by face of the job's world, */
  bool *known;           /* where it has been found */
  struct hsr_tint background;

  /* If disputes are allowed for; else NULL. */
  const struct hsr_screen *screen;
  bool *disputed; /* by sample of the view's window, row by row */
  bool any_disputed;
  uint32_t *over; /* room for the faces over a sample */
};

/* Begins a frame of a job that asks for HSR_TRANSPARENT: writes the background
 * to the window. The job is borrowed as long as *glass; memory is taken from
 * job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_glass_begin(struct hsr_glass *glass,
                                const struct hsr_job *job);

/* Allows for disputes among the relevant faces of a screen, which is borrowed
 * as long as *glass. HSR_E_NOMEM. */
enum hsr_status hsr_glass_allow_disputes(struct hsr_glass *glass,
                                         const struct hsr_screen *screen);

/* The three colours of sample (i, j). */
static inline uint16_t *hsr_glass_at(const struct hsr_glass *glass, int i,
                                     int j) {
  size_t k = (size_t)j * (size_t)glass->job->view->m + (size_t)i;
  return glass->colours + 3 * k;
}

/* The tint of a face of the job's world; it is computed when it is first
 * needed. Valid as long as *glass. */
const struct hsr_tint *hsr_glass_tint(struct hsr_glass *glass, uint32_t f);

/* Is face f transparent? */
static inline bool hsr_is_glass(struct hsr_glass *glass, uint32_t f) {
  return hsr_glass_tint(glass, f)->opacity < HSR_OPAQUE;
}

/* Combines face f with the colour behind it, rgb, which becomes the result. */
static inline void hsr_glass_over(struct hsr_glass *glass, uint32_t f,
                                  uint16_t rgb[3]) {
  hsr_tint_over(hsr_glass_tint(glass, f), glass->mix, rgb);
}

/* Sets rgb to the background. */
static inline void hsr_glass_clear(const struct hsr_glass *glass,
                                   uint16_t rgb[3]) {
  for (int c = 0; c < 3; c++)
    rgb[c] = glass->background.rgb[c];
}

/* Writes a colour to the samples [x0, x1) of row j. */
static inline void hsr_glass_show(const struct hsr_glass *glass,
                                  const uint16_t rgb[3], int x0, int x1,
                                  int j) {
  for (int i = x0; i < x1; i++)
    for (int c = 0; c < 3; c++)
      hsr_glass_at(glass, i, j)[c] = rgb[c];
}

/* Marks the samples [x0, x1) of row j as disputed. */
void hsr_glass_dispute(struct hsr_glass *glass, int x0, int x1, int j);

/* Settles all disputed samples. A comparison in depth is a step of the counter
 * `compare`, a sample that is written one of `accept`. */
void hsr_glass_settle(struct hsr_glass *glass, int compare, int accept);

#ifdef __cplusplus
}
#endif
#endif
