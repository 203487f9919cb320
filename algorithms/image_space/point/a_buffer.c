/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The A-buffer: the fragments of faces in a pixel, with masks of 4 x 8 bits.
 *
 * Source      L. Carpenter, "The A-buffer, an antialiased hidden surface
 *             method", SIGGRAPH 1984, 103-108, as described by Greene 1995,
 *             pp. 20-21, 45 and 49.
 * Notation    fragment -> struct fragment, what a face covers of a pixel; mask
 *             -> bit 8 b + a for the sub-sample in column a and row b, as in
 *             common/answers/filter.h; object tag -> the instance of a face
 * Invariants  a pixel holds one fragment at most that covers all of it. It has
 *             no mask, and is the nearest of those that came. The other
 *             fragments of the pixel are not behind it.
 * Masks       are exact: their bits are the samples that the face covers.
 * Ties        by hsr_nearer at one sample
 * Departures  Fragments are found by the rows of sub-samples that a face
 *             covers, not by clipping it to the pixel and combining masks of
 *             edges. Which of two fragments is nearer is asked at the first
 *             sample that both cover, not told by ranges of Z. Where the two
 *             penetrate in the pixel, the nearer one there is taken for nearer
 *             all over the pixel: the picture is known to be wrong, as
 *             Carpenter's is, who estimates what is seen of either from the
 *             ranges. Fragments of one object are merged when they are packed,
 *             and only if they have one colour, so that nothing is lost. All is
 *             opaque.
 * Cost        a span for each row of sub-samples of a face, a fragment for each
 *             pixel that it touches; to pack a pixel of k fragments, at most
 *             k (k - 1) / 2 comparisons */
#include "algorithms/algorithm.h"
#include "common/answers/kinds/filtered.h"
#include "common/exact/screen.h"

#include <string.h>

enum {
  FRAGMENTS,
  MASKS,
  COVERED,
  HIDDEN,
  SIMPLE,
  COMPLEX,
  COMPARED,
  MERGES,
  PACKED
};

/* A fragment with a mask. */
struct fragment {
  uint32_t face;
  uint32_t next; /* in its pixel: 1 and an index; 0: none */
  uint64_t mask;
};

/* A fragment that is being packed. */
struct packed {
  uint32_t face;
  uint64_t mask, seen; /* seen: what is left of the mask */
};

/* A pixel of the row. */
struct pixel {
  uint32_t whole; /* the face that covers it, or HSR_BACKGROUND */
  uint32_t first; /* fragment: 1 and an index; 0: none */
  uint64_t mask;  /* of the face that is being added */
};

struct colour {
  bool known;
  uint16_t rgb[3];
};

struct state {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_view finer;
  struct hsr_screen screen;
  struct hsr_kernel kernel;
  uint32_t *sums;               /* of the answer */
  struct pixel *pixel;          /* m */
  struct hsr_growing fragments; /* struct fragment; of the row */
  struct hsr_growing packing;   /* struct packed; of a pixel */
  uint32_t *first, *next; /* faces by the first row of pixels they touch, 1
                                  and a number; 0: none */
  int *columns;
  struct colour *colour; /* a face; the last one is that of the background */
};

enum { ROWS = HSR_SUB, COLUMNS = HSR_SUB_ABUFFER };

/* --- Fragments ------------------------------------------------------------ */

/* Sets the bits of columns [x0, x1) of sub-samples in row b of their pixels. */
static void set_bits(struct state *s, int x0, int x1, int b, int *i0, int *i1) {
  for (int i = x0 / COLUMNS; i * COLUMNS < x1; i++) {
    int from = x0 > i * COLUMNS ? x0 - i * COLUMNS : 0;
    int to = x1 < (i + 1) * COLUMNS ? x1 - i * COLUMNS : COLUMNS;
    uint64_t bits = (UINT64_C(1) << to) - (UINT64_C(1) << from);
    s->pixel[i].mask |= bits << (ROWS * b);
    *i0 = i < *i0 ? i : *i0;
    *i1 = i >= *i1 ? i + 1 : *i1;
  }
}

/* Whether f is nearer than g in pixel (i, j), at the first sample of a mask. */
static bool is_nearer(struct state *s, uint32_t f, uint32_t g, uint64_t mask,
                      int i, int j) {
  int bit = __builtin_ctzll(mask);
  return hsr_nearer(&s->screen, f, g, COLUMNS * i + bit % ROWS,
                    ROWS * j + bit / ROWS, s->tally);
}

