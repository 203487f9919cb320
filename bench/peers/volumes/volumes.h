/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other people's renderers of volumes, beside our splats.
 *
 * hsr-volumes list
 *   prints the renderers as a JSON array of {"name", "title", "version",
 *   "beside": the algorithm of ours that is drawn in turn, "what"}
 * hsr-volumes NAME SCENE VIEW WxH [FRAMES [PREFIX]]
 *   draws frames of both in turn, on one thread, and prints a JSON object: the
 *   least and the median time of each, in seconds; how far the pictures are
 *   apart: the root mean square difference of all pixels, where 1 is the
 *   greatest value of a channel, the share of pixels that show anything, the
 *   correlation, and the shift of the other picture, in pixels, at which the
 *   correlation is greatest. Sums are first multiplied by the factor that makes
 *   them fit best. Writes PREFIX-ours.png, PREFIX-NAME.png
 *   and PREFIX-difference.png, which is eight times as bright; and PREFIX-NAME.npy,
 *   red, green, blue and opacity in floats, for hsr errors.
 *
 * It is a program of its own because hsr-peers serves pictures that have a
 * right answer, of which bench counts what is wrong. What these renderers draw
 * is another integral of the same samples: there is only how far it is off.
 *
 * Exit status: as hsr's, and HSR_E_REFUSED for what the renderer refuses. */
#ifndef HSR_BENCH_PEERS_VOLUMES_VOLUMES_H
#define HSR_BENCH_PEERS_VOLUMES_VOLUMES_H

#include "bench/peers/shared/samples.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

struct volume_peer {
  const char *name, *title, *what;
  bool sums;     /* it draws sums of opacity, and not what is over what */
  bool parallel; /* it draws in parallel projection alone */
  double steps;  /* of a ray, in a cell; 0: it casts none */

  void (*version)(char *text); /* at most VOLUME_VERSION characters */

  /* Does all work that does not depend on the view. *state is freed by release,
   * also after a failure. HSR_E_NOMEM, HSR_E_REFUSED, HSR_E_INTERNAL. */
  enum hsr_status (*setup)(const struct volume_peer *peer,
                           const struct samples *samples,
                           const struct hsr_view *view, void **state,
                           struct hsr_error *err);

  /* Draws one whole frame. */
  enum hsr_status (*draw)(void *state, const struct hsr_view *view,
                          struct hsr_error *err);

  /* The frame drawn last, which is not a part of drawing it: 4 values a pixel,
   * by rows from the top. Colours are premultiplied, 1 is the most. Of sums
   * only the last counts: opacity times length in cells. */
  void (*take)(const void *state, const struct hsr_view *view, float *rgba);

  void (*release)(void *state); /* NULL is allowed */
};

enum { VOLUME_VERSION = 40 };

extern const struct volume_peer volume_vtk,
    volume_vtk_coarse;                          /* volumes_vtk.cc */
extern const struct volume_peer volume_volpack; /* volumes_volpack.c */
extern const struct volume_peer volume_teem,
    volume_teem_coarse; /* volumes_teem.c */

#ifdef __cplusplus
}
#endif
#endif
