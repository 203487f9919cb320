/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene in cubes, and one view of it, against the same scene laid out. Cells
 * hold its faces, bit for bit. Cubes enclose what is in them, in the world and
 * on the screen. Each inequality that locates a cube is a step. Pairs of faces
 * compare as they do in the scene laid out. */
#define HSR_COUNTING 1
#include "algorithms/counting-names.h" /* the functions of that build */
#include "algorithms/engines/cubes/cube_frame.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61 };

struct laid_out {
  struct hsr_scene *scene;
  struct hsr_world world, outline;
};

static void lay_out(struct laid_out *l) {
  must_world(&l->world, l->scene);
  must_roster(&l->outline, l->scene);
}

static void free_all(struct laid_out *l) {
  hsr_world_free(&l->world);
  hsr_world_free(&l->outline);
  hsr_scene_delete(l->scene);
}

/* --- A scene of all kinds of faces ---------------------------------------- */

/* Triangles, flat polygons and bent ones, small integers. */
static void add_faces(struct hsr_object *object, int n, uint64_t *seed) {
  for (int f = 0; f < n; f++) {
    uint32_t vertex[4];
    double a[3], d[2][3], twist = (double)(f % 4 == 3);
    for (int k = 0; k < 3; k++) {
      a[k] = (double)draw_integer(seed, -40, 40);
      d[0][k] = (double)draw_integer(seed, -9, 9);
      d[1][k] = (double)draw_integer(seed, -9, 9);
    }
    d[0][f % 3] += 20; /* no normal is zero */
    d[1][(f + 1) % 3] += 20;
    int corners = f % 2 ? 4 : 3;
    for (int c = 0; c < corners; c++) {
      double s = c == 1 || c == 2, t = c >= 2;
      hsr_object_vertex(object,
                        a[0] + s * d[0][0] + t * d[1][0] + twist * (c == 2),
                        a[1] + s * d[0][1] + t * d[1][1],
                        a[2] + s * d[0][2] + t * d[1][2], &vertex[c]);
    }
    hsr_object_face(object, vertex, (size_t)corners, NULL);
  }
}

enum { OBJECTS = 4, FACES = 300 };

/* Object 0 is placed exactly, turned and mirrored; object 1 by exact fractions;
 * object 2 also turned by an angle; object 3 also squashed to almost nothing.
 */
static void place_object(struct hsr_scene *scene, uint32_t o) {
  static const double exact[3][12] = {
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
      {0, -1, 0, 100, 0, 0, 1, 7, 1, 0, 0, -30},
      {-1, 0, 0, -80, 0, 0, -1, 0, 0, -1, 0, 60}};
  static const double quarter[12] = {0, 0,     1, 0.25, 1, 0,
                                     0, 90.75, 0, 1,    0, -2.5};
  static const double turned[12] = {0.8, -0.6, 0, -70, 0.6, 0.8,
                                    0,   -70,  0, 0,   1,   1e3};
  static const double squashed[12] = {1, 0, 0,     5, 0, 1e-9,
                                      0, 5, 0.001, 0, 1, 400};
  for (int i = 0; i < (o ? 1 : 3); i++)
    hsr_scene_instance(scene, o, exact[i]);
  if (o)
    hsr_scene_instance(scene, o, o == 1 ? quarter : turned);
  if (o == 3)
    hsr_scene_instance(scene, o, squashed);
}

static struct hsr_scene *all_kinds(uint64_t *seed) {
  static const char *const names[OBJECTS] = {"exact", "quarter", "turned",
                                             "squashed"};
  struct hsr_scene *scene = hsr_scene_new("all kinds");
  for (uint32_t o = 0; o < OBJECTS; o++) {
    struct hsr_object *object = hsr_scene_object(scene, names[o]);
    add_faces(object, FACES, seed);
    object->one_sided = o == 1;
    place_object(scene, o);
  }
  must_finish(scene);
  return scene;
}

/* --- Loose faces ---------------------------------------------------------- */

/* Is the object's face flat in every instance? */
static bool is_flat_everywhere(const struct laid_out *l, uint32_t object,
                               uint32_t f) {
  for (uint32_t i = 0; i < l->scene->n_instances; i++)
    if (l->scene->instances[i].object == object &&
        l->world.mesh.deviation[l->world.roster.first[i] + f] > 0)
      return false;
  return true;
}

/* A face that is not flat in some instance is loose. If instances round
 * nothing, no other face is. */