/* The face covers all of a pixel: the nearest of such faces is kept. */
static void cover(struct state *s, uint32_t f, int i, int j) {
  struct pixel *p = &s->pixel[i];
  bool nearer = p->whole == HSR_BACKGROUND ||
                is_nearer(s, f, p->whole, s->kernel.all, i, j);
  HSR_STEP(s->tally, COVERED, HSR_FACE(f), HSR_FACE(p->whole), HSR_AT(i, j),
           nearer);
  if (nearer)
    p->whole = f;
}

static bool add_fragment(struct state *s, uint32_t f, int i, int j) {
  struct pixel *p = &s->pixel[i];
  uint64_t mask = p->mask;
  p->mask = 0;
  if (!mask)
    return true;
  HSR_STEP(s->tally, FRAGMENTS, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j), 0);
  if (mask == s->kernel.all) {
    cover(s, f, i, j);
    return true;
  }
  HSR_STEP(s->tally, MASKS, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j), 0);
  if (!hsr_arena_grow(s->job->scratch, &s->fragments, sizeof(struct fragment)))
    return false;
  struct fragment *all = s->fragments.items;
  all[s->fragments.n - 1] = (struct fragment){f, p->first, mask};
  p->first = (uint32_t)s->fragments.n;
  return true;
}

/* The fragments of a face in row j of pixels. */
static bool add_face(struct state *s, uint32_t f, int j) {
  int i0 = s->job->view->m, i1 = 0;
  for (int b = 0; b < ROWS; b++) {
    int n = hsr_face_spans(&s->screen, f, ROWS * j + b, s->columns, s->tally);
    for (int k = 0; k < n; k += 2)
      if (s->columns[k] < s->columns[k + 1])
        set_bits(s, s->columns[k], s->columns[k + 1], b, &i0, &i1);
  }
  for (int i = i0; i < i1; i++)
    if (!add_fragment(s, f, i, j))
      return false;
  return true;
}

/* --- Packing -------------------------------------------------------------- */

static const uint16_t *colour_of(struct state *s, uint32_t face) {
  uint32_t n = s->job->world->n_faces;
  struct colour *colour = &s->colour[face == HSR_BACKGROUND ? n : face];
  if (!colour->known) {
    hsr_filter_colour(s->job->world, s->job->view, face, colour->rgb);
    colour->known = true;
  }
  return colour->rgb;
}

static void add_colour(struct state *s, uint32_t face, uint64_t mask, int i,
                       int j) {
  if (!mask)
    return;
  uint32_t part[3] = {0, 0, 0};
  uint32_t *sums =
      s->sums + 3 * ((size_t)j * (size_t)s->job->view->m + (size_t)i);
  hsr_filter_add(&s->kernel, 1, 1, 0, 0, mask, colour_of(s, face), part);
  for (int c = 0; c < 3; c++)
    sums[c] += part[c];
  HSR_ACCEPTED(s->tally, PACKED, HSR_FACE(face), HSR_NOTHING, HSR_AT(i, j),
               part);
}

/* Lists the fragments of a pixel that are not behind what covers it. */
static bool list_fragments(struct state *s, const struct pixel *p, int i,
                           int j) {
  struct fragment *all = s->fragments.items;
  s->packing.n = 0;
  for (uint32_t k = p->first; k; k = all[k - 1].next) {
    struct fragment *f = &all[k - 1];
    if (p->whole != HSR_BACKGROUND &&
        !is_nearer(s, f->face, p->whole, f->mask, i, j)) {
      HSR_STEP(s->tally, HIDDEN, HSR_FACE(f->face), HSR_FACE(p->whole),
               HSR_AT(i, j), 0);
      continue;
    }
    if (!hsr_arena_grow(s->job->scratch, &s->packing, sizeof(struct packed)))
      return false;
    struct packed *list = s->packing.items;
    list[s->packing.n - 1] = (struct packed){f->face, f->mask, f->mask};
  }
  return true;
}

/* Takes from two fragments what one hides of the other. */
static void overlap(struct state *s, struct packed *f, struct packed *g, int i,
                    int j) {
  uint64_t both = f->mask & g->mask;
  if (!both)
    return;
  bool nearer = is_nearer(s, f->face, g->face, both, i, j);
  HSR_STEP(s->tally, COMPARED, HSR_FACE(f->face), HSR_FACE(g->face),
           HSR_AT(i, j), nearer);
  struct packed *hidden = nearer ? g : f;
  hidden->seen &= ~both;
}

