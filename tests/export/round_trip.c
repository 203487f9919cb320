/* SPDX-License-Identifier: GPL-3.0-or-later */
/* round_trip SCENE FILE: what became of a scene in a file that hsr wrote of it
 * and read again. One line on stdout: the numbers of faces, objects, instances
 * and views, each "n" if it is kept and "n>m" if not; then, of the faces in
 * their order, "same", or the number of those that differ in the number of their
 * corners, in their names, colours, opacities, and sides; then the largest
 * change of a coordinate of a corner and of the box. If there are more faces than
 * before, they are compared with the triangles of those. "-": they are others even
 * so. */
#include "common/files/cells/cells.h"
#include "common/scene/pieces.h"
#include "scenes/scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct hsr_scene *open_scene(const char *name, struct hsr_world *world) {
  struct hsr_import import = {.notes = ""};
  struct hsr_scene *scene = NULL;
  struct hsr_error err;
  if (hsr_scene_open(name, &import, &scene, &err) ||
      hsr_world_init(world, scene, &err)) {
    fprintf(stderr, "%s: %s\n", name, err.text);
    exit(1);
  }
  fputs(import.notes, stderr);
  return scene;
}

static void print_count(uint32_t a, uint32_t b) {
  if (a == b)
    printf("%u ", a);
  else
    printf("%u>%u ", a, b);
}

/* Two places of a face. */
struct pair {
  const struct hsr_world *world[2];
  struct hsr_place place[2];
  uint32_t face;
};
typedef bool differ(const struct pair *pair);

static bool ring_differs(const struct pair *p) {
  return hsr_face_size(p->world[0], p->face) !=
         hsr_face_size(p->world[1], p->face);
}
static bool name_differs(const struct pair *p) {
  return strcmp(p->place[0].object->name, p->place[1].object->name);
}
static bool colour_differs(const struct pair *p) {
  return memcmp(hsr_face_rgb(p->place[0].object, p->place[0].face),
                hsr_face_rgb(p->place[1].object, p->place[1].face),
                3 * sizeof(float));
}
static bool opacity_differs(const struct pair *p) {
  return hsr_face_opacity(p->place[0].object, p->place[0].face) !=
         hsr_face_opacity(p->place[1].object, p->place[1].face);
}
static bool side_differs(const struct pair *p) {
  return p->place[0].object->one_sided != p->place[1].object->one_sided;
}

static void print_differing(const struct hsr_world *a,
                            const struct hsr_world *b, differ *differs) {
  uint32_t n = 0;
  if (a->n_faces != b->n_faces) {
    printf("- ");
    return;
  }
  for (uint32_t f = 0; f < a->n_faces; f++)
    n += differs(&(struct pair){
        {a, b},
        {hsr_place_of(a, hsr_world_parent(a, f)), hsr_place_of(b, f)},
        f});
  if (n)
    printf("%u ", n);
  else
    printf("same ");
}

static void corner_of(const struct hsr_mesh *mesh, uint32_t k, double p[3]) {
  const uint32_t v = mesh->vertex[k];
  p[0] = mesh->x[v];
  p[1] = mesh->y[v];
  p[2] = mesh->z[v];
}

static void print_change(const struct hsr_world *a, const struct hsr_world *b) {
  double most = 0, p[3], q[3];
  if (a->mesh.n_corners != b->mesh.n_corners) {
    printf("- ");
    return;
  }
  for (uint32_t k = 0; k < a->mesh.n_corners; k++) {
    corner_of(&a->mesh, k, p);
    corner_of(&b->mesh, k, q);
    for (int c = 0; c < 3; c++)
      most = fmax(most, fabs(p[c] - q[c]));
  }
  printf("%.2g ", most);
}

static void box_of(const struct hsr_world *world, double box[6]) {
  double p[3];
  for (uint32_t k = 0; k < world->mesh.n_corners; k++) {
    corner_of(&world->mesh, k, p);
    for (int c = 0; c < 3; c++) {
      box[c] = k ? fmin(box[c], p[c]) : p[c];
      box[3 + c] = k ? fmax(box[3 + c], p[c]) : p[c];
    }
  }
}

static void print_box(const struct hsr_world *a, const struct hsr_world *b) {
  double p[6], q[6], most = 0;
  box_of(a, p);
  box_of(b, q);
  for (int k = 0; k < 6; k++)
    most = fmax(most, fabs(p[k] - q[k]));
  printf("%.2g\n", most);
}

/* Views that are there twice count once. */
static void print_views(const struct hsr_scene *a, const struct hsr_scene *b) {
  uint32_t n = 0;
  for (uint32_t v = 0; v < a->n_views && v < b->n_views; v++)
    n += !memcmp(&a->views[v], &b->views[v], sizeof a->views[v]);
  print_count(a->n_views, n);
}

int main(int argc, char **argv) {
  struct hsr_world a, b, triangles;
  bool divided = false;
  if (argc != 3)
    return 2;
  struct hsr_scene *from = open_scene(argv[1], &a);
  struct hsr_scene *to = open_scene(argv[2], &b);
  print_count(a.n_faces, b.n_faces);
  print_count(from->n_objects, to->n_objects);
  print_count(from->n_instances, to->n_instances);
  print_views(from, to);
  if (a.n_faces < b.n_faces &&
      hsr_world_triangulate(&a, &triangles, &divided, NULL))
    return 1;
  const struct hsr_world *faces = divided ? &triangles : &a;
  differ *const all[] = {ring_differs, name_differs, colour_differs,
                         opacity_differs, side_differs};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++)
    print_differing(faces, &b, all[k]);
  print_change(faces, &b);
  print_box(&a, &b);
  if (divided)
    hsr_world_free(&triangles);
  hsr_world_free(&a);
  hsr_world_free(&b);
  hsr_scene_delete(from);
  hsr_scene_delete(to);
  return 0;
}
