/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws figures 3.4, 3.6 and 3.7 of N. Greene's thesis (UC Santa Cruz, 1995), and
 * the panels of figure 1 of 1993, of other scenes; and counts an octree:
 *
 *   pyramid SCENE VIEW FILE   a z-pyramid, the nearest bright: the finest level
 *                             at the left, each coarser one above the next
 *   exposed SCENE VIEW FILE   the view after VIEW, by coherence=passes; what is
 *                             tiled in the second pass only is magenta
 *   above SCENE VIEW FILE     from above, as .svg: the frustum, and the cubes
 *                             visited: visible blue, hidden red, outside grey
 *
 *   octree SCENE VIEW FILE    how many faces the leaves of each object's octree
 *                             hold, as text (3.5)
 *
 *   culled SCENE VIEW FILE    by cubes=entry, as in 1993: which share of the faces
 *                             in culled cubes the pyramid culls, and which share
 *                             the scan conversion of sides, as text
 *
 *   work SCENE VIEW FILE ALGORITHM COUNTER...
 *                             where an algorithm raises these counters: each
 *                             step adds 1, shared out over its pixels
 *
 * usage: figures WHAT SCENE VIEW FILE ...      VIEW from 1; reports/greene/make */
#include "algorithms/engines/cubes/cubes.h"
#include "bench/modules/variant.h"
#include "common/answers/filter.h"
#include "common/files/image.h"
#include "scenes/scenes.h"
#include "tests/draw.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 512, SAMPLES = SIDE * SIDE };

static void stop(const char *text) {
  fprintf(stderr, "figures: %s\n", text);
  exit(1);
}

static struct hsr_view view_of(const struct both_worlds *worlds, uint32_t k) {
  struct hsr_error err = {.text = "no such view"};
  struct hsr_view view = {.m = 0};
  if (k >= worlds->scene->n_views ||
      hsr_view_init(&view, &worlds->scene->views[k], SIDE, SIDE, &err))
    stop(err.text);
  return view;
}

static void write_picture(const char *path, int m, int n, const float *rgb) {
  struct hsr_error err = {.text = "cannot be written"};
  struct hsr_picture picture = {.m = m, .n = n, .rgb = rgb};
  if (hsr_image_write(path, &picture, NULL, &err))
    stop(err.text);
}

/* One frame of a prepared variant; `listen` may be NULL. */
static void draw(struct hsr_setup *setup, const struct hsr_view *view,
                 uint32_t *ids,
                 void (*listen)(void *, const struct hsr_event *),
                 void *context) {
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_trace trace = {.listen = listen, .context = context};
  struct hsr_tally tally = {.trace = listen ? &trace : NULL};
  struct hsr_answer answer = hsr_answer_of_ids(ids, SIDE, SIDE);
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = &tally, .answer = &answer};
  if (hsr_setup_render(setup, &job, &err))
    stop(err.text);
  hsr_arena_free(&scratch);
}

static void prepare(struct hsr_setup *setup, const char *variant,
                    const struct hsr_world *world) {
  static struct hsr_variant parsed;
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_variant_parse(variant, &parsed, &err) ||
      hsr_setup_init(setup, parsed.listed->counting, &parsed.choice, world,
                     &err))
    stop(err.text);
}

static int number_of(const struct hsr_algorithm *a, const char *counter) {
  int k = 0;
  while (a->counters[k].name && strcmp(a->counters[k].name, counter) != 0)
    k++;
  if (!a->counters[k].name)
    stop("no such counter");
  return k;
}

/* --- 3.4 ------------------------------------------------------------------ */

/* The farthest of 2 x 2. */
static void coarsen(const float *fine, int side, float *coarse) {
  for (int j = 0; j < side / 2; j++)
    for (int i = 0; i < side / 2; i++) {
      const float *at = fine + 2 * j * side + 2 * i;
      coarse[j * side / 2 + i] =
          fmaxf(fmaxf(at[0], at[1]), fmaxf(at[side], at[side + 1]));
    }
}

static void paint_level(const float *depth, int side, int x, int y, int m,
                        double nearest, double range, float *rgb) {
  for (int k = 0; k < side * side; k++) {
    double z = depth[k];
    float grey = z < INFINITY ? (float)(1 - 0.9 * log(z / nearest) / range) : 0;
    for (int c = 0; c < 3; c++)
      rgb[3 * ((y + k / side) * m + x + k % side) + c] = grey * grey;
  }
}

