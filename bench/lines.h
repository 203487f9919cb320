/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr render does with a line drawing. */
#ifndef HSR_BENCH_LINES_H
#define HSR_BENCH_LINES_H

#include "bench/command.h"
#include "common/files/plot.h"

/* Whether only a line drawing can be written to a file of this name. */
bool is_line_file(const char *path);

/* A drawing and how it is to be shown. All borrowed. */
struct line_picture {
  const struct hsr_drawing *drawing;
  const struct hsr_world *world;
  const struct hsr_view *view;
  enum hsr_hidden hidden; /* but .vtp files hold all intervals */
  const char *title, *description;
  const char *text; /* of an image: see hsr_image_write */
};

/* Writes the files, by suffix: .svg, .pdf, .vtp, or an image. */
enum hsr_status write_lines(const struct line_picture *picture,
                            const char *const *file, int n_files,
                            struct hsr_error *err);

/* Prints how many edges and intervals there are, and how much of them is
 * visible. */
void print_lines(const struct hsr_drawing *drawing,
                 const struct hsr_view *view);

#endif
