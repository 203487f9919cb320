/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is known in advance of how the instances of a scene move.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, section 3.4: a limit
 *             of the motion per frame; a volume that the object never leaves; a
 *             path that is known in advance.
 * Frame       a whole number. A scene describes one frame. Another frame is a
 *             scene of the same objects and instances in other places.
 * Way         the path of an instance: a box that moves. It is given by keys.
 * Promise     a limit, a volume or a way holds for every vertex of the
 *             instance, as placed by hsr_instance_vertex, in every frame. The
 *             maker of a scene promises that. hsr_scene_follow checks it. */
#ifndef HSR_COMMON_MOTION_H
#define HSR_COMMON_MOTION_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One key of a way: at the time `frame`, which need not be whole, all vertices
 * of the instance are in the box lo .. hi. Between two keys, the corners of the
 * box move on straight lines at a constant speed. World units. */
struct hsr_key {
  double frame, lo[3], hi[3];
};

/* What is known of one instance. World units. */
struct hsr_motion {
  double speed; /* no coordinate of a vertex changes by more than this from one
                   frame to the next; infinite: unknown */
  double lo[3], hi[3]; /* no vertex ever leaves this box; infinite: unknown */
  uint32_t first_key, n_keys; /* the way, in hsr_motions.key; n_keys is 0 if it
                                 is unknown */
};

/* What is known of a scene's instances. The scene owns it. */
struct hsr_motions {
  long frame;            /* the frame that the scene describes */
  struct hsr_motion *of; /* of instances 0 .. n - 1; nothing is known of later
                            ones */
  struct hsr_key *key;   /* n_keys, the ways one after another */
  uint32_t n, cap, n_keys, cap_keys; /* cap: room, for the builder */
};

/* Returns the motion of an instance of which nothing is known. */
struct hsr_motion hsr_motion_unknown(void);

/* Sets the frame that a scene describes. It is 0 if it is never set.
 * HSR_E_NOMEM. */
enum hsr_status hsr_scene_set_frame(struct hsr_scene *scene, long frame);

/* Returns the frame that a scene describes. */
long hsr_scene_frame(const struct hsr_scene *scene);

/* Sets what is known of the last instance that was added. Its way is key[0 ..
 * n_keys - 1], in ascending order of `frame`, which is copied; the members
 * first_key and n_keys of *motion are ignored. `key` may be NULL if n_keys is
 * 0. HSR_E_NOMEM; HSR_E_INPUT if there is no instance, its object does not
 * move, or the keys are not in order. */
enum hsr_status hsr_scene_set_motion(struct hsr_scene *scene,
                                     const struct hsr_motion *motion,
                                     const struct hsr_key *key,
                                     uint32_t n_keys);

/* Returns what is known of instance i, perhaps nothing. */
struct hsr_motion hsr_scene_motion(const struct hsr_scene *scene, uint32_t i);

/* Finds the box lo .. hi that holds instance i at all times from `from` to
 * `to`, both included, by its way. False if the way does not cover that time;
 * lo and hi are then not written. */
bool hsr_scene_way(const struct hsr_scene *scene, uint32_t i, double from,
                   double to, double lo[3], double hi[3]);

/* Checks the promises of a scene in its own frame. The scene need not be
 * finished. HSR_E_INPUT, with *err naming the instance, if a promise is broken.
 */
enum hsr_status hsr_scene_check_motion(const struct hsr_scene *scene,
                                       struct hsr_error *err);

/* Whether objects of the scene move. */
bool hsr_scene_moves(const struct hsr_scene *scene);

/* Whether `then` may be another frame of the scene: both have the same number
 * of objects, of faces and of vertices in each, and the same instances of them,
 * in any places. */
bool hsr_scene_has_frame(const struct hsr_scene *scene,
                         const struct hsr_scene *then);

/* Whether both scenes have equal objects, to the last vertex and colour, and
 * the same instances of them, in any places. False if either scene is a
 * grid. */
bool hsr_scene_has_objects(const struct hsr_scene *scene,
                           const struct hsr_scene *then);

/* Whether also the instances are in equal places. */
bool hsr_scene_is_same(const struct hsr_scene *scene,
                       const struct hsr_scene *then);

/* Makes a scene another frame of itself: moves its instances to their places in
 * `then` and takes its frame. HSR_E_INPUT if hsr_scene_has_frame is false, or,
 * with *err naming the instance, if an object moved that does not move or a
 * promise is broken; *scene is then as it was. HSR_E_NOMEM. */
enum hsr_status hsr_scene_follow(struct hsr_scene *scene,
                                 const struct hsr_scene *then,
                                 struct hsr_error *err);

/* For common/scene/scene.c: multiplies all lengths by 2^exponent. NULL is
 * allowed. */
void hsr_motions_enlarge(struct hsr_motions *motions, int exponent);

/* For common/scene/scene.c: frees *motions and its arrays. NULL is allowed. */
void hsr_motions_free(struct hsr_motions *motions);

#ifdef __cplusplus
}
#endif
#endif
