/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Potentially visible sets of cells, found before any view.
 *
 * Holds       The set of a cell holds every face that the oracle sees from
 *             random eyes in it, whatever way they look.
 * Larger      How much larger it is than what all these eyes see together, and
 *             than all faces.
 * Doors       Without doors a room's set is the room.
 * Lines       Every cell that a random line gets into by portals is in the set
 *             of the cell that it comes from; and nearly all of a set is found
 *             so.
 *
 * usage: cell_sets_test [EYES [SCENE...]]    in each cell; standard: 8. With a
 * SCENE, only the first two of these are tested, and each cell has a line */
#include "bench/modules/modules.h"
#include "algorithms/hierarchical/culling/cell_sets.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 12, N = 9 };

struct building {
  struct claim_scene scene;
  struct hsr_portals portals;
  struct hsr_cell_sets sets;
  struct hsr_box bounds;   /* of the scene, and somewhat more */
  struct hsr_setup oracle; /* of all eyes */
};

/* --- A building whose doors are anywhere ---------------------------------- */

enum { ROOMS = 6 };

static void draw_rectangle(struct hsr_object *o, const double lo[3],
                           const double hi[3], int axis) {
  uint32_t v[4];
  int a = (axis + 1) % 3, b = (axis + 2) % 3;
  for (int k = 0; k < 4; k++) {
    double at[3] = {lo[0], lo[1], lo[2]};
    at[a] = k == 1 || k == 2 ? hi[a] : lo[a];
    at[b] = k > 1 ? hi[b] : lo[b];
    if (hsr_object_vertex(o, at[0], at[1], at[2], &v[k]))
      abort();
  }
  if (hsr_object_face(o, v, 4, NULL))
    abort();
}

/* A wall across x or z, 8 long and 4 high from `at` on, around a door. */
static void draw_wall(struct hsr_object *o, int axis, const double at[3],
                      bool door, uint64_t *seed) {
  int along = 2 - axis;
  double from = at[along] + 0.25 * (double)draw_integer(seed, 1, 20);
  double to = from + 0.25 * (double)draw_integer(seed, 2, 8);
  double top = 0.25 * (double)draw_integer(seed, 4, 14);
  const double part[4][4] = {{at[along], door ? from : at[along] + 8, 0, 4},
                             {to, at[along] + 8, 0, 4},
                             {from, to, top, 4}};
  for (int k = 0; k < (door ? 3 : 1); k++) {
    double lo[3] = {at[0], part[k][2], at[2]};
    double hi[3] = {at[0], part[k][3], at[2]};
    lo[along] = part[k][0];
    hi[along] = part[k][1];
    draw_rectangle(o, lo, hi, axis);
  }
}

static struct hsr_scene *random_building(uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("building");
  struct hsr_object *o = hsr_scene_object(scene, "building");
  struct hsr_camera camera = {
      .eye = {4, 2, 4}, .at = {5, 2, 4}, .up = {0, 1, 0}, .fov = 90};
  for (int i = 0; i <= ROOMS; i++)
    for (int j = 0; j < ROOMS; j++)
      for (int axis = 0; axis < 3; axis += 2) {
        const double at[3] = {axis ? 8.0 * j : 8.0 * i, 0,
                              axis ? 8.0 * i : 8.0 * j};
        draw_wall(o, axis, at,
                  i > 0 && i < ROOMS && draw_integer(seed, 0, 3) > 0, seed);
      }
  for (int level = 0; level < 2; level++) {
    const double lo[3] = {0, 4 * level, 0}, hi[3] = {8 * ROOMS, 0, 8 * ROOMS};
    draw_rectangle(o, lo, hi, 1);
  }
  if (hsr_scene_view(scene, &camera))
    abort();
  must_finish(scene);
  return scene;
}

