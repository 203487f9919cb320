/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gl2ps beside Appel's algorithm: which edges of a scene does it keep, that
 * removes hidden primitives from OpenGL's feedback by a tree of images?
 *
 * Asked       the edges of the correct drawing, each of a colour of its own, as
 *             OpenGL lines, before the existing faces as triangles, which are
 *             moved back a little by its polygon offset, as its manual tells.
 * Told        an edge is kept if its colour occurs in the SVG file. gl2ps does
 *             not cut lines: a kept one is drawn whole, and hidden parts are
 *             painted over. So an edge is wrong only if none of it is visible
 *             and it is kept, or if some of it is and it is not.
 *
 * usage: gl2ps-lines SCENE [VIEW [simple|bsp]] */
#include "algorithms/setup.h"
#include "scenes/scenes.h"

#include <GL/osmesa.h>
#include <gl2ps.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIZE = 512 };

struct edge {
  struct hsr_edge_name name;
  double visible; /* the longest visible part, pixels */
  bool kept;
};

static void stop(const char *what) {
  fprintf(stderr, "gl2ps-lines: %s\n", what);
  exit(4);
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* --- Ours --------------------------------------------------------------------
 */

static double draw(const char *algorithm, const struct hsr_world *world,
                   const struct hsr_view *view, struct hsr_drawing *drawing) {
  struct hsr_error err;
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = &tally, .drawing = drawing};
  if (hsr_setup_init(&setup, hsr_algorithm_find(algorithm)->plain, world, &err))
    stop(err.text);
  double begin = now();
  if (hsr_setup_render(&setup, &job, &err))
    stop(err.text);
  double seconds = now() - begin;
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return seconds;
}

static double length_on_screen(const struct hsr_view *view,
                               const struct hsr_segment *s) {
  double at[2][2];
  for (int end = 0; end < 2; end++) {
    double h[3] = {0, 0, 0};
    for (int row = 0; row < 3; row++)
      for (int k = 0; k < 3; k++)
        h[row] +=
            view->screen[row][k] * ((end ? s->to[k] : s->from[k]) - view->E[k]);
    at[end][0] = h[0] / h[2];
    at[end][1] = h[1] / h[2];
  }
  return hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
}

/* The edges of a drawing. */
static size_t collect(const struct hsr_drawing *drawing,
                      const struct hsr_view *view, struct edge *edge) {
  size_t n = 0;
  for (size_t k = 0; k < drawing->n; k++) {
    const struct hsr_segment *s = &drawing->segment[k];
    if (s->edge.implied)
      continue;
    if (!n || hsr_edge_name_compare(&edge[n - 1].name, &s->edge))
      edge[n++] = (struct edge){.name = s->edge};
    if (!s->invisibility)
      edge[n - 1].visible =
          fmax(edge[n - 1].visible, length_on_screen(view, s));
  }
  return n;
}

/* --- Theirs ------------------------------------------------------------------
 */

static void set_camera(const struct hsr_world *world,
                       const struct hsr_view *view) {
  /* As in OpenGL's own frame: x R, y U, -F; depth between the nearest and the
   * farthest vertex before the eye. */
  double low = INFINITY, high = 0;
  for (uint32_t v = 0; v < world->n_vertices; v++) {
    double w = view->screen[2][0] * (world->x[v] - view->E[0]) +
               view->screen[2][1] * (world->y[v] - view->E[1]) +
               view->screen[2][2] * (world->z[v] - view->E[2]);
    low = w > 0 ? fmin(low, w) : low;
    high = fmax(high, w);
  }
  low *= 0.99;
  high *= 1.01;
  /* Clip coordinates from (w x, w y, w): rows of view->screen made symmetric.
   */
  GLdouble m[16] = {0};
  for (int k = 0; k < 3; k++) {
    double w = view->screen[2][k];
    m[4 * k] = 2 * view->screen[0][k] / view->m - w;
    m[4 * k + 1] = w - 2 * view->screen[1][k] / view->n;
    m[4 * k + 2] = w * (high + low) / (high - low);
    m[4 * k + 3] = w;
  }
  for (int row = 0; row < 4; row++)
    m[12 + row] = -(m[row] * view->E[0] + m[4 + row] * view->E[1] +
                    m[8 + row] * view->E[2]);
  m[14] -= 2 * high * low / (high - low);
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  glMatrixMode(GL_MODELVIEW);
  glLoadMatrixd(m);
}

static void corner(const struct hsr_world *world, uint32_t v) {
  glVertex3d(world->x[v], world->y[v], world->z[v]);
}

static bool exists(const struct hsr_world *world, const struct hsr_view *view,
                   uint32_t f) {
  double side = world->nx[f] * (view->E[0] - world->px[f]) +
                world->ny[f] * (view->E[1] - world->py[f]) +
                world->nz[f] * (view->E[2] - world->pz[f]);
  return side > 0 || !world->one_sided[f];
}

