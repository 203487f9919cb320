/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawings of Sketch, painted at the samples: by hand, in a picture of 8 x 4
 * samples. A pixel is 100 units, so sample (i, j) is at 100 i + 50, -100 j -
 * 50.
 */
#include "bench/peers/surfaces/painted.h"

#include "common/view/view.h"
#include "tests/tap.h"

#include <string.h>

enum { M = 8, N = 4 };

/* Whether the drawing is this picture: a row after the other, a character a
 * sample, '.' the background. */
static bool shows(const char *drawing, const char *picture) {
  uint32_t ids[M * N];
  bool good = true;
  paint_drawing(drawing, M, N, ids);
  for (int k = 0; k < M * N; k++)
    good &= ids[k] ==
            (picture[k] == '.' ? HSR_BACKGROUND : (uint32_t)(picture[k] - '0'));
  for (int j = 0; j < N && !good; j++) {
    printf("# ");
    for (int i = 0; i < M; i++)
      printf("%c", ids[j * M + i] == HSR_BACKGROUND
                       ? '.'
                       : (char)('0' + ids[j * M + i] % 10));
    printf("\n");
  }
  return good;
}

#define POLYGON(id, points)                                                    \
  "\\pspolygon[fillcolor=f" #id ",linestyle=none,fillstyle=solid]" points "\n"

int main(void) {
  struct tap tap = plan(9);
  ok(&tap, shows("% nothing\n", "................................"),
     "an empty drawing is background");
  ok(&tap,
     shows(POLYGON(3, "(100,-100)(300,-100)(300,-300)(100,-300)"),
           ".........33......33............."),
     "a rectangle");
  ok(&tap,
     shows(POLYGON(1, "(0,0)(800,0)(800,-400)(0,-400)")
               POLYGON(2, "(100,-100)(300,-100)(300,-300)(100,-300)"),
           "11111111122111111221111111111111"),
     "the last polygon is in front");
  ok(&tap,
     shows(POLYGON(5, "(50,-50)(350,-50)(350,-250)(50,-250)"),
           "555.....555....................."),
     "of samples on its sides it has those on the left and upper ones");
  ok(&tap,
     shows(POLYGON(5, "(50.001,-50)(350.001,-50)(350.001,-250)(50.001,-250)"),
           ".555.....555...................."),
     "a thousandth of a unit to the right");
  ok(&tap,
     shows(POLYGON(5, "(50,-50.001)(350,-50.001)(350,-250.001)(50,-250.001)"),
           "........555.....555............."),
     "a thousandth of a unit lower");
  ok(&tap,
     shows(POLYGON(7, "(-900000000,900000000)(900000000,-900000000)"
                      "(-900000000,-900000000)"),
           "........7.......77......777....."),
     "a very large triangle with samples on a side, which is on the right");
  ok(&tap,
     shows(POLYGON(4, "(0,0)(400,0)(400,-400)(0,-400)(0,0)(200,0)(200,-200)(0,"
                      "-200)"),
           "..44......44....4444....4444...."),
     "parity leaves a hole");
  ok(&tap,
     shows("\\psline[linestyle=none](0,0)(800,-400)\n"
           "\\pspolygon[fillcolor=f6,fillstyle=solid](.5,-.5)(100.25,-.5)(100."
           "25,-101)\n",
           "6..............................."),
     "lines are passed over; numbers without a first digit");
  return finish(&tap);
}