static void draw_pyramid(const struct both_worlds *worlds, uint32_t k,
                         const char *path) {
  enum { M = SIDE + SIDE / 2 };
  struct hsr_view view = view_of(worlds, k);
  struct hsr_setup setup;
  struct hsr_error err = {.text = "out of memory"};
  uint32_t *ids = malloc(SAMPLES * sizeof *ids);
  float *depth = malloc(2 * SAMPLES * sizeof *depth);
  float *rgb = calloc(3 * (size_t)M * SIDE, sizeof *rgb);
  if (!ids || !depth || !rgb)
    stop("out of memory");
  prepare(&setup, "hzbuffer", &worlds->roster);
  draw(&setup, &view, ids, NULL, NULL);
  if (hsr_picture_finish(&worlds->roster, &view, ids, HSR_SHADE_LAMBERT, depth,
                         NULL, &err))
    stop(err.text);
  double nearest = INFINITY, farthest = 0;
  for (int s = 0; s < SAMPLES; s++) {
    nearest = fmin(nearest, depth[s]);
    farthest = depth[s] < INFINITY ? fmax(farthest, depth[s]) : farthest;
  }
  double range = log(farthest / nearest);
  float *level = depth;
  paint_level(level, SIDE, 0, 0, M, nearest, range, rgb);
  for (int side = SIDE / 2, y = 0; side; y += side, side /= 2) {
    coarsen(level, 2 * side, level + 4 * side * side);
    level += 4 * side * side;
    paint_level(level, side, SIDE, y, M, nearest, range, rgb);
  }
  write_picture(path, M, SIDE, rgb);
  hsr_setup_free(&setup);
  free(ids);
  free(depth);
  free(rgb);
}

/* --- 3.6 ------------------------------------------------------------------ */

struct passes {
  int nodes, writes;
  bool second;
  bool *late; /* a sample: written last in the second pass */
  long n;
};

/* The second pass begins with the first node that is visited. */
static void note_pass(void *context, const struct hsr_event *event) {
  struct passes *p = context;
  p->second |= event->counter == p->nodes;
  if (event->counter == p->writes)
    p->late[event->window.y0 * SIDE + event->window.x0] = p->second;
}

static void draw_exposed(const struct both_worlds *worlds, uint32_t k,
                         const char *path) {
  static const float magenta[3] = {1, 0, 1};
  struct hsr_view before = view_of(worlds, k), view = view_of(worlds, k + 1);
  struct hsr_setup setup;
  struct hsr_error err = {.text = "out of memory"};
  uint32_t *ids = malloc(SAMPLES * sizeof *ids);
  float *rgb = malloc(3 * SAMPLES * sizeof *rgb);
  struct passes passes = {.late = calloc(SAMPLES, sizeof(bool))};
  if (!ids || !rgb || !passes.late)
    stop("out of memory");
  prepare(&setup, "hzbuffer:coherence=passes", &worlds->roster);
  passes.nodes = number_of(setup.algorithm, "nodes visited");
  passes.writes = number_of(setup.algorithm, "writes");
  draw(&setup, &before, ids, NULL, NULL);
  draw(&setup, &view, ids, note_pass, &passes);
  if (hsr_picture_finish(&worlds->roster, &view, ids, HSR_SHADE_LAMBERT, NULL,
                         rgb, &err))
    stop(err.text);
  for (int s = 0; s < SAMPLES; s++)
    if (passes.late[s]) {
      memcpy(rgb + 3 * s, magenta, sizeof magenta);
      passes.n++;
    }
  printf("%.2f %% of the samples are of faces that came into view\n",
         100.0 * (double)passes.n / SAMPLES);
  write_picture(path, SIDE, SIDE, rgb);
  hsr_setup_free(&setup);
  free(ids);
  free(rgb);
  free(passes.late);
}

/* The standard octree of hzbuffer. */
static const struct hsr_octree_rule rule = {
    .small = 0.1, .most = 20, .least = 20};

/* --- 3.7 ------------------------------------------------------------------ */

