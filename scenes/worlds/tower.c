/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The office building of 408 storeys in the style of the Empire State Building.
 *
 * Source      N. Greene, Hierarchical Polygon Tiling with Coverage Masks,
 *             SIGGRAPH 1996, section 9: modules replicated within the shell of
 *             a building of 408 storeys, about 167 million quadrilaterals;
 *             figures 4 and 6 from within and without, figure 7 without the
 *             shell.
 * Modules     of four storeys and 7,488 quadrilaterals (module.h; Greene's have
 *             about 16,000): 102 layers of them, as many as the Empire State
 *             Building has storeys, with its setbacks.
 * Shell       panels of 16 m x 16 m before the outer modules, posts at the
 *             corners, roofs on the setbacks, a crown; the windows are holes.
 * Smaller     towers have the same proportions: N layers are N / 102 as wide.
 * Exact       all coordinates are multiples of 1/64 m. Instances are moved and
 *             not turned, and the boxes about any two touch at most: whatever
 *             belongs to the shell lies outside the modules' boxes.
 */
#include "scenes/builders.h"
#include "scenes/parts/module.h"

#include <math.h>

/* In metres: a module's side, the shell's and the roofs' thickness, the width
 * and the height of the pavement. */
static const double SIDE = HSR_MODULE / 64.0, SHELL = 0.5, ROOF = 0.5,
                    PAVED = 24, KERB = 0.25;

static const unsigned LIMESTONE = 0xd9cfba, STEEL = 0xaab2b8,
                      SPANDREL = 0x59605f, GRAVEL = 0x9a958b,
                      PAVEMENT = 0xb7b1a5, ASPHALT = 0x5d6063, VENT = 0x8b9499;

/* --- The plan ------------------------------------------------------------- */

enum { LAYERS = 102 };

/* Layers below number `top` have so many modules along x and z. */
static const struct tier {
  int top, wide, deep;
} tiers[] = {{5, 30, 18},  {20, 24, 15}, {24, 22, 14},
             {29, 20, 13}, {71, 18, 12}, {80, 16, 10},
             {85, 12, 8},  {97, 4, 4},   {LAYERS, 2, 2}};

struct tower {
  struct hsr_pen pen;
  int n_layers;
};

/* A rectangle about the y axis: |x| <= x, |z| <= z, in metres. */
struct plan {
  double x, z;
};

static int scaled(const struct tower *tower, int modules) {
  int n = (modules * tower->n_layers + LAYERS / 2) / LAYERS;
  return n ? n : 1;
}

/* Of the modules of a layer; above the last, of the crown. */
static struct plan plan_of(const struct tower *tower, int layer) {
  const struct tier *tier = tiers;
  if (layer == tower->n_layers) {
    struct plan top = plan_of(tower, layer - 1);
    return (struct plan){top.x / 2, top.z / 2};
  }
  while (layer * LAYERS / tower->n_layers >= tier->top)
    tier++;
  return (struct plan){SIDE / 2 * scaled(tower, tier->wide),
                       SIDE / 2 * scaled(tower, tier->deep)};
}

static void place(struct tower *tower, double x, double y, double z) {
  double m[12];
  hsr_pen_matrix(m, x, y, z, 0);
  hsr_pen_place(&tower->pen, m);
}

static void modules(struct tower *tower) {
  hsr_pen_object(&tower->pen, "module", true);
  hsr_draw_module(&tower->pen);
  for (int layer = 0; layer < tower->n_layers; layer++) {
    struct plan plan = plan_of(tower, layer);
    for (double z = -plan.z; z < plan.z; z += SIDE)
      for (double x = -plan.x; x < plan.x && !tower->pen.status; x += SIDE)
        place(tower, x, SIDE * layer, z);
  }
}

/* --- The walls: four kinds of panels, and posts -----------------------------
 *
 * A panel's own frame: x along the wall, the wall from z = 0 outwards. Lengths
 * are in 64ths of a metre. */

enum { BAY = 256, PIER = 32, WINDOW = 90, MULLION = 12, SILL = 80 };

/* One storey between two piers or a pier and a mullion; x and y are its lower
 * left corner. */
