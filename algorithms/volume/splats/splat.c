/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splats composited one after the other, from back to front or from front to
 * back.
 *
 * Source      L. Westover, "Footprint Evaluation for Volume Rendering",
 *             SIGGRAPH 1990; J. E. Swan II, PhD thesis, Ohio State University,
 *             1998, 1.2.1 and 2.3
 * Full        the room of a pixel is 65536 less its opacity. From front to back, a
 *             splat adds nothing where there is too little room for it:
 *             docs/composited-picture.md. The greatest room of each block of
 *             pixels is kept. A splat is left out if all blocks that it may touch
 *             have too little room. A piece of a row of samples is left out if
 *             they have too little for the most opaque splat of the palette.
 *             Once FEW splats were drawn, and as many as there are blocks around
 *             them, these blocks are looked at again.
 * Order       splats that are wider than a cell have no order that is right. That
 *             of pbtf is a part of the definition; how far the picture of
 *             another one is from it can be measured.
 *
 * Notation, invariant, ties, departures and cost are those of splats.h. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"

#include <string.h>

enum { BLOCK = 4, FEW = 4096 };

/* The picture is defined by the sequence of pbtf. */
enum { ORDER, NESTING };
static const struct hsr_word orders[] = {
    {"pbtf", "octant by octant: the sequence of the definition", 0},
    {"btf", "three loops towards the view plane", HSR_KNOWN_WRONG},
    {"wbtf", "slices along the view outermost", HSR_KNOWN_WRONG},
    {"vbuffer", "by distance within a slice", HSR_KNOWN_WRONG},
    {"ippbtf", "octants interleaved", HSR_KNOWN_WRONG},
    {"octree-order", "an octree over the grid", HSR_KNOWN_WRONG},
    {NULL}};
static const enum hsr_grid_order order_of[] = {
    HSR_PBTF, HSR_BTF, HSR_WBTF, HSR_VBUFFER, HSR_IPPBTF, HSR_OCTREE};
/* In the order of hsr_grid_nesting. */
static const struct hsr_word nestings[] = {
    {"zyx", "z in the outermost loop, x in the innermost", 0},
    {"zxy", "likewise", HSR_KNOWN_WRONG},
    {"yzx", "likewise", HSR_KNOWN_WRONG},
    {"yxz", "likewise", HSR_KNOWN_WRONG},
    {"xzy", "likewise", HSR_KNOWN_WRONG},
    {"xyz", "likewise", HSR_KNOWN_WRONG},
    {NULL}};
static const struct hsr_option options[] = {
    [ORDER] = {"order", "in which samples are visited", orders, 0, 5, 0},
    [NESTING] = {"nesting", "how the loops of pbtf, btf and ippbtf are nested",
                 nestings, 0, 5, 0},
    {NULL}};

struct model {
  struct hsr_splat_picture picture;
  uint32_t *room; /* the greatest of each block, when it was last looked at */
  int blocks;     /* a row */
  int drawn;      /* splats since the last look, and where they were */
  struct hsr_window where;
};

/* --- Over ----------------------------------------------------------------- */

static void draw_over(struct hsr_splats *s, struct hsr_splat_tile *tile,
                      const struct hsr_placed *p) {
  struct model *m = tile->model;
  hsr_splats_put(s, p, &m->picture, HSR_PUT_OVER);
}

/* --- Under ---------------------------------------------------------------- */

static size_t blocks_of(const struct model *m) {
  const struct hsr_window *w = m->picture.window;
  int height = w->y1 - w->y0;
  return (size_t)(height + BLOCK - 1) / BLOCK * (size_t)m->blocks;
}

static void empty_blocks(struct model *m) {
  for (size_t k = 0; k < blocks_of(m); k++)
    m->room[k] = 65536;
  m->drawn = 0;
  m->where = hsr_splats_none(m->picture.window);
}

/* The most that a splat gives to a pixel, be it opacity or weight. */
static uint32_t most_given(const struct hsr_splats *s, uint32_t opacity,
                           uint32_t energy) {
  uint64_t most = s->splatting.normalise ? 65536 : opacity;
  if (s->veils) {
    uint64_t length = (uint64_t)s->length[opacity] * energy >> 16;
    return hsr_splats_veil(s, s->weight[0] * length >> 16);
  }
  return (uint32_t)(s->weight[0] * (most * energy >> 16) >> 16);
}

static enum hsr_status open_blocks(struct hsr_splats *s, struct model *m) {
  const struct hsr_window *w = m->picture.window;
  m->blocks = (w->x1 - w->x0 + BLOCK - 1) / BLOCK;
  m->room = HSR_NEW(s->job->scratch, uint32_t, blocks_of(m));
  if (!m->room)
    return HSR_E_NOMEM;
  empty_blocks(m);
  return HSR_OK;
}

/* The greatest room of a block: by the least opacity of each of its columns. */
static uint32_t room_of(const struct model *m, int x0, int y0) {
  const struct hsr_window *w = m->picture.window;
  int width = w->x1 - w->x0, height = w->y1 - w->y0;
  int columns = width - x0 < BLOCK ? width - x0 : BLOCK,
      rows = height - y0 < BLOCK ? height - y0 : BLOCK;
  const struct hsr_splat_picture *picture = &m->picture;
  uint16_t least[BLOCK][4];
  memset(least, 0xff, sizeof least);
  for (int y = y0; y < y0 + rows; y++) {
    uint16_t(*row)[4] =
        picture->rgba + (size_t)y * picture->stride + (size_t)x0;
    for (int x = 0; x < BLOCK; x++)
      for (int c = 0; c < 4; c++)
        least[x][c] = row[x][c] < least[x][c] ? row[x][c] : least[x][c];
  }
  uint32_t opacity = UINT16_MAX;
  for (int x = 0; x < columns; x++)
    opacity = least[x][HSR_SPLAT_OPACITY] < opacity
                  ? least[x][HSR_SPLAT_OPACITY]
                  : opacity;
  return 65536 - opacity;
}

