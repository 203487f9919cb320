/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The areas of the picture that a face covers: docs/correct-picture.md,
 * Covering, at all points of the picture.
 *
 * Convex      a face with all corners before the eye that is convex on the
 *             screen is the polygon of its corners' images, clipped to the
 *             picture.
 * Any other   the image of an edge is a stretch of its line; if the edge passes
 *             behind the eye, it is all but a stretch. These stretches, clipped
 *             to the picture, are where the parity of the definition changes.
 *             They are divided where they meet, and one that an even number of
 *             edges share is no border. On which side of a strand the area lies
 *             is told by the definition's parity beside its middle.
 * Beyond near the areas are then clipped by the face's horizon, behind which
 *             its plane is met behind the eye, and by its near line, where they
 *             reach beyond these. */
#include "algorithms/image_space/area/sorting/areas.h"

static uint32_t line_of_edge(struct hsr_clipper *c, uint32_t face, uint32_t k,
                             int *sign) {
  return hsr_line_number(c->lines,
                         (struct hsr_line_name){HSR_LINE_EDGE, face, k}, sign);
}

/* --- Convex faces --------------------------------------------------------- */

/* Whether all corners are before the eye, and on one side of every edge; +1 or
 * -1 as that is the positive side, else 0. */
static int convex_side(struct hsr_clipper *c, const struct hsr_world *world,
                       uint32_t face) {
  uint32_t n = hsr_face_size(world, face);
  int all = 0, w, toward[2], sign;
  for (uint32_t k = 0; k < n; k++)
    if (hsr_corner_point(c->lines, face, k, &w, toward) == HSR_NO_POINT ||
        w <= 0)
      return 0;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t line = line_of_edge(c, face, k, &sign);
    for (uint32_t v = 0; v < n && line != HSR_NO_LINE; v++) {
      uint32_t point = hsr_corner_point(c->lines, face, v, &w, toward);
      int side = v == k || v == (k + 1) % n
                     ? 0
                     : sign * hsr_crossing_side(c->lines, point, line);
      if (side && all && side != all)
        return 0;
      all = side ? side : all;
    }
  }
  return all;
}

/* Adds the edges of a convex face, around the area. */
static void add_convex(struct hsr_clipper *c, const struct hsr_world *world,
                       uint32_t face, int side) {
  uint32_t n = hsr_face_size(world, face);
  int w, toward[2], sign;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t line = line_of_edge(c, face, k, &sign);
    uint32_t a = hsr_corner_point(c->lines, face, k, &w, toward),
             b = hsr_corner_point(c->lines, face, (k + 1) % n, &w, toward);
    if (line == HSR_NO_LINE || a == b)
      continue;
    struct hsr_border_edge e = hsr_border_make(
        c, line, sign * side, side > 0 ? a : b, side > 0 ? b : a);
    hsr_border_add(c, &e);
  }
}

static void drop_all(struct hsr_clipper *c, struct hsr_area_list *list) {
  struct hsr_area *area;
  while ((area = hsr_areas_pop(list)))
    hsr_area_free(c, area);
}

/* Keeps of the areas in the list what is on the side of a line where sign times
 * its function is positive. */
static void keep_half(struct hsr_clipper *c, struct hsr_area_list *list,
                      uint32_t line, int sign) {
  struct hsr_area_list all = *list, outside = {NULL, NULL};
  *list = (struct hsr_area_list){NULL, NULL};
  struct hsr_area *half = hsr_area_of_half(c, line, sign), *area;
  while ((area = hsr_areas_pop(&all)) && !c->failed && !c->faulty)
    if (!half || !hsr_areas_clip(c, area, half, list, &outside))
      hsr_area_free(c, area);
  drop_all(c, &outside);
  if (half)
    hsr_area_free(c, half);
}

