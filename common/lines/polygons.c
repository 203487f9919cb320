/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/lines/polygons.h"

#include "common/exact/named_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hsr_polygons_clear(struct hsr_polygons *p) {
  p->world = NULL;
  p->n_regions = p->n_cycles = p->n_sides = 0;
}

void hsr_polygons_free(struct hsr_polygons *p) {
  free(p->region);
  free(p->cycle);
  free(p->side);
  *p = (struct hsr_polygons){.region = NULL};
}

/* Room for one more item of `size` bytes. */
static enum hsr_status grow(void *items, size_t n, size_t *room, size_t size) {
  if (n < *room)
    return HSR_OK;
  size_t more = *room ? 2 * *room : 64;
  void *moved = realloc(*(void **)items, more * size);
  if (!moved)
    return HSR_E_NOMEM;
  memcpy(items, &moved, sizeof moved);
  *room = more;
  return HSR_OK;
}

enum hsr_status hsr_polygons_add_region(struct hsr_polygons *p, uint32_t face) {
  if (grow(&p->region, p->n_regions, &p->region_room, sizeof *p->region))
    return HSR_E_NOMEM;
  p->region[p->n_regions++] = (struct hsr_polygon_region){face, p->n_cycles, 0};
  return HSR_OK;
}

enum hsr_status hsr_polygons_add_cycle(struct hsr_polygons *p) {
  if (grow(&p->cycle, p->n_cycles, &p->cycle_room, sizeof *p->cycle))
    return HSR_E_NOMEM;
  p->cycle[p->n_cycles++] = (struct hsr_polygon_cycle){p->n_sides, 0};
  p->region[p->n_regions - 1].n++;
  return HSR_OK;
}

enum hsr_status hsr_polygons_add_side(struct hsr_polygons *p,
                                      const struct hsr_polygon_side *side) {
  if (grow(&p->side, p->n_sides, &p->side_room, sizeof *p->side))
    return HSR_E_NOMEM;
  p->side[p->n_sides++] = *side;
  p->cycle[p->n_cycles - 1].n++;
  return HSR_OK;
}

static enum hsr_status append_cycle(struct hsr_polygons *p,
                                    const struct hsr_polygons *more,
                                    const struct hsr_polygon_cycle *cycle) {
  enum hsr_status status = hsr_polygons_add_cycle(p);
  for (size_t k = 0; k < cycle->n && !status; k++)
    status = hsr_polygons_add_side(p, &more->side[cycle->first + k]);
  return status;
}

enum hsr_status hsr_polygons_append(struct hsr_polygons *p,
                                    const struct hsr_polygons *more) {
  enum hsr_status status = HSR_OK;
  p->world = more->world;
  for (size_t r = 0; r < more->n_regions && !status; r++) {
    const struct hsr_polygon_region *region = &more->region[r];
    status = hsr_polygons_add_region(p, region->face);
    for (size_t c = 0; c < region->n && !status; c++)
      status = append_cycle(p, more, &more->cycle[region->first + c]);
  }
  return status;
}

static int by_face(const void *a, const void *b) {
  const struct hsr_polygon_region *r = a, *s = b;
  if (r->face != s->face)
    return (r->face > s->face) - (r->face < s->face);
  return (r->first > s->first) - (r->first < s->first);
}

void hsr_polygons_sort(struct hsr_polygons *p) {
  if (p->n_regions)
    qsort(p->region, p->n_regions, sizeof *p->region, by_face);
}

static double cycle_area(const struct hsr_polygon_side *side, size_t n) {
  double sum = 0;
  for (size_t k = 0; k < n; k++) {
    const double *a = side[k].at, *b = side[(k + 1) % n].at, *o = side[0].at;
    sum += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
  }
  return sum / 2;
}

double hsr_polygon_area(const struct hsr_polygons *p,
                        const struct hsr_polygon_region *region) {
  double sum = 0;
  for (size_t c = region->first; c < region->first + region->n; c++)
    sum += cycle_area(p->side + p->cycle[c].first, p->cycle[c].n);
  return sum;
}

/* A normal of a face, of any length. The world's normal is 0 if the area of the
 * face is below the least double. In that case the face is enlarged to size 1
 * first. */
