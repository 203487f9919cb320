/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octants in lanes against one cube after another, their images and whether they
 * are visible; and the pyramid's test of rows at once against a look at every
 * sample. Both are of the build that is
 * timed, and use the vector unit that the machine has. */
#include "algorithms/engines/cubes/cube_octants.h"
#include "algorithms/engines/pyramid/pyramid.h"
#include "algorithms/hierarchical/hzbuffer/walk.h"
#include "common/answers/kinds/ids.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61 };

/* --- Octants -------------------------------------------------------------- */

struct held {
  long images, none, parts, wrong;
};

/* Part k of octant o against what hsr_cube_bounds says of the same corners. */
static bool is_same_part(const struct hsr_cube_frame *frame,
                         const struct hsr_octants *octants, int k, int o,
                         const struct hsr_cube_image *image) {
  static const unsigned char all[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const unsigned char *corner = k == HSR_WHOLE_CUBE ? all : hsr_cube_side[k];
  int n = k == HSR_WHOLE_CUBE ? 8 : 4;
  float q = 0;
  for (int c = 0; c < n; c++)
    q = fmaxf(q, image->q[corner[c]]);
  struct hsr_bounds one, lane;
  bool covers = hsr_cube_bounds(frame, image, corner, n, &one);
  return hsr_octant_bounds(octants, k, o, &lane) == covers &&
         octants->q[k][o] == q && (!covers || !memcmp(&one, &lane, sizeof one));
}

static void look_at_octants(const struct hsr_cube_frame *frame,
                            const struct hsr_octree_node *node, bool tight,
                            struct held *held) {
  const struct hsr_octree *octree = &frame->object->octree;
  struct hsr_octants octants;
  hsr_octants_project(frame, &frame->placing, octree, node, tight, &octants);
  for (int o = 0; o < 8; o++) {
    if (node->child[o] == HSR_NO_NODE)
      continue;
    const struct hsr_octree_node *child = &octree->node[node->child[o]];
    struct hsr_octree_box box = tight ? child->tight : hsr_octree_cube(child);
    struct hsr_cube_image image;
    bool has_image = hsr_cube_project(frame, &frame->placing, &box, &image);
    held->images += has_image;
    held->none += !has_image;
    held->wrong += octants.has_image[o] != has_image;
    held->wrong += has_image && (unsigned)octants.front[o] != image.front;
    for (int k = 0; k < HSR_CUBE_PARTS && has_image; k++) {
      held->parts++;
      held->wrong += !is_same_part(frame, &octants, k, o, &image);
    }
  }
}

/* From one of the scene's own places, or close to a corner of its first object's
 * root cube. */
static struct hsr_camera camera_of(const struct hsr_scene *scene, int c,
                                   uint64_t *seed) {
  struct hsr_camera camera = scene->views[(uint32_t)c % scene->n_views];
  for (int k = 0; k < 3 && c % 2; k++)
    camera.eye[k] +=
        (double)draw_integer(seed, -64, 64) / 64 * fabs(camera.eye[k]);
  return camera;
}

static void look_from(const struct hsr_camera *camera,
                      const struct hsr_world *outline,
                      const struct hsr_cubes *cubes, struct held *held) {
  struct hsr_view view;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  must_view(&view, camera, M, N);
  view.window = (struct hsr_window){5, 3, M - 9, N};
  struct hsr_job job = {
      .world = outline, .view = &view, .scratch = &scratch, .tally = &tally};
  struct hsr_cube_frame frame;
  memset(&frame, 0, sizeof frame);
  if (hsr_cube_frame_begin(&frame, &job, cubes))
    bail("out of memory");
  for (uint32_t i = 0; i < cubes->scene->n_instances; i++) {
    hsr_cube_instance(&frame, i);
    for (uint32_t k = 0; k < frame.object->octree.n_nodes; k++)
      for (int tight = 0; tight < 2; tight++)
        look_at_octants(&frame, &frame.object->octree.node[k], tight, held);
  }
  hsr_arena_free(&scratch);
}

static void test_octants(struct tap *tap, const char *name, uint64_t *seed) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_octree_rule rule = {.small = 0.1, .most = 20, .least = 20};
  struct hsr_world outline;
  struct hsr_cubes cubes;
  struct held held = {.wrong = 0};
  struct hsr_scene *scene = NULL;
  scene = must_open(name);
  must_roster(&outline, scene);
  if (hsr_cubes_init(&cubes, &outline, &rule, &err))
    bail("%s", err.text);
  for (int c = 0; c < 6; c++) {
    struct hsr_camera camera = camera_of(scene, c, seed);
    look_from(&camera, &outline, &cubes, &held);
  }
  ok(tap, !held.wrong && held.images > 500 && held.none > 20,
     "%s: %ld octants have an image, %ld have none; of %ld sides and wholes "
     "and "
     "what else is known of them %ld differ from one cube at a time",
     name, held.images, held.none, held.parts, held.wrong);
  hsr_cubes_free(&cubes);
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* --- Is an octant visible? ------------------------------------------------ */

struct asked {
  long visible, hidden, wrong;
};

/* The octants of a node, together and one by one. */
static void ask_node(struct hsr_hz_walk *w, const struct hsr_octree *octree,
                     const struct hsr_octree_node *node, struct asked *asked) {
  struct hsr_octants octants;
  hsr_octants_project(&w->frame, &w->frame.placing, octree, node,
                      w->choice.volumes == HSR_HZ_VOLUMES_TIGHT, &octants);
  for (int o = 0; o < 8; o++) {
    if (node->child[o] == HSR_NO_NODE)
      continue;
    const struct hsr_octree_node *child = &octree->node[node->child[o]];
    const struct hsr_octree_box cube = hsr_hz_volume(w, child);
    bool in = false, inside = false;
    bool together =
        hsr_hz_is_in_frustum(w, &w->frame.placing, &cube, HSR_NOTHING, &in) &&
        hsr_hz_octant_passes_pyramid(w, &octants, o);
    bool alone = hsr_hz_is_cube_visible(w, &w->frame.placing, cube, HSR_NOTHING,
                                        &inside);
    asked->visible += alone;
    asked->hidden += !alone;
    asked->wrong += together != alone || in != inside;
  }
}

/* All octants, when the whole picture is drawn. */
static void ask_frame(const struct hsr_job *job,
                      struct hsr_hz_prepared *prepared,
                      const struct hsr_hz_choice *choice, struct asked *asked) {
  struct hsr_hz_walk w;
  if (hsr_hz_begin(&w, job, prepared, choice))
    bail("out of memory");
  hsr_hz_process_instances(&w, 0, false);
  for (uint32_t i = 0; i < w.frame.cubes->scene->n_instances; i++) {
    hsr_hz_set_instance(&w, i);
    const struct hsr_octree *octree = &w.frame.object->octree;
    for (uint32_t k = 0; k < octree->n_nodes; k++)
      ask_node(&w, octree, &octree->node[k], asked);
  }
  if (hsr_hz_end(&w))
    bail("out of memory");
}

static void test_visible(struct tap *tap, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_octree_rule rule = {.small = 0.1, .most = 20, .least = 20};
  struct hsr_hz_prepared prepared = {.last = 0};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_world roster;
  struct asked asked = {.wrong = 0};
  static uint32_t ids[M * N];
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_scene *scene = must_open(name);
  must_roster(&roster, scene);
  if (hsr_hz_prepare(&prepared, &roster, &rule, false, &err))
    bail("%s", err.text);
  for (uint32_t v = 0; v < scene->n_views && v < 3; v++)
    for (int c = 0; c < 4; c++) {
      const struct hsr_hz_choice choice = {
          .octree = HSR_HZ_OCTREE_ON,
          .pyramid = HSR_HZ_PYRAMID_ON,
          .volumes = c & 1 ? HSR_HZ_VOLUMES_TIGHT : HSR_HZ_VOLUMES_CUBES,
          .cubes = c & 2 ? HSR_HZ_CUBES_WHOLE : HSR_HZ_CUBES_RECTANGLE};
      struct hsr_view view;
      struct hsr_tally tally = {.out_of_memory = false};
      must_view(&view, &scene->views[v], M, N);
      hsr_arena_reset(&scratch);
      ask_frame(&(struct hsr_job){.world = &roster,
                                  .view = &view,
                                  .scratch = &scratch,
                                  .tally = &tally,
                                  .answer = &answer},
                &prepared, &choice, &asked);
    }
  ok(tap, !asked.wrong && asked.visible > 50 && asked.hidden > 50,
     "%s: %ld octants are visible, %ld are not; %ld are told otherwise "
     "together "
     "than one by one",
     name, asked.visible, asked.hidden, asked.wrong);
  hsr_hz_release(&prepared);
  hsr_arena_free(&scratch);
  hsr_world_free(&roster);
  hsr_scene_delete(scene);
}

/* --- The pyramid ---------------------------------------------------------- */

/* Is every sample of a box nearer than q? */
static bool is_hidden(const struct hsr_pyramid *p, size_t stride,
                      struct hsr_bounds box, float q) {
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      float z = p->far[0][(size_t)(j - p->window.y0) * stride +
                          (size_t)(i - p->window.x0)];
      if (!(q * HSR_CLEAR < z))
        return false;
    }
  return true;
}

