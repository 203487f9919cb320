/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A failure case of outlines: rings that pass a vertex twice, or an edge in both
 * directions. So faces have holes. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

enum { PLATE = 12, RING = 16 };

/* A plate with two holes. Its corners are 0 to 3, those of the holes 4 to 7 and
 * 8 to 11, seen from above counter-clockwise and clockwise. */
static const double plate[PLATE][2] = {{0, 0}, {12, 0}, {12, 8}, {0, 8},
                                       {2, 2}, {2, 6},  {5, 6},  {5, 2},
                                       {7, 2}, {7, 6},  {10, 6}, {10, 2}};

/* One bridge runs from corner 0 to the first hole, and one from there to the
 * second, in line with sides of both. */
static const uint32_t ring[RING] = {0, 1, 2, 3,  0,  4, 5, 6,
                                    7, 8, 9, 10, 11, 8, 7, 4};

/* The walls of n corners that follow `first`, from the floor to the top. */
static void walls(struct hsr_pen *pen, uint32_t floor, uint32_t top,
                  uint32_t first, uint32_t n) {
  for (uint32_t k = 0; k < n; k++) {
    uint32_t a = first + k, b = first + (k + 1) % n;
    hsr_pen_palette(pen, 2 + a);
    hsr_pen_face(pen, 4,
                 (const uint32_t[]){floor + a, floor + b, top + b, top + a});
  }
}

static void solid(struct hsr_pen *pen) {
  uint32_t floor = 0, top = 0, upwards[RING], downwards[RING];
  hsr_pen_object(pen, "plate", true);
  for (uint32_t k = 0; k < 2 * PLATE; k++) {
    const double *at = plate[k % PLATE];
    uint32_t v = hsr_pen_vertex(pen, at[0], at[1], k < PLATE ? 0 : 1.5);
    floor = k ? floor : v;
  }
  top = floor + PLATE;
  for (uint32_t k = 0; k < RING; k++) {
    upwards[k] = top + ring[k];
    downwards[RING - 1 - k] = floor + ring[k];
  }
  hsr_pen_palette(pen, 0);
  hsr_pen_face(pen, RING, upwards);
  hsr_pen_palette(pen, 1);
  hsr_pen_face(pen, RING, downwards);
  walls(pen, floor, top, 0, 4);
  walls(pen, floor, top, 4, 4);
  walls(pen, floor, top, 8, 4);
  hsr_pen_place(pen, NULL);
}

/* A face through n points of a plane z, by a ring of numbers of them. */
static void flat(struct hsr_pen *pen, const double (*xy)[2], uint32_t n,
                 double z, const uint32_t *numbers, uint32_t n_ring) {
  uint32_t first = 0, corner[RING];
  for (uint32_t k = 0; k < n; k++) {
    uint32_t v = hsr_pen_vertex(pen, xy[k][0], xy[k][1], z);
    first = k ? first : v;
  }
  for (uint32_t k = 0; k < n_ring; k++)
    corner[k] = first + numbers[k];
  hsr_pen_face(pen, n_ring, corner);
}

/* A hole that touches a corner, two triangles that meet in one, and a side that
 * goes out and comes back. */
static void sheets(struct hsr_pen *pen) {
  static const double square[6][2] = {{14, 0}, {22, 0}, {22, 8},
                                      {14, 8}, {16, 6}, {19, 3}};
  static const double eight[5][2] = {
      {3, 10}, {9, 11}, {9, 16}, {0, 8}, {-2, 15}};
  static const double spike[5][2] = {
      {24, 0}, {30, 0}, {30, 8}, {34, 11}, {24, 8}};
  hsr_pen_object(pen, "sheets", false);
  hsr_pen_palette(pen, 9);
  flat(pen, square, 6, 2, (const uint32_t[]){0, 1, 2, 3, 0, 4, 5}, 7);
  hsr_pen_palette(pen, 10);
  flat(pen, eight, 5, -1, (const uint32_t[]){0, 1, 2, 0, 4, 3}, 6);
  hsr_pen_palette(pen, 11);
  flat(pen, spike, 5, 0, (const uint32_t[]){0, 1, 2, 3, 2, 4}, 6);
  hsr_pen_palette(pen, 5);
  hsr_pen_frame(pen, 0, 0, -3, 0);
  const double below[4][3] = {
      {-4, -2, 0}, {36, -2, 0}, {36, 18, 0}, {-4, 18, 0}};
  hsr_pen_polygon(pen, 4, below);
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_keyholes(struct hsr_scene *scene,
                                   const long long *parameter) {
  static const double view[][8] = {
      {16, -22, 28, 15, 6, 0, 55}, {6, 4, 9.5, 6, 4, 0, 90},
      {6, 4, -8, 6, 4, 0, 90},     {3.5, 4, 0.5, 9, 4, 1, 80},
      {18, 4, 10, 18, 4, 2, 60},   {3, 12, 7, 3, 12, -1, 90},
      {40, 20, 9, 28, 4, 0, 50},   {-12, -9, 7, 8, 5, 0, 60}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  solid(&pen);
  sheets(&pen);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}
