/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What several threads import, lay out and prepare is what one does, to the last
 * bit: faces, planes, octrees, cells, BSP trees, and the counts of a frame. */
#include "bench/modules/modules.h"
#include "algorithms/engines/cubes/cubes.h"
#include "common/base/share.h"
#include "common/trees/bsp.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const int crews[] = {1, 2, 3, 7, 16};
enum { CREWS = sizeof crews / sizeof *crews, M = 61, ROWS = 47 };

/* Sheets of 1 to 60 x 60 quadrilaterals. Those of every third are not flat. */
static const char MANY[] = "many-objects";
enum { N_SHEETS = 150, LARGE = 60 };

static void add_sheet(struct hsr_object *object, int side, bool flat) {
  bool good = true;
  for (int k = 0; k < (side + 1) * (side + 1); k++) {
    int i = k % (side + 1), j = k / (side + 1);
    good &= !hsr_object_vertex(object, i, j, flat ? 0 : i * j % 7 / 3.0, NULL);
  }
  for (int k = 0; k < side * side; k++) {
    uint32_t v = (uint32_t)(k % side + k / side * (side + 1)),
             above = v + (uint32_t)side + 1;
    const uint32_t corner[] = {v, v + 1, above + 1, above};
    good &= !hsr_object_face(object, corner, 4, NULL);
  }
  if (!good)
    bail("%s: out of memory", MANY);
}

static struct hsr_scene *many_objects(int threads) {
  struct hsr_scene *scene = hsr_scene_new(MANY);
  for (int k = 0; k < N_SHEETS; k++) {
    const double m[12] = {1, 0,           0, k % 12 * 70, 0, 1,
                          0, k / 12 * 70, 0, 0,           1, k % 5};
    struct hsr_object *sheet = hsr_scene_object(scene, MANY);
    if (!sheet)
      bail("%s: out of memory", MANY);
    add_sheet(sheet, k % 50 == 49 ? LARGE : k % 23 + 1, k % 3 > 0);
    if (hsr_scene_instance(scene, (uint32_t)k, m))
      bail("%s: out of memory", MANY);
  }
  scene->threads = threads;
  must_finish(scene);
  return scene;
}

static struct hsr_scene *open_by(const char *name, int threads) {
  struct hsr_import import = {.threads = threads};
  struct hsr_scene *scene;
  struct hsr_error err = {.text = "out of memory"};
  if (strcmp(name, MANY) == 0)
    return many_objects(threads);
  if (hsr_scene_open(name, &import, &scene, &err))
    bail("%s: %s", name, err.text);
  return scene;
}

/* --- Scenes and worlds ---------------------------------------------------- */

static bool are_bytes(const void *a, const void *b, size_t n, size_t size) {
  return !n || !memcmp(a, b, n * size);
}

static bool same_objects(const struct hsr_scene *a, const struct hsr_scene *b) {
  bool same = a->n_objects == b->n_objects;
  for (uint32_t o = 0; o < a->n_objects && same; o++) {
    const struct hsr_object *x = &a->objects[o], *y = &b->objects[o];
    same = x->n_vertices == y->n_vertices && x->n_faces == y->n_faces &&
           x->one_sided == y->one_sided && !x->rgb == !y->rgb &&
           are_bytes(x->xyz, y->xyz, 3 * (size_t)x->n_vertices, 8) &&
           are_bytes(x->start, y->start, x->n_faces + (size_t)1, 4) &&
           are_bytes(x->vertex, y->vertex, x->start[x->n_faces], 4);
  }
  return same;
}

static bool same_worlds(const struct hsr_world *a, const struct hsr_world *b) {
  const struct hsr_mesh *x = &a->mesh, *y = &b->mesh;
  size_t f = a->n_faces, v = x->n_vertices, c = x->n_corners;
  return a->n_faces == b->n_faces && v == y->n_vertices && c == y->n_corners &&
         x->n_planes == y->n_planes && are_bytes(x->x, y->x, v, 8) &&
         are_bytes(x->y, y->y, v, 8) && are_bytes(x->z, y->z, v, 8) &&
         are_bytes(x->start, y->start, f + 1, 4) &&
         are_bytes(x->vertex, y->vertex, c, 4) &&
         are_bytes(x->nx, y->nx, f, 8) && are_bytes(x->ny, y->ny, f, 8) &&
         are_bytes(x->nz, y->nz, f, 8) &&
         are_bytes(x->n_error, y->n_error, f, 8) &&
         are_bytes(x->px, y->px, f, 8) && are_bytes(x->py, y->py, f, 8) &&
         are_bytes(x->pz, y->pz, f, 8) &&
         are_bytes(x->anchor_error, y->anchor_error, f, 8) &&
         are_bytes(x->deviation, y->deviation, f, 8) &&
         are_bytes(x->plane, y->plane, f, 4);
}

