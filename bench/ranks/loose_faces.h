/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces by themselves, with the scene's ids: what ranks send to one another so
 * that each can compare what it sees with what others see. The corners are the
 * doubles of the world, so the planes are exact. */
#ifndef HSR_BENCH_RANKS_LOOSE_FACES_H
#define HSR_BENCH_RANKS_LOOSE_FACES_H

#include "common/scene/world.h"

struct loose_faces {
  uint32_t n;
  size_t n_corners;
  uint32_t *id;   /* ascending, all different */
  uint32_t *size; /* corners */
  float *rgb;     /* 3 n */
  double *xyz;    /* 3 n_corners */
};
void loose_faces_free(struct loose_faces *faces); /* it is empty then */

/* Makes in *out the faces that are seen at n samples of a picture of a part. The
 * picture has the numbers that faces have in `world`; `first` makes ids of
 * them. HSR_E_NOMEM. */
enum hsr_status loose_faces_seen(struct loose_faces *out,
                                 const struct hsr_world *world, uint32_t first,
                                 const uint32_t *picture, size_t n);

/* Makes in *out those of `faces` that are seen in a picture, by ids, of n
 * samples; and those of a or b. HSR_E_NOMEM. */
enum hsr_status loose_faces_select(struct loose_faces *out,
                                   const struct loose_faces *faces,
                                   const uint32_t *picture, size_t n);
enum hsr_status loose_faces_unite(struct loose_faces *out,
                                  const struct loose_faces *a,
                                  const struct loose_faces *b);

/* The place of an id, which is there. */
uint32_t loose_faces_find(const struct loose_faces *faces, uint32_t id);

/* Their size in bytes; copies them there; and makes them of what was copied.
 * HSR_E_NOMEM. */
size_t loose_faces_bytes(const struct loose_faces *faces);
void loose_faces_pack(const struct loose_faces *faces, void *bytes);
enum hsr_status loose_faces_unpack(struct loose_faces *out, const void *bytes);

/* Makes a scene of one object, and its world: face k is the k-th. Both are the
 * caller's, also after a failure. HSR_E_NOMEM. */
enum hsr_status loose_faces_lay_out(const struct loose_faces *faces,
                                    const char *name, struct hsr_scene **scene,
                                    struct hsr_world *world,
                                    struct hsr_error *err);

#endif
