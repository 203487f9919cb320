/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judge of anybody's picture names what is wrong with it. Right pictures of
 * several scenes are spoiled in one way each, by means that the judge does not
 * use: by other algorithms, by loops over all faces. Where that changes a
 * sample, its reason must come first; where the whole picture is another, that
 * must explain all. */
#include "bench/stranger/stranger.h"
#include "common/exact/screen.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 48, N = 36, ALL = M * N };
#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* A scene, and its right picture. */
struct stage {
  const char *name;
  struct lib_scene *judged; /* the judge's own */
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  uint32_t right[ALL];
  int m, n;
  struct lib_camera camera; /* its size is 0: view 1 of the scene */
};

static struct hsr_request request_of(const struct stage *s) {
  return (struct hsr_request){.size = sizeof(struct hsr_request),
                              .camera = s->camera.size ? &s->camera : NULL,
                              .m = s->m,
                              .n = s->n};
}

/* A floor with decals so little above it that 24 bits of depth may lose them. */
static enum hsr_status open_decals(double above, struct lib_scene **scene,
                                   struct hsr_error *err) {
  enum { DECALS = 6 };
  static double xyz[3 * 4 * (1 + DECALS)];
  static uint32_t ring[1 + DECALS], vertex[4 * (1 + DECALS)];
  for (uint32_t f = 0; f <= DECALS; f++) {
    ring[f] = 4;
    for (uint32_t k = 0; k < 4; k++) {
      double *p = xyz + 3 * (4 * f + k);
      const double half = f ? .22 : 1;
      p[0] = (f ? f / 4.0 - 1 : 0) + (k == 1 || k == 2 ? half : -half);
      p[1] = (f ? f % 3 / 2.0 - .5 : 0) + (k > 1 ? half : -half);
      p[2] = f * above;
      vertex[4 * f + k] = 4 * f + k;
    }
  }
  const struct hsr_arrays arrays = {.size = sizeof arrays,
                                    .name = "decals",
                                    .xyz = xyz,
                                    .n_vertices = 4 * (1 + DECALS),
                                    .ring = ring,
                                    .n_faces = 1 + DECALS,
                                    .vertex = vertex,
                                    .n_corners = 4 * (1 + DECALS)};
  return hsr_open_arrays(&arrays, NULL, scene, err);
}

/* With a near plane far before the scene, which takes most of the bits. */
static const char NEAR_DECALS[] = "decals, near plane";
static void come_near(struct stage *s) {
  struct hsr_camera camera = s->view.camera;
  camera.near = 0x1p-6;
  must_view(&s->view, &camera, s->m, s->n);
  s->camera = (struct lib_camera){
      .size = sizeof s->camera, .fov = camera.fov, .near = camera.near};
  memcpy(s->camera.eye, camera.eye, sizeof camera.eye);
  memcpy(s->camera.at, camera.at, sizeof camera.at);
  memcpy(s->camera.up, camera.up, sizeof camera.up);
}

static void set_up(struct stage *s, const char *name, int m, int n) {
  struct hsr_error err;
  enum hsr_status status;
  s->name = name;
  s->m = m;
  s->n = n;
  s->camera = (struct lib_camera){.size = 0};
  if (!strcmp(name, "decals"))
    status = open_decals(0x1p-26, &s->judged, &err);
  else if (!strcmp(name, NEAR_DECALS))
    status = open_decals(0x1p-18, &s->judged, &err);
  else
    status = hsr_open(name, NULL, &s->judged, &err);
  if (status)
    bail("%s", err.text);
  s->scene = s->judged->scene;
  must_world(&s->world, s->scene);
  must_view(&s->view, &s->scene->views[0], m, n);
  if (!strcmp(name, NEAR_DECALS))
    come_near(s);
  draw_plain("raycast", &s->world, &s->view, s->right);
}

static void tear_down(struct stage *s) {
  hsr_world_free(&s->world);
  hsr_close(s->judged);
}

/* --- The whole picture ---------------------------------------------------- */

static void turn_over(const struct stage *s, uint32_t *ids) {
  for (int j = 0; j < s->n; j++)
    memcpy(ids + j * s->m, s->right + (s->n - 1 - j) * s->m,
           (size_t)s->m * sizeof *ids);
}

static void mirror(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = s->right[k / s->m * s->m + s->m - 1 - k % s->m];
}

static void turn_half(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = s->right[s->m * s->n - 1 - k];
}

