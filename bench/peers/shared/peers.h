/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peers: other people's renderers, which draw the same views as our own.
 *
 * hsr-peers list
 *   prints the peers as a JSON array of {"name", "title", "source", "version":
 *   null if it cannot be started here, "kind": "ids", "cells" of a grid,
 *   "segments", "groups" or "none", "threads": whether it can draw on several, "what":
 *   what a frame contains and what it leaves out}
 * hsr-peers NAME FOLDER
 *   draws when told to, by the protocol of docs/programs.md. It knows the scene by
 *   its name. The answer is as the peer's kind: ids, or cells in their place
 * hsr-peers judge NAME SCENE VIEW WxH
 *   for a peer that draws lines, or tells groups of faces that are hidden:
 *   compares its drawing with the line oracle's, or its groups with the picture of
 *   the oracle, and prints {"compared": edges or groups, "mismatches": those that
 *   are wrong, ...}. The peer's "what" tells how. A picture of ids or cells is judged by the program that reads
 *   them.
 *
 * Exit status: as hsr's, and HSR_E_REFUSED for a scene that the peer refuses.
 */
#ifndef HSR_BENCH_PEERS_SHARED_PEERS_H
#define HSR_BENCH_PEERS_SHARED_PEERS_H

#include "algorithms/setup.h"
#include "common/view/view.h"

#include <jansson.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a peer is set up with. All borrowed; it outlives the peer's state. */
struct peer_canvas {
  const struct hsr_setup *setup;   /* of peer->demands, for the scene; if there
                                      is an outline, for its objects, each once,
                                      in their own coordinates */
  const struct hsr_world *outline; /* of the scene; NULL: it is laid out */
  int m, n;
  long threads;  /* 1, unless the peer can draw on several */
  uint32_t *ids; /* m * n; the face of sample (i, j) goes to j * m + i. Of a
                    peer of kind "cells", the grid's cell */
};

/* Which scenes a peer draws from an outline and the objects: no scene, those
 * that are too large to be laid out, or all scenes. */
enum outlines { OUTLINES_REFUSED, OUTLINES_TAKEN, OUTLINES_ONLY };

struct peer {
  const char *name, *title, *source, *what;
  const char *kind;    /* "ids", "cells", "segments", "groups" of faces that are
                          hidden or may be seen, "none" */
  bool many_threads;   /* it can draw on more than one */
  const void *flavour; /* where one set of functions serves several peers */

  /* The peer makes the same demands on a scene as this algorithm. */
  const struct hsr_algorithm *demands;
  enum outlines outlines;

  /* Writes the version, at most PEER_VERSION characters; an empty one if the
   * peer cannot be started. */
  void (*version)(char *text);

  /* Does all work that does not depend on the view. *state is freed by release,
   * also after a failure. HSR_E_NOMEM, HSR_E_INTERNAL; HSR_E_REFUSED if the
   * peer cannot draw the scene. */
  enum hsr_status (*setup)(const struct peer *peer,
                           const struct peer_canvas *canvas, void **state,
                           struct hsr_error *err);

  /* Draws one whole frame, from the world's vertices to the answer in memory.
   */
  enum hsr_status (*draw)(void *state, const struct hsr_view *view,
                          struct hsr_error *err);

  /* Judges the frame just drawn; NULL unless the peer is of kind "segments" or
   * "groups". *verdict is a new reference; NULL for lack of memory. */
  enum hsr_status (*judge)(void *state, const struct hsr_view *view,
                           json_t **verdict, struct hsr_error *err);

  void (*release)(void *state); /* NULL is allowed */
};

enum { PEER_VERSION = 80 };

/* Has only a restriction: it demands triangles. */
extern const struct hsr_algorithm takes_triangles; /* main.c */

extern const struct peer peer_embree, peer_embree_packets,
    peer_embree_instances, peer_embree_robust,
    peer_embree_robust_packets;                               /* embree.c */
extern const struct peer peer_tinybvh;                        /* tinybvh.cc */
extern const struct peer peer_masked_culling;                 /* culler.cc */
extern const struct peer peer_llvmpipe, peer_llvmpipe_arrays; /* llvmpipe.c */
extern const struct peer peer_vtk, peer_vtk_painter;          /* vtk.cc */
extern const struct peer peer_vtk_lines;                      /* vtk_lines.cc */
extern const struct peer peer_vtk_volume,
    peer_vtk_volume_fine;            /* vtk_volume.cc */
extern const struct peer peer_gl2ps; /* gl2ps.c */
extern const struct peer peer_occt_exact, peer_occt_polygonal; /* occt.cc */
extern const struct peer peer_sketch, peer_sketch_bsp;         /* sketch.cc */
extern const struct peer peer_zbuffer_inexact, peer_memset;    /* own.c */

#ifdef __cplusplus
}
#endif
#endif
