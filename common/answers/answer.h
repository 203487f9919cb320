/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of answers: what algorithms make, and everything that is done with it.
 *
 * A kind is one `const struct hsr_answer_type`. It has two files in kinds/, its
 * table and a header with its typed body, and one line in list.def. The command, the judge, the bench, the report and the crew
 * know answers only through this table.
 *
 * An algorithm makes some kinds itself. Other kinds are folded from pictures of
 * another kind, which any algorithm of that kind can draw: struct hsr_fold. */
#ifndef HSR_COMMON_ANSWERS_ANSWER_H
#define HSR_COMMON_ANSWERS_ANSWER_H

#include "common/base/count.h"
#include "common/files/image.h"
#include "common/base/option.h"
#include "common/lines/drawing.h"
#include "common/paper/page.h"
#include "common/scene/world.h"
#include "common/view/picture.h"
#include "common/view/view.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_answer_type;
struct hsr_line_style;
struct hsr_polygons;
struct json_t; /* of jansson */

/* What exactly is asked for: a kind and the values of its options. Two answers
 * are compared only if they have the same form. */
struct hsr_form {
  const struct hsr_answer_type *type;
  struct hsr_values values; /* of type->options */
};
bool hsr_same_form(const struct hsr_form *a, const struct hsr_form *b);

/* An answer to one view, of m x n samples or pixels. Owned by the caller. */
struct hsr_answer {
  struct hsr_form form;
  int m, n;
  void *body;    /* the contents, in the type's own form; owned by the type */
  uint32_t *ids; /* of the body: the visible face of each sample, m n of them by
                    rows; NULL: it has none */
  struct hsr_answer *picture; /* if the kind is folded: the picture that is
                                 folded in next; NULL if the algorithm makes
                                 the kind itself */
};

/* How the answer to a view is folded from pictures of another kind. */
struct hsr_fold {
  const struct hsr_answer_type *of;

  /* How many pictures there are, and the view of picture k, from 0.
   * HSR_E_REFUSED if that picture would be too large. */
  long (*n)(const struct hsr_form *form);
  enum hsr_status (*view)(const struct hsr_form *form,
                          const struct hsr_view *view, long k,
                          struct hsr_view *picture, struct hsr_error *err);

  /* Adds answer->picture, which is picture k. */
  void (*add)(struct hsr_answer *answer, const struct hsr_world *world,
              const struct hsr_view *view, long k);
};

/* How the answers to a view of the parts of a scene are added up: by sums of
 * whole numbers, to which an algorithm adds what it draws. */
struct hsr_summing {
  bool (*fits)(const struct hsr_form *form);
  /* Gives the answer sums, all 0. HSR_E_NOMEM. */
  enum hsr_status (*begin)(struct hsr_answer *answer, struct hsr_error *err);
  /* How many there are, and the first. */
  size_t (*sums)(const struct hsr_answer *answer, uint64_t **first);
  /* Makes the answer of the sums of all parts. */
  void (*finish)(struct hsr_answer *answer);
};

/* Two answers of one form to one view. All borrowed. */
struct hsr_comparison {
  const struct hsr_view *view;
  const struct hsr_answer *got, *wanted;
  const uint32_t *place; /* the places to compare, j * m + i, ascending; NULL:
                            all */
  size_t n;              /* how many */
  bool coarse; /* `got` is as coarse as its kind allows: its segments say
                  whether they are hidden, not by how many faces */
};

struct hsr_difference {
  uint64_t compared, differing; /* places, or whatever the kind compares */
  char first[200]; /* the place of the first difference, and what is there:
                      "(3, 4): face 5, not background" */
};

/* A line drawing on paper. Lengths are millimetres. */
struct hsr_drawn {
  size_t strokes;
  double ink, pen_up; /* how far the pen travels down, and up */
};

/* How an answer is to be shown. All borrowed. */
struct hsr_showing {
  const struct hsr_world *world;
  const struct hsr_view *view;
  const char *scene, *title, *description;
  const char *text; /* "key=value" lines for a file's metadata, or NULL */
  enum hsr_shading shading;
  bool depth;       /* depths are wanted as well */
  int supersamples; /* s: s x s samples are averaged; 1: none */
  const struct hsr_line_style *style; /* of line drawings; NULL: "screen" */
  const struct hsr_polygons *fill; /* faces under a line drawing; NULL: none */
  bool hatch;                      /* faces on paper are hatched, not filled */
  struct hsr_page page;            /* of drawings on paper */
  struct hsr_drawn *drawn; /* is set when a line drawing is written; NULL: it is
                              not asked for */
  /* Where there is no face, and behind splats: a linear colour; or nothing, in
   * .png and .exr files. */
  struct {
    bool given, none;
    float rgb[3];
  } background;
};

