/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the shaders of the area picture need of a face, as doubles that are
 * exact by definition: docs/area-picture.md, "Shaders". The functions
 * themselves are not here: who draws and who judges compute them each in their
 * own way. */
#ifndef HSR_COMMON_ANSWERS_SHADER_H
#define HSR_COMMON_ANSWERS_SHADER_H

#include "common/base/arena.h"
#include "common/scene/world.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_shader {
  HSR_SHADER_FLAT,
  HSR_SHADER_GOURAUD,
  HSR_SHADER_CHECKER,
  HSR_SHADER_BUMPS,
  HSR_SHADER_PHONG,
  HSR_SHADER_SKY,
  HSR_SHADER_WATER
};

/* What a shader is made of. */
enum {
  HSR_PART_CORNERS = 1, /* colours at a triangle's corners */
  HSR_PART_BOARD = 2,
  HSR_PART_BUMPS = 4, /* they refract the board */
  HSR_PART_HIGHLIGHT = 8,
  HSR_PART_SKY = 16
};
unsigned hsr_shader_parts(enum hsr_shader shader);

/* The constants of the definition. Lengths are in sides of a square. */
#define HSR_SHADER_DARK .25        /* of a dark square, times the colour */
#define HSR_SHADER_WAVE 4          /* from bump to bump */
#define HSR_SHADER_DEPTH 2         /* of the board, under bumps */
#define HSR_SHADER_TROCHOID .5     /* κ */
#define HSR_SHADER_TILT .5         /* of bumps */
#define HSR_SHADER_INDEX .75       /* of refraction: 1 over that of water */
#define HSR_SHADER_GLOSS 4         /* the exponent is 2 to the power of this */
#define HSR_SHADER_HIGHLIGHT .5    /* of the way to white */
#define HSR_SHADER_REFLECTION .375 /* of what is seen where there is a sky */
extern const double hsr_sky_low[3], hsr_sky_high[3]; /* the ramp's two ends */

/* A view's shader. Borrows the world, the view and the arena. */
struct hsr_shades {
  unsigned parts;
  double side;     /* of a square */
  double light[3]; /* towards it */
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct hsr_arena *arena;
  double **normals; /* an object: 3 a vertex; NULL until they are needed */
};

/* HSR_E_NOMEM. */
enum hsr_status hsr_shades_init(struct hsr_shades *shades,
                                enum hsr_shader shader, double side,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena);

struct hsr_shaded_face {
  uint16_t rgb[3];  /* its one colour, in 65535ths */
  double normal[3]; /* of length 1, but for rounding; towards the eye */
  int u, v;         /* the axes of the board */
  bool by_corners;  /* a triangle: corner[k] is of its k-th corner */
  uint16_t corner[3][3];
};

/* Fills *face for the face of this id, which exists; it may be HSR_BACKGROUND,
 * which has nothing but rgb. False if memory ran out. */
bool hsr_shades_face(struct hsr_shades *shades, uint32_t id,
                     struct hsr_shaded_face *face);

#ifdef __cplusplus
}
#endif
#endif
