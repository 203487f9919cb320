/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .glb files. VTK 9.1 writes no binary glTF, and no instances of one mesh.
 *
 * Source      The Khronos Group, "glTF 2.0 Specification", 2021: 3.6 to 3.10,
 *             and 4, the container of .glb
 * Chunks      JSON, then BIN. Of each primitive, one stretch of BIN: the
 *             positions of its vertices, 12 bytes each, and then the numbers of
 *             their faces, 4 bytes each.
 * Flat        there are no normals: a viewer shades each triangle flat. */
#include "common/files/cells/cells.h"
#include "common/files/json/json.h"
#include "common/files/whole_file.h"
#include "common/scene/pieces.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FLOAT = 5126, ARRAY_BUFFER = 34962 };

struct glb {
  struct hsr_scene *scene;
  struct hsr_glb_frame frame;
  json_t *meshes, *accessors, *views, *materials, *nodes, *cameras;
  size_t n_accessors, n_views, n_materials;
  FILE *bin; /* of all primitives */
  size_t bytes;
};

/* A value that could not be made shows as NULL in the end. */
static json_t *numbers(const double *x, int n) {
  json_t *array = json_array();
  for (int k = 0; k < n; k++)
    hsr_json_append(&array, json_real(x[k]));
  return array;
}

/* --- Meshes --------------------------------------------------------------- */

static void add_material(struct glb *g, const struct hsr_object *object,
                         const float rgb[3]) {
  const double factor[4] = {(double)rgb[0], (double)rgb[1], (double)rgb[2],
                            (double)object->opacity};
  hsr_json_append(&g->materials,
                  json_pack("{s{so sf sf} sb ss}", "pbrMetallicRoughness",
                            "baseColorFactor", numbers(factor, 4),
                            "metallicFactor", 0.0, "roughnessFactor", 1.0,
                            "doubleSided", !object->one_sided, "alphaMode",
                            object->opacity < 1 ? "BLEND" : "OPAQUE"));
  g->n_materials++;
}

/* One array of BIN, of n floats or groups of three, and its accessor. */
static void add_accessor(struct glb *g, const char *type, size_t n,
                         size_t bytes, json_t *extent) {
  hsr_json_append(&g->views,
                  json_pack("{si sI sI si}", "buffer", 0, "byteOffset",
                            (json_int_t)g->bytes, "byteLength",
                            (json_int_t)bytes, "target", (int)ARRAY_BUFFER));
  json_t *accessor = json_pack(
      "{sI si sI ss}", "bufferView", (json_int_t)g->n_views++, "componentType",
      (int)FLOAT, "count", (json_int_t)n, "type", type);
  if (accessor && extent && json_object_update(accessor, extent)) {
    json_decref(accessor);
    accessor = NULL;
  }
  json_decref(extent);
  hsr_json_append(&g->accessors, accessor);
  g->n_accessors++;
  g->bytes += bytes;
}

/* What is written of each corner of a triangle. */
enum corner { POSITION, COLOUR, FACE_NUMBER };

/* The triangles of one colour of an object, or all of them. */
struct triangles {
  const struct hsr_world *world;
  const struct hsr_colours *colours;
  uint32_t colour; /* ALL_COLOURS: all */
};
#define ALL_COLOURS UINT32_MAX

static void write_corner(struct glb *g, const struct triangles *t,
                         enum corner what, uint32_t face, const float p[3]) {
  const float number = (float)face;
  if (what == FACE_NUMBER)
    fwrite(&number, sizeof number, 1, g->bin);
  else
    fwrite(what == POSITION
               ? p
               : t->colours->rgb + 3 * (size_t)t->colours->of[face],
           sizeof *p, 3, g->bin);
}

