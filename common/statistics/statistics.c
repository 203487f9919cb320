/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table I, measured.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, section II,
 *             "Environment Complexity Definitions", and appendix A. The paper
 *             defines in words. The comment above each function says what was
 *             chosen to make the words measurable, and why.
 * Picture     the rectangle [0, m] x [0, n] of the screen, border included, of
 *             what lies at t >= near.
 * Exact       which faces exist and from which side they are seen, spans,
 *             penetrations, and the picture given.
 * In doubles  clipping, heights, lengths and crossings. They decide nothing but
 *             the statistics.
 * Cost        all but X_r, X_v and X_f is linear in the faces, the spans and
 *             the length of the edges; edges are sorted once. */
#include "common/statistics/statistics.h"
#include "common/view/clip.h"
#include "common/exact/predicates.h"
#include "common/exact/screen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A face's use of an edge. */
struct use {
  uint32_t a, b; /* vertices, a < b */
  uint32_t face; /* which exists */
  int side;      /* on the screen, face lies left (+1) or right of a -> b */
};

/* A relevant edge, shared ones once. */
struct edge {
  const struct use *use; /* of its faces that exist, relevant or not */
  size_t n_uses;
  double x[2], y[2]; /* the ends of its image, clipped, pixels */
  double q[2];       /* 1/t there; linear on the screen in between */
  double length;     /* pixels */
};

struct survey {
  const struct hsr_world *world;
  const uint32_t *ids; /* NULL if there is none */
  struct hsr_table1 *table;
  struct hsr_view view; /* the whole picture */
  double side[5][3];    /* the picture: side . P + margin >= 0 for all */
  double margin[5];

  struct hsr_arena arena;
  struct hsr_tally tally;
  struct hsr_screen screen;
  double (*point)[3];  /* a vertex: homogeneous (w sx, w sy, w) */
  signed char *facing; /* a face: +1 seen from its front, -1 back, 0 edge on */
  bool *is_relevant;   /* a face */
  uint32_t *relevant;  /* ids, ascending */
  uint32_t n_relevant;
  uint32_t largest_face;
  struct use *uses;
  size_t n_uses;
  struct edge *edges;
  size_t n_edges;
};

/* --- The picture on the screen -------------------------------------------- */

static void find_sides(struct survey *s) {
  const double m = s->view.m, n = s->view.n;
  const bool parallel = s->view.parallel;
  const double side[5][3] = {{0, 0, 1},
                             {1, 0, 0},
                             {-1, 0, parallel ? 0 : m},
                             {0, 1, 0},
                             {0, -1, parallel ? 0 : n}};
  memcpy(s->side, side, sizeof side);
  s->margin[0] = -s->view.near;
  s->margin[2] = parallel ? m : 0;
  s->margin[4] = parallel ? n : 0;
}