static void test_loose(struct tap *tap, const struct laid_out *l,
                       const struct hsr_cubes *cubes) {
  bool needed = true, only = true;
  long n_loose = 0, spared = 0;
  for (uint32_t o = 0; o < OBJECTS; o++)
    for (uint32_t f = 0; f < FACES; f++) {
      bool loose = cubes->object[o].is_loose[f];
      bool flat = is_flat_everywhere(l, o, f);
      needed &= loose || flat;
      only &= o >= 2 || loose == !flat;
      n_loose += loose;
      spared += loose && flat;
    }
  ok(tap, needed && n_loose > FACES,
     "every face that is not flat in some instance is loose");
  ok(tap, only,
     "and no other, where instances round nothing; of those that do, %ld of "
     "%ld loose faces happen to be flat",
     spared, n_loose);
}

/* The loose faces, laid out. */
static void test_loose_world(struct tap *tap, const struct laid_out *l,
                             const struct hsr_cubes *cubes) {
  const struct hsr_world *loose = &cubes->loose, *world = &l->world;
  uint32_t n = 0;
  bool good = true;
  for (uint32_t g = 0; g < world->n_faces; g++) {
    uint32_t f = g - world->roster.first[world->mesh.instance[g]];
    if (!cubes->object[world->mesh.object[g]].is_loose[f])
      continue;
    good &= n < loose->n_faces && cubes->loose_id[n] == g &&
            loose->mesh.nx[n] == world->mesh.nx[g] &&
            loose->mesh.px[n] == world->mesh.px[g] &&
            loose->mesh.deviation[n] == world->mesh.deviation[g];
    n++;
  }
  ok(tap, good && n == loose->n_faces,
     "all %u loose faces are laid out, in order", (unsigned)n);
}

/* --- Cells ---------------------------------------------------------------- */

/* A frame of the whole picture. */
struct frame {
  struct hsr_view view;
  struct hsr_tally tally;
  struct hsr_arena scratch;
  struct hsr_job job;
  struct hsr_cube_frame frame;
};

static void begin_frame(struct frame *f, const struct laid_out *l,
                        const struct hsr_cubes *cubes,
                        const struct hsr_camera *camera) {
  memset(f, 0, sizeof *f);
  must_view(&f->view, camera, M, N);
  f->job = (struct hsr_job){.world = &l->outline,
                            .view = &f->view,
                            .scratch = &f->scratch,
                            .tally = &f->tally};
  if (hsr_cube_frame_begin(&f->frame, &f->job, cubes))
    bail("%s: out of memory", l->scene->name);
}

/* Is face k of the current cell face g of the world? */
static bool is_face(const struct hsr_world *cell, uint32_t k,
                    const struct hsr_world *world, uint32_t g) {
  bool same = hsr_face_size(cell, k) == hsr_face_size(world, g) &&
              cell->mesh.one_sided[k] == world->mesh.one_sided[g];
  for (uint32_t c = 0; same && c < hsr_face_size(cell, k); c++) {
    uint32_t v = cell->mesh.vertex[cell->mesh.start[k] + c];
    uint32_t w = world->mesh.vertex[world->mesh.start[g] + c];
    same = cell->mesh.x[v] == world->mesh.x[w] &&
           cell->mesh.y[v] == world->mesh.y[w] &&
           cell->mesh.z[v] == world->mesh.z[w];
  }
  return same;
}

/* The cell with its vertices laid out, even if that could be put off. */
static const struct hsr_cell *lay_out_cell(struct hsr_cube_frame *frame,
                                           uint32_t k) {
  const struct hsr_cell *cell = hsr_cube_cell(frame, k);
  if (frame->tiler.lay_out)
    frame->tiler.lay_out(frame->tiler.context);
  frame->tiler.lay_out = NULL;
  return cell;
}

/* Counts how often each face of the world is in a cell. */
static bool match_cells(struct frame *f, const struct laid_out *l,
                        unsigned char *times) {
  struct hsr_cube_frame *frame = &f->frame;
  bool good = true;
  for (uint32_t i = 0; i < l->scene->n_instances; i++) {
    hsr_cube_instance(frame, i);
    for (uint32_t k = 0; k < frame->object->octree.n_nodes; k++) {
      const struct hsr_cell *cell = lay_out_cell(frame, k);
      for (uint32_t n = 0; n < cell->n_faces; n++) {
        uint32_t g = frame->tiler.first_id + frame->tiler.id[n];
        times[g]++;
        good &=
            is_face(&frame->world, n, &l->world, g) &&
            (hsr_face_size(&frame->world, n) == 3) == (n < cell->n_triangles);
      }
    }
  }
  return good;
}