static void draw_offset(const struct stage *s, double x, double y,
                        uint32_t *ids) {
  struct hsr_view view = s->view;
  view.offset_x = x;
  view.offset_y = y;
  draw_plain("raycast", &s->world, &view, ids);
}
static void move_x(const struct stage *s, uint32_t *ids) {
  draw_offset(s, -.5, 0, ids);
}
static void move_y(const struct stage *s, uint32_t *ids) {
  draw_offset(s, 0, .5, ids);
}
static void move_both(const struct stage *s, uint32_t *ids) {
  draw_offset(s, -.5, -.5, ids);
}

static void draw_camera(const struct stage *s, const struct hsr_camera *camera,
                        uint32_t *ids) {
  struct hsr_view view;
  must_view(&view, camera, s->m, s->n);
  draw_plain("raycast", &s->world, &view, ids);
}

static void halve_angle(const struct stage *s, uint32_t *ids) {
  struct hsr_camera camera = s->view.camera;
  camera.fov /= 2;
  draw_camera(s, &camera, ids);
}

static void double_angle(const struct stage *s, uint32_t *ids) {
  struct hsr_camera camera = s->view.camera;
  camera.fov *= camera.fov < 90 ? 2 : 1;
  draw_camera(s, &camera, ids);
}

/* The angle is that of the width, which makes the height's smaller. */
static void take_as_width(const struct stage *s, uint32_t *ids) {
  struct hsr_camera camera = s->view.camera;
  const double half = camera.fov * (M_PI / 360);
  camera.fov = atan(tan(half) * s->n / s->m) * (360 / M_PI);
  draw_camera(s, &camera, ids);
}

/* As wide as it is high, in as many columns. */
static void stretch(const struct stage *s, uint32_t *ids) {
  struct hsr_view view = s->view, square;
  bool out_of_memory = false;
  must_view(&square, &s->view.camera, s->m, s->m);
  memcpy(view.R, square.R, sizeof view.R);
  if (!hsr_exact_view_matrices(&view, &out_of_memory))
    bail("no view");
  draw_plain("raycast", &s->world, &view, ids);
}

/* Samples from border to border. With a column less, and a row less, they are
 * the corners of the pixels. */
static void spread(const struct stage *s, uint32_t *ids) {
  static uint32_t corner[ALL];
  struct hsr_view view;
  bool out_of_memory = false;
  must_view(&view, &s->view.camera, s->m - 1, s->n - 1);
  memcpy(view.R, s->view.R, sizeof view.R);
  if (!hsr_exact_view_matrices(&view, &out_of_memory))
    bail("no view");
  for (int k = 0; k < 4; k++) {
    const int x = k % 2, y = k / 2;
    view.offset_x = x - .5;
    view.offset_y = y - .5;
    draw_plain("raycast", &s->world, &view, corner);
    for (int j = 0; j < s->n - 1; j++)
      for (int i = 0; i < s->m - 1; i++)
        ids[(j + y) * s->m + i + x] = corner[j * (s->m - 1) + i];
  }
}

/* Part of a picture that has a column, or a row, more at each side. */
static void draw_cut(const struct stage *s, int left, int top, uint32_t *ids) {
  static uint32_t larger[(M + 2) * (N + 2)];
  struct hsr_view view;
  bool out_of_memory = false;
  must_view(&view, &s->view.camera, s->m + 2, s->n + 2);
  for (int k = 0; k < 3; k++) {
    view.R[k] = s->view.R[k] * (s->m + 2) / s->m;
    view.U[k] = s->view.U[k] * (s->n + 2) / s->n;
  }
  if (!hsr_exact_view_matrices(&view, &out_of_memory))
    bail("no view");
  draw_plain("raycast", &s->world, &view, larger);
  for (int j = 0; j < s->n; j++)
    memcpy(ids + j * s->m, larger + (j + top) * (s->m + 2) + left,
           (size_t)s->m * sizeof *ids);
}
static void shift_left(const struct stage *s, uint32_t *ids) {
  draw_cut(s, 2, 1, ids);
}
static void shift_down(const struct stage *s, uint32_t *ids) {
  draw_cut(s, 1, 0, ids);
}
static void shift_both(const struct stage *s, uint32_t *ids) {
  draw_cut(s, 0, 2, ids);
}

static void show_view_2(const struct stage *s, uint32_t *ids) {
  draw_camera(s, &s->scene->views[1], ids);
}

