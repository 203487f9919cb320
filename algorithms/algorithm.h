/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contract that every hidden-surface algorithm meets.
 *
 * An algorithm is one `const struct hsr_algorithm`, defined at the foot of its
 * own file and named in list.def. It gets a world and a view and answers with
 * one face id a sample, or with a line drawing. It never prints, exits, or
 * keeps an epsilon of its own: what it compares, it compares by the services of
 * common/exact/screen.h, which are exact.
 *
 * Every algorithm is compiled twice, with HSR_COUNTING 0 and 1. Only the
 * counting one counts and traces; only the other one is ever timed. */
#ifndef HSR_ALGORITHMS_ALGORITHM_H
#define HSR_ALGORITHMS_ALGORITHM_H

#include "algorithms/part.h"
#include "common/adapt/adapt.h"
#include "common/base/arena.h"
#include "common/base/count.h"
#include "common/lines/drawing.h"
#include "common/answers/kinds/ids.h"
#include "common/statistics/statistics.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The branches of figure 13 of Sutherland et al. 1974, and four beside it. */
enum hsr_branch {
  HSR_OBJECT_SPACE_VOLUMES,    /* edges against volumes */
  HSR_OBJECT_SPACE_EDGES,      /* edges against edges */
  HSR_LIST_PRIORITY_FIXED,     /* priority a priori, for all frames */
  HSR_LIST_PRIORITY_PER_FRAME, /* priority anew in each frame */
  HSR_IMAGE_SPACE_AREA,        /* area sampling */
  HSR_IMAGE_SPACE_POINT,       /* point sampling, along scan lines */
  HSR_BRUTE_FORCE,             /* the paper's two yardsticks */
  HSR_HIERARCHICAL, /* a z-buffer behind a hierarchy of the scene's volumes */
  HSR_VOLUME_SPACE, /* voxels */
  HSR_YARDSTICK     /* no algorithm of the field: the oracle, null */
};

/* Flags. */
enum {
  HSR_JUDGE = 1 << 0,       /* the oracle: defines what is right */
  HSR_NO_PICTURE = 1 << 1,  /* draws nothing; never compared */
  HSR_FRAME_STATE = 1 << 2, /* one render at a time on a prepared object */
  HSR_KNOWN_WRONG = 1 << 3, /* its picture is wrong sometimes, and shown so */
  HSR_INSTANCED = 1 << 5,   /* takes a world that is a roster, too */
  HSR_FOLLOWS =
      1 << 8, /* with HSR_FRAME_STATE, unless it prepares nothing: what
                           it has prepared goes on in another frame of a scene
                           that is laid out. It holds numbers of faces, and
                           nothing of where they are. Adapters keep what they
                           can, too */
  HSR_RATHER_LAID_OUT = 1 << 7, /* with HSR_INSTANCED: takes a roster only if
                                  instances are apart (algorithms/image_space/area/tiling/grove.h) */
  HSR_OWN_TILES = 1 << 9, /* divides a window into tiles itself, and draws these
                             on the threads that the job allows */
  HSR_LAID_OUT_UNLESS_LARGE = 1 << 10, /* with HSR_INSTANCED: goes through all
                      faces. To save memory it takes a roster of HSR_LARGE to
                      HSR_MOST_LAID_OUT faces, for its own kind of answer */
  HSR_NEEDS_LAID_OUT =
      1 << 11 /* of what is chosen: takes no roster after all */
};

/* A kind of answer that an algorithm makes. */
struct hsr_made {
  const struct hsr_answer_type *kind;
  unsigned
      words;    /* those that it makes of the kind's first option: 1 << HSR_OVER
                     ...; the first of them is standard. 0: all */
  unsigned how; /* HSR_VISIBLE_ONLY, HSR_SUMS */
};
enum {
  HSR_VISIBLE_ONLY = 1 << 0, /* of segments: all invisibility over 0 is 1 */
  HSR_SUMS = 1 << 1 /* it adds to the sums of an answer that has them */
};

