/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The services of common/exact/shadow.h: whether a face blocks the light,
 * against products of whole numbers that the test makes itself; and that no
 * face which blocks is left out by hsr_may_shade, or by the boxes of the
 * light's picture. */
#include "common/exact/shadow.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

enum { SCENES = 300, SIDE = 16 };

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_screen screen;
  struct hsr_lighting lighting;
  struct hsr_arena arena;
  struct hsr_tally tally;
};

/* What was found. */
struct found {
  long blocking, not_blocking; /* as whole numbers say */
  long wrong, ties;
  long left_out;    /* blocking faces that hsr_may_shade leaves out */
  long out_of_box;  /* or boxes */
  long boxes_apart; /* pairs that the boxes keep apart */
};

static void add_faces(uint64_t *seed, struct hsr_object *object) {
  for (int n = (int)draw_integer(seed, 4, 12); object->n_faces < (uint32_t)n;) {
    uint32_t vertex[4], k = (uint32_t)draw_integer(seed, 3, 4);
    bool out_of_memory = false;
    for (uint32_t c = 0; c < k; c++)
      hsr_object_vertex(object, (double)draw_integer(seed, -5, 5),
                        (double)draw_integer(seed, -5, 5),
                        (double)draw_integer(seed, -5, 5), &vertex[c]);
    struct hsr_loop loop = {object->xyz, object->xyz + 1, object->xyz + 2,
                            3,           vertex,          k};
    if (hsr_exact_has_normal(loop, &out_of_memory))
      hsr_object_face(object, vertex, k, NULL);
  }
}

/* Squares about the view's axis. One corner is out of the plane of the others by
 * a thousandth of a side or so. */
static void add_bent_faces(uint64_t *seed, struct hsr_object *object) {
  for (int k = 0; k < 3; k++) {
    double tilt[2] = {(double)draw_integer(seed, -5, 5) / 8,
                      (double)draw_integer(seed, -5, 5) / 8};
    double size = (double)draw_integer(seed, 1, 4);
    double middle[2] = {(double)draw_integer(seed, -4, 4),
                        (double)draw_integer(seed, -4, 4)};
    uint32_t vertex[4];
    for (int c = 0; c < 4; c++) {
      double x = c == 1 || c == 2 ? size : -size, y = c >= 2 ? size : -size;
      double bend = c ? 0 : (double)draw_integer(seed, -9, 9) * size / 4096;
      hsr_object_vertex(object, middle[0] + x, middle[1] + y,
                        tilt[0] * x + tilt[1] * y + bend, &vertex[c]);
    }
    hsr_object_face(object, vertex, 4, NULL);
  }
}

/* The camera looks along -z, with R = (1, 0, 0) and U = (0, 1, 0). */
static struct fixture *
set_up(uint64_t *seed, void (*add)(uint64_t *seed, struct hsr_object *object)) {
  struct fixture *x = calloc(1, sizeof *x);
  struct hsr_camera camera = {
      .eye = {0, 0, 9}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 90};
  struct hsr_error err = {.text = "out of memory"};
  x->scene = hsr_scene_new("shadow");
  add(seed, hsr_scene_object(x->scene, "faces"));
  camera.light[3] = (double)draw_integer(seed, 0, 1);
  for (int k = 0; k < 3; k++)
    camera.light[k] = (double)draw_integer(seed, -7, 7);
  if (hsr_scene_view(x->scene, &camera) || hsr_scene_finish(x->scene, &err) ||
      hsr_world_init(&x->world, x->scene, &err) ||
      hsr_view_init(&x->view, &camera, SIDE, SIDE, &err) ||
      hsr_screen_make(&x->screen, &x->world, &x->view, &x->arena, &x->tally) ||
      hsr_lighting_init(&x->lighting, &x->screen, &x->arena, &x->tally))
    bail("%s", err.text);
  return x;
}

static void tear_down(struct fixture *x) {
  hsr_arena_free(&x->arena);
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
  free(x);
}

/* --- By whole numbers ----------------------------------------------------- */

/* All coordinates are small, so products of four of them are exact in 128 bits.
 * A sample lies at whole sixteenths of the screen. */
__extension__ typedef __int128 whole;
struct point {
  whole x[4];
};

static whole det3(const whole a[3], const whole b[3], const whole c[3]) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) -
         a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static void corner(const struct fixture *x, uint32_t f, uint32_t k,
                   whole v[3]) {
  uint32_t n = hsr_face_size(&x->world, f);
  uint32_t c = x->world.mesh.vertex[x->world.mesh.start[f] + k % n];
  v[0] = (whole)x->world.mesh.x[c];
  v[1] = (whole)x->world.mesh.y[c];
  v[2] = (whole)x->world.mesh.z[c];
}

