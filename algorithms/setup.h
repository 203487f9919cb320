/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A setup: an algorithm made ready for one world. The world has been adapted to
 * the algorithm's restrictions, and the algorithm's view-independent work has
 * been done. Every program that runs an algorithm runs it through a setup. */
#ifndef HSR_ALGORITHMS_SETUP_H
#define HSR_ALGORITHMS_SETUP_H

#include "algorithms/algorithm.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_MAX_ADAPTATIONS 8

/* A step of the adaptation that changed something. */
struct hsr_adaptation {
  const char *name; /* of the adapter; static */
  uint32_t n_faces; /* of the world after it */
  double seconds;   /* that it took */
};

struct hsr_setup {
  const struct hsr_algorithm *algorithm;
  struct hsr_choice choice;      /* of its options */
  unsigned flags;                /* of the algorithm so chosen */
  const struct hsr_world *world; /* what the algorithm gets: the given world,
                                    borrowed, or `adapted` */
  struct hsr_world adapted;
  struct hsr_adaptation adaptation[HSR_MAX_ADAPTATIONS];
  int n_adaptations;
  double
      adapt_seconds; /* of all adapters, also of those that changed nothing */
  struct hsr_kept_priorities *kept; /* by an adapter, if the algorithm follows;
                                       else NULL */
  void *prepared;      /* what the algorithm's prepare made, or NULL */
  uint32_t n_prepared; /* faces of the world for which it was made */
  double prepare_seconds;

  /* Set by the caller, or NULL: for jobs whose own `passes` is NULL.
   * Borrowed. */
  const struct hsr_passes *passes;
};

/* Opens the world of a scene in the form that suits an algorithm best: laid
 * out, or a roster. If the scene is a grid and the algorithm takes grids, it is
 * a roster without faces. `choice` is NULL for the standard one. Owner and
 * errors as of hsr_world_open. */
enum hsr_status hsr_setup_world(struct hsr_world *world,
                                const struct hsr_algorithm *algorithm,
                                const struct hsr_choice *choice,
                                struct hsr_scene *scene, struct hsr_error *err);

/* Makes an algorithm, so chosen, ready for a world. `choice` is NULL for the
 * standard one. `world` is borrowed and outlives the setup. *setup is freed
 * with hsr_setup_free, also after a failure. HSR_E_NOMEM. HSR_E_REFUSED if the
 * algorithm does not take the scene's subject; if the scene breaks a
 * restriction and cannot be adapted; if the world is a roster and the algorithm
 * needs it laid out; or as the algorithm's own prepare. */
enum hsr_status hsr_setup_init(struct hsr_setup *setup,
                               const struct hsr_algorithm *algorithm,
                               const struct hsr_choice *choice,
                               const struct hsr_world *world,
                               struct hsr_error *err);

/* Replaces the algorithm by its other build. The adapted world is kept; what is
 * prepared is made anew. Fails as hsr_setup_init, and is freed as before. */
enum hsr_status hsr_setup_rebuild(struct hsr_setup *setup,
                                  const struct hsr_algorithm *build,
                                  struct hsr_error *err);

/* Goes on to another frame of the scene: `world` takes the place of the last
 * world, which may be gone by now. What is prepared is kept if the algorithm
 * follows (HSR_FOLLOWS) and there are as many faces as before; otherwise all is
 * made anew. The world is adapted anew, with what the adapters keep of the last
 * frames. *kept says which. Fails as hsr_setup_init, and is freed as
 * before. */
enum hsr_status hsr_setup_follow(struct hsr_setup *setup,
                                 const struct hsr_world *world, bool *kept,
                                 struct hsr_error *err);

/* Renders job->view into job->answer. The job's world, prepared object and
 * options are set here; all else is the caller's. Ids that the algorithm has
 * written for faces of an adapted world become those of the scene's faces. The
 * algorithm itself uses the scene's names for the edges of a drawing and for
 * the faces that it filters. HSR_E_NOMEM. */
enum hsr_status hsr_setup_render(const struct hsr_setup *setup,
                                 struct hsr_job *job, struct hsr_error *err);

/* What the algorithm has prepared, for those who show it. */
struct hsr_shown hsr_setup_show(const struct hsr_setup *setup);

/* Frees what the setup owns; the setup itself is the caller's. */
void hsr_setup_free(struct hsr_setup *setup);

#ifdef __cplusplus
}
#endif
#endif