static void send(const struct hsr_world *world, const struct hsr_view *view,
                 const struct edge *edge, size_t n) {
  glPolygonOffset(1, 1);
  gl2psEnable(GL2PS_POLYGON_OFFSET_FILL);
  glColor3f(1, 1, 1);
  glBegin(GL_TRIANGLES);
  for (uint32_t f = 0; f < world->n_faces; f++)
    for (uint32_t k = world->start[f] + 2;
         exists(world, view, f) && k < world->start[f + 1]; k++) {
      corner(world, world->vertex[world->start[f]]);
      corner(world, world->vertex[k - 1]);
      corner(world, world->vertex[k]);
    }
  glEnd();
  gl2psDisable(GL2PS_POLYGON_OFFSET_FILL);
  glBegin(GL_LINES);
  for (size_t k = 0; k < n; k++) {
    glColor3d((double)(k >> 16 & 255) / 255.5 + 0.5 / 255.5,
              (double)(k >> 8 & 255) / 255.5 + 0.5 / 255.5,
              (double)(k & 255) / 255.5 + 0.5 / 255.5);
    corner(world, edge[k].name.a);
    corner(world, edge[k].name.b);
  }
  glEnd();
}

/* Marks the edges whose colours are in the file. */
static void find_kept(FILE *file, struct edge *edge, size_t n) {
  char line[4096];
  rewind(file);
  while (fgets(line, sizeof line, file)) {
    const char *colour = strstr(line, "stroke=\"#");
    size_t k = colour ? strtoul(colour + 9, NULL, 16) : n;
    if (k < n)
      edge[k].kept = true;
  }
}

static double run_gl2ps(const struct hsr_world *world,
                        const struct hsr_view *view, GLint sort,
                        struct edge *edge, size_t n) {
  FILE *file = tmpfile();
  if (!file)
    stop("no file");
  double begin = now();
  GLint state = GL2PS_OVERFLOW;
  for (GLint size = 1 << 24; state == GL2PS_OVERFLOW; size *= 2) {
    rewind(file);
    gl2psBeginPage("edges", "hsr", NULL, GL2PS_SVG, sort,
                   GL2PS_OCCLUSION_CULL | GL2PS_USE_CURRENT_VIEWPORT |
                       GL2PS_NO_PS3_SHADING | GL2PS_SILENT,
                   GL_RGBA, 0, NULL, 0, 0, 0, size, file, "edges.svg");
    send(world, view, edge, n);
    state = gl2psEndPage();
  }
  double seconds = now() - begin;
  find_kept(file, edge, n);
  fclose(file);
  return seconds;
}

/* --- Comparison --------------------------------------------------------------
 */

static void compare(const struct edge *edge, size_t n) {
  size_t kept = 0, hidden = 0, lost = 0;
  double longest = 0;
  for (size_t k = 0; k < n; k++) {
    kept += edge[k].kept;
    hidden += edge[k].kept && edge[k].visible == 0;
    lost += !edge[k].kept && edge[k].visible > 0;
    if (!edge[k].kept)
      longest = fmax(longest, edge[k].visible);
  }
  printf("%zu edges, gl2ps keeps %zu: %zu of them are hidden wholly; it drops "
         "%zu that are visible somewhere, the longest for %.1f pixels\n",
         n, kept, hidden, lost, longest);
}

int main(int argc, char **argv) {
  if (argc < 2 || argc > 4) {
    fputs("usage: gl2ps-lines SCENE [VIEW [simple|bsp]]\n", stderr);
    return 2;
  }
  struct hsr_import import = {.drop_degenerate = true};
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_error err;
  long number = argc > 2 ? strtol(argv[2], NULL, 10) : 1;
  if (hsr_scene_open(argv[1], &import, &scene, &err) ||
      hsr_world_init(&world, scene, &err))
    stop(err.text);
  if (number < 1 || number > (long)scene->n_views)
    stop("no such view");
  if (hsr_view_init(&view, &scene->views[number - 1], SIZE, SIZE, &err))
    stop(err.text);

  struct hsr_drawing wanted = {.n = 0}, ours = {.n = 0};
  draw("line-oracle", &world, &view, &wanted);
  double appel = draw("appel-visible", &world, &view, &ours);
  struct edge *edge = calloc(wanted.n + 1, sizeof *edge);
  OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, NULL);
  void *pixels = malloc((size_t)SIZE * SIZE * 4);
  if (!edge || !pixels || !context ||
      !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, SIZE, SIZE))
    stop("no OpenGL");
  size_t n = collect(&wanted, &view, edge);
  set_camera(&world, &view);
  glEnable(GL_DEPTH_TEST);
  GLint sort = argc > 3 && !strcmp(argv[3], "simple") ? GL2PS_SIMPLE_SORT
                                                      : GL2PS_BSP_SORT;
  double theirs = run_gl2ps(&world, &view, sort, edge, n);
  compare(edge, n);
  printf("ms: appel-visible %.1f, gl2ps %.1f\n", 1e3 * appel, 1e3 * theirs);

  OSMesaDestroyContext(context);
  free(pixels);
  free(edge);
  hsr_drawing_free(&wanted);
  hsr_drawing_free(&ours);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return 0;
}
