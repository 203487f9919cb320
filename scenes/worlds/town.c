/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The harbors of Table II of Sutherland et al. 1974: F_r faces in the picture,
 * twice as many in all, F_c of them in a cluster, D_c = 3 over one another.
 *
 * Lengths are in metres. The quay runs along the x axis, the water lies to +z,
 * the town to -z. The plane is cut into square lots. Those that the standard
 * view holds are built on, each with an instance of one object: a cluster. With
 * more clusters the standard view is farther away. So the picture, and with it
 * the depth complexity, stays about the same at all sizes. */
#include "scenes/builders.h"
#include "scenes/parts/lots.h"

#include <math.h>
#include <stdlib.h>

/* Settings that come near Table II: its harbors are the third and the last row,
 * its house the first. Lots get a few faces fewer than they are asked for,
 * since they are drawn in whole boxes. Finer lots hide more of themselves; they
 * are made lower, so that D_c is the same. */
struct setting {
  double relevant, per_cluster; /* F_r, F_c */
  double faces;                 /* asked of a lot */
  double stretch;               /* of what stands on land, upwards */
};
static const struct setting settings[5] = {{100, 8, 11, 1.125},
                                           {500, 16, 17, 1.375},
                                           {2500, 25, 26, 1.3125},
                                           {12000, 69, 72, 1.0625},
                                           {60000, 200, 203, 0.78125}};

static double mix(double a, double b, double t) {
  return a + t * (b - a);
}

static struct setting setting_for(double relevant) {
  int i = 0;
  while (i < 3 && relevant > settings[i + 1].relevant)
    i++;
  const struct setting *a = &settings[i], *b = a + 1;
  double t = (relevant - a->relevant) / (b->relevant - a->relevant);
  return (struct setting){relevant, mix(a->per_cluster, b->per_cluster, t),
                          mix(a->faces, b->faces, t),
                          mix(a->stretch, b->stretch, t)};
}

/* The standard view, in units of its scale: from the south-east, over the
 * water, to the north-west. */
static const double EYE[3] = {0.7, 0.8, 1.6}, AT[3] = {-0.12, 0, -0.5},
                    FOV = 38, TANGENT = 0.34433; /* tan(FOV / 2), nearly */

static void towards(double f[3]) {
  double length = 0;
  for (int k = 0; k < 3; k++) {
    f[k] = AT[k] - EYE[k];
    length += f[k] * f[k];
  }
  for (int k = 0; k < 3; k++)
    f[k] /= sqrt(length);
}

/* Where the standard view shows a point of the ground: sideways and up, -1 to
 * 1 in the picture. False if behind it. */
static bool on_picture(double x, double z, double picture[2]) {
  double f[3], v[3] = {x - EYE[0], -EYE[1], z - EYE[2]};
  towards(f);
  double across = sqrt(f[0] * f[0] + f[2] * f[2]);
  double depth = v[0] * f[0] + v[1] * f[1] + v[2] * f[2];
  double right = (v[2] * f[0] - v[0] * f[2]) / across;
  double up = (v[1] - depth * f[1]) / across;
  picture[0] = right / (depth * TANGENT);
  picture[1] = up / (depth * TANGENT);
  return depth > 0;
}

struct lot {
  enum hsr_lot_kind kind;
  int variant, quarters;
  double x, z; /* metres */
};

struct plan {
  double scale;   /* metres of a unit of the standard view */
  int n_faces;    /* asked of a lot */
  double stretch; /* of what stands on land, upwards */
  int church[2];  /* column and row of its lot */
  struct lot *lots;
  int n_lots, most;
  struct hsr_random random;
};

/* Whether the standard view shows what stands about (x, z), all of it to the
 * left, the right and below, and leaves room above. */
static bool holds(const struct plan *plan, double x, double z) {
  double p[2], s = plan->scale, reach = 0.375 * HSR_LOT_SIZE;
  for (int i = 0; i < 4; i++)
    if (!on_picture((x + (i & 1 ? reach : -reach)) / s,
                    (z + (i & 2 ? reach : -reach)) / s, p) ||
        fabs(p[0]) > 0.97 || p[1] < -0.97)
      return false;
  return on_picture(x / s, z / s, p) && p[1] < 0.5;
}

/* How far from the middle the picture may hold lots. */
static int reach_in_lots(const struct plan *plan) {
  return (int)(6 * plan->scale / HSR_LOT_SIZE) + 1;
}

static bool on_pier(int i, int k) {
  return (i + 1) % 3 == 0 && k >= 0 && k < 3;
}

/* The purpose of the lot in column i and row k; -1 if it stays empty. Rows
 * count from the quay to the water. */
