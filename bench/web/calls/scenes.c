/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opening scenes; what is known of them. */
#include "bench/web/over.h"
#include "bench/web/web.h"
#include "common/files/json/json.h"

#include <string.h>

/* --- What is known -------------------------------------------------------- */

static json_t *vector_json(const double v[3]) {
  return json_pack("[fff]", v[0], v[1], v[2]);
}

static json_t *cameras_json(const struct lib_scene *scene) {
  struct lib_camera c = {.size = sizeof c};
  json_t *cameras = json_array();
  for (uint32_t k = 0; !hsr_get_camera(scene, k, &c, NULL); k++)
    hsr_json_append(&cameras,
                    json_pack("{so so so sf sf sf s[ffff]}", "eye",
                              vector_json(c.eye), "at", vector_json(c.at), "up",
                              vector_json(c.up), "fov", c.fov, "near", c.near,
                              "parallel", c.parallel, "light", c.light[0],
                              c.light[1], c.light[2], c.light[3]));
  return cameras;
}

static json_t *scene_json(const struct lib_scene *scene) {
  struct hsr_scene_info s = {.size = sizeof s};
  hsr_get_scene(scene, &s, NULL);
  return json_pack(
      "{so ss sI sI sI sI so sb sb si sI ss}", "id", web_address(scene), "name",
      s.name, "nFaces", (json_int_t)s.n_faces, "nVertices",
      (json_int_t)s.n_vertices, "nObjects", (json_int_t)s.n_objects,
      "nInstances", (json_int_t)s.n_instances, "views", cameras_json(scene),
      "isGrid", s.is_grid, "isTransparent", s.is_transparent, "enlarged",
      s.enlarged, "nDropped", (json_int_t)s.n_dropped, "notes", s.notes);
}

static enum hsr_status end_open(enum hsr_status status,
                                struct lib_scene *scene) {
  json_t *json = status ? NULL : scene_json(scene);
  if (!json)
    hsr_close(scene);
  return web_end(status, json);
}

/* --- Opening -------------------------------------------------------------- */

/* path: where its file is, or NULL. */
WEB_CALL enum hsr_status web_open(const char *name, const char *path,
                                  int two_sided, double weld) {
  struct hsr_error *err = web_begin();
  const struct hsr_open_options options = {.size = sizeof options,
                                           .two_sided = two_sided,
                                           .weld = weld,
                                           .path = path};
  struct lib_scene *scene = NULL;
  return end_open(hsr_open(name, &options, &scene, err), scene);
}

/* ring, rgb and opacity may be NULL. The arrays are copied. */
WEB_CALL enum hsr_status web_open_arrays(const char *name, const double *xyz,
                                         uint32_t n_vertices,
                                         const uint32_t *ring, uint32_t n_faces,
                                         const uint32_t *vertex,
                                         uint32_t n_corners, const float *rgb,
                                         const float *opacity, int two_sided) {
  struct hsr_error *err = web_begin();
  const struct hsr_open_options options = {.size = sizeof options,
                                           .two_sided = two_sided};
  const struct hsr_arrays arrays = {.size = sizeof arrays,
                                    .name = name,
                                    .xyz = xyz,
                                    .n_vertices = n_vertices,
                                    .ring = ring,
                                    .n_faces = n_faces,
                                    .vertex = vertex,
                                    .n_corners = n_corners,
                                    .rgb = rgb,
                                    .opacity = opacity};
  struct lib_scene *scene = NULL;
  return end_open(hsr_open_arrays(&arrays, &options, &scene, err), scene);
}

WEB_CALL enum hsr_status web_close(struct lib_scene *scene) {
  web_begin();
  over_forget();
  hsr_close(scene);
  return web_end(HSR_OK, json_true());
}

/* --- Geometry ------------------------------------------------------------- */

static json_t *names_json(const struct hsr_geometry *g) {
  json_t *names = json_array();
  for (size_t k = 0; k < g->n_objects; k++)
    hsr_json_append(&names, json_string(g->object_name[k]));
  return names;
}

WEB_CALL enum hsr_status web_geometry(const struct lib_scene *scene) {
  struct hsr_error *err = web_begin();
  struct hsr_geometry g = {.size = sizeof g};
  enum hsr_status status = hsr_get_geometry(scene, &g, err);
  if (status)
    return web_end(status, NULL);
  return web_end(
      HSR_OK,
      json_pack("{so sI so sI so sI so so so so so}", "xyz", web_address(g.xyz),
                "nVertices", (json_int_t)g.n_vertices, "ring",
                web_address(g.ring), "nFaces", (json_int_t)g.n_faces, "vertex",
                web_address(g.vertex), "nCorners", (json_int_t)g.n_corners,
                "rgb", web_address(g.rgb), "opacity", web_address(g.opacity),
                "object", web_address(g.object), "objects", names_json(&g),
                "oneSided", web_address(g.one_sided)));
}