/* Returns the number of corners. */
static size_t write_corners(struct glb *g, const struct triangles *t,
                            enum corner what, double lo[3], double hi[3]) {
  const struct hsr_mesh *mesh = &t->world->mesh;
  size_t n = 0;
  for (uint32_t f = 0; f < t->world->n_faces; f++) {
    const uint32_t parent = hsr_world_parent(t->world, f);
    if (t->colour != ALL_COLOURS && t->colours->of[parent] != t->colour)
      continue;
    for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++, n++) {
      const uint32_t v = mesh->vertex[k];
      const float p[3] = {(float)mesh->x[v], (float)mesh->y[v],
                          (float)mesh->z[v]};
      write_corner(g, t, what, parent, p);
      for (int c = 0; c < 3; c++) {
        lo[c] = n ? fmin(lo[c], (double)p[c]) : (double)p[c];
        hi[c] = n ? fmax(hi[c], (double)p[c]) : (double)p[c];
      }
    }
  }
  return n;
}

/* Writes one array of the corners, and names it. */
static void add_attribute(struct glb *g, const struct triangles *t,
                          enum corner what, json_t **attributes) {
  static const char *const name[] = {
      [POSITION] = "POSITION", [COLOUR] = "COLOR_0", [FACE_NUMBER] = "_FACE"};
  double lo[3], hi[3];
  json_t *number = json_integer((json_int_t)g->n_accessors);
  if (json_object_set_new(*attributes, name[what], number)) {
    json_decref(*attributes);
    *attributes = NULL;
  }
  const size_t n = write_corners(g, t, what, lo, hi);
  if (what == FACE_NUMBER)
    add_accessor(g, "SCALAR", n, 4 * n, NULL);
  else
    add_accessor(g, "VEC3", n, 12 * n,
                 what == POSITION ? json_pack("{so so}", "min", numbers(lo, 3),
                                              "max", numbers(hi, 3))
                                  : NULL);
}

static json_t *primitive(struct glb *g, const struct triangles *t) {
  json_t *attributes = json_object();
  add_attribute(g, t, POSITION, &attributes);
  add_attribute(g, t, FACE_NUMBER, &attributes);
  if (t->colour == ALL_COLOURS)
    add_attribute(g, t, COLOUR, &attributes);
  return json_pack("{so sI}", "attributes", attributes, "material",
                   (json_int_t)g->n_materials - 1);
}

/* Names of files may be no UTF-8, which JSON is. */
static json_t *name_of(const struct hsr_object *object) {
  json_t *name = json_string(object->name);
  return name ? name : json_string("object");
}

/* A material for each colour; of many colours, one for all, and the colours at
 * the corners. */
static enum hsr_status add_primitives(struct glb *g,
                                      const struct hsr_object *object,
                                      const struct hsr_world *world,
                                      struct hsr_error *err) {
  enum { MANY = 256 };
  static const float white[3] = {1, 1, 1};
  struct hsr_colours colours;
  enum hsr_status status = hsr_colours_of(&colours, object, 1, err);
  json_t *primitives = json_array();
  for (uint32_t c = 0; c < colours.n && colours.n <= MANY && !status; c++) {
    const struct triangles t = {world, &colours, c};
    add_material(g, object, colours.rgb + 3 * (size_t)c);
    hsr_json_append(&primitives, primitive(g, &t));
  }
  if (colours.n > MANY && !status) {
    const struct triangles t = {world, &colours, ALL_COLOURS};
    add_material(g, object, white);
    hsr_json_append(&primitives, primitive(g, &t));
  }
  hsr_json_append(&g->meshes, json_pack("{so so}", "name", name_of(object),
                                        "primitives", primitives));
  hsr_colours_free(&colours);
  return status;
}