static void window(struct hsr_pen *pen, int x, int y) {
  hsr_pen_paint(pen, SPANDREL);
  hsr_pen_block(pen, x, y, 0, x + WINDOW, y + SILL - 4, 16);
  hsr_pen_paint(pen, LIMESTONE);
  hsr_pen_block(pen, x, y + SILL - 4, 0, x + WINDOW, y + SILL, 22);
  hsr_pen_paint(pen, STEEL);
  hsr_pen_block(pen, x, y + 166, 8, x + WINDOW, y + 170, 12);
}

static void bay(struct hsr_pen *pen, int x) {
  hsr_pen_paint(pen, LIMESTONE);
  hsr_pen_block(pen, x, 0, 0, x + PIER, HSR_MODULE, 32);
  hsr_pen_block(pen, x + BAY - PIER, 0, 0, x + BAY, HSR_MODULE, 32);
  hsr_pen_paint(pen, STEEL);
  hsr_pen_block(pen, x + PIER + WINDOW, 0, 0, x + BAY - PIER - WINDOW,
                HSR_MODULE, 26);
  for (int y = 0; y < HSR_MODULE; y += HSR_STOREY) {
    window(pen, x + PIER, y);
    window(pen, x + PIER + WINDOW + MULLION, y);
  }
}

/* A panel before the south, east, north or west side of a module from (0, 0, 0)
 * to (16, 16, 16). */
static void panel(struct hsr_pen *pen, int side) {
  static const char *const name[4] = {"south wall", "east wall", "north wall",
                                      "west wall"};
  hsr_pen_object(pen, name[side], true);
  hsr_pen_frame(pen, side == 1 || side == 2 ? SIDE : 0, 0, side < 2 ? SIDE : 0,
                side);
  for (int x = 0; x < HSR_MODULE; x += BAY)
    bay(pen, x);
}

static void panels(struct tower *tower, int side) {
  panel(&tower->pen, side);
  for (int layer = 0; layer < tower->n_layers; layer++) {
    struct plan plan = plan_of(tower, layer);
    double y = SIDE * layer;
    if (side % 2)
      for (double z = -plan.z; z < plan.z; z += SIDE)
        place(tower, side == 1 ? plan.x - SIDE : -plan.x, y, z);
    else
      for (double x = -plan.x; x < plan.x; x += SIDE)
        place(tower, x, y, side ? -plan.z : plan.z - SIDE);
  }
}

static void posts(struct tower *tower) {
  hsr_pen_object(&tower->pen, "post", true);
  hsr_pen_paint(&tower->pen, LIMESTONE);
  hsr_pen_box(&tower->pen, 0, 0, 0, SHELL, SIDE, SHELL);
  for (int layer = 0; layer < tower->n_layers; layer++) {
    struct plan plan = plan_of(tower, layer);
    for (int k = 0; k < 4; k++)
      place(tower, k & 1 ? plan.x : -plan.x - SHELL, SIDE * layer,
            k & 2 ? plan.z : -plan.z - SHELL);
  }
}

/* --- Roofs, crown and ground ---------------------------------------------- */

/* A strip of a roof in its own frame: before what rises from it, with a parapet
 * along its outer edge, and at its ends, if so wanted; rows of vents on the
 * wide. */
static void strip(struct hsr_pen *pen, double half, double inner, double outer,
                  bool ends) {
  double top = ROOF + 1, middle = (inner + outer) / 2;
  hsr_pen_paint(pen, GRAVEL);
  hsr_pen_box(pen, -half, 0, inner, half, ROOF, outer);
  hsr_pen_paint(pen, LIMESTONE);
  hsr_pen_box(pen, -half, ROOF, outer - SHELL, half, top, outer);
  for (int k = -1; ends && k <= 1; k += 2)
    hsr_pen_box(pen, k < 0 ? -half : half - SHELL, ROOF, inner,
                k < 0 ? SHELL - half : half, top, outer - SHELL);
  hsr_pen_paint(pen, VENT);
  if (outer - inner > 12)
    for (double x = 8 - half; x < half - 12; x += 24)
      hsr_pen_box(pen, x, ROOF, middle - 2, x + 6, ROOF + 3, middle + 2);
}

/* The roof of the layer below, around the layer above: strips along two sides
 * from corner to corner, and along the others between these, where they have
 * any width. So planes separate them. */
