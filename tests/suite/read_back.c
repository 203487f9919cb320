/* SPDX-License-Identifier: GPL-3.0-or-later */
/* read_back DIR: what the files of a suite hold. Of each scene, the .obj, .ply
 * and .glb file are the same faces as the .scene.json file, in the same order. Of
 * each picture, the ids are those that an algorithm draws, which shares no code
 * with the oracle; depths and matrices agree with formulas of their own. */
#include "common/base/arena.h"
#include "common/files/cells/cells.h"
#include "common/files/json/scene_json.h"
#include "common/files/mesh/exchange.h"
#include "common/files/npy.h"
#include "common/files/whole_input.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static struct tap tap;
static const char *folder;
static struct hsr_error err;

static const char *path_of(const char *format, const char *name) {
  static char path[4096];
  const int n = snprintf(path, sizeof path, "%s/", folder);
  snprintf(path + n, sizeof path - (size_t)n, "%s%s", name, format);
  return path;
}

static const char *scene_path(const char *name, const char *suffix) {
  char all[300];
  snprintf(all, sizeof all, "scenes/%s%s", name, suffix);
  return path_of("", all);
}

static const char *right_path(const char *name, const char *suffix) {
  char all[300];
  snprintf(all, sizeof all, "right/%s%s", name, suffix);
  return path_of("", all);
}

static struct hsr_npy must_read(const char *path) {
  struct hsr_npy array;
  if (hsr_npy_read(path, &array, &err))
    bail("%s", err.text);
  return array;
}

/* --- Polygons ------------------------------------------------------------- */

static bool is_vertex(const struct hsr_mesh *mesh, uint32_t v,
                      const double x[3]) {
  return mesh->x[v] == x[0] && mesh->y[v] == x[1] && mesh->z[v] == x[2];
}

/* Whether a mesh file has the world's vertices and faces, number for number. Its
 * groups may be objects, which share the vertices. */
static bool is_same_mesh(const struct hsr_world *world, const char *path) {
  struct hsr_scene *scene = hsr_scene_new("read");
  struct hsr_import import = {.notes = ""};
  struct hsr_world read = {.n_faces = 0};
  const struct hsr_camera camera = {
      .eye = {0, 0, 1}, .up = {0, 1, 0}, .fov = 45};
  if (!scene || hsr_mesh_read(scene, path, &import, &err) ||
      hsr_scene_view(scene, &camera) || hsr_scene_finish(scene, &err) ||
      hsr_world_init(&read, scene, &err)) {
    printf("# %s\n", err.text);
    hsr_world_free(&read);
    hsr_scene_delete(scene);
    return false;
  }
  const struct hsr_mesh *got = &read.mesh, *mesh = &world->mesh;
  bool same = got->n_vertices == mesh->n_vertices &&
              read.n_faces == world->n_faces && !import.n_dropped;
  for (uint32_t v = 0; v < got->n_vertices && same; v++)
    same =
        is_vertex(mesh, v, (const double[]){got->x[v], got->y[v], got->z[v]});
  for (uint32_t f = 0; f <= read.n_faces && same; f++)
    same = got->start[f] == mesh->start[f];
  for (uint32_t k = 0; same && k < got->n_corners; k++)
    same = got->vertex[k] == mesh->vertex[k];
  hsr_world_free(&read);
  hsr_scene_delete(scene);
  return same;
}

/* Whether the property one_sided is the last byte of each face, after its colour,
 * if the scene has any, and, where faces are transparent, its opacity. */