struct hsr_box; /* common/trees/box.h */

/* Takes a box of the world, perhaps an infinite one: that which steps name as
 * HSR_CELL(a, b, 0). */
typedef void hsr_take_box(void *to, uint32_t a, uint32_t b,
                          const struct hsr_box *box);

/* What an algorithm has prepared, for those who show it. Each is the prepared
 * object's own; NULL: there is none. */
struct hsr_shown {
  const struct hsr_octree *octree; /* common/trees/octree.h. Its nodes are the
                                      subjects HSR_CELL(node, HSR_NO_ID, 0) */
  const struct hsr_cubes *cubes;   /* algorithms/engines/cubes/cubes.h. Likewise
                                      HSR_CELL(node, instance, 0) */
  const struct hsr_bsp *bsp;       /* common/trees/bsp.h */
  const struct hsr_grove
      *grove; /* algorithms/image_space/area/tiling/grove.h */
  /* Gives all its boxes of a scene. */
  void (*boxes)(const void *prepared, const struct hsr_scene *scene,
                hsr_take_box *put, void *to);
};

/* What the numbers of the volumes and the cells mean that an algorithm's steps
 * name, where `show` does not tell it. */
enum hsr_numbered {
  HSR_NUMBERED_OWN,     /* it numbers them in its own way, or names none */
  HSR_NUMBERED_VOLUMES, /* volumes, and bodies: common/lines/volumes.h */
  HSR_NUMBERED_SOLIDS,  /* volumes: bodies of these, from 1 */
  HSR_NUMBERED_TEXELS,  /* cells: level, column and row of a texture */
  HSR_NUMBERED_ENTRIES, /* likewise, of a table of sums over a texture */
  HSR_NUMBERED_SQUARES /* cells: level, column and row of squares in the picture.
                           Those of level HSR_SQUARES_OF_PIXELS are pixels, and those of
                           the level before are half as wide */
};
enum { HSR_SQUARES_OF_PIXELS = 20 };

/* The parts in which an algorithm visits the cells of a grid, one after the other. */
enum hsr_grid_parts {
  HSR_GRID_WHOLE,   /* none */
  HSR_GRID_SLICES,  /* across the axis of the outermost loop */
  HSR_GRID_OCTANTS, /* divided at the eye's cell along each axis: HSR_PBTF */
  HSR_GRID_TURNS,   /* none: both sides of the eye take turns */
  HSR_GRID_CHILDREN /* of the root of an octree: HSR_OCTREE */
};

/* What was chosen of an algorithm. */
struct hsr_choice {
  struct hsr_values values; /* of its own options */
  long window; /* samples a side of the squares in which the picture is drawn;
                  0: as it suits the harness */
  struct hsr_form form; /* of the answer: the algorithm's own kind, or one that
                           is folded from it */
};

/* Who looks at an answer while it becomes better. The answer is borrowed for
 * the call; passes count from 0. */
struct hsr_passes {
  void (*show)(void *whom, const struct hsr_answer *answer, int pass);
  void *whom;
};

/* Who watches a job whose algorithm has HSR_OWN_TILES. One thread calls `tell`
 * now and then, with the share of the window that is drawn, from 0 to 1. If it
 * returns false, render returns HSR_E_STOPPED. */
struct hsr_watch {
  bool (*tell)(void *whom, double share);
  void *whom;
};

/* One picture to make. Everything is borrowed for the call. */
struct hsr_job {
  const struct hsr_world *world;
  const struct hsr_view *view; /* its window says which samples */
  void *prepared;              /* what prepare made, or NULL */
  const long *option;          /* what was chosen, an option of the algorithm */
  const double *real;          /* the same, of options that are real */
  struct hsr_arena *scratch;   /* reset before the call; no other memory is
                                  taken inside a frame */
  struct hsr_tally *tally;     /* what was counted is added here */