static void roof(struct tower *tower, int layer) {
  struct plan below = plan_of(tower, layer - 1), above = plan_of(tower, layer);
  struct hsr_pen *pen = &tower->pen;
  for (int side = 0; side < 4; side++) {
    bool between = side % 2;
    double half = between ? above.z : below.x;
    double inner = between ? above.x : above.z;
    double outer = between ? below.x : below.z;
    if (inner == outer)
      continue;
    hsr_pen_object(pen, "roof", true);
    hsr_pen_frame(pen, 0, 0, 0, side);
    strip(pen, half + SHELL, inner + SHELL, outer + SHELL,
          !between || above.z == below.z);
    place(tower, 0, SIDE * layer, 0);
  }
}

static void crown(struct tower *tower) {
  /* Pieces: the part of the crown's width at the foot and at the top, and the
   * heights of these in metres a layer. */
  static const double piece[][4] = {{1, 1, 0, 0.25},
                                    {0.75, 0.75, 0.25, 0.5},
                                    {0.75, 0.5, 0.5, 0.75},
                                    {0.125, 0.125, 0.75, 1.5},
                                    {0.0625, 0.0625, 1.5, 2.5}};
  struct plan plan = plan_of(tower, tower->n_layers);
  hsr_pen_object(&tower->pen, "crown", true);
  hsr_pen_paint(&tower->pen, STEEL);
  for (size_t k = 0; k < sizeof piece / sizeof *piece; k++) {
    double p[8][3];
    for (int i = 0; i < 8; i++) {
      double part = piece[k][i / 4];
      p[i][0] = part * (plan.x + SHELL) * (i % 4 % 3 ? 1 : -1);
      p[i][1] = piece[k][2 + i / 4] * tower->n_layers;
      p[i][2] = part * (plan.z + SHELL) * (i % 4 < 2 ? 1 : -1);
    }
    hsr_pen_loft(&tower->pen, 4, 2, (const double(*)[3])p, false);
  }
  place(tower, 0, SIDE * tower->n_layers, 0);
}

/* The pavement about the tower and below it, on the asphalt. */
static void ground(struct tower *tower) {
  struct plan plan = plan_of(tower, 0);
  double x = plan.x + PAVED, z = plan.z + PAVED, reach = SIDE * tower->n_layers;
  hsr_pen_object(&tower->pen, "pavement", true);
  hsr_pen_paint(&tower->pen, PAVEMENT);
  hsr_pen_box(&tower->pen, -x, -KERB, -z, x, 0, z);
  hsr_pen_place(&tower->pen, NULL);
  hsr_pen_object(&tower->pen, "street", true);
  hsr_pen_paint(&tower->pen, ASPHALT);
  hsr_pen_box(&tower->pen, -x - reach, -1, -z - reach, x + reach, -KERB,
              z + reach);
  hsr_pen_place(&tower->pen, NULL);
}

/* The kinds of blocks about the tower, a block's width and that of a street. */
enum { KINDS = 3, BLOCK = 128, STREET = 32 };

/* A block of twelve houses. */
static void block(struct hsr_pen *pen, int kind) {
  static const unsigned colour[4] = {0x9c8676, 0xa79f92, 0x8c7468, 0xb5aa98};
  struct hsr_random random = {(uint64_t)kind};
  hsr_pen_object(pen, "block", true);
  for (int k = 0; k < 12; k++) {
    int x = k % 3 * 42, z = k / 3 * 32;
    int height = hsr_random_int(&random, 10, 60);
    int deep = hsr_random_int(&random, 24, 32);
    hsr_pen_paint(pen, colour[hsr_random_int(&random, 0, 3)]);
    hsr_pen_box(pen, x, 0, z, x + 42, height, z + deep);
    hsr_pen_paint(pen, GRAVEL);
    hsr_pen_box(pen, x + 4, height, z + 4, x + 16, height + 4, z + 12);
  }
}

/* Places the blocks of one kind at random, between the pavement and the end of
 * the ground. */
static void blocks(struct tower *tower, int kind) {
  struct plan plan = plan_of(tower, 0);
  double pitch = BLOCK + STREET, reach = SIDE * tower->n_layers;
  double x = floor((plan.x + reach) / pitch) * pitch + STREET / 2;
  double z = floor((plan.z + reach) / pitch) * pitch + STREET / 2;
  struct hsr_random random = {1931};
  bool drawn = false;
  for (double v = -z + STREET; v < z; v += pitch)
    for (double u = -x + STREET; u < x && !tower->pen.status; u += pitch) {
      bool clear = fabs(u + BLOCK / 2) >= plan.x + PAVED + BLOCK / 2 ||
                   fabs(v + BLOCK / 2) >= plan.z + PAVED + BLOCK / 2;
      if (hsr_random_int(&random, 0, KINDS - 1) != kind || !clear)
        continue;
      if (!drawn)
        block(&tower->pen, kind);
      drawn = true;
      place(tower, u, -KERB, v);
    }
}

