/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells over the picture, as looks/solids.js of the page draws them: a cube of a tree,
 * a cell of a pyramid of voxels or of samples, a texel. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <string.h>

/* --- Boxes of the world --------------------------------------------------- */

/* The edges of a box, by the images of its corners; some may have none. */
static void add_wires(struct frames *f, const json_t *corners) {
  for (size_t c = 0; c < 8; c++)
    for (size_t axis = 1; axis < 8; axis *= 2) {
      const json_t *p = json_array_get(corners, c),
                   *q = json_array_get(corners, c | axis);
      if (!(c & axis))
        frames_add_line(f, p, q);
    }
}

/* Borrowed: [node, instance, corners, image]; NULL: there is none. */
static const json_t *cube_of(const struct frames *f, json_int_t node,
                             json_int_t instance) {
  size_t k;
  const json_t *cube;
  json_array_foreach(json_object_get(f->structure, "cubes"), k, cube) {
    if (json_integer_value(json_array_get(cube, 0)) == node &&
        json_integer_value(json_array_get(cube, 1)) == instance)
      return cube;
  }
  return NULL;
}

/* A cell, and the window through which it is looked at. */
struct visit {
  uint32_t cell;
  struct hsr_window window;
};

bool frames_follow_visits(struct frames *f, const struct hsr_event *event) {
  if (event->a.kind != HSR_OF_CELL || event->b.kind != HSR_OF_WINDOW ||
      !json_object_get(f->structure, "isBoxes"))
    return true;
  if (!hsr_arena_grow(&f->arena, &f->visited, sizeof(struct visit)))
    return false;
  ((struct visit *)f->visited.items)[f->visited.n - 1] =
      (struct visit){event->a.id[0], event->window};
  return true;
}

/* The window of the last visit of a cell. */
static void mark_visit(struct frames *f, uint32_t cell) {
  const struct visit *visit = f->visited.items;
  size_t k = f->visited.n;
  while (k && visit[k - 1].cell != cell)
    k--;
  if (!k)
    return;
  const struct hsr_window *w = &visit[k - 1].window;
  cairo_rectangle(f->cairo, w->x0, w->y0, w->x1 - w->x0, w->y1 - w->y0);
  frames_stroke(f, FRAME_INK, 1.2, FRAME_SOLID);
}

/* An opening between two cells. */
static void mark_opening(struct frames *f, const json_t *image,
                         unsigned colour) {
  frames_add_polygon(f, image);
  frames_set_colour(f->cairo, colour, .4);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, colour, 3.5, FRAME_SOLID);
}

/* The box of a node; of an opening, that of the cell beyond it, too. False: it has
 * none. */
static bool mark_cube(struct frames *f, const struct hsr_event *event,
                      const struct hsr_subject *subject, unsigned colour,
                      enum frame_dash dash) {
  json_int_t node = subject->id[0], instance = subject->id[1] == HSR_NO_ID
                                                   ? -1
                                                   : (json_int_t)subject->id[1];
  const json_t *cube = cube_of(f, node, instance),
               *image = json_array_get(cube, 3);
  if (json_array_size(image) > 2) {
    mark_opening(f, image, colour);
    mark_visit(f, event->a.id[0]);
  }
  if (json_is_array(image))
    cube = cube_of(f, node, -1);
  if (!cube)
    return false;
  add_wires(f, json_array_get(cube, 2));
  frames_stroke(f, colour, 2, dash);
  return true;
}

/* The end of the edge of cell number `at` along an axis of n voxels. */
static double end_of(double lo, double size, json_int_t n, json_int_t at,
                     json_int_t side) {
  json_int_t end = at * side < n ? at * side : n;
  return lo + size * (double)end;
}

/* Cell number id[1] of level id[0] of a pyramid of voxels, four a side in each level;
 * below the last level, a voxel. */
