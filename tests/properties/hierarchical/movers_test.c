/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Objects that move between frames: hzbuffer, hzbuffer-moving and clark are
 * prepared once, and must draw the same as the z-buffer, for which the scene is
 * laid out anew in every frame. Carts drive through the office; some frames
 * move them out of the building, or back in time. Greene's thesis, 3.4. */
#define HSR_COUNTING 1
#include "algorithms/counting-names.h" /* the functions of that build */
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "algorithms/hierarchical/hzbuffer/moving/movers.h"
#include "bench/modules/variant.h"
#include "common/scene/motion.h"

#include <stdlib.h>
#include <string.h>

enum { M = 120, N = 90, FRAMES = 6 };

/* The time in each frame: it goes forth, far ahead, and back. */
static const int moment[FRAMES] = {0, 1, 2, 500, 501, 1};

static const char *const variants[] = {
    "clark",
    "hzbuffer",
    "hzbuffer-moving",
    "hzbuffer-moving:movers=lazy",
    "hzbuffer-moving:movers=update",
    "hzbuffer-moving:coherence=list:movers=update",
    "hzbuffer:cubes=sides",
    "hzbuffer:volumes=tight:cubes=whole",
    "hzbuffer:coherence=list",
    "hzbuffer:coherence=passes",
    "hzbuffer:coherence=chc",
    "hzbuffer:coherence=chc++:assumed=3",
    "hzbuffer-moving:coherence=list",
    "hzbuffer-moving:coherence=passes:movers=lazy",
    "hzbuffer-moving:octree=lazy:movers=lazy",
    "hzbuffer:octree=lazy:coherence=list",
    "hzbuffer:octree=off"};
enum { VARIANTS = sizeof variants / sizeof *variants };

static struct hsr_scene *open_scene(int per_cent, int frame) {
  char name[40];
  snprintf(name, sizeof name, "traffic:%d:%d", per_cent, frame);
  struct hsr_scene *scene = must_open(name);
  return scene;
}

/* Moves the instances to their places in a frame; in some frames the first cart
 * is far off. */
static void move_to(struct hsr_scene *scene, int per_cent, int frame) {
  struct hsr_scene *then = open_scene(per_cent, moment[frame]);
  memcpy(scene->instances, then->instances,
         scene->n_instances * sizeof *scene->instances);
  hsr_scene_delete(then);
  for (uint32_t i = 0; i < scene->n_instances && frame % 3 == 1; i++)
    if (scene->objects[scene->instances[i].object].moves) {
      scene->instances[i].m[3] = -40;
      break;
    }
}

struct ready {
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena scratch;
  struct hsr_tally tally;
  long wrong;
};

static void draw(struct ready *r, const struct hsr_view *view,
                 const uint32_t *right) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  hsr_arena_reset(&r->scratch);
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {.view = view,
                        .scratch = &r->scratch,
                        .tally = &r->tally,
                        .answer = &answer};
  memset(ids, 0xfe, sizeof ids);
  if (hsr_setup_render(&r->setup, &job, &err))
    bail("%s", err.text);
  r->wrong += count_differences(view, ids, right);
}

static long carts_in(const struct hsr_world *world, const uint32_t *ids) {
  long n = 0;
  for (int k = 0; k < M * N; k++)
    n += ids[k] != HSR_BACKGROUND &&
         world->roster.scene->objects[world->mesh.object[ids[k]]].moves;
  return n;
}

