/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of hsr render. */
#ifndef HSR_BENCH_RENDER_H
#define HSR_BENCH_RENDER_H

#include "algorithms/setup.h"
#include "bench/modules/variant.h"
#include "bench/options/lines.h"
#include "bench/options/page.h"
#include "bench/options/view.h"

enum { MOST_OUTPUTS = 16 };

struct render_options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  const char *algorithm;
  const char *output[MOST_OUTPUTS];
  int n_outputs;
  const char *work;
  const char *passes, *uncertainty, *certain; /* patterns of files; or NULL */
  enum hsr_shading shading;
  struct line_options lines;
  struct hsr_line_style style; /* made of `lines` */
  struct hsr_page page;
  const char *sheet; /* the list of its views; or NULL */
  bool first_angle;  /* of the sheet */
  const char *fill;  /* the algorithm of the faces under lines; or NULL */
  bool hatch;
  const char *page_option; /* the last one given that is for pages; or NULL */
  bool has_background, no_background;
  float background[3]; /* linear */
  /* For each of HSR_SHADING, ...: the last option given that only kinds of
   * answers which take account of it accept; or NULL. */
  const char *given[HSR_N_TAKES];
  long threads, supersamples;
  long first, last;             /* of --views, from 1; first is 0 without it */
  long orbit;                   /* of --orbit; 0 without it */
  long first_frame, last_frame; /* of --frames; last_frame is -1 without it */
  long tile;                    /* of --tiles; 0 without it */
  bool sort_last;
  long parts; /* of --sort-last; 0: as many as ranks */
};

/* Reads the command line of hsr render, and the variant that it names. The
 * scene's name has its cameras then. HSR_E_USAGE; HSR_E_INPUT, HSR_E_NOMEM: the
 * palette cannot be read. */
enum hsr_status render_parse(int argc, char **argv,
                             struct render_options *options,
                             struct hsr_variant *variant,
                             struct hsr_error *err);

/* Whether pictures of several views or frames are made. */
static inline bool is_series(const struct render_options *options) {
  return options->first || options->orbit || options->last_frame >= 0;
}

/* The pictures in the making, one after the other, and their times and counts.
 * Everything is freed by command_render. */
struct render {
  const struct render_options *options;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup setup;
  struct crew *crew;
  struct hsr_view view; /* of the answer's m x n */
  const struct hsr_answer_type *kind;
  struct hsr_answer answer;
  struct hsr_shaded shaded;
  struct hsr_drawn drawn;
  size_t n_on_sheet;  /* views of --sheet */
  double sheet_mm[2]; /* its width and height */
  struct hsr_answer
      fill; /* the visible polygons of --fill, and what they need */
  struct hsr_setup fill_setup;
  float *work;
  struct hsr_tally tally;
  struct hsr_passes passes;
  enum hsr_status pass_status;
  struct hsr_error pass_err;
  long view_number, n_pictures; /* of this picture, from 1, or its frame's; and
                                   so far */
  long frame;                   /* of --frames */
  long n_kept; /* frames that went on with what was prepared for the last one */
  long n_tiles, n_found; /* of --tiles: all, and those there were before */
  bool shows;            /* the picture on the terminal: no file is asked for */
  double exposure;       /* that was chosen for an X-ray picture; 0: none */
  uint32_t n_faces;      /* of --sort-last: of all parts */
  long n_drawn;          /* parts, by this rank */
  double sent_bytes, sent_messages, compared; /* of their pictures */
  double import, build, compose;              /* seconds */
  double draw, shade, write;                  /* seconds, of all pictures */
};

/* Makes the picture of r->view, for which all is made ready, and writes it.
 * HSR_E_NOMEM, and whatever the algorithm and the writing fail with. */
enum hsr_status make_picture(struct render *r, struct hsr_error *err);

/* Makes the picture by tiles and writes it (bench/render/tiles.c). Fails as
 * make_picture; HSR_E_INPUT also if there are tiles of another picture. */
enum hsr_status make_tiles(struct render *r, struct hsr_error *err);

/* Draws the standard views of --sheet, and writes them as one drawing
 * (bench/render/sheet.c). Fails as make_picture; HSR_E_USAGE if a view is none,
 * or the page is too small. */
enum hsr_status make_sheet(struct render *r, struct hsr_error *err);

/* Makes the picture of a scene that is drawn in parts, and writes it
 * (bench/render/sort_last.c). Fails as make_picture, and as
 * hsr_scene_open_part; HSR_E_USAGE if there are fewer parts than ranks. */
enum hsr_status make_sort_last(struct render *r, const struct hsr_algorithm *a,
                               const struct hsr_variant *variant,
                               struct hsr_error *err);

/* For an X-ray picture whose exposure the user did not choose: chooses one by which
 * the brightest channel of r->view is nearly white, and keeps to it in further
 * pictures (bench/render/exposure.c). Fails as make_picture. */
enum hsr_status choose_exposure(struct render *r, struct hsr_error *err);

/* The same of the sums of all parts of a scene: an answer that is about to be made
 * of them. */
void expose_sums(struct render *r, struct hsr_answer *sums);

/* What make_picture does: draws; makes the colours, r->shaded; writes. */
enum hsr_status draw_picture(struct render *r, struct hsr_error *err);
enum hsr_status shade_picture(struct render *r, struct hsr_error *err);
enum hsr_status write_picture(struct render *r, struct hsr_error *err);

/* Draws the visible polygons of --fill, of the same view. Fails as draw_picture;
 * HSR_E_USAGE if its algorithm draws none. Freed with all else that is of one
 * scene. */
enum hsr_status draw_fill(struct render *r, struct hsr_error *err);
void forget_fill(struct render *r);

/* Says on stderr what a drawing that was written lacks, or has too much of, and
 * which option helps. HSR_E_NOMEM. */
enum hsr_status say_notes(const struct render *r, struct hsr_error *err);

/* Frees what is of one scene, before the next. */
void render_forget_scene(struct render *r);

/* Frees what has the size of a picture, before one of another size. */
void render_forget(struct render *r);

/* Frees all but the scene. All zero is allowed. */
void render_close(struct render *r);

/* Whether the options go with one another and with what is drawn. HSR_E_USAGE. */
enum hsr_status check_options(const struct render_options *options,
                              const struct hsr_variant *variant,
                              struct hsr_error *err);

/* Whether --passes and the like, if they are given, fit what is drawn.
 * HSR_E_USAGE. */
enum hsr_status check_passes(const struct render_options *options,
                             const struct hsr_variant *variant,
                             struct hsr_error *err);

/* For an error: which algorithms draw what takes account of a setting,
 * HSR_SHADING and so on; or what fits the file of a drawing. "": none is
 * named. */
enum { MOST_HINT = 200 };
void hint_taker(const struct hsr_variant *variant, int takes,
                char text[MOST_HINT]);
void hint_writer(const struct hsr_variant *variant, const char *path,
                 char text[MOST_HINT]);

/* For struct hsr_passes: tells of a pass and writes its files. `whom` is a
 * struct render; what fails first is left in its pass_status. */
void write_pass(void *whom, const struct hsr_answer *answer, int pass);

/* How a picture is shown. */
struct hsr_showing showing_of(const struct render *r);

#endif