static void test_cells(struct tap *tap, struct frame *f,
                       const struct laid_out *l, const struct hsr_cubes *cubes,
                       bool once) {
  const struct hsr_world *world = &l->world;
  unsigned char *times = calloc(world->n_faces, 1);
  if (!times)
    bail("%s: out of memory", l->scene->name);
  bool good = match_cells(f, l, times);
  long most = 0;
  for (uint32_t g = 0; g < world->n_faces; g++) {
    uint32_t face = g - world->roster.first[world->mesh.instance[g]];
    bool loose = cubes->object[world->mesh.object[g]].is_loose[face];
    good &= loose ? !times[g] : times[g] > 0;
    most = times[g] > most ? times[g] : most;
  }
  ok(tap, good && (once ? most == 1 : most > 1),
     "%s: cells hold the faces of the world that are not loose, bit for bit; "
     "none in more than %ld",
     l->scene->name, most);
  free(times);
}

/* --- The octree of instances ---------------------------------------------- */

/* Is the point of the instance in a cube that holds the instance? */
static bool is_in_its_cubes(const struct hsr_octree *octree, uint32_t k,
                            uint32_t instance, const double p[3]) {
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_box cube = hsr_cube_box(node);
  for (int a = 0; a < 3; a++)
    if (p[a] < cube.lo[a] || p[a] > cube.hi[a])
      return false;
  for (uint32_t i = 0; i < node->n; i++)
    if (octree->item[node->first + i] == instance)
      return true;
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE &&
        is_in_its_cubes(octree, node->child[o], instance, p))
      return true;
  return false;
}

/* All vertices except those of loose faces are in their cubes. */
static void test_bounds(struct tap *tap, const struct laid_out *l,
                        const struct hsr_cubes *cubes) {
  const struct hsr_world *world = &l->world;
  long looked = 0, out = 0, astray = 0;
  for (uint32_t g = 0; g < world->n_faces; g++) {
    uint32_t i = world->mesh.instance[g];
    struct hsr_box box = hsr_cubes_bounds(cubes, i);
    if (cubes->object[world->mesh.object[g]]
            .is_loose[g - world->roster.first[i]])
      continue;
    for (uint32_t c = world->mesh.start[g]; c < world->mesh.start[g + 1]; c++) {
      uint32_t v = world->mesh.vertex[c];
      const double p[3] = {world->mesh.x[v], world->mesh.y[v],
                           world->mesh.z[v]};
      for (int a = 0; a < 3; a++)
        out += p[a] < box.lo[a] || p[a] > box.hi[a];
      astray += !is_in_its_cubes(&cubes->octree, 0, i, p);
      looked++;
    }
  }
  ok(tap, looked && !out && !astray,
     "%s: of %ld corners %ld are out of their instance's bounds, %ld of its "
     "cubes",
     l->scene->name, looked, out, astray);
}

/* --- Cubes in the world and on the screen --------------------------------- */

struct held {
  long vertices, images, out, wrong, miscounted;
};

/* A vertex on the screen lies in the cube's image, and not in front of the
 * cube's front sides. */
static bool is_in_image(const struct frame *f,
                        const struct hsr_cube_image *image,
                        const struct hsr_octree_node *node, uint32_t v) {
  const struct hsr_screen *screen = &f->frame.tiler.screen;
  double x = screen->sx[v], y = screen->sy[v], q = screen->q[v];
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  if (isnan(x) || fabs(x) > 4 * M || fabs(y) > 4 * N)
    return true;
  for (int c = 0; c < 8; c++) {
    x0 = fmin(x0, image->x[c]), x1 = fmax(x1, image->x[c]);
    y0 = fmin(y0, image->y[c]), y1 = fmax(y1, image->y[c]);
  }
  bool good = x >= x0 - HSR_CUBE_MARGIN && x <= x1 + HSR_CUBE_MARGIN &&
              y >= y0 - HSR_CUBE_MARGIN && y <= y1 + HSR_CUBE_MARGIN &&
              q <= (double)image->nearest;
  if (x < 0 || x > M || y < 0 || y > N)
    return good; /* depths are only for the picture */
  struct hsr_octree_box cube = hsr_octree_cube(node);
  for (int side = 0; side < 6; side++)
    if (image->front >> side & 1) {
      struct hsr_side_depth d =
          hsr_cube_side_depth(&f->frame, &f->frame.placing, &cube, image, side);
      good &= q <= d.c + d.a * x + d.b * y;
    }
  return good;
}

/* The inequalities of one cube, from their events. */
struct told {
  long n, outside, wrong;
  struct hsr_subject cube;
  bool last;
};