static void test_world(struct tap *tap, const char *name) {
  struct hsr_scene *one = open_by(name, 1);
  struct hsr_world wanted;
  bool same = !hsr_world_init(&wanted, one, NULL);
  for (int k = 1; k < CREWS; k++) {
    struct hsr_scene *scene = open_by(name, crews[k]);
    struct hsr_world got;
    same &= !hsr_world_init(&got, scene, NULL) && same_objects(one, scene) &&
            same_worlds(&wanted, &got);
    hsr_world_free(&got);
    hsr_scene_delete(scene);
  }
  ok(tap, same, "%.20s: %u faces in %u planes", name, wanted.n_faces,
     wanted.mesh.n_planes);
  hsr_world_free(&wanted);
  hsr_scene_delete(one);
}

/* --- Cubes ---------------------------------------------------------------- */

static bool same_octrees(const struct hsr_octree *a,
                         const struct hsr_octree *b) {
  return a->n_nodes == b->n_nodes && a->n_items == b->n_items &&
         are_bytes(a->node, b->node, a->n_nodes, sizeof *a->node) &&
         are_bytes(a->item, b->item, a->n_items, sizeof *a->item);
}

static bool same_cells(const struct hsr_cubes_object *a,
                       const struct hsr_cubes_object *b) {
  bool same = same_octrees(&a->octree, &b->octree);
  for (uint32_t k = 0; k < a->octree.n_nodes && same; k++) {
    const struct hsr_cell *x = &a->cell[k], *y = &b->cell[k];
    const uint32_t *start = a->start + x->first_start;
    same = !memcmp(x, y, sizeof *x) &&
           are_bytes(a->face + x->first_face, b->face + y->first_face,
                     x->n_faces, 4) &&
           are_bytes(start, b->start + y->first_start, x->n_faces + (size_t)1,
                     4) &&
           are_bytes(a->vertex + x->first_corner, b->vertex + y->first_corner,
                     start[x->n_faces], 4) &&
           are_bytes(a->x + x->first_vertex, b->x + y->first_vertex,
                     x->n_vertices, 8) &&
           are_bytes(a->y + x->first_vertex, b->y + y->first_vertex,
                     x->n_vertices, 8) &&
           are_bytes(a->z + x->first_vertex, b->z + y->first_vertex,
                     x->n_vertices, 8);
  }
  return same;
}

static void make_cubes(const char *name, int threads, struct hsr_scene **scene,
                       struct hsr_world *world, struct hsr_cubes *cubes) {
  static const struct hsr_octree_rule rule = {0.1, 20, 20};
  struct hsr_error err = {.text = "out of memory"};
  *scene = open_by(name, threads);
  must_roster(world, *scene);
  if (hsr_cubes_init(cubes, world, &rule, &err))
    bail("%s: %s", name, err.text);
}

static void test_cubes(struct tap *tap, const char *name) {
  struct hsr_scene *one, *scene;
  struct hsr_world world, of_many;
  struct hsr_cubes wanted, got;
  make_cubes(name, 1, &one, &world, &wanted);
  bool same = true;
  for (int k = 1; k < CREWS; k++) {
    make_cubes(name, crews[k], &scene, &of_many, &got);
    same &= same_octrees(&wanted.octree, &got.octree) &&
            wanted.most_faces == got.most_faces &&
            wanted.most_vertices == got.most_vertices &&
            wanted.most_corners == got.most_corners &&
            wanted.most_object_faces == got.most_object_faces &&
            same_worlds(&wanted.loose, &got.loose);
    for (uint32_t o = 0; o < one->n_objects; o++)
      same &= same_cells(&wanted.object[o], &got.object[o]) &&
              wanted.object[o].n_loose == got.object[o].n_loose &&
              are_bytes(wanted.object[o].is_loose, got.object[o].is_loose,
                        one->objects[o].n_faces, sizeof(bool));
    hsr_cubes_free(&got);
    hsr_world_free(&of_many);
    hsr_scene_delete(scene);
  }
  ok(tap, same, "cubes of %s, %u in the first object", name,
     wanted.object[0].octree.n_nodes);
  hsr_cubes_free(&wanted);
  hsr_world_free(&world);
  hsr_scene_delete(one);
}