static void find_points(struct survey *s) {
  const struct hsr_world *world = s->world;
  for (uint32_t v = 0; v < world->mesh.n_vertices; v++) {
    const double at[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
    hsr_view_project(&s->view, at, s->point[v]);
  }
}

static enum hsr_status find_facings(struct survey *s) {
  const struct hsr_world *world = s->world;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    struct hsr_loop loop = {world->mesh.x,
                            world->mesh.y,
                            world->mesh.z,
                            1,
                            world->mesh.vertex + world->mesh.start[f],
                            hsr_face_size(world, f)};
    s->facing[f] = s->screen.facing[f];
    if (!s->facing[f])
      s->facing[f] = (signed char)hsr_exact_eye_side(&s->view, loop,
                                                     &s->tally.out_of_memory);
    if (loop.n > s->largest_face)
      s->largest_face = loop.n;
  }
  return s->tally.out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

static bool exists(const struct survey *s, uint32_t f) {
  return s->facing[f] > 0 || (s->facing[f] < 0 && !s->world->mesh.one_sided[f]);
}

/* The screen point of a homogeneous point within the picture, which rounding
 * may have moved a little out. False at the eye. */
static bool project(const struct survey *s, const double p[3], double *x,
                    double *y) {
  double w = hsr_view_w(&s->view, p);
  if (!(w > 0))
    return false;
  *x = fmin(fmax(p[0] / w, 0), s->view.m);
  *y = fmin(fmax(p[1] / w, 0), s->view.n);
  return true;
}

/* --- Faces ---------------------------------------------------------------- */

/* How many points a face of n vertices may have after five clippings. */
static size_t clipped_size(size_t n) {
  for (int k = 0; k < 5; k++)
    n += n / 2 + 1;
  return n;
}

/* The height in pixels of the part of face f in the picture; negative if there
 * is none. `room` is two arrays of clipped_size points. */
static double clipped_height(const struct survey *s, uint32_t f,
                             double (*room[2])[3]) {
  const uint32_t *vertex = s->world->mesh.vertex + s->world->mesh.start[f];
  double(*in)[3] = room[0], (*out)[3] = room[1];
  int n = (int)hsr_face_size(s->world, f);
  for (int k = 0; k < n; k++)
    memcpy(in[k], s->point[vertex[k]], sizeof in[k]);
  for (int k = 0; k < 5 && n; k++) {
    n = hsr_clip((const double(*)[3])in, n, s->side[k], s->margin[k], out);
    double(*swap)[3] = in;
    in = out;
    out = swap;
  }
  double top = INFINITY, bottom = -INFINITY;
  for (int k = 0; k < n; k++) {
    double x, y;
    if (project(s, in[k], &x, &y)) {
      top = fmin(top, y);
      bottom = fmax(bottom, y);
    }
  }
  return bottom - top;
}

/* F_t    all faces of all instances.
 * F_r    the faces that exist for the eye (docs/correct-picture.md) and have a
 *        part in the picture. A face that only touches the border counts:
 *        clipping keeps it, and rounding could not tell it from one that
 *        reaches in. Faces that others hide count, and so do those too small to
 *        cover a sample: the culls of the paper remove neither.
 * H_f    the height in scan lines, a real number, of the part in the picture,
 *        averaged over the relevant faces: "as seen by the observer", who does
 *        not see the rest. */
static enum hsr_status measure_faces(struct survey *s) {
  size_t size = clipped_size(s->largest_face);
  double(*room[2])[3] = {hsr_arena_array(&s->arena, size, sizeof *room[0]),
                         hsr_arena_array(&s->arena, size, sizeof *room[1])};
  if (!room[0] || !room[1])
    return HSR_E_NOMEM;
  double sum = 0;
  for (uint32_t f = 0; f < s->world->n_faces; f++) {
    double height = exists(s, f) ? clipped_height(s, f, room) : -1;
    s->is_relevant[f] = height >= 0;
    if (!s->is_relevant[f])
      continue;
    s->relevant[s->n_relevant++] = f;
    sum += height;
  }
  s->table->F_t = s->world->n_faces;
  s->table->F_r = s->n_relevant;
  if (s->n_relevant)
    s->table->H_f = sum / s->n_relevant;
  return HSR_OK;
}

/* C_t    the clusters are the instances: what the scene says belongs together.
 * C_r    those with a relevant face.
 * F_c    F_t / C_t, as in Table II. */
static void measure_clusters(struct survey *s) {
  const struct hsr_world *world = s->world;
  uint32_t total = world->roster.scene->n_instances, n_relevant = 0;
  for (uint32_t k = 0; k < s->n_relevant; k++)
    if (!k || world->mesh.instance[s->relevant[k]] !=
                  world->mesh.instance[s->relevant[k - 1]])
      n_relevant++;
  s->table->C_t = total;
  s->table->C_r = n_relevant;
  s->table->F_c = s->table->F_t / total;
}

/* --- Segments ------------------------------------------------------------- */

/* D_c    the relevant faces that cover a sample, averaged over all samples of
 *        the picture, whose rays stand for the "arbitrary" ones. The paper
 *        speaks of front faces, since its back faces are culled; two-sided
 *        faces are not, and count either way.
 * S_f    the segments: a face has, on a scan line, as many as it has runs of
 *        samples. A stretch between two samples is none, since no scan-line
 *        algorithm meets it. Two runs of one face that adjoin are two.
 * S_l    S_f / n. */
static enum hsr_status measure_segments(struct survey *s) {
  int *columns = HSR_NEW(&s->arena, int, (size_t)s->largest_face + 4);
  if (!columns)
    return HSR_E_NOMEM;
  uint64_t n_covered = 0, n_segments = 0;
  for (uint32_t r = 0; r < s->screen.n_relevant; r++) {
    uint32_t f = s->screen.relevant[r];
    const struct hsr_bounds *bounds = &s->screen.bounds[f];
    struct hsr_face_rows rows;
    hsr_face_rows_begin(&rows, &s->screen, f, &s->tally);
    for (int j = bounds->y0; j < bounds->y1; j++) {
      int n = hsr_face_rows_spans(&rows, j, columns, &s->tally);
      for (int k = 0; k < n; k += 2) {
        n_covered += (uint64_t)(columns[k + 1] - columns[k]);
        n_segments += columns[k + 1] > columns[k];
      }
    }
  }
  s->table->D_c = (double)n_covered / ((double)s->view.m * s->view.n);
  s->table->S_f = (double)n_segments;
  s->table->S_l = s->table->S_f / s->view.n;
  return s->tally.out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

/* S_v    the visible segments of a scan line: its runs of samples that show the
 *        same face, averaged over the lines. A segment that is hidden in its
 *        middle shows as two. Background is no face's segment. */
static enum hsr_status measure_visible_segments(struct survey *s,
                                                struct hsr_error *err) {
  uint64_t n_runs = 0;
  for (int j = 0; j < s->view.n; j++) {
    const uint32_t *row = s->ids + (size_t)j * (size_t)s->view.m;
    uint32_t previous = HSR_BACKGROUND;
    for (int i = 0; i < s->view.m; i++) {
      if (row[i] != HSR_BACKGROUND && row[i] >= s->world->n_faces)
        return hsr_fail(err, HSR_E_USAGE,
                        "sample (%d, %d) of the picture shows no face", i, j);
      n_runs += row[i] != previous && row[i] != HSR_BACKGROUND;
      previous = row[i];
    }
  }
  s->table->S_v = (double)n_runs / s->view.n;
  return HSR_OK;
}

/* --- Edges ---------------------------------------------------------------- */

static int compare_uses(const void *p, const void *q) {
  const struct use *u = p, *v = q;
  if (u->a != v->a)
    return u->a < v->a ? -1 : 1;
  if (u->b != v->b)
    return u->b < v->b ? -1 : 1;
  return (u->face > v->face) - (u->face < v->face);
}

/* All uses of edges by faces that exist, the uses of one edge together. The
 * inside of a face is on the left of its loop when seen from the front. */
static void find_uses(struct survey *s) {
  const struct hsr_world *world = s->world;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    if (!exists(s, f))
      continue;
    uint32_t from = world->mesh.vertex[world->mesh.start[f + 1] - 1];
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
      uint32_t to = world->mesh.vertex[k];
      s->uses[s->n_uses++] = from < to
                                 ? (struct use){from, to, f, s->facing[f]}
                                 : (struct use){to, from, f, -s->facing[f]};
      from = to;
    }
  }
  qsort(s->uses, s->n_uses, sizeof *s->uses, compare_uses);
}

