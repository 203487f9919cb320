/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weighted sums of 8 x 8, 4 x 8, 4 x 4 or 64 x 64 samples a pixel:
 * docs/filtered-picture.md.
 * Two answers are equal if their sums are, to the last bit.
 *
 * The kind is folded from ids: without jitter, from one picture of 8 m x 8 n
 * samples, or 4 m x 8 n, 4 m x 4 n or 64 m x 64 n; with jitter, from a picture
 * of m x n samples, or 8 m x 8 n, for each sub-sample and each pattern
 * (Haeberli and Akeley 1990). */
#include "common/answers/kinds/filtered.h"
#include "common/answers/coded.h"
#include "common/files/image.h"
#include "common/files/srgb.h"
#include "common/files/suffix.h"

#include <stdlib.h>
#include <string.h>

/* The options of a form. */
enum { FILTER, JITTER };

static const struct hsr_word filters[] = {
    {"box", "all of the pixel, with one weight", 0},
    {"cosine", "a hump of one pixel's radius", 0},
    {"box4x8", "the box, with 4 x 8 samples a pixel", 0},
    {"box4x4", "the box, with 4 x 4 samples a pixel", 0},
    {"field",
     "one field of a frame of twice as many lines, of which five have the "
     "weights 1, 4, 6, 4, 1",
     0},
    {"box64x64",
     "the box, with 64 x 64 samples a pixel, at most 256 x 256 pixels", 0},
    {NULL}};

static const struct hsr_option options[] = {
    [FILTER] = {"filter",
                "the filtered picture of 8 x 8, 4 x 8, 4 x 4 or 64 x 64 "
                "samples a pixel",
                .words = filters},
    [JITTER] = {"jitter", "with filter: the samples jittered in N patterns",
                .least = 0, .most = HSR_MOST_PATTERNS, .standard = 0},
    {NULL}};

struct hsr_filtering hsr_form_filtering(const struct hsr_form *form) {
  if (form->type != &hsr_answer_filtered)
    return (struct hsr_filtering){HSR_FILTER_NONE, 0};
  return (struct hsr_filtering){
      (enum hsr_filter)(form->values.option[FILTER] + 1),
      (int)form->values.option[JITTER]};
}

/* How many columns, or rows, of sub-samples a pixel has, of those a cell has. */
static int of_pixel(enum hsr_filter filter, int of_cell) {
  return hsr_filter_cells(filter) * of_cell;
}

struct body {
  struct hsr_kernel kernel;
  uint32_t sums[]; /* 3 m n */
};

static size_t size_of_sums(const struct hsr_answer *answer) {
  return 3 * (size_t)answer->m * (size_t)answer->n * sizeof(uint32_t);
}

uint32_t *hsr_answer_sums_of(const struct hsr_answer *answer) {
  struct body *body = answer->body;
  return body && answer->form.type == &hsr_answer_filtered ? body->sums : NULL;
}

static enum hsr_status too_many(int m, int n, int columns, int rows,
                                const char *how, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_REFUSED,
                  "%d x %d pixels of %d x %d samples%s: at most %d x %d", m, n,
                  columns, rows, how, HSR_MAX_SIZE / columns,
                  HSR_MAX_SIZE / rows);
}

/* Where a pixel is many cells, nobody draws more than HSR_MAX_SIZE samples a
 * side. */
static enum hsr_status check_size(const struct hsr_answer *answer,
                                  struct hsr_error *err) {
  enum hsr_filter filter = hsr_form_filtering(&answer->form).filter;
  int side = of_pixel(filter, HSR_SUB), most = HSR_MAX_SIZE / side;
  return hsr_filter_cells(filter) == 1 ||
                 (answer->m <= most && answer->n <= most)
             ? HSR_OK
             : too_many(answer->m, answer->n, side, side, "", err);
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  enum hsr_status status = check_size(answer, err);
  if (status)
    return status;
  struct body *body = calloc(1, sizeof *body + size_of_sums(answer));
  answer->body = body;
  if (!body)
    return hsr_fail_nomem(err);
  hsr_kernel_init(&body->kernel, hsr_form_filtering(&answer->form).filter);
  return HSR_OK;
}

static void clear(struct hsr_answer *answer) {
  memset(hsr_answer_sums_of(answer), 0, size_of_sums(answer));
}

static void free_body(struct hsr_answer *answer) {
  free(answer->body);
}

/* --- Folding -------------------------------------------------------------- */

/* How many sub-samples a cell has, and the bit of the k-th. */
static long count_bits(const struct hsr_form *form) {
  enum hsr_filter filter = hsr_form_filtering(form).filter;
  return (long)hsr_filter_rows(filter) * hsr_filter_columns(filter);
}

static int bit_of(const struct hsr_form *form, long k) {
  int columns = hsr_filter_columns(hsr_form_filtering(form).filter);
  int bit = (int)(k % count_bits(form));
  return HSR_SUB * (bit / columns) + bit % columns;
}

static long count_pictures(const struct hsr_form *form) {
  int patterns = hsr_form_filtering(form).patterns;
  return patterns ? patterns * count_bits(form) : 1;
}

static enum hsr_status picture_view(const struct hsr_form *form,
                                    const struct hsr_view *view, long k,
                                    struct hsr_view *picture,
                                    struct hsr_error *err) {
  struct hsr_filtering filtering = hsr_form_filtering(form);
  enum hsr_filter filter = filtering.filter;
  int columns = of_pixel(filter, hsr_filter_columns(filter));
  int rows = of_pixel(filter, hsr_filter_rows(filter));
  if (filtering.patterns) {
    *picture = hsr_subsample_view(view, filter, (int)(k / count_bits(form)),
                                  bit_of(form, k));
    return HSR_OK;
  }
  if (view->m > HSR_MAX_SIZE / columns || view->n > HSR_MAX_SIZE / rows)
    return too_many(view->m, view->n, columns, rows, ", without jitter", err);
  *picture = hsr_view_finer(view, columns, rows);
  return HSR_OK;
}

