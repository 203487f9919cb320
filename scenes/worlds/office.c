/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Modules of offices side by side and on top of each other, and a walk in one.
 *
 * Source      Greene, Kass and Miller, SIGGRAPH 1993: modules replicated
 *             33 x 33 x 33 times; 538,192,512 triangles in office:33. See
 *             module.h.
 * Exact       modules are moved by multiples of 16 m. */
#include "scenes/builders.h"
#include "scenes/parts/module.h"

/* A stretch ends with the feet at (x, z), y above the lowest floor, in 64ths,
 * and the eye turned to `heading` degrees from +x to +z, looking down (up, if
 * negative) by 64ths in a metre. */
struct stretch {
  int x, y, z, heading, down, n_views;
};

/* From the second storey to the third: to the foot of the stairs, up, and round
 * the stairwell to above the start. A view is 0.25 m from the one before, or
 * turned by 4 degrees. */
static const struct stretch walk[] = {
    {112, 256, 230, 395, 5, 1},   {150, 256, 342, 422, 5, 7},
    {208, 256, 512, 390, 2, 12},  {208, 256, 512, 360, 0, 8},
    {332, 256, 512, 360, -12, 8}, {692, 512, 512, 360, 4, 28},
    {752, 512, 512, 345, 4, 4},   {752, 512, 512, 300, 4, 12},
    {760, 512, 230, 240, 6, 18},  {260, 512, 226, 150, 6, 31},
    {260, 512, 226, 60, 4, 24}};

static double between(int a, int b, int k, int n) {
  return a + (double)(b - a) * k / n;
}

/* In the module nearest to the middle, which begins at `origin`. */
static void walk_through(struct hsr_pen *pen, const double origin[3]) {
  const struct stretch *from = walk;
  for (size_t s = 0; s < sizeof walk / sizeof *walk; s++) {
    const struct stretch *to = &walk[s];
    for (int k = 1; k <= to->n_views; k++) {
      double c, z, eye[3], at[3];
      int n = to->n_views;
      hsr_unit((uint32_t)between(4 * from->heading, 4 * to->heading, k, n),
               1440, &c, &z);
      eye[0] = origin[0] + between(from->x, to->x, k, n) / 64;
      eye[1] =
          origin[1] + (HSR_SLAB + HSR_EYE + between(from->y, to->y, k, n)) / 64;
      eye[2] = origin[2] + between(from->z, to->z, k, n) / 64;
      at[0] = eye[0] + c;
      at[1] = eye[1] - between(from->down, to->down, k, n) / 64;
      at[2] = eye[2] + z;
      hsr_pen_view(pen, eye, at, 70, 0.0625);
    }
    from = to;
  }
}

enum hsr_status hsr_build_office(struct hsr_scene *scene,
                                 const long long *parameter) {
  int n[3];
  double middle[3];
  for (int k = 0; k < 3; k++) {
    n[k] = (int)(parameter[k] ? parameter[k] : parameter[0]);
    middle[k] = (n[k] - 1) / 2 * 16.0;
  }
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "module", true);
  pen.triangles = true;
  hsr_draw_module(&pen);
  for (int y = 0; y < n[1]; y++)
    for (int z = 0; z < n[2]; z++)
      for (int x = 0; x < n[0] && !pen.status; x++) {
        double m[12];
        hsr_pen_matrix(m, 16 * x, 16 * y, 16 * z, 0);
        hsr_pen_place(&pen, m);
      }
  walk_through(&pen, middle);
  return pen.status;
}
