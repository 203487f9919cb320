/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An algorithm made ready for one world: the world adapted to its restrictions,
 * and its own view-independent work done. Whoever runs an algorithm, runs it
 * through this. */
#ifndef HSR_ALGORITHMS_SETUP_H
#define HSR_ALGORITHMS_SETUP_H

#include "algorithms/algorithm.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_MAX_ADAPTATIONS 8

struct hsr_adaptation {
  const char *name; /* of the adapter */
  uint32_t n_faces; /* after it */
  double seconds;
};

struct hsr_setup {
  const struct hsr_algorithm *algorithm;
  struct hsr_choice choice;      /* of its options */
  unsigned flags;                /* of the algorithm so chosen */
  const struct hsr_world *world; /* what the algorithm gets: the scene's own, or
                                    `adapted` */
  struct hsr_world adapted;
  struct hsr_adaptation adaptation[HSR_MAX_ADAPTATIONS];
  int n_adaptations;    /* those that changed something */
  double adapt_seconds; /* of all, also where there was nothing to change */
  void *prepared;
  uint32_t n_prepared; /* faces of the world that it was prepared for */
  double prepare_seconds;
  const struct hsr_passes
      *passes; /* for jobs that have none; NULL unless set */
};

/* Opens the world of a scene as this algorithm takes it best: laid out, or an
 * roster, which of a grid that it takes has no faces. `choice` is NULL for the
 * standard one. As hsr_world_open. */
enum hsr_status hsr_setup_world(struct hsr_world *world,
                                const struct hsr_algorithm *algorithm,
                                const struct hsr_choice *choice,
                                struct hsr_scene *scene, struct hsr_error *err);

/* `choice` is NULL for the standard one. `world` is borrowed and outlives the
 * setup. Freed with hsr_setup_free, also after a failure: HSR_E_NOMEM;
 * HSR_E_REFUSED where the scene is of a subject that the algorithm does not
 * take, or breaks a restriction and cannot be adapted, or is a roster and the
 * algorithm needs it laid out. */
enum hsr_status hsr_setup_init(struct hsr_setup *setup,
                               const struct hsr_algorithm *algorithm,
                               const struct hsr_choice *choice,
                               const struct hsr_world *world,
                               struct hsr_error *err);

/* Goes on with another build of the same algorithm, as hsr_setup_init would begin
 * with it. The adapted world is kept; all else is prepared anew. Fails as
 * hsr_setup_init, and is freed as before. */
enum hsr_status hsr_setup_rebuild(struct hsr_setup *setup,
                                  const struct hsr_algorithm *build,
                                  struct hsr_error *err);

/* Goes on to another frame of the scene, whose world takes the place of the last
 * one, which need not be there any more. What is prepared is kept, and *kept
 * says so, if the algorithm follows (HSR_FOLLOWS) and there are as many faces as
 * before; else all is prepared anew. Fails as hsr_setup_init, and is freed as
 * before. */
enum hsr_status hsr_setup_follow(struct hsr_setup *setup,
                                 const struct hsr_world *world, bool *kept,
                                 struct hsr_error *err);

/* Renders job->view. The job's world, prepared object and options are
 * set here. Ids are those of the
 * scene's faces; the edges of a drawing, and the faces that it filters, the
 * algorithm names by itself. HSR_E_NOMEM. */
enum hsr_status hsr_setup_render(const struct hsr_setup *setup,
                                 struct hsr_job *job, struct hsr_error *err);

void hsr_setup_free(struct hsr_setup *setup);

#ifdef __cplusplus
}
#endif
#endif
