/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gl2ps, which removes hidden primitives from OpenGL's feedback by a BSP tree
 * and a tree of images: a hidden-line renderer of sorts.
 *
 * Input       First the edges of existing faces as OpenGL lines, each in its
 *             own colour; then these faces as triangles, which gl2ps's polygon
 *             offset moves back a little, as its manual advises.
 * Output      An edge is kept if its colour occurs in the SVG file. gl2ps does
 *             not cut lines: it draws a kept line whole, and paints over the
 *             hidden parts. So an edge is wrong only if it is kept and none of
 *             it is visible, or if it is not kept and some of it is visible. */
#define GL_GLEXT_PROTOTYPES 1
#include "bench/peers/lines/lines.h"
#include "bench/peers/shared/offscreen.h"
#include "bench/peers/shared/peers.h"
#include "bench/peers/shared/projection.h"

#include <GL/gl.h>
#include <gl2ps.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_FEEDBACK = 1 << 20, MOST_FEEDBACK = 1 << 29 };

struct lines {
  struct offscreen offscreen;
  const struct hsr_world *triangles; /* of the same scene as the edges */
  struct hsr_edges edges;
  struct box box;
  GLint feedback; /* how many numbers the last frame took */
  FILE *file;     /* SVG, in memory: text[0 .. length), and a zero */
  char *text;
  size_t length;
};

/* --- Setting up ----------------------------------------------------------- */

static enum hsr_status lines_setup(const struct peer *peer,
                                   const struct peer_canvas *canvas,
                                   void **state, struct hsr_error *err) {
  (void)peer;
  struct lines *lines = calloc(1, sizeof *lines);
  *state = lines;
  if (!lines)
    return hsr_fail_nomem(err);
  const struct hsr_world *world = canvas->setup->world;
  lines->triangles = world;
  lines->box = box_of_world(world);
  lines->feedback = LEAST_FEEDBACK;
  enum hsr_status status = hsr_edges_init(
      &lines->edges, world->pieces ? world->pieces->whole : world, err);
  if (!status && lines->edges.n_real >= 0xffffff)
    status = hsr_fail(err, HSR_E_REFUSED, "gl2ps: more edges than colours");
  if (!status)
    status = offscreen_open(&lines->offscreen, true, 1, err);
  if (!status)
    status = offscreen_raster(canvas->m, canvas->n, err);
  if (status)
    return status;
  lines->file = open_memstream(&lines->text, &lines->length);
  return lines->file ? HSR_OK : hsr_fail_nomem(err);
}

/* --- A frame -------------------------------------------------------------- */

/* For a file, where the first row is already the top one. */
static void set_camera(const struct lines *lines, const struct hsr_view *view) {
  double nearest, farthest, matrix[16];
  box_depths(&lines->box, view, &nearest, &farthest);
  clip_matrix(view, nearest, farthest, matrix);
  for (int k = 1; k < 16; k += 4)
    matrix[k] = -matrix[k];
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixd(matrix);
}

static void send_corner(const struct hsr_world *world, uint32_t v) {
  glVertex3d(world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]);
}

static void send_triangles(const struct hsr_world *world,
                           const struct hsr_view *view) {
  glPolygonOffset(1, 1);
  gl2psEnable(GL2PS_POLYGON_OFFSET_FILL);
  glColor3f(1, 1, 1);
  glBegin(GL_TRIANGLES);
  for (uint32_t f = 0; f < world->n_faces; f++)
    for (uint32_t k = 0; k < 3 && lines_face_exists(world, view, f); k++)
      send_corner(world, world->mesh.vertex[world->mesh.start[f] + k]);
  glEnd();
  gl2psDisable(GL2PS_POLYGON_OFFSET_FILL);
}

static void send_edges(const struct hsr_edges *edges,
                       const struct hsr_view *view) {
  glBegin(GL_LINES);
  for (uint32_t e = 0; e < edges->n_real; e++) {
    bool relevant = false;
    for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++)
      relevant |= lines_face_exists(edges->world, view, edges->side[k].face);
    if (!relevant)
      continue;
    /* The middle of the interval that is rounded down to a byte. */
    glColor3d(((e >> 16) + 0.5) / 255.5, ((e >> 8 & 255) + 0.5) / 255.5,
              ((e & 255) + 0.5) / 255.5);
    send_corner(edges->world, edges->a[e]);
    send_corner(edges->world, edges->b[e]);
  }
  glEnd();
}