/* Whether a point of an area's border is beyond a line. */
static bool reaches_beyond(struct hsr_clipper *c, const struct hsr_area *area,
                           uint32_t line, int sign) {
  for (uint32_t k = 0; k < area->n_edges; k++)
    if (sign * hsr_crossing_side(c->lines, area->edge[k].from, line) < 0)
      return true;
  return false;
}

/* Keeps of the areas in the list what is on the positive side of a line. If its
 * function is zero everywhere, nothing is: a face that lies at near. */
static void clip_by(struct hsr_clipper *c, struct hsr_area_list *list,
                    struct hsr_line_name name) {
  int sign;
  uint32_t line = hsr_line_number(c->lines, name, &sign);
  bool beyond = false;
  if (line == HSR_NO_LINE) {
    drop_all(c, list);
    return;
  }
  for (struct hsr_area *a = list->first; a; a = a->next)
    beyond = beyond || reaches_beyond(c, a, line, sign);
  if (beyond)
    keep_half(c, list, line, sign);
}

/* --- Other faces ---------------------------------------------------------- */

/* The edges of a face in the picture. They are in no order and may cross, but
 * are kept as one cycle, so that they can be divided like a border. */
struct stretches {
  struct hsr_clipper *c;
  uint32_t border[HSR_N_BORDERS];
  int way[HSR_N_BORDERS];
  struct hsr_growing edges; /* struct hsr_border_edge; those of the picture's
                               border first */
};

/* The ends of the part of a line in the picture, in their order along `axis`.
 * False if it has no more than one point. */
static bool chord(struct stretches *s, uint32_t line, uint32_t end[2],
                  int *axis) {
  struct hsr_clipper *c = s->c;
  uint32_t n = 0;
  for (int k = 0; k < HSR_N_BORDERS; k++) {
    uint32_t point = s->border[k] == line
                         ? HSR_NO_POINT
                         : hsr_crossing(c->lines, line, s->border[k]);
    bool in = point != HSR_NO_POINT;
    for (int l = 0; l < HSR_N_BORDERS && in; l++)
      in = s->way[l] * hsr_crossing_side(c->lines, point, s->border[l]) >= 0;
    if (in && !(n && point == end[0]) && n < 2)
      end[n++] = point;
  }
  if (n < 2)
    return false;
  *axis = hsr_crossing_compare(c->lines, end[0], end[1], 0) ? 0 : 1;
  if (hsr_crossing_compare(c->lines, end[0], end[1], *axis) > 0) {
    uint32_t first = end[0];
    end[0] = end[1];
    end[1] = first;
  }
  return true;
}

static void add_stretch(struct stretches *s, uint32_t line, uint32_t from,
                        uint32_t to, int axis) {
  struct hsr_clipper *c = s->c;
  if (hsr_crossing_compare(c->lines, from, to, axis) >= 0)
    return;
  struct hsr_border_edge *e =
      HSR_CLIPPER_NEW(c, &s->edges, struct hsr_border_edge);
  double d[2];
  hsr_line_direction(c->lines, line, d);
  if (e) /* its sign is such that it runs from `from` to `to` */
    *e = hsr_border_make(c, line, d[axis] > 0 ? 1 : -1, from, to);
}

static uint32_t later(struct stretches *s, uint32_t p, uint32_t q, int axis) {
  return hsr_crossing_compare(s->c->lines, p, q, axis) >= 0 ? p : q;
}
static uint32_t earlier(struct stretches *s, uint32_t p, uint32_t q, int axis) {
  return hsr_crossing_compare(s->c->lines, p, q, axis) <= 0 ? p : q;
}

/* An edge in line with the eye does not cross rows. So where a row passes an
 * end of the edge, the parity changes: left of the end's image, or right of it
 * if the end is behind the eye. The ends of an edge that does not pass through
 * the eye have one image, and what is added for them is added twice. */