static void check(struct tap *tap, int per_cent, uint32_t of) {
  static struct ready ready[VARIANTS];
  static uint32_t right[M * N];
  const struct hsr_algorithm *zbuffer =
      hsr_algorithm_find("zbuffer-fast")->plain;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = open_scene(per_cent, moment[0]);
  struct hsr_world outline;
  struct hsr_view view;
  long carts = 0;
  must_roster(&outline, scene);
  must_view(&view, &scene->views[of], M, N);
  for (int k = 0; k < VARIANTS; k++) {
    struct ready *r = &ready[k];
    *r = (struct ready){.wrong = 0};
    if (hsr_variant_parse(variants[k], &r->variant, &err))
      bail("%s", err.text);
    must_setup(&r->setup, r->variant.listed->counting, &r->variant.choice,
               &outline);
  }
  for (int frame = 0; frame < FRAMES; frame++) {
    struct hsr_world world;
    move_to(scene, per_cent, frame);
    must_world(&world, scene);
    draw_ids(zbuffer, &world, &view, right, NULL);
    carts += carts_in(&world, right);
    for (int k = 0; k < VARIANTS; k++)
      draw(&ready[k], &view, right);
    hsr_world_free(&world);
  }
  ok(tap, carts > 0, "traffic:%d, view %u: carts cover %ld samples", per_cent,
     of + 1, carts);
  for (int k = 0; k < VARIANTS; k++) {
    ok(tap, !ready[k].wrong, "%s: %ld samples differ in %d frames", variants[k],
       ready[k].wrong, FRAMES);
    hsr_setup_free(&ready[k].setup);
    hsr_arena_free(&ready[k].scratch);
  }
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* --- With what is known beforehand ---------------------------------------- */

/* Each is used where the motion is known; movers=update does not use that. */
static const char *const knowing[] = {
    "hzbuffer-moving:movers=octree",
    "hzbuffer-moving:movers=update",
    "hzbuffer-moving:movers=bounded",
    "hzbuffer-moving:movers=bounded:interval=3",
    "hzbuffer-moving:movers=fixed",
    "hzbuffer-moving:movers=space-time",
    "hzbuffer-moving:movers=space-time:interval=64",
    "hzbuffer-moving:movers=space-time:interval=5:octree=lazy:coherence=list",
    "hzbuffer-moving:movers=bounded:octree=lazy:coherence=passes"};
enum { KNOWING = sizeof knowing / sizeof *knowing };

static void begin(struct ready *r, const char *way,
                  const struct hsr_world *outline) {
  struct hsr_error err = {.text = "out of memory"};
  *r = (struct ready){.wrong = 0};
  if (hsr_variant_parse(way, &r->variant, &err))
    bail("%s", err.text);
  must_setup(&r->setup, r->variant.listed->counting, &r->variant.choice,
             outline);
}

static void end(struct ready *r) {
  hsr_setup_free(&r->setup);
  hsr_arena_free(&r->scratch);
}

static uint64_t count_of(const struct ready *r, const char *name) {
  return counted(r->setup.algorithm, &r->tally, name);
}

static struct hsr_scene *open_way(int per_cent, int frame, int way) {
  char name[60];
  snprintf(name, sizeof name, "traffic:%d:%d:%d", per_cent, frame, way);
  struct hsr_scene *scene = must_open(name);
  return scene;
}

/* Makes a scene another frame, which its promises must allow. */
static void follow(struct hsr_scene *scene, int per_cent, int frame, int way) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *then = open_way(per_cent, frame, way);
  if (hsr_scene_follow(scene, then, &err))
    bail("%s", err.text);
  hsr_scene_delete(then);
}