static void add(struct hsr_answer *answer, const struct hsr_world *world,
                const struct hsr_view *view, long k) {
  const struct hsr_form *form = &answer->form;
  struct hsr_filtering filtering = hsr_form_filtering(form);
  struct body *body = answer->body;
  const uint32_t *ids = answer->picture->body;
  if (filtering.patterns)
    hsr_filter_add_subsample(&body->kernel, &filtering, world, view,
                             (int)(k / count_bits(form)), bit_of(form, k), ids,
                             body->sums);
  else
    hsr_filter_add_picture(&body->kernel, world, view, ids, body->sums);
}

static const struct hsr_fold fold = {.of = &hsr_answer_ids,
                                     .n = count_pictures,
                                     .view = picture_view,
                                     .add = add};

/* --- Comparing ------------------------------------------------------------ */

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const uint32_t *got = hsr_answer_sums_of(c->got);
  const uint32_t *wanted = hsr_answer_sums_of(c->wanted);
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m;
    const uint32_t *g = got + 3 * s, *w = wanted + 3 * s;
    if (memcmp(g, w, 3 * sizeof *g) && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu): sums %u %u %u, not %u %u %u", s % m, s / m, g[0],
               g[1], g[2], w[0], w[1], w[2]);
  }
}

/* --- Showing -------------------------------------------------------------- */

static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  struct hsr_filtering filtering = hsr_form_filtering(&answer->form);
  (void)showing;
  shaded->rgb =
      malloc(3 * (size_t)answer->m * (size_t)answer->n * sizeof *shaded->rgb);
  if (!shaded->rgb)
    return hsr_fail_nomem(err);
  hsr_filter_finish(&filtering, answer->m, answer->n,
                    hsr_answer_sums_of(answer), shaded->rgb);
  return HSR_OK;
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  struct hsr_picture picture = {
      .m = answer->m, .n = answer->n, .rgb = shaded->rgb};
  return hsr_image_write(path, &picture, showing->text, err);
}

static bool fits(const char *path) {
  return hsr_is_colour_file(path);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  struct hsr_filtering filtering = hsr_form_filtering(&answer->form);
  (void)showing;
  fprintf(out, "%d x %d samples a pixel, %s",
          of_pixel(filtering.filter, hsr_filter_columns(filtering.filter)),
          of_pixel(filtering.filter, hsr_filter_rows(filtering.filter)),
          filters[answer->form.values.option[FILTER]].name);
  if (filtering.patterns)
    fprintf(out, ", jittered in %d patterns", filtering.patterns);
  putc('\n', out);
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an event is what it adds to the sums of its pixel: 3 numbers. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  const struct hsr_window *w = &event->window;
  const uint32_t *part = event->part;
  uint32_t *sums = hsr_answer_sums_of(answer) +
                   3 * ((size_t)w->y0 * (size_t)answer->m + (size_t)w->x0);
  for (int c = 0; c < 3; c++)
    sums[c] += part[c];
  return HSR_OK;
}

static json_t *part_json(const void *part, const struct hsr_view *view) {
  const uint32_t *sums = part;
  (void)view;
  return json_pack("[III]", (json_int_t)sums[0], (json_int_t)sums[1],
                   (json_int_t)sums[2]);
}

static json_t *sums_json(const struct hsr_answer *answer,
                         const struct hsr_view *view) {
  const uint32_t *sums = hsr_answer_sums_of(answer);
  size_t n = 3 * (size_t)answer->m * (size_t)answer->n;
  json_t *all = json_array();
  (void)view;
  for (size_t k = 0; k < n; k++)
    hsr_json_append(&all, json_integer(sums[k]));
  return all;
}

/* A pixel's sums so far. */
static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  const struct hsr_window *w = &event->window;
  const uint32_t *sums =
      hsr_answer_sums_of(painted) +
      3 * ((size_t)w->y0 * (size_t)painted->m + (size_t)w->x0);
  uint16_t channel[3];
  (void)view;
  if (step != HSR_ACCEPT)
    return;
  for (int c = 0; event->part && c < 3; c++)
    channel[c] = (uint16_t)(sums[c] / HSR_WHOLE_WEIGHT);
  slide->fill(slide->on, w, event->part ? hsr_srgb_of(channel) : face);
}

/* Tiles know nothing of one another. */
static const char *not_by_tiles(const struct hsr_form *form) {
  struct hsr_filtering filtering = hsr_form_filtering(form);
  bool narrow = filtering.filter == HSR_FILTER_BOX ||
                filtering.filter == HSR_FILTER_BOX_4X8;
  return narrow && !filtering.patterns
             ? NULL
             : "is for the filters box and box4x8, which do not reach into the "
               "next tile, and without jitter, whose patterns begin at the "
               "corner of the picture";
}

const struct hsr_answer_type hsr_answer_filtered = {
    .name = "filtered",
    .meaning =
        "weighted integer sums of 8 x 8, 4 x 8, 4 x 4 or 64 x 64 samples "
        "a pixel",
    .draws = "filtered pixels",
    .places = "pixels",
    .grains = "pixels",
    .options = options,
    .fold = &fold,
    .by_places = true,
    .make = make,
    .clear = clear,
    .free = free_body,
    .compare = compare,
    .shade = shade,
    .fits = fits,
    .write = write,
    .not_by_tiles = not_by_tiles,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .json = sums_json,
    .part_json = part_json};
