/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines joined into strokes, as a pen draws them: from one node to the next
 * without being lifted.
 *
 * Few         lines of one group that hang together are divided into as few
 *             strokes as there can be (Euler 1736): half as many as there are
 *             nodes with an odd number of lines, or one.
 * Straight    where several lines meet, those are joined that turn least, as
 *             far as the number of strokes allows.
 * Cost        O(n log n), and O(d^2) at a node of d lines. */
#ifndef HSR_COMMON_PAPER_STROKES_H
#define HSR_COMMON_PAPER_STROKES_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A line to be joined. */
struct hsr_pen_line {
  uint32_t group;    /* only lines of one group are joined */
  uint32_t from, to; /* nodes, which differ */
  uint32_t straight; /* lines of one number lie on one straight line */
};

struct hsr_stroke {
  uint32_t group;
  size_t first, n; /* its places: at[first] ... at[first + n - 1] */
  bool closed;     /* the last place is the first; it is not repeated */
};

struct hsr_strokes {
  struct hsr_stroke *stroke; /* by group; open ones first */
  size_t n;
  double (*at)[2];
  size_t n_at;
};

/* Joins n lines. node[] has the places of the nodes. A place in which a stroke
 * goes straight on, on one straight line, is left out. *strokes is written in
 * full, and is freed with hsr_strokes_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_strokes_join(struct hsr_strokes *strokes,
                                 const struct hsr_pen_line *line, size_t n,
                                 const double (*node)[2],
                                 struct hsr_error *err);
void hsr_strokes_free(struct hsr_strokes *strokes);

/* Brings the strokes of each group into an order in which the pen travels
 * little while it is up, from {0, 0} on: each time to the nearest end. A closed
 * stroke may begin at any of its places. HSR_E_NOMEM. */
enum hsr_status hsr_strokes_order(struct hsr_strokes *strokes,
                                  struct hsr_error *err);

/* How far the pen travels: down, and up between the strokes, from {0, 0} on. */
struct hsr_travel {
  double down, up;
};
struct hsr_travel hsr_strokes_travel(const struct hsr_strokes *strokes);

#ifdef __cplusplus
}
#endif
#endif
