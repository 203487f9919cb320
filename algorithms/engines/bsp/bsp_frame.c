/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view of a world in one BSP tree: see bsp_frame.h. */
#include "algorithms/engines/bsp/bsp_frame.h"
#include "common/base/numbers.h"
#include "common/exact/predicates.h"

#include <math.h>
#include <stdlib.h>

/* --- Once ----------------------------------------------------------------- */

struct prepared {
  struct hsr_bsp bsp;
  struct hsr_box *box; /* a node; NULL: not made. In the tree's arena */
  uint32_t most_corners, most_cuts; /* of a piece */
  uint32_t most_vertices;           /* of a face */
};

void hsr_bsp_release(void *prepared) {
  struct prepared *p = prepared;
  hsr_bsp_free(&p->bsp);
  free(p);
}

enum hsr_status hsr_bsp_prepare(const struct hsr_world *world,
                                const long *option, void **prepared,
                                struct hsr_error *err) {
  struct hsr_bsp_rule one_tree = {.most = 0};
  struct prepared *p = calloc(1, sizeof *p);
  (void)option;
  *prepared = p;
  if (!p)
    return hsr_fail_nomem(err);
  for (uint32_t f = 0; f < world->n_faces; f++)
    p->most_vertices = hsr_max_u32(p->most_vertices, hsr_face_size(world, f));
  enum hsr_status status = hsr_bsp_init(&p->bsp, world, &one_tree, err);
  for (uint32_t k = 0; k < p->bsp.n_pieces && !status; k++) {
    p->most_corners = hsr_max_u32(p->most_corners, p->bsp.piece[k].n_corners);
    p->most_cuts = hsr_max_u32(p->most_cuts, p->bsp.piece[k].n_cuts);
  }
  p->most_cuts = hsr_max_u32(p->most_cuts, p->most_corners);
  return status;
}

void hsr_bsp_show(const void *prepared, struct hsr_shown *shown) {
  shown->bsp = &((const struct prepared *)prepared)->bsp;
}

static void add_box(struct hsr_box *all, const struct hsr_box *box) {
  for (int k = 0; k < 3; k++) {
    all->lo[k] = hsr_min(all->lo[k], box->lo[k]);
    all->hi[k] = hsr_max(all->hi[k], box->hi[k]);
  }
}

/* What is seen of a face that is not flat is within its reach. */
static struct hsr_box box_of_piece(const struct hsr_bsp *bsp,
                                   const struct hsr_bsp_piece *piece) {
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t k = 0; k < piece->n_corners; k++) {
    uint32_t p = bsp->corner[piece->first_corner + k].point;
    double grow = bsp->error[p] + bsp->reach[piece->face];
    const double at[3] = {bsp->x[p], bsp->y[p], bsp->z[p]};
    for (int a = 0; a < 3; a++) {
      box.lo[a] = hsr_min(box.lo[a], at[a] - grow);
      box.hi[a] = hsr_max(box.hi[a], at[a] + grow);
    }
  }
  return box;
}

/* Children come after their parents. */
static enum hsr_status make_boxes(struct prepared *p) {
  struct hsr_bsp *bsp = &p->bsp;
  p->box = HSR_NEW(&bsp->arena, struct hsr_box, bsp->n_nodes);
  for (uint32_t k = bsp->n_nodes; p->box && k--;) {
    const struct hsr_bsp_node *node = &bsp->node[k];
    p->box[k] = (struct hsr_box){{INFINITY, INFINITY, INFINITY},
                                 {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t c = 0; c < node->n_pieces; c++) {
      struct hsr_box box =
          box_of_piece(bsp, &bsp->piece[node->first_piece + c]);
      add_box(&p->box[k], &box);
    }
    if (node->front != HSR_NO_BSP)
      add_box(&p->box[k], &p->box[node->front]);
    if (node->behind != HSR_NO_BSP)
      add_box(&p->box[k], &p->box[node->behind]);
  }
  return p->box ? HSR_OK : HSR_E_NOMEM;
}

enum hsr_status hsr_bsp_prepare_bounded(const struct hsr_world *world,
                                        const long *option, void **prepared,
                                        struct hsr_error *err) {
  enum hsr_status status = hsr_bsp_prepare(world, option, prepared, err);
  return !status && make_boxes(*prepared) ? hsr_fail_nomem(err) : status;
}

/* --- A frame -------------------------------------------------------------- */

/* Divides the relevant faces into placed and loose ones. */
static void find_loose(struct hsr_bsp_frame *frame) {
  const struct hsr_screen *screen = &frame->screen;
  const struct hsr_bsp *bsp = frame->bsp;
  uint32_t next = 0;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    while (next < bsp->n_loose && bsp->loose[next] < f)
      next++;
    bool is_loose = next < bsp->n_loose && bsp->loose[next] == f;
    frame->placed[f] = !is_loose && !hsr_grazes(screen, f, bsp->reach[f]);
    if (!frame->placed[f])
      frame->loose[frame->n_loose++] = f;
  }
}