/* --- BSP trees ------------------------------------------------------------ */

static bool same_trees(const struct hsr_bsp *a, const struct hsr_bsp *b) {
  return a->n_cubes == b->n_cubes && a->n_nodes == b->n_nodes &&
         a->n_pieces == b->n_pieces && a->n_corners == b->n_corners &&
         a->n_cuts == b->n_cuts && a->n_points == b->n_points &&
         a->n_medians == b->n_medians && a->n_loose == b->n_loose &&
         a->most_depth == b->most_depth &&
         are_bytes(a->cube, b->cube, a->n_cubes, sizeof *a->cube) &&
         are_bytes(a->node, b->node, a->n_nodes, sizeof *a->node) &&
         are_bytes(a->piece, b->piece, a->n_pieces, sizeof *a->piece) &&
         are_bytes(a->corner, b->corner, a->n_corners, sizeof *a->corner) &&
         are_bytes(a->cut, b->cut, a->n_cuts, sizeof *a->cut) &&
         are_bytes(a->x, b->x, a->n_points, 8) &&
         are_bytes(a->y, b->y, a->n_points, 8) &&
         are_bytes(a->z, b->z, a->n_points, 8) &&
         are_bytes(a->error, b->error, a->n_points, 8) &&
         are_bytes(a->loose, b->loose, a->n_loose, 4);
}

static void make_trees(const char *name, uint32_t most, int threads,
                       struct hsr_scene **scene, struct hsr_world *world,
                       struct hsr_bsp *bsp) {
  struct hsr_bsp_rule rule = {.most = most};
  struct hsr_error err = {.text = "out of memory"};
  *scene = open_by(name, threads);
  must_world(world, *scene);
  if (hsr_bsp_init(bsp, world, &rule, &err))
    bail("%s: %s", name, err.text);
}

/* The faces of the scene are convex. */
static void test_trees(struct tap *tap, const char *name, uint32_t most) {
  struct hsr_scene *one, *scene;
  struct hsr_world world, of_many;
  struct hsr_bsp wanted, got;
  make_trees(name, most, 1, &one, &world, &wanted);
  bool same = true;
  for (int k = 1; k < CREWS; k++) {
    make_trees(name, most, crews[k], &scene, &of_many, &got);
    same &= same_trees(&wanted, &got);
    hsr_bsp_free(&got);
    hsr_world_free(&of_many);
    hsr_scene_delete(scene);
  }
  ok(tap, same, "trees of %s: %u cubes, %u nodes, %u pieces, %u loose", name,
     wanted.n_cubes, wanted.n_nodes, wanted.n_pieces, wanted.n_loose);
  hsr_bsp_free(&wanted);
  hsr_world_free(&world);
  hsr_scene_delete(one);
}

/* --- Frames --------------------------------------------------------------- */

static void draw(const char *name, const char *algorithm, int threads,
                 uint32_t *ids, struct hsr_tally *tally) {
  const struct hsr_algorithm *a = hsr_algorithm_find(algorithm)->counting;
  struct hsr_scene *scene = open_by(name, threads);
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_setup_world(&world, a, NULL, scene, &err) ||
      hsr_view_init_of(&view, scene, 0, M, ROWS, &err))
    bail("%s: %s", name, err.text);
  memset(tally, 0, sizeof *tally);
  draw_ids(a, &world, &view, ids, tally);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

static void test_frame(struct tap *tap, const char *name,
                       const char *algorithm) {
  static uint32_t wanted[M * ROWS], got[M * ROWS];
  struct hsr_tally tally, other;
  draw(name, algorithm, 1, wanted, &tally);
  bool same = true;
  for (int k = 1; k < CREWS; k++) {
    draw(name, algorithm, crews[k], got, &other);
    same &= !memcmp(wanted, got, sizeof got) &&
            !memcmp(tally.count, other.count, sizeof tally.count) &&
            tally.depths_compared == other.depths_compared;
  }
  ok(tap, same, "%s draws %s and counts alike", algorithm, name);
}

/* --- Files ---------------------------------------------------------------- */

enum { SIDE = 90 };

/* A bent sheet of triangles and quadrilaterals; and another line, which is one of
 * its faces if `more` is 1. */
