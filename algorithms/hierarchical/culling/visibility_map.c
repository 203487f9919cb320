/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A two-dimensional BSP tree of the picture: see visibility_map.h. */
#include "algorithms/hierarchical/culling/visibility_map.h"
#include "common/base/numbers.h"
#include "common/view/clip.h"

#include <float.h>
#include <string.h>

#define NO_NODE UINT32_MAX
enum { MOST_POINTS = 40 }; /* outlines with more are clipped no further */

/* A piece whose samples are asked. */
struct asked {
  struct hsr_piece piece;
  const struct asked *before; /* the one in front of it; NULL: none */
};

/* A line as numbers: inside where value . (w sx, w sy, w) is positive. */
struct line {
  double value[3];
  double size;  /* the sum of the sizes of these */
  double error; /* of the value at a point of size 1. Infinite: unknown */
};

struct map_node {
  uint32_t inside, outside; /* nodes; NO_NODE: it is a leaf */
  /* Of a leaf. */
  uint32_t shown;            /* face; HSR_BACKGROUND: vacant */
  const struct asked *asked; /* in front of that; the last of a list */
  /* Of other nodes. */
  uint32_t face; /* whose side it is */
  struct hsr_bsp_side side;
  struct line line;
};

struct outline {
  int n;
  double off;  /* of each coordinate of a point */
  double size; /* no coordinate of the first outline was larger */
  double (*point)[3];
};

static struct map_node *node_at(const struct hsr_map *map, uint32_t k) {
  return (struct map_node *)map->node.items + k;
}

static uint32_t add_leaf(struct hsr_map *map, uint32_t shown,
                         const struct asked *asked) {
  if (!hsr_arena_grow(map->arena, &map->node, sizeof(struct map_node))) {
    map->out_of_memory = true;
    return NO_NODE;
  }
  uint32_t k = (uint32_t)map->node.n - 1;
  *node_at(map, k) = (struct map_node){
      .inside = NO_NODE, .outside = NO_NODE, .shown = shown, .asked = asked};
  return k;
}

/* --- The filter of lines --------------------------------------------------
 *
 * Vertices. An entry of the screen matrix has a relative error of 2u, u =
 * 2^-53, and a difference with E one of u. So a coordinate of an image is
 * within 8u of the sizes of its terms, and 2^-1072 that underflow takes, which
 * is far below 2^-42 of `size`: that is 2^-1000 at least.
 * Edges. A coefficient of the line is a difference of two products of such
 * coordinates: within 4 x 8u of the product of both sizes, and 2^-1072. 2^-40
 * of it and 2^-900 are above that.
 * Cuts. The coefficients of both depth planes are within their errors, anywhere
 * in the picture; the differences round by u.
 * Clipping. A point of an outline is off by `off` in each coordinate, and so
 * its value by line->size times that; the sum of three products rounds by less
 * than 4u of line->size times the outline's size, which is part of line->error.
 * All this holds in every scene. What overflows makes a margin that is infinite
 * or not a number, and then nothing is clipped. */

/* A vertex as (w sx, w sy, w); the sum of the sizes of its terms, or
 * 2^-1000. */
static double image_of(const struct hsr_map *map, const double at[3],
                       double image[3]) {
  const struct hsr_view *view = map->frame->job->view;
  double most = 0x1p-1000;
  for (int r = 0; r < 3; r++) {
    double sum = view->origin[r], size = fabs(view->origin[r]);
    for (int c = 0; c < 3; c++) {
      double term = view->screen[r][c] * (at[c] - view->E[c]);
      sum += term;
      size += fabs(term) +
              fabs(view->screen[r][c]) * DBL_EPSILON * fabs(view->E[c]);
    }
    image[r] = sum;
    most = hsr_max(most, size);
  }
  return most;
}