static void mark_voxels(struct frames *f, const struct hsr_subject *subject,
                        unsigned colour, enum frame_dash dash) {
  json_int_t n[3], across[3], at[3], side = 1, k = subject->id[1];
  double size = json_number_value(json_object_get(f->voxels, "size"));
  long levels = 1;
  for (int axis = 0; axis < 3; axis++) {
    n[axis] = json_integer_value(
        json_array_get(json_object_get(f->voxels, "n"), (size_t)axis));
    long own = 0;
    for (json_int_t x = 1; x < n[axis]; x *= 4)
      own++;
    levels = own > levels ? own : levels;
  }
  for (long l = subject->id[0]; l < levels; l++)
    side *= 4;
  for (int axis = 0; axis < 3; axis++) {
    across[axis] = (n[axis] + side - 1) / side;
    at[axis] = axis < 2 ? k % across[axis] : k;
    k /= across[axis];
  }
  json_t *corners = json_array();
  for (int c = 0; c < 8; c++) {
    double corner[1][3];
    for (int axis = 0; axis < 3; axis++)
      corner[0][axis] =
          end_of(json_number_value(json_array_get(
                     json_object_get(f->voxels, "lo"), (size_t)axis)),
                 size, n[axis], at[axis] + (c >> axis & 1), side);
    json_t *image =
        lesson_image_json(&f->run->view, (const double(*)[3])corner, 1);
    hsr_json_append(&corners, json_incref(json_array_get(image, 0)));
    json_decref(image);
  }
  add_wires(f, corners);
  frames_stroke(f, colour, 2, dash);
  json_decref(corners);
}

/* --- Textures ------------------------------------------------------------- */

/* The texels of a level that the steps of a run are about. */
struct texture {
  uint32_t level, lo[2], hi[2];
};

static struct texture *texture_of(const struct frames *f, uint32_t level) {
  struct texture *t = f->textures.items;
  for (size_t k = 0; k < f->textures.n; k++)
    if (t[k].level == level)
      return &t[k];
  return NULL;
}

static bool has_window(const struct hsr_event *event) {
  return event->window.x0 < event->window.x1 &&
         event->window.y0 < event->window.y1;
}

static bool is_texel(const struct frames *f, const struct hsr_event *event) {
  return event->a.kind == HSR_OF_CELL && lesson_has_texels(&f->run->setup);
}

void frames_note_cells(struct frames *f, const struct hsr_event *event) {
  if (event->counter >= HSR_MAX_COUNTERS)
    return;
  f->has_third[event->counter][0] |= event->a.id[2] != 0;
  f->has_third[event->counter][1] |= event->b.id[2] != 0;
}

bool frames_note_texel(struct frames *f, const struct hsr_event *event) {
  if (!is_texel(f, event))
    return true;
  struct texture *t = texture_of(f, event->a.id[0]);
  const uint32_t *at = event->a.id + 1;
  if (!t) {
    if (!hsr_arena_grow(&f->arena, &f->textures, sizeof *t))
      return false;
    t = (struct texture *)f->textures.items + f->textures.n - 1;
    *t = (struct texture){event->a.id[0], {at[0], at[1]}, {at[0], at[1]}};
  }
  for (int k = 0; k < 2; k++) {
    t->lo[k] = at[k] < t->lo[k] ? at[k] : t->lo[k];
    t->hi[k] = at[k] > t->hi[k] ? at[k] : t->hi[k];
  }
  return true;
}

/* --- What is read for a pixel --------------------------------------------- */

bool frames_follow_texels(struct frames *f, const struct hsr_event *event) {
  if (frames_has_key(f, event, "texture-ray"))
    f->read.n = 0;
  if (!frames_has_key(f, event, "texel-read"))
    return true;
  if (!hsr_arena_grow(&f->arena, &f->read, sizeof event->a.id))
    return false;
  uint32_t(*read)[3] = f->read.items;
  memcpy(read[f->read.n - 1], event->a.id, sizeof *read);
  return true;
}

