/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Subjects and points in JSON, as docs/schemas/trace.schema.json has them. */
#ifndef HSR_COMMON_ANSWERS_CODED_H
#define HSR_COMMON_ANSWERS_CODED_H

#include "common/base/count.h"
#include "common/files/json/json.h"
#include "common/view/view.h"

/* The meaning of each number of a subject: "face", ..., ended by NULL. */
enum { HSR_MOST_SUBJECT_IDS = 3 };
extern const char
    *const hsr_subject_ids[HSR_N_SUBJECT_KINDS][HSR_MOST_SUBJECT_IDS + 1];

/* All of these give a new reference, or NULL for lack of memory. */

/* Runs of one value: value, length, value, length ...; null for `none`. */
json_t *hsr_runs_json(const uint32_t *value, size_t n, uint32_t none);

/* n channels of 16 bits, one after the other. */
json_t *hsr_channels_json(const uint16_t *channel, size_t n);

/* [kind, ids...], or null if there is no subject. */
json_t *hsr_subject_json(struct hsr_subject subject);

/* Where a point of the world is on the screen, in samples: [x, y], to the
 * nearest 1/64; or null if it is not beyond the view's `near`. */
json_t *hsr_point_json(const struct hsr_view *view, const double point[3]);

/* [x, y] of an image from hsr_view_project, in samples, to the nearest 1/64; or
 * null if they are not finite. */
json_t *hsr_image_json(const struct hsr_view *view, const double image[3]);

#endif
