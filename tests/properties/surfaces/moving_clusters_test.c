/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 say of Schumacker's algorithm: it tolerates motion
 * of clusters, whose face priorities are a property of the cluster alone. With
 * frames=kept, face priorities are found in the first frame and in no other, and
 * every frame shows what the oracle shows. */
#include "bench/modules/modules.h"
#include "bench/modules/variant.h"
#include "common/exact/predicates.h"
#include "common/scene/clusters.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

enum { M = 61, N = 47, FRAMES = 24 };

/* How the things of a scene move. */
enum motion { STEPS, TURNS, TUMBLES, MIRRORED };

/* The things: those before BOX have no four corners in one plane. */
enum { TETRAHEDRON, OCTAHEDRON, BOX, TOWER, THINGS };

/* What is tried. once: face priorities must be found in the first frame, and in
 * no other. Not so where rounding may make faces that touch penetrate; nor where
 * the things are mirrored, and the order of their corners turned round. */
static const struct trial {
  const char *name;
  enum motion motion;
  int n_things;
  bool once;
} trials[] = {
    {"by steps of 1/8", STEPS, THINGS, true},
    {"turning about a vertical axis", TURNS, THINGS, true},
    {"tumbling", TUMBLES, BOX, true},
    {"tumbling, with boxes", TUMBLES, THINGS, false},
    {"mirrored in every other frame", MIRRORED, BOX, false},
    {"mirrored in every other frame, with boxes", MIRRORED, THINGS, false}};
enum { TRIALS = sizeof trials / sizeof *trials };

/* --- Objects -------------------------------------------------------------- */

/* A box of twelve triangles. */
static void add_box(struct hsr_object *o, const double lo[3],
                    const double hi[3]) {
  static const int side[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  uint32_t v[8];
  for (int k = 0; k < 8; k++)
    if (hsr_object_vertex(o, k & 1 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1],
                          k & 4 ? hi[2] : lo[2], &v[k]))
      bail("no vertex");
  for (int k = 0; k < 6; k++)
    for (int half = 0; half < 2; half++) {
      uint32_t t[3] = {v[side[k][0]], v[side[k][1 + half]],
                       v[side[k][2 + half]]};
      if (hsr_object_face(o, t, 3, NULL))
        bail("no face");
    }
}

static void add_solid(struct hsr_object *o, const double (*at)[3], int n,
                      const uint32_t (*face)[3], int n_faces) {
  for (int k = 0; k < n; k++)
    if (hsr_object_vertex(o, at[k][0], at[k][1], at[k][2], NULL))
      bail("no vertex");
  for (int k = 0; k < n_faces; k++)
    if (hsr_object_face(o, face[k], 3, NULL))
      bail("no face");
}

