/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef HSR_BENCH_WEB_OVER_H
#define HSR_BENCH_WEB_OVER_H

#include "common/scene/world.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A face that covers a sample, and its depth there, rounded. */
struct over_face {
  uint32_t face;
  double depth;
};

/* Sets *faces to the n faces of a world, laid out, that cover sample (i, j), the
 * nearest first. The array lasts until the next call, and what is built for the
 * world until over_forget. HSR_E_NOMEM. */
enum hsr_status over_find(const struct hsr_world *world,
                          const struct hsr_view *view, int i, int j,
                          const struct over_face **faces, size_t *n,
                          struct hsr_error *err);

/* To be called before a world is freed. */
void over_forget(void);

#ifdef __cplusplus
}
#endif

#endif
