/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .glb files. VTK 9.1 writes no binary glTF, and no instances of one mesh.
 *
 * Source      The Khronos Group, "glTF 2.0 Specification", 2021: 3.6 to 3.10,
 *             and 4, the container of .glb
 * Chunks      JSON, then BIN. Of each primitive, one stretch of BIN for each
 *             array: the positions of its corners, 12 bytes each, the numbers of
 *             their faces, 4 bytes each, perhaps their colours, and the corners
 *             of the triangles.
 * Flat        there are no normals: a viewer shades each triangle flat.
 * Offset      of an object whose coordinates are no floats and which is farther
 *             from the origin than four times its size: a multiple of a power of
 *             two, which is as large as the object */
#include "common/files/gltf/glb_frame.h"
#include "common/files/json/json.h"
#include "common/files/whole_file.h"
#include "common/scene/pieces.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { UNSIGNED = 5125, FLOAT = 5126 };
enum { ARRAY_BUFFER = 34962, INDEX_BUFFER = 34963 };
enum { NO_MESH = -1 };

struct glb {
  struct hsr_scene *scene;
  struct hsr_glb_frame frame;
  json_t *meshes, *accessors, *views, *materials, *nodes, *cameras;
  /* For hsr itself: of meshes the offset and the one that is the same, of
   * instances the place, and of cameras the view. */
  json_t *offsets, *same, *places, *eyes;
  json_int_t (*mesh)[2]; /* of each object, as it is and turned; or NO_MESH */
  json_int_t n_meshes;
  size_t n_accessors, n_views, n_materials;
  double (*offset)[3]; /* of each object */
  double *change;      /* of each object: the most, in its own frame */
  FILE *bin;           /* of all primitives */
  size_t bytes;
};

/* A value that could not be made shows as NULL in the end. */
static json_t *numbers(const double *x, int n) {
  json_t *array = json_array();
  for (int k = 0; k < n; k++)
    hsr_json_append(&array, json_real(x[k]));
  return array;
}

/* --- Offsets -------------------------------------------------------------- */

static double round_to_float(double x, double offset) {
  return (double)(float)(x - offset) + offset;
}

/* Axis by axis. Where all coordinates are floats, nothing is gained. */
static void find_offset(const struct hsr_object *object, bool plain,
                        double offset[3], double *change) {
  double lo[3] = {0}, hi[3] = {0}, size = 0;
  bool are_floats = true;
  for (size_t v = 0; v < object->n_vertices; v++)
    for (size_t k = 0; k < 3; k++) {
      const double x = object->xyz[3 * v + k];
      lo[k] = v ? fmin(lo[k], x) : x;
      hi[k] = v ? fmax(hi[k], x) : x;
      are_floats &= (double)(float)x == x;
    }
  for (int k = 0; k < 3; k++) {
    offset[k] = 0;
    size = fmax(size, hi[k] - lo[k]);
  }
  int exponent;
  frexp(size, &exponent);
  for (int k = 0; k < 3 && !are_floats && !plain; k++) {
    const double centre = lo[k] / 2 + hi[k] / 2;
    if (fabs(centre) > 4 * size)
      offset[k] = ldexp(rint(ldexp(centre, -exponent)), exponent);
  }
  *change = 0;
  for (size_t v = 0; v < 3 * (size_t)object->n_vertices; v++) {
    const double x = object->xyz[v];
    *change = fmax(*change, fabs(round_to_float(x, offset[v % 3]) - x));
  }
}

/* The most by which a coordinate in the world changes. */
static double largest_change(const struct glb *g) {
  double most = 0;
  for (uint32_t i = 0; i < g->scene->n_instances; i++) {
    const struct hsr_instance *instance = &g->scene->instances[i];
    for (const double *m = instance->m; m < instance->m + 12; m += 4)
      most = fmax(most, g->change[instance->object] *
                            (fabs(m[0]) + fabs(m[1]) + fabs(m[2])));
  }
  return most;
}

/* --- Meshes --------------------------------------------------------------- */

