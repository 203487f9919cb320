/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr render says on stderr about a drawing of lines. */
#include "bench/render/render.h"
#include "common/files/mesh/exchange.h"
#include "common/files/suffix.h"
#include "common/paper/lines/lines.h"
#include "scenes/cameras.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether the scene is a mesh file, or is made of such: then the options of the
 * import apply. */
static bool is_mesh(const struct render *r) {
  const char *name = r->scene->name;
  char *plain = strndup(name, hsr_name_before_cameras(name));
  const bool is =
      plain && (!strncmp(plain, "mesh:", strlen("mesh:")) ||
                hsr_is_mesh_name(plain) || strstr(plain, ".scene.json"));
  free(plain);
  return is;
}

/* What is worth saying of the edges of a drawing. */
struct edge_counts {
  size_t edges, flat, borders;
};

/* Counts edges of flat faces, and of one face. */
static enum hsr_status count_edges(const struct render *r,
                                   const struct hsr_drawing *drawing,
                                   struct edge_counts *n,
                                   struct hsr_error *err) {
  unsigned char *of = malloc(drawing->n + 1);
  uint32_t *object = malloc((drawing->n + 1) * sizeof *object);
  enum hsr_status status =
      of && object
          ? hsr_lines_classify(drawing, &r->world, &r->view, 1, of, object, err)
          : hsr_fail_nomem(err);
  for (size_t k = 0; k < drawing->n && !status; k++) {
    const struct hsr_segment *s = &drawing->segment[k];
    if (k && !hsr_edge_name_compare(&s->edge, &s[-1].edge))
      continue;
    n->edges++;
    n->flat += of[k] == HSR_LINE_SMOOTH || of[k] == HSR_LINE_SEAM;
    n->borders += of[k] == HSR_LINE_BOUNDARY;
  }
  free(of);
  free(object);
  return status;
}

/* What to leave out of a drawing of faces that are divided: an edge within a
 * plane shows nothing. And what to do if most edges are borders: then vertices
 * may nearly meet, as in files of many programs. */
static enum hsr_status say_seams(const struct render *r,
                                 const struct hsr_drawing *drawing,
                                 struct hsr_error *err) {
  struct edge_counts n = {.edges = 0};
  if (r->options->style.crease >= 0 || r->options->lines.has_crease)
    return HSR_OK;
  enum hsr_status status = count_edges(r, drawing, &n, err);
  if (!status && n.flat)
    fprintf(stderr,
            "hsr: %zu of %zu edges lie between faces of one plane; --crease=1 "
            "leaves them out\n",
            n.flat, n.edges);
  if (!status && n.borders > n.edges / 2 && is_mesh(r) &&
      !(r->options->scene.import.weld > 0))
    fprintf(stderr,
            "hsr: %zu of %zu edges have one face only; if faces ought to meet "
            "there, --weld=DISTANCE joins them\n",
            n.borders, n.edges);
  return status;
}

static int compare(const void *a, const void *b) {
  const uint64_t *x = a, *y = b;
  return (*x > *y) - (*x < *y);
}

/* The edges of all faces, each as often as faces have it: its vertices in one
 * number. */
static uint64_t *list_sides(const struct hsr_mesh *mesh, uint32_t n_faces) {
  uint64_t *side = malloc(((size_t)mesh->n_corners + 1) * sizeof *side);
  for (uint32_t f = 0; f < n_faces && side; f++)
    for (uint32_t k = mesh->start[f], end = mesh->start[f + 1]; k < end; k++) {
      const uint64_t a = mesh->vertex[k],
                     b = mesh->vertex[k + 1 < end ? k + 1 : mesh->start[f]];
      side[k] = a < b ? a << 32 | b : b << 32 | a;
    }
  return side;
}

/* Whether all faces are one-sided and every edge has exactly two. */
static enum hsr_status find_closed(const struct hsr_world *world, bool *closed,
                                   struct hsr_error *err) {
  const uint32_t n = world->mesh.n_corners;
  *closed = n % 2 == 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    *closed &= world->mesh.one_sided[f];
  if (!*closed)
    return HSR_OK;
  uint64_t *side = list_sides(&world->mesh, world->n_faces);
  if (!side)
    return hsr_fail_nomem(err);
  qsort(side, n, sizeof *side, compare);
  for (uint32_t k = 0; k < n; k += 2)
    *closed &= side[k] == side[k + 1] && (!k || side[k] != side[k - 1]);
  free(side);
  return HSR_OK;
}

/* What hidden lines are missing: those of faces that do not exist. */
static enum hsr_status say_rear(const struct render *r, struct hsr_error *err) {
  bool closed = false;
  if (!hsr_line_style_draws_hidden(&r->options->style) || !is_mesh(r))
    return HSR_OK;
  enum hsr_status status = find_closed(&r->world, &closed, err);
  if (closed)
    fprintf(stderr,
            "hsr: the mesh is closed and its faces are one-sided: edges at the "
            "back are left out; --two-sided draws them\n");
  return status;
}

/* Files of lines alone. */
static void say_no_faces(const struct render_options *o) {
  for (int k = 0; k < o->n_outputs && o->fill; k++) {
    const char *file = o->output[k];
    if (hsr_ends_in(file, ".dxf") && !o->hatch)
      fprintf(stderr,
              "hsr: %s: holds lines, and no filled faces; --hatch makes lines "
              "of them\n",
              file);
    else if (hsr_ends_in(file, ".vtp") || hsr_ends_in(file, ".json"))
      fprintf(stderr, "hsr: %s: holds the edges alone, and no faces\n", file);
  }
}

/* A scene whose unit is not a millimetre is a dot on a page to scale. A view with
 * less than 20 mm of line is too small to show anything. */
static void say_unit(const struct render *r) {
  const struct hsr_page *page = &r->options->page;
  const size_t views = r->n_on_sheet ? r->n_on_sheet : 1;
  if (page->scale > 0 && !(page->unit > 0) && r->drawn.strokes &&
      r->drawn.ink < 20 * (double)views)
    fprintf(stderr,
            "hsr: to this scale all lines together are %.3g mm long; --unit "
            "says how long a unit of the scene is, if it is not 1mm\n",
            r->drawn.ink);
}

enum hsr_status say_notes(const struct render *r, struct hsr_error *err) {
  const struct hsr_drawing *drawing = hsr_answer_lines(&r->answer);
  if (!drawing || !r->options->n_outputs)
    return HSR_OK;
  say_no_faces(r->options);
  say_unit(r);
  enum hsr_status status = say_seams(r, drawing, err);
  return status ? status : say_rear(r, err);
}