enum hsr_status hsr_bsp_frame_begin(struct hsr_bsp_frame *frame,
                                    const struct hsr_job *job) {
  const struct prepared *p = job->prepared;
  struct hsr_arena *arena = job->scratch;
  *frame = (struct hsr_bsp_frame){.job = job,
                                  .bsp = &p->bsp,
                                  .box = p->box,
                                  .most_corners = p->most_corners};
  if (hsr_screen_make(&frame->screen, job->world, job->view, arena, job->tally))
    return HSR_E_NOMEM;
  frame->waiting = HSR_NEW(arena, struct hsr_bsp_waiting,
                           hsr_bsp_most_waiting(frame->bsp->most_depth));
  frame->placed = HSR_NEW_ZEROED(arena, bool, job->world->n_faces);
  frame->loose = HSR_NEW(arena, uint32_t, frame->screen.n_relevant);
  frame->columns = HSR_NEW(arena, int, (size_t)p->most_vertices + 4);
  frame->outline =
      hsr_arena_array(arena, p->most_corners, sizeof *frame->outline);
  frame->cut = HSR_NEW(arena, struct hsr_cut, p->most_cuts);
  if (!frame->waiting || !frame->placed || !frame->loose || !frame->columns ||
      !frame->outline || !frame->cut)
    return HSR_E_NOMEM;
  find_loose(frame);
  hsr_job_clear(job);
  return HSR_OK;
}

void hsr_bsp_frame_walk(const struct hsr_bsp_frame *frame, bool backwards,
                        void *context,
                        void (*piece)(void *context,
                                      const struct hsr_bsp_piece *piece,
                                      int facing)) {
  static const double still[3] = {0, 0, 0};
  struct hsr_bsp_walk walk = {.bsp = frame->bsp,
                              .view = frame->job->view,
                              .shift = still,
                              .backwards = backwards,
                              .tally = frame->job->tally,
                              .waiting = frame->waiting,
                              .context = context,
                              .enter_node = frame->enter_node,
                              .piece = piece};
  hsr_bsp_walk_tree(&walk);
}

/* --- Pieces --------------------------------------------------------------- */

/* The cuts among n sides. All are by planes of faces. */
static uint32_t take_cuts(struct hsr_bsp_frame *frame,
                          const struct hsr_bsp_corner *side, uint32_t n,
                          uint32_t n_taken) {
  for (uint32_t k = 0; k < n; k++)
    if (side[k].b == HSR_BSP_FRONT || side[k].b == HSR_BSP_BEHIND) {
      uint32_t g = frame->bsp->face_of[side[k].a];
      frame->cut[n_taken++] =
          (struct hsr_cut){g, side[k].b == HSR_BSP_FRONT ? 1 : -1};
    }
  return n_taken;
}

/* The face's bounds. They are narrowed by the piece's corners if those are
 * about as exact as the outlines of common/exact/order.c. */
static struct hsr_bounds bounds_of(struct hsr_bsp_frame *frame,
                                   const struct hsr_bsp_piece *piece) {
  const struct hsr_bsp *bsp = frame->bsp;
  const struct hsr_bsp_corner *corner = bsp->corner + piece->first_corner;
  bool exact = true;
  double off = 0;
  for (uint32_t k = 0; k < piece->n_corners; k++) {
    uint32_t p = corner[k].point;
    double *at = frame->outline[k];
    at[0] = bsp->x[p];
    at[1] = bsp->y[p];
    at[2] = bsp->z[p];
    double size = 0x1p-44 * (fabs(at[0]) + fabs(at[1]) + fabs(at[2]));
    exact &= bsp->error[p] <= size;
    off = fmax(off, size);
  }
  return exact ? hsr_outline_bounds(
                     &frame->screen,
                     (struct hsr_polygon){piece->face,
                                          (const double(*)[3])frame->outline,
                                          piece->n_corners, off})
               : frame->screen.bounds[piece->face];
}

