/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/warnock/surround.h"
#include "common/exact/predicates.h"

#include <math.h>

enum hsr_status hsr_surround_init(struct hsr_surround *s,
                                  const struct hsr_screen *screen,
                                  enum hsr_surround_way way,
                                  struct hsr_arena *arena,
                                  struct hsr_tally *tally) {
  *s = (struct hsr_surround){
      .screen = screen, .tally = tally, .way = way, .columns = *screen->view};
  struct hsr_view *turned = &s->columns;
  const struct hsr_view *view = screen->view;
  for (int k = 0; k < 3; k++) {
    turned->R[k] = view->U[k];
    turned->U[k] = -view->R[k];
  }
  turned->whole_m = view->whole_n;
  turned->whole_n = view->whole_m;
  turned->left = view->top;
  turned->top = view->left;
  s->convex = HSR_NEW_ZEROED(arena, signed char, screen->world->n_faces);
  return s->convex ? HSR_OK : HSR_E_NOMEM;
}

/* --- A face --------------------------------------------------------------- */

struct ring {
  uint32_t face, n;
  const uint32_t *vertex;
};

static struct ring ring_of(const struct hsr_surround *s, uint32_t f) {
  const struct hsr_world *world = s->screen->world;
  return (struct ring){f, hsr_face_size(world, f),
                       world->mesh.vertex + world->mesh.start[f]};
}

/* The way that the picture of a face turns at its corner b: +1 or -1. 0: it is
 * not certain. The bound is that of hsr_edge_side. */
static int turn_at(const struct hsr_screen *screen, uint32_t a, uint32_t b,
                   uint32_t c) {
  double dx = screen->sx[b] - screen->sx[a], dy = screen->sy[b] - screen->sy[a];
  double ex = screen->sx[c] - screen->sx[b], ey = screen->sy[c] - screen->sy[b];
  double turn = dx * ey - dy * ex;
  double bound = 4 * HSR_DELTA * (fabs(dx) + fabs(dy) + fabs(ex) + fabs(ey)) +
                 16 * HSR_DELTA * HSR_DELTA;
  return turn > bound ? 1 : turn < -bound ? -1 : 0;
}

/* If all corners turn one way, a ring that goes around once goes down once, and
 * up once. */
static bool is_convex(const struct hsr_surround *s, struct ring ring) {
  const struct hsr_screen *screen = s->screen;
  if (ring.n == 3)
    return true;
  int way = 0, n_changes = 0;
  for (uint32_t k = 0; k < ring.n; k++) {
    uint32_t a = ring.vertex[k], b = ring.vertex[(k + 1) % ring.n],
             c = ring.vertex[(k + 2) % ring.n];
    int turn = turn_at(screen, a, b, c);
    double down = screen->sy[b] - screen->sy[a];
    double next = screen->sy[c] - screen->sy[b];
    bool sure = fabs(down) > 2 * HSR_DELTA && fabs(next) > 2 * HSR_DELTA;
    if (!turn || (way && turn != way) || (ring.n > 4 && !sure))
      return false;
    way = turn;
    n_changes += (down > 0) != (next > 0);
  }
  return ring.n == 4 || n_changes == 2;
}

/* --- Sides ---------------------------------------------------------------- */

static bool by_sides(struct hsr_surround *s, struct ring ring, int i, int j) {
  int side = 0;
  for (uint32_t k = 0, last = ring.n - 1; k < ring.n; last = k++) {
    uint32_t a = ring.vertex[last], b = ring.vertex[k];
    int here = hsr_edge_side(s->screen, a, b, i, j, s->tally);
    bool differs = here && side && here != side;
    HSR_STEP(s->tally, HSR_EDGE_SIDES, HSR_EDGE(a, b, ring.face),
             HSR_THE_WINDOW, HSR_AT(i, j), !differs);
    if (differs)
      return false;
    side = here ? here : side;
  }
  return side != 0;
}

/* --- Crossings ------------------------------------------------------------ */

static bool by_crossings(struct hsr_surround *s, struct ring ring, int i,
                         int j) {
  bool odd = false;
  uint32_t a = ring.vertex[ring.n - 1];
  int row_a = hsr_row_side(s->screen, a, j, s->tally);
  for (uint32_t k = 0; k < ring.n; k++) {
    uint32_t b = ring.vertex[k];
    int row_b = hsr_row_side(s->screen, b, j, s->tally);
    HSR_STEP(s->tally, HSR_EDGE_ROWS, HSR_EDGE(a, b, ring.face), HSR_THE_WINDOW,
             HSR_AT(i, j), row_a != row_b);
    if (row_a != row_b) {
      /* Whether the sample is to the right of the edge. */
      bool crosses = hsr_edge_side(s->screen, row_a < 0 ? a : b,
                                   row_a < 0 ? b : a, i, j, s->tally) < 0;
      HSR_STEP(s->tally, HSR_EDGE_CROSSINGS, HSR_EDGE(a, b, ring.face),
               HSR_THE_WINDOW, HSR_AT(i, j), crosses);
      odd ^= crosses;
    }
    a = b;
    row_a = row_b;
  }
  return odd;
}

/* --- Angles --------------------------------------------------------------- */

