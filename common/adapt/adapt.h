/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making a scene fit an algorithm's restrictions.
 *
 * Source      Sutherland et al. 1974, figure 29a: what each algorithm demands
 *             of its environment.
 * Adapters    an adapter makes a world satisfy a restriction. It divides faces
 *             into exact pieces (common/scene/pieces.h), once for all views.
 *             The adapters that an algorithm needs are applied in the order of
 *             hsr_adapters, and each is timed by itself. The ids of a picture
 *             are still those of the scene's own faces. */
#ifndef HSR_COMMON_ADAPT_H
#define HSR_COMMON_ADAPT_H

#include "common/scene/pieces.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Environment restrictions, figure 29a: what a method demands. */
enum {
  HSR_CC = 1 << 0, /* clusters are closed convex polyhedra */
  HSR_CF = 1 << 1, /* faces are convex polygons */
  HSR_TR = 1 << 2, /* faces are triangles */
  HSR_LS = 1 << 3, /* clusters are linearly separable */
  HSR_NP = 1 << 4, /* faces do not penetrate one another */
  HSR_TP = 1 << 5, /* topology is needed: adjacency, clusters */
  HSR_PF = 1 << 6, /* faces are planar */
  HSR_OF = 1 << 7, /* no face is outside the field of view */
  HSR_BE = 1 << 8  /* no face is behind the observer */
};
enum { HSR_N_RESTRICTIONS = 9 };

/* Returns the code of one restriction, "TR" for HSR_TR; "" if it is none of
 * these. */
const char *hsr_restriction_code(unsigned restriction);

/* What an adapter keeps from frame to frame of a scene in which objects move:
 * the priorities within clusters (common/adapt/kept_priorities.h). It is empty at
 * first. NULL: out of memory. */
struct hsr_kept_priorities;
struct hsr_kept_priorities *hsr_kept_priorities_new(void);
void hsr_kept_priorities_free(struct hsr_kept_priorities *kept); /* or NULL */

struct hsr_adapter {
  const char *name;  /* "triangulate" */
  unsigned mends;    /* the restriction that it satisfies, HSR_TR, ... If there
                        are several, it is applied only if an algorithm demands
                        all of them */
  const char *about; /* what it does, a clause */

  /* Makes *out, a world of pieces, from `in`, which is borrowed. If there is
   * nothing to do, *changed is false and *out is not written. If *changed is
   * true, *out is freed with hsr_world_free. `in` may be freed before *out, but
   * the world of the scene itself must outlive both. HSR_E_NOMEM;
   * HSR_E_REFUSED, with the code and the face in *err, if a face cannot be
   * adapted; HSR_E_INTERNAL if a library fails. */
  enum hsr_status (*adapt)(const struct hsr_world *in, struct hsr_world *out,
                           bool *changed, struct hsr_error *err);

  /* The same, but uses what was kept of other frames of the scene, and keeps what
   * it finds. What it makes is as right, but need not be the same. NULL: the
   * adapter keeps nothing. */
  enum hsr_status (*follow)(const struct hsr_world *in,
                            struct hsr_kept_priorities *kept,
                            struct hsr_world *out, bool *changed,
                            struct hsr_error *err);
};

/* The adapters, in the order of their application. The list ends with .name ==
 * NULL. */
extern const struct hsr_adapter hsr_adapters[];

/* Checks that all faces of a world that has not been adapted are convex and
 * flat. HSR_E_REFUSED if not, with a text that names the world by `what`:
 * "object chair", "the scene". HSR_E_NOMEM; HSR_E_INTERNAL if a library
 * fails. */
enum hsr_status hsr_check_unadapted(const struct hsr_world *world,
                                    const char *what, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