static void add_tetrahedron(struct hsr_object *o) {
  static const double at[4][3] = {
      {0, 0, 0}, {1, 0.125, 0}, {0.25, 1, 0.125}, {0.125, 0.25, 1}};
  static const uint32_t face[4][3] = {
      {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  add_solid(o, at, 4, face, 4);
}

static void add_octahedron(struct hsr_object *o) {
  static const double at[6][3] = {{1, 0.125, 0},  {-1, 0, 0.125},
                                  {0, 1, -0.125}, {0.125, -1, 0},
                                  {0, 0.0625, 1}, {0.0625, 0, -1}};
  static const uint32_t face[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4},
                                      {3, 0, 4}, {2, 0, 5}, {1, 2, 5},
                                      {3, 1, 5}, {0, 3, 5}};
  add_solid(o, at, 6, face, 8);
}

/* A base, and a tower that stands upon it: they touch. */
static void add_tower(struct hsr_object *o) {
  add_box(o, (double[]){-0.75, -0.5, -0.5}, (double[]){0.75, 0, 0.5});
  add_box(o, (double[]){-0.25, 0, -0.25}, (double[]){0.25, 1, 0.25});
}

/* The place of instance k in a frame. The places are far enough apart for
 * planes to pass between. */
static void place(double m[12], enum motion motion, int k, int frame) {
  double about = motion == STEPS ? 0 : 0.37 * frame + k;
  double over = motion >= TUMBLES ? 0.23 * frame + 2 * k : 0;
  double c = cos(about), s = sin(about), d = cos(over), e = sin(over);
  double turn[9] = {c, 0, s, e * s, d, -e * c, -d * s, e, d * c};
  for (int row = 0; row < 3; row++)
    memcpy(m + 4 * row, turn + 3 * row, 3 * sizeof *turn);
  for (int row = 0; row < 3 && motion == MIRRORED && frame % 2; row++)
    m[4 * row] = -m[4 * row];
  m[3] = 4 * (k % 3) + 0.125 * frame;
  m[7] = motion == STEPS ? 0.125 * (frame % 8) : 0.07 * frame;
  m[11] = -5 * (k / 3);
}

/* A still board, and two instances each of things that move. */
static struct hsr_scene *make_scene(const struct trial *trial, bool one_sided,
                                    int frame) {
  struct hsr_scene *scene = hsr_scene_new("movers");
  static const struct hsr_camera eye = {
      .eye = {3, 6, 14}, .at = {5, 1, -2}, .up = {0, 1, 0}, .fov = 60};
  for (int k = 0; k <= trial->n_things; k++) {
    bool moves = k < trial->n_things;
    struct hsr_object *o = hsr_scene_object(scene, moves ? "it" : "board");
    if (!o)
      bail("no object");
    o->moves = moves;
    o->one_sided = one_sided;
    if (!moves)
      add_box(o, (double[]){-3, -2, -20}, (double[]){14, -1.75, -9});
    else if (k == TETRAHEDRON)
      add_tetrahedron(o);
    else if (k == OCTAHEDRON)
      add_octahedron(o);
    else if (k == BOX)
      add_box(o, (double[]){-0.5, -0.5, -0.5}, (double[]){0.5, 0.5, 0.5});
    else
      add_tower(o);
    double m[12];
    for (int i = 0; i < (moves ? 2 : 1); i++) {
      place(m, trial->motion, 2 * k + i, frame);
      if (hsr_scene_instance(scene, (uint32_t)k, moves ? m : NULL))
        bail("no instance");
    }
  }
  if (hsr_scene_view(scene, &eye))
    bail("no view");
  must_finish(scene);
  return scene;
}

/* --- Priorities ----------------------------------------------------------- */

/* Whether a corner of face f lies strictly on that side of the plane of face g, as
 * g is oriented: its front is +1. */
static bool reaches(const struct hsr_world *world, uint32_t f,
                    uint32_t g_oriented, int side) {
  const struct hsr_mesh *mesh = &world->mesh;
  struct hsr_loop plane = hsr_plane_loop(world, g_oriented / 2);
  int turned = g_oriented % 2 ? -side : side;
  bool out_of_memory = false, reaches = false;
  for (uint32_t c = mesh->start[f]; c < mesh->start[f + 1]; c++) {
    uint32_t v = mesh->vertex[c];
    double p[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
    reaches |= hsr_exact_plane_side(plane, p, &out_of_memory) == turned;
  }
  if (out_of_memory)
    bail("no memory");
  return reaches;
}

static bool is_cut(const struct hsr_world *world, uint32_t f) {
  return world->pieces->cut_start[f] < world->pieces->cut_start[f + 1];
}

/* How many faces of clusters, which are not cut, can hide one of higher
 * priority. */
static long count_wrong_priorities(const struct hsr_world *world) {
  const struct hsr_clusters *c = world->clusters;
  long n = 0;
  for (uint32_t k = 0; k < c->n_clusters; k++)
    for (uint32_t i = c->start[k]; i < c->start[k + 1]; i++)
      for (uint32_t h = c->start[k]; h < i; h++) {
        uint32_t lower = c->order[i], higher = c->order[h];
        n += !is_cut(world, lower / 2) && !is_cut(world, higher / 2) &&
             reaches(world, higher / 2, lower, -1) &&
             reaches(world, lower / 2, higher, +1);
      }
  return n;
}

/* --- Frames --------------------------------------------------------------- */

struct sums {
  uint64_t first, later; /* pairs compared: in the first frame, and after */
  uint64_t kept, close;  /* after the first frame */
  uint64_t counted, by_tally; /* the same pairs, and by the counters */
  long wrong, shown, wrong_priorities;
  int n_anew; /* frames after the first in which pairs were compared */
};

static void draw(const struct hsr_setup *setup, const struct hsr_view *view,
                 struct hsr_tally *tally, uint32_t *ids) {
  static struct hsr_arena scratch;
  struct hsr_error err = {.text = ""};
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = tally, .answer = &answer};
  hsr_arena_reset(&scratch);
  memset(ids, 0xfe, (size_t)M * N * sizeof *ids);
  if (hsr_setup_render(setup, &job, &err))
    bail("%s", err.text);
  hsr_arena_free(&scratch);
}

static void add_frame(struct sums *sums, const struct hsr_world *world,
                      const struct hsr_setup *setup, int frame) {
  static uint32_t got[M * N], right[M * N];
  const struct hsr_clusters *c = setup->world->clusters;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_view view;
  must_view(&view, &world->roster.scene->views[0], M, N);
  draw(setup, &view, &tally, got);
  draw_plain("oracle", world, &view, right);
  sums->wrong += count_differences(&view, got, right);
  for (int k = 0; k < M * N; k++)
    sums->shown += right[k] != HSR_BACKGROUND;
  sums->wrong_priorities += count_wrong_priorities(setup->world);
  sums->counted += c->pair_tests + c->close_tests + c->n_kept;
  for (int k = 0; k < 3; k++)
    sums->by_tally += tally.count[setup->algorithm->base[0] + k];
  if (!frame) {
    sums->first = c->pair_tests;
    return;
  }
  sums->later += c->pair_tests;
  sums->kept += c->n_kept;
  sums->close += c->close_tests;
  sums->n_anew += c->pair_tests > 0;
}

static struct sums run(const char *name, const struct trial *trial,
                       bool one_sided) {
  struct hsr_variant variant;
  struct hsr_error err = {.text = ""};
  struct hsr_setup setup;
  struct hsr_scene *last = NULL;
  struct hsr_world world;
  struct sums sums = {.first = 0};
  if (hsr_variant_parse(name, &variant, &err))
    bail("%s", err.text);
  for (int frame = 0; frame < FRAMES; frame++) {
    struct hsr_scene *scene = make_scene(trial, one_sided, frame);
    struct hsr_world now;
    bool kept;
    must_world(&now, scene);
    if (!frame)
      must_setup(&setup, variant.listed->counting, &variant.choice, &now);
    else if (hsr_setup_follow(&setup, &now, &kept, &err))
      bail("%s", err.text);
    add_frame(&sums, &now, &setup, frame);
    if (last) {
      hsr_world_free(&world);
      hsr_scene_delete(last);
    }
    world = now;
    last = scene;
  }
  hsr_setup_free(&setup);
  hsr_world_free(&world);
  hsr_scene_delete(last);
  return sums;
}

static void check(struct tap *tap, const struct trial *trial, bool one_sided) {
  const char *of = one_sided ? "solids" : "shells", *how = trial->name;
  struct sums anew = run("schumacker", trial, one_sided);
  struct sums kept = run("schumacker:frames=kept", trial, one_sided);
  printf("# %s, %s: anew %llu pairs, then %llu; kept %llu, then %llu in %d of "
         "%d frames, %llu close pairs, %llu priorities kept\n",
         of, how, (unsigned long long)anew.first,
         (unsigned long long)anew.later, (unsigned long long)kept.first,
         (unsigned long long)kept.later, kept.n_anew, FRAMES - 1,
         (unsigned long long)kept.close, (unsigned long long)kept.kept);
  ok(tap, !anew.wrong && !kept.wrong && kept.shown > 10 * FRAMES,
     "%s, %s: all frames are right", of, how);
  ok(tap, !anew.wrong_priorities && !kept.wrong_priorities,
     "%s, %s: no face can hide one of higher priority; anew %ld can, kept %ld",
     of, how, anew.wrong_priorities, kept.wrong_priorities);
  ok(tap, anew.later >= anew.first * (FRAMES - 1) * 3 / 4 && !anew.kept,
     "%s, %s: anew, the faces are compared in every frame", of, how);
  ok(tap, kept.first && kept.first < anew.first,
     "%s, %s: of two instances of an object, one is compared", of, how);
  ok(tap, kept.counted == kept.by_tally && anew.counted == anew.by_tally,
     "%s, %s: the counters tell the same", of, how);
  if (trial->once)
    ok(tap, !kept.later && kept.kept && (trial->motion != STEPS || !kept.close),
       "%s, %s: face priorities are computed once", of, how);
  else
    ok(tap, kept.later && kept.later + kept.close < anew.later && kept.kept,
       "%s, %s: some are computed again", of, how);
}

int main(void) {
  struct tap tap = plan(6 * 2 * TRIALS);
  for (int k = 0; k < TRIALS; k++)
    for (int one_sided = 0; one_sided < 2; one_sided++)
      check(&tap, &trials[k], one_sided);
  return finish(&tap);
}
