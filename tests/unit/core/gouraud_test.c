/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gouraud shading: linear on a triangle, the same on both sides of a smooth
 * edge, and flat where edges are sharp. */
#include "bench/modules/modules.h"
#include "common/view/gouraud.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 120, N = 90 };

struct stage {
  struct both_worlds worlds;
  struct hsr_view view;
  uint32_t ids[M * N];
  float smooth[3 * M * N], flat[3 * M * N];
};

static void finish_picture(struct stage *s, const struct hsr_world *world,
                           enum hsr_shading shading, float *rgb) {
  if (!hsr_picture_finish(world, &s->view, s->ids, shading, NULL, rgb, NULL))
    return;
  bail("no picture");
}

/* A scene, all of whose faces have the colours of their objects. */
static void open_stage(struct stage *s, const char *name, int view) {
  open_worlds(&s->worlds, name);
  for (uint32_t o = 0; o < s->worlds.scene->n_objects; o++)
    s->worlds.scene->objects[o].rgb = NULL;
  must_view(&s->view, &s->worlds.scene->views[view], M, N);
  draw_plain("zbuffer-fast", &s->worlds.world, &s->view, s->ids);
  finish_picture(s, &s->worlds.world, HSR_SHADE_GOURAUD, s->smooth);
  finish_picture(s, &s->worlds.world, HSR_SHADE_LAMBERT, s->flat);
}

static double brightness(const float *rgb, int i, int j) {
  const float *c = rgb + 3 * (j * M + i);
  return (double)c[0] + (double)c[1] + (double)c[2];
}

/* The mean step between neighbours that are two faces, or, `inside`, the
 * greatest of those that are one. */
static double step(const struct stage *s, const float *rgb, bool inside) {
  double sum = 0, most = 0;
  int n = 0;
  for (int j = 0; j < N; j++)
    for (int i = 0; i + 1 < M; i++) {
      uint32_t f = s->ids[j * M + i], g = s->ids[j * M + i + 1];
      if (f == HSR_BACKGROUND || g == HSR_BACKGROUND)
        continue;
      double size = fabs(brightness(rgb, i, j) - brightness(rgb, i + 1, j));
      most = f == g ? fmax(most, size) : most;
      sum += f == g ? 0 : size;
      n += f != g;
    }
  return inside ? most : sum / n;
}

static double greatest_difference(const struct stage *s) {
  double most = 0;
  for (int k = 0; k < 3 * M * N; k++)
    most = fmax(most, fabs((double)(s->smooth[k] - s->flat[k])));
  return most;
}

/* A ball: what is smooth looks smooth, and is nearer to the true light of a
 * ball than flat faces are. */
static void check_ball(struct tap *tap, struct stage *s) {
  open_stage(s, "sphere:600", 0);
  double flat = step(s, s->flat, false), smooth = step(s, s->smooth, false);
  ok(tap, smooth < flat / 2, "a ball has no edges: steps of %.3f, not %.3f",
     smooth, flat);
  double wrong[2] = {0, 0};
  for (int k = 0; k < M * N; k++) {
    if (s->ids[k] == HSR_BACKGROUND)
      continue;
    const struct hsr_mesh *mesh = &s->worlds.world.mesh;
    double point[3],
        n[3] = {mesh->nx[s->ids[k]], mesh->ny[s->ids[k]], mesh->nz[s->ids[k]]},
        p[3] = {mesh->px[s->ids[k]], mesh->py[s->ids[k]], mesh->pz[s->ids[k]]};
    double height = 0, slope = 0;
    double sx = hsr_sample_x(&s->view, k % M),
           sy = hsr_sample_y(&s->view, k / M);
    for (int c = 0; c < 3; c++) {
      point[c] =
          s->view.ray[0][c] + sx * s->view.ray[1][c] + sy * s->view.ray[2][c];
      height += n[c] * (p[c] - s->view.E[c]);
      slope += n[c] * point[c];
    }
    for (int c = 0; c < 3; c++) /* the ball is about the origin */
      point[c] = s->view.E[c] + height / slope * point[c];
    double light = (double)hsr_picture_light_of(&s->view, point, false);
    float rgb[3];
    hsr_picture_colour(&s->worlds.world, &s->view, s->ids[k], HSR_SHADE_FLAT,
                       rgb);
    wrong[0] += fabs((double)s->flat[3 * k] - light * (double)rgb[0]);
    wrong[1] += fabs((double)s->smooth[3 * k] - light * (double)rgb[0]);
  }
  ok(tap, wrong[1] < wrong[0] / 2,
     "and it has the light of a ball: %.1f wrong in all, not %.1f", wrong[1],
     wrong[0]);
  memcpy(s->flat, s->smooth, sizeof s->flat);
  finish_picture(s, &s->worlds.roster, HSR_SHADE_GOURAUD, s->smooth);
  ok(tap, !memcmp(s->flat, s->smooth, sizeof s->flat),
     "by instances it is the same picture");
  close_worlds(&s->worlds);
}