/* The blocks that a part of the tile touches: indices, and one more. */
static struct hsr_window blocks_in(const struct model *m,
                                   const struct hsr_window *box) {
  int x = m->picture.window->x0, y = m->picture.window->y0;
  return (struct hsr_window){(box->x0 - x) / BLOCK, (box->y0 - y) / BLOCK,
                             (box->x1 - x + BLOCK - 1) / BLOCK,
                             (box->y1 - y + BLOCK - 1) / BLOCK};
}

static int count_blocks(const struct model *m, const struct hsr_window *box) {
  const struct hsr_window blocks = blocks_in(m, box);
  return (blocks.x1 - blocks.x0) * (blocks.y1 - blocks.y0);
}

static void look_at_blocks(const struct hsr_splats *s, struct model *m) {
  /* the greatest opacity that a splat gives to a pixel */
  const uint32_t most = most_given(s, s->most_opacity, 65536);
  const struct hsr_window blocks = blocks_in(m, &m->where);
  for (int y = blocks.y0; y < blocks.y1; y++)
    for (int x = blocks.x0; x < blocks.x1; x++) {
      uint32_t *room = &m->room[(size_t)y * (size_t)m->blocks + (size_t)x];
      if (*room * most >= 65536)
        *room = room_of(m, BLOCK * x, BLOCK * y);
    }
  m->drawn = 0;
  m->where = hsr_splats_none(m->picture.window);
}

static bool is_hidden(const struct hsr_splats *s,
                      const struct hsr_splat_tile *tile, uint32_t opacity,
                      uint32_t energy, const struct hsr_window *box) {
  const struct model *m = tile->model;
  uint32_t most = most_given(s, opacity, energy);
  const struct hsr_window blocks = blocks_in(m, box);
  for (int y = blocks.y0; y < blocks.y1; y++)
    for (int x = blocks.x0; x < blocks.x1; x++)
      if (m->room[(size_t)y * (size_t)m->blocks + (size_t)x] * most >= 65536)
        return false;
  return true;
}

static void draw_under(struct hsr_splats *s, struct hsr_splat_tile *tile,
                       const struct hsr_placed *p) {
  struct model *m = tile->model;
  hsr_splats_put(s, p, &m->picture, HSR_PUT_UNDER);
  hsr_splats_widen(&m->where, &p->box);
  if (++m->drawn >= FEW && m->drawn >= count_blocks(m, &m->where))
    look_at_blocks(s, m);
}

/* --- A frame -------------------------------------------------------------- */

static enum hsr_status open(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  return hsr_splats_open(s, tile, &m->picture) || open_blocks(s, m)
             ? HSR_E_NOMEM
             : HSR_OK;
}

static void finish(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  hsr_splats_finish(s, &((struct model *)tile->model)->picture);
}

static const struct hsr_splats_module over = {
    .size = sizeof(struct model), .open = open, .draw = draw_over};
static const struct hsr_splats_module under = {.size = sizeof(struct model),
                                               .open = open,
                                               .draw = draw_under,
                                               .is_hidden = is_hidden};

static enum hsr_status draw(struct hsr_splats *s, struct hsr_error *err) {
  const long *option = s->job->option;
  return hsr_splats_visit(s, order_of[option[ORDER]], (int)option[NESTING],
                          s->splatting.model == HSR_UNDER, err);
}

static enum hsr_status draw_frame(const struct hsr_job *job,
                                  struct hsr_error *err) {
  struct hsr_splats s;
  if (hsr_splats_begin(&s, job) ||
      hsr_splats_divide(&s, s.splatting.model == HSR_UNDER ? &under : &over))
    return hsr_fail_nomem(err);
  enum hsr_status status = draw(&s, err);
  hsr_splats_each(&s, finish);
  return status;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_splats_accumulate(job, draw_frame, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_splats_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"take the samples of the grid in an order, from the back or the front"},
    {"for each row of samples, or piece of it from the front; is its box out "
     "of "
     "the window, or all full? leave it",
     HSR_RAISES(HSR_SPLAT_ROWS)},
    {"  for each sample of it that is kept", HSR_RAISES(HSR_SPLAT_CELLS)},
    {"    shade it by its density, its gradient and the light"},
    {"      find its footprint; is it out of sight, or all full? leave it",
     HSR_RAISES(HSR_SPLAT_SPLATS)},
    {"    for each pixel of the footprint, composite weight times colour",
     HSR_RAISES(HSR_SPLAT_UPDATES)},
    {"write the pixels that are not empty", HSR_RAISES(HSR_SPLAT_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(splat) = {
    .name = "splat",
    .title = "Splatting, splat over splat",
    .authors = "L. Westover; J. E. Swan II",
    .year = 1990,
    .source = "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH "
              "1990; Swan, Object-Order Rendering of Discrete Objects, PhD "
              "thesis, Ohio State University, 1998",
    .sort_order = "Z(XY)",
    .taxonomy = HSR_VOLUME_SPACE,
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_OVER | 1 << HSR_UNDER}},
    .flags = HSR_INSTANCED | HSR_OWN_TILES,
    .parts = uses,
    .outline = outline,
    .options = options,
    .render = render};
