/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making an environment fit an algorithm's restrictions.
 *
 * Source      Sutherland et al. 1974, figure 29a: what each algorithm demands
 *             of its environment.
 * Adapters    each mends one restriction by dividing faces, in exact terms
 *             (common/scene/pieces.h), once for all views. They are applied by
 *             name, in the order below, and each is timed by itself. The ids of
 *             a picture are still those of the scene's own faces. */
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
  HSR_LS = 1 << 3, /* clusters linearly separable */
  HSR_NP = 1 << 4, /* no penetrating faces */
  HSR_TP = 1 << 5, /* topology needed: adjacency, clusters */
  HSR_PF = 1 << 6, /* planar faces only */
  HSR_OF = 1 << 7, /* no faces outside the field of view */
  HSR_BE = 1 << 8  /* no faces behind the observer */
};
enum { HSR_N_RESTRICTIONS = 9 };

/* The code of one restriction, "TR" for HSR_TR; "" if it is none of these. */
const char *hsr_restriction_code(unsigned restriction);

struct hsr_adapter {
  const char *name;  /* "triangulate" */
  unsigned mends;    /* HSR_TR, ...; several: only if all are demanded */
  const char *about; /* what it does, a clause */

  /* Makes *out from `in`, which is borrowed. If nothing need be done, *changed
   * is false and *out is not written. Else *out is freed with hsr_world_free;
   * `in` may be freed before it, but the world of the scene itself must outlive
   * both. HSR_E_NOMEM; HSR_E_REFUSED, with the code and the face in *err, where
   * a face cannot be mended. */
  enum hsr_status (*adapt)(const struct hsr_world *in, struct hsr_world *out,
                           bool *changed, struct hsr_error *err);
};

/* In the order of their application, ended by .name == NULL. */
extern const struct hsr_adapter hsr_adapters[];

/* Checks that all faces of a world that nobody has adapted are convex and flat:
 * HSR_E_REFUSED if not, with a text about `what`: "object chair", "the scene".
 * HSR_E_NOMEM. */
enum hsr_status hsr_check_unadapted(const struct hsr_world *world,
                                    const char *what, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
