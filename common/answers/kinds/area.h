/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "area": intervals that hold the area integrals of the picture
 * (docs/area-picture.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_AREA_H
#define HSR_COMMON_ANSWERS_KINDS_AREA_H

#include "common/answers/answer.h"
#include "common/answers/shader.h"
#include "common/base/option.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_AREAS (&hsr_answer_area)

/* The filters, B-splines of degree 0 to 3. */
enum hsr_area_filter {
  HSR_AREA_BOX,
  HSR_AREA_TENT,
  HSR_AREA_QUADRATIC,
  HSR_AREA_CUBIC
};
extern const struct hsr_word hsr_area_filters[]; /* their names, by number */

/* What is asked for. */
struct hsr_area_form {
  enum hsr_area_filter filter;
  double eps; /* the greatest width of an interval */
  enum hsr_shader shader;
  double side; /* of the shader's squares */
};

/* An interval that claims to hold the value of a pixel in a channel. Nothing is
 * written where lo > hi. */
struct hsr_area_bounds {
  double lo, hi;
};

/* The 3 m n intervals of an answer: red, green and blue of each pixel, by rows.
 * They are the answer's own. NULL if it is of another kind. */
struct hsr_area_bounds *hsr_answer_areas_of(const struct hsr_answer *answer);

/* For a form of this kind: what is asked for. */
struct hsr_area_form hsr_form_area(const struct hsr_form *form);

#ifdef __cplusplus
}
#endif
#endif