static double image_of_vertex(const struct hsr_map *map, uint32_t v,
                              double image[3]) {
  const struct hsr_mesh *mesh = &map->frame->job->world->mesh;
  const double at[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
  return image_of(map, at, image);
}

/* As hsr_edge_side: the determinant of both vertices and the sample. */
static struct line line_of_edge(const struct hsr_map *map, uint32_t a,
                                uint32_t b) {
  struct line line;
  double p[3], q[3];
  double size = image_of_vertex(map, a, p) * image_of_vertex(map, b, q);
  for (int k = 0; k < 3; k++)
    line.value[k] =
        p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
  line.error = 0x1p-40 * size + 0x1p-900;
  return line;
}

/* As hsr_cut_side of f and g: in front of g where f is nearer on the eye's
 * side of g. */
static struct line line_of_cut(const struct hsr_map *map, uint32_t f,
                               uint32_t g) {
  const struct hsr_screen *screen = &map->frame->screen;
  const struct hsr_depth_plane *p = &screen->plane[f], *q = &screen->plane[g];
  double facing = screen->facing[g];
  struct line line = {.value = {facing * (p->a - q->a), facing * (p->b - q->b),
                                facing * (p->c - q->c)}};
  double size = fabs(p->a) + fabs(q->a) + fabs(p->b) + fabs(q->b) + fabs(p->c) +
                fabs(q->c);
  line.error = facing == 0
                   ? INFINITY
                   : 4 * (p->error + q->error) + 0x1p-48 * size + 0x1p-900;
  return line;
}

static struct line line_of(const struct hsr_map *map, uint32_t face,
                           const struct hsr_bsp_side *side) {
  struct line line = side->b == HSR_NO_ID ? line_of_cut(map, face, side->a)
                                          : line_of_edge(map, side->a, side->b);
  line.size = 0;
  for (int k = 0; k < 3; k++) {
    line.value[k] *= side->inside;
    line.size += fabs(line.value[k]);
  }
  return line;
}

/* --- Outlines ------------------------------------------------------------- */

/* The part of an outline on one side of a line: +1 inside, -1 outside. False:
 * there certainly is none. `out` has room for MOST_POINTS * 3 / 2 + 1. */
static bool clip(const struct outline *in, const struct line *line, int side,
                 struct outline *out) {
  double margin =
      2 * line->size * in->off + 4 * line->error * in->size + 0x1p-900;
  *out = (struct outline){in->n, in->off, in->size, out->point};
  if (in->n > MOST_POINTS || !(margin < 1e300) ||
      !(line->size * in->size < 1e300)) {
    memcpy(out->point, in->point, (size_t)in->n * sizeof *in->point);
    return true;
  }
  const double plane[3] = {side * line->value[0], side * line->value[1],
                           side * line->value[2]};
  out->n =
      hsr_clip((const double(*)[3])in->point, in->n, plane, margin, out->point);
  out->off += 0x1p-50 * in->size;
  return out->n > 0;
}

enum { ROOM = MOST_POINTS * 3 / 2 + 2 };

/* A rectangle of samples. */
static struct outline rectangle(const struct hsr_map *map,
                                const struct hsr_bounds *b,
                                double (*point)[3]) {
  const struct hsr_view *view = map->frame->job->view;
  double x[2] = {hsr_sample_x(view, b->x0), hsr_sample_x(view, b->x1 - 1)};
  double y[2] = {hsr_sample_y(view, b->y0), hsr_sample_y(view, b->y1 - 1)};
  for (int k = 0; k < 4; k++) {
    point[k][0] = x[k == 1 || k == 2];
    point[k][1] = y[k > 1];
    point[k][2] = 1;
  }
  double size = hsr_max(1, hsr_max(x[1], y[1]));
  return (struct outline){4, 0x1p-44 * size, size, point};
}

/* What its sides leave of a piece's bounds, in `point`. */
static struct outline outline_of(const struct hsr_map *map,
                                 const struct hsr_piece *piece,
                                 uint32_t n_sides, double (*point)[3]) {
  struct outline o = rectangle(map, &piece->bounds, point);
  double kept[ROOM][3];
  for (uint32_t k = 0; k < n_sides && o.n; k++) {
    struct line line = line_of(map, piece->face, &map->side[k]);
    struct outline part = {.point = kept};
    clip(&o, &line, 1, &part);
    memcpy(point, kept, (size_t)part.n * sizeof *point);
    part.point = point;
    o = part;
  }
  return o;
}

/* --- Rectangles of samples and lines -------------------------------------- */

enum { INSIDE, OUTSIDE, BOTH, NEITHER };

/* If the corner samples of a rectangle are on one side of a line, all of its
 * samples are. */
static int side_of(const struct hsr_map *map, uint32_t face,
                   const struct hsr_bsp_side *side,
                   const struct hsr_bounds *b) {
  const struct hsr_bsp_frame *f = map->frame;
  int n = hsr_bsp_frame_inside(f, face, side, b->x0, b->y0);
  n += hsr_bsp_frame_inside(f, face, side, b->x1 - 1, b->y0);
  if (n == 1)
    return BOTH;
  n += hsr_bsp_frame_inside(f, face, side, b->x0, b->y1 - 1);
  n += hsr_bsp_frame_inside(f, face, side, b->x1 - 1, b->y1 - 1);
  return n == 4 ? INSIDE : n == 0 ? OUTSIDE : BOTH;
}

/* --- Samples of an outline ------------------------------------------------ */

enum { ENOUGH = 16 }; /* samples of an outline that are looked at */

/* An outline on the screen; no point is farther than `error` from its place. */
struct shape {
  int n;
  double x[ROOM], y[ROOM], error;
};

/* False if too little is known. */
static bool shape_of(const struct outline *o, struct shape *shape) {
  double least = INFINITY, most = 1;
  shape->n = o->n;
  for (int k = 0; k < o->n; k++) {
    shape->x[k] = o->point[k][0] / o->point[k][2];
    shape->y[k] = o->point[k][1] / o->point[k][2];
    least = fmin(least, o->point[k][2]);
    most = fmax(most, fmax(fabs(shape->x[k]), fabs(shape->y[k])));
  }
  shape->error = 8 * o->off * (1 + most) / least + 0x1p-40 * most;
  return least > 4 * o->off && shape->error < 0.25;
}

static int sample_from(double at, double first, int least, int most) {
  return (int)fmax(least, fmin(most, ceil(at - first)));
}

/* The samples of the window in the rectangle around an outline. False if there
 * are none. */
static bool samples_around(const struct hsr_map *map, const struct outline *o,
                           struct hsr_bounds *b) {
  const struct hsr_view *view = map->frame->job->view;
  const struct hsr_window *w = &view->window;
  struct shape s;
  *b = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
  if (!shape_of(o, &s))
    return true;
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
  for (int k = 0; k < s.n; k++) {
    lo[0] = fmin(lo[0], s.x[k] - s.error);
    hi[0] = fmax(hi[0], s.x[k] + s.error);
    lo[1] = fmin(lo[1], s.y[k] - s.error);
    hi[1] = fmax(hi[1], s.y[k] + s.error);
  }
  double x = hsr_sample_x(view, 0), y = hsr_sample_y(view, 0);
  b->x0 = sample_from(lo[0], x, w->x0, w->x1);
  b->x1 = sample_from(floor(hi[0] - x) + 1, 0, w->x0, w->x1);
  b->y0 = sample_from(lo[1], y, w->y0, w->y1);
  b->y1 = sample_from(floor(hi[1] - y) + 1, 0, w->y0, w->y1);
  return b->x0 < b->x1 && b->y0 < b->y1;
}

/* Where the samples of an outline lie to a side of a piece of `face`, as far as
 * the rectangle around it tells. */
static int side_of_outline(const struct hsr_map *map, uint32_t face,
                           const struct hsr_bsp_side *side,
                           const struct outline *o) {
  struct hsr_bounds b;
  return samples_around(map, o, &b) ? side_of(map, face, side, &b) : NEITHER;
}

/* The columns, from lo to hi on the screen, that a convex shape has between two
 * heights. False if there are none. */
static bool columns_between(const struct shape *s, double top, double below,
                            double *lo, double *hi) {
  *lo = INFINITY;
  *hi = -INFINITY;
  for (int k = 0; k < s->n; k++) {
    int next = k + 1 < s->n ? k + 1 : 0;
    double ax = s->x[k], ay = s->y[k], bx = s->x[next], by = s->y[next];
    if (ay >= top && ay <= below) {
      *lo = fmin(*lo, ax);
      *hi = fmax(*hi, ax);
    }
    const double at[2] = {top, below};
    for (int h = 0; h < 2; h++)
      if ((ay < at[h]) != (by < at[h])) {
        double x = ax + (at[h] - ay) / (by - ay) * (bx - ax);
        *lo = fmin(*lo, x);
        *hi = fmax(*hi, x);
      }
  }
  return *lo <= *hi;
}

/* Whether an outline may hold a sample of the window on that side of a node's
 * line. If the first few that may be in it are not, or there are none, it does
 * not. Where edges lie on one another, this tells on which side a part is. */
static bool may_hold_sample(const struct hsr_map *map, const struct outline *o,
                            const struct map_node *node, int side) {
  const struct hsr_view *view = map->frame->job->view;
  const struct hsr_window *w = &view->window;
  struct shape shape;
  if (!shape_of(o, &shape))
    return true;
  double top = INFINITY, below = -INFINITY, e = shape.error;
  for (int k = 0; k < shape.n; k++) {
    top = fmin(top, shape.y[k]);
    below = fmax(below, shape.y[k]);
  }
  double x0 = hsr_sample_x(view, 0), y0 = hsr_sample_y(view, 0), lo, hi;
  int first = (int)fmax(w->y0, fmin(w->y1, ceil(top - e - y0)));
  int end = (int)fmin(w->y1, fmax(w->y0, floor(below + e - y0) + 1));
  int looked_at = 0;
  for (int j = first; j < end; j++) {
    double y = hsr_sample_y(view, j);
    if (!columns_between(&shape, y - e, y + e, &lo, &hi))
      continue;
    int i = (int)fmax(w->x0, fmin(w->x1, ceil(lo - e - x0)));
    int last = (int)fmin(w->x1, fmax(w->x0, floor(hi + e - x0) + 1));
    for (; i < last; i++)
      if (++looked_at > ENOUGH ||
          hsr_bsp_frame_inside(map->frame, node->face, &node->side, i, j) ==
              (side > 0))
        return true;
  }
  return false;
}

/* --- Inserting ------------------------------------------------------------ */

/* A node that waits for a part of the piece: outlines of that part and of the
 * node's region, one after the other among the waiting points. */
struct waiting {
  uint32_t node;
  size_t first;
  struct outline part, region; /* .point is unused */
};

static bool keep_points(struct hsr_map *map, const struct outline *o) {
  if (map->n_points + (size_t)o->n > map->room) {
    size_t room = 2 * map->room + 4 * ROOM;
    double(*grown)[3] = hsr_arena_array(map->arena, room, sizeof *grown);
    if (!grown) {
      map->out_of_memory = true;
      return false;
    }
    if (map->n_points)
      memcpy(grown, map->points, map->n_points * sizeof *grown);
    map->points = grown;
    map->room = room;
  }
  memcpy(map->points + map->n_points, o->point,
         (size_t)o->n * sizeof *o->point);
  map->n_points += (size_t)o->n;
  return true;
}

static void wait(struct hsr_map *map, uint32_t node, const struct outline *part,
                 const struct outline *region) {
  size_t first = map->n_points;
  if (!keep_points(map, part) || !keep_points(map, region))
    return;
  if (!hsr_arena_grow(map->arena, &map->waiting, sizeof(struct waiting))) {
    map->out_of_memory = true;
    return;
  }
  ((struct waiting *)map->waiting.items)[map->waiting.n - 1] =
      (struct waiting){node, first, *part, *region};
}

/* Sends the parts of an outline, and of the region, to both sides of a line. */
static void part_at(struct hsr_map *map, uint32_t k, uint32_t face,
                    const struct outline *part, const struct outline *region) {
  double a[2][ROOM][3], b[2][ROOM][3];
  const struct map_node node = *node_at(map, k);
  struct outline of_part[2] = {{.point = a[0]}, {.point = a[1]}};
  struct outline of_region[2] = {{.point = b[0]}, {.point = b[1]}};
  bool there[2];
  for (int s = 0; s < 2; s++) {
    there[s] = clip(part, &node.line, s ? -1 : 1, &of_part[s]);
    there[s] &= clip(region, &node.line, s ? -1 : 1, &of_region[s]);
  }
  if (there[0] && there[1]) {
    int side = side_of_outline(map, node.face, &node.side, part);
    there[0] = side == INSIDE || side == BOTH;
    there[1] = side == OUTSIDE || side == BOTH;
  }
  bool both = there[0] && there[1];
  for (int s = 0; s < 2 && both; s++)
    there[s] = may_hold_sample(map, &of_part[s], &node, s ? -1 : 1);
  HSR_STEP(map->frame->job->tally, HSR_MAP_LINES, HSR_FACE(face),
           HSR_CELL(k, 0, 0), HSR_NOWHERE,
           there[0] && there[1] ? BOTH
           : there[0]           ? INSIDE
           : there[1]           ? OUTSIDE
                                : NEITHER);
  for (int s = 0; s < 2; s++)
    if (there[s])
      wait(map, s ? node.outside : node.inside, &of_part[s], &of_region[s]);
}

/* Divides a vacant region by those sides of the piece that may cross it, and
 * gives what is inside of all to the face. */
static void fill(struct hsr_map *map, uint32_t k, const struct hsr_piece *piece,
                 uint32_t n_sides, const struct outline *region) {
  struct hsr_tally *tally = map->frame->job->tally;
  double points[2][ROOM][3];
  struct outline left = *region;
  left.point = points[0];
  memcpy(points[0], region->point, (size_t)region->n * sizeof *points[0]);
  for (uint32_t c = 0; c < n_sides; c++) {
    struct line line = line_of(map, piece->face, &map->side[c]);
    struct outline rest = {.point = points[1]};
    if (!clip(&left, &line, -1, &rest))
      continue; /* the region is inside */
    int side = side_of_outline(map, piece->face, &map->side[c], &left);
    if (side == INSIDE)
      continue;
    if (side == OUTSIDE || side == NEITHER)
      return; /* nothing of the region is inside */
    const struct asked *asked = node_at(map, k)->asked;
    uint32_t inside = add_leaf(map, HSR_BACKGROUND, asked);
    uint32_t outside = add_leaf(map, HSR_BACKGROUND, asked);
    if (inside == NO_NODE || outside == NO_NODE)
      return;
    HSR_STEP(tally, HSR_MAP_DIVISIONS, HSR_FACE(piece->face), HSR_CELL(k, 0, 0),
             HSR_NOWHERE, 0);
    *node_at(map, k) = (struct map_node){.inside = inside,
                                         .outside = outside,
                                         .shown = HSR_BACKGROUND,
                                         .face = piece->face,
                                         .side = map->side[c],
                                         .line = line};
    k = inside;
    if (!clip(&left, &line, 1, &rest))
      return; /* nothing of the region is inside */
    memcpy(points[0], points[1], (size_t)rest.n * sizeof *points[0]);
    rest.point = points[0];
    left = rest;
  }
  HSR_STEP(tally, HSR_MAP_FILLED, HSR_FACE(piece->face), HSR_CELL(k, 0, 0),
           HSR_NOWHERE, 0);
  node_at(map, k)->shown = piece->face;
}

/* Whether some line of a piece parts no two points of the picture for certain.
 * Such a line would divide every region that it is put to. */
static bool is_blurred(const struct hsr_map *map, uint32_t face,
                       uint32_t n_sides) {
  for (uint32_t k = 0; k < n_sides; k++) {
    struct line line = line_of(map, face, &map->side[k]);
    if (!(4 * line.error < line.size))
      return true;
  }
  return false;
}

/* Puts a piece whose samples are asked behind those that a leaf has already. */
static void add_asked(struct hsr_map *map, uint32_t k,
                      const struct hsr_piece *piece,
                      const struct hsr_cut *cuts) {
  struct asked *asked = HSR_NEW(map->arena, struct asked, 1);
  if (!asked) {
    map->out_of_memory = true;
    return;
  }
  *asked = (struct asked){*piece, node_at(map, k)->asked};
  asked->piece.cuts = cuts;
  node_at(map, k)->asked = asked;
}

static const struct hsr_cut *copy_cuts(struct hsr_map *map,
                                       const struct hsr_piece *piece) {
  struct hsr_cut *cuts = HSR_NEW(map->arena, struct hsr_cut, piece->n_cuts);
  if (!cuts)
    map->out_of_memory = true;
  else if (piece->n_cuts)
    memcpy(cuts, piece->cuts, piece->n_cuts * sizeof *cuts);
  return cuts;
}

void hsr_map_insert(struct hsr_map *map, const struct hsr_bsp_piece *given,
                    const struct hsr_piece *piece, int facing) {
  struct hsr_tally *tally = map->frame->job->tally;
  const struct hsr_window *w = &map->frame->job->view->window;
  const struct hsr_bounds all = {w->x0, w->y0, w->x1, w->y1};
  uint32_t n_sides =
      hsr_bsp_frame_sides(map->frame, given, piece, facing, map->side);
  bool is_asked = hsr_bsp_frame_is_asked(map->frame, piece->face) ||
                  is_blurred(map, piece->face, n_sides);
  if (is_asked)
    n_sides = 0;
  const struct hsr_cut *cuts = is_asked ? copy_cuts(map, piece) : NULL;
  double a[ROOM][3], b[ROOM][3];
  struct outline part = outline_of(map, piece, n_sides, a);
  struct outline region = rectangle(map, &all, b);
  if (map->out_of_memory || !part.n)
    return;
  wait(map, 0, &part, &region);
  while (map->waiting.n && !map->out_of_memory) {
    struct waiting next =
        ((struct waiting *)map->waiting.items)[--map->waiting.n];
    part = next.part;
    region = next.region;
    part.point = a;
    region.point = b;
    memcpy(a, map->points + next.first, (size_t)part.n * sizeof *a);
    memcpy(b, map->points + next.first + part.n, (size_t)region.n * sizeof *b);
    map->n_points = next.first;
    const struct map_node *node = node_at(map, next.node);
    if (node->inside != NO_NODE)
      part_at(map, next.node, piece->face, &part, &region);
    else if (node->shown != HSR_BACKGROUND)
      HSR_STEP(tally, HSR_MAP_HIDDEN, HSR_FACE(piece->face),
               HSR_FACE(node->shown), HSR_NOWHERE, 0);
    else if (is_asked)
      add_asked(map, next.node, piece, cuts);
    else
      fill(map, next.node, piece, n_sides, &region);
  }
}

/* --- Rectangles of samples ------------------------------------------------ */

/* A rectangle that waits at a node. */
struct spot {
  uint32_t node;
  struct hsr_bounds bounds;
};

static void wait_at(struct hsr_map *map, uint32_t node,
                    const struct hsr_bounds *bounds) {
  if (!hsr_arena_grow(map->arena, &map->spots, sizeof(struct spot))) {
    map->out_of_memory = true;
    return;
  }
  ((struct spot *)map->spots.items)[map->spots.n - 1] =
      (struct spot){node, *bounds};
}

/* Of a leaf: the outcomes of HSR_MAP_BOXES, and of HSR_MAP_REGIONS. */
enum { IS_HIDDEN = BOTH + 1, IS_VACANT, IS_LEAF = BOTH + 1 };

static struct hsr_window window_of(const struct hsr_bounds *b) {
  return hsr_window_make(b->x0, b->y0, b->x1, b->y1);
}

/* Halves a rectangle that is on both sides of a line. */
static void wait_in_halves(struct hsr_map *map, const struct spot *spot) {
  struct hsr_bounds first = spot->bounds, last = spot->bounds;
  if (first.x1 - first.x0 > first.y1 - first.y0)
    first.x1 = last.x0 = first.x0 + (first.x1 - first.x0) / 2;
  else
    first.y1 = last.y0 = first.y0 + (first.y1 - first.y0) / 2;
  wait_at(map, spot->node, &first);
  wait_at(map, spot->node, &last);
}

bool hsr_map_hides(struct hsr_map *map, const struct hsr_bounds *bounds,
                   bool several, struct hsr_subject subject) {
  bool hidden = true;
  map->spots.n = 0;
  wait_at(map, 0, bounds);
  while (map->spots.n && hidden && !map->out_of_memory) {
    struct spot next = ((struct spot *)map->spots.items)[--map->spots.n];
    const struct map_node *node = node_at(map, next.node);
    bool is_leaf = node->inside == NO_NODE;
    int side = !is_leaf ? side_of(map, node->face, &node->side, &next.bounds)
               : node->shown == HSR_BACKGROUND ? IS_VACANT
                                               : IS_HIDDEN;
    HSR_STEP(map->frame->job->tally, HSR_MAP_BOXES, subject,
             HSR_CELL(next.node, 0, 0), window_of(&next.bounds), side);
    hidden = side != IS_VACANT && (side != BOTH || several);
    if (side == INSIDE || side == OUTSIDE)
      wait_at(map, side == INSIDE ? node->inside : node->outside, &next.bounds);
    if (side == BOTH)
      wait_in_halves(map, &next);
  }
  return hidden;
}

/* --- Showing -------------------------------------------------------------- */

/* The frontmost of the pieces that are asked, if one covers the sample. */
static uint32_t face_at(const struct hsr_map *map, const struct map_node *leaf,
                        int i, int j) {
  struct hsr_tally *tally = map->frame->job->tally;
  uint32_t face = leaf->shown;
  for (const struct asked *a = leaf->asked; a; a = a->before) {
    const struct hsr_bounds *b = &a->piece.bounds;
    if (i < b->x0 || i >= b->x1 || j < b->y0 || j >= b->y1)
      continue;
    bool covered =
        hsr_piece_covers(&map->frame->screen, a->piece.face, a->piece.cuts,
                         a->piece.n_cuts, i, j, tally);
    HSR_STEP(tally, HSR_MAP_ASKED, HSR_FACE(a->piece.face), HSR_THE_WINDOW,
             HSR_AT(i, j), covered);
    if (covered)
      face = a->piece.face;
  }
  return face;
}

static void show_leaf(const struct hsr_map *map, const struct map_node *leaf,
                      const struct hsr_bounds *b) {
  struct hsr_tally *tally = map->frame->job->tally;
  for (int j = b->y0; j < b->y1; j++)
    for (int i = b->x0; i < b->x1; i++) {
      uint32_t face = face_at(map, leaf, i, j);
      HSR_TOUCH(tally, i, j);
      if (face != HSR_BACKGROUND)
        HSR_STEP(tally, HSR_BSP_SAMPLES, HSR_FACE(face), HSR_THE_WINDOW,
                 HSR_AT(i, j), 0);
      hsr_bsp_frame_row(map->frame, j)[i] = face;
    }
}

void hsr_map_show(struct hsr_map *map) {
  const struct hsr_window *w = &map->frame->job->view->window;
  map->spots.n = 0;
  wait_at(map, 0, &(struct hsr_bounds){w->x0, w->y0, w->x1, w->y1});
  while (map->spots.n && !map->out_of_memory) {
    struct spot next = ((struct spot *)map->spots.items)[--map->spots.n];
    const struct map_node *node = node_at(map, next.node);
    bool is_leaf = node->inside == NO_NODE;
    int side =
        is_leaf ? IS_LEAF : side_of(map, node->face, &node->side, &next.bounds);
    HSR_STEP(map->frame->job->tally, HSR_MAP_REGIONS, HSR_CELL(next.node, 0, 0),
             HSR_THE_WINDOW, window_of(&next.bounds), side);
    if (is_leaf)
      show_leaf(map, node, &next.bounds);
    else if (side == BOTH)
      wait_in_halves(map, &next);
    else
      wait_at(map, side == INSIDE ? node->inside : node->outside, &next.bounds);
  }
}

enum hsr_status hsr_map_begin(struct hsr_map *map,
                              struct hsr_bsp_frame *frame) {
  *map = (struct hsr_map){.frame = frame, .arena = frame->job->scratch};
  map->side = HSR_NEW(map->arena, struct hsr_bsp_side, frame->most_corners);
  add_leaf(map, HSR_BACKGROUND, NULL);
  return map->side && !map->out_of_memory ? HSR_OK : HSR_E_NOMEM;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"lines compared", "pieces compared with lines of the map", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_CELL, "inside|outside|both|neither"},
    {"parts hidden",
     "parts of pieces behind faces of the "
     "map",
     HSR_REJECT, HSR_OF_FACE, HSR_OF_FACE},
    {"divisions", "regions divided by a side of a piece", HSR_SUBDIVIDE,
     HSR_OF_FACE, HSR_OF_CELL},
    {"regions filled", "vacant regions given to a face", HSR_ACTIVATE,
     HSR_OF_FACE, HSR_OF_CELL},
    {"boxes compared", "bounding volumes compared with nodes of the map",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_CELL,
     "inside|outside|both|hidden|vacant"},
    {"regions shown", "rectangles of samples compared with lines of the map",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_WINDOW, "inside|outside|both|leaf",
     .key = "region-compared", .outcome_keys = "||divided"},
    {"samples asked", "samples of pieces that no lines bound", HSR_SAMPLE,
     HSR_OF_FACE, HSR_OF_WINDOW, "not covered|covered"},
    {NULL}};

const struct hsr_part hsr_map_part = {
    HSR_PART_MAP, counters, NULL, NULL, {NULL}};
