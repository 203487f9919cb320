/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The area picture: docs/area-picture.md. */
#ifndef HSR_COMMON_ANSWERS_AREA_H
#define HSR_COMMON_ANSWERS_AREA_H

#include "common/answers/shader.h"
#include "common/base/option.h"

#ifdef __cplusplus
extern "C" {
#endif

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

#ifdef __cplusplus
}
#endif
#endif