static void add_rows(struct stretches *s, const struct hsr_world *world,
                     uint32_t face, uint32_t k) {
  struct hsr_clipper *c = s->c;
  for (uint32_t e = 0; e < 2; e++) {
    uint32_t corner = (k + e) % hsr_face_size(world, face), end[2];
    int sign, w, toward[2], axis;
    uint32_t at = hsr_corner_point(c->lines, face, corner, &w, toward);
    uint32_t line = hsr_line_number(
        c->lines, (struct hsr_line_name){HSR_LINE_ROW, face, corner}, &sign);
    if (line == HSR_NO_LINE || !chord(s, line, end, &axis))
      continue;
    if (w > 0)
      add_stretch(s, line, end[0], earlier(s, end[1], at, axis), axis);
    else
      add_stretch(s, line, later(s, end[0], at, axis), end[1], axis);
  }
}

/* The image of the edge from corner k to the next one. */
static void add_image(struct stretches *s, const struct hsr_world *world,
                      uint32_t face, uint32_t k) {
  struct hsr_clipper *c = s->c;
  int sign, w[2], toward[2][2], axis;
  uint32_t line = line_of_edge(c, face, k, &sign), end[2], at[2];
  if (line == HSR_NO_LINE)
    add_rows(s, world, face, k);
  if (line == HSR_NO_LINE || !chord(s, line, end, &axis))
    return;
  for (uint32_t e = 0; e < 2; e++)
    at[e] = hsr_corner_point(
        c->lines, face, (k + e) % hsr_face_size(world, face), &w[e], toward[e]);
  if (!w[0] && !w[1])
    return;
  if (!w[0] || !w[1]) { /* one end is at infinity */
    int far = w[0] ? 1 : 0, way = toward[far][axis] * w[1 - far];
    uint32_t near = at[1 - far];
    if (way > 0)
      add_stretch(s, line, later(s, end[0], near, axis), end[1], axis);
    else
      add_stretch(s, line, end[0], earlier(s, end[1], near, axis), axis);
    return;
  }
  uint32_t lo = earlier(s, at[0], at[1], axis),
           hi = later(s, at[0], at[1], axis);
  if (w[0] == w[1]) {
    add_stretch(s, line, later(s, end[0], lo, axis),
                earlier(s, end[1], hi, axis), axis);
    return;
  }
  add_stretch(s, line, end[0], earlier(s, end[1], lo, axis), axis);
  add_stretch(s, line, later(s, end[0], hi, axis), end[1], axis);
}

static void add_picture(struct stretches *s) {
  struct hsr_clipper *c = s->c;
  for (uint32_t k = 0; k < HSR_N_BORDERS; k++)
    s->border[k] = hsr_line_number(
        c->lines, (struct hsr_line_name){HSR_LINE_BORDER, k, 0}, &s->way[k]);
  for (uint32_t k = 0; k < HSR_N_BORDERS; k++) {
    struct hsr_border_edge *e =
        HSR_CLIPPER_NEW(c, &s->edges, struct hsr_border_edge);
    uint32_t from =
                 hsr_crossing(c->lines, s->border[(k + 3) % 4], s->border[k]),
             to = hsr_crossing(c->lines, s->border[k], s->border[(k + 1) % 4]);
    if (e)
      *e = hsr_border_make(c, s->border[k], s->way[k], from, to);
  }
}

/* Of the strands between the ends of strand k, those that are images of edges;
 * and whether k is the first of these, or of all where there are none. */
static uint32_t count_alike(struct hsr_clipper *c, uint32_t k,
                            uint32_t n_border, bool *first) {
  const struct hsr_strand *all = c->strands[0].items, *s = &all[k];
  uint32_t n = 0, least = k;
  const struct hsr_knot *knot = hsr_clipper_knot(c, s->edge.from);
  for (uint32_t l = knot ? knot->leaving[0] : 0; l; l = all[l - 1].leaving)
    if (all[l - 1].edge.to == s->edge.to) {
      n += l - 1 >= n_border;
      least = l - 1 < least ? l - 1 : least;
    }
  for (uint32_t l = knot ? knot->entering[0] : 0; l; l = all[l - 1].entering)
    if (all[l - 1].edge.from == s->edge.to) {
      n += l - 1 >= n_border;
      least = l - 1 < least ? l - 1 : least;
    }
  *first = least == k;
  return n;
}

