/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of the library. */
#ifndef HSR_BENCH_LIBRARY_H
#define HSR_BENCH_LIBRARY_H

#include "algorithms/setup.h"
#include "bench/library/within.h"
#include "bench/modules/variant.h"

#include <pthread.h>
#include <stdatomic.h>

/* --- Structs that cross the border (structs.c) ---------------------------- */

/* Copies a struct of the caller's, whose first member is its size, to *to,
 * which has `known` bytes. If `from` is NULL, *to becomes all 0. HSR_E_USAGE if
 * it is too small, or has more than is known. `what` names it in the error. */
enum hsr_status lib_take(const char *what, void *to, size_t known,
                         const void *from, struct hsr_error *err);

/* Fills a struct of the caller's with *from, which has `known` bytes, but for
 * its first member. HSR_E_USAGE if `to` is NULL or too small. */
enum hsr_status lib_give(const char *what, void *to, size_t known,
                         const void *from, struct hsr_error *err);

/* HSR_E_USAGE: "WHAT is NULL". */
enum hsr_status lib_null(const char *what, struct hsr_error *err);

/* --- Scenes (scenes.c) ---------------------------------------------------- */

/* The arrays of struct hsr_geometry that the world has in another form. */
struct lib_geometry {
  double *xyz;
  uint32_t *ring;
  float *rgb, *opacity;
  uint8_t *one_sided;
  const char **object_name;
};

/* A scene, and its worlds, made when they are first needed. Who reads the scene
 * or a world holds the lock for reading; who makes a world, or the faces of a
 * grid, holds it for writing. */
struct lib_scene {
  struct hsr_scene *scene;
  atomic_long users; /* the handle, and each answer */
  pthread_rwlock_t lock;
  struct hsr_world laid_out, roster;
  bool has_laid_out, has_roster;
  struct lib_geometry geometry; /* of laid_out; NULL: not made yet */
  uint64_t n_dropped;
  char notes[1000];
};

/* A handle without a scene, which hsr_close frees. NULL for lack of memory. */
struct lib_scene *lib_scene_new(void);

/* The options of opening, checked. HSR_E_USAGE. */
enum hsr_status lib_open_options(const struct hsr_open_options *from,
                                 struct hsr_open_options *options,
                                 struct hsr_error *err);

/* One more user. */
struct lib_scene *lib_scene_share(const struct lib_scene *scene);

/* Sets *world to the one that suits an algorithm, as hsr_setup_world makes it.
 * It is the scene's. The caller does not hold the lock. Errors as
 * hsr_setup_world. */
enum hsr_status lib_scene_world(struct lib_scene *scene,
                                const struct hsr_algorithm *algorithm,
                                const struct hsr_choice *choice,
                                const struct hsr_world **world,
                                struct hsr_error *err);

/* Frees the arrays of a scene's geometry (geometry.c). */
void lib_geometry_free(struct lib_geometry *geometry);

/* Begins and ends reading. */
void lib_scene_read(struct lib_scene *scene);
void lib_scene_leave(struct lib_scene *scene);

/* --- Algorithms that are ready (ready.c) ---------------------------------- */

/* An algorithm, chosen for a scene, and made ready for it. A drawer and its
 * answers share it. */
struct lib_ready {
  atomic_long users;
  struct lib_scene *scene; /* shared */
  struct hsr_variant variant;
  bool counts;
  long threads;                  /* that draw */
  const struct hsr_world *world; /* the scene's */
  struct hsr_setup setup;        /* its algorithm is NULL until it is ready */
};

/* Chooses the algorithm that a request names. HSR_E_USAGE, HSR_E_NOMEM. */
enum hsr_status lib_ready_new(const struct lib_scene *scene,
                              const struct hsr_request *request,
                              struct lib_ready **ready, struct hsr_error *err);

/* Makes it ready, once. Errors as hsr_setup_world and hsr_setup_init. */
enum hsr_status lib_ready_prepare(struct lib_ready *ready,
                                  struct hsr_error *err);