struct map {
  FILE *out;
  const struct hsr_cubes *cubes;
  int visible, culled, outside;
  long n[3];
};

/* A cube from above, with x to the right and z downwards. */
static void draw_cube(struct map *map, const struct hsr_subject *cube,
                      int what) {
  static const char *const colour[3] = {"#2050c0", "#d03020", "#b0b0b0"};
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  uint32_t node = cube->id[0], i = cube->id[1];
  const struct hsr_scene *scene = map->cubes->scene;
  const struct hsr_octree_node *at =
      i == HSR_NO_ID
          ? &map->cubes->octree.node[node]
          : &map->cubes->object[scene->instances[i].object].octree.node[node];
  double centre[3];
  hsr_instance_vertex(i == HSR_NO_ID ? identity : scene->instances[i].m,
                      at->centre, centre);
  map->n[what]++;
  fprintf(map->out,
          "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" "
          "stroke=\"%s\"/>\n",
          centre[0] - at->half, centre[2] - at->half, 2 * at->half,
          2 * at->half, colour[what]);
}

static void note_cube(void *context, const struct hsr_event *event) {
  struct map *map = context;
  if (event->counter == map->visible)
    draw_cube(map, &event->a, 0);
  else if (event->counter == map->culled)
    draw_cube(map, &event->a, 1);
  else if (event->counter == map->outside)
    draw_cube(map, &event->a, 2);
}

/* The sides of the frustum, as far as the root cube is wide. */
static void draw_frustum(const struct map *map, const struct hsr_view *view) {
  double far = 4 * map->cubes->octree.node[0].half, x[2], z[2];
  for (int k = 0; k < 2; k++) {
    double side = k ? 1 : -1, d[3];
    for (int a = 0; a < 3; a++)
      d[a] = view->F[a] + side * view->R[a];
    double length = hypot(d[0], d[2]);
    x[k] = view->E[0] + far * d[0] / length;
    z[k] = view->E[2] + far * d[2] / length;
  }
  fprintf(map->out,
          "<path d=\"M %g %g L %g %g L %g %g\" fill=\"none\" stroke=\"black\" "
          "stroke-width=\"2\"/>\n",
          x[0], z[0], view->E[0], view->E[2], x[1], z[1]);
}

static void draw_above(const struct both_worlds *worlds, uint32_t k,
                       const char *path) {
  struct hsr_view view = view_of(worlds, k);
  struct hsr_setup setup;
  struct hsr_cubes cubes;
  struct hsr_error err = {.text = "out of memory"};
  uint32_t *ids = malloc(SAMPLES * sizeof *ids);
  struct map map = {.out = fopen(path, "w"), .cubes = &cubes};
  if (!ids || !map.out || hsr_cubes_init(&cubes, &worlds->roster, &rule, &err))
    stop(map.out ? err.text : path);
  prepare(&setup, "hzbuffer", &worlds->roster);
  map.visible = number_of(setup.algorithm, "cubes visible");
  map.culled = number_of(setup.algorithm, "cubes culled");
  map.outside = number_of(setup.algorithm, "nodes out");
  const struct hsr_octree_node *root = &cubes.octree.node[0];
  fprintf(map.out,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" "
          "height=\"900\" viewBox=\"%g %g %g %g\" stroke-width=\"%g\">\n"
          "<rect x=\"%g\" y=\"%g\" width=\"100%%\" height=\"100%%\" "
          "fill=\"white\"/>\n",
          root->centre[0] - root->half, root->centre[2] - root->half,
          2 * root->half, 2 * root->half, root->half / 900,
          root->centre[0] - root->half, root->centre[2] - root->half);
  draw(&setup, &view, ids, note_cube, &map);
  draw_frustum(&map, &view);
  fprintf(map.out, "</svg>\n");
  if (fclose(map.out))
    stop(path);
  printf("%ld cubes are visible, %ld hidden, %ld outside\n", map.n[0], map.n[1],
         map.n[2]);
  hsr_setup_free(&setup);
  hsr_cubes_free(&cubes);
  free(ids);
}

/* --- The octree, 3.5 ------------------------------------------------------ */