static void find_normal(const struct hsr_mesh *mesh, uint32_t face,
                        double normal[3]) {
  const uint32_t *v = mesh->vertex + mesh->start[face];
  uint32_t n = mesh->start[face + 1] - mesh->start[face];
  double edge[2][3], size = 0;
  normal[0] = mesh->nx[face], normal[1] = mesh->ny[face];
  normal[2] = mesh->nz[face];
  if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0)
    return;
  for (uint32_t k = 1; k < n; k++)
    size = fmax(size, fmax(fabs(mesh->x[v[k]] - mesh->x[v[0]]),
                           fmax(fabs(mesh->y[v[k]] - mesh->y[v[0]]),
                                fabs(mesh->z[v[k]] - mesh->z[v[0]]))));
  for (uint32_t k = 1; k + 1 < n && size > 0; k++) {
    for (uint32_t e = 0; e < 2; e++) {
      edge[e][0] = (mesh->x[v[k + e]] - mesh->x[v[0]]) / size;
      edge[e][1] = (mesh->y[v[k + e]] - mesh->y[v[0]]) / size;
      edge[e][2] = (mesh->z[v[k + e]] - mesh->z[v[0]]) / size;
    }
    for (int c = 0; c < 3; c++)
      normal[c] += edge[0][(c + 1) % 3] * edge[1][(c + 2) % 3] -
                   edge[0][(c + 2) % 3] * edge[1][(c + 1) % 3];
  }
}

/* The point of the plane of a face that is seen at (sx, sy). If doubles do not
 * hold the plane, the point of the ray that is nearest to the face's anchor. */
static void point_at(const struct hsr_mesh *mesh, const struct hsr_view *view,
                     uint32_t face, const double at[2], double point[3]) {
  const double anchor[3] = {mesh->px[face], mesh->py[face], mesh->pz[face]};
  double normal[3], from[3], along[3], height = 0, down = 0;
  double to_anchor = 0, length = 0;
  find_normal(mesh, face, normal);
  for (int k = 0; k < 3; k++) {
    double d =
        view->ray[0][k] + at[0] * view->ray[1][k] + at[1] * view->ray[2][k];
    from[k] = view->E[k] + (view->parallel ? d : 0);
    along[k] = view->parallel ? view->F[k] : d;
    height += normal[k] * (anchor[k] - from[k]);
    down += normal[k] * along[k];
    to_anchor += along[k] * (anchor[k] - from[k]);
    length += along[k] * along[k];
  }
  double t = height / down;
  if (!isfinite(t))
    t = to_anchor / length;
  for (int k = 0; k < 3; k++)
    point[k] = from[k] + t * along[k];
}

void hsr_polygon_points(const struct hsr_polygons *p,
                        const struct hsr_view *view, double *points) {
  for (size_t r = 0; r < p->n_regions; r++)
    for (size_t c = 0; c < p->region[r].n; c++) {
      const struct hsr_polygon_cycle *cycle = &p->cycle[p->region[r].first + c];
      for (size_t k = cycle->first; k < cycle->first + cycle->n; k++)
        point_at(&p->world->mesh, view, p->region[r].face, p->side[k].at,
                 points + 3 * k);
    }
}

/* --- A cycle in exact lines and points ------------------------------------ */

/* Whether the faces and corners of a name are those of the world. */
static bool is_known(const struct hsr_world *world, struct hsr_line_name name) {
  switch (name.kind) {
  case HSR_LINE_BORDER:
    return name.a < HSR_N_BORDERS;
  case HSR_LINE_EDGE:
  case HSR_LINE_ROW:
    return name.a < world->n_faces && name.b < hsr_face_size(world, name.a);
  case HSR_LINE_MEETING:
    return name.a < name.b && name.b < world->n_faces;
  case HSR_LINE_NEAR:
  case HSR_LINE_HORIZON:
    return name.a < world->n_faces;
  }
  return false;
}

/* The number of a side's line, or HSR_NO_LINE. */
static uint32_t line_of(struct hsr_named_lines *lines,
                        const struct hsr_polygons *p, size_t side) {
  int sign;
  struct hsr_line_name name = p->side[side].line;
  return is_known(p->world, name) ? hsr_line_number(lines, name, &sign)
                                  : HSR_NO_LINE;
}

/* The point where side k of a cycle begins, or HSR_NO_POINT; and its line. */
static uint32_t beginning(struct hsr_named_lines *lines,
                          const struct hsr_polygons *p,
                          const struct hsr_polygon_cycle *cycle, size_t k,
                          uint32_t *line) {
  uint32_t before =
      line_of(lines, p, cycle->first + (k + cycle->n - 1) % cycle->n);
  *line = line_of(lines, p, cycle->first + k);
  if (before == HSR_NO_LINE || *line == HSR_NO_LINE || before == *line)
    return HSR_NO_POINT;
  return hsr_crossing(lines, before, *line);
}

static enum hsr_status say_faulty(const struct hsr_named_lines *lines,
                                  uint32_t face, struct hsr_error *err) {
  if (hsr_named_lines_failed(lines))
    return hsr_fail_nomem(err);
  return hsr_fail(err, HSR_E_INTERNAL,
                  "the polygons of face %u name lines that do not cross", face);
}

