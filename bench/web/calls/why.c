/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why a sample shows what it shows: the faces over it. */
#include "bench/web/over.h"
#include "bench/web/web.h"
#include "common/files/json/json.h"

static json_t *faces_json(const struct over_face *face, size_t n) {
  json_t *faces = json_array();
  for (size_t k = 0; k < n; k++)
    hsr_json_append(&faces,
                    json_pack("{sI sf}", "face", (json_int_t)face[k].face,
                              "depth", face[k].depth));
  return faces;
}

static enum hsr_status find(struct lib_scene *scene,
                            const struct hsr_request *request, int i, int j,
                            const struct over_face **face, size_t *n,
                            struct hsr_error *err) {
  struct hsr_geometry laid_out = {.size = sizeof laid_out};
  struct hsr_view view;
  enum hsr_status status = hsr_get_geometry(scene, &laid_out, err);
  if (!status)
    status = lib_view(scene, request, HSR_IDS, &view, err);
  if (!status && (i < 0 || j < 0 || i >= view.m || j >= view.n))
    status = hsr_fail(err, HSR_E_USAGE, "there is no sample (%d, %d)", i, j);
  return status ? status
                : over_find(&scene->laid_out, &view, i, j, face, n, err);
}

/* [{face, depth}, ...] over sample (i, j), the nearest first. */
WEB_CALL enum hsr_status web_why(struct lib_scene *scene, const char *text,
                                 int i, int j) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  const struct over_face *face = NULL;
  size_t n = 0;
  enum hsr_status status = web_request_read(&request, text, err);
  if (!status)
    status = find(scene, &request.request, i, j, &face, &n, err);
  web_request_free(&request);
  return web_end(status, status ? NULL : faces_json(face, n));
}