static void shell(struct tower *tower) {
  for (int side = 0; side < 4; side++)
    panels(tower, side);
  posts(tower);
  for (int layer = 1; layer <= tower->n_layers; layer++)
    roof(tower, layer);
  crown(tower);
}

/* --- The views ------------------------------------------------------------ */

/* From `eye` towards `heading` degrees, from +x to +z, and up or down by so
 * many metres in one. */
static void look(struct tower *tower, const double eye[3], uint32_t heading,
                 double rise, double fov) {
  double at[3];
  hsr_unit(heading, 360, &at[0], &at[2]);
  at[0] += eye[0];
  at[1] = eye[1] + rise;
  at[2] += eye[2];
  hsr_pen_view(&tower->pen, eye, at, fov, 0.0625);
}

/* Round the tower by three quarters of a turn, rising and coming nearer, to
 * `end` before a window. */
static void approach(struct tower *tower, const double end[3], uint32_t n) {
  double height = SIDE * tower->n_layers;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t heading = 270 * k / n;
    double left = (double)(n - k) / n, c, s;
    hsr_unit(heading, 360, &c, &s);
    double far = end[2] + left * height;
    const double eye[3] = {end[0] - far * c, end[1] * (1 - 0.9 * left),
                           -far * s};
    look(tower, eye, heading, 0.45 * left, 60);
  }
}

/* In at the window, and on between the cubicles. */
static void enter(struct tower *tower, const double start[3], double way,
                  int n) {
  for (int k = 0; k < n; k++) {
    const double eye[3] = {start[0], start[1], start[2] - way * k / (n - 1)};
    look(tower, eye, 270, -0.03125, 70);
  }
}

/* All of it, windows of the middle storeys on two sides, along a corridor and
 * across cubicles behind these, and a flight of 24 views from without to
 * within. */
static void views(struct tower *tower) {
  static const double whole[][8] = {{0.68, 0.3, 1.12, 0, 0.53, 0, 52, 0}};
  hsr_pen_views(&tower->pen, whole, 1, SIDE * tower->n_layers);
  int layer = tower->n_layers / 2;
  struct plan plan = plan_of(tower, layer);
  double y = SIDE * layer + (HSR_STOREY + HSR_SLAB + HSR_EYE) / 64.0;
  /* A corridor leads along z on either side of where two modules meet. */
  double corridor = (int)(plan.x / SIDE) * SIDE - plan.x;
  double far = 0.25 * SIDE * tower->n_layers;
  const double outside[3] = {plan.x + 0.5 * far, y + 0.0625 * far,
                             plan.z + far};
  const double inside[3] = {0.625 * plan.x, y, 0.375 * plan.z};
  hsr_pen_view(&tower->pen, outside, inside, 60, 0.0625);
  const double along[3] = {corridor + 0.5625, y, plan.z - 2};
  look(tower, along, 268, -0.0625, 70);
  const double across[3] = {corridor + 1, y + 0.25, plan.z - SIDE + 0.375};
  look(tower, across, 10, -0.125, 70);
  const double end[3] = {corridor + (PIER + WINDOW / 2) / 64.0, y, plan.z + 40};
  approach(tower, end, 14);
  enter(tower, end, 66, 10);
}

static enum hsr_status build(struct hsr_scene *scene, long long storeys,
                             bool bare) {
  struct tower tower = {.n_layers = (int)(storeys + 3) / 4};
  hsr_pen_init(&tower.pen, scene);
  modules(&tower);
  ground(&tower);
  for (int kind = 0; kind < KINDS; kind++)
    blocks(&tower, kind);
  if (!bare)
    shell(&tower);
  views(&tower);
  return tower.pen.status;
}

enum hsr_status hsr_build_tower(struct hsr_scene *scene,
                                const long long *parameter) {
  return build(scene, parameter[0], false);
}

enum hsr_status hsr_build_bare_tower(struct hsr_scene *scene,
                                     const long long *parameter) {
  return build(scene, parameter[0], true);
}
