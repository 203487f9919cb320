/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact answers about shadows: which faces block the light of a view from a
 * visible point. docs/shadow-picture.md has the definition and the notation.
 *
 * Source      A. Appel, "Some techniques for shading machine renderings of
 *             solids", AFIPS SJCC 1968: a visible point is in shadow if another
 *             face lies between it and the light.
 * Exact       interval arithmetic, with rounded planes and exact vertices,
 *             comes first. If it leaves a sign open, exact numbers decide, and
 *             tally->exact counts that.
 * Faces       the world must be laid out, and must not be one of pieces.
 * Memory      if memory runs out, tally->out_of_memory is set and the result is
 *             meaningless. */
#ifndef HSR_COMMON_EXACT_SHADOW_H
#define HSR_COMMON_EXACT_SHADOW_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The light of a screen's view. */
struct hsr_lighting {
  const struct hsr_screen *screen; /* borrowed */
  const double *light;             /* the view's light, L; borrowed */
  signed char *side; /* by face: the sign of the height of L over its plane, +1
                        if L is in front of the face */
};

/* Sets up *lighting: finds the sides of all faces. Its arrays are in the arena.
 * `screen`, whose depth planes are filled in, is borrowed and must outlive
 * *lighting. HSR_E_NOMEM. */
enum hsr_status hsr_lighting_init(struct hsr_lighting *lighting,
                                  const struct hsr_screen *screen,
                                  struct hsr_arena *arena,
                                  struct hsr_tally *tally);

/* Whether the light is on the same side of face f as the eye, so that the eye
 * sees a lit side. f exists (hsr_face_exists). */
bool hsr_faces_light(const struct hsr_lighting *lighting, uint32_t f,
                     struct hsr_tally *tally);

/* Whether face g may block the light at all. It cannot if its plane holds the
 * light, or if it is one-sided and its back is towards the light. */
static inline bool hsr_may_block(const struct hsr_lighting *lighting,
                                 uint32_t g) {
  bool one_sided = lighting->screen->world->mesh.one_sided[g];
  return lighting->side[g] > 0 || (lighting->side[g] < 0 && !one_sided);
}

/* The point P of a face that is visible at a sample. */
struct hsr_lit_point {
  uint32_t face;
  double sx, sy;          /* the sample, in pixels */
  double low[3], high[3]; /* a box that holds P, undisplaced, in world units;
                             not finite if none was found */
  /* The row of the light ray (docs/shadow-picture.md): row(v) is row . (v -
   * from). The components of `row` are off by at most row_error, and those of
   * `from` by at most from_error. They are not finite if no bound was found. */
  double row[3], row_error, from[3], from_error;
};

/* Sets *point for face f, the visible face of sample (i, j). */
void hsr_lit_point_find(const struct hsr_lighting *lighting, uint32_t f, int i,
                        int j, struct hsr_lit_point *point);

/* Whether face g, for which hsr_may_block holds, blocks the light from P. */
bool hsr_blocks(const struct hsr_lighting *lighting,
                const struct hsr_lit_point *point, uint32_t g,
                struct hsr_tally *tally);

/* Balls that hold faces: all corners of face k are within r[k] of (x[k], y[k],
 * z[k]), in world units. */
struct hsr_light_balls {
  float *x, *y, *z, *r;
};

/* Makes the balls of the faces face[0 .. n-1]; ball k is of face[k]. The arrays
 * are in the arena. HSR_E_NOMEM. */
enum hsr_status hsr_light_balls_make(struct hsr_light_balls *balls,
                                     const struct hsr_world *world,
                                     const uint32_t *face, uint32_t n,
                                     struct hsr_arena *arena);

/* For n balls from ball k on: sets beside[i] to 1 if ball k + i certainly does
 * not meet the plane of the light ray's row, else to 0. A face whose ball does
 * not meet it does not block the light from P. */
void hsr_light_balls_beside(const struct hsr_light_balls *balls,
                            const struct hsr_lit_point *point, uint32_t k,
                            uint32_t n, uint8_t *beside);

/* Whether face g may block the light from any point of face f, judged by their
 * planes alone. It may if a part of g is on the light's side of the plane of f,
 * and a part of f is on the far side of the plane of g. If one of the faces is
 * not flat, the result is true in doubt. The light must not be in the plane of
 * f, and hsr_may_block must hold for g. */
bool hsr_may_shade(const struct hsr_lighting *lighting, uint32_t g, uint32_t f,
                   struct hsr_tally *tally);

/* --- The light's picture -------------------------------------------------- */

/* The light's picture is the scene as projected from the light. For a sun it
 * has one side, a plane across an axis, in world units. For a light at a point
 * it has six sides, those of a cube about the light; the coordinates on each
 * run from -1 to 1. hsr_light_sides returns the number of sides. */
enum { HSR_LIGHT_SIDES = 6 };
int hsr_light_sides(const struct hsr_lighting *lighting);

/* A box on a side of the light's picture. Its bounds may be infinite. */
struct hsr_light_box {
  double low[2], high[2];
};

/* Finds a box that holds the image of face f on this side. False if the face
 * has no image there. If f blocks the light from a point P, the image of P is
 * in the box of P's side. `reach` widens the face in every direction, in world
 * units. It is 0 for a face that may block the light. */
bool hsr_light_sees(const struct hsr_lighting *lighting, uint32_t f, int side,
                    double reach, struct hsr_light_box *box);

/* Returns a bound of the distance, in world units, between a point at which a
 * ray meets face f and the hull of the face's vertices. 0 if f is flat;
 * infinite if no bound was found. */
double hsr_off_hull(const struct hsr_lighting *lighting, uint32_t f);

/* Finds the image of P: returns its side, and sets *box to a box that holds it.
 * -1 if the side is not certain. */
int hsr_light_image(const struct hsr_lighting *lighting,
                    const struct hsr_lit_point *point,
                    struct hsr_light_box *box);

#ifdef __cplusplus
}
#endif
#endif