/* Clips the edge from a to b to the picture: false if nothing is left. */
static bool clip_edge(const struct survey *s, const double a[3],
                      const double b[3], struct edge *edge) {
  double from = 0, to = 1;
  for (int k = 0; k < 5; k++) {
    const double *side = s->side[k];
    double ha = side[0] * a[0] + side[1] * a[1] + side[2] * a[2];
    double hb = side[0] * b[0] + side[1] * b[1] + side[2] * b[2];
    ha += s->margin[k];
    hb += s->margin[k];
    if (ha < 0 && hb < 0)
      return false;
    if (ha < 0)
      from = fmax(from, ha / (ha - hb));
    else if (hb < 0)
      to = fmin(to, ha / (ha - hb));
  }
  if (from > to)
    return false;
  for (int end = 0; end < 2; end++) {
    double p[3], t = end ? to : from;
    for (int k = 0; k < 3; k++)
      p[k] = t < 1 ? a[k] + t * (b[k] - a[k]) : b[k];
    if (!project(s, p, &edge->x[end], &edge->y[end]))
      return false;
    edge->q[end] = s->view.parallel ? -p[2] : 1 / p[2];
  }
  edge->length = hypot(edge->x[1] - edge->x[0], edge->y[1] - edge->y[0]);
  return true;
}