static void count_octree(FILE *out, const struct hsr_cubes *cubes, uint32_t o) {
  const struct hsr_cubes_object *object = &cubes->object[o];
  uint32_t leaves = 0, least = UINT32_MAX, most = 0;
  uint64_t in_leaves = 0, in_all = 0, faces = 0;
  for (uint32_t k = 0; k < object->octree.n_nodes; k++) {
    uint32_t n = object->cell[k].n_faces;
    in_all += n;
    if (!hsr_octree_is_leaf(&object->octree.node[k]))
      continue;
    leaves++;
    in_leaves += n;
    least = n < least ? n : least;
    most = n > most ? n : most;
  }
  bool *met = calloc(cubes->most_object_faces, sizeof *met);
  if (!met)
    stop("out of memory");
  for (uint64_t k = 0; k < in_all; k++) {
    faces += !met[object->face[k]];
    met[object->face[k]] = true;
  }
  free(met);
  fprintf(out,
          "%llu faces, %u nodes, %u leaves of %u to %u faces, %.1f in the "
          "mean; a face is in %.2f nodes\n",
          (unsigned long long)faces, object->octree.n_nodes, leaves, least,
          most, (double)in_leaves / leaves, (double)in_all / (double)faces);
}

static void count_octrees(const struct both_worlds *worlds, const char *path) {
  struct hsr_cubes cubes;
  struct hsr_error err = {.text = "out of memory"};
  FILE *out = fopen(path, "w");
  if (!out || hsr_cubes_init(&cubes, &worlds->roster, &rule, &err))
    stop(out ? err.text : path);
  for (uint32_t k = 0; k < worlds->scene->n_objects; k++)
    count_octree(out, &cubes, k);
  if (fclose(out))
    stop(path);
  hsr_cubes_free(&cubes);
}

/* --- What culls, 1993, section 4 ------------------------------------------ */

struct culling {
  const struct hsr_cubes *cubes;
  int sides, culled;
  struct hsr_subject scanned; /* the last cube of which a side was scanned */
  uint64_t cubes_by[2], faces_by[2]; /* the pyramid; sides */
};

/* Faces in the cells below a node. A face counts in every cell that it is in. */
static uint64_t faces_below(const struct hsr_cubes_object *object, uint32_t k) {
  const struct hsr_octree_node *node = &object->octree.node[k];
  uint64_t n = object->cell[k].n_faces;
  for (int o = 0; o < 8; o++)
    n +=
        node->child[o] == HSR_NO_NODE ? 0 : faces_below(object, node->child[o]);
  return n;
}

static uint64_t faces_of_instances(const struct hsr_cubes *cubes, uint32_t k) {
  const struct hsr_octree_node *node = &cubes->octree.node[k];
  uint64_t n = 0;
  for (uint32_t i = 0; i < node->n; i++) {
    uint32_t item = cubes->octree.item[node->first + i];
    uint32_t instance = cubes->still ? cubes->still[item] : item;
    n += faces_below(&cubes->object[cubes->scene->instances[instance].object],
                     0);
  }
  for (int o = 0; o < 8; o++)
    n += node->child[o] == HSR_NO_NODE
             ? 0
             : faces_of_instances(cubes, node->child[o]);
  return n;
}

static void note_culling(void *context, const struct hsr_event *event) {
  struct culling *c = context;
  const uint32_t *id = event->a.id;
  if (event->counter == c->sides)
    c->scanned = event->a;
  if (event->counter != c->culled)
    return;
  int by = c->scanned.id[0] == id[0] && c->scanned.id[1] == id[1];
  c->cubes_by[by]++;
  c->faces_by[by] +=
      id[1] == HSR_NO_ID
          ? faces_of_instances(c->cubes, id[0])
          : faces_below(
                &c->cubes->object[c->cubes->scene->instances[id[1]].object],
                id[0]);
}