/* The middle of the layer at a texel, in the picture. */
static void mark_in_picture(struct frames *f, const uint32_t texel[3],
                            unsigned colour) {
  const struct hsr_grid *grid = f->run->scene->grid;
  int across = 0, axis[2] = {0, 0}, n = 0;
  while (across < 3 && grid->n[across] != 1)
    across++;
  for (int k = 0; k < 3 && n < 2; k++)
    if (k != across)
      axis[n++] = k;
  if (across == 3 || texel[1] >= grid->n[axis[0]] ||
      texel[2] >= grid->n[axis[1]])
    return;
  double at[4][3];
  for (int c = 0; c < 4; c++) {
    at[c][across] = (grid->bound[across][0] + grid->bound[across][1]) / 2;
    at[c][axis[0]] = grid->bound[axis[0]][texel[1] + (c == 1 || c == 2)];
    at[c][axis[1]] = grid->bound[axis[1]][texel[2] + (c >= 2)];
  }
  json_t *image = lesson_image_json(&f->run->view, (const double(*)[3])at, 4);
  frames_add_polygon(f, image);
  frames_set_colour(f->cairo, colour, .15);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, colour, 1.2, FRAME_SOLID);
  json_decref(image);
}

/* The left end of map number n, and the size of a texel there. */
static double map_of(const struct frames *f, const struct texture *t, size_t n,
                     double *unit) {
  double across = t->hi[0] - t->lo[0] + 1., down = t->hi[1] - t->lo[1] + 1.;
  *unit = .32 * f->run->view.m / fmax(across, down);
  return 1 + (double)n * .35 * f->run->view.m;
}

static void mark_map(struct frames *f, const struct texture *t, size_t n) {
  double unit, left = map_of(f, t, n, &unit);
  cairo_rectangle(f->cairo, left, 1, unit * (t->hi[0] - t->lo[0] + 1.),
                  unit * (t->hi[1] - t->lo[1] + 1.));
  frames_stroke(f, FRAME_INK, 1.2, FRAME_SOLID);
}

static void mark_in_map(struct frames *f, const struct texture *t, size_t n,
                        const uint32_t texel[3], unsigned colour) {
  double unit, left = map_of(f, t, n, &unit);
  cairo_rectangle(f->cairo, left + unit * (texel[1] - t->lo[0]),
                  1 + unit * (texel[2] - t->lo[1]), unit, unit);
  frames_set_colour(f->cairo, colour, .35);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, colour, .8, FRAME_SOLID);
}

/* The number of the map of a level: as on the page, that of what was read last is the
 * first. */
static size_t map_number(const struct frames *f, uint32_t level) {
  const uint32_t(*read)[3] = f->read.items;
  size_t n = 0;
  for (size_t k = f->read.n; k-- > 0 && read[k][0] != level;) {
    bool is_new = true;
    for (size_t l = k + 1; l < f->read.n; l++)
      is_new = is_new && read[l][0] != read[k][0];
    n += is_new;
  }
  return n;
}

void frames_mark_read(struct frames *f, const struct hsr_event *event,
                      unsigned colour) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  bool is_end = a->counters[event->counter].kind == HSR_ACCEPT;
  if (!f->read.n || (!is_end && !frames_has_key(f, event, "texel-read")))
    return;
  const uint32_t(*read)[3] = f->read.items;
  for (size_t k = 0; k < f->read.n; k++) {
    const struct texture *t = texture_of(f, read[k][0]);
    size_t n = is_end ? map_number(f, read[k][0]) : 0;
    if (t && is_end)
      mark_map(f, t, n);
    if (t && (is_end || read[k][0] == event->a.id[0]))
      mark_in_map(f, t, n, read[k], colour);
    if (!read[k][0] && a->numbered == HSR_NUMBERED_TEXELS)
      mark_in_picture(f, read[k], colour);
  }
}

/* A texel: in a small map of its level. */
static void mark_texel(struct frames *f, const struct hsr_event *event,
                       unsigned colour) {
  const struct texture *t = texture_of(f, event->a.id[0]);
  if (!t)
    return;
  double across = t->hi[0] - t->lo[0] + 1., down = t->hi[1] - t->lo[1] + 1.,
         unit = .32 * f->run->view.m / fmax(across, down);
  cairo_rectangle(f->cairo, 1, 1, unit * across, unit * down);
  frames_stroke(f, FRAME_INK, 1.2, FRAME_SOLID);
  cairo_rectangle(f->cairo, 1 + unit * (event->a.id[1] - t->lo[0]),
                  1 + unit * (event->a.id[2] - t->lo[1]), unit, unit);
  frames_set_colour(f->cairo, colour, .7);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, colour, 2, FRAME_SOLID);
}