/* E_t    all sides of all faces.
 * E_r    of these, the sides of relevant faces of which something is in the
 *        picture.
 * E_s    the same, but sides between the same two vertices once. Vertices are
 *        the same by number, not by place: only a shared vertex can tell an
 *        algorithm that an edge is shared.
 * E_c    the edges among E_s where the number of faces that a ray pierces
 *        changes: on the screen, more of the edge's faces lie on one side of it
 *        than on the other. With two faces that is the outline of a one-sided
 *        solid, where one of them does not exist, or the fold of a two-sided
 *        surface, where both lie on one side, however they are wound. An edge
 *        of a single face always is one. Put so, the definition also holds
 *        where three or more faces meet. */
static enum hsr_status measure_edges(struct survey *s) {
  s->uses = HSR_NEW(&s->arena, struct use, s->world->mesh.n_corners);
  if (!s->uses)
    return HSR_E_NOMEM;
  find_uses(s);
  s->edges = HSR_NEW(&s->arena, struct edge, s->n_uses);
  if (!s->edges)
    return HSR_E_NOMEM;
  uint64_t n_relevant = 0, n_contour = 0;
  for (size_t k = 0, next; k < s->n_uses; k = next) {
    const struct use *use = s->uses + k;
    uint64_t n_faces = 0;
    int side = 0;
    for (next = k; next < s->n_uses && s->uses[next].a == use->a &&
                   s->uses[next].b == use->b;
         next++) {
      n_faces += s->is_relevant[s->uses[next].face];
      side += s->uses[next].side;
    }
    struct edge edge = {.use = use, .n_uses = next - k};
    if (!n_faces || !clip_edge(s, s->point[use->a], s->point[use->b], &edge))
      continue;
    n_relevant += n_faces;
    n_contour += side != 0;
    s->edges[s->n_edges++] = edge;
  }
  s->table->E_t = s->world->mesh.n_corners;
  s->table->E_r = (double)n_relevant;
  s->table->E_s = (double)s->n_edges;
  s->table->E_c = (double)n_contour;
  return HSR_OK;
}

/* --- Visible edges -------------------------------------------------------- */

/* By how much, relative, a depth must be nearer to hide another: a face does
 * not hide the edges of what stands on it. */
static const double CLEARLY = 0x1p-30;

static double depth(const struct survey *s, uint32_t f, double x, double y) {
  const struct hsr_depth_plane *p = &s->screen.plane[f];
  return p->a * x + p->b * y + p->c;
}

/* Whether face f, which sample (i, j) shows, is in front of a face of the edge
 * that lies on that side of it. */
static bool before_a_face(const struct survey *s, uint32_t f, int i, int j,
                          const struct edge *e) {
  double x = hsr_sample_x(&s->view, i), y = hsr_sample_y(&s->view, j);
  double dx = e->x[1] - e->x[0], dy = e->y[1] - e->y[0];
  int side = dx * (y - e->y[0]) < dy * (x - e->x[0]) ? 1 : -1;
  double q = depth(s, f, x, y);
  for (size_t k = 0; k < e->n_uses; k++) {
    uint32_t g = e->use[k].face;
    double error = s->screen.plane[f].error + s->screen.plane[g].error;
    if (s->world->mesh.plane[f] == s->world->mesh.plane[g] ||
        (e->use[k].side == side &&
         !(q - depth(s, g, x, y) > error + CLEARLY * fabs(q))))
      return false;
  }
  return true;
}

static int nearest_sample(double at, double offset, int n) {
  double k = floor(at - offset);
  return k < 0 ? 0 : k >= n ? n - 1 : (int)k;
}

/* Whether the edge is visible at parameter t of its image, by the picture's
 * nearest sample. It is unless the face shown there hides it; that face
 *   is nearer, on its plane, than the point of the edge,
 *   is none of the edge's faces, nor in the plane of one, and
 *   is nearer, at the sample, than those of the edge's faces that lie on the
 *   sample's side of the edge.
 * The last condition distinguishes a face that hides the edge from the next
 * small face of the same surface: if that surface is convex, the plane of the
 * next face passes in front of the edge too. One could ask instead for a sample
 * beside the edge that shows one of its faces. That loses the edges of faces
 * too small to cover a sample: a quarter of L_v for a mesh of 89,000 triangles
 * at 512 x 512. The conditions above lose a hundredth. Both were measured
 * against pictures of 16 times the resolution. */
