/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sort-last: a picture that is put together from pictures of the parts of a
 * scene (common/scene/part.h).
 *
 * Source      Molnar, Cox, Ellsworth and Fuchs 1994, "A Sorting Classification
 *             of Parallel Rendering"; Ma, Painter, Hansen and Krogh 1994,
 *             "Parallel Volume Rendering Using Binary-Swap Compositing".
 * Exact       where two pictures show different faces at a sample, the nearer
 *             one is kept, by the services of common/exact/screen.h on the
 *             faces' own planes; of coplanar ones that of the lower id. Depths
 *             are not sent: with its samples a rank sends the corners of the
 *             faces that are seen in them.
 * Invariant   `faces` holds all faces of `ids`.
 * Cost        of a swap: 8 bytes for each sample that is covered, and for each
 *             face 20 bytes and 24 a corner. In log2 R rounds a rank sends
 *             half, a quarter, ... of its picture. */
#ifndef HSR_BENCH_RANKS_COMPOSITE_H
#define HSR_BENCH_RANKS_COMPOSITE_H

#include "bench/ranks/loose_faces.h"
#include "common/view/view.h"

struct composite {
  struct hsr_view view;
  uint32_t *ids;            /* m * n, the scene's */
  struct loose_faces faces; /* at least those that are seen */
  double bytes, messages;   /* sent by this rank */
  double compared; /* samples at which this rank had two faces to compare */
};

/* An empty picture, to be freed also after a failure. HSR_E_NOMEM. */
enum hsr_status composite_init(struct composite *composite,
                               const struct hsr_view *view,
                               struct hsr_error *err);
void composite_free(struct composite *composite);

/* Adds the picture of a part: by the numbers of its faces, whose ids begin at
 * `first`. HSR_E_NOMEM. */
enum hsr_status composite_add(struct composite *composite,
                              const struct hsr_world *world, uint32_t first,
                              const uint32_t *picture, struct hsr_error *err);

/* Puts the pictures of all ranks together in rank 0, by binary swap; what others
 * have is meaningless then. All ranks call it. HSR_E_NOMEM. */
enum hsr_status composite_gather(struct composite *composite,
                                 struct hsr_error *err);

/* Makes a scene and a world of the faces that the picture shows, as
 * loose_faces_lay_out does, and writes the picture to *ids, m * n, by their
 * numbers there. HSR_E_NOMEM. */
enum hsr_status composite_lay_out(const struct composite *composite,
                                  const char *name, struct hsr_scene **scene,
                                  struct hsr_world *world, uint32_t *ids,
                                  struct hsr_error *err);

/* Sends faces of other ranks to rank 0, whose *faces become those of all. All
 * ranks call it. HSR_E_NOMEM. */
enum hsr_status composite_gather_faces(struct loose_faces *faces,
                                       struct hsr_error *err);

#endif