static void add_material(struct glb *g, const struct hsr_object *object,
                         const float rgba[4], bool is_blended) {
  const double factor[4] = {(double)rgba[0], (double)rgba[1], (double)rgba[2],
                            (double)rgba[3]};
  hsr_json_append(&g->materials,
                  json_pack("{s{so sf sf} sb ss}", "pbrMetallicRoughness",
                            "baseColorFactor", numbers(factor, 4),
                            "metallicFactor", 0.0, "roughnessFactor", 1.0,
                            "doubleSided", !object->one_sided, "alphaMode",
                            is_blended ? "BLEND" : "OPAQUE"));
  g->n_materials++;
}

/* One array of BIN, of n elements, and its accessor. */
static void add_accessor(struct glb *g, const char *type, int component,
                         size_t n, size_t bytes, json_t *extent) {
  hsr_json_append(
      &g->views,
      json_pack("{si sI sI si}", "buffer", 0, "byteOffset",
                (json_int_t)g->bytes, "byteLength", (json_int_t)bytes, "target",
                component == FLOAT ? (int)ARRAY_BUFFER : (int)INDEX_BUFFER));
  json_t *accessor = json_pack("{sI si sI ss}", "bufferView",
                               (json_int_t)g->n_views++, "componentType",
                               component, "count", (json_int_t)n, "type", type);
  if (accessor && extent && json_object_update(accessor, extent)) {
    json_decref(accessor);
    accessor = NULL;
  }
  json_decref(extent);
  hsr_json_append(&g->accessors, accessor);
  g->n_accessors++;
  g->bytes += bytes;
}

/* What is written of each corner of a face. */
enum corner { POSITION, FACE_NUMBER, COLOUR, TRIANGLES };

/* The faces of one colour of an object, or all of them. */
struct faces {
  const struct hsr_world *world;     /* of the object alone */
  const struct hsr_world *triangles; /* of all its faces, in their order */
  const struct hsr_colours *colours;
  const double *offset;
  uint32_t colour; /* ALL_COLOURS: all */
  bool is_turned;  /* triangles are wound the other way round */
};
#define ALL_COLOURS UINT32_MAX

static void write_corner(struct glb *g, const struct faces *faces,
                         enum corner what, uint32_t face, const float p[3]) {
  const float number = (float)face;
  if (what == POSITION)
    fwrite(p, sizeof *p, 3, g->bin);
  else if (what == FACE_NUMBER)
    fwrite(&number, sizeof number, 1, g->bin);
  else
    fwrite(faces->colours->rgba + 4 * (size_t)faces->colours->of[face],
           sizeof(float), 4, g->bin);
}

/* Writes the corners of a face. */
static void write_corners(struct glb *g, const struct faces *faces,
                          enum corner what, uint32_t f, double lo[3],
                          double hi[3]) {
  const struct hsr_mesh *mesh = &faces->world->mesh;
  for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++) {
    const uint32_t v = mesh->vertex[k];
    const float p[3] = {(float)(mesh->x[v] - faces->offset[0]),
                        (float)(mesh->y[v] - faces->offset[1]),
                        (float)(mesh->z[v] - faces->offset[2])};
    write_corner(g, faces, what, f, p);
    for (int c = 0; c < 3; c++) {
      lo[c] = fmin(lo[c], (double)p[c]);
      hi[c] = fmax(hi[c], (double)p[c]);
    }
  }
}

/* Which corner of face f has the place of vertex v of a triangle. */
static uint32_t find_corner(const struct faces *faces, uint32_t f, uint32_t v) {
  const struct hsr_mesh *mesh = &faces->world->mesh;
  const struct hsr_mesh *of = &faces->triangles->mesh;
  uint32_t k = mesh->start[f];
  for (; k + 1 < mesh->start[f + 1]; k++) {
    const uint32_t w = mesh->vertex[k];
    if (mesh->x[w] == of->x[v] && mesh->y[w] == of->y[v] &&
        mesh->z[w] == of->z[v])
      break;
  }
  return k - mesh->start[f];
}

/* Writes the triangles of face f, from *triangle on. The corners of the face are
 * numbered from `first` on. */