/* As somebody writes a picture of n columns and m rows into an array of n rows. */
static void transpose(const struct stage *s, uint32_t *ids) {
  static uint32_t exchanged[ALL];
  struct hsr_view view;
  must_view(&view, &s->view.camera, s->n, s->m);
  draw_plain("raycast", &s->world, &view, exchanged);
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = exchanged[k % s->m * s->n + k / s->m];
}

/* Middle depths of the picture: a plane there cuts something off. */
static double middle_depth(const struct stage *s) {
  static float depth[ALL];
  double sum = 0;
  int n = 0;
  hsr_picture_depth(&s->world, &s->view, s->right, depth);
  for (int k = 0; k < s->m * s->n; k++)
    if (isfinite(depth[k])) {
      sum += (double)depth[k];
      n++;
    }
  return n ? sum / n : 1;
}

static void cut_near(const struct stage *s, uint32_t *ids) {
  struct hsr_camera camera = s->view.camera;
  camera.near = middle_depth(s);
  draw_camera(s, &camera, ids);
}

static void cut_far(const struct stage *s, uint32_t *ids) {
  static float depth[ALL];
  const double far = middle_depth(s);
  hsr_picture_depth(&s->world, &s->view, s->right, depth);
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = (double)depth[k] > far ? HSR_BACKGROUND : s->right[k];
}

/* --- Numbers -------------------------------------------------------------- */

static void number_from_1(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = s->right[k] == HSR_BACKGROUND ? HSR_BACKGROUND : s->right[k] + 1;
}

static void number_from_1_with_0(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = s->right[k] + 1;
}

/* As OpenGL's glReadPixels and primitives numbered from 1. */
static void number_from_1_and_turn(const struct stage *s, uint32_t *ids) {
  turn_over(s, ids);
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] += ids[k] != HSR_BACKGROUND;
}

static void number_below(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = s->right[k] == HSR_BACKGROUND ? HSR_BACKGROUND : s->right[k] - 1;
}

static void other_background(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = s->right[k] == HSR_BACKGROUND ? 0 : s->right[k];
}

static void number_triangles(const struct stage *s, uint32_t *ids) {
  uint32_t *first = calloc(s->world.n_faces + 1, sizeof *first);
  if (!first)
    bail("no memory");
  for (uint32_t f = 0; f < s->world.n_faces; f++)
    first[f + 1] = first[f] + hsr_face_size(&s->world, f) - 2;
  for (int k = 0; k < s->m * s->n; k++) {
    const uint32_t f = s->right[k];
    ids[k] = f == HSR_BACKGROUND
                 ? f
                 : first[f] + (uint32_t)k % (first[f + 1] - first[f]);
  }
  free(first);
}

/* --- Single samples ------------------------------------------------------- */

/* All faces over a sample, in order: a plain loop. */
struct column {
  uint32_t face[2000];
  int n;
};

struct loops {
  struct hsr_world open; /* seen from both sides */
  struct hsr_screen screen;
  struct hsr_arena arena;
  struct hsr_tally tally;
};

static struct loops *begin_loops(const struct stage *s) {
  struct loops *l = calloc(1, sizeof *l);
  bool *both = calloc(s->world.n_faces, sizeof *both);
  if (!l || !both)
    bail("no memory");
  l->open = s->world;
  l->open.mesh.one_sided = both;
  if (hsr_screen_make(&l->screen, &l->open, &s->view, &l->arena, &l->tally))
    bail("no memory");
  return l;
}

static void end_loops(struct loops *l) {
  hsr_arena_free(&l->arena);
  free(l->open.mesh.one_sided);
  free(l);
}

static void find_column(struct loops *l, int i, int j, struct column *c) {
  c->n = 0;
  for (uint32_t k = 0; k < l->screen.n_relevant; k++) {
    const uint32_t f = l->screen.relevant[k];
    const struct hsr_bounds *b = &l->screen.bounds[f];
    if (i < b->x0 || i >= b->x1 || j < b->y0 || j >= b->y1 ||
        !hsr_covers(&l->screen, f, i, j, &l->tally) || c->n == 2000)
      continue;
    int at = c->n++;
    while (at > 0 &&
           hsr_nearer(&l->screen, f, c->face[at - 1], i, j, &l->tally)) {
      c->face[at] = c->face[at - 1];
      at--;
    }
    c->face[at] = f;
  }
}

static bool is_turned(const struct loops *l, uint32_t f) {
  return l->screen.facing[f] < 0;
}
static bool is_there(const struct stage *s, const struct loops *l, uint32_t f) {
  return !s->world.mesh.one_sided[f] || !is_turned(l, f);
}