static bool ply_tells_sides(const struct hsr_world *world, const char *path) {
  unsigned char *bytes;
  size_t size;
  if (hsr_whole_input(path, &bytes, &size, &err))
    return false;
  static const char end[] = "end_header\n";
  const unsigned char *at = (unsigned char *)strstr((char *)bytes, end);
  bool same = at != NULL;
  if (at)
    at += strlen(end) + 24 * (size_t)world->mesh.n_vertices;
  const struct hsr_scene *scene = world->roster.scene;
  const size_t look = hsr_scene_is_transparent(scene) ? 4
                      : hsr_scene_has_colours(scene)  ? 3
                                                      : 0;
  for (uint32_t f = 0; f < world->n_faces && same; f++) {
    at += 1 + 4 * (size_t)at[0] + look;
    same = at < bytes + size && *at == world->mesh.one_sided[f];
    at++;
  }
  same &= at == bytes + size;
  free(bytes);
  return same;
}

/* --- Triangles ------------------------------------------------------------ */

struct glb {
  unsigned char *bytes;
  const unsigned char *bin;
  json_t *json;
};

static uint32_t number_at(const unsigned char *at) {
  return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 |
         (uint32_t)at[3] << 24;
}

static float float_at(const unsigned char *at) {
  const uint32_t bits = number_at(at);
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

static bool open_glb(struct glb *glb, const char *path) {
  size_t size;
  glb->json = NULL;
  if (hsr_whole_input(path, &glb->bytes, &size, &err))
    return false;
  const uint32_t n = number_at(glb->bytes + 12);
  glb->json = json_loadb((const char *)glb->bytes + 20, n,
                         JSON_REJECT_DUPLICATES, NULL);
  glb->bin = glb->bytes + 20 + n + 8;
  return glb->json;
}

static size_t integer(const json_t *object, const char *key) {
  return (size_t)json_integer_value(json_object_get(object, key));
}

static const unsigned char *accessor(const struct glb *glb,
                                     const json_t *attributes, const char *name,
                                     size_t *count) {
  const json_t *a = json_array_get(json_object_get(glb->json, "accessors"),
                                   integer(attributes, name));
  const json_t *view = json_array_get(json_object_get(glb->json, "bufferViews"),
                                      integer(a, "bufferView"));
  *count = integer(a, "count");
  return glb->bin + integer(view, "byteOffset");
}

/* Whether a face has a corner that is this one, in floats. */
static bool has_corner(const struct hsr_world *world, uint32_t f,
                       const unsigned char *at) {
  const struct hsr_mesh *mesh = &world->mesh;
  for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++) {
    const uint32_t v = mesh->vertex[k];
    if ((float)mesh->x[v] == float_at(at) &&
        (float)mesh->y[v] == float_at(at + 4) &&
        (float)mesh->z[v] == float_at(at + 8))
      return true;
  }
  return false;
}

/* The triangles of one node; *k counts them. */
static bool are_triangles(const struct glb *glb, const json_t *node,
                          const struct hsr_world *world,
                          const struct hsr_npy *table, size_t *k) {
  const json_t *mesh = json_array_get(json_object_get(glb->json, "meshes"),
                                      integer(node, "mesh"));
  const size_t first = integer(json_object_get(node, "extras"), "first_face");
  const json_t *primitives = json_object_get(mesh, "primitives"), *p;
  size_t number, count;
  json_array_foreach(primitives, number, p) {
    const json_t *attributes = json_object_get(p, "attributes");
    const unsigned char *face = accessor(glb, attributes, "_FACE", &count);
    const unsigned char *place = accessor(glb, attributes, "POSITION", &count);
    const unsigned char *corner = accessor(glb, p, "indices", &count);
    const bool two_sided = json_is_true(
        json_object_get(json_array_get(json_object_get(glb->json, "materials"),
                                       integer(p, "material")),
                        "doubleSided"));
    for (size_t c = 0; c < count; c++) {
      if (*k + c / 3 >= hsr_npy_count(table))
        return false;
      const uint32_t f = ((const uint32_t *)table->data)[*k + c / 3];
      const size_t v = number_at(corner + 4 * c);
      if (f != first + (size_t)float_at(face + 4 * v) ||
          !has_corner(world, f, place + 12 * v) ||
          two_sided == world->mesh.one_sided[f])
        return false;
    }
    *k += count / 3;
  }
  return true;
}

