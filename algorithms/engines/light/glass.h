/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What algorithms need to draw transparent faces: the tints of the faces, and
 * for list-priority algorithms, the samples at which the list does not tell the
 * order.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", 1972, in the words of Sutherland et al.
 *             1974: "partial overwriting"; docs/transparent-picture.md.
 * Disputed    A list-priority algorithm puts faces over one another from back
 *             to front. Where faces are not flat they may have no place in its
 *             list, and the algorithm compares depths at the samples. An opaque
 *             face is then written or not. But a transparent one might belong
 *             between two that are already combined. Such a sample is disputed:
 *             at the end, all faces over it are sorted by depth and combined
 *             anew. These comparisons are counted as the algorithm's own
 *             comparisons in depth. */
#ifndef HSR_ALGORITHMS_GLASS_H
#define HSR_ALGORITHMS_GLASS_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_glass {
  const struct hsr_job *job;
  uint16_t *colours; /* of the answer */
  enum hsr_mix mix;
  struct hsr_tint *tint; /* a face of the job's world, if known */
  bool *known;
  struct hsr_tint background; /* where there is none */

  const struct hsr_screen *screen; /* if there may be disputes */
  bool *disputed;                  /* samples of the view's window, by rows */
  bool any_disputed;
  uint32_t *over; /* room for faces over a sample */
};

/* For a job of HSR_TRANSPARENT: writes the background. Memory is taken from
 * job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_glass_begin(struct hsr_glass *glass,
                                const struct hsr_job *job);

/* Makes room for disputes among the relevant faces of a screen, which is
 * borrowed. HSR_E_NOMEM. */
enum hsr_status hsr_glass_allow_disputes(struct hsr_glass *glass,
                                         const struct hsr_screen *screen);

static inline uint16_t *hsr_glass_at(const struct hsr_glass *glass, int i,
                                     int j) {
  size_t k = (size_t)j * (size_t)glass->job->view->m + (size_t)i;
  return glass->colours + 3 * k;
}

/* The tint of a face of the job's world, found when it is first asked for. */
const struct hsr_tint *hsr_glass_tint(struct hsr_glass *glass, uint32_t f);

static inline bool hsr_is_glass(struct hsr_glass *glass, uint32_t f) {
  return hsr_glass_tint(glass, f)->opacity < HSR_OPAQUE;
}

/* Puts face f over the colour there. */
static inline void hsr_glass_over(struct hsr_glass *glass, uint32_t f,
                                  uint16_t rgb[3]) {
  hsr_tint_over(hsr_glass_tint(glass, f), glass->mix, rgb);
}

/* What is behind all faces. */
static inline void hsr_glass_clear(const struct hsr_glass *glass,
                                   uint16_t rgb[3]) {
  for (int c = 0; c < 3; c++)
    rgb[c] = glass->background.rgb[c];
}

/* Shows a colour at the samples [x0, x1) of row j. */
static inline void hsr_glass_show(const struct hsr_glass *glass,
                                  const uint16_t rgb[3], int x0, int x1,
                                  int j) {
  for (int i = x0; i < x1; i++)
    for (int c = 0; c < 3; c++)
      hsr_glass_at(glass, i, j)[c] = rgb[c];
}

/* The samples [x0, x1) of row j are disputed. */
void hsr_glass_dispute(struct hsr_glass *glass, int x0, int x1, int j);

/* Settles the disputed samples. Steps of `compare` are comparisons in depth,
 * and steps of `accept` write a sample. */
void hsr_glass_settle(struct hsr_glass *glass, int compare, int accept);

#ifdef __cplusplus
}
#endif
#endif