/* Which face of a column is chosen by somebody. */
enum chosen { LAST_TIED, ANY_SIDE, TURNED, NOT_TURNED, LOST, LAST };

static bool is_lost(struct loops *l, uint32_t near, uint32_t far, int i, int j,
                    double unit) {
  double by =
      hsr_depth(&l->screen, near, i, j) - hsr_depth(&l->screen, far, i, j);
  return by < unit && by > unit / 64;
}

static uint32_t choose(const struct stage *s, struct loops *l,
                       const struct column *c, enum chosen chosen, int i, int j,
                       double unit) {
  uint32_t first = HSR_BACKGROUND, found = HSR_BACKGROUND;
  for (int k = 0; k < c->n; k++) {
    const uint32_t f = c->face[k];
    const bool there = is_there(s, l, f);
    if (there && first == HSR_BACKGROUND)
      first = found = f;
    if (chosen == ANY_SIDE)
      return f;
    if ((chosen == TURNED && is_turned(l, f)) ||
        (chosen == NOT_TURNED && there && !is_turned(l, f)))
      return f;
    if (chosen == LAST_TIED && there &&
        s->world.mesh.plane[f] == s->world.mesh.plane[first])
      found = f;
    if (chosen == LOST && there && is_lost(l, first, f, i, j, unit))
      found = f;
    if (chosen == LAST && there)
      found = f;
  }
  return chosen == TURNED || chosen == NOT_TURNED ? HSR_BACKGROUND : found;
}

static void choose_all(const struct stage *s, enum chosen chosen, double unit,
                       uint32_t *ids) {
  static struct column column;
  struct loops *l = begin_loops(s);
  for (int j = 0; j < s->n; j++)
    for (int i = 0; i < s->m; i++) {
      find_column(l, i, j, &column);
      ids[j * s->m + i] = choose(s, l, &column, chosen, i, j, unit);
    }
  end_loops(l);
}

static void turn_ties(const struct stage *s, uint32_t *ids) {
  choose_all(s, LAST_TIED, 0, ids);
}
static void show_backs(const struct stage *s, uint32_t *ids) {
  choose_all(s, ANY_SIDE, 0, ids);
}
static void cull_fronts(const struct stage *s, uint32_t *ids) {
  choose_all(s, TURNED, 0, ids);
}
static void cull_backs(const struct stage *s, uint32_t *ids) {
  choose_all(s, NOT_TURNED, 0, ids);
}
static void show_farthest(const struct stage *s, uint32_t *ids) {
  choose_all(s, LAST, 0, ids);
}

/* Where columns and rows are both even: right elsewhere. */
static void show_hidden(const struct stage *s, uint32_t *ids) {
  show_farthest(s, ids);
  for (int k = 0; k < s->m * s->n; k++)
    if (k % s->m % 2 || k / s->m % 2)
      ids[k] = s->right[k];
}

/* By number alone. */
static void choose_numbers(const struct stage *s, bool last, uint32_t *ids) {
  static struct column column;
  struct loops *l = begin_loops(s);
  for (int k = 0; k < s->m * s->n; k++) {
    uint32_t chosen = HSR_BACKGROUND;
    find_column(l, k % s->m, k / s->m, &column);
    for (int c = 0; c < column.n; c++) {
      const uint32_t f = column.face[c];
      if (is_there(s, l, f) &&
          (chosen == HSR_BACKGROUND || (last ? f > chosen : f < chosen)))
        chosen = f;
    }
    ids[k] = chosen;
  }
  end_loops(l);
}
static void paint_all(const struct stage *s, uint32_t *ids) {
  choose_numbers(s, true, ids);
}
static void keep_first(const struct stage *s, uint32_t *ids) {
  choose_numbers(s, false, ids);
}

/* A face is lost if it is nearer by less than three quarters of a unit. */
static void lose_depth(const struct stage *s, uint32_t *ids) {
  static float depth[ALL];
  double least = INFINITY, most = 0;
  hsr_picture_depth(&s->world, &s->view, s->right, depth);
  for (int k = 0; k < s->m * s->n; k++) {
    double t = (double)depth[k];
    least = fmin(t, least);
    most = isfinite(t) ? fmax(t, most) : most;
  }
  least = s->view.near > 0 ? s->view.near : least;
  choose_all(s, LOST,
             .75 * 0x1p-24 *
                 (s->view.parallel ? most - least : 1 / least - 1 / most),
             ids);
}