/* Gives m n places of a picture that show no face the background. */
void hsr_show_background(const struct hsr_showing *showing, const uint32_t *ids,
                         size_t n, float *rgb);

/* An answer made visible. Owned by the caller, freed by hsr_shaded_free. */
struct hsr_shaded {
  float *rgb, *depth; /* 3 m n and m n floats; NULL if the kind has none */
};
void hsr_shaded_free(struct hsr_shaded *shaded);

/* The settings that showing a kind can take account of. */
enum {
  HSR_SHADING,
  HSR_SUPERSAMPLES,
  HSR_LINES,       /* style, fill */
  HSR_HATCH,       /* hatch */
  HSR_PALETTE,     /* of a grid */
  HSR_LIGHTING,    /* the view's light */
  HSR_BACKDROP,    /* background */
  HSR_NO_BACKDROP, /* background none */
  HSR_N_TAKES
};

/* A picture of what a run has made so far. All is in samples of the view; a colour
 * is 0xrrggbb, as in files. */
struct hsr_slide {
  void *on; /* for the functions */
  void (*fill)(void *on, const struct hsr_window *window, uint32_t rgb);
  void (*line)(void *on, const double from[2], const double to[2]);
  void (*square)(void *on, const double middle[2], double half, double depth,
                 uint32_t rgb); /* the nearest hides the others */
  void (*touch)(void *on, const struct hsr_window *window); /* looked at */
};

/* An array of m n places by rows. */
enum { HSR_MOST_ARRAYS = 2 };
struct hsr_array {
  void *begin;
  size_t place; /* bytes of a place */
};

struct hsr_answer_type {
  const char *name;    /* [a-z]+, "ids" */
  const char *meaning; /* "the visible face of every sample" */
  const char *draws;   /* "faces": what its algorithms are said to draw */
  const char *places;  /* "samples": what is compared; a plural in s */
  const char *grains;  /* "samples": the unit of a view's size, m x n */

  const struct hsr_option *options;  /* of its form; if the kind is folded, the
                                       first option is the one that asks for
                                       it */
  const struct hsr_fold *fold;       /* NULL: algorithms make it themselves */
  const struct hsr_summing *summing; /* NULL: parts are not added up */
  bool by_windows;   /* each window of it can be made alone, and in any order */
  bool by_faces;     /* each place holds one face, and nothing else. Then the
                    answers of a scene's parts can be put together: at each
                    place the nearest face is taken */
  bool sees_through; /* transparent faces are drawn as such */
  bool by_places;    /* m x n places are compared, and each can be asked for
                      alone; false: it is made and compared as a whole */
  unsigned takes;    /* 1 << HSR_SHADING, ... */

  /* Makes the body of an empty answer, of form, m and n. HSR_E_NOMEM. */
  enum hsr_status (*make)(struct hsr_answer *answer, struct hsr_error *err);
  /* Puts it in the state before anything is drawn. NULL: the algorithm writes
   * every place. */
  void (*clear)(struct hsr_answer *answer);
  /* Marks all places as not written, so that a place which an algorithm leaves
   * out shows as a difference. NULL: clear does that. */
  void (*unset)(struct hsr_answer *answer);
  void (*free)(struct hsr_answer *answer);

  /* The arrays of the body of a kind that is made by windows. Returns how many
   * there are. NULL: the kind is not made by windows. */
  int (*arrays)(const struct hsr_answer *answer,
                struct hsr_array array[HSR_MOST_ARRAYS]);

  void (*compare)(const struct hsr_comparison *comparison,
                  struct hsr_difference *difference);
  /* Fills 3 m n floats: the wanted answer, dimmed, with the differences marked.
   * NULL: the kind cannot be shown so. HSR_E_NOMEM. */
  enum hsr_status (*show_difference)(const struct hsr_comparison *comparison,
                                     const struct hsr_showing *showing,
                                     float *rgb, struct hsr_error *err);

