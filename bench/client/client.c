/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/client/client.h"

enum hsr_status client_open(const struct scene_options *o,
                            const struct view_options *view,
                            struct lib_scene **scene, struct hsr_error *err) {
  const struct hsr_open_options options = {.size = sizeof options,
                                           .threads = o->import.threads,
                                           .strict = o->import.strict,
                                           .two_sided = o->import.two_sided,
                                           .weld = o->import.weld,
                                           .path = o->import.path};
  struct hsr_scene_info info = {.size = sizeof info};
  enum hsr_status status = hsr_open(o->name, &options, scene, err);
  if (!status)
    status = hsr_get_scene(*scene, &info, err);
  if (!status)
    say_opened(o->name, info.notes, info.n_dropped, info.enlarged);
  if (!status && view && view->view > (long)info.n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %ld",
                    info.name, info.n_views, view->view);
  return status;
}

struct hsr_request client_request(const struct view_options *o,
                                  const char *algorithm, int samples) {
  return (struct hsr_request){.size = sizeof(struct hsr_request),
                              .algorithm = algorithm,
                              .view = (uint32_t)o->view - 1,
                              .m = samples * o->m,
                              .n = samples * o->n};
}