/* Samples here and there show what is a little beside them. */
static void shake(const struct stage *s, uint32_t *ids) {
  static uint32_t beside[4][ALL];
  static const double by = .375;
  for (int k = 0; k < 4; k++)
    draw_offset(s, k % 2 ? by : -by, k / 2 ? by : -by, beside[k]);
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = beside[(unsigned)k * 2654435761u >> 30][k];
}

static void draw_nothing(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = HSR_BACKGROUND;
}

static void throw_dice(const struct stage *s, uint32_t *ids) {
  for (int k = 0; k < s->m * s->n; k++)
    ids[k] = (unsigned)k * 2654435761u >> 28
                 ? s->right[k]
                 : (uint32_t)((unsigned)k * 40503u % s->world.n_faces);
}

/* --- All of them ---------------------------------------------------------- */

static const struct {
  const char *what;
  void (*spoil)(const struct stage *s, uint32_t *ids);
  enum stranger_kind kind;
  bool all; /* the reason explains all samples */
} spoils[] = {
    {"turned over", turn_over, STRANGER_TURNED, true},
    {"mirrored", mirror, STRANGER_MIRRORED, true},
    {"turned by half", turn_half, STRANGER_HALF_TURN, true},
    {"half a sample off in x", move_x, STRANGER_PLACES, true},
    {"half a sample off in y", move_y, STRANGER_PLACES, true},
    {"half a sample off in both", move_both, STRANGER_PLACES, true},
    {"transposed", transpose, STRANGER_TRANSPOSED, true},
    {"samples from border to border", spread, STRANGER_PLACES, true},
    {"a column to the left", shift_left, STRANGER_SHIFTED, true},
    {"a row down", shift_down, STRANGER_SHIFTED, true},
    {"a column to the right and a row up", shift_both, STRANGER_SHIFTED, true},
    {"view 2", show_view_2, STRANGER_VIEW, true},
    {"half the angle", halve_angle, STRANGER_FIELD, true},
    {"twice the angle", double_angle, STRANGER_FIELD, true},
    {"the angle of the width", take_as_width, STRANGER_FIELD, true},
    {"stretched", stretch, STRANGER_FIELD, true},
    {"another near plane", cut_near, STRANGER_NEAR, true},
    {"a far plane", cut_far, STRANGER_FAR, true},
    {"ids from 1", number_from_1, STRANGER_IDS, true},
    {"ids from 1, 0 is none", number_from_1_with_0, STRANGER_IDS, true},
    {"ids from 1, and turned over", number_from_1_and_turn, STRANGER_TURNED,
     true},
    {"ids one too low", number_below, STRANGER_IDS, true},
    {"0 is none", other_background, STRANGER_NO_FACE, true},
    {"ids of triangles", number_triangles, STRANGER_TRIANGLES, true},
    {"the last of a tie", turn_ties, STRANGER_TIE, true},
    {"backs shown", show_backs, STRANGER_BACK, false},
    {"fronts culled", cull_fronts, STRANGER_FRONT_CULLED, false},
    {"backs culled", cull_backs, STRANGER_BACK_CULLED, false},
    {"beside edges", shake, STRANGER_EDGE, false},
    {"lost by depth", lose_depth, STRANGER_DEPTH, false},
    {"the farthest", show_farthest, STRANGER_FARTHEST, false},
    {"hidden ones here and there", show_hidden, STRANGER_HIDDEN, false},
    {"the last face", paint_all, STRANGER_LAST, false},
    {"the first face", keep_first, STRANGER_FIRST, false},
    {"empty", draw_nothing, STRANGER_EMPTY, true},
    {"dice", throw_dice, STRANGER_WRONG, false},
};

static const struct stranger_reason *
first_of(const struct stranger_verdict *v) {
  return v->n_whole ? &v->whole[0] : v->n_sample ? &v->sample[0] : NULL;
}

static enum hsr_status judge(const struct stage *s, const uint32_t *ids,
                             struct stranger_verdict *v,
                             struct hsr_error *err) {
  const struct hsr_request request = request_of(s);
  const struct stranger_question question = {
      .scene = s->judged, .request = &request, .ids = ids};
  return stranger_judge(&question, v, err);
}

/* The farthest face is also what a near plane leaves, or what is below all
 * decals. And where nothing is closed, nothing is left if fronts are culled. Of
 * the few samples with a hidden face, ties or edges explain most where all faces
 * lie together. */