/* N, and N.S, of a face. */
static void plane_of(const struct fixture *x, uint32_t f, whole N[3],
                     whole *offset) {
  whole sum[3] = {0, 0, 0};
  N[0] = N[1] = N[2] = *offset = 0;
  for (uint32_t k = 0; k < hsr_face_size(&x->world, f); k++) {
    whole a[3], b[3];
    corner(x, f, k, a);
    corner(x, f, k + 1, b);
    for (int c = 0; c < 3; c++) {
      N[c] += a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
      sum[c] += a[c];
    }
  }
  for (int c = 0; c < 3; c++)
    *offset += N[c] * sum[c];
}

static whole height(const struct fixture *x, uint32_t g, struct point p) {
  whole N[3], offset, along = 0;
  plane_of(x, g, N, &offset);
  for (int c = 0; c < 3; c++)
    along += N[c] * p.x[c];
  return hsr_face_size(&x->world, g) * along - p.x[3] * offset;
}

/* P of a sample on f: t = c / (k N.D), with D = (2 i + 1 - 16, 15 - 2 j, -16).
 */
static struct point visible_point(const struct fixture *x, uint32_t f, int i,
                                  int j) {
  const whole D[3] = {2 * i + 1 - SIDE, SIDE - 1 - 2 * j, -SIDE};
  const whole E[3] = {0, 0, 9}, k = hsr_face_size(&x->world, f);
  whole n[3], offset, along = 0;
  struct point p;
  plane_of(x, f, n, &offset);
  for (int c = 0; c < 3; c++)
    along += k * n[c] * D[c];
  for (int c = 0; c < 3; c++)
    p.x[c] = along * E[c] + (offset - k * n[2] * 9) * D[c];
  p.x[3] = along;
  for (int c = 0; c < 4 && along < 0; c++)
    p.x[c] = -p.x[c];
  return p;
}

static int sign(whole v) {
  return (v > 0) - (v < 0);
}

/* 1: g blocks; 0: it does not; -1: something is exactly zero. The half plane in
 * which crossings are counted is another than the definition's: along (3, 7,
 * -19). */
static int blocks(const struct fixture *x, struct point P, uint32_t g) {
  static const whole X[3] = {3, 7, -19};
  struct point L;
  whole to_light[3], scale = P.x[3];
  bool odd = false;
  for (int c = 0; c < 4; c++)
    L.x[c] = (whole)x->view.light[c];
  for (int c = 0; c < 3; c++)
    to_light[c] = scale * L.x[c] - L.x[3] * P.x[c];
  int at_L = sign(height(x, g, L)), at_P = sign(height(x, g, P));
  if (!at_P)
    return -1;
  for (uint32_t k = 0; k < hsr_face_size(&x->world, g); k++) {
    whole a[3], b[3];
    corner(x, g, k, a);
    corner(x, g, k + 1, b);
    for (int c = 0; c < 3; c++) {
      a[c] = scale * a[c] - P.x[c];
      b[c] = scale * b[c] - P.x[c];
    }
    int row_a = sign(det3(to_light, X, a)), row_b = sign(det3(to_light, X, b));
    int edge = sign(det3(to_light, a, b));
    if (!row_a || !row_b || !edge)
      return -1;
    odd ^= row_a != row_b && edge == -row_a;
  }
  return odd && at_L == -at_P;
}

/* --- Comparing ------------------------------------------------------------ */

static bool overlap(const struct hsr_light_box *a,
                    const struct hsr_light_box *b) {
  return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] &&
         a->low[1] <= b->high[1] && b->low[1] <= a->high[1];
}

/* Whether the boxes allow g to block the light from the point. */
static bool boxes_meet(const struct fixture *x,
                       const struct hsr_lit_point *point, uint32_t g) {
  struct hsr_light_box image, box, receiver;
  double reach = hsr_off_hull(&x->lighting, point->face);
  int side = hsr_light_image(&x->lighting, point, &image);
  bool meets = false;
  for (int s = 0; s < hsr_light_sides(&x->lighting); s++)
    meets |= hsr_light_sees(&x->lighting, g, s, 0, &box) &&
             hsr_light_sees(&x->lighting, point->face, s, reach, &receiver) &&
             overlap(&box, &receiver);
  return meets &&
         (side < 0 || (hsr_light_sees(&x->lighting, g, side, 0, &box) &&
                       overlap(&image, &box)));
}

