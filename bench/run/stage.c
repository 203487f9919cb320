/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/run/stage.h"

#include "common/base/clock.h"
#include "common/base/share.h"

enum hsr_status stage_open(struct stage *stage, const char *scene,
                           uint32_t most, long view, int m, int n, long threads,
                           struct hsr_error *err) {
  *stage = (struct stage){.imported.threads = hsr_threads(threads)};
  double begin = hsr_seconds_now();
  enum hsr_status status =
      hsr_scene_open(scene, &stage->imported, &stage->scene, err);
  if (!status)
    status = hsr_world_open(&stage->world, stage->scene, most, err);
  stage->import_seconds = hsr_seconds_now() - begin;
  if (status)
    return status;
  if (stage->scene->n_views < view &&
      hsr_scene_add_orbit(stage->scene, (unsigned)view - stage->scene->n_views))
    return hsr_fail_nomem(err);
  return hsr_view_init_of(&stage->view, stage->scene, (uint32_t)view - 1, m, n,
                          err);
}

enum hsr_status stage_walk(const struct stage *stage, long first, int n,
                           struct hsr_view *view, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < n && !status; k++)
    status = hsr_view_init_of(&view[k], stage->scene, (uint32_t)(first - 1 + k),
                              stage->view.m, stage->view.n, err);
  return status;
}

void stage_close(struct stage *stage) {
  hsr_world_free(&stage->world);
  hsr_scene_delete(stage->scene);
}
