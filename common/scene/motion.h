/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is known beforehand of how the instances of a scene move.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.4: a limit of how
 *             far something moves in a frame; a volume that it never leaves; a
 *             way that is determined beforehand.
 * Frame       a whole number. A scene is one of its frames; another is of the
 *             same objects and instances in other places.
 * Promise     what is known is true of every vertex of the instance, as
 *             hsr_instance_vertex places it, in every frame. Who makes a scene
 *             promises that; hsr_scene_follow holds a frame to it. */
#ifndef HSR_COMMON_MOTION_H
#define HSR_COMMON_MOTION_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* At this time, which need not be whole, all vertices are within. Between two
 * keys of a way the corners move on straight lines, at a steady speed. */
struct hsr_key {
  double frame, lo[3], hi[3];
};

/* Of one instance. */
struct hsr_motion {
  double speed; /* no coordinate changes by more from a frame to the next;
                   infinite: that is not known */
  double lo[3], hi[3]; /* always within; infinite: that is not known */
  uint32_t first_key, n_keys;
};

struct hsr_motions {
  long frame;            /* the one that the scene is */
  struct hsr_motion *of; /* instance 0 and so on, as far as any is known */
  struct hsr_key *key;
  uint32_t n, cap, n_keys, cap_keys;
};

/* Nothing is known. */
struct hsr_motion hsr_motion_unknown(void);

/* Says what frame a scene is: 0, if that is never said. HSR_E_NOMEM. */
enum hsr_status hsr_scene_set_frame(struct hsr_scene *scene, long frame);
long hsr_scene_frame(const struct hsr_scene *scene);

/* Says what is known of the last instance that was added, with its way as
 * n_keys keys, in the order of their times; the motion's own numbers of keys
 * mean nothing. HSR_E_NOMEM; HSR_E_INPUT if its object does not move, or the
 * keys are not in order. */
enum hsr_status hsr_scene_set_motion(struct hsr_scene *scene,
                                     const struct hsr_motion *motion,
                                     const struct hsr_key *key,
                                     uint32_t n_keys);
struct hsr_motion hsr_scene_motion(const struct hsr_scene *scene, uint32_t i);

/* Where an instance is from frame `from` to frame `to`, both included. False if
 * its way is not known for all of that time. */
bool hsr_scene_way(const struct hsr_scene *scene, uint32_t i, double from,
                   double to, double lo[3], double hi[3]);

/* Holds a scene, which need not be finished, to what is known of it. HSR_E_INPUT,
 * with *err naming the instance, if a promise is broken in its own frame. */
enum hsr_status hsr_scene_check_motion(const struct hsr_scene *scene,
                                       struct hsr_error *err);

/* Whether objects of the scene move. */
bool hsr_scene_moves(const struct hsr_scene *scene);

/* Whether another scene is of the same objects and instances, wherever these
 * are. */
bool hsr_scene_has_frame(const struct hsr_scene *scene,
                         const struct hsr_scene *then);

/* Whether another scene is of the same objects to the last vertex and colour,
 * wherever its instances are; and whether these are in the same places, too. A
 * grid never is. */
bool hsr_scene_has_objects(const struct hsr_scene *scene,
                           const struct hsr_scene *then);
bool hsr_scene_is_same(const struct hsr_scene *scene,
                       const struct hsr_scene *then);

/* Makes a scene another frame of itself: moves its instances to where they are
 * in `then`. HSR_E_INPUT, with *err naming the instance, if that is another
 * scene, if something was moved that does not move, or if a promise is broken;
 * *scene is then as it was. HSR_E_NOMEM. */
enum hsr_status hsr_scene_follow(struct hsr_scene *scene,
                                 const struct hsr_scene *then,
                                 struct hsr_error *err);

/* For common/scene/scene.c: multiplies all lengths, and frees. NULL is allowed.
 */
void hsr_motions_enlarge(struct hsr_motions *motions, int exponent);
void hsr_motions_free(struct hsr_motions *motions);

#ifdef __cplusplus
}
#endif
#endif