static void count_culling(const struct both_worlds *worlds, uint32_t k,
                          const char *path) {
  struct hsr_view view = view_of(worlds, k);
  struct hsr_setup setup;
  struct hsr_cubes cubes;
  struct hsr_error err = {.text = "out of memory"};
  uint32_t *ids = malloc(SAMPLES * sizeof *ids);
  FILE *out = fopen(path, "w");
  if (!ids || !out || hsr_cubes_init(&cubes, &worlds->roster, &rule, &err))
    stop(out ? err.text : path);
  prepare(&setup, "hzbuffer:cubes=entry", &worlds->roster);
  struct culling c = {.cubes = &cubes,
                      .sides = number_of(setup.algorithm, "sides scanned"),
                      .culled = number_of(setup.algorithm, "cubes culled"),
                      .scanned = HSR_CELL(HSR_NO_NODE, 0, 0)};
  draw(&setup, &view, ids, note_culling, &c);
  double all = (double)(c.faces_by[0] + c.faces_by[1]);
  fprintf(out,
          "the pyramid: %llu cubes, %.1f %% of the faces in culled cubes; "
          "sides: %llu cubes, %.1f %%\n",
          (unsigned long long)c.cubes_by[0], 100 * (double)c.faces_by[0] / all,
          (unsigned long long)c.cubes_by[1], 100 * (double)c.faces_by[1] / all);
  if (fclose(out))
    stop(path);
  hsr_setup_free(&setup);
  hsr_cubes_free(&cubes);
  free(ids);
}

/* --- Work ----------------------------------------------------------------- */

struct work {
  bool shown[HSR_MAX_COUNTERS];
  int side;  /* samples along a side of a pixel */
  float *at; /* a pixel */
};

static void note_work(void *context, const struct hsr_event *event) {
  struct work *work = context;
  const struct hsr_window *w = &event->window;
  if (!work->shown[event->counter])
    return;
  int x0 = w->x0 / work->side, x1 = w->x1 / work->side;
  int y0 = w->y0 / work->side, y1 = w->y1 / work->side;
  float share = 1.0f / (float)((x1 - x0) * (y1 - y0));
  for (int j = y0; j < y1; j++)
    for (int i = x0; i < x1; i++)
      work->at[j * SIDE + i] += share;
}

/* A module that filters by itself, as tiling does, tells its windows in
 * sub-samples. */
static void draw_work(const struct both_worlds *worlds, uint32_t k,
                      const char *path, const char *algorithm,
                      char **counters) {
  struct hsr_view view = view_of(worlds, k);
  struct hsr_error err = {.text = "the scene is refused"};
  struct hsr_variant variant;
  struct hsr_answer answer;
  struct work work = {.at = calloc(SAMPLES, sizeof *work.at)};
  if (!work.at || hsr_variant_parse(algorithm, &variant, &err))
    stop(err.text);
  const struct hsr_algorithm *a = variant.listed->counting;
  bool filtered = !strcmp(variant.choice.form.type->name, "filtered");
  work.side = filtered ? HSR_SUB : 1;
  for (; *counters; counters++)
    work.shown[number_of(a, *counters)] = true;
  struct hsr_trace trace = {.listen = note_work, .context = &work};
  struct hsr_tally tally = {.trace = &trace};
  if (!draw_chosen(a, &variant.choice, &worlds->roster, &view, &answer,
                   &tally) ||
      hsr_image_write_work(path, SIDE, SIDE, work.at, &err))
    stop(err.text);
  hsr_answer_free(&answer);
  free(work.at);
}

int main(int argc, char **argv) {
  if (argc < 5)
    stop("usage: figures pyramid|exposed|above|octree|culled|work SCENE VIEW "
         "FILE ...");
  struct both_worlds worlds = {.scene = NULL};
  struct hsr_error err = {.text = "out of memory"};
  uint32_t view = (uint32_t)atol(argv[3]) - 1;
  if (hsr_scene_open(argv[2], NULL, &worlds.scene, &err) ||
      hsr_world_roster(&worlds.roster, worlds.scene, &err))
    stop(err.text);
  if (!strcmp(argv[1], "pyramid"))
    draw_pyramid(&worlds, view, argv[4]);
  else if (!strcmp(argv[1], "exposed"))
    draw_exposed(&worlds, view, argv[4]);
  else if (!strcmp(argv[1], "octree"))
    count_octrees(&worlds, argv[4]);
  else if (!strcmp(argv[1], "culled"))
    count_culling(&worlds, view, argv[4]);
  else if (!strcmp(argv[1], "work") && argc > 6)
    draw_work(&worlds, view, argv[4], argv[5], argv + 6);
  else
    draw_above(&worlds, view, argv[4]);
  hsr_world_free(&worlds.roster);
  hsr_scene_delete(worlds.scene);
  return 0;
}