static bool visible(const struct survey *s, const struct edge *e, double t) {
  double x = e->x[0] + t * (e->x[1] - e->x[0]);
  double y = e->y[0] + t * (e->y[1] - e->y[0]);
  double q = e->q[0] + t * (e->q[1] - e->q[0]);
  int i = nearest_sample(x, s->view.offset_x, s->view.m);
  int j = nearest_sample(y, s->view.offset_y, s->view.n);
  uint32_t f = s->ids[(size_t)j * (size_t)s->view.m + (size_t)i];
  if (f == HSR_BACKGROUND)
    return true;
  double nearer = depth(s, f, x, y) - q;
  return !(nearer > s->screen.plane[f].error + CLEARLY * fabs(q)) ||
         !before_a_face(s, f, i, j, e);
}

/* L_v    the length of the images of the edges among E_s where they are
 *        visible: each is gone through in steps of half a pixel or less, whose
 *        middles are looked at. Implied edges, where faces penetrate, are not
 *        among them. An estimate: at the end of what hides an edge it is off by
 *        up to half a pixel, either way. */
static void measure_visible_edges(struct survey *s) {
  double sum = 0;
  for (size_t k = 0; k < s->n_edges; k++) {
    const struct edge *e = &s->edges[k];
    int n_steps = (int)ceil(2 * e->length), n_visible = 0;
    for (int step = 0; step < n_steps; step++)
      n_visible += visible(s, e, (step + 0.5) / n_steps);
    if (n_steps)
      sum += e->length * n_visible / n_steps;
  }
  s->table->L_v = sum;
}

/* --- Crossings ------------------------------------------------------------ */

/* An edge whose end lies within this many pixels of another edge touches it and
 * does not cross it. It is above the rounding of projection and clipping. It is
 * also far above the error of a point of crossing, which therefore lies within
 * both edges, however flat they cross. */
#define TOUCH (4 * HSR_DELTA)

/* A uniform grid over the picture's edges. A cell lists the edges that come
 * within MARGIN of it, and so both edges of every crossing in it. */
#define MARGIN 0x1p-6
struct grid {
  double x, y, cell; /* corner and width, pixels */
  int columns, rows;
  size_t *start;   /* columns * rows + 1 offsets into entry[] */
  uint32_t *entry; /* edges */
};

struct range {
  int from, to; /* inclusive */
};

static int grid_index(double at, double origin, double cell, int n) {
  double k = floor((at - origin) / cell);
  return k < 0 ? 0 : k >= n ? n - 1 : (int)k;
}

static struct range grid_rows(const struct grid *g, const struct edge *e) {
  double lo = fmin(e->y[0], e->y[1]), hi = fmax(e->y[0], e->y[1]);
  return (struct range){grid_index(lo - MARGIN, g->y, g->cell, g->rows),
                        grid_index(hi + MARGIN, g->y, g->cell, g->rows)};
}

/* The columns of cells that the edge comes within MARGIN of, in a row. */
static struct range grid_columns(const struct grid *g, const struct edge *e,
                                 int row) {
  double top = g->y + row * g->cell - MARGIN;
  double bottom = g->y + (row + 1) * g->cell + MARGIN;
  double dx = e->x[1] - e->x[0], dy = e->y[1] - e->y[0];
  double from = 0, to = 1;
  if (dy != 0) {
    double a = (top - e->y[0]) / dy, b = (bottom - e->y[0]) / dy;
    from = fmin(fmax(fmin(a, b), 0), 1);
    to = fmin(fmax(fmax(a, b), 0), 1);
  }
  double a = e->x[0] + from * dx, b = e->x[0] + to * dx;
  return (struct range){
      grid_index(fmin(a, b) - MARGIN, g->x, g->cell, g->columns),
      grid_index(fmax(a, b) + MARGIN, g->x, g->cell, g->columns)};
}

/* As many cells as edges, but none much smaller than the edges are long, so
 * that the entries stay a small multiple of the edges. */
static void grid_place(struct grid *g, const struct survey *s) {
  double x1 = 0, y1 = 0, length = 0, n = (double)s->n_edges;
  g->x = g->y = INFINITY;
  for (size_t k = 0; k < s->n_edges; k++) {
    const struct edge *e = &s->edges[k];
    g->x = fmin(g->x, fmin(e->x[0], e->x[1]));
    g->y = fmin(g->y, fmin(e->y[0], e->y[1]));
    x1 = fmax(x1, fmax(e->x[0], e->x[1]));
    y1 = fmax(y1, fmax(e->y[0], e->y[1]));
    length += e->length;
  }
  double width = x1 - g->x, height = y1 - g->y;
  g->cell = fmax(sqrt(width * height / n), fmax(length / (4 * n), 4 * MARGIN));
  g->columns = (int)(width / g->cell) + 1;
  g->rows = (int)(height / g->cell) + 1;
}

