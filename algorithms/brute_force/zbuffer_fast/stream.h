/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiling a scene that is not laid out (a roster): instance after instance, from
 * the arrays of its object.
 *
 * The tiler gets the snapped vertices of one instance at a time, the current
 * one, and the corner numbers of its object. So besides the scene there are 16
 * bytes a vertex and one a face, of the largest object only. A face that floats
 * cannot decide is laid out by itself (common/exact/alone.h); so are two faces
 * whose depths floats cannot tell apart (common/exact/pair.h). */
#ifndef HSR_ALGORITHMS_STREAM_H
#define HSR_ALGORITHMS_STREAM_H

#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_stream {
  const struct hsr_world *scene; /* a roster; borrowed */
  struct hsr_world world;        /* of the current instance's object: its corner
                                    numbers and sides, nothing else */
  bool *one_sided;               /* by face, for the largest object */
  struct hsr_alone alone;
  struct hsr_pair pair;
};

/* Makes a tiler, which hsr_tiler_begin has set, ready for the job's world: a
 * roster with faces. *stream must stay where it is while the tiler is used;
 * memory is taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_stream_begin(struct hsr_stream *stream,
                                 const struct hsr_job *job,
                                 struct hsr_tiler *tiler);

/* Makes instance i the current one, and snaps its vertices if `snap`. For the
 * tiler its faces are 0 to n - 1. Returns n. */
uint32_t hsr_stream_instance(struct hsr_stream *stream, struct hsr_tiler *tiler,
                             uint32_t i, bool snap);

/* Tiles face f of the current instance the general way. */
void hsr_stream_tile_generally(struct hsr_stream *stream,
                               const struct hsr_tiler *tiler, uint32_t f);

#ifdef __cplusplus
}
#endif
#endif
