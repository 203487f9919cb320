/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The judge of lines that are drawn as pixels, by pictures that are wrong in
 * known ways.
 *
 * In 48 x 48 pixels, 6 of which are one unit, the square's sides are at 18 and
 * 30; the strip's ends at 6 and 42, its long sides at 21 and 27. */
#include "bench/peers/lines/line_pixels.h"
#include "tests/unit/peers/strip.h"

#include <stdlib.h>

enum { SIZE = 48, SQUARE = 0, STRIP = 1 };

struct bench {
  struct strip strip;
  uint32_t pixel[SIZE * SIZE];
};

/* Pixels [x0, x1] x [y0, y1]. */
static void put(struct bench *b, uint32_t face, int x0, int x1, int y0,
                int y1) {
  for (int y = y0; y <= y1; y++)
    for (int x = x0; x <= x1; x++)
      b->pixel[y * SIZE + x] = face;
}

static void put_right(struct bench *b) {
  put(b, HSR_BACKGROUND, 0, SIZE - 1, 0, SIZE - 1);
  for (int side = 0; side < 2; side++) {
    put(b, STRIP, 6, 17, side ? 27 : 21, side ? 27 : 21);
    put(b, STRIP, 30, 41, side ? 27 : 21, side ? 27 : 21);
    put(b, STRIP, side ? 42 : 6, side ? 42 : 6, 21, 27);
    put(b, SQUARE, 18, 29, side ? 30 : 18, side ? 30 : 18);
    put(b, SQUARE, side ? 30 : 18, side ? 30 : 18, 18, 30);
  }
}

/* Whether so many edges are wrong in each way, by so many pixels. */
static bool says(struct bench *b, size_t visible, size_t visible_px,
                 size_t hidden, size_t hidden_px) {
  struct pixels_verdict v;
  struct hsr_error err;
  if (line_pixels_compare(&b->strip.edges, &b->strip.view, b->pixel,
                          &b->strip.right, &v, &err))
    return false;
  bool good = v.edges == 8 && v.visible == visible &&
              v.visible_px == visible_px && v.hidden == hidden &&
              v.hidden_px == hidden_px;
  if (!good)
    printf("# %zu edges, %zu by %zu shown, %zu by %zu hidden\n", v.edges,
           v.visible, v.visible_px, v.hidden, v.hidden_px);
  return good;
}

int main(void) {
  struct tap tap = plan(8);
  struct bench b;
  open_strip(&b.strip, SIZE, 0);
  put_right(&b);
  ok(&tap, says(&b, 0, 0, 0, 0), "the right picture has no error");

  put(&b, STRIP, 17, 30, 21, 21);
  ok(&tap, says(&b, 1, 10, 0, 0),
     "a hidden third is shown: 12 pixels, less one and a bit at either end");

  put_right(&b);
  put(&b, HSR_BACKGROUND, 6, 17, 27, 27);
  ok(&tap, says(&b, 0, 0, 1, 9),
     "a visible third is not: 10 steps, of which one is beside the strip's "
     "end");

  put_right(&b);
  put(&b, HSR_BACKGROUND, 10, 10, 21, 21);
  ok(&tap, says(&b, 0, 0, 0, 0), "a gap of one pixel is none");
  put(&b, HSR_BACKGROUND, 10, 12, 21, 21);
  ok(&tap, says(&b, 0, 0, 1, 1), "a gap of three pixels is one");

  put_right(&b);
  put(&b, STRIP, 2, 2, 24, 24);
  ok(&tap, says(&b, 1, 1, 0, 0), "a pixel that lies apart from its face");

  put_right(&b);
  put(&b, STRIP, 18, 29, 18, 18);
  ok(&tap, says(&b, 1, 12, 0, 0), "the square's side in the strip's colour");

  put_right(&b);
  put(&b, SQUARE, 6, 15, 21, 21);
  ok(&tap, says(&b, 1, 10, 0, 0),
     "one edge covers another: it is wrong there, the other one is not");
  close_strip(&b.strip);
  return finish(&tap);
}