/* Frames in order, left out, far off, back, and beyond what is known. */
static void check_knowing(struct tap *tap, int per_cent, int way, uint32_t of) {
  static const int at[] = {0,   1,   2,   3,  5,    6,    7,    20,
                           500, 501, 499, 15, 1030, 1031, 1500, 3};
  static struct ready ready[KNOWING];
  static uint32_t right[M * N];
  struct hsr_scene *scene = open_way(per_cent, 0, way);
  struct hsr_world outline;
  struct hsr_view view;
  long carts = 0, frames = sizeof at / sizeof *at;
  must_roster(&outline, scene);
  must_view(&view, &scene->views[of], M, N);
  for (int k = 0; k < KNOWING; k++)
    begin(&ready[k], knowing[k], &outline);
  for (long f = 0; f < frames; f++) {
    struct hsr_world world;
    follow(scene, per_cent, at[f], way);
    must_world(&world, scene);
    draw_plain("zbuffer-fast", &world, &view, right);
    carts += carts_in(&world, right);
    for (int k = 0; k < KNOWING; k++)
      draw(&ready[k], &view, right);
    hsr_world_free(&world);
  }
  for (int k = 0; k < KNOWING; k++) {
    ok(tap, !ready[k].wrong && carts > 0,
       "%s, %s: %ld samples differ in %ld frames", scene->name, knowing[k],
       ready[k].wrong, frames);
    end(&ready[k]);
  }
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* Two triangles across the view, from corner to corner. */
static void add_screen(struct hsr_object *object, const double lo[2],
                       const double hi[2], double z) {
  const double x[4] = {lo[0], hi[0], hi[0], lo[0]},
               y[4] = {lo[1], lo[1], hi[1], hi[1]};
  uint32_t vertex[4];
  for (int k = 0; k < 4; k++)
    if (hsr_object_vertex(object, x[k], y[k], z, &vertex[k]))
      bail("out of memory");
  const uint32_t other[3] = {vertex[0], vertex[2], vertex[3]};
  if (hsr_object_face(object, vertex, 3, NULL) ||
      hsr_object_face(object, other, 3, NULL))
    bail("out of memory");
}

/* A shuttle, the first instance, comes out from behind a wall, a unit a frame.
 * Farther back is a wall as wide as the view. */
static struct hsr_scene *open_emerging(long frame) {
  static const double still[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const double moved[12] = {1, 0, 0, (double)frame, 0, 1, 0, 0, 0, 0, 1, 0};
  static const struct hsr_camera camera = {
      .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_motion motion = hsr_motion_unknown();
  struct hsr_scene *scene = hsr_scene_new("emerging");
  if (!scene)
    bail("%s", err.text);
  struct hsr_object *shuttle = hsr_scene_object(scene, "shuttle");
  shuttle->moves = true;
  add_screen(shuttle, (double[]){-3.75, 2.625}, (double[]){-2.75, 3.625},
             -16.25);
  motion.speed = 1;
  struct hsr_object *walls = hsr_scene_object(scene, "walls");
  add_screen(walls, (double[]){-10, -10}, (double[]){0, 10}, -10);
  add_screen(walls, (double[]){-40, -40}, (double[]){40, 40}, -40);
  if (hsr_scene_instance(scene, 0, moved) ||
      hsr_scene_set_motion(scene, &motion, NULL, 0) ||
      hsr_scene_instance(scene, 1, still) ||
      hsr_scene_set_frame(scene, frame) || hsr_scene_view(scene, &camera))
    bail("%s", err.text);
  must_finish(scene);
  return scene;
}

/* The cube that the shuttle is in at first is hidden, and is small. */
static void check_emerging(struct tap *tap) {
  static struct ready ready;
  static uint32_t right[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = open_emerging(0);
  struct hsr_world outline;
  struct hsr_view view;
  long seen[8] = {0};
  must_roster(&outline, scene);
  must_view(&view, &scene->views[0], M, N);
  begin(&ready, "hzbuffer-moving:movers=bounded:interval=8:octree=lazy",
        &outline);
  for (long frame = 0; frame < 8; frame++) {
    struct hsr_scene *then = open_emerging(frame);
    struct hsr_world world;
    if (hsr_scene_follow(scene, then, &err))
      bail("%s", err.text);
    must_world(&world, scene);
    draw_plain("zbuffer-fast", &world, &view, right);
    seen[frame] = carts_in(&world, right);
    draw(&ready, &view, right);
    hsr_world_free(&world);
    hsr_scene_delete(then);
  }
  ok(tap, !ready.wrong && !seen[0] && seen[7],
     "a shuttle comes out from behind a wall: %ld samples differ", ready.wrong);
  end(&ready);
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* --- What that takes ------------------------------------------------------ */

enum { RUN = 33, WAYS = 6 };
enum { WAY_OCTREE, WAY_LAZY, WAY_UPDATE, WAY_BOUNDED, WAY_FIXED, WAY_CLUSTERS };

/* Of one way, a frame after the first. */
struct cost {
  double down, looked, bounded, met, nodes;
};

static struct cost cost_of(const struct ready *r) {
  return (struct cost){(double)count_of(r, "moved down"),
                       (double)count_of(r, "movers looked at"),
                       (double)count_of(r, "ways bounded"),
                       (double)count_of(r, "movers met"),
                       (double)count_of(r, "nodes visited")};
}

static struct cost difference(const struct cost *a, const struct cost *b) {
  const double n = RUN - 1;
  return (struct cost){(a->down - b->down) / n, (a->looked - b->looked) / n,
                       (a->bounded - b->bounded) / n, (a->met - b->met) / n,
                       (a->nodes - b->nodes) / n};
}

static void measure(int per_cent, int way, struct cost cost[WAYS]) {
  static const char *const ways[WAYS] = {
      "hzbuffer-moving",
      "hzbuffer-moving:movers=lazy",
      "hzbuffer-moving:movers=update",
      "hzbuffer-moving:movers=bounded:interval=8",
      "hzbuffer-moving:movers=fixed",
      "hzbuffer-moving:movers=space-time:interval=32"};
  static struct ready ready[WAYS];
  static uint32_t ids[M * N];
  struct hsr_scene *scene = open_way(per_cent, 0, way);
  struct hsr_world outline;
  struct hsr_view view;
  struct cost first[WAYS];
  must_roster(&outline, scene);
  must_view(&view, &scene->views[60], M, N);
  for (int k = 0; k < WAYS; k++)
    begin(&ready[k], ways[k], &outline);
  for (int frame = 0; frame < RUN; frame++) {
    follow(scene, per_cent, frame, way);
    for (int k = 0; k < WAYS; k++) {
      draw(&ready[k], &view, ids);
      if (!frame)
        first[k] = cost_of(&ready[k]);
    }
  }
  for (int k = 0; k < WAYS; k++) {
    struct cost all = cost_of(&ready[k]);
    cost[k] = difference(&all, &first[k]);
    printf("# %s, %s, a frame: %.1f moved down, %.1f looked at, %.1f ways "
           "bounded, %.1f met, %.0f nodes visited; first frame: %.0f moved "
           "down, %.0f ways bounded\n",
           scene->name, ways[k], cost[k].down, cost[k].looked, cost[k].bounded,
           cost[k].met, cost[k].nodes, first[k].down, first[k].bounded);
    end(&ready[k]);
  }
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* Thesis, 3.4: with a limit of speed, the octree needs to be brought up to date
 * every k frames only; with a volume, never. But boxes that hold more hide
 * less. */
static void check_costs(struct tap *tap) {
  struct cost far[WAYS], near[WAYS];
  const double movers = 1053;
  measure(20, 0, far);
  measure(20, 2, near);
  ok(tap,
     far[WAY_UPDATE].looked == movers && far[WAY_BOUNDED].looked > movers / 9 &&
         far[WAY_BOUNDED].looked < movers / 7,
     "every 8 frames: an eighth of the carts is looked at in a frame");
  ok(tap,
     far[WAY_FIXED].looked == 0 && far[WAY_FIXED].down == 0 &&
         near[WAY_FIXED].looked == 0,
     "with fixed volumes none is looked at after the first frame");
  ok(tap,
     far[WAY_OCTREE].met <= far[WAY_BOUNDED].met &&
         far[WAY_BOUNDED].met < far[WAY_FIXED].met &&
         near[WAY_FIXED].met < 0.5 * far[WAY_FIXED].met,
     "larger boxes hide less: %.1f carts met a frame, %.1f with a limit of "
     "speed, %.1f with a volume as long as the building, %.1f with one of 2 m",
     far[WAY_OCTREE].met, far[WAY_BOUNDED].met, far[WAY_FIXED].met,
     near[WAY_FIXED].met);
  ok(tap,
     far[WAY_CLUSTERS].bounded + far[WAY_CLUSTERS].down < movers / 2 &&
         far[WAY_CLUSTERS].met < movers / 2,
     "clusters: %.1f ways are bounded, %.1f carts moved down and %.1f met a "
     "frame, of %.0f",
     far[WAY_CLUSTERS].bounded, far[WAY_CLUSTERS].down, far[WAY_CLUSTERS].met,
     movers);
}

/* --- The work of keeping an octree ---------------------------------------- */

enum { LONG = 12 };

/* Thesis, 3.4: to bring an octree up to date takes much less than to make it
 * anew, since most instances stay in their cubes; but each has to be looked at.
 */
static void check_update(struct tap *tap) {
  static const char *const ways[3] = {"hzbuffer-moving",
                                      "hzbuffer-moving:movers=lazy",
                                      "hzbuffer-moving:movers=update"};
  static uint32_t right[M * N];
  struct ready ready[3];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = open_scene(20, 0);
  struct hsr_world outline;
  struct hsr_view view;
  uint64_t first = 0, movers = 0;
  must_roster(&outline, scene);
  must_view(&view, &scene->views[60], M, N);
  for (uint32_t i = 0; i < scene->n_instances; i++)
    movers += scene->objects[scene->instances[i].object].moves;
  for (int k = 0; k < 3; k++) {
    ready[k] = (struct ready){.wrong = 0};
    if (hsr_variant_parse(ways[k], &ready[k].variant, &err))
      bail("%s", err.text);
    must_setup(&ready[k].setup, ready[k].variant.listed->counting,
               &ready[k].variant.choice, &outline);
  }
  for (int frame = 0; frame < LONG; frame++) {
    struct hsr_scene *then = open_scene(20, frame);
    memcpy(scene->instances, then->instances,
           scene->n_instances * sizeof *scene->instances);
    hsr_scene_delete(then);
    for (int k = 0; k < 3; k++)
      draw(&ready[k], &view, right);
    if (!frame)
      first = count_of(&ready[2], "moved down");
  }
  uint64_t anew = count_of(&ready[0], "moved down");
  uint64_t lazily = count_of(&ready[1], "moved down");
  uint64_t kept = count_of(&ready[2], "moved down") - first;
  ok(tap,
     count_of(&ready[2], "movers looked at") == LONG * movers &&
         8 * kept < anew && lazily < anew && kept > 0,
     "%lu carts, a frame: %lu moved down in a new octree, %lu in a lazy one, "
     "%lu in one brought up to date, where all are looked at",
     (unsigned long)movers, (unsigned long)(anew / LONG),
     (unsigned long)(lazily / LONG), (unsigned long)(kept / (LONG - 1)));
  for (int k = 0; k < 3; k++) {
    hsr_setup_free(&ready[k].setup);
    hsr_arena_free(&ready[k].scratch);
  }
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* The only mover in the cube from -1 to 1: a cube with sides of .2. Its centre
 * is at (x, x, x) in the frame. */
struct single {
  struct hsr_object object;
  struct hsr_instance instance;
  struct hsr_scene scene;
  struct hsr_cubes_object extent;
  struct hsr_octree_node root;
  uint32_t number;
  struct hsr_cubes cubes;
  struct hsr_movers movers;
  struct hsr_arena arena;
  struct hsr_tally tally;
};

static uint64_t moved_down_at(struct single *a, double x) {
  uint64_t before = a->tally.count[HSR_MOVERS_DOWN];
  a->instance =
      (struct hsr_instance){.m = {1, 0, 0, x, 0, 1, 0, x, 0, 0, 1, x}};
  if (hsr_movers_update(&a->movers, &a->cubes, &a->tally, &a->arena))
    bail("out of memory");
  return a->tally.count[HSR_MOVERS_DOWN] - before;
}

/* A mover stays while its cube holds it, even where an octant would. */
static void check_stays(struct tap *tap) {
  static struct single a;
  a.object.moves = true;
  a.scene = (struct hsr_scene){.objects = &a.object,
                               .n_objects = 1,
                               .instances = &a.instance,
                               .n_instances = 1};
  a.extent = (struct hsr_cubes_object){
      .reach = .1, .grain = -60, .bounds = {{-.1, -.1, -.1}, {.1, .1, .1}}};
  a.root = (struct hsr_octree_node){.half = 1};
  a.cubes = (struct hsr_cubes){.scene = &a.scene,
                               .object = &a.extent,
                               .octree = {.node = &a.root, .n_nodes = 1},
                               .mover = &a.number,
                               .n_movers = 1};
  ok(tap, moved_down_at(&a, .05) == 0, "across the centre: in the root");
  ok(tap, moved_down_at(&a, .75) == 0 && a.movers.mover[0].node == 0,
     "into an octant: it stays in the root, which holds it");
  ok(tap, moved_down_at(&a, 3) == 0 && a.movers.mover[0].node == HSR_NO_NODE,
     "out of the root: outside");
  ok(tap, moved_down_at(&a, .75) == 2 && a.movers.mover[0].node != 0,
     "back into an octant: down to the smallest cube that holds it");
  ok(tap, a.tally.count[HSR_MOVERS_LOOKED_AT] == 4,
     "it is looked at in each frame");
  hsr_arena_free(&a.arena);
}

int main(void) {
  struct tap tap = plan(2 * (1 + VARIANTS) + 2 * KNOWING + 11);
  check_update(&tap);
  check_stays(&tap);
  check(&tap, 5, 10);
  check(&tap, 20, 60);
  check_knowing(&tap, 20, 0, 60);
  check_knowing(&tap, 5, 2, 10);
  check_emerging(&tap);
  check_costs(&tap);
  return finish(&tap);
}