static int purpose(struct plan *plan, int i, int k, double inland) {
  static const int pier[4] = {HSR_LOT_crane, HSR_LOT_containers,
                              HSR_LOT_warehouse, HSR_LOT_containers};
  static const int quay[4] = {HSR_LOT_crane, HSR_LOT_containers, HSR_LOT_crane,
                              HSR_LOT_warehouse};
  static const int works[4] = {HSR_LOT_warehouse, HSR_LOT_tank,
                               HSR_LOT_warehouse, HSR_LOT_containers};
  static const int town[8] = {HSR_LOT_houses, HSR_LOT_houses, HSR_LOT_houses,
                              HSR_LOT_park,   HSR_LOT_houses, HSR_LOT_tower,
                              HSR_LOT_houses, HSR_LOT_houses};
  static const int city[4] = {HSR_LOT_tower, HSR_LOT_tower, HSR_LOT_tower,
                              HSR_LOT_houses};
  int pick = hsr_random_int(&plan->random, 0, 7);
  if (i == 2 && k == 1)
    return HSR_LOT_lighthouse;
  if (i == plan->church[0] && k == plan->church[1])
    return HSR_LOT_church;
  if (on_pier(i, k))
    return pier[pick & 3];
  if (k >= 0)
    return pick < 4 ? HSR_LOT_ship : pick < 6 ? HSR_LOT_boats : -1;
  if (k == -1)
    return quay[pick & 3];
  if (inland < 0.35)
    return works[pick & 3];
  return inland < 1.1 ? town[pick] : city[pick & 3];
}

static void take(struct plan *plan, int i, int k) {
  double x = (i + 0.5) * HSR_LOT_SIZE, z = (k + 0.5) * HSR_LOT_SIZE;
  if (plan->n_lots == plan->most || !holds(plan, x, z))
    return;
  int kind = purpose(plan, i, k, -z / plan->scale);
  int variant = hsr_random_int(&plan->random, 0, 59);
  int quarters = hsr_random_int(&plan->random, 0, 3);
  if (kind < 0)
    return;
  if (kind == HSR_LOT_crane)
    quarters = 0;
  plan->lots[plan->n_lots++] =
      (struct lot){(enum hsr_lot_kind)kind,
                   variant % hsr_lot_types[kind].n_variants, quarters, x, z};
}

/* Lots nearest the quay first, to both sides of it. */
static void plan_lots(struct plan *plan) {
  plan->random.state = 1974;
  plan->church[0] = (int)(-0.2 * plan->scale / HSR_LOT_SIZE);
  plan->church[1] = (int)(-0.75 * plan->scale / HSR_LOT_SIZE) - 1;
  plan->n_lots = 0;
  int reach = reach_in_lots(plan);
  for (int k = 0; k < 2 * reach; k++)
    for (int i = -reach; i <= reach; i++)
      take(plan, i, k & 1 ? k / 2 : -1 - k / 2);
}

/* The first scale, in steps of a sixteenth, at which there are lots enough. */
static void plan_scale(struct plan *plan) {
  plan->scale = 16;
  do {
    plan->scale += floor(plan->scale / 16);
    plan_lots(plan);
  } while (plan->n_lots < plan->most);
}

