/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiling a scene that is not laid out: instance after instance, from the arrays
 * of its object.
 *
 * The tiler gets the vertices of the instance at hand, snapped, and the corner
 * numbers of its object. So beside the scene there are 16 bytes a vertex and one
 * a face, both of the largest object. A face that floats cannot decide is laid
 * out by itself (common/exact/alone.h), and so are two faces whose depths floats
 * cannot tell (common/exact/pair.h). */
#ifndef HSR_ALGORITHMS_STREAM_H
#define HSR_ALGORITHMS_STREAM_H

#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_stream {
  const struct hsr_world *scene; /* a roster; borrowed */
  struct hsr_world world;        /* the object at hand: its corner numbers and
                                    sides, and nothing else */
  bool *one_sided;               /* a face of the largest object */
  struct hsr_alone alone;
  struct hsr_pair pair;
};

/* Makes a tiler (hsr_tiler_begin) ready for the job's world, a roster whose
 * faces are made. *stream must not be moved, and lasts as long as the job's
 * scratch. HSR_E_NOMEM. */
enum hsr_status hsr_stream_begin(struct hsr_stream *stream,
                                 const struct hsr_job *job,
                                 struct hsr_tiler *tiler);

/* Makes instance i the one at hand; snaps its vertices if they are needed. Its
 * faces are 0 to n - 1 for the tiler. Returns n. */
uint32_t hsr_stream_instance(struct hsr_stream *stream, struct hsr_tiler *tiler,
                             uint32_t i, bool snap);

/* Tiles face f of the instance at hand the general way. */
void hsr_stream_tile_generally(struct hsr_stream *stream,
                               const struct hsr_tiler *tiler, uint32_t f);

#ifdef __cplusplus
}
#endif
#endif
