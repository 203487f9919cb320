/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of answers: what algorithms make, and all that one does with it.
 *
 * A kind is one `const struct hsr_answer_type` in a file of its own, and one
 * line in list.def. The command, the judge, the bench, the report and the crew
 * know answers only through this table.
 *
 * Some kinds an algorithm makes itself. Others are folded from pictures of
 * another kind, by whoever makes those: struct hsr_fold. */
#ifndef HSR_COMMON_ANSWERS_ANSWER_H
#define HSR_COMMON_ANSWERS_ANSWER_H

#include "common/answers/filter.h"
#include "common/base/count.h"
#include "common/base/option.h"
#include "common/grids/voxels.h"
#include "common/lines/drawing.h"
#include "common/scene/world.h"
#include "common/view/picture.h"
#include "common/view/view.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_answer_type;
struct json_t; /* of jansson */

/* What exactly is asked for: a kind, and its options. Only answers of one form
 * are compared. */
struct hsr_form {
  const struct hsr_answer_type *type;
  struct hsr_values values; /* of type->options */
};
bool hsr_same_form(const struct hsr_form *a, const struct hsr_form *b);

/* An answer to one view, of m x n samples or pixels. Owned by the caller. */
struct hsr_answer {
  struct hsr_form form;
  int m, n;
  void *body; /* what it is, as its type says; the type's memory */
  struct hsr_answer *picture; /* of a kind that is folded, one picture to be
                                 folded in; NULL where the algorithm makes the
                                 kind itself */
};

/* How the answer to a view is folded from pictures of another kind. */
struct hsr_fold {
  const struct hsr_answer_type *of;

  /* How many pictures, and the view of picture k, from 0. HSR_E_REFUSED where
   * it would be too large. */
  long (*n)(const struct hsr_form *form);
  enum hsr_status (*view)(const struct hsr_form *form,
                          const struct hsr_view *view, long k,
                          struct hsr_view *picture, struct hsr_error *err);

  /* Adds answer->picture, which is picture k. */
  void (*add)(struct hsr_answer *answer, const struct hsr_world *world,
              const struct hsr_view *view, long k);
};

/* Two answers of one form to one view. All borrowed. */
struct hsr_comparison {
  const struct hsr_view *view;
  const struct hsr_answer *got, *wanted;
  const uint32_t *place; /* the places to compare, j * m + i, ascending; NULL:
                            all */
  size_t n;              /* how many */
  bool coarse; /* `got` answers as coarsely as its kind allows: of segments,
                  whether hidden, not by how many */
};

struct hsr_difference {
  uint64_t compared, differing; /* places, or whatever the kind compares */
  char first[200]; /* the first difference in words, behind their number:
                      "samples, the first (3, 4): face 5, not 6" */
};

/* How an answer is to be shown. All borrowed. */
struct hsr_showing {
  const struct hsr_world *world;
  const struct hsr_view *view;
  const char *scene, *title, *description;
  const char *text; /* "key=value" lines for a file's metadata, or NULL */
  enum hsr_shading shading;
  bool depth;       /* depths are wanted, too */
  const float *rgb; /* colours of the samples, if the algorithm made them */
  int supersamples; /* s: s x s samples are averaged; 1: none */
  enum hsr_hidden hidden; /* what becomes of hidden lines */
  double crease;          /* degrees; negative: all edges */
};

/* An answer made visible. Owned by the caller, freed by hsr_shaded_free. */
struct hsr_shaded {
  float *rgb, *depth; /* 3 m n and m n, as far as the kind has them; or NULL */
};
void hsr_shaded_free(struct hsr_shaded *shaded);

/* What showing a kind can take account of. */
enum {
  HSR_SHADING,
  HSR_SUPERSAMPLES,
  HSR_LINES, /* hidden, crease */
  HSR_N_TAKES
};

struct hsr_answer_type {
  const char *name;    /* [a-z]+, "ids" */
  const char *meaning; /* "the visible face of every sample" */
  const char *draws;   /* "faces": what who makes it is said to draw */
  const char *places;  /* "samples": what is compared */
  const char *grains;  /* "samples": what a view of m x n has m x n of */

  const struct hsr_option *options; /* of its form; the first of them is what
                                       asks for the kind, if it is folded */
  const struct hsr_fold *fold;      /* NULL: algorithms make it themselves */
  bool by_windows; /* each window of it can be made alone, and in any order */
  bool by_places;  /* m x n places are compared, and each can be asked for
                      alone; else it is made and compared as a whole */
  unsigned takes;  /* 1 << HSR_SHADING, ... */

  /* Makes the body of an empty answer, of form, m and n. HSR_E_NOMEM. */
  enum hsr_status (*make)(struct hsr_answer *answer, struct hsr_error *err);
  /* As before anything was drawn. NULL: who makes it writes all of it. */
  void (*clear)(struct hsr_answer *answer);
  /* Marks all places as not written, so that what an algorithm leaves out shows
   * as a difference. NULL: clear does. */
  void (*unset)(struct hsr_answer *answer);
  void (*free)(struct hsr_answer *answer);