static size_t write_triangles(struct glb *g, const struct faces *faces,
                              uint32_t f, uint32_t *triangle, size_t first) {
  const struct hsr_world *world = faces->triangles;
  uint32_t from = *triangle;
  for (; *triangle < world->n_faces && hsr_world_parent(world, *triangle) == f;
       ++*triangle) {
    const uint32_t *v = world->mesh.vertex + world->mesh.start[*triangle];
    uint32_t corner[3];
    for (int k = 0; k < 3; k++)
      corner[k] = (uint32_t)first +
                  find_corner(faces, f, v[faces->is_turned && k ? 3 - k : k]);
    fwrite(corner, sizeof *corner, 3, g->bin);
  }
  return *triangle - from;
}

/* Writes an array of all these faces. Returns the number of its elements. */
static size_t write_array(struct glb *g, const struct faces *faces,
                          enum corner what, double lo[3], double hi[3]) {
  const struct hsr_world *world = faces->world;
  size_t n = 0, n_triangles = 0;
  uint32_t triangle = 0;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    const bool is_here =
        faces->colour == ALL_COLOURS || faces->colours->of[f] == faces->colour;
    if (what != TRIANGLES && is_here)
      write_corners(g, faces, what, f, lo, hi);
    else if (is_here)
      n_triangles += write_triangles(g, faces, f, &triangle, n);
    else
      while (triangle < faces->triangles->n_faces &&
             hsr_world_parent(faces->triangles, triangle) == f)
        triangle++;
    n += is_here ? hsr_face_size(world, f) : 0;
  }
  return what == TRIANGLES ? 3 * n_triangles : n;
}

/* Writes one array of the corners. Returns the number of its accessor. */
static json_int_t add_array(struct glb *g, const struct faces *faces,
                            enum corner what) {
  static const size_t width[] = {
      [POSITION] = 12, [FACE_NUMBER] = 4, [COLOUR] = 16, [TRIANGLES] = 4};
  static const char *const type[] = {[POSITION] = "VEC3",
                                     [FACE_NUMBER] = "SCALAR",
                                     [COLOUR] = "VEC4",
                                     [TRIANGLES] = "SCALAR"};
  double lo[3] = {INFINITY, INFINITY, INFINITY},
         hi[3] = {-INFINITY, -INFINITY, -INFINITY};
  const size_t n = write_array(g, faces, what, lo, hi);
  add_accessor(g, type[what], what == TRIANGLES ? UNSIGNED : FLOAT, n,
               width[what] * n,
               what == POSITION ? json_pack("{so so}", "min", numbers(lo, 3),
                                            "max", numbers(hi, 3))
                                : NULL);
  return (json_int_t)g->n_accessors - 1;
}

static json_t *primitive(struct glb *g, const struct faces *faces) {
  json_t *attributes =
      json_pack("{sI sI}", "POSITION", add_array(g, faces, POSITION), "_FACE",
                add_array(g, faces, FACE_NUMBER));
  if (faces->colour == ALL_COLOURS &&
      json_object_set_new(attributes, "COLOR_0",
                          json_integer(add_array(g, faces, COLOUR)))) {
    json_decref(attributes);
    attributes = NULL;
  }
  return json_pack("{so sI sI}", "attributes", attributes, "indices",
                   add_array(g, faces, TRIANGLES), "material",
                   (json_int_t)g->n_materials - 1);
}

/* Names of files may be no UTF-8, which JSON is. */
static json_t *name_of(const struct hsr_object *object) {
  json_t *name = json_string(object->name);
  return name ? name : json_string("object");
}

/* Whether a colour lets light through. Of many, whether one does. */
static bool is_blended(const struct hsr_colours *colours, uint32_t from,
                       uint32_t to) {
  bool is = false;
  for (uint32_t c = from; c < to; c++)
    is |= colours->rgba[4 * (size_t)c + 3] < 1;
  return is;
}

/* A material for each colour; of many colours, one for all, and the colours at
 * the corners. */
static json_t *add_primitives(struct glb *g, const struct hsr_object *object,
                              struct faces faces) {
  enum { MANY = 256 };
  static const float white[4] = {1, 1, 1, 1};
  const struct hsr_colours *colours = faces.colours;
  json_t *primitives = json_array();
  for (uint32_t c = 0; c < colours->n && colours->n <= MANY; c++) {
    faces.colour = c;
    add_material(g, object, colours->rgba + 4 * (size_t)c,
                 is_blended(colours, c, c + 1));
    hsr_json_append(&primitives, primitive(g, &faces));
  }
  if (colours->n > MANY) {
    faces.colour = ALL_COLOURS;
    add_material(g, object, white, is_blended(colours, 0, colours->n));
    hsr_json_append(&primitives, primitive(g, &faces));
  }
  return primitives;
}