/* A polygon of k corners has k - 2 triangles, and they come in the order of
 * faces. */
static bool is_table(const struct hsr_world *world,
                     const struct hsr_npy *table) {
  const uint32_t *face = table->data;
  const size_t n = hsr_npy_count(table);
  size_t k = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    for (uint32_t c = 2; c < hsr_face_size(world, f); c++, k++)
      if (k >= n || face[k] != f)
        return false;
  return k == n;
}

static bool is_same_glb(const struct hsr_world *world, const char *name) {
  struct hsr_npy table = must_read(scene_path(name, ".triangles.npy"));
  struct glb glb;
  size_t number, k = 0;
  bool same =
      is_table(world, &table) && open_glb(&glb, scene_path(name, ".glb"));
  if (same) {
    json_t *nodes = json_object_get(glb.json, "nodes"), *node;
    json_array_foreach(nodes, number, node) if (json_object_get(node, "mesh"))
        same &= are_triangles(&glb, node, world, &table, &k);
    same &= k == hsr_npy_count(&table);
    json_decref(glb.json);
    free(glb.bytes);
  }
  hsr_npy_free(&table);
  return same;
}

static bool has_sides(const struct hsr_world *world, const json_t *scene) {
  const json_t *runs = json_object_get(scene, "one_sided");
  for (uint32_t f = 0; f < world->n_faces; f++) {
    bool inside = false;
    for (size_t k = 0; k < json_array_size(runs); k++) {
      const json_t *run = json_array_get(runs, k);
      inside |= f >= json_integer_value(json_array_get(run, 0)) &&
                f < json_integer_value(json_array_get(run, 1));
    }
    if (inside != world->mesh.one_sided[f])
      return false;
  }
  return integer(scene, "faces") == world->n_faces &&
         integer(scene, "vertices") == world->mesh.n_vertices;
}

/* --- Pictures ------------------------------------------------------------- */

static void read_numbers(const json_t *array, int n, double *x) {
  for (int k = 0; k < n; k++)
    x[k] = json_number_value(json_array_get(array, (size_t)k));
}

static bool near_to(double a, double b, double size) {
  return fabs(a - b) <= 1e-9 * (1 + fabs(size));
}

/* Whether `rays` are the view's E, F, R, U to the last bit. */
static bool has_rays(const struct hsr_view *view, const json_t *case_) {
  const json_t *rays = json_object_get(case_, "rays");
  static const char *const name[] = {"E", "F", "R", "U"};
  const double *const axis[] = {view->E, view->F, view->R, view->U};
  double x[3];
  for (int k = 0; k < 4; k++) {
    read_numbers(json_object_get(rays, name[k]), 3, x);
    for (int c = 0; c < 3; c++)
      if (x[c] != axis[k][c])
        return false;
  }
  return json_is_true(json_object_get(rays, "parallel")) == view->parallel;
}

static void transform(const double m[16], const double in[4], double out[4]) {
  for (int r = 0; r < 4; r++) {
    out[r] = 0;
    for (int c = 0; c < 4; c++)
      out[r] += m[4 * c + r] * in[c];
  }
}

/* A point of the ray of column i and row j, at depth t, is at the middle of that
 * pixel for the matrix, and z runs from the near to the far plane. `down`: +1 if
 * y is down. */