static void listen(void *context, const struct hsr_event *event) {
  struct told *t = context;
  t->n++;
  t->last = event->outcome;
  t->outside += event->outcome;
  t->wrong += event->counter != HSR_INEQUALITIES % HSR_PART_SIZE ||
              memcmp(&event->a, &t->cube, sizeof t->cube) != 0;
}

/* Is a cube outside the frustum? Its place against six planes takes one to
 * thirty inequalities; if the cube is outside, only the last one says so. */
static bool is_out(struct frame *f, const struct hsr_octree_box *cube,
                   uint32_t k, struct held *held) {
  struct told told = {.cube = hsr_cube_subject(f->frame.instance, k)};
  struct hsr_trace trace = {.listen = listen, .context = &told};
  uint64_t before = hsr_tally_count(&f->tally, HSR_INEQUALITIES);
  f->tally.trace = &trace;
  bool out = hsr_cube_classify(&f->frame, &f->frame.placing, cube, told.cube) ==
             HSR_BOX_OUT;
  f->tally.trace = NULL;
  held->miscounted +=
      told.wrong || told.outside != out || told.last != out || told.n < 1 ||
      told.n > 30 ||
      hsr_tally_count(&f->tally, HSR_INEQUALITIES) != before + (uint64_t)told.n;
  return out;
}

static void look_at_cube(struct frame *f, uint32_t k, struct held *held) {
  struct hsr_cube_frame *frame = &f->frame;
  const struct hsr_octree_node *node = &frame->object->octree.node[k];
  const struct hsr_cell *cell = lay_out_cell(frame, k);
  struct hsr_octree_box cube = hsr_octree_cube(node);
  struct hsr_cube_image image;
  bool out = is_out(f, &cube, k, held);
  bool has_image = hsr_cube_project(frame, &frame->placing, &cube, &image);
  held->out += out;
  held->images += has_image;
  for (uint32_t v = 0; v < cell->n_vertices; v++) {
    double x = frame->tiler.screen.sx[v], y = frame->tiler.screen.sy[v];
    held->vertices++;
    if (out)
      held->wrong += x > 0 && x < M && y > 0 && y < N &&
                     1 > f->view.near * frame->tiler.screen.q[v];
    if (has_image)
      held->wrong += !is_in_image(f, &image, node, v);
  }
}

/* Cameras at the scene's own places, and inside the scene. */
static void test_images(struct tap *tap, const struct laid_out *l,
                        const struct hsr_cubes *cubes, uint64_t *seed) {
  struct held held = {.wrong = 0};
  const struct hsr_world *world = &l->world;
  for (int c = 0; c < 24; c++) {
    struct hsr_camera camera = l->scene->views[(uint32_t)c % l->scene->n_views];
    struct frame f;
    if (c % 3) { /* the eye is near or on something */
      uint32_t v = (uint32_t)draw_integer(seed, 0, world->mesh.n_vertices - 1);
      const double p[3] = {world->mesh.x[v], world->mesh.y[v],
                           world->mesh.z[v]};
      for (int k = 0; k < 3; k++)
        camera.eye[k] =
            p[k] + (c % 3 - 1) * 0.1 * (camera.eye[k] - camera.at[k]);
    }
    begin_frame(&f, l, cubes, &camera);
    for (uint32_t i = 0; i < l->scene->n_instances; i++) {
      hsr_cube_instance(&f.frame, i);
      for (uint32_t k = 0; k < f.frame.object->octree.n_nodes; k++)
        look_at_cube(&f, k, &held);
    }
    hsr_arena_free(&f.scratch);
  }
  ok(tap,
     !held.wrong && held.images > 100 && held.out > 3 && held.vertices > 2000,
     "%s: %ld vertices are where their cubes are, in %ld images; %ld cubes are "
     "out; %ld wrong",
     l->scene->name, held.vertices, held.images, held.out, held.wrong);
  ok(tap, !held.miscounted,
     "each inequality is a step, of which the last decides: of %ld cubes not",
     held.miscounted);
}

/* --- Pairs ---------------------------------------------------------------- */

