/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the judge found, for people, for programs, and as a picture. */
#ifndef HSR_BENCH_STRANGER_SAY_H
#define HSR_BENCH_STRANGER_SAY_H

#include "bench/stranger/lines.h"
#include "bench/stranger/stranger.h"

/* What was judged. All borrowed. */
struct judged {
  const char *scene, *picture;
  long view; /* from 1 */
  const struct stranger_verdict *verdict;
};

void say_text(const struct judged *judged, bool colours);

/* Prints one JSON object. HSR_E_NOMEM. */
enum hsr_status say_json(const struct judged *judged, struct hsr_error *err);

/* The same of line drawings of m x n pixels; judged->verdict is not used. */
void say_lines(const struct judged *judged, const struct line_verdict *verdict,
               int m, int n);
enum hsr_status say_lines_json(const struct judged *judged,
                               const struct line_verdict *verdict, int m, int n,
                               struct hsr_error *err);

/* Writes a picture of the kinds. Errors as hsr_image_write. */
enum hsr_status say_picture(const struct judged *judged, const char *path,
                            struct hsr_error *err);

#endif