  /* Copies what `from` has in a window. NULL: not by windows. */
  void (*merge)(struct hsr_answer *into, const struct hsr_answer *from,
                const struct hsr_window *window);

  void (*compare)(const struct hsr_comparison *comparison,
                  struct hsr_difference *difference);
  /* 3 m n: the wanted answer, dim, with what differs marked. NULL: it cannot be
   * shown so. HSR_E_NOMEM. */
  enum hsr_status (*show_difference)(const struct hsr_comparison *comparison,
                                     const struct hsr_showing *showing,
                                     float *rgb, struct hsr_error *err);

  /* What is left out of the answer for showing it. NULL: nothing. HSR_E_NOMEM.
   */
  enum hsr_status (*trim)(struct hsr_answer *answer,
                          const struct hsr_showing *showing,
                          struct hsr_error *err);
  /* To colours; the shaded is all NULL before. NULL: there are none. */
  enum hsr_status (*shade)(const struct hsr_answer *answer,
                           const struct hsr_showing *showing,
                           struct hsr_shaded *shaded, struct hsr_error *err);
  /* Whether a file of this name can hold it, by suffix. */
  bool (*fits)(const char *path);
  enum hsr_status (*write)(const struct hsr_answer *answer,
                           const struct hsr_showing *showing,
                           struct hsr_shaded *shaded, const char *path,
                           struct hsr_error *err);
  /* A line on what there is in it, with its end. */
  void (*print)(const struct hsr_answer *answer,
                const struct hsr_showing *showing, FILE *out);

  /* Its part in a trace: docs/trace.schema.json. NULL, all of them: a run that
   * makes this kind cannot be traced. */

  /* Adds what an event of kind HSR_ACCEPT tells. HSR_E_NOMEM. */
  enum hsr_status (*paint)(struct hsr_answer *answer,
                           const struct hsr_event *event);
  /* Brings what was painted into the order of an answer. NULL: it has none.
   * HSR_E_NOMEM. */
  enum hsr_status (*settle)(struct hsr_answer *answer);
  /* New references, or NULL for lack of memory: an answer; and the part of an
   * event, NULL if its events have none. */
  struct json_t *(*json)(const struct hsr_answer *answer,
                         const struct hsr_view *view);
  struct json_t *(*part_json)(const void *part, const struct hsr_view *view);
};

/* --- The kinds ------------------------------------------------------------- */

#define HSR_ANSWER(id) extern const struct hsr_answer_type hsr_answer_##id;
#include "common/answers/list.def"
#undef HSR_ANSWER

/* All kinds, ended by NULL: the program's own list, or that of list.def. */
extern const struct hsr_answer_type *const hsr_answer_types[];

/* The number of a kind among them. */
int hsr_answer_number(const struct hsr_answer_type *type);
#define HSR_MOST_ANSWER_TYPES 16

/* The names that algorithms give in their descriptors. */
#define HSR_IDS (&hsr_answer_ids)
#define HSR_SEGMENTS (&hsr_answer_segments)
#define HSR_VOXELS (&hsr_answer_voxels)

/* --- Answers --------------------------------------------------------------- */

/* The form of a kind with its standard options. */
struct hsr_form hsr_form_standard(const struct hsr_answer_type *type);

/* An answer in which nothing is drawn, to be freed also after a failure.
 * `by_pictures`: the kind is folded, and from pictures. HSR_E_NOMEM;
 * HSR_E_REFUSED where such a picture would be too large. */
enum hsr_status hsr_answer_make(struct hsr_answer *answer,
                                const struct hsr_form *form,
                                const struct hsr_view *view, bool by_pictures,
                                struct hsr_error *err);
void hsr_answer_free(struct hsr_answer *answer);

/* About how many pictures of the view's size it takes to make the answer. */
double hsr_form_pictures(const struct hsr_form *form,
                         const struct hsr_view *view);

/* The body of an answer of these kinds; NULL of any other. Of ids, m * n; of a
 * filtered picture, its sums, 3 m n. */
uint32_t *hsr_answer_ids_of(const struct hsr_answer *answer);
struct hsr_drawing *hsr_answer_drawing_of(const struct hsr_answer *answer);
struct hsr_solid_voxels *hsr_answer_voxels_of(const struct hsr_answer *answer);
uint32_t *hsr_answer_sums_of(const struct hsr_answer *answer);

/* How many voxels lie along the longest side of the scene's box, of a form of
 * voxels. */
int hsr_form_voxels(const struct hsr_form *form);

/* An answer around ids that somebody else owns, of m x n; not to be freed. */
struct hsr_answer hsr_answer_of_ids(uint32_t *ids, int m, int n);

/* How a picture is filtered, of a form; the filter is HSR_FILTER_NONE if it is
 * of another kind. */
struct hsr_filtering hsr_form_filtering(const struct hsr_form *form);

#ifdef __cplusplus
}
#endif
#endif