static void write_off(const char *path, int more, const char *odd) {
  FILE *file = fopen(path, "w");
  if (!file)
    bail("%s: cannot be written", path);
  fprintf(file, "OFF\n%d %d 0\n", SIDE * SIDE, (SIDE - 1) * (SIDE - 1) + more);
  for (int k = 0; k < SIDE * SIDE; k++)
    fprintf(file, "%d.25 %.17g -%de-1\n", k % SIDE, k % 7 / 3.0, k / SIDE);
  for (int k = 0; k < (SIDE - 1) * (SIDE - 1); k++) {
    int v = k / (SIDE - 1) * SIDE + k % (SIDE - 1);
    if (k % 3)
      fprintf(file, "3 %d %d %d\n", v, v + 1, v + SIDE);
    else
      fprintf(file, "4 %d %d %d %d\n", v, v + 1, v + SIDE + 1, v + SIDE);
  }
  fprintf(file, "%s", odd);
  if (fclose(file))
    bail("%s: cannot be written", path);
}

/* The line that refuses a file, by so many threads. */
static void refuse(const char *path, int threads, struct hsr_error *err) {
  struct hsr_import import = {.threads = threads, .strict = true};
  struct hsr_scene *scene;
  if (!hsr_scene_open(path, &import, &scene, err))
    bail("%s: was not refused", path);
}

/* By any number of threads it is refused with its last line's number. */
static void test_bad_off(struct tap *tap, const char *path, int more,
                         const char *line, const char *words) {
  struct hsr_error err[CREWS];
  char number[32];
  snprintf(number, sizeof number,
           ":%d:", 2 + SIDE * SIDE + (SIDE - 1) * (SIDE - 1) + 1);
  bool same = true;
  write_off(path, more, line);
  for (int k = 0; k < CREWS; k++) {
    refuse(path, crews[k], &err[k]);
    same &= !strcmp(err[k].text, err[0].text);
  }
  ok(tap, same && strstr(err[0].text, words) && strstr(err[0].text, number),
     "refused in the same words: %s", strrchr(err[0].text, '/'));
}

static void test_off(struct tap *tap) {
  char folder[] = "/tmp/hsr-prepare-XXXXXX";
  char plain[64], odd[64], bad[64];
  if (!mkdtemp(folder))
    bail("%s: cannot be made", folder);
  snprintf(plain, sizeof plain, "%s/a.off", folder);
  snprintf(odd, sizeof odd, "%s/b.off", folder);
  snprintf(bad, sizeof bad, "%s/c.off", folder);
  write_off(plain, 0, "");
  write_off(odd, 0, "# the end\n");
  test_world(tap, plain);
  struct hsr_scene *by_lines = open_by(odd, 1), *by_blocks = open_by(plain, 3);
  ok(tap, same_objects(by_lines, by_blocks),
     "a plain .off file is read as one with a comment is");
  hsr_scene_delete(by_lines);
  hsr_scene_delete(by_blocks);
  test_bad_off(tap, bad, 0, "3 0 1 2\n", "goes on after the last");
  test_bad_off(tap, bad, 1, "3 5 6 5\n", "has the same vertex twice");
  test_bad_off(tap, bad, 1, "3 5 6 8100\n", "names vertex 8100 of 8100");
  test_bad_off(tap, bad, 1, "2 5 6\n", "has fewer than 3 vertices");
  unlink(plain);
  unlink(odd);
  unlink(bad);
  rmdir(folder);
}

int main(void) {
  struct tap tap = plan(6 + 5 + 5 + 6 + 6);
  test_off(&tap);
  test_world(&tap, "sphere:30000");
  test_world(&tap, "soup:20000:3");
  test_world(&tap, "office:1");
  test_world(&tap, "checker-cube:40");
  test_world(&tap, MANY);
  test_cubes(&tap, "sphere:30000");
  test_cubes(&tap, "soup:20000:3");
  test_cubes(&tap, "harbor");
  test_cubes(&tap, "office:1");
  test_cubes(&tap, MANY);
  test_trees(&tap, "terrain:128", 0);
  test_trees(&tap, "terrain", 30);
  test_trees(&tap, "soup:1500:3", 0);
  test_trees(&tap, "soup:3000:3", 30);
  test_trees(&tap, "twist:60", 0);
  test_trees(&tap, "sphere:3000", 0);
  test_frame(&tap, "sphere:30000", "hzbuffer");
  test_frame(&tap, "sphere:30000", "clark");
  test_frame(&tap, "soup:5000:3", "octree-raycast");
  test_frame(&tap, "soup:5000:3", "zbuffer-fast");
  test_frame(&tap, "harbor", "hzbuffer");
  test_frame(&tap, "office:1", "clark");
  return finish(&tap);
}