/* Pairs of faces that exist, at samples that they need not cover. */
static void test_pairs(struct tap *tap, const struct laid_out *l,
                       uint64_t *seed) {
  const struct hsr_world *world = &l->world;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false}, own = tally;
  struct hsr_view view;
  struct hsr_screen screen;
  struct hsr_error err = {.text = "out of memory"};
  static struct hsr_pair pair;
  long asked = 0, wrong = 0, coplanar = 0, apart = 0;
  uint32_t v = (uint32_t)draw_integer(seed, 0, l->scene->n_views - 1);
  must_view(&view, &l->scene->views[v], M, N);
  if (hsr_screen_make(&screen, world, &view, &arena, &tally) ||
      hsr_pair_init(&pair, &l->outline, &view, &arena))
    bail("%s: %s", l->scene->name, err.text);
  for (int k = 0; k < 30000; k++) {
    uint32_t f = (uint32_t)draw_integer(seed, 0, world->n_faces - 1);
    uint32_t g = (uint32_t)draw_integer(seed, 0, world->n_faces - 1);
    for (uint32_t h = 0; k % 2 && h < world->n_faces; h++) {
      g = (g + 1) % world->n_faces; /* seeks one on the same plane */
      if (g != f && world->mesh.plane[g] == world->mesh.plane[f])
        break;
    }
    int i = (int)draw_integer(seed, 0, M - 1),
        j = (int)draw_integer(seed, 0, N - 1);
    if (f == g || !hsr_face_exists(&screen, f, &tally) ||
        !hsr_face_exists(&screen, g, &tally))
      continue;
    bool same = world->mesh.plane[f] == world->mesh.plane[g];
    asked++;
    coplanar += same;
    apart += same && world->mesh.instance[f] != world->mesh.instance[g];
    wrong += hsr_pair_nearer(&pair, f, g, i, j, &own) !=
             hsr_nearer(&screen, f, g, i, j, &tally);
  }
  bool grid = strcmp(l->scene->name, "mirrors") == 0;
  ok(tap, !wrong && asked > 1000 && (!grid || apart > 10000),
     "%s: %ld pairs of faces compare as laid out, %ld on one plane, %ld of "
     "these in two instances; %ld wrong",
     l->scene->name, asked, coplanar, apart, wrong);
  hsr_arena_free(&arena);
}

/* One object in many places where its faces coincide. */
static struct hsr_scene *mirrors(uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("mirrors");
  struct hsr_object *object = hsr_scene_object(scene, "faces");
  add_faces(object, 40, seed);
  for (int k = 0; k < 12; k++) {
    double m[12] = {0};
    for (int a = 0; a < 3; a++) /* the same again, or moved along an axis */
      m[5 * a] = 1;
    m[4 * (k % 3) + 3] = k / 6 * 3;
    hsr_scene_instance(scene, 0, m);
  }
  must_finish(scene);
  return scene;
}

static struct laid_out open_scene(const char *name) {
  struct laid_out l;
  l.scene = must_open(name);
  lay_out(&l);
  return l;
}

static void try_scene(struct tap *tap, struct laid_out *l, bool enclosing,
                      uint64_t *seed) {
  static const struct hsr_octree_rule rules[] = {{0.1, 8, 8}, {0, 8, 1}};
  struct hsr_cubes cubes;
  struct hsr_error err;
  struct frame f;
  if (hsr_cubes_init(&cubes, &l->outline, &rules[enclosing], &err))
    bail("%s: %s", l->scene->name, err.text);
  begin_frame(&f, l, &cubes, &l->scene->views[0]);
  test_cells(tap, &f, l, &cubes, enclosing);
  hsr_arena_free(&f.scratch);
  if (enclosing) {
    test_bounds(tap, l, &cubes);
    test_images(tap, l, &cubes, seed);
  }
  hsr_cubes_free(&cubes);
}

int main(void) {
  static const char *const scenes[] = {"office:1", "terrain:16:3", "twist:3",
                                       "house"};
  enum { SCENES = sizeof scenes / sizeof *scenes };
  struct tap tap = plan(3 + 5 * (SCENES + 1) + 3);
  uint64_t seed = 1995;
  struct laid_out l = {.scene = all_kinds(&seed)};
  struct hsr_cubes cubes;
  struct hsr_error err;
  static const struct hsr_octree_rule rule = {0.1, 8, 8};
  lay_out(&l);
  if (hsr_cubes_init(&cubes, &l.outline, &rule, &err))
    bail("%s: %s", l.scene->name, err.text);
  test_loose(&tap, &l, &cubes);
  test_loose_world(&tap, &l, &cubes);
  hsr_cubes_free(&cubes);
  try_scene(&tap, &l, false, &seed);
  try_scene(&tap, &l, true, &seed);
  test_pairs(&tap, &l, &seed);
  free_all(&l);
  for (int k = 0; k < SCENES; k++) {
    l = open_scene(scenes[k]);
    try_scene(&tap, &l, false, &seed);
    try_scene(&tap, &l, true, &seed);
    if (k == 3)
      test_pairs(&tap, &l, &seed);
    free_all(&l);
  }
  l = (struct laid_out){.scene = mirrors(&seed)};
  lay_out(&l);
  test_pairs(&tap, &l, &seed);
  free_all(&l);
  return finish(&tap);
}