/* One user more, and one fewer; the last one frees it. NULL is allowed. */
struct lib_ready *lib_ready_share(struct lib_ready *ready);
void lib_ready_free(struct lib_ready *ready);

/* --- Answers (draw.c) ----------------------------------------------------- */

/* Takes a request to draw a scene, which must not be NULL. HSR_E_USAGE if there
 * is no algorithm, or threads are out of range. */
enum hsr_status lib_take_request(const struct lib_scene *scene,
                                 const struct hsr_request *from,
                                 struct hsr_request *request,
                                 struct hsr_error *err);

/* Makes an answer in which nothing is drawn, for the view of a request. Errors
 * as hsr_draw. *answer may be not NULL also after a failure. */
enum hsr_status lib_answer_begin(struct lib_ready *ready,
                                 const struct hsr_request *request,
                                 struct lib_answer **answer,
                                 struct hsr_error *err);

/* Sets the view of an answer to that of a request. Errors as hsr_draw. */
enum hsr_status lib_answer_aim(struct lib_answer *answer,
                               const struct hsr_request *request,
                               struct hsr_error *err);

/* Draws it by a crew, when answer->ready is. Errors as hsr_draw. */
struct crew;
enum hsr_status lib_answer_draw(struct lib_answer *answer, struct crew *crew,
                                const struct hsr_request *request,
                                struct hsr_error *err);

/* The arrays of struct hsr_polygon_arrays. */
struct lib_polygons {
  uint32_t *face;
  size_t *cycle, *point;
  double *xy;
};

struct lib_answer {
  struct lib_scene *scene; /* shared */
  const struct hsr_world *world;
  struct hsr_variant variant;
  struct lib_ready *ready; /* shared; NULL: it is needed no more */
  struct hsr_view view;
  bool is_own_view; /* of the scene, number `number` */
  uint32_t number;
  struct hsr_answer answer;
  struct hsr_tally tally;
  float *work; /* by sample; NULL: it was not asked for */
  bool counts;
  char adapted[200];
  double adapt_seconds, prepare_seconds, draw_seconds;
  struct lib_polygons polygons;
};

/* Sets the view that a request asks for, for a kind of answer. Errors as
 * hsr_draw. */
enum hsr_status lib_view(const struct lib_scene *scene,
                         const struct hsr_request *request,
                         const struct hsr_answer_type *type,
                         struct hsr_view *view, struct hsr_error *err);

/* Whether an algorithm, so chosen, has steps to tell of. HSR_E_USAGE. */
enum hsr_status lib_check_trace(const struct hsr_variant *variant,
                                struct hsr_error *err);

/* Whether an algorithm, so chosen, draws samples in one picture, each of which
 * can be told how much work it took. HSR_E_USAGE. */
enum hsr_status lib_check_work(const struct hsr_variant *variant,
                               struct hsr_error *err);

/* Fills the arrays of an answer of polygons anew (polygons.c). HSR_E_NOMEM. */
enum hsr_status lib_polygons_make(struct lib_answer *answer,
                                  struct hsr_error *err);
void lib_polygons_free(struct lib_polygons *polygons);

/* --- Showing (write.c) ---------------------------------------------------- */

/* How an answer is shown. */
struct hsr_showing lib_showing(const struct lib_answer *answer,
                               enum hsr_shading_choice shading);

/* The texts that go into a file. */
struct lib_texts {
  char text[300], title[200], description[600];
};

/* Makes the texts for a view of a scene, from 1, or 0 if it is none of its own,
 * and sets them in *showing. */
void lib_set_texts(struct hsr_showing *showing, struct lib_texts *texts,
                   long view, const struct hsr_algorithm *algorithm);

/* Whether the kind of the answer takes account of a setting, HSR_SHADING and so
 * on. HSR_E_USAGE with `what` if not. */
enum hsr_status lib_takes(const struct lib_answer *answer, int setting,
                          const char *what, struct hsr_error *err);

#endif
