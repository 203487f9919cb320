/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a face keeps of the light of a view: exact answers, by the definition of
 * docs/shadow-picture.md, in whose notation this is.
 *
 * Source      A. Appel, "Some techniques for shading machine renderings of
 *             solids", AFIPS SJCC 1968: a visible point is in shadow if another
 *             face lies between it and the light.
 * Exact       every question is first put to interval arithmetic, about rounded
 *             planes and exact vertices; where that leaves a sign open, exact
 *             numbers decide, and tally->exact counts that.
 * Faces       those of a world that is not of pieces. */
#ifndef HSR_COMMON_EXACT_SHADOW_H
#define HSR_COMMON_EXACT_SHADOW_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The light of a screen's view. */
struct hsr_lighting {
  const struct hsr_screen *screen; /* borrowed */
  const double *light;             /* the view's L */
  signed char *side; /* a face: the sign of its plane's height at L */
};

/* Finds the sides of all faces. Memory is taken from the arena; `screen` is
 * borrowed and outlives *lighting. HSR_E_NOMEM. */
enum hsr_status hsr_lighting_init(struct hsr_lighting *lighting,
                                  const struct hsr_screen *screen,
                                  struct hsr_arena *arena,
                                  struct hsr_tally *tally);

/* Whether the light shines on the side of face f that the eye sees. f exists.
 */
bool hsr_faces_light(const struct hsr_lighting *lighting, uint32_t f,
                     struct hsr_tally *tally);

/* Whether face g may block the light from anything: it is there for the light,
 * and not in its plane. */
static inline bool hsr_may_block(const struct hsr_lighting *lighting,
                                 uint32_t g) {
  bool one_sided = lighting->screen->world->mesh.one_sided[g];
  return lighting->side[g] > 0 || (lighting->side[g] < 0 && !one_sided);
}

/* What is seen of face f at a sample: the point P. */
struct hsr_lit_point {
  uint32_t face;
  double sx, sy;
  double low[3], high[3]; /* P undisplaced lies between these; they are not
                             finite where that cannot be told */
  /* The row of the light ray (docs/shadow-picture.md): row(v) is the product of
   * row and v - from, whose components are off by no more than these. They are
   * not finite where that cannot be told. */
  double row[3], row_error, from[3], from_error;
};

/* f is the visible face of sample (i, j). */
void hsr_lit_point_find(const struct hsr_lighting *lighting, uint32_t f, int i,
                        int j, struct hsr_lit_point *point);

/* Whether face g, for which hsr_may_block holds, blocks the light from P. */
bool hsr_blocks(const struct hsr_lighting *lighting,
                const struct hsr_lit_point *point, uint32_t g,
                struct hsr_tally *tally);

/* Balls about faces, side by side in memory: face k's corners are within r[k] of
 * (x[k], y[k], z[k]). */
struct hsr_light_balls {
  float *x, *y, *z, *r;
};

/* Makes the balls of n faces. Memory is taken from the arena. HSR_E_NOMEM. */
enum hsr_status hsr_light_balls_make(struct hsr_light_balls *balls,
                                     const struct hsr_world *world,
                                     const uint32_t *face, uint32_t n,
                                     struct hsr_arena *arena);

/* Sets beside[i] to 1 if ball k + i is certainly to one side of the light ray's
 * row, else to 0, for n balls. Such a face does not block the light from P. */
void hsr_light_balls_beside(const struct hsr_light_balls *balls,
                            const struct hsr_lit_point *point, uint32_t k,
                            uint32_t n, uint8_t *beside);

/* Whether face g may block the light from any point of face f, by their planes:
 * a part of g lies before f as the light sees it, and a part of f behind g. f
 * faces the light, and hsr_may_block holds for g. A face that is not flat is
 * given the benefit of the doubt. */
bool hsr_may_shade(const struct hsr_lighting *lighting, uint32_t g, uint32_t f,
                   struct hsr_tally *tally);

/* --- The light's picture -------------------------------------------------- */

/* The picture in which the light sees the scene: of a sun, one, on a plane
 * across an axis; of a light, six, the sides of a cube about it, each from
 * -1 to 1. */
enum { HSR_LIGHT_SIDES = 6 };
int hsr_light_sides(const struct hsr_lighting *lighting);

/* A box in such a picture. Its bounds may be infinite. */
struct hsr_light_box {
  double low[2], high[2];
};

/* A box that holds the part of face f that the light sees on this side. False
 * if it sees none there. If f blocks the light from a point P, then the image
 * of P is in the box of its side. `reach` widens the face by so much in every
 * direction, in world units; 0 for blockers. */
bool hsr_light_sees(const struct hsr_lighting *lighting, uint32_t f, int side,
                    double reach, struct hsr_light_box *box);

/* How far what is seen of face f may be from the hull of its vertices, in world
 * units: 0 if f is flat; infinite if that cannot be told. */
double hsr_off_hull(const struct hsr_lighting *lighting, uint32_t f);

/* The image of P: the side, and a box that holds it. -1 if it cannot be told.
 */
int hsr_light_image(const struct hsr_lighting *lighting,
                    const struct hsr_lit_point *point,
                    struct hsr_light_box *box);

#ifdef __cplusplus
}
#endif
#endif