bool hsr_bsp_frame_piece(struct hsr_bsp_frame *frame,
                         const struct hsr_bsp_piece *piece,
                         struct hsr_piece *out) {
  const struct hsr_bsp *bsp = frame->bsp;
  if (!frame->placed[piece->face])
    return false;
  uint32_t n =
      take_cuts(frame, bsp->corner + piece->first_corner, piece->n_corners, 0);
  n = take_cuts(frame, bsp->cut + piece->first_cut, piece->n_cuts, n);
  *out = (struct hsr_piece){.face = piece->face,
                            .n_cuts = n,
                            .cuts = frame->cut,
                            .bounds = n ? bounds_of(frame, piece)
                                        : frame->screen.bounds[piece->face]};
  const struct hsr_bounds *b = &out->bounds;
  if (b->x0 >= b->x1 || b->y0 >= b->y1)
    return false;
  HSR_STEP(frame->job->tally, HSR_BSP_PIECES,
           HSR_PIECE(piece->face, (uint32_t)(piece - bsp->piece)),
           HSR_THE_WINDOW, hsr_window_make(b->x0, b->y0, b->x1, b->y1), 0);
  return true;
}

/* --- Sides ---------------------------------------------------------------- */

bool hsr_bsp_frame_is_asked(const struct hsr_bsp_frame *frame, uint32_t face) {
  const struct hsr_view *view = frame->job->view;
  bool may_be_near = view->near > 0 || view->parallel;
  return frame->job->world->mesh.deviation[face] > 0 ||
         (may_be_near && !frame->screen.whole[face]);
}

/* On which side of its plane the eye is, turned as the face's loop goes. */
static int side_of_loop(const struct hsr_job *job, uint32_t f, int facing) {
  return job->world->pieces
             ? hsr_exact_eye_side(job->view, hsr_face_loop(job->world, f),
                                  &job->tally->out_of_memory)
             : facing;
}

uint32_t hsr_bsp_frame_sides(const struct hsr_bsp_frame *frame,
                             const struct hsr_bsp_piece *piece,
                             const struct hsr_piece *out, int facing,
                             struct hsr_bsp_side *side) {
  const struct hsr_bsp_corner *corner =
      frame->bsp->corner + piece->first_corner;
  int around = side_of_loop(frame->job, piece->face, facing);
  uint32_t n_cuts = 0;
  for (uint32_t k = 0; k < piece->n_corners; k++) {
    if (corner[k].b == HSR_BSP_FRONT || corner[k].b == HSR_BSP_BEHIND) {
      const struct hsr_cut *cut = &out->cuts[n_cuts++];
      side[k] = (struct hsr_bsp_side){cut->face, HSR_NO_ID, cut->side};
    } else {
      side[k] = (struct hsr_bsp_side){corner[k].a, corner[k].b, -around};
    }
  }
  return piece->n_corners;
}

/* --- Loose faces ---------------------------------------------------------- */

/* Writes a sample that a loose face covers, if it is nearer there. */
static void write_loose(struct hsr_bsp_frame *frame, uint32_t f, uint32_t *id,
                        int i, int j) {
  struct hsr_tally *tally = frame->job->tally;
  HSR_TOUCH(tally, i, j);
  if (*id != HSR_BACKGROUND) {
    bool nearer = hsr_nearer(&frame->screen, f, *id, i, j, tally);
    HSR_STEP(tally, HSR_BSP_THICKNESS, HSR_FACE(f), HSR_FACE(*id), HSR_AT(i, j),
             nearer);
    if (!nearer)
      return;
  }
  HSR_STEP(tally, HSR_BSP_SAMPLES, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j),
           0);
  *id = f;
}

static void write_loose_span(struct hsr_bsp_frame *frame, uint32_t f, int x0,
                             int x1, int j) {
  if (frame->glass)
    hsr_glass_dispute(frame->glass, x0, x1, j);
  else
    for (int i = x0; i < x1; i++)
      write_loose(frame, f, &hsr_bsp_frame_row(frame, j)[i], i, j);
}

void hsr_bsp_frame_finish(struct hsr_bsp_frame *frame) {
  for (uint32_t k = 0; k < frame->n_loose; k++) {
    uint32_t f = frame->loose[k];
    const struct hsr_bounds *b = &frame->screen.bounds[f];
    for (int j = b->y0; j < b->y1; j++) {
      int n = hsr_face_spans(&frame->screen, f, j, frame->columns,
                             frame->job->tally);
      for (int c = 0; c < n; c += 2) {
        int x0 = frame->columns[c] > b->x0 ? frame->columns[c] : b->x0;
        int x1 = frame->columns[c + 1] < b->x1 ? frame->columns[c + 1] : b->x1;
        write_loose_span(frame, f, x0, x1, j);
      }
    }
  }
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"pieces",
     "pieces of faces in the order of the tree, with a "
     "sample in their box",
     HSR_ACTIVATE, HSR_OF_PIECE, HSR_OF_WINDOW, .key = "piece"},
    {"samples", "samples written", HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {"thickness checks",
     "comparisons in depth with faces that are not flat and have no place "
     "in the tree",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {NULL}};

const struct hsr_part hsr_bsp_part = {
    HSR_PART_BSP, counters, NULL, NULL, {NULL}};