  /* What the algorithm is to make: an answer to the whole picture, of which it
   * writes the window. Of kinds that have ids it writes all of these in the window,
   * HSR_BACKGROUND where there is no face, and touches no others. A kind that is
   * not made by windows is empty before the call, as its `make` and `clear` leave
   * it. */
  struct hsr_answer *answer;

  /* For algorithms that draw in passes: to be called after each. Or NULL. */
  const struct hsr_passes *passes;

  /* For algorithms with HSR_OWN_TILES. */
  int threads;                   /* that it may use; below 1: one */
  int tile;                      /* pixels a side; 0: as suits it */
  const struct hsr_watch *watch; /* or NULL */
};

/* Row j of the ids that a job asks for, from column 0 on. */
static inline uint32_t *hsr_job_row(const struct hsr_job *job, int j) {
  return job->answer->ids + (size_t)j * (size_t)job->answer->m;
}

/* Writes the background to all ids of the job's window, if it asks for ids. */
static inline void hsr_job_clear(const struct hsr_job *job) {
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; job->answer->ids && j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      hsr_job_row(job, j)[i] = HSR_BACKGROUND;
}

#define HSR_MOST_MADE 3
struct hsr_algorithm {
  const char *name;    /* [a-z0-9-]+, "watkins" */
  const char *title;   /* "Watkins' scan-line algorithm" */
  const char *authors; /* "G. S. Watkins" */
  int year;            /* of publication; 0: never published */
  const char *source;  /* where it is published, and where described */

  enum hsr_branch taxonomy;
  const char *sort_order; /* "YXZ"; NULL if it has none */
  const char *coherence;  /* what it bets on; NULL if nothing */
  unsigned
      restrictions; /* HSR_CC ... (common/adapt/adapt.h): the world that prepare
                             and render get is adapted to these */
  unsigned lifted;  /* those of the paper's that this module does not have */
  unsigned subjects; /* what it takes: 1 << HSR_FACES, 1 << HSR_GRID. What takes
                        faces draws a grid by the faces of its cells */
  /* What it makes, ended by .kind == NULL: first its own kind; then those that it
   * makes if it is asked for them by an option of theirs. */
  struct hsr_made makes[HSR_MOST_MADE + 1];
  unsigned flags;

  /* What it counts and how: the parts that it uses, and its own. Each array is
   * ended by an empty one; NULL: none. In a registered algorithm the parts' are
   * put before its own, and `base` says where each part's counters begin. */
  const struct hsr_use *parts;
  const struct hsr_counter *counters;
  const struct hsr_step *steps;
  const struct hsr_sort *sorts;
  const struct hsr_line *outline;
  uint8_t base[HSR_MOST_PARTS];
  const struct hsr_option *options; /* ended by .name == NULL; NULL: none */

  /* About how many elementary comparisons a view takes, by which a harness
   * refuses what would take too long; NULL: it grows no faster than the faces
   * and the samples. */
  double (*expense)(const struct hsr_world *world, const struct hsr_view *view);

  /* View-independent work, timed apart; NULL if there is none. `option` is what
   * was chosen; *prepared is freed by release. HSR_E_NOMEM. */
  enum hsr_status (*prepare)(const struct hsr_world *world, const long *option,
                             void **prepared, struct hsr_error *err);

  /* One view. May be called on several threads at once, with different jobs
   * and one prepared object, unless HSR_FRAME_STATE. HSR_E_NOMEM. */
  enum hsr_status (*render)(const struct hsr_job *job, struct hsr_error *err);

  void (*release)(void *prepared); /* NULL if prepare is */

  /* Says what a prepared object holds. *shown is empty before. NULL: nothing to
   * show. */
  void (*show)(const void *prepared, struct hsr_shown *shown);

  /* For those who show its steps. */
  enum hsr_numbered numbered;
  enum hsr_grid_parts grid_parts;
};

/* The standard choice; and the flags of an algorithm so chosen. */
struct hsr_choice hsr_choice_standard(const struct hsr_algorithm *algorithm);
unsigned hsr_choice_flags(const struct hsr_algorithm *algorithm,
                          const struct hsr_choice *choice);