  /* Makes colours; before the call, all of *shaded is NULL. NULL: the kind has
   * no colours. */
  enum hsr_status (*shade)(const struct hsr_answer *answer,
                           const struct hsr_showing *showing,
                           struct hsr_shaded *shaded, struct hsr_error *err);
  /* Fills m n floats: how uncertain each place is, 1 if as much as the form
   * allows, and 2 if more. NULL: nothing is uncertain, and the kind is not
   * drawn in passes. */
  void (*uncertainty)(const struct hsr_answer *answer, float *share);
  /* Whether the suffix of `path` is that of a file that can hold it. */
  bool (*fits)(const char *path);
  enum hsr_status (*write)(const struct hsr_answer *answer,
                           const struct hsr_showing *showing,
                           struct hsr_shaded *shaded, const char *path,
                           struct hsr_error *err);
  /* For a picture larger than memory, which is made by tiles: writes the file
   * of one, and joins all to the picture's file. As hsr_image_write_tile and
   * hsr_image_join_tiles. NULL: the kind is not made by tiles. */
  enum hsr_status (*write_tile)(const struct hsr_answer *tile,
                                const struct hsr_tile_grid *tiling, long number,
                                const char *text, const char *path,
                                struct hsr_error *err);
  enum hsr_status (*join_tiles)(const char *path,
                                const struct hsr_tile_grid *tiling,
                                const char *(*name)(void *whom, long k),
                                void *whom, const char *text,
                                struct hsr_error *err);
  /* Returns why a picture of this form cannot be made by tiles: the rest of a
   * sentence that begins with "--tiles". It returns NULL if the picture can be
   * made so. The function itself is NULL if that holds for every form. */
  const char *(*not_by_tiles)(const struct hsr_form *form);
  /* The line drawing in an answer. NULL: the kind is none. */
  const struct hsr_drawing *(*lines)(const struct hsr_answer *answer);
  /* Prints one line about its contents, with the newline. */
  void (*print)(const struct hsr_answer *answer,
                const struct hsr_showing *showing, FILE *out);

  /* For traces: docs/schemas/trace.schema.json. If all of these are NULL, a run that
   * makes this kind cannot be traced. */

  /* Adds what an event of kind HSR_ACCEPT describes. HSR_E_NOMEM. */
  enum hsr_status (*paint)(struct hsr_answer *answer,
                           const struct hsr_event *event);
  /* Adds to a slide what an event of kind `step` shows, which is HSR_ACCEPT or
   * HSR_SAMPLE. `painted` has the event; `face` is the colour of its face. NULL:
   * an accepted event without a part fills its window with that colour. */
  void (*sketch)(const struct hsr_answer *painted,
                 const struct hsr_event *event, enum hsr_step_kind step,
                 const struct hsr_view *view, uint32_t face,
                 const struct hsr_slide *slide);
  /* Puts what was painted into the order of an answer. NULL: the kind has no
   * order. HSR_E_NOMEM. */
  enum hsr_status (*settle)(struct hsr_answer *answer);
  /* Return new references, or NULL for lack of memory: to an answer; and to the
   * part of an event. part_json is NULL if events of the kind have no part. */
  struct json_t *(*json)(const struct hsr_answer *answer,
                         const struct hsr_view *view);
  struct json_t *(*part_json)(const void *part, const struct hsr_view *view);
};

/* --- The kinds ------------------------------------------------------------ */

#define HSR_ANSWER(id) extern const struct hsr_answer_type hsr_answer_##id;
#include "common/answers/list.def"
#undef HSR_ANSWER

/* All kinds, ended by NULL: the program's own list, or that of list.def. */
extern const struct hsr_answer_type *const hsr_answer_types[];

/* The index of a kind in that list. */
int hsr_answer_number(const struct hsr_answer_type *type);
#define HSR_MOST_ANSWER_TYPES 16

/* Whether algorithms that make `made` can be asked for `type`: it is what they
 * make, or it is folded from that. */
bool hsr_is_asked_of(const struct hsr_answer_type *type,
                     const struct hsr_answer_type *made);

/* --- Answers -------------------------------------------------------------- */

/* The form of a kind with its standard options. */
struct hsr_form hsr_form_standard(const struct hsr_answer_type *type);

/* Makes an answer in which nothing is drawn. It is to be freed also after a
 * failure. `by_pictures`: the kind is folded, and pictures are drawn for it.
 * HSR_E_NOMEM; HSR_E_REFUSED if such a picture would be too large. */
enum hsr_status hsr_answer_make(struct hsr_answer *answer,
                                const struct hsr_form *form,
                                const struct hsr_view *view, bool by_pictures,
                                struct hsr_error *err);
void hsr_answer_free(struct hsr_answer *answer);

/* For kinds that are made by windows. The size of a window's places, in bytes;
 * copies them, by rows, out of the answer, or into it. */
size_t hsr_answer_window_size(const struct hsr_answer *answer,
                              const struct hsr_window *window);
void hsr_answer_pack(const struct hsr_answer *answer,
                     const struct hsr_window *window, void *bytes);
void hsr_answer_unpack(struct hsr_answer *answer,
                       const struct hsr_window *window, const void *bytes);

/* The line drawing in an answer; NULL: it has none, or is not made yet. */
static inline const struct hsr_drawing *
hsr_answer_lines(const struct hsr_answer *answer) {
  const struct hsr_answer_type *type = answer->form.type;
  return answer->body && type->lines ? type->lines(answer) : NULL;
}

/* Roughly how many pictures of the view's size are drawn for one answer. */
double hsr_form_pictures(const struct hsr_form *form,
                         const struct hsr_view *view);

/* In the ids of an answer that is unset, where nothing is written. */
#define HSR_NOT_WRITTEN 0xfefefefeu

#ifdef __cplusplus
}
#endif

#endif
