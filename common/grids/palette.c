/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/palette.h"

#include <string.h>

enum { ONE = 65535 };

/* Percent, of what is 1. */
#define P(percent) ((uint16_t)(ONE * (percent) / 100))
#define GREY(percent)                                                          \
  { P(percent), P(percent), P(percent) }

/* Each list of points ends with that at level 255. */
enum { MOST_POINTS = 6 };
struct made {
  struct hsr_palette_point opacity[MOST_POINTS], rgb[MOST_POINTS],
      gradient[MOST_POINTS];
  bool own_colours;
  uint16_t ambient, diffuse, specular;
  int exponent;
};

const struct hsr_palette_name hsr_palette_names[] = {
    {"flat", "opaque, in the samples' own colours, without light"},
    {"solid", "opaque, lit from the eye"},
    {"haze", "white, an eighth opaque at the greatest density, without light"},
    {"surfaces", "opaque where the density changes fast, lit from the eye"},
    {"bone", "faint skin over what is dense and opaque, lit from the eye"},
    {"tissue", "translucent, from red to white by density, clearest where the "
               "density changes, lit from the eye"},
    {"heat", "glowing from black over red and yellow to white by density, "
             "without light"},
    {"cortex",
     "the brain of an MR image of a head, through skull and skin: what "
     "is even and of middling density, lit from the eye"},
    {NULL, NULL}};

#define OPAQUE                                                                 \
  {                                                                            \
    {                                                                          \
      255, {                                                                   \
        ONE                                                                    \
      }                                                                        \
    }                                                                          \
  }
#define LIT                                                                    \
  .ambient = P(20), .diffuse = ONE - P(20), .specular = ONE / 6, .exponent = 24
#define UNLIT .ambient = ONE, .exponent = 1

/* In the order of the names. */
static const struct made made[] = {
    {OPAQUE, {{255, GREY(75)}}, OPAQUE, true, UNLIT},
    {OPAQUE, {{255, GREY(75)}}, OPAQUE, true, LIT},
    {{{0, {0}}, {255, {ONE / 8}}}, {{255, GREY(100)}}, OPAQUE, false, UNLIT},
    /* After M. Levoy, "Display of Surfaces from Volume Data", 1988. */
    {OPAQUE,
     {{255, GREY(75)}},
     {{0, {0}}, {128, {ONE}}, {255, {ONE}}},
     true,
     LIT},
    {{{30, {0}}, {60, {P(2)}}, {120, {P(5)}}, {150, {P(80)}}, {255, {ONE}}},
     {{100, {P(60), P(25), P(12)}},
      {140, {P(90), P(75), P(50)}},
      {255, GREY(95)}},
     {{0, {P(30)}}, {40, {ONE}}, {255, {ONE}}},
     false,
     LIT},
    {{{30, {0}}, {60, {P(8)}}, {110, {P(30)}}, {255, {P(80)}}},
     {{40, {P(30), P(2), P(1)}},
      {90, {P(75), P(18), P(10)}},
      {130, {P(90), P(60), P(45)}},
      {255, GREY(100)}},
     {{0, {P(10)}}, {32, {ONE}}, {255, {ONE}}},
     false,
     LIT},
    {{{16, {0}}, {128, {P(8)}}, {255, {P(50)}}},
     {{16, {0}},
      {80, {P(70), 0, 0}},
      {140, {ONE, P(60), 0}},
      {220, GREY(100)},
      {255, GREY(100)}},
     OPAQUE,
     false,
     UNLIT},
    {{{70, {0}}, {100, {P(30)}}, {118, {P(80)}}, {132, {P(1)}}, {255, {0}}},
     {{60, {P(30), P(12), P(10)}},
      {90, {P(60), P(35), P(30)}},
      {120, {P(95), P(90), P(80)}},
      {255, GREY(95)}},
     {{10, {ONE}}, {20, {P(1)}}, {255, {P(1)}}},
     false,
     LIT}};
_Static_assert(sizeof made / sizeof *made + 1 ==
                   sizeof hsr_palette_names / sizeof *hsr_palette_names,
               "every palette has a name");

uint16_t hsr_palette_at(const struct hsr_palette_point *point, int level,
                        int channel) {
  if (level <= point->level)
    return point->value[channel];
  while (point[1].level < level)
    point++;
  int before = level - point[0].level, after = point[1].level - level;
  return (uint16_t)((point[0].value[channel] * after +
                     point[1].value[channel] * before) /
                    (before + after));
}

static void make(const struct made *m, struct hsr_palette *palette) {
  *palette = (struct hsr_palette){.own_colours = m->own_colours,
                                  .ambient = m->ambient,
                                  .diffuse = m->diffuse,
                                  .specular = m->specular,
                                  .exponent = m->exponent,
                                  .eye_light = true};
  for (int k = 0; k < HSR_LEVELS; k++) {
    palette->opacity[k] = hsr_palette_at(m->opacity, k, 0);
    palette->gradient[k] = hsr_palette_at(m->gradient, k, 0);
    for (int c = 0; c < 3; c++)
      palette->rgb[k][c] = hsr_palette_at(m->rgb, k, c);
  }
}

bool hsr_palette_find(const char *name, struct hsr_palette *palette) {
  for (int k = 0; hsr_palette_names[k].name; k++)
    if (!strcmp(name, hsr_palette_names[k].name)) {
      make(&made[k], palette);
      return true;
    }
  return false;
}
