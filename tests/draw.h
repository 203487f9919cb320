/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures for the tests: a scene, a camera, an algorithm, its ids. */
#ifndef HSR_TESTS_DRAW_H
#define HSR_TESTS_DRAW_H

#include "algorithms/setup.h"
#include "common/scene/scene.h"

#include <stdint.h>

/* A value that no picture holds, for samples that were not written. */
#define UNWRITTEN 0xfefefefeu

#ifdef __cplusplus
extern "C" {
#endif

/* What no test can do without: each ends the test program on failure. A named
 * scene; a scene that is complete; a scene as a world, or as a roster; a view;
 * an algorithm that is set up. */
struct hsr_scene *must_open(const char *name);
void must_finish(struct hsr_scene *scene);
void must_world(struct hsr_world *world, struct hsr_scene *scene);
void must_roster(struct hsr_world *world, struct hsr_scene *scene);
void must_view(struct hsr_view *view, const struct hsr_camera *camera, int m,
               int n);
void must_setup(struct hsr_setup *setup, const struct hsr_algorithm *algorithm,
                const struct hsr_choice *choice, const struct hsr_world *world);

/* Draws the window of `view` into ids (m * n, set to UNWRITTEN first), and adds
 * its counts to *tally unless NULL. Aborts the test program on failure: no test
 * expects one here. */
void draw_ids(const struct hsr_algorithm *algorithm,
              const struct hsr_world *world, const struct hsr_view *view,
              uint32_t *ids, struct hsr_tally *tally);

/* The same by the algorithm of this name, in the build that does not count. */
void draw_plain(const char *name, const struct hsr_world *world,
                const struct hsr_view *view, uint32_t *ids);

/* Draws the picture of `view` into ids (m * n, set to UNWRITTEN first) by a set-up
 * that exists, in square windows of so many samples a side. Of n threads, at most
 * 8, each takes every n-th window. Ends the test program on failure. */
void draw_in_windows(const struct hsr_setup *setup, const struct hsr_view *view,
                     int side, int threads, uint32_t *ids);

/* Draws lines into *drawing, and adds its counts to *tally unless NULL. Aborts
 * the test program on failure. */
void draw_lines(const struct hsr_algorithm *algorithm,
                const struct hsr_world *world, const struct hsr_view *view,
                struct hsr_drawing *drawing, struct hsr_tally *tally);

/* Makes *answer, of any kind, and draws it; adds its counts to *tally unless
 * NULL. False if the algorithm refuses the scene. *answer is to be freed in
 * either case by hsr_answer_free. Any other failure ends the test program. */
bool draw_answer(const struct hsr_algorithm *algorithm,
                 const struct hsr_world *world, const struct hsr_view *view,
                 struct hsr_answer *answer, struct hsr_tally *tally);

/* The same, so chosen; NULL: as is standard. */
bool draw_chosen(const struct hsr_algorithm *algorithm,
                 const struct hsr_choice *choice, const struct hsr_world *world,
                 const struct hsr_view *view, struct hsr_answer *answer,
                 struct hsr_tally *tally);

/* The standard choice for the kind that the algorithm makes besides its own. */
struct hsr_choice choose_also(const struct hsr_algorithm *algorithm,
                              const struct hsr_answer_type *type);

/* How many of the window's samples differ between two answers of one kind. The
 * first of them is told in words, in text[size], if any does. */
long compare_answers(const struct hsr_view *view, const struct hsr_answer *got,
                     const struct hsr_answer *wanted, char *text, size_t size);

/* The number of samples in the window that differ. */
long count_differences(const struct hsr_view *view, const uint32_t *a,
                       const uint32_t *b);

/* The listed algorithms, and after them the variants of proposals.def and some
 * others: each as an algorithm of its own, of the variant's name, whose standard
 * choice is the variant's. Ended by .plain == NULL. */
const struct hsr_listed *all_listed(void);

/* One of these, in the counting build. Ends the test program if there is none.
 */
const struct hsr_algorithm *find_counting(const char *name);

/* Whether an algorithm is among those that a test was asked for by n names. A
 * name without options asks for the variants as well; no name asks for all. */
bool is_asked(const struct hsr_algorithm *algorithm, int n, char **names);

/* The number of an algorithm's counter; and of a run's tally, what it counted.
 * End the test program if there is none of this name. */
int counter_of(const struct hsr_algorithm *algorithm, const char *name);
uint64_t counted(const struct hsr_algorithm *algorithm,
                 const struct hsr_tally *tally, const char *name);

/* A named scene, both laid out as a world and as a roster. Opening aborts the
 * test program on failure. */
struct both_worlds {
  struct hsr_scene *scene;
  struct hsr_world world, roster;
};
void open_worlds(struct both_worlds *worlds, const char *name);
void close_worlds(struct both_worlds *worlds);

/* A random number in [lo, hi]; advances the seed. */
int64_t draw_integer(uint64_t *seed, int64_t lo, int64_t hi);

/* One camera of two becomes a parallel one, for a picture of n rows: along an
 * axis, isometric or dimetric, at a corner of the lattice of whole numbers, and
 * so high that samples lie on that lattice, or on halves and quarters of it. */
void draw_parallel(uint64_t *seed, struct hsr_camera *camera, int n);

/* One view of four is jittered, and one of four becomes a part of its picture.
 */
void draw_part(uint64_t *seed, struct hsr_view *view);

/* Runs `check` for every algorithm that takes faces and must be right, in both
 * builds: for those that draw pictures and for those that draw lines. */
void for_each_judged(void (*check)(const struct hsr_algorithm *, void *),
                     void *context);
void for_each_line_algorithm(void (*check)(const struct hsr_algorithm *,
                                           void *),
                             void *context);

#ifdef __cplusplus
}
#endif
#endif