/* Adds a strand to the border, if the area is on one side of it only. A point
 * beside a strand, displaced as samples are, is on the right of one that runs
 * to the right, and on the left of one that runs straight down or up. Beyond
 * the picture there is no area. */
static void add_strand(struct hsr_clipper *c, uint32_t face, uint32_t k,
                       uint32_t n_border) {
  bool first;
  uint32_t n = count_alike(c, k, n_border, &first);
  struct hsr_border_edge e = HSR_ITEM(struct hsr_strand, c->strands[0], k).edge;
  bool on_border = k < n_border;
  if (!first || (!on_border && n % 2 == 0))
    return;
  bool parity = hsr_parity_between(c->lines, face, e.from, e.to);
  /* The displacement is (e, e^2) along (sx, sy). On which side of the strand is
   * that? The function of its line grows along (a, b). */
  double d[2];
  hsr_line_direction(c->lines, e.line, d);
  int beside = d[1] < 0 || (d[1] == 0 && d[0] > 0) ? 1 : -1;
  bool positive = beside > 0 ? parity : parity != (n % 2 == 1);
  bool negative = beside > 0 ? parity != (n % 2 == 1) : parity;
  if (on_border) { /* its sign is towards the picture */
    positive = e.sign > 0 && positive;
    negative = e.sign < 0 && negative;
  }
  if (positive == negative)
    return;
  /* d runs so that the positive side is on the right of it. */
  int sign = positive ? 1 : -1;
  if (sign != e.sign)
    e = hsr_border_make(c, e.line, sign, e.to, e.from);
  hsr_border_add(c, &e);
}

static void add_by_parity(struct hsr_clipper *c, const struct hsr_world *world,
                          uint32_t face) {
  struct stretches s = {.c = c, .edges = {NULL, 0, 0}};
  add_picture(&s);
  for (uint32_t k = 0; k < hsr_face_size(world, face) && !c->failed; k++)
    add_image(&s, world, face, k);
  if (c->failed)
    return;
  c->round++;
  c->divisions.n = c->strands[0].n = c->ends[0].n = 0;
  uint32_t n = (uint32_t)s.edges.n;
  const struct hsr_border_edge *edge = s.edges.items;
  for (uint32_t k = 0; k < n; k++)
    for (uint32_t l = k + 1; l < n; l++)
      hsr_border_cut(c, &edge[k], k, &edge[l], l, 0);
  const uint32_t start[3] = {0, HSR_N_BORDERS, n};
  hsr_border_divide(c, edge, start, 2, 0);
  if (c->failed)
    return;
  uint32_t n_border = HSR_ITEM(uint32_t, c->ends[0], 0);
  for (uint32_t k = 0; k < c->strands[0].n && !c->failed; k++)
    add_strand(c, face, k, n_border);
}

/* --- A face --------------------------------------------------------------- */

void hsr_areas_of_face(struct hsr_clipper *c, const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t face,
                       double nearest, struct hsr_area_list *list) {
  struct hsr_area_list made = {NULL, NULL};
  int side = convex_side(c, world, face);
  if (side)
    add_convex(c, world, face, side);
  else
    add_by_parity(c, world, face);
  if (c->border.n)
    hsr_areas_of_border(c, face, nearest, &made);
  for (uint32_t k = 0; side && k < HSR_N_BORDERS; k++)
    clip_by(c, &made, (struct hsr_line_name){HSR_LINE_BORDER, k, 0});
  if (!view->parallel)
    clip_by(c, &made, (struct hsr_line_name){HSR_LINE_HORIZON, face, 0});
  clip_by(c, &made, (struct hsr_line_name){HSR_LINE_NEAR, face, 0});
  hsr_areas_join(list, &made);
}