static bool is_ambiguous(const struct stage *s, int which) {
  if (spoils[which].spoil == number_from_1_and_turn)
    return !strcmp(s->name, "near-plane"); /* one fault by one is found */
  if (spoils[which].kind == STRANGER_EMPTY)
    return !strcmp(s->name, "deep-stack") || !strncmp(s->name, "decals", 6);
  if (spoils[which].kind == STRANGER_HIDDEN)
    return !strcmp(s->name, "coplanar") || !strcmp(s->name, "terrain:12") ||
           !strcmp(s->name, "one-sided") || !strncmp(s->name, "decals", 6);
  return spoils[which].kind == STRANGER_FARTHEST &&
         (!strcmp(s->name, "near-plane") || !strncmp(s->name, "decals", 6));
}

/* A face that is chosen by its number may be one of another kind at all samples
 * that are wrong: the farthest, where the nearest come first. */
static bool fits_another(const struct stranger_verdict *v, int which) {
  const bool by_number = spoils[which].kind == STRANGER_LAST ||
                         spoils[which].kind == STRANGER_FIRST;
  return by_number && (v->n_whole ? !v->left : v->n_sample == 1);
}

/* Spoils a picture in one way. */
static void test_spoil(struct tap *t, struct stage *s, int which,
                       int changed_in[COUNT(spoils)],
                       int named_in[COUNT(spoils)]) {
  static uint32_t ids[ALL];
  struct stranger_verdict v;
  struct hsr_error err = {.text = ""};
  spoils[which].spoil(s, ids);
  uint64_t changed = 0;
  for (int k = 0; k < s->m * s->n; k++)
    changed += ids[k] != s->right[k];
  changed_in[which] += changed > 0;
  enum hsr_status status = judge(s, ids, &v, &err);
  const struct stranger_reason *first = first_of(&v);
  uint64_t sum = 0;
  for (int k = 0; k < v.n_sample; k++)
    sum += v.sample[k].samples;
  bool good = !status && v.compared == (uint64_t)(s->m * s->n) &&
              v.differing == changed && sum == v.left;
  /* Of two ways to round a camera, a few samples in a hundred may tell. */
  if (changed && spoils[which].all)
    good &= first &&
            (v.n_whole ? 25 * v.left <= changed : first->samples == changed);
  const bool named = first && first->kind == spoils[which].kind;
  if (changed && !is_ambiguous(s, which) && !fits_another(&v, which))
    good &= named;
  named_in[which] += named;
  ok(t, good, "%s, %s: %llu wrong, %llu left, %s%s", s->name,
     spoils[which].what, (unsigned long long)changed,
     (unsigned long long)v.left, first ? first->words : "right", err.text);
  for (int k = 0; k < v.n_sample && !good; k++)
    printf("#   %llu %s\n", (unsigned long long)v.sample[k].samples,
           v.sample[k].words);
  stranger_free(&v);
}

static void test_right(struct tap *t, struct stage *s) {
  struct stranger_verdict v;
  struct hsr_error err = {.text = ""};
  ok(t,
     !judge(s, s->right, &v, &err) && !v.differing && !v.n_whole &&
         !v.n_sample && !v.left && v.compared == (uint64_t)(s->m * s->n),
     "%s: the right picture is right%s", s->name, err.text);
  stranger_free(&v);
}

static const char *const scenes[] = {
    "house",      "greenhouse", "coplanar",      "office:1",    "terrain:12",
    "one-sided",  "near-plane", "lattice:120:3", "penetration", "harbor:600",
    "deep-stack", "decals",     NEAR_DECALS};

int main(void) {
  static struct stage s;
  int changed_in[COUNT(spoils)] = {0}, named_in[COUNT(spoils)] = {0};
  struct tap t = plan(COUNT(scenes) * (1 + COUNT(spoils)) + COUNT(spoils));
  for (int k = 0; k < COUNT(scenes); k++) {
    set_up(&s, scenes[k], k ? M : N, N);
    test_right(&t, &s);
    for (int which = 0; which < COUNT(spoils); which++)
      test_spoil(&t, &s, which, changed_in, named_in);
    tear_down(&s);
  }
  for (int k = 0; k < COUNT(spoils); k++)
    ok(&t, named_in[k] > 0,
       "%s: it changes the pictures of %d scenes, and is named first in %d",
       spoils[k].what, changed_in[k], named_in[k]);
  return finish(&t);
}