/* An object, from its world and that of its triangles. */
static enum hsr_status add_world(struct glb *g, uint32_t number, bool is_turned,
                                 const struct hsr_world *world,
                                 const struct hsr_world *triangles,
                                 struct hsr_error *err) {
  const struct hsr_object *object = &g->scene->objects[number];
  struct hsr_colours colours;
  enum hsr_status status = hsr_colours_of(&colours, object, 1, err);
  const struct faces faces = {.world = world,
                              .triangles = triangles,
                              .colours = &colours,
                              .offset = g->offset[number],
                              .is_turned = is_turned};
  if (!status)
    hsr_json_append(&g->meshes,
                    json_pack("{so so}", "name", name_of(object), "primitives",
                              add_primitives(g, object, faces)));
  g->mesh[number][is_turned] = g->n_meshes++;
  hsr_json_append(&g->offsets, numbers(g->offset[number], 3));
  hsr_json_append(&g->same, json_integer(g->mesh[number][0]));
  hsr_colours_free(&colours);
  return status;
}

/* An object by itself as a world, in its own frame. */
static enum hsr_status add_mesh(struct glb *g, uint32_t number, bool is_turned,
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
  find_offset(object, g->frame.plain, g->offset[number], &g->change[number]);
  enum hsr_status status = hsr_world_init(&world, &alone, err);
  if (!status)
    status = hsr_world_triangulate(&world, &triangles, &changed, err);
  if (!status)
    status = add_world(g, number, is_turned, &world,
                       changed ? &triangles : &world, err);
  if (changed)
    hsr_world_free(&triangles);
  hsr_world_free(&world);
  return status;
}

/* --- Nodes ---------------------------------------------------------------- */

/* Whether an instance shows the backs of triangles in glTF, where a mirror turns
 * the winding: there the front stays the front. In hsr the corners tell. */
static bool is_turned(const struct hsr_scene *scene, uint32_t instance) {
  const struct hsr_instance *i = &scene->instances[instance];
  return scene->objects[i->object].one_sided && hsr_glb_mirrors(i->m);
}

/* The meshes of all objects, and then the turned ones. */
static enum hsr_status add_meshes(struct glb *g, struct hsr_error *err) {
  const struct hsr_scene *scene = g->scene;
  enum hsr_status status = HSR_OK;
  for (uint32_t o = 0; o < scene->n_objects && !status; o++) {
    g->mesh[o][0] = g->mesh[o][1] = NO_MESH;
    if (scene->objects[o].n_faces) /* a mesh must have something */
      status = add_mesh(g, o, false, err);
  }
  for (uint32_t i = 0; i < scene->n_instances && !status; i++) {
    const uint32_t o = scene->instances[i].object;
    if (is_turned(scene, i) && g->mesh[o][0] != NO_MESH &&
        g->mesh[o][1] == NO_MESH)
      status = add_mesh(g, o, true, err);
  }
  return status;
}

static void add_instances(struct glb *g) {
  const struct hsr_scene *scene = g->scene;
  json_int_t first = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const uint32_t o = scene->instances[i].object;
    const double *m = scene->instances[i].m;
    double matrix[16];
    hsr_glb_place(&g->frame, m, g->offset[o], matrix);
    if (scene->objects[o].n_faces)
      hsr_json_append(&g->nodes,
                      json_pack("{sI so s{sI sI}}", "mesh",
                                g->mesh[o][is_turned(scene, i)], "matrix",
                                numbers(matrix, 16), "extras", "instance",
                                (json_int_t)i, "first_face", first));
    hsr_json_append(&g->places, numbers(m, 12));
    first += scene->objects[o].n_faces;
  }
}