/* Whether what is seen of two faces can be added at once. */
static bool are_one(struct state *s, uint32_t f, uint32_t g) {
  const struct hsr_mesh *mesh = &s->job->world->mesh;
  return mesh->instance[f] == mesh->instance[g] &&
         !memcmp(colour_of(s, f), colour_of(s, g), 3 * sizeof(uint16_t));
}

/* Adds fragment f, and the later ones that are one with it. */
static void add_merged(struct state *s, struct packed *f,
                       const struct packed *end, int i, int j) {
  for (struct packed *g = f + 1; g < end && f->seen; g++)
    if (g->seen && are_one(s, f->face, g->face)) {
      HSR_STEP(s->tally, MERGES, HSR_FACE(g->face), HSR_FACE(f->face),
               HSR_AT(i, j), 0);
      f->seen |= g->seen;
      g->seen = 0;
    }
  add_colour(s, f->face, f->seen, i, j);
}

static bool pack(struct state *s, const struct pixel *p, int i, int j) {
  if (!list_fragments(s, p, i, j))
    return false;
  struct packed *list = s->packing.items;
  struct packed *end = list ? list + s->packing.n : list; /* NULL: none yet */
  uint64_t rest = s->kernel.all;
  for (struct packed *f = list; f < end; f++) {
    rest &= ~f->mask;
    for (struct packed *g = f + 1; g < end; g++)
      overlap(s, f, g, i, j);
  }
  for (struct packed *f = list; f < end; f++)
    add_merged(s, f, end, i, j);
  add_colour(s, p->whole, rest, i, j);
  return true;
}

static bool finish_pixel(struct state *s, int i, int j) {
  const struct pixel *p = &s->pixel[i];
  if (p->first) {
    HSR_STEP(s->tally, COMPLEX, HSR_THE_WINDOW, HSR_NOTHING, HSR_AT(i, j), 0);
    return pack(s, p, i, j);
  }
  HSR_STEP(s->tally, SIMPLE, HSR_THE_WINDOW, HSR_NOTHING, HSR_AT(i, j), 0);
  add_colour(s, p->whole, s->kernel.all, i, j);
  return true;
}

/* --- A picture ------------------------------------------------------------ */

static enum hsr_status allocate(struct state *s) {
  const struct hsr_job *job = s->job;
  uint32_t largest = 0, n_faces = job->world->n_faces;
  for (uint32_t r = 0; r < s->screen.n_relevant; r++) {
    uint32_t size = hsr_face_size(job->world, s->screen.relevant[r]);
    largest = size > largest ? size : largest;
  }
  s->pixel = HSR_NEW(job->scratch, struct pixel, (size_t)job->view->m);
  s->first = HSR_NEW_ZEROED(job->scratch, uint32_t, (size_t)job->view->n + 1);
  s->next = HSR_NEW(job->scratch, uint32_t, s->screen.n_relevant);
  s->columns = HSR_NEW(job->scratch, int, largest + 4);
  s->colour = HSR_NEW_ZEROED(job->scratch, struct colour, (size_t)n_faces + 1);
  return s->pixel && s->first && s->next && s->columns && s->colour
             ? HSR_OK
             : HSR_E_NOMEM;
}

/* Puts the relevant faces into buckets, by the first row of pixels. */
static void fill_buckets(struct state *s) {
  for (uint32_t r = s->screen.n_relevant; r--;) {
    uint32_t j = (uint32_t)(s->screen.bounds[s->screen.relevant[r]].y0 / ROWS);
    s->next[r] = s->first[j];
    s->first[j] = r + 1;
  }
}