/* +1: vertex v is to the right of the column of samples i, -1 to its left. */
static int column_side(struct hsr_surround *s, uint32_t v, int i) {
  const struct hsr_mesh *mesh = &s->screen->world->mesh;
  double sx = hsr_sample_x(s->screen->view, i), right = s->screen->sx[v] - sx;
  if (right > HSR_DELTA)
    return 1;
  if (right < -HSR_DELTA)
    return -1;
  double p[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
  s->tally->exact[HSR_ASK_ROW]++;
  return hsr_exact_row_side(&s->columns, p, sx, &s->tally->out_of_memory);
}

/* The quadrant about sample (i, j) that a corner is in: 0 at the upper right,
 * and on anticlockwise. */
static int quadrant_of(struct hsr_surround *s, uint32_t f, uint32_t v, int i,
                       int j) {
  bool below = hsr_row_side(s->screen, v, j, s->tally) > 0;
  bool left = column_side(s, v, i) < 0;
  int quadrant = below ? 2 + !left : left;
  HSR_STEP(s->tally, HSR_CORNER_QUADRANTS, HSR_VERTEX(v), HSR_FACE(f),
           HSR_AT(i, j), quadrant);
  return quadrant;
}

static bool by_angles(struct hsr_surround *s, struct ring ring, int i, int j) {
  uint32_t a = ring.vertex[ring.n - 1];
  int sum = 0, from = quadrant_of(s, ring.face, a, i, j);
  int first = from;
  for (uint32_t k = 0; k < ring.n; k++) {
    uint32_t b = ring.vertex[k];
    int to = k + 1 < ring.n ? quadrant_of(s, ring.face, b, i, j) : first;
    int by = (to - from) & 3;
    if (by == 2) {
      bool clockwise = hsr_edge_side(s->screen, a, b, i, j, s->tally) > 0;
      HSR_STEP(s->tally, HSR_EDGE_DIAGONALS, HSR_EDGE(a, b, ring.face),
               HSR_THE_WINDOW, HSR_AT(i, j), clockwise);
      by = clockwise ? -2 : 2;
    }
    sum += by == 3 ? -1 : by;
    a = b;
    from = to;
  }
  return sum / 4 % 2 != 0;
}

bool hsr_surrounds(struct hsr_surround *s, uint32_t f, int i, int j) {
  struct ring ring = ring_of(s, f);
  enum hsr_surround_way way = s->way;
  if (way == HSR_SURROUND_SIDES) {
    if (!s->convex[f])
      s->convex[f] = is_convex(s, ring) ? 1 : -1;
    way = s->convex[f] > 0 ? way : HSR_SURROUND_CROSSINGS;
  }
  bool inside = way == HSR_SURROUND_SIDES       ? by_sides(s, ring, i, j)
                : way == HSR_SURROUND_CROSSINGS ? by_crossings(s, ring, i, j)
                                                : by_angles(s, ring, i, j);
  HSR_STEP(s->tally, HSR_SURROUND_TESTS, HSR_FACE(f), HSR_THE_WINDOW,
           HSR_AT(i, j), inside);
  return inside;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"surround tests", "faces asked whether they surround a point, one by one",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW, "outside|inside"},
    {"surround: sides",
     "edges of convex faces into whose lines the point is "
     "put",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_WINDOW, "another side|one side"},
    {"surround: rows",
     "edges whose ends are compared with the line to the left", HSR_COMPARE,
     HSR_OF_EDGE, HSR_OF_WINDOW, "on one side|on both sides"},
    {"surround: crossings", "edges intersected with the line to the left",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_WINDOW,
     "to the right of the point|crosses it"},
    {"surround: quadrants", "corners put into quadrants about the point",
     HSR_COMPARE, HSR_OF_VERTEX, HSR_OF_FACE,
     "upper right|upper left|lower left|lower right"},
    {"surround: diagonals",
     "edges between opposite quadrants, into whose "
     "lines the point is put",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_WINDOW, "anticlockwise|clockwise"},
    {NULL}};

static const struct hsr_step steps[] = {
    {"surround test",
     HSR_EDGE_SIDES,
     HSR_KIND_EDGE_LINE,
     NULL,
     NULL,
     {{HSR_EDGE_ROWS, HSR_KIND_NUMBERS},
      {HSR_EDGE_CROSSINGS, HSR_KIND_TWO_SEGMENTS},
      {HSR_CORNER_QUADRANTS, HSR_KIND_QUADRANT},
      {HSR_EDGE_DIAGONALS, HSR_KIND_EDGE_LINE}}},
    {NULL}};

static const struct hsr_line lines[] = {
    {"surround=: where no edge meets the window, does the face surround it?",
     HSR_RAISES(HSR_SURROUND_TESTS)},
    {"  of a convex face: is the point on one side of all edges?",
     HSR_RAISES(HSR_EDGE_SIDES)},
    {"  or count the edges that cross a line from the point to the left",
     HSR_RAISES(HSR_EDGE_ROWS, HSR_EDGE_CROSSINGS)},
    {"  or add the angles that the edges subtend, in quadrants",
     HSR_RAISES(HSR_CORNER_QUADRANTS, HSR_EDGE_DIAGONALS)},
    {NULL}};

const struct hsr_part hsr_surround_part = {
    HSR_PART_SURROUND, counters, steps, NULL, {lines}};