static struct hsr_bounds draw_box(const struct hsr_window *w, uint64_t *seed) {
  int most = 1 << draw_integer(seed, 0, 7);
  int x0 = (int)draw_integer(seed, w->x0, w->x1 - 1);
  int y0 = (int)draw_integer(seed, w->y0, w->y1 - 1);
  int x1 = x0 + (int)draw_integer(seed, 1, most);
  int y1 = y0 + (int)draw_integer(seed, 1, most);
  return (struct hsr_bounds){x0, y0, x1 < w->x1 ? x1 : w->x1,
                             y1 < w->y1 ? y1 : w->y1};
}

/* All samples are near but for a few, so that boxes of any size may be hidden. */
static void test_pyramid(struct tap *tap, const struct hsr_window *window,
                         uint64_t *seed) {
  struct hsr_pyramid p;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  size_t stride;
  long hidden = 0, open = 0, wrong = 0;
  if (hsr_pyramid_init(&p, window, false, &stride, &arena))
    bail("out of memory");
  for (int round = 0; round < 40; round++) {
    hsr_pyramid_clear(&p);
    for (int j = 0; j < window->y1 - window->y0; j++)
      for (int i = 0; i < window->x1 - window->x0; i++) {
        int64_t kind = draw_integer(seed, 0, 50 << round % 8);
        p.far[0][(size_t)j * stride + (size_t)i] =
            kind == 0   ? 0.25f
            : kind == 1 ? NAN
            : kind == 2 ? HUGE_VALF
                        : 0.5f + (float)draw_integer(seed, 0, 99) / 128;
      }
    hsr_pyramid_update(&p, (struct hsr_bounds){window->x0, window->y0,
                                               window->x1, window->y1});
    for (int k = 0; k < 500; k++) {
      struct hsr_bounds box = draw_box(window, seed);
      float q = (float)draw_integer(seed, 10, 90) / 128;
      bool truth = is_hidden(&p, stride, box, q);
      hidden += truth;
      open += !truth;
      wrong += hsr_pyramid_hides(&p, box, q) != truth;
    }
  }
  ok(tap, !wrong && hidden > 500 && open > 500,
     "a window of %d x %d: %ld boxes are hidden, %ld are not; %ld are wrong",
     window->x1 - window->x0, window->y1 - window->y0, hidden, open, wrong);
  hsr_arena_free(&arena);
}

int main(void) {
  static const char *const scenes[] = {"office:1", "office:3", "terrain:40:0",
                                       "soup:3000:3"};
  static const struct hsr_window windows[] = {
      {0, 0, 128, 128}, {3, 5, 103, 66}, {7, 1, 20, 150}, {0, 0, 9, 5}};
  enum {
    SCENES = sizeof scenes / sizeof *scenes,
    WINDOWS = sizeof windows / sizeof *windows
  };
  struct tap tap = plan(2 * SCENES + WINDOWS);
  uint64_t seed = 17;
  for (int k = 0; k < SCENES; k++)
    test_octants(&tap, scenes[k], &seed);
  for (int k = 0; k < SCENES; k++)
    test_visible(&tap, scenes[k]);
  for (int k = 0; k < WINDOWS; k++)
    test_pyramid(&tap, &windows[k], &seed);
  return finish(&tap);
}