/* Draws row j of pixels, and moves the faces that reach the next row there. */
static bool draw_row(struct state *s, int j) {
  int m = s->job->view->m;
  s->fragments.n = 0;
  for (int i = 0; i < m; i++)
    s->pixel[i] = (struct pixel){.whole = HSR_BACKGROUND};
  for (uint32_t k = s->first[j], after; k; k = after) {
    uint32_t f = s->screen.relevant[k - 1];
    after = s->next[k - 1];
    if (!add_face(s, f, j))
      return false;
    if (s->screen.bounds[f].y1 > ROWS * (j + 1)) {
      s->next[k - 1] = s->first[j + 1];
      s->first[j + 1] = k;
    }
  }
  for (int i = 0; i < m; i++)
    if (!finish_pixel(s, i, j))
      return false;
  return true;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  const struct hsr_view *view = job->view;
  if (view->m > HSR_MAX_SIZE / COLUMNS || view->n > HSR_MAX_SIZE / ROWS)
    return hsr_fail(err, HSR_E_REFUSED, "a-buffer: more than %d x %d pixels",
                    HSR_MAX_SIZE / COLUMNS, HSR_MAX_SIZE / ROWS);
  if (hsr_form_filtering(&job->answer->form).patterns)
    return hsr_fail(err, HSR_E_REFUSED, "a-buffer: its masks have no jitter");
  struct state s = {.job = job,
                    .tally = job->tally,
                    .sums = hsr_answer_sums_of(job->answer),
                    .finer = hsr_view_finer(view, COLUMNS, ROWS)};
  hsr_kernel_init(&s.kernel, HSR_FILTER_BOX_4X8);
  if (hsr_screen_make(&s.screen, job->world, &s.finer, job->scratch,
                      job->tally) ||
      allocate(&s))
    return hsr_fail_nomem(err);
  fill_buckets(&s);
  for (int j = 0; j < view->n; j++)
    if (!draw_row(&s, j))
      return hsr_fail_nomem(err);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [FRAGMENTS] = {"fragments", "pixels that a face touches", HSR_ACTIVATE,
                   HSR_OF_FACE, HSR_OF_WINDOW},
    [MASKS] = {"masks", "fragments that need a mask", HSR_ACTIVATE, HSR_OF_FACE,
               HSR_OF_WINDOW},
    [COVERED] = {"covering",
                 "fragments that cover a whole pixel, compared "
                 "with the one that is there",
                 HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [HIDDEN] = {"hidden", "fragments behind one that covers the pixel",
                HSR_REJECT, HSR_OF_FACE, HSR_OF_FACE},
    [SIMPLE] = {"simple pixels", "pixels of one face, or none", HSR_SAMPLE,
                HSR_OF_WINDOW, HSR_OF_NOTHING},
    [COMPLEX] = {"complex pixels", "pixels with masks", HSR_SAMPLE,
                 HSR_OF_WINDOW, HSR_OF_NOTHING},
    [COMPARED] = {"fragment comparisons",
                  "pairs of fragments that overlap, put into depth order",
                  HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [MERGES] = {"merges", "fragments of one object and colour, merged",
                HSR_RETIRE, HSR_OF_FACE, HSR_OF_FACE},
    [PACKED] = {"packed", "colours added to pixels", HSR_ACCEPT, HSR_OF_FACE,
                HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each row of pixels"},
    {"  for each face that may touch it"},
    {"    for each pixel that it touches", HSR_RAISES(FRAGMENTS)},
    {"      if it covers the pixel: nearer than what covers it so far?",
     HSR_RAISES(COVERED)},
    {"      else make a mask", HSR_RAISES(MASKS)},
    {"  for each pixel"},
    {"    if it has no masks, one face has all of it", HSR_RAISES(SIMPLE)},
    {"    else pack its fragments, from front to back", HSR_RAISES(COMPLEX)},
    {"      leave out those behind a fragment that covers the pixel",
     HSR_RAISES(HIDDEN)},
    {"      which of two that overlap is nearer?", HSR_RAISES(COMPARED)},
    {"      take from each mask what is before it; merge those of one object",
     HSR_RAISES(MERGES)},
    {"    add colours by the bits that are left", HSR_RAISES(PACKED)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Y", "bucket sort", "once a frame"},
    {"samples", "X", "mask", "once a row of samples of a face"},
    {"fragments", "Z", "comparison", "once a pair that overlaps in a pixel"},
    {NULL}};

static const struct hsr_step steps[] = {
    {"fragments", FRAGMENTS, HSR_KIND_SEGMENT},
    {"compare", COMPARED, HSR_KIND_SAMPLE},
    {"pack", PACKED, HSR_KIND_WRITE},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(a_buffer) = {
    .name = "a-buffer",
    .title = "Carpenter's A-buffer",
    .authors = "L. Carpenter",
    .year = 1984,
    .source = "SIGGRAPH 1984, 103-108; Greene 1995, pp. 20-21",
    .taxonomy = HSR_IMAGE_SPACE_POINT,
    .sort_order = "YXZ",
    .coherence = "object: fragments of one object are merged",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_FILTERED, HSR_WORD_OF(HSR_FILTER_BOX_4X8)}},
    .flags = HSR_KNOWN_WRONG,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