static bool hits_middle(const struct hsr_view *view, const json_t *matrices,
                        bool parts, int down, double least_z) {
  double m[16], projection[16], p[4] = {0, 0, 0, 1}, clip[4], eye[4];
  read_numbers(json_object_get(matrices, parts ? "view" : "matrix"), 16, m);
  read_numbers(json_object_get(matrices, "projection"), 16, projection);
  const double near = json_number_value(json_object_get(matrices, "near")),
               far = json_number_value(json_object_get(matrices, "far"));
  for (int k = 0; k < 12; k++) {
    const int i = k * 7 % view->m, j = k * 5 % view->n;
    const double x = (2.0 * i + 1 - view->m) / view->m,
                 y = (view->n - 1 - 2.0 * j) / view->n;
    const double t = k % 3 == 0 ? near : k % 3 == 1 ? far : (near + far) / 2;
    const double across = view->parallel ? 1 : t;
    double size = 0;
    for (int c = 0; c < 3; c++) {
      p[c] = view->E[c] + t * view->F[c] +
             across * (x * view->R[c] + y * view->U[c]);
      size = fmax(size, fmax(fabs(p[c]), fabs(view->E[c])));
    }
    transform(m, p, clip);
    if (parts) {
      memcpy(eye, clip, sizeof eye);
      transform(projection, eye, clip);
    }
    /* What is lost by a camera that is far from the origin of the world. */
    const double lost = size / fmax(across, 1e-300);
    const double z = clip[2] / clip[3];
    if (!near_to(clip[0] / clip[3], x, lost) ||
        !near_to(clip[1] / clip[3], -down * y, lost) ||
        (k % 3 == 0 && !near_to(z, least_z, lost)) ||
        (k % 3 == 1 && !near_to(z, 1, lost)))
      return false;
  }
  return true;
}

static bool has_matrices(const struct hsr_view *view, const json_t *case_) {
  const json_t *opengl = json_object_get(case_, "opengl"),
               *vulkan = json_object_get(case_, "vulkan");
  return hits_middle(view, opengl, false, -1, -1) &&
         hits_middle(view, opengl, true, -1, -1) &&
         hits_middle(view, vulkan, false, 1, 0) &&
         hits_middle(view, vulkan, true, 1, 0);
}

/* By an algorithm: the oracle itself made the file. */
static bool has_ids(const struct hsr_world *world, const struct hsr_view *view,
                    const struct hsr_npy *ids) {
  const size_t n = (size_t)view->m * (size_t)view->n;
  uint32_t *drawn = malloc(n * sizeof *drawn);
  if (!drawn)
    bail("out of memory");
  draw_plain("raycast", world, view, drawn);
  const bool same =
      ids->kind == 'u' && ids->bytes == 4 && ids->n_dimensions == 2 &&
      ids->size[0] == (uint64_t)view->n && ids->size[1] == (uint64_t)view->m &&
      !memcmp(drawn, ids->data, n * sizeof *drawn);
  free(drawn);
  return same;
}

/* In long doubles, from Newell's normal about the face's first corner. */
static long double depth_of(const struct hsr_world *world,
                            const struct hsr_view *view, uint32_t f, int i,
                            int j, long double *slack) {
  const struct hsr_mesh *mesh = &world->mesh;
  const double *const axis[3] = {mesh->x, mesh->y, mesh->z};
  const uint32_t *v = mesh->vertex + mesh->start[f];
  const uint32_t n = hsr_face_size(world, f);
  const long double x = (2.0L * i + 1 - view->m) / view->m,
                    y = (view->n - 1 - 2.0L * j) / view->n;
  long double over = 0, under = 0, size = 0, steep = 0;
  for (int c = 0; c < 3; c++) {
    const double *a = axis[(c + 1) % 3], *b = axis[(c + 2) % 3];
    long double normal = 0, middle = 0;
    for (uint32_t k = 0; k < n; k++) {
      const uint32_t p = v[k], q = v[(k + 1) % n], o = v[0];
      normal += ((long double)a[p] - a[o]) * ((long double)b[q] - b[o]) -
                ((long double)b[p] - b[o]) * ((long double)a[q] - a[o]);
      middle += axis[c][v[k]];
    }
    const long double across = x * view->R[c] + y * view->U[c];
    const long double from = view->E[c] + (view->parallel ? across : 0),
                      along = view->F[c] + (view->parallel ? 0 : across);
    over += normal * (middle / n - from);
    under += normal * along;
    size += fabsl(normal) * (fabsl(middle / n) + fabsl(from));
    steep += fabsl(normal * along);
  }
  const long double t = over / under;
  *slack = 1e-15L * (size + fabsl(t) * steep) / fabsl(under);
  return t;
}