/* An object by itself as a world of triangles, in its own frame. */
static enum hsr_status add_mesh(struct glb *g, uint32_t number,
                                struct hsr_error *err) {
  struct hsr_instance here = {0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
  struct hsr_object *object = &g->scene->objects[number];
  struct hsr_scene alone = {.name = g->scene->name,
                            .objects = object,
                            .instances = &here,
                            .views = g->scene->views,
                            .n_objects = 1,
                            .n_instances = 1,
                            .n_views = 1};
  struct hsr_world world, triangles;
  bool changed = false;
  enum hsr_status status = hsr_world_init(&world, &alone, err);
  if (!status)
    status = hsr_world_triangulate(&world, &triangles, &changed, err);
  if (!status)
    status = add_primitives(g, object, changed ? &triangles : &world, err);
  if (changed)
    hsr_world_free(&triangles);
  hsr_world_free(&world);
  return status;
}

/* --- Nodes ---------------------------------------------------------------- */

/* Matrices of glTF go by columns. */
static json_t *matrix(const double m[12]) {
  double column[16];
  for (int c = 0; c < 4; c++)
    for (int r = 0; r < 4; r++)
      column[4 * c + r] = r < 3 ? m[4 * r + c] : c == 3;
  return numbers(column, 16);
}

/* A point or direction in the file's frame: from z up to y up, and scaled. Of a
 * matrix of 3 x 4, column c. */
static void to_frame(const struct glb *g, double scale, double *m, int c) {
  const double x = m[c], y = m[4 + c], z = m[8 + c];
  const bool turned = g->frame.z_up;
  m[c] = scale * x;
  m[4 + c] = scale * (turned ? z : y);
  m[8 + c] = scale * (turned ? 0 - y : z);
}

static json_t *instance_matrix(const struct glb *g, uint32_t instance) {
  double m[12];
  memcpy(m, g->scene->instances[instance].m, sizeof m);
  for (int c = 0; c < 4; c++)
    to_frame(g, g->frame.metres, m, c);
  return matrix(m);
}

static void add_instances(struct glb *g) {
  const struct hsr_scene *scene = g->scene;
  json_int_t first = 0, mesh = 0;
  for (uint32_t o = 0, i = 0; o < scene->n_objects; o++) {
    const uint32_t n_faces = scene->objects[o].n_faces;
    for (; i < scene->n_instances && scene->instances[i].object == o; i++) {
      if (n_faces)
        hsr_json_append(&g->nodes,
                        json_pack("{sI so s{sI sI}}", "mesh", mesh, "matrix",
                                  instance_matrix(g, i), "extras", "instance",
                                  (json_int_t)i, "first_face", first));
      first += n_faces;
    }
    mesh += n_faces > 0;
  }
}

/* A camera of glTF looks along -z, with y up. */
static void add_camera(struct glb *g, uint32_t number) {
  const struct hsr_camera *camera = &g->scene->views[number];
  struct hsr_view view;
  if (hsr_view_init(&view, camera, 1, 1, NULL))
    return;
  double right = 0, up = 0, distance = 0, m[12];
  for (int k = 0; k < 3; k++) {
    right += view.R[k] * view.R[k];
    up += view.U[k] * view.U[k];
    distance = fmax(distance, fabs(camera->at[k] - camera->eye[k]));
  }
  for (int k = 0; k < 3; k++) {
    m[4 * k] = view.R[k] / sqrt(right);
    m[4 * k + 1] = view.U[k] / sqrt(up);
    m[4 * k + 2] = -view.F[k];
    m[4 * k + 3] = view.E[k];
  }
  const double metres = g->frame.metres;
  for (int c = 0; c < 4; c++)
    to_frame(g, c < 3 ? 1 : metres, m, c);
  const double near = metres * fmax(camera->near, distance / 1000);
  const double height = metres * camera->parallel;
  const double degree = 3.14159265358979323846 / 180;
  hsr_json_append(
      &g->cameras,
      view.parallel
          ? json_pack("{ss s{sf sf sf sf}}", "type", "orthographic",
                      "orthographic", "xmag", height / 2, "ymag", height / 2,
                      "znear", metres * camera->near, "zfar",
                      metres * (camera->near + 1000 * distance))
          : json_pack("{ss s{sf sf}}", "type", "perspective", "perspective",
                      "yfov", camera->fov * degree, "znear", near));
  hsr_json_append(&g->nodes,
                  json_pack("{sI so}", "camera",
                            (json_int_t)json_array_size(g->cameras) - 1,
                            "matrix", matrix(m)));
}

/* --- The file ------------------------------------------------------------- */

static void put_number(size_t number, FILE *out) {
  for (int k = 0; k < 4; k++)
    fputc((int)(number >> 8 * k & 255), out);
}

/* All that is not BIN; takes over the arrays. NULL for lack of memory. */
static char *describe(struct glb *g) {
  json_t *roots = json_array();
  for (size_t k = 0; k < json_array_size(g->nodes); k++)
    hsr_json_append(&roots, json_integer((json_int_t)k));
  json_t *all = json_pack(
      "{s{ss ss} si s[{so}] so so so so so so s[{sI}]}", "asset", "version",
      "2.0", "generator", "hsr", "scene", 0, "scenes", "nodes", roots, "nodes",
      g->nodes, "meshes", g->meshes, "materials", g->materials, "cameras",
      g->cameras, "accessors", g->accessors, "bufferViews", g->views, "buffers",
      "byteLength", (json_int_t)g->bytes);
  char *text =
      all ? json_dumps(all, JSON_COMPACT | JSON_REAL_PRECISION(17)) : NULL;
  json_decref(all);
  return text;
}

static void copy(FILE *from, FILE *to) {
  char block[65536];
  rewind(from);
  for (size_t n; (n = fread(block, 1, sizeof block, from)) > 0;)
    fwrite(block, 1, n, to);
}

static enum hsr_status write_file(struct glb *g, const char *path,
                                  struct hsr_error *err) {
  char *text = describe(g);
  if (!text)
    return hsr_fail_nomem(err);
  const size_t n = strlen(text), padded = (n + 3) / 4 * 4;
  const size_t all = 12 + 8 + padded + 8 + g->bytes;
  struct hsr_whole_file file;
  enum hsr_status status =
      all > UINT32_MAX ? hsr_fail(err, HSR_E_INPUT,
                                  "%.200s: would be larger than 4 GB", path)
      : fflush(g->bin) || ferror(g->bin)
          ? hsr_fail(err, HSR_E_INPUT, "%.200s: cannot be written: no room",
                     path)
          : hsr_whole_file_open(&file, path, err);
  if (!status) {
    fputs("glTF", file.stream);
    put_number(2, file.stream);
    put_number(all, file.stream);
    put_number(padded, file.stream);
    fprintf(file.stream, "JSON%-*s", (int)padded, text);
    put_number(g->bytes, file.stream);
    fwrite("BIN", 1, 4, file.stream);
    copy(g->bin, file.stream);
    status = hsr_whole_file_close(&file, HSR_OK, err);
  }
  free(text);
  return status;
}

enum hsr_status hsr_scene_write_glb(struct hsr_scene *scene,
                                    struct hsr_glb_frame frame,
                                    const char *path, struct hsr_error *err) {
  enum hsr_status status = hsr_scene_make_faces(scene, err);
  if (status)
    return status;
  struct glb g = {.scene = scene,
                  .frame = frame,
                  .meshes = json_array(),
                  .accessors = json_array(),
                  .views = json_array(),
                  .materials = json_array(),
                  .nodes = json_array(),
                  .cameras = json_array(),
                  .bin = tmpfile()};
  if (!g.bin)
    status = errno == ENOMEM
                 ? hsr_fail_nomem(err)
                 : hsr_fail(err, HSR_E_INPUT,
                            "%.200s: cannot be written: no room", path);
  for (uint32_t o = 0; o < scene->n_objects && !status; o++)
    if (scene->objects[o].n_faces) /* a mesh must have something */
      status = add_mesh(&g, o, err);
  if (!status)
    add_instances(&g);
  for (uint32_t v = 0; v < scene->n_views && !status; v++)
    add_camera(&g, v);
  if (!status)
    status = write_file(&g, path, err);
  else {
    json_t *const array[] = {g.meshes,    g.accessors, g.views,
                             g.materials, g.nodes,     g.cameras};
    for (int k = 0; k < 6; k++)
      json_decref(array[k]);
  }
  if (g.bin)
    fclose(g.bin);
  return status;
}