static void ask(struct fixture *x, const struct hsr_lit_point *point,
                struct point P, uint32_t g, struct found *found) {
  bool got = hsr_blocks(&x->lighting, point, g, &x->tally);
  bool meets = boxes_meet(x, point, g);
  int wanted = blocks(x, P, g);
  found->ties += wanted < 0;
  found->blocking += wanted == 1;
  found->not_blocking += wanted == 0;
  found->wrong += wanted >= 0 && got != wanted;
  found->left_out +=
      got && !hsr_may_shade(&x->lighting, g, point->face, &x->tally);
  found->out_of_box += got && !meets;
  found->boxes_apart += !meets;
}

/* The nearest face at a sample. */
static uint32_t visible(struct fixture *x, int i, int j) {
  uint32_t nearest = HSR_BACKGROUND;
  for (uint32_t r = 0; r < x->screen.n_relevant; r++) {
    uint32_t f = x->screen.relevant[r];
    if (hsr_covers(&x->screen, f, i, j, &x->tally) &&
        (nearest == HSR_BACKGROUND ||
         hsr_nearer(&x->screen, f, nearest, i, j, &x->tally)))
      nearest = f;
  }
  return nearest;
}

static void check_scene(uint64_t *seed, struct found *found) {
  struct fixture *x = set_up(seed, add_faces);
  for (int j = 0; j < SIDE; j++)
    for (int i = 0; i < SIDE; i++) {
      uint32_t f = visible(x, i, j);
      struct hsr_lit_point point;
      if (f == HSR_BACKGROUND || !hsr_faces_light(&x->lighting, f, &x->tally))
        continue;
      hsr_lit_point_find(&x->lighting, f, i, j, &point);
      for (uint32_t g = 0; g < x->world.n_faces; g++)
        if (hsr_may_block(&x->lighting, g))
          ask(x, &point, visible_point(x, f, i, j), g, found);
    }
  tear_down(x);
}

/* --- Bent faces ----------------------------------------------------------- */

/* Points of bent faces, by where their images are. */
struct bent {
  long n, outside; /* of the face's box */
  long beside;     /* outside of that of its vertices */
};

static bool is_in_box(const struct fixture *x,
                      const struct hsr_lit_point *point, double reach) {
  struct hsr_light_box image, box;
  int side = hsr_light_image(&x->lighting, point, &image);
  return side < 0 ||
         (hsr_light_sees(&x->lighting, point->face, side, reach, &box) &&
          overlap(&image, &box));
}

static void check_bent(uint64_t *seed, struct bent *bent) {
  struct fixture *x = set_up(seed, add_bent_faces);
  for (int j = 0; j < SIDE; j++)
    for (int i = 0; i < SIDE; i++) {
      uint32_t f = visible(x, i, j);
      struct hsr_lit_point point;
      if (f == HSR_BACKGROUND || x->world.mesh.deviation[f] == 0)
        continue;
      hsr_lit_point_find(&x->lighting, f, i, j, &point);
      double reach = hsr_off_hull(&x->lighting, f);
      bent->n += isfinite(reach);
      bent->outside += !is_in_box(x, &point, reach);
      bent->beside += !is_in_box(x, &point, 0);
    }
  tear_down(x);
}

int main(void) {
  struct tap tap = plan(5);
  struct found found = {0};
  uint64_t seed = 1;
  for (int k = 0; k < SCENES; k++)
    check_scene(&seed, &found);
  ok(&tap, !found.wrong && found.blocking > 1000 && found.not_blocking > 1000,
     "hsr_blocks: %ld wrong; %ld block, %ld do not, %ld ties are left out",
     found.wrong, found.blocking, found.not_blocking, found.ties);
  ok(&tap, found.ties > 1000, "there are ties, which take the exact path");
  ok(&tap, !found.left_out, "hsr_may_shade: %ld are left out wrongly",
     found.left_out);
  ok(&tap, !found.out_of_box && found.boxes_apart > 1000,
     "boxes: %ld are apart wrongly, %ld rightly", found.out_of_box,
     found.boxes_apart);
  struct bent bent = {0};
  for (int k = 0; k < 20 * SCENES; k++)
    check_bent(&seed, &bent);
  ok(&tap, !bent.outside && bent.n > 1000 && bent.beside > 0,
     "of %ld points of bent faces, %ld are outside of the boxes; %ld would be "
     "without a reach",
     bent.n, bent.outside, bent.beside);
  return finish(&tap);
}