static bool has_depths(const struct hsr_world *world,
                       const struct hsr_view *view, const struct hsr_npy *ids,
                       const struct hsr_npy *depths) {
  const uint32_t *id = ids->data;
  const double *depth = depths->data;
  if (depths->kind != 'f' || depths->bytes != 8 ||
      depths->size[1] != (uint64_t)view->m)
    return false;
  for (int j = 0; j < view->n; j++)
    for (int i = 0; i < view->m; i++, id++, depth++) {
      long double slack;
      if (*id == HSR_BACKGROUND) {
        if (!(isinf(*depth) && *depth > 0))
          return false;
        continue;
      }
      const long double t = depth_of(world, view, *id, i, j, &slack);
      if (!(fabsl(t - *depth) <= slack + 2e-16L * fabsl(t)))
        return printf("# face %u at %d %d: %.17g, not %.17Lg\n", *id, i, j,
                      *depth, t) < 0;
    }
  return true;
}

static void check_case(const json_t *case_, const struct hsr_scene *scene,
                       const struct hsr_world *world) {
  const char *name = json_string_value(json_object_get(case_, "name"));
  const size_t view_number = integer(case_, "view");
  struct hsr_view view;
  must_view(&view, &scene->views[view_number - 1], (int)integer(case_, "width"),
            (int)integer(case_, "height"));
  struct hsr_npy ids = must_read(right_path(name, ".ids.npy")),
                 depths = must_read(right_path(name, ".depths.npy"));
  ok(&tap, has_rays(&view, case_), "%s: rays", name);
  ok(&tap, has_matrices(&view, case_), "%s: matrices", name);
  ok(&tap, has_ids(world, &view, &ids), "%s: ids", name);
  ok(&tap, has_depths(world, &view, &ids, &depths), "%s: depths", name);
  hsr_npy_free(&ids);
  hsr_npy_free(&depths);
}

static void check_scene(const json_t *about, const json_t *cases) {
  const char *name = json_string_value(json_object_get(about, "name"));
  struct hsr_scene *scene = hsr_scene_new(name);
  struct hsr_import import = {.notes = ""};
  struct hsr_world world;
  if (hsr_scene_json_read(scene, scene_path(name, ".scene.json"), &import,
                          &err))
    bail("%s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  ok(&tap, has_sides(&world, about), "%s: sides", name);
  ok(&tap, is_same_mesh(&world, scene_path(name, ".obj")), "%s.obj", name);
  ok(&tap, is_same_mesh(&world, scene_path(name, ".ply")), "%s.ply", name);
  ok(&tap, ply_tells_sides(&world, scene_path(name, ".ply")), "%s.ply: sides",
     name);
  ok(&tap, is_same_glb(&world, name), "%s.glb", name);
  for (size_t k = 0; k < json_array_size(cases); k++) {
    const json_t *case_ = json_array_get(cases, k);
    if (!strcmp(json_string_value(json_object_get(case_, "scene")), name))
      check_case(case_, scene, &world);
  }
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(int argc, char **argv) {
  if (argc != 2)
    bail("usage: read_back DIR");
  folder = argv[1];
  json_t *all = json_load_file(path_of("", "cases.json"), 0, NULL);
  const json_t *scenes = json_object_get(all, "scenes"),
               *cases = json_object_get(all, "cases");
  const size_t n = json_array_size(scenes);
  tap = plan((int)(5 * n + 4 * json_array_size(cases)));
  if (!n)
    bail("no scenes");
  for (size_t k = 0; k < n; k++)
    check_scene(json_array_get(scenes, k), cases);
  json_decref(all);
  return finish(&tap);
}