/* Whether an algorithm, so chosen, takes a roster. */
bool hsr_choice_takes_roster(const struct hsr_algorithm *algorithm,
                             const struct hsr_choice *choice);

/* How many faces a scene may have to be laid out for an algorithm. `choice` is
 * NULL for the standard one. */
#define HSR_RATHER_MOST (1u << 22)
#define HSR_LARGE (1u << 20)
uint32_t hsr_most_laid_out(const struct hsr_algorithm *algorithm,
                           const struct hsr_choice *choice);

/* Whether an algorithm can be asked for answers of a kind: it makes them, or
 * they are folded from what it makes. */
bool hsr_can_draw(const struct hsr_algorithm *algorithm,
                  const struct hsr_answer_type *type);

/* Its own kind. */
static inline const struct hsr_answer_type *
hsr_own_kind(const struct hsr_algorithm *algorithm) {
  return algorithm->makes[0].kind;
}

/* Its line of a kind, or NULL; and how it makes that kind, 0 if it does not. */
const struct hsr_made *hsr_makes(const struct hsr_algorithm *algorithm,
                                 const struct hsr_answer_type *type);
unsigned hsr_makes_how(const struct hsr_algorithm *algorithm,
                       const struct hsr_answer_type *type);

/* Whether it makes an answer of this form itself. */
bool hsr_makes_form(const struct hsr_algorithm *algorithm,
                    const struct hsr_form *form);

/* Kind k, from 0, of those that it makes besides its own and that cannot be folded
 * from pictures; NULL: there are no more. And whether a kind is one of these. */
const struct hsr_answer_type *
hsr_makes_besides(const struct hsr_algorithm *algorithm, int k);
bool hsr_makes_also(const struct hsr_algorithm *algorithm,
                    const struct hsr_answer_type *type);

/* Whether the chosen answer is folded from pictures that the algorithm draws,
 * instead of by the algorithm itself. */
bool hsr_choice_folds(const struct hsr_algorithm *algorithm,
                      const struct hsr_choice *choice);

/* Whether the chosen answer is, or is folded from, one of faces: those of the parts
 * of a scene can then be put together. */
bool hsr_choice_composes(const struct hsr_algorithm *algorithm,
                         const struct hsr_choice *choice);

/* HSR_ALGORITHM(watkins) is the name of the descriptor in this build. All other
 * names of the counting build get the ending _counting, by a header that is made
 * of the symbols of the other build (algorithms/local.mk). */
#if defined HSR_MODULE /* a module outside of the tree: hsr-module.h */
#define HSR_ALGORITHM(id) HSR_MODULE_NAME
#elif HSR_COUNTING
#define HSR_ALGORITHM(id) hsr_counting_##id
#else
#define HSR_ALGORITHM(id) hsr_algorithm_##id
#endif

/* Makes a tally one of a registered algorithm; its counts stay as they are. */
static inline void hsr_tally_begin(struct hsr_tally *tally,
                                   const struct hsr_algorithm *algorithm) {
  memcpy(tally->base, algorithm->base, sizeof tally->base);
}

/* The line of a registered algorithm's outline that a counter belongs to, from 1;
 * 0: none. */
static inline int hsr_line_of(const struct hsr_algorithm *algorithm,
                              int counter) {
  const struct hsr_line *line = algorithm->outline;
  for (int k = 0; line && line[k].text; k++)
    for (int r = 0; r < line[k].n_raises; r++)
      if (line[k].raises[r] == counter)
        return k + 1;
  return 0;
}

/* Both builds of one algorithm. An oracle has one build, which counts: it is
 * never timed. */
struct hsr_listed {
  const struct hsr_algorithm *plain, *counting;
};

/* Registers the descriptors of a list, which is ended by .plain == NULL: a list of
 * the same length and order, whose algorithms have their parts. A program calls
 * it once. */
const struct hsr_listed *hsr_register(const struct hsr_listed *modules);

#ifdef __cplusplus
}
#endif
#endif
