/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is right of a scene in parts, which nobody has as a whole.
 *
 * The oracle answers for each part at the samples of the places that are
 * compared. The faces that it sees there are candidates. Then it is asked of all
 * candidates alone: the face that is seen of a scene is seen of its part too, so
 * it is among them. */
#ifndef HSR_BENCH_CANDIDATES_H
#define HSR_BENCH_CANDIDATES_H

#include "bench/judge/judge.h"
#include "bench/ranks/loose_faces.h"

/* Adds what the oracle sees of a part, whose ids begin at `first`. `of` has the
 * form, how many places are compared, the one view, its number, and the part's
 * world. HSR_E_NOMEM, or the oracle's; HSR_E_REFUSED if a picture that is folded
 * would be too large. */
enum hsr_status candidates_add(struct loose_faces *candidates,
                               const struct group *of, uint32_t first,
                               struct hsr_error *err);

/* What is right, by the scene's ids: the oracle's answer for the candidates of
 * all parts. `of` as above, but for the world. *wanted, all 0 at first, is to be
 * freed by free_wanted also after a failure: as above. */
enum hsr_status candidates_ask(const struct loose_faces *candidates,
                               const struct group *of, const char *name,
                               struct wanted *wanted, struct hsr_error *err);

#endif
