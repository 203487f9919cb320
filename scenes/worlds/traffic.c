/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The office with moving carts. Each goes back and forth on a straight way of
 * its own, along x or z, and turns as it goes: from one end of the building to
 * the other, or on a part of that. There are as many as make the given
 * percentage of all faces move. They pass through whatever stands there. What
 * is known of their motion, the scene says. */
#include "common/scene/motion.h"
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

enum { MODULES = 3, CART_FACES = 8 * 12, MODULE_FACES = 14976 };
static const double LENGTH = 16.0 * MODULES, STOREY = 4;

/* 96 triangles, about the origin, its wheels on y = 0. */
static void draw_cart(struct hsr_pen *pen) {
  hsr_pen_object(pen, "cart", true);
  pen->triangles = true;
  pen->scene->objects[pen->object].moves = true;
  hsr_pen_paint(pen, 0xb23a33);
  hsr_pen_box(pen, -0.375, 0.25, -0.25, 0.375, 0.3125, 0.25);
  hsr_pen_paint(pen, 0x6f9dbd);
  hsr_pen_box(pen, -0.3125, 0.3125, -0.1875, 0.1875, 0.75, 0.1875);
  hsr_pen_paint(pen, 0x4b5560);
  hsr_pen_box(pen, 0.3125, 0.3125, -0.25, 0.375, 1, -0.1875);
  hsr_pen_box(pen, 0.3125, 0.3125, 0.1875, 0.375, 1, 0.25);
  for (int k = 0; k < 4; k++) {
    double x = k & 1 ? 0.25 : -0.25, z = k & 2 ? 0.1875 : -0.1875;
    hsr_pen_box(pen, x - 0.0625, 0, z - 0.03125, x + 0.0625, 0.125,
                z + 0.03125);
  }
}

/* A cart's way. */
struct drive {
  double from, length; /* along the building */
  double start;        /* so far it is along its way, and back, at frame 0 */
  double speed;        /* metres a frame */
  double aside, floor;
  bool along_x, reversed;
};

/* How far along the building it is. */
static double place_along(const struct drive *d, double frame) {
  double round = 2 * d->length, gone = d->start + d->speed * frame;
  gone -= round * (double)(long long)(gone / round);
  double along = gone < d->length ? gone : round - gone;
  return d->from + (d->reversed ? d->length - along : along);
}

/* A cart reaches less than this far from its middle, whichever way it is
 * turned. */
static const double REACH = 0.46, HEIGHT = 1;

static void bounds_at(const struct drive *d, double first, double last,
                      double lo[3], double hi[3]) {
  int along = d->along_x ? 0 : 2, aside = 2 - along;
  lo[along] = first - REACH;
  hi[along] = last + REACH;
  lo[aside] = d->aside - REACH;
  hi[aside] = d->aside + REACH;
  lo[1] = d->floor - 0.01;
  hi[1] = d->floor + HEIGHT + 0.01;
}

/* Its way is known so far. */
enum { KNOWN_FRAMES = 1024, MOST_KEYS = 128 };

/* A key at the beginning, at each end of the way, and at the end of what is
 * known. */
static uint32_t make_keys(const struct drive *d, struct hsr_key *key) {
  uint32_t n = 0;
  for (double turns = 1 + (double)(long long)(d->start / d->length), frame = 0;
       n < MOST_KEYS; turns++) {
    double at = place_along(d, frame);
    key[n].frame = frame;
    bounds_at(d, at, at, key[n].lo, key[n].hi);
    n++;
    if (frame >= KNOWN_FRAMES)
      break;
    frame = (turns * d->length - d->start) / d->speed;
    if (frame > KNOWN_FRAMES)
      frame = KNOWN_FRAMES;
  }
  return n;
}

/* A point of a cart that turns by a degree moves by less than .008. */
static void say_motion(struct hsr_pen *pen, const struct drive *d) {
  struct hsr_motion motion = {.speed = d->speed + 0.008};
  struct hsr_key key[MOST_KEYS];
  bounds_at(d, d->from, d->from + d->length, motion.lo, motion.hi);
  if (!pen->status)
    pen->status =
        hsr_scene_set_motion(pen->scene, &motion, key, make_keys(d, key));
}

/* Places a cart at a frame. Its way, speed and turning are random. */
static void place_cart(struct hsr_pen *pen, struct hsr_random *random,
                       double frame, double length) {
  double start = LENGTH * hsr_random_unit(random);
  struct drive d = {.length = length > 0 ? length : LENGTH};
  d.aside = 1 + (LENGTH - 2) * hsr_random_unit(random);
  d.speed = 0.02 + 0.06 * hsr_random_unit(random);
  d.floor = STOREY * hsr_random_int(random, 0, 4 * MODULES - 1) + 0.25;
  int direction = hsr_random_int(random, 0, 3);
  uint32_t turns = (uint32_t)hsr_random_int(random, 0, 359);
  d.along_x = direction & 2;
  d.reversed = direction & 1;
  d.from = start / LENGTH * (LENGTH - d.length);
  d.start = length > 0 ? start / LENGTH * d.length : start;
  double along = place_along(&d, frame), c, s;
  double x = d.along_x ? along : d.aside, z = d.along_x ? d.aside : along;
  hsr_unit((turns + (uint32_t)frame) % 360, 360, &c, &s);
  const double m[12] = {c, 0, s, x, 0, 1, 0, d.floor, -s, 0, c, z};
  hsr_pen_place(pen, m);
  say_motion(pen, &d);
}

enum hsr_status hsr_build_traffic(struct hsr_scene *scene,
                                  const long long *parameter) {
  const long long office[3] = {MODULES, 0, 0};
  double per_cent = (double)parameter[0], frame = (double)parameter[1];
  double length = (double)parameter[2];
  double still = (double)MODULE_FACES * MODULES * MODULES * MODULES;
  int carts = (int)(still * per_cent / (100 - per_cent) / CART_FACES + 0.5);
  enum hsr_status status = hsr_build_office(scene, office);
  if (status)
    return status;
  struct hsr_random random = {1995};
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  draw_cart(&pen);
  for (int k = 0; k < carts; k++)
    place_cart(&pen, &random, frame, length);
  return pen.status ? pen.status : hsr_scene_set_frame(scene, parameter[1]);
}