/* Eye, at, up, fov, near, parallel, light. */
static json_t *describe_view(const struct hsr_camera *camera) {
  double all[HSR_GLB_VIEW];
  memcpy(all, camera->eye, sizeof camera->eye);
  memcpy(all + 3, camera->at, sizeof camera->at);
  memcpy(all + 6, camera->up, sizeof camera->up);
  all[9] = camera->fov;
  all[10] = camera->near;
  all[11] = camera->parallel;
  memcpy(all + 12, camera->light, sizeof camera->light);
  return numbers(all, HSR_GLB_VIEW);
}

static void add_camera(struct glb *g, uint32_t number) {
  const struct hsr_camera *view = &g->scene->views[number];
  struct hsr_glb_camera camera;
  if (!hsr_glb_find_camera(&g->frame, view, &camera))
    return;
  hsr_json_append(
      &g->cameras,
      camera.is_parallel
          ? json_pack("{ss s{sf sf sf sf}}", "type", "orthographic",
                      "orthographic", "xmag", camera.size, "ymag", camera.size,
                      "znear", camera.near, "zfar", camera.far)
          : json_pack("{ss s{sf sf}}", "type", "perspective", "perspective",
                      "yfov", camera.size, "znear", camera.near));
  hsr_json_append(&g->nodes,
                  json_pack("{sI so}", "camera",
                            (json_int_t)json_array_size(g->cameras) - 1,
                            "matrix", numbers(camera.matrix, 16)));
  hsr_json_append(&g->eyes, describe_view(view));
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
      "{s{ss ss} s{sf sb so so so so} si s[{so}] so so so so so so s[{sI}]}",
      "asset", "version", "2.0", "generator", HSR_GLB_GENERATOR, "extras",
      "metres", g->frame.metres, "z_up", g->frame.z_up, "offsets", g->offsets,
      "same_mesh", g->same, "instances", g->places, "views", g->eyes, "scene",
      0, "scenes", "nodes", roots, "nodes", g->nodes, "meshes", g->meshes,
      "materials", g->materials, "cameras", g->cameras, "accessors",
      g->accessors, "bufferViews", g->views, "buffers", "byteLength",
      (json_int_t)g->bytes);
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

/* All that is written; the arrays are taken over. */
static enum hsr_status write_scene(struct glb *g, const char *path,
                                   struct hsr_error *err) {
  struct hsr_scene *scene = g->scene;
  enum hsr_status status = add_meshes(g, err);
  if (!status) {
    add_instances(g);
    for (uint32_t v = 0; v < scene->n_views; v++)
      add_camera(g, v);
    return write_file(g, path, err);
  }
  json_t *const array[] = {g->meshes, g->accessors, g->views,   g->materials,
                           g->nodes,  g->cameras,   g->offsets, g->same,
                           g->places, g->eyes};
  for (size_t k = 0; k < sizeof array / sizeof *array; k++)
    json_decref(array[k]);
  return status;
}

enum hsr_status hsr_scene_write_glb(struct hsr_scene *scene,
                                    struct hsr_glb_frame frame,
                                    const char *path, double *change,
                                    struct hsr_error *err) {
  enum hsr_status status = hsr_scene_make_faces(scene, err);
  if (status)
    return status;
  struct glb g = {.scene = scene,
                  .frame = frame,
                  .offset = calloc(scene->n_objects + 1u, sizeof *g.offset),
                  .change = calloc(scene->n_objects + 1u, sizeof *g.change),
                  .mesh = calloc(scene->n_objects + 1u, sizeof *g.mesh),
                  .bin = tmpfile()};
  if (!g.offset || !g.change || !g.mesh || (!g.bin && errno == ENOMEM))
    status = hsr_fail_nomem(err);
  else if (!g.bin)
    status =
        hsr_fail(err, HSR_E_INPUT, "%.200s: cannot be written: no room", path);
  if (!status) {
    g.meshes = json_array();
    g.accessors = json_array();
    g.views = json_array();
    g.materials = json_array();
    g.nodes = json_array();
    g.cameras = json_array();
    g.offsets = json_array();
    g.same = json_array();
    g.places = json_array();
    g.eyes = json_array();
    status = write_scene(&g, path, err);
    if (change)
      *change = largest_change(&g);
  }
  if (g.bin)
    fclose(g.bin);
  free(g.offset);
  free(g.change);
  free(g.mesh);
  return status;
}