/* --- Comparison ----------------------------------------------------------- */

/* That a side on `line` of a region of `face` begins in `point` (less one) or
 * ends there (one more). */
struct end {
  uint32_t face, line, point;
  int count;
};

struct ends {
  struct end *end;
  size_t n;
};

static int in_order(const void *a, const void *b) {
  const struct end *d = a, *e = b;
  if (d->face != e->face)
    return d->face < e->face ? -1 : 1;
  if (d->line != e->line)
    return d->line < e->line ? -1 : 1;
  return (d->point > e->point) - (d->point < e->point);
}

/* The ends of a cycle's sides, times `sign`. False if it is faulty. */
static bool add_cycle(struct ends *ends, struct hsr_named_lines *lines,
                      const struct hsr_polygons *p, uint32_t face,
                      const struct hsr_polygon_cycle *cycle, int sign) {
  for (size_t k = 0; k < cycle->n; k++) {
    uint32_t line, next;
    uint32_t from = beginning(lines, p, cycle, k, &line);
    uint32_t to = beginning(lines, p, cycle, (k + 1) % cycle->n, &next);
    if (from == HSR_NO_POINT || to == HSR_NO_POINT)
      return false;
    ends->end[ends->n++] = (struct end){face, line, from, -sign};
    ends->end[ends->n++] = (struct end){face, line, to, sign};
  }
  return true;
}

static enum hsr_status add_all(struct ends *ends, struct hsr_named_lines *lines,
                               const struct hsr_polygons *p, int sign,
                               struct hsr_error *err) {
  for (size_t r = 0; r < p->n_regions; r++)
    for (size_t c = 0; c < p->region[r].n; c++)
      if (!add_cycle(ends, lines, p, p->region[r].face,
                     &p->cycle[p->region[r].first + c], sign))
        return say_faulty(lines, p->region[r].face, err);
  return HSR_OK;
}

/* Counts the faces, and those of which a number of ends is not 0. */
static void count_faces(const struct ends *ends,
                        struct hsr_polygons_difference *difference) {
  const struct end *end = ends->end;
  for (size_t k = 0, l; k < ends->n; k = l) {
    bool differs = false;
    for (l = k; l < ends->n && end[l].face == end[k].face;) {
      size_t first = l;
      int sum = 0;
      for (; l < ends->n && !in_order(&end[first], &end[l]); l++)
        sum += end[l].count;
      differs = differs || sum;
    }
    difference->faces++;
    if (differs && !difference->differing++)
      difference->first = end[k].face;
  }
}

enum hsr_status hsr_polygons_compare(const struct hsr_polygons *got,
                                     const struct hsr_polygons *wanted,
                                     const struct hsr_view *view,
                                     struct hsr_polygons_difference *difference,
                                     struct hsr_error *err) {
  *difference = (struct hsr_polygons_difference){.faces = 0};
  const struct hsr_world *world = got->world ? got->world : wanted->world;
  struct hsr_named_lines *lines = hsr_named_lines_new(world, view);
  struct ends ends = {
      malloc((2 * (got->n_sides + wanted->n_sides) + 1) * sizeof *ends.end), 0};
  enum hsr_status status = lines && ends.end ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = add_all(&ends, lines, got, 1, err);
  if (!status)
    status = add_all(&ends, lines, wanted, -1, err);
  if (!status && hsr_named_lines_failed(lines))
    status = hsr_fail_nomem(err);
  if (!status && ends.n)
    qsort(ends.end, ends.n, sizeof *ends.end, in_order);
  if (!status)
    count_faces(&ends, difference);
  free(ends.end);
  hsr_named_lines_free(lines);
  return status;
}

/* --- Samples -------------------------------------------------------------- */

/* Where the sides of a region cross the rows of samples: bit (i, j) changes
 * where the samples from i on lie beyond a crossing. */
struct raster {
  const struct hsr_polygons *polygons;
  const struct hsr_view *view;
  struct hsr_named_lines *lines;
  bool *change; /* (m + 1) n; false between two regions */
  int y0, y1;   /* the rows that the region reaches */
};

/* The first row that lies below the point or passes through it. A sample is
 * displaced downwards, so the point counts as above it. */
static int row_of(const struct raster *raster, uint32_t point) {
  const struct hsr_view *view = raster->view;
  double at[2];
  hsr_crossing_at(raster->lines, point, at);
  double guess = at[1] - hsr_sample_y(view, 0);
  int j = guess < 0 ? 0 : guess < view->n ? (int)guess : view->n;
  while (j > 0 && hsr_crossing_compare_to(raster->lines, point, 1,
                                          hsr_sample_y(view, j - 1)) <= 0)
    j--;
  while (j < view->n && hsr_crossing_compare_to(raster->lines, point, 1,
                                                hsr_sample_y(view, j)) > 0)
    j++;
  return j;
}