/* Advances at[c] by one for every edge in cell c. If g->entry is there, first
 * writes the edge to the place at[c]. */
static void grid_list(const struct grid *g, const struct survey *s,
                      size_t *at) {
  for (uint32_t k = 0; k < s->n_edges; k++) {
    struct range rows = grid_rows(g, &s->edges[k]);
    for (int row = rows.from; row <= rows.to; row++) {
      struct range columns = grid_columns(g, &s->edges[k], row);
      size_t *cell = at + (size_t)row * (size_t)g->columns;
      for (int c = columns.from; c <= columns.to; c++) {
        if (g->entry)
          g->entry[cell[c]] = k;
        cell[c]++;
      }
    }
  }
}

/* Lists the edges twice, to count and to write. Writing moves start[c + 1] from
 * the beginning of cell c to its end. */
static enum hsr_status grid_fill(struct grid *g, struct survey *s) {
  size_t n_cells = (size_t)g->columns * (size_t)g->rows;
  g->start = HSR_NEW_ZEROED(&s->arena, size_t, n_cells + 2);
  if (!g->start)
    return HSR_E_NOMEM;
  g->entry = NULL;
  grid_list(g, s, g->start + 2);
  for (size_t c = 2; c < n_cells + 2; c++)
    g->start[c] += g->start[c - 1];
  g->entry = HSR_NEW(&s->arena, uint32_t, g->start[n_cells + 1]);
  if (!g->entry)
    return HSR_E_NOMEM;
  grid_list(g, s, g->start + 1);
  return HSR_OK;
}

static bool share_vertex(const struct edge *e, const struct edge *f) {
  return e->use->a == f->use->a || e->use->a == f->use->b ||
         e->use->b == f->use->a || e->use->b == f->use->b;
}

/* Whether the line of e separates the ends of f, and where on f. */
static bool separates(const struct edge *e, const struct edge *f, double *t) {
  double dx = e->x[1] - e->x[0], dy = e->y[1] - e->y[0];
  double a = dx * (f->y[0] - e->y[0]) - dy * (f->x[0] - e->x[0]);
  double b = dx * (f->y[1] - e->y[0]) - dy * (f->x[1] - e->x[0]);
  *t = a / (a - b);
  return (a < 0) != (b < 0) && fmin(fabs(a), fabs(b)) > TOUCH * e->length;
}

static size_t grid_cell(const struct grid *g, double x, double y) {
  size_t row = (size_t)grid_index(y, g->y, g->cell, g->rows);
  return row * (size_t)g->columns +
         (size_t)grid_index(x, g->x, g->cell, g->columns);
}

/* Whether e and f cross in cell c, and where on each. Other cells may list both
 * too, and find that they do not cross there. */
static bool cross_in_cell(const struct edge *e, const struct edge *f,
                          const struct grid *g, size_t c, double *on_e,
                          double *on_f) {
  return !share_vertex(e, f) && separates(e, f, on_f) &&
         separates(f, e, on_e) &&
         grid_cell(g, e->x[0] + *on_e * (e->x[1] - e->x[0]),
                   e->y[0] + *on_e * (e->y[1] - e->y[0])) == c;
}

static bool nearer_visible(const struct survey *s, const struct edge *e,
                           double on_e, const struct edge *f, double on_f) {
  double e_q = e->q[0] + on_e * (e->q[1] - e->q[0]);
  double f_q = f->q[0] + on_f * (f->q[1] - f->q[0]);
  return e_q > f_q ? visible(s, e, on_e) : visible(s, f, on_f);
}

/* X_r    the pairs of edges among E_s whose images cross in the picture: in a
 *        point inside both, so that neither edges of one vertex nor edges that
 *        touch are crossing.
 * X_v    those of them where the nearer edge is visible. */