static void slab(struct hsr_pen *pen, const char *name, unsigned colour,
                 const double lo[3], const double hi[3]) {
  hsr_pen_object(pen, name, true);
  hsr_pen_paint(pen, colour);
  hsr_pen_box(pen, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
}
#define P(x, y, z) ((const double[3]){x, y, z})

static const double QUAY_EDGE = -4;

static void ground(struct hsr_pen *pen, const struct plan *plan) {
  double s = plan->scale;
  slab(pen, "sea", 0x3f7f93, P(-12 * s, -20, -9 * s),
       P(8 * s, HSR_WATER, 6 * s));
  hsr_pen_place(pen, NULL);
  slab(pen, "land", 0xb5ae98, P(-10 * s, HSR_WATER, -2.5 * s),
       P(6 * s, 0, QUAY_EDGE));
  hsr_pen_place(pen, NULL);
  slab(pen, "country", 0x9cb87c, P(-10 * s, HSR_WATER, -8 * s),
       P(6 * s, 0, -2.5 * s));
  hsr_pen_place(pen, NULL);
}

/* Whether the standard view holds a lot on the pier of column i. */
static bool has_pier(const struct plan *plan, int i) {
  for (int k = 0; on_pier(i, k); k++)
    if (holds(plan, (i + 0.5) * HSR_LOT_SIZE, (k + 0.5) * HSR_LOT_SIZE))
      return true;
  return false;
}

static void piers(struct hsr_pen *pen, const struct plan *plan) {
  bool drawn = false;
  int reach = reach_in_lots(plan);
  for (int i = -reach; i <= reach; i++) {
    if (!has_pier(plan, i))
      continue;
    if (!drawn)
      slab(pen, "pier", 0x9a948a, P(4, HSR_WATER, QUAY_EDGE),
           P(HSR_LOT_SIZE - 4, 0, 3 * HSR_LOT_SIZE));
    drawn = true;
    double m[12];
    hsr_pen_matrix(m, i * HSR_LOT_SIZE, 0, 0, 0);
    hsr_pen_place(pen, m);
  }
}

static void hills(struct hsr_pen *pen, const struct plan *plan) {
  static const double hill[3][4] = {
      {-2.4, -4.6, 1.2, 0.5}, {-0.1, -5.0, 1.1, 0.4}, {-4.7, -4.2, 1.1, 0.4}};
  hsr_pen_object(pen, "hill", true);
  if (!pen->status)
    hsr_lot_types[HSR_LOT_hill].draw(pen, 0, plan->n_faces);
  for (int i = 0; i < 3; i++) {
    double h[4];
    for (int k = 0; k < 4; k++)
      h[k] = floor(hill[i][k] * plan->scale);
    const double m[12] = {h[2], 0, 0, h[0], 0, h[3], 0, 0, 0, 0, h[2], h[1]};
    hsr_pen_place(pen, m);
  }
}

/* Places all lots of one kind and variant; none, no object. */
static void build_variant(struct hsr_pen *pen, const struct plan *plan,
                          enum hsr_lot_kind kind, int variant) {
  bool drawn = false;
  for (int i = 0; i < plan->n_lots; i++) {
    const struct lot *lot = &plan->lots[i];
    if (lot->kind != kind || lot->variant != variant)
      continue;
    if (!drawn) {
      hsr_pen_object(pen, hsr_lot_types[kind].name, true);
      /* Variants differ in detail, so that sizes are not all rounded alike. */
      hsr_lot_types[kind].draw(
          pen, variant, plan->n_faces + (variant % 3 - 1) * plan->n_faces / 8);
      drawn = true;
    }
    double m[12];
    hsr_pen_matrix(m, lot->x, 0, lot->z, lot->quarters);
    if (kind != HSR_LOT_ship && kind != HSR_LOT_boats)
      m[5] = plan->stretch;
    hsr_pen_place(pen, m);
  }
}

static void views(struct hsr_pen *pen, double s) {
  static const double view[][8] = {
      {-1.2, 0.4, 1.4, -0.2, 0, -0.6, 50}, {0, 0.12, 1.2, -0.3, 0.1, -1, 60},
      {1.6, 1.2, -2.4, -0.4, 0, 0, 45},    {-3, 1.4, -1.6, -0.3, 0, -0.4, 45},
      {-0.6, 3, -0.6, -0.6, 0, -0.6, 60},  {0.1, 0.05, -0.3, -1, 0.12, -2, 70},
      {0.9, 0.3, 0.2, -1, 0, -0.1, 55},    {-0.9, 0.25, -1.6, 0.1, 0, 0.4, 65}};
  const double eye[3] = {EYE[0] * s, EYE[1] * s, EYE[2] * s},
               at[3] = {AT[0] * s, AT[1] * s, AT[2] * s};
  hsr_pen_view(pen, eye, at, FOV, 0);
  HSR_VIEWS(pen, view, s);
}

static enum hsr_status build(struct hsr_scene *scene, double relevant) {
  struct setting setting = setting_for(relevant);
  struct plan plan = {.n_faces = (int)(setting.faces + 0.5),
                      .stretch = hsr_grid(setting.stretch, 32),
                      .most = (int)(2 * relevant / setting.per_cluster) - 9};
  plan.lots = malloc((size_t)plan.most * sizeof *plan.lots);
  if (!plan.lots)
    return HSR_E_NOMEM;
  plan_scale(&plan);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  ground(&pen, &plan);
  piers(&pen, &plan);
  for (int kind = 0; kind < HSR_LOT_hill; kind++)
    for (int v = 0; v < hsr_lot_types[kind].n_variants; v++)
      build_variant(&pen, &plan, (enum hsr_lot_kind)kind, v);
  hills(&pen, &plan);
  views(&pen, plan.scale);
  free(plan.lots);
  return pen.status;
}

enum hsr_status hsr_build_harbor(struct hsr_scene *scene,
                                 const long long *parameter) {
  return build(scene, (double)parameter[0]);
}

enum hsr_status hsr_build_big_harbor(struct hsr_scene *scene,
                                     const long long *parameter) {
  (void)parameter;
  return build(scene, 60000);
}
