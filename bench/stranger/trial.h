/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Suppositions of what is wrong with a picture as a whole, tried one after the
 * other. */
#ifndef HSR_BENCH_STRANGER_TRIAL_H
#define HSR_BENCH_STRANGER_TRIAL_H

#include "bench/stranger/parts.h"

/* What is tried, and the best so far. */
struct trial {
  const struct studio *studio;
  const struct supposed *now;
  struct supposed best; /* its arrays: NULL where they are those of *now */
  struct stranger_reason reason;
  uint64_t left; /* what the best leaves wrong */
  struct hsr_error *err;
};

/* Takes a supposition if it is the best so far. Its arrays are taken over, or
 * freed; those that are NULL are as they are now. `words` NULL: those of the
 * kind. */
void try_this(struct trial *trial, struct supposed *supposed,
              enum stranger_kind kind, const char *words);

/* Frees the arrays of a supposition. */
void drop(struct supposed *supposed);

/* Room for the ids of the picture; NULL: memory ran out. */
uint32_t *new_ids(const struct trial *trial);

/* Each of these tries suppositions of its kind. HSR_E_NOMEM. */

/* Rows or columns the other way, or exchanged. */
enum hsr_status try_turns(struct trial *trial);

/* Other numbers of the faces, or of no face; those of triangles, which are cut as
 * fans. */
enum hsr_status try_numbers(struct trial *trial);

/* Rows or columns the other way, and other numbers of the faces: neither explains
 * much by itself. */
enum hsr_status try_pairs(struct trial *trial);

/* Another camera: another view; samples at other places, by half a sample or by
 * whole ones; another angle of view. */
enum hsr_status try_views(struct trial *trial);
enum hsr_status try_places(struct trial *trial);
enum hsr_status try_borders(struct trial *trial);
enum hsr_status try_shifts(struct trial *trial);
enum hsr_status try_fields(struct trial *trial);

/* Another near plane, or a far one. */
enum hsr_status try_depths(struct trial *trial);

#endif