/* A named scene; NULL: a random building. */
static void open_building(struct building *b, const char *name,
                          uint64_t *seed) {
  memset(b, 0, sizeof *b);
  if (name) {
    claim_open(&b->scene, name, 0, M, N);
  } else {
    b->scene.worlds.scene = random_building(seed);
    must_world(&b->scene.worlds.world, b->scene.worlds.scene);
    must_roster(&b->scene.worlds.roster, b->scene.worlds.scene);
  }
  const struct hsr_world *world = &b->scene.worlds.world;
  const double *at[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
  if (hsr_portals_init(&b->portals, world) ||
      hsr_cell_sets_init(&b->sets, &b->portals, &b->portals.arena))
    abort();
  for (int k = 0; k < 3; k++) {
    double lo = INFINITY, hi = -INFINITY;
    for (size_t v = 0; v < world->mesh.n_vertices; v++) {
      lo = fmin(lo, at[k][v]);
      hi = fmax(hi, at[k][v]);
    }
    b->bounds.lo[k] = lo - (hi - lo) / 8;
    b->bounds.hi[k] = hi + (hi - lo) / 8;
  }
}

static void close_building(struct building *b) {
  hsr_portals_free(&b->portals);
  claim_close(&b->scene);
}

/* --- Sets ----------------------------------------------------------------- */

/* The faces of each cell's set: 1 a cell and a face. To be freed. */
static unsigned char *list_sets(const struct building *b) {
  const struct hsr_portals *p = &b->portals;
  size_t n = b->scene.worlds.world.n_faces;
  unsigned char *holds = calloc(p->n_cells * n, 1);
  if (!holds)
    abort();
  for (uint32_t from = 0; from < p->n_cells; from++) {
    for (uint32_t k = 0; k < p->n_loose; k++)
      holds[from * n + p->loose[k]] = 1;
    for (uint32_t c = 0; c < p->n_cells; c++)
      for (uint32_t k = p->first_face[c];
           hsr_cell_sees(&b->sets, from, c) && k < p->first_face[c + 1]; k++)
        holds[from * n + p->face[k]] = 1;
  }
  return holds;
}

/* A camera within a cell; one of eight at a side, at an edge or at a corner. */
static struct hsr_camera random_camera(const struct building *b, uint32_t cell,
                                       uint64_t *seed) {
  const struct hsr_box *box = &b->portals.cell[cell];
  struct hsr_camera camera = {.fov = 100};
  bool apart = draw_integer(seed, 0, 7) > 0;
  for (int k = 0; k < 3; k++) {
    double lo = fmax(box->lo[k], b->bounds.lo[k]);
    double hi = fmin(box->hi[k], b->bounds.hi[k]);
    long parts = apart || draw_integer(seed, 0, 1) ? 1 << 20 : 1;
    double part = (double)draw_integer(seed, 0, parts) / (double)parts;
    camera.eye[k] = fmin(hi, fmax(lo, lo + part * (hi - lo)));
    camera.at[k] = camera.eye[k] + (double)draw_integer(seed, -99, 99) + 0.5;
    camera.up[k] = (double)draw_integer(seed, -99, 99) + 0.25;
  }
  return camera;
}

struct sums {
  long eyes, lacking, cells;
  double in_sets, seen;
};

struct cells_at {
  uint32_t cell[8];
  int n;
};

static void add_cell(void *context, uint32_t cell) {
  struct cells_at *at = context;
  if (at->n < 8)
    at->cell[at->n++] = cell;
}

static void open_oracle(struct building *b) {
  must_setup(&b->oracle, hsr_algorithm_find("oracle")->plain, NULL,
             &b->scene.worlds.roster);
}

static void ask_oracle(const struct building *b, const struct hsr_view *view,
                       struct hsr_arena *scratch, uint32_t ids[M * N]) {
  struct hsr_error err;
  struct hsr_tally tally = {.trace = NULL};
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {
      .view = view, .scratch = scratch, .tally = &tally, .answer = &answer};
  hsr_arena_reset(scratch);
  memset(ids, 0xfe, M * N * sizeof *ids);
  if (hsr_setup_render(&b->oracle, &job, &err))
    abort();
}

/* What is seen from an eye is in a set of a cell that holds it: an eye on a
 * wall is in two cells, and sees both. `seen` is of the eyes in one cell. */
static void look(const struct building *b, long eyes, uint32_t cell,
                 const unsigned char *holds, struct sums *sums) {
  size_t n = b->scene.worlds.world.n_faces;
  uint64_t seed = 7 + cell;
  unsigned char *seen = calloc(n, 1);
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  if (!seen)
    abort();
  for (long k = 0; k < eyes; k++) {
    struct hsr_camera camera = random_camera(b, cell, &seed);
    struct hsr_box point;
    struct cells_at at = {.n = 0};
    struct hsr_view view;
    uint32_t ids[M * N];
    memcpy(point.lo, camera.eye, sizeof point.lo);
    memcpy(point.hi, camera.eye, sizeof point.hi);
    hsr_portals_find(&b->portals, &point, add_cell, &at);
    if (hsr_view_init(&view, &camera, M, N, NULL))
      continue;
    ask_oracle(b, &view, &scratch, ids);
    sums->eyes++;
    for (int s = 0; s < M * N; s++) {
      uint32_t f = ids[s];
      bool held = f == HSR_BACKGROUND;
      for (int c = 0; c < at.n && !held; c++)
        held = holds[at.cell[c] * n + f];
      sums->lacking += !held;
      if (f == HSR_BACKGROUND || at.n > 1 || seen[f])
        continue;
      seen[f] = 1;
      sums->seen++;
    }
  }
  hsr_arena_free(&scratch);
  free(seen);
}

/* `tell`: of each cell, as it is done. */
static void check_building(struct tap *tap, const char *name, long eyes,
                           double most, bool tell) {
  struct building b;
  struct sums sums = {0};
  open_building(&b, name, NULL);
  size_t n = b.scene.worlds.world.n_faces;
  unsigned char *holds = list_sets(&b);
  open_oracle(&b);
  for (uint32_t c = 0; c < b.portals.n_cells; c++) {
    for (uint32_t f = 0; f < n; f++)
      sums.in_sets += holds[c * n + f];
    look(&b, eyes, c, holds, &sums);
    sums.cells++;
    if (tell) {
      printf("# cell %ld of %u: %ld eyes so far, %ld faces lacking\n",
             sums.cells, b.portals.n_cells, sums.eyes, sums.lacking);
      fflush(stdout);
    }
  }
  hsr_setup_free(&b.oracle);
  free(holds);
  double cells = (double)sums.cells;
  ok(tap,
     (double)sums.eyes > 0.9 * (double)eyes * cells && !sums.lacking &&
         sums.seen > 0,
     "%s: %ld eyes in %ld cells see nothing that the sets of their cells lack "
     "(%ld)",
     name, sums.eyes, sums.cells, sums.lacking);
  ok(tap, sums.in_sets < most * (double)n * cells && sums.in_sets >= sums.seen,
     "%s: a set has %.0f faces of %zu; %.1f are seen, so it is %.2f times as "
     "large",
     name, sums.in_sets / cells, n, sums.seen / cells,
     sums.in_sets / sums.seen);
  close_building(&b);
}

/* --- Doors ---------------------------------------------------------------- */

/* The cell that holds a point. */
static void take(void *context, uint32_t cell) {
  *(uint32_t *)context = cell;
}

static uint32_t cell_at(const struct building *b, double x, double y,
                        double z) {
  uint32_t cell = 0;
  struct hsr_box point = {{x, y, z}, {x, y, z}};
  hsr_portals_find(&b->portals, &point, take, &cell);
  return cell;
}

static uint32_t size_of_set(const struct building *b, uint32_t from) {
  uint32_t n = 0;
  for (uint32_t c = 0; c < b->portals.n_cells; c++)
    n += hsr_cell_sees(&b->sets, from, c);
  return n;
}

static void check_doors(struct tap *tap) {
  struct building closed, open;
  open_building(&closed, "rooms:4:0", NULL);
  open_building(&open, "rooms:4:100", NULL);
  uint32_t alone = 0, most = 0;
  for (int room = 0; room < 16; room++) {
    double x = 4 + 8 * (room % 4), z = 4 + 8 * (room / 4);
    alone += size_of_set(&closed, cell_at(&closed, x, 2, z)) == 1;
    uint32_t n = size_of_set(&open, cell_at(&open, x, 2, z));
    most = n > most ? n : most;
  }
  ok(tap, alone == 16, "without doors %u rooms of 16 see themselves alone",
     alone);
  /* Doors are in the middle of walls, so a line along a diagonal goes through
   * all rooms on it. */
  ok(tap, most == 16, "with doors a room sees %u rooms of 16 at most", most);
  close_building(&closed);
  close_building(&open);
}

/* --- Lines ---------------------------------------------------------------- */

/* Where a line leaves a cell: its exit along an axis, and the portal there.
 * NULL if there is a wall, or too little room between the line and the portal's
 * edge to be sure. */
static const struct hsr_portal *leave(const struct hsr_portals *p,
                                      uint32_t cell, const double eye[3],
                                      const double along[3]) {
  double t[3];
  int axis = 0;
  for (int k = 0; k < 3; k++) {
    const struct hsr_box *box = &p->cell[cell];
    t[k] = ((along[k] > 0 ? box->hi : box->lo)[k] - eye[k]) / along[k];
    axis = t[k] < t[axis] ? k : axis;
  }
  for (uint32_t k = p->first_portal[cell]; k < p->first_portal[cell + 1]; k++) {
    const struct hsr_portal *portal = &p->portal[p->of_cell[k]];
    bool within =
        portal->axis == axis && (portal->cell[0] == cell) == (along[axis] > 0);
    for (int b = 0; b < 3; b++) {
      double at = eye[b] + t[axis] * along[b];
      within &= b == axis || (at > portal->box.lo[b] + 1e-9 &&
                              at < portal->box.hi[b] - 1e-9);
    }
    if (within)
      return portal;
  }
  return NULL;
}

struct found {
  unsigned char *pair; /* n x n */
  long pairs, lacking, lines;
};

/* Follows a line from a random point of a cell through one of its portals. */
static void follow_line(const struct building *b, uint32_t from, uint64_t *seed,
                        struct found *found) {
  const struct hsr_portals *p = &b->portals;
  uint32_t n_of_cell = p->first_portal[from + 1] - p->first_portal[from];
  if (!n_of_cell)
    return;
  long which = draw_integer(seed, 0, (int64_t)n_of_cell - 1);
  const struct hsr_portal *portal =
      &p->portal[p->of_cell[p->first_portal[from] + (uint32_t)which]];
  double eye[3], along[3];
  for (int k = 0; k < 3; k++) {
    double lo = fmax(p->cell[from].lo[k], b->bounds.lo[k]);
    double hi = fmin(p->cell[from].hi[k], b->bounds.hi[k]);
    double first = fmax(portal->box.lo[k], b->bounds.lo[k]);
    double last = fmin(portal->box.hi[k], b->bounds.hi[k]);
    eye[k] = lo + (hi - lo) * (double)draw_integer(seed, 1, 9999) / 1e4;
    along[k] =
        first + (last - first) * (double)draw_integer(seed, 1, 9999) / 1e4;
    along[k] -= eye[k];
  }
  found->lines++;
  for (uint32_t cell = from; (portal = leave(p, cell, eye, along));) {
    cell = portal->cell[portal->cell[0] == cell];
    unsigned char *pair = &found->pair[(size_t)from * p->n_cells + cell];
    found->lacking += !hsr_cell_sees(&b->sets, from, cell);
    found->pairs += !*pair;
    *pair = 1;
  }
}

static void look_along_lines(struct building *b, uint64_t *seed,
                             struct found *found, long *in_sets) {
  uint32_t n = b->portals.n_cells;
  found->pair = calloc(n, n);
  if (!found->pair)
    abort();
  for (uint32_t from = 0; from < n; from++) {
    for (int k = 0; k < 2000; k++)
      follow_line(b, from, seed, found);
    for (uint32_t to = 0; to < n; to++)
      *in_sets += from != to && hsr_cell_sees(&b->sets, from, to);
  }
  free(found->pair);
}

static void check_lines(struct tap *tap, const char *name, int buildings,
                        double tight) {
  struct found found = {.pair = NULL};
  uint64_t seed = 11;
  long in_sets = 0;
  for (int k = 0; k < buildings; k++) {
    struct building b;
    open_building(&b, name, &seed);
    look_along_lines(&b, &seed, &found, &in_sets);
    close_building(&b);
  }
  ok(tap,
     !found.lacking && (double)found.pairs > tight * (double)in_sets &&
         found.pairs <= in_sets,
     "%s: %ld lines find %ld pairs of cells of the %ld in sets, and no other "
     "(%ld)",
     name ? name : "doors anywhere", found.lines, found.pairs, in_sets,
     found.lacking);
}

int main(int argc, char **argv) {
  long eyes = argc > 1 ? atol(argv[1]) : 8;
  struct tap tap = plan(argc > 2 ? 2 * (argc - 2) : 11);
  for (int k = 2; k < argc; k++)
    check_building(&tap, argv[k], eyes, 1.01, true);
  if (argc > 2)
    return finish(&tap);
  check_building(&tap, "rooms:5", eyes, 0.9, false);
  check_building(&tap, "rooms:8:60", eyes, 0.5, false);
  check_building(&tap, "office:1", eyes, 1.01, false);
  check_doors(&tap);
  check_lines(&tap, "rooms:7:60", 1, 0.99);
  check_lines(&tap, "rooms:5:100", 1, 0.9);
  check_lines(&tap, NULL, 12, 0.81);
  return finish(&tap);
}