/* The first column whose sample in row j is right of the line or on it. `right`
 * is the sign of the line's function there. */
static int column_of(const struct raster *raster, uint32_t line, int right,
                     int j, int guess) {
  const struct hsr_view *view = raster->view;
  double sy = hsr_sample_y(view, j);
  int i = guess < 0 ? 0 : guess > view->m ? view->m : guess;
  while (i > 0 && hsr_line_sign_at(raster->lines, line,
                                   hsr_sample_x(view, i - 1), sy) != -right)
    i--;
  while (i < view->m && hsr_line_sign_at(raster->lines, line,
                                         hsr_sample_x(view, i), sy) == -right)
    i++;
  return i;
}

static void cross_rows(struct raster *raster, uint32_t line, uint32_t from,
                       uint32_t to) {
  int j0 = row_of(raster, from), j1 = row_of(raster, to);
  if (j0 == j1)
    return;
  double a[2], b[2], along[2];
  hsr_crossing_at(raster->lines, from, a);
  hsr_crossing_at(raster->lines, to, b);
  hsr_line_direction(raster->lines, line, along);
  int right = along[1] < 0 ? 1 : -1; /* the sign of its coefficient of sx */
  double slope = (b[0] - a[0]) / (b[1] - a[1]);
  int top = j0 < j1 ? j0 : j1, end = j0 < j1 ? j1 : j0;
  for (int j = top; j < end; j++) {
    double x = a[0] + slope * (hsr_sample_y(raster->view, j) - a[1]);
    double guess = x - hsr_sample_x(raster->view, 0);
    int i = column_of(raster, line, right, j,
                      guess > 0 && guess < raster->view->m ? (int)guess
                      : guess > 0                          ? raster->view->m
                                                           : 0);
    bool *change =
        &raster->change[(size_t)j * ((size_t)raster->view->m + 1) + (size_t)i];
    *change = !*change;
  }
  raster->y0 = top < raster->y0 ? top : raster->y0;
  raster->y1 = end > raster->y1 ? end : raster->y1;
}

static void fill(struct raster *raster, uint32_t face, uint32_t *ids) {
  size_t m = (size_t)raster->view->m;
  for (int j = raster->y0; j < raster->y1; j++) {
    bool *change = &raster->change[(size_t)j * (m + 1)], inside = false;
    for (size_t i = 0; i < m; i++) {
      inside = inside != change[i];
      if (inside)
        ids[(size_t)j * m + i] = face;
    }
    memset(change, 0, (m + 1) * sizeof *change);
  }
}

static enum hsr_status draw_region(struct raster *raster,
                                   const struct hsr_polygon_region *region,
                                   uint32_t *ids, struct hsr_error *err) {
  const struct hsr_polygons *p = raster->polygons;
  raster->y0 = raster->view->n;
  raster->y1 = 0;
  for (size_t c = 0; c < region->n; c++) {
    const struct hsr_polygon_cycle *cycle = &p->cycle[region->first + c];
    for (size_t k = 0; k < cycle->n; k++) {
      uint32_t line, next;
      uint32_t from = beginning(raster->lines, p, cycle, k, &line);
      uint32_t to =
          beginning(raster->lines, p, cycle, (k + 1) % cycle->n, &next);
      if (from == HSR_NO_POINT || to == HSR_NO_POINT)
        return say_faulty(raster->lines, region->face, err);
      cross_rows(raster, line, from, to);
    }
  }
  fill(raster, region->face, ids);
  return HSR_OK;
}

enum hsr_status hsr_polygons_ids(const struct hsr_polygons *polygons,
                                 const struct hsr_view *view, uint32_t *ids,
                                 struct hsr_error *err) {
  size_t n = (size_t)view->m * (size_t)view->n;
  for (size_t k = 0; k < n; k++)
    ids[k] = HSR_BACKGROUND;
  struct raster raster = {
      .polygons = polygons,
      .view = view,
      .lines = hsr_named_lines_new(polygons->world, view),
      .change = calloc(n + (size_t)view->n, sizeof *raster.change)};
  enum hsr_status status =
      raster.lines && raster.change ? HSR_OK : hsr_fail_nomem(err);
  for (size_t r = 0; r < polygons->n_regions && !status; r++)
    status = draw_region(&raster, &polygons->region[r], ids, err);
  if (!status && hsr_named_lines_failed(raster.lines))
    status = hsr_fail_nomem(err);
  free(raster.change);
  hsr_named_lines_free(raster.lines);
  return status;
}