/* Cubes turn by 90 degrees at their edges. */
static void check_cubes(struct tap *tap, struct stage *s) {
  open_stage(s, "color-cube:3", 0);
  ok(tap, greatest_difference(s) < 1e-6, "sharp edges stay sharp (%.1g)",
     greatest_difference(s));
  ok(tap, step(s, s->smooth, true) < 1e-6, "and a side has one colour");
  close_worlds(&s->worlds);
}

/* Two triangles that meet at 40 degrees: at corners 0 and 1 each has the mean
 * normal, at the others its own. */
static void check_edge(struct tap *tap, struct stage *s) {
  static const double p[4][3] = {{0, -1, 0},
                                 {0, 1, 0},
                                 {-1, 0, -0.3639702342662024},
                                 {1, 0, -0.3639702342662024}};
  struct hsr_scene *scene = hsr_scene_new("roof");
  struct hsr_object *roof = hsr_scene_object(scene, "roof");
  struct hsr_camera camera = {
      .eye = {0.3, 0.2, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 22};
  const uint32_t west[3] = {0, 1, 2}, east[3] = {1, 0, 3};
  for (int k = 0; k < 4; k++)
    hsr_object_vertex(roof, p[k][0], p[k][1], p[k][2], NULL);
  hsr_object_face(roof, west, 3, NULL);
  hsr_object_face(roof, east, 3, NULL);
  if (hsr_scene_view(scene, &camera))
    exit(99);
  must_finish(scene);
  must_world(&s->worlds.world, scene);
  must_view(&s->view, &camera, M, N);
  draw_plain("zbuffer-fast", &s->worlds.world, &s->view, s->ids);
  finish_picture(s, &s->worlds.world, HSR_SHADE_GOURAUD, s->smooth);
  finish_picture(s, &s->worlds.world, HSR_SHADE_LAMBERT, s->flat);
  double flat = 0, smooth = 0;
  int edges = 0;
  for (int j = 0; j < N; j++)
    for (int i = 0; i + 1 < M; i++) {
      uint32_t f = s->ids[j * M + i], g = s->ids[j * M + i + 1];
      if (f == g || f == HSR_BACKGROUND || g == HSR_BACKGROUND)
        continue;
      edges++;
      flat += fabs(brightness(s->flat, i, j) - brightness(s->flat, i + 1, j));
      smooth +=
          fabs(brightness(s->smooth, i, j) - brightness(s->smooth, i + 1, j));
    }
  ok(tap, edges > 40 && smooth < flat / 10,
     "a smooth edge is not seen: steps of %.4f, not %.4f", smooth / edges,
     flat / edges);
  /* Linear in space: at the middle of the eastern triangle, the mean of its
   * corners. */
  double mean[3] = {0, 0, 1}, own[3] = {0.3639702342662024, 0, 1}, image[3],
         middle[3] = {1. / 3, 0, p[3][2] / 3};
  hsr_view_project(&s->view, middle, image);
  int i = (int)floor(image[0] / image[2]), j = (int)floor(image[1] / image[2]);
  double light = (2 * (double)hsr_picture_light_of(&s->view, mean, false) +
                  (double)hsr_picture_light_of(&s->view, own, false)) /
                 3;
  double got = (double)s->smooth[3 * (j * M + i)] / 0.6;
  ok(tap, s->ids[j * M + i] == 1 && fabs(got - light) < 0.004,
     "a triangle's middle has the mean of its corners' light: %.4f, %.4f", got,
     light);
  hsr_world_free(&s->worlds.world);
  hsr_scene_delete(scene);
}

int main(void) {
  static struct stage stage;
  struct tap tap = plan(7);
  check_ball(&tap, &stage);
  check_cubes(&tap, &stage);
  check_edge(&tap, &stage);
  return finish(&tap);
}
