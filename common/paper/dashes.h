/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the dashes of a stroke lie.
 *
 * A dash runs on through the whole stroke. There is ink at both ends of a stroke
 * and at its corners (ISO 128-2:2020: lines meet at dashes). Between two
 * corners, dashes and gaps are stretched a little so that they come out even. No
 * stroke is solid because it is short: it has two dashes at least. */
#ifndef HSR_COMMON_PAPER_DASHES_H
#define HSR_COMMON_PAPER_DASHES_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A corner is a place where a stroke turns by so many degrees or more, and from
 * which it is not too near to the last. */
#define HSR_CORNER_DEGREES 30

struct hsr_dashes {
  double
      *length; /* of a dash, of a gap, of a dash ...; n of them, n odd but for
                     closed strokes without a corner */
  size_t n, room;
};

/* Finds the dashes of a stroke of n places. `dash` and `gap` are lengths in the
 * unit of the places. *dashes is all zero, or of an earlier call; it is freed by
 * hsr_dashes_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_dashes_find(struct hsr_dashes *dashes,
                                const double (*at)[2], size_t n, bool closed,
                                double dash, double gap, struct hsr_error *err);
void hsr_dashes_free(struct hsr_dashes *dashes);

/* Calls move(on, place) at the beginning of each dash, and line(on, place) for
 * each place to which it is drawn. */
void hsr_dashes_cut(const struct hsr_dashes *dashes, const double (*at)[2],
                    size_t n, bool closed, void *on,
                    void (*move)(void *on, const double place[2]),
                    void (*line)(void *on, const double place[2]));

#ifdef __cplusplus
}
#endif
#endif
