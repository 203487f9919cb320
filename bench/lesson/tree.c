/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tree of the survey's figure 13 as a drawing, with its ten algorithms as leaves. */
#include "bench/lesson/lesson.h"
#include "bench/results/descriptor.h"
#include "common/files/whole_file.h"

#include <cairo-svg.h>
#include <string.h>

enum { ROW = 34, MARGIN = 16, WIDTH = 940, MOST_NAME = 160 };

static const double at_column[] = {MARGIN, 160, 300, 490};
enum { ROOT, CLASS, BRANCH, LEAF };

struct node {
  const char *text;
  double first, last; /* the heights of what hangs on it */
};

struct tree {
  cairo_t *cairo;
  struct node node[LEAF]; /* those that are open */
};

static double middle(const struct node *node) {
  return (node->first + node->last) / 2;
}

static void put(cairo_t *cairo, double x, double y, double size,
                const char *text) {
  cairo_set_font_size(cairo, size);
  cairo_move_to(cairo, x, y + size / 3);
  cairo_show_text(cairo, text);
}

/* A line from the stem before a column to what stands in it. */
static void put_twig(cairo_t *cairo, int column, double y) {
  cairo_move_to(cairo, at_column[column] - 18, y);
  cairo_line_to(cairo, at_column[column] - 6, y);
  cairo_stroke(cairo);
}

/* Draws a node, and the stem of what hangs on it, and hangs it on its own. */
static void end_node(struct tree *t, int column) {
  struct node *node = &t->node[column];
  double y = middle(node), stem = at_column[column + 1] - 18;
  cairo_text_extents_t wide;
  if (!node->text)
    return;
  put(t->cairo, at_column[column], y, 14, node->text);
  cairo_text_extents(t->cairo, node->text, &wide);
  cairo_move_to(t->cairo, at_column[column] + wide.x_advance + 6, y);
  cairo_line_to(t->cairo, stem, y);
  cairo_move_to(t->cairo, stem, node->first);
  cairo_line_to(t->cairo, stem, node->last);
  cairo_stroke(t->cairo);
  node->text = NULL;
  if (column == ROOT)
    return;
  put_twig(t->cairo, column, y);
  struct node *up = &t->node[column - 1];
  up->first = up->first < 0 ? y : up->first;
  up->last = y;
}

/* Goes on in the node of this text, or ends it and those within it, and begins
 * another. */
static void enter(struct tree *t, int column, const char *text) {
  struct node *node = &t->node[column];
  if (node->text && !strcmp(node->text, text))
    return;
  for (int k = BRANCH; k >= column; k--)
    end_node(t, k);
  *node = (struct node){text, -1, -1};
}

static void put_leaf(struct tree *t, const struct hsr_algorithm *a, double y) {
  char text[MOST_NAME];
  struct node *branch = &t->node[BRANCH];
  snprintf(text, sizeof text, "%s %d", a->authors, a->year);
  put(t->cairo, at_column[LEAF], y - 4, 14, text);
  snprintf(text, sizeof text, "%s%s%s", a->name,
           a->sort_order ? "; sorts " : "", a->sort_order ? a->sort_order : "");
  cairo_set_source_rgb(t->cairo, .37, .38, .41);
  put(t->cairo, at_column[LEAF], y + 9, 11, text);
  cairo_set_source_rgb(t->cairo, .11, .12, .13);
  put_twig(t->cairo, LEAF, y);
  branch->first = branch->first < 0 ? y : branch->first;
  branch->last = y;
}

static void draw(cairo_t *cairo, const struct hsr_algorithm *const *ten,
                 int n) {
  struct tree tree = {.cairo = cairo};
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  cairo_set_source_rgb(cairo, .11, .12, .13);
  cairo_set_line_width(cairo, 1);
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  enter(&tree, ROOT, "opaque objects");
  for (int k = 0; k < n; k++) {
    struct taxonomy place = taxonomy(ten[k]->taxonomy);
    enter(&tree, CLASS, place.class);
    enter(&tree, BRANCH, place.branch);
    put_leaf(&tree, ten[k], MARGIN + ROW * (k + .5));
  }
  for (int k = BRANCH; k >= ROOT; k--)
    end_node(&tree, k);
}

static cairo_status_t append(void *stream, const unsigned char *data,
                             unsigned length) {
  return fwrite(data, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_WRITE_ERROR;
}

enum hsr_status lesson_tree(const char *path, struct hsr_error *err) {
  const struct hsr_algorithm *ten[LESSON_TEN];
  struct hsr_whole_file file;
  int n = 0;
  for (int k = 0; k < LESSON_TEN; k++)
    if (hsr_algorithm_find(lesson_ten[k]))
      ten[n++] = hsr_algorithm_find(lesson_ten[k])->plain;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  cairo_surface_t *surface = cairo_svg_surface_create_for_stream(
      append, file.stream, WIDTH, 2 * MARGIN + ROW * n);
  cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
  cairo_t *cairo = cairo_create(surface);
  draw(cairo, ten, n);
  cairo_status_t said = cairo_status(cairo);
  cairo_destroy(cairo);
  cairo_surface_finish(surface);
  said = said ? said : cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  if (said)
    status = hsr_fail(err, HSR_E_INPUT, "%.400s: %s", path,
                      cairo_status_to_string(said));
  return hsr_whole_file_close(&file, status, err);
}
