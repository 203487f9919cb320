/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judge of peers that draw lines, by drawings that are wrong in known ways.
 *
 * Of the strip, 60 pixels are one unit: its long edges are 360 pixels, all that
 * is visible 1080. */
#include "tests/unit/peers/strip.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_PARTS = 32, N_EDGES = 8 };

/* In the order of drawings: four edges of the square, and of the strip. */
enum { SQUARE, BOTTOM = 4, LEFT, RIGHT, TOP };

struct bench {
  struct strip strip;
  struct drawn_part part[MOST_PARTS];
  size_t n;
};

static void draw(struct bench *b, uint32_t edge, bool visible, double t0,
                 double t1) {
  b->part[b->n++] = (struct drawn_part){edge, visible, t0, t1};
}

/* All edges, rightly, but for the one that is left out. They are not in order.
 */
static void draw_others(struct bench *b, uint32_t but) {
  b->n = 0;
  for (uint32_t e = N_EDGES; e-- > 0;)
    if (e != but && (e == BOTTOM || e == TOP)) {
      draw(b, e, true, 2. / 3, 1);
      draw(b, e, false, 1. / 3, 2. / 3);
      draw(b, e, true, 0, 1. / 3);
    } else if (e != but)
      draw(b, e, true, 0, 1);
}

static struct lines_verdict judge(struct bench *b) {
  struct lines_verdict verdict;
  struct hsr_error err;
  if (lines_compare(&b->strip.edges, &b->strip.view, b->part, b->n,
                    &b->strip.right, &verdict, &err))
    bail("no verdict");
  return verdict;
}

static bool is_near(double value, double wanted) {
  return fabs(value - wanted) < 1e-6;
}

/* Whether so many edges are wrong in each way, over so many pixels in all. */
static bool says(const struct lines_verdict *v, size_t visible, size_t hidden,
                 size_t missing, double pixels) {
  bool good = v->edges == N_EDGES && v->count[WRONGLY_VISIBLE] == visible &&
              v->count[WRONGLY_HIDDEN] == hidden &&
              v->count[LINES_MISSING] == missing &&
              is_near(v->length[WRONGLY_VISIBLE] + v->length[WRONGLY_HIDDEN] +
                          v->length[LINES_MISSING],
                      pixels);
  if (!good)
    printf("# %zu edges; %zu, %zu, %zu wrong; %g, %g, %g pixels\n", v->edges,
           v->count[0], v->count[1], v->count[2], v->length[0], v->length[1],
           v->length[2]);
  return good;
}

static void test_errors(struct tap *tap) {
  struct bench b;
  open_strip(&b.strip, 480, 0);
  draw_others(&b, UINT32_MAX);
  struct lines_verdict v = judge(&b);
  ok(tap, says(&v, 0, 0, 0, 0) && v.wrong == 0 && v.disputed == 0,
     "the right drawing has no error");
  ok(tap, is_near(v.visible, 1080), "1080 pixels are visible");

  draw_others(&b, TOP);
  draw(&b, TOP, true, 0, 1);
  v = judge(&b);
  ok(tap, says(&v, 1, 0, 0, 120) && v.wrong == 1 && v.disputed == 0,
     "a hidden third is shown");

  draw_others(&b, TOP);
  draw(&b, TOP, false, 0, 1);
  v = judge(&b);
  ok(tap, says(&v, 0, 1, 0, 240) && v.wrong == 1, "two thirds are hidden");

  draw_others(&b, TOP);
  v = judge(&b);
  ok(tap, says(&v, 0, 0, 1, 360) && v.wrong == 1, "an edge is missing");

  draw_others(&b, SQUARE);
  draw(&b, SQUARE, true, 0, .5);
  draw(&b, SQUARE, false, .75, 1);
  v = judge(&b);
  ok(tap, says(&v, 0, 1, 1, 60) && v.wrong == 1,
     "a quarter of an edge is missing, another is hidden: one edge is wrong");

  draw_others(&b, LEFT);
  draw(&b, LEFT, true, 0, .75);
  draw(&b, LEFT, true, .5, 1);
  draw(&b, LEFT, false, .5, 1);
  v = judge(&b);
  ok(tap, says(&v, 0, 0, 0, 0), "what is shown once is shown");

  draw_others(&b, RIGHT);
  draw(&b, RIGHT, true, .0001, 1);
  v = judge(&b);
  ok(tap, says(&v, 0, 0, 0, .006) && v.wrong == 0,
     "less than a hundredth of a pixel is measured, and not counted");
  close_strip(&b.strip);
}

/* The strip's upper edge is seen along the square's. */
static void test_disputes(struct tap *tap) {
  struct bench b;
  open_strip(&b.strip, 480, .5);
  draw_others(&b, TOP);
  draw(&b, TOP, true, 0, 1);
  struct lines_verdict v = judge(&b);
  ok(tap, says(&v, 1, 0, 0, 120) && v.wrong == 1 && v.disputed == 1,
     "along another edge it is wrong only where it is disputed");

  draw_others(&b, BOTTOM);
  draw(&b, BOTTOM, true, 0, 1);
  v = judge(&b);
  ok(tap, v.wrong == 1 && v.disputed == 0, "the lower edge is not disputed");

  draw_others(&b, TOP);
  v = judge(&b);
  ok(tap, v.wrong == 1 && v.disputed == 0,
     "an edge that is missing, and only in part disputed, is wrong");
  close_strip(&b.strip);
}

int main(void) {
  struct tap tap = plan(11);
  test_errors(&tap);
  test_disputes(&tap);
  return finish(&tap);
}