/* --- Regions of a visibility map ------------------------------------------- */

/* A rectangle of samples that lies in the region of a node of the map. */
struct region {
  uint32_t node;
  struct hsr_window window;
};

bool frames_note_region(struct frames *f, const struct hsr_event *event) {
  if (!frames_has_key(f, event, "region-compared") ||
      frames_has_outcome(f, event, "divided"))
    return true;
  if (!hsr_arena_grow(&f->arena, &f->regions, sizeof(struct region)))
    return false;
  ((struct region *)f->regions.items)[f->regions.n - 1] =
      (struct region){event->a.id[0], event->window};
  return true;
}

/* Whether a cell is a region of a map, not a node of a tree of planes. */
static bool is_region(const struct frames *f, const struct hsr_subject *cell) {
  return cell->id[1] == 0 &&
         lesson_has_counter(f->run->setup.algorithm, "region-compared");
}

static void mark_region(struct frames *f, uint32_t node, unsigned colour,
                        double fill) {
  const struct region *region = f->regions.items;
  for (size_t k = 0; k < f->regions.n; k++)
    if (region[k].node == node) {
      const struct hsr_window *w = &region[k].window;
      cairo_rectangle(f->cairo, w->x0, w->y0, w->x1 - w->x0, w->y1 - w->y0);
    }
  frames_set_colour(f->cairo, colour, fill);
  cairo_fill(f->cairo);
}

/* --- Squares of the picture ----------------------------------------------- */

static void mark_square(struct frames *f, const struct hsr_subject *cell,
                        unsigned colour, enum frame_dash dash) {
  double side = ldexp(1, (int)cell->id[0] - HSR_SQUARES_OF_PIXELS);
  cairo_rectangle(f->cairo, cell->id[1] * side, cell->id[2] * side, side, side);
  frames_set_colour(f->cairo, colour, dash == FRAME_SOLID ? .3 : .18);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, colour, 2, dash);
}

/* --- Nodes of a BSP tree --------------------------------------------------- */

/* The plane of a node, if the cells of the steps are these. */
static void mark_node(struct frames *f, const struct hsr_subject *cell,
                      unsigned colour, enum frame_dash dash) {
  const json_t *node =
      json_array_get(json_object_get(f->structure, "nodes"), cell->id[0]);
  bool is_solid = dash == FRAME_SOLID;
  if (!node || json_array_size(json_object_get(f->structure, "cubes")))
    return;
  frames_mark_plane_of(
      f, json_integer_value(json_array_get(node, 0)),
      &(struct frame_look){colour, is_solid ? .3 : .18, 2, dash});
}

/* --- Cells ---------------------------------------------------------------- */

void frames_mark_cell(struct frames *f, const struct hsr_event *event,
                      const struct hsr_subject *subject, unsigned colour,
                      enum frame_dash dash) {
  const struct hsr_window *w = &event->window;
  bool has_third = f->has_third[event->counter][subject == &event->b];
  bool is_node = json_object_get(f->structure, "nodes") && !has_third;
  if (subject->kind != HSR_OF_CELL)
    return;
  if (f->voxels)
    mark_voxels(f, subject, colour, dash);
  else if (is_region(f, subject))
    mark_region(f, subject->id[0], colour, dash == FRAME_SOLID ? .45 : .27);
  else if (!has_third && mark_cube(f, event, subject, colour, dash))
    return;
  else if (json_object_get(f->structure, "separators") || is_node)
    mark_node(f, subject, colour, dash);
  else if (f->run->setup.algorithm->numbered == HSR_NUMBERED_SQUARES)
    mark_square(f, subject, colour, dash);
  else if (is_texel(f, event))
    mark_texel(f, event, colour);
  else if (has_window(event)) {
    cairo_rectangle(f->cairo, w->x0, w->y0, w->x1 - w->x0, w->y1 - w->y0);
    frames_set_colour(f->cairo, colour, dash == FRAME_SOLID ? .15 : .09);
    cairo_fill_preserve(f->cairo);
    frames_stroke(f, colour, 1.5, dash);
  }
}
