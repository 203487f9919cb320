/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "transparent": the faces over each sample, folded from back
 * to front (docs/transparent-picture.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_TRANSPARENT_H
#define HSR_COMMON_ANSWERS_KINDS_TRANSPARENT_H

#include "common/answers/answer.h"
#include "common/scene/world.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_TRANSPARENT (&hsr_answer_transparent)

/* How a transparent face is put over what is behind it. */
enum hsr_mix {
  HSR_MIX_LINEAR, /* they are combined */
  HSR_MIX_NEWELL  /* the face takes its place where it is brighter */
};

/* A face as a transparent picture sees it: one colour, linear, and an opacity,
 * all of 65535. */
struct hsr_tint {
  uint16_t rgb[3], opacity;
};
enum { HSR_OPAQUE = 65535 };

/* That of a face by its id in the scene, or of HSR_BACKGROUND, which is opaque.
 * The world may be laid out or not. */
struct hsr_tint hsr_tint_of(const struct hsr_world *world,
                            const struct hsr_view *view, uint32_t id);

/* Puts a face over a colour, which becomes that of both. */
static inline void hsr_tint_over(const struct hsr_tint *face, enum hsr_mix mix,
                                 uint16_t under[3]) {
  uint32_t opacity = face->opacity;
  bool brighter = face->rgb[0] + face->rgb[1] + face->rgb[2] >
                  under[0] + under[1] + under[2];
  if (mix == HSR_MIX_NEWELL && brighter)
    opacity = HSR_OPAQUE;
  for (int c = 0; c < 3; c++)
    under[c] = (uint16_t)((opacity * face->rgb[c] +
                           (HSR_OPAQUE - opacity) * under[c] + 32767) /
                          65535);
}

/* The 3 m n channels of an answer: linear red, green and blue of each sample, by
 * rows; 65535 is 1. They are the answer's own. NULL if it is of another kind. */
uint16_t *hsr_answer_colours_of(const struct hsr_answer *answer);

/* For a form of this kind: how a face is put over what is behind it. */
enum hsr_mix hsr_form_mix(const struct hsr_form *form);

#ifdef __cplusplus
}
#endif
#endif