static enum hsr_status measure_crossings(struct survey *s) {
  struct grid g = {0};
  uint64_t n_crossings = 0, n_visible = 0;
  if (s->n_edges) {
    grid_place(&g, s);
    if (grid_fill(&g, s))
      return HSR_E_NOMEM;
  }
  for (size_t c = 0; c < (size_t)g.columns * (size_t)g.rows; c++)
    for (size_t k = g.start[c]; k < g.start[c + 1]; k++)
      for (size_t l = k + 1; l < g.start[c + 1]; l++) {
        const struct edge *e = &s->edges[g.entry[k]];
        const struct edge *f = &s->edges[g.entry[l]];
        double on_e, on_f;
        if (!cross_in_cell(e, f, &g, c, &on_e, &on_f))
          continue;
        n_crossings++;
        n_visible += s->ids && nearer_visible(s, e, on_e, f, on_f);
      }
  s->table->X_r = (double)n_crossings;
  if (s->ids)
    s->table->X_v = (double)n_visible;
  return HSR_OK;
}

/* --- All of it ------------------------------------------------------------ */

static enum hsr_status set_up(struct survey *s) {
  size_t n_vertices = s->world->mesh.n_vertices, n_faces = s->world->n_faces;
  s->view.window = (struct hsr_window){0, 0, s->view.m, s->view.n};
  s->point = hsr_arena_array(&s->arena, n_vertices, sizeof *s->point);
  s->facing = HSR_NEW(&s->arena, signed char, n_faces);
  s->is_relevant = HSR_NEW(&s->arena, bool, n_faces);
  s->relevant = HSR_NEW(&s->arena, uint32_t, n_faces);
  if (!s->point || !s->facing || !s->is_relevant || !s->relevant ||
      hsr_screen_make(&s->screen, s->world, &s->view, &s->arena, &s->tally))
    return HSR_E_NOMEM;
  find_sides(s);
  find_points(s);
  return find_facings(s);
}

static enum hsr_status measure(struct survey *s, struct hsr_error *err) {
  enum hsr_status status;
  s->table->n = s->view.n;
  s->table->m = s->view.m;
  if (set_up(s) || measure_faces(s) || measure_segments(s) || measure_edges(s))
    return hsr_fail_nomem(err);
  measure_clusters(s);
  if (s->ids) {
    status = measure_visible_segments(s, err);
    if (status)
      return status;
    measure_visible_edges(s);
  }
  if (measure_crossings(s))
    return hsr_fail_nomem(err);
  uint64_t n_pairs;
  status = hsr_count_penetrations(s->world, s->relevant, s->n_relevant,
                                  &n_pairs, err);
  if (!status)
    s->table->X_f = (double)n_pairs;
  return status;
}

enum hsr_status hsr_statistics_measure(const struct hsr_world *world,
                                       const struct hsr_view *view,
                                       const uint32_t *ids,
                                       struct hsr_table1 *table,
                                       struct hsr_error *err) {
  struct survey s = {.world = world, .ids = ids, .table = table, .view = *view};
#define X(field, symbol, meaning) table->field = NAN;
  HSR_TABLE1(X)
#undef X
  enum hsr_status status = measure(&s, err);
  hsr_arena_free(&s.arena);
  return status;
}

/* --- Table II ------------------------------------------------------------- */

void hsr_statistics_rules(const struct hsr_table1 *given,
                          struct hsr_table1 *rules) {
  const double n = given->n, m = given->m;
  const double F_r = given->F_r, F_c = given->F_c, D_c = given->D_c;
  /* The rules assume a picture that is filled D_c times over, so that one
   * D_c-th is visible. A picture that is not filled shows all faces. */
  const double layers = fmax(D_c, 1);
  struct hsr_table1 r = {.n = n, .m = m, .F_r = F_r, .F_c = F_c, .D_c = D_c};
  r.F_t = 2 * F_r;
  r.C_t = r.F_t / F_c;
  r.C_r = NAN;
  r.E_t = 4 * r.F_t;
  r.E_r = r.E_t / 2;
  r.E_c = r.E_r / sqrt(F_c / 2);
  r.E_s = (r.E_r - r.E_c) / 2 + r.E_c;
  r.X_r = (layers - 1) * r.E_r / 4;
  r.X_v = r.X_r / layers;
  r.X_f = NAN;
  r.H_f = sqrt(n * m * D_c / F_r);
  r.S_l = sqrt(D_c * F_r * m / n);
  r.S_f = n * r.S_l;
  r.S_v = r.S_l / layers;
  r.L_v = 2 * n * r.S_v;
  *rules = r;
}