static enum hsr_status lines_draw(void *state, const struct hsr_view *view,
                                  struct hsr_error *err) {
  struct lines *lines = state;
  set_camera(lines, view);
  for (;;) {
    rewind(lines->file);
    gl2psBeginPage("edges", "hsr", NULL, GL2PS_SVG, GL2PS_BSP_SORT,
                   GL2PS_OCCLUSION_CULL | GL2PS_USE_CURRENT_VIEWPORT |
                       GL2PS_NO_PS3_SHADING | GL2PS_SILENT,
                   GL_RGBA, 0, NULL, 0, 0, 0, lines->feedback, lines->file,
                   "edges.svg");
    send_triangles(lines->triangles, view);
    send_edges(&lines->edges, view);
    if (gl2psEndPage() != GL2PS_OVERFLOW)
      return fflush(lines->file) ? hsr_fail_nomem(err) : HSR_OK;
    if (lines->feedback >= MOST_FEEDBACK)
      return hsr_fail(err, HSR_E_NOMEM, "gl2ps: the scene is too large");
    lines->feedback *= 2;
  }
}

/* --- Judging -------------------------------------------------------------- */

struct verdict {
  size_t edges, hidden_kept, visible_dropped;
  double longest_dropped; /* the longest visible part of a dropped edge,
                             pixels */
};

/* kept[e] becomes true if the colour of edge e is in the file. */
static void find_kept(const struct lines *lines, bool *kept) {
  const char *at = lines->text;
  while ((at = strstr(at, "stroke=\"#"))) {
    at += strlen("stroke=\"#");
    unsigned long e = strtoul(at, NULL, 16);
    if (e < lines->edges.n_real)
      kept[e] = true;
  }
}

static void add_edge(struct verdict *verdict, bool kept, double visible) {
  verdict->edges++;
  verdict->hidden_kept += kept && visible == 0;
  verdict->visible_dropped += !kept && visible > 0;
  if (!kept)
    verdict->longest_dropped = fmax(verdict->longest_dropped, visible);
}

/* Compares every real edge of the right drawing, in which the intervals of an
 * edge follow one another. */
static void compare(const struct lines *lines, const bool *kept,
                    const struct hsr_view *view,
                    const struct hsr_drawing *right, struct verdict *verdict) {
  const struct hsr_edges *edges = &lines->edges;
  for (size_t k = 0; k < right->n;) {
    const struct hsr_edge_name *name = &right->segment[k].edge;
    double visible = 0;
    for (;
         k < right->n && !hsr_edge_name_compare(&right->segment[k].edge, name);
         k++)
      if (!right->segment[k].invisibility)
        visible = fmax(visible, lines_length(view, right->segment[k].from,
                                             right->segment[k].to));
    uint32_t found = lines_find(edges, name);
    if (!name->implied)
      add_edge(verdict, found != UINT32_MAX && kept[found], visible);
  }
}

static enum hsr_status lines_judge(void *state, const struct hsr_view *view,
                                   json_t **answer, struct hsr_error *err) {
  struct lines *lines = state;
  struct hsr_drawing right = {.n = 0};
  struct verdict verdict = {.edges = 0};
  bool *kept = calloc((size_t)lines->edges.n_real + 1, sizeof *kept);
  enum hsr_status status =
      kept ? lines_draw_right(lines->edges.world, view, &right, err)
           : hsr_fail_nomem(err);
  if (!status) {
    find_kept(lines, kept);
    compare(lines, kept, view, &right, &verdict);
    *answer = json_pack(
        "{sI sI sI sI sf}", "compared", (json_int_t)verdict.edges, "mismatches",
        (json_int_t)(verdict.hidden_kept + verdict.visible_dropped),
        "hidden_kept", (json_int_t)verdict.hidden_kept, "visible_dropped",
        (json_int_t)verdict.visible_dropped, "longest_dropped_px",
        verdict.longest_dropped);
  }
  free(kept);
  hsr_drawing_free(&right);
  return status;
}

static void lines_release(void *state) {
  struct lines *lines = state;
  if (!lines)
    return;
  if (lines->file)
    fclose(lines->file);
  free(lines->text);
  offscreen_close(&lines->offscreen);
  hsr_edges_free(&lines->edges);
  free(lines);
}

/* --- The peer ------------------------------------------------------------- */

static void lines_version(char *text) {
  snprintf(text, PEER_VERSION, "%d.%d.%d", GL2PS_MAJOR_VERSION,
           GL2PS_MINOR_VERSION, GL2PS_PATCH_VERSION);
}

const struct peer peer_gl2ps = {
    .name = "gl2ps",
    .title = "gl2ps, BSP sort and occlusion culling",
    .source = "C. Geuzaine, GL2PS: an OpenGL to PostScript printing library",
    .what = "Hidden lines by painting over. A frame sends all existing "
            "triangles and their edges through OpenGL's feedback, sorts, culls "
            "and writes SVG to memory. Set-up, which is not part of a frame, "
            "finds the edges. Mismatches are edges that are kept but wholly "
            "hidden, and edges that are dropped but partly visible. Parts of "
            "an edge are not judged, as gl2ps does not cut edges.",
    .kind = "segments",
    .demands = &takes_triangles,
    .version = lines_version,
    .setup = lines_setup,
    .draw = lines_draw,
    .judge = lines_judge,
    .release = lines_release};
