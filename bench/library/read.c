/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers as arrays. */
#include "bench/library/library.h"
#include "common/answers/kinds/area.h"
#include "common/answers/kinds/composited.h"
#include "common/answers/kinds/filtered.h"
#include "common/answers/kinds/segments.h"
#include "common/answers/kinds/shadowed.h"
#include "common/answers/kinds/transparent.h"
#include "common/answers/kinds/voxels.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum hsr_status hsr_get_answer(const struct lib_answer *answer,
                               struct hsr_answer_info *info,
                               struct hsr_error *err) {
  if (!answer)
    return lib_null("answer", err);
  const struct hsr_answer_type *type = answer->answer.form.type;
  const struct hsr_window *w = &answer->view.window;
  struct hsr_answer_info found = {
      .kind = (size_t)hsr_answer_number(type),
      .kind_name = type->name,
      .algorithm = answer->variant.name,
      .algorithm_number = (size_t)(answer->variant.listed - hsr_algorithms()),
      .m = answer->view.m,
      .n = answer->view.n,
      .window = {w->x0, w->y0, w->x1, w->y1},
      .adapt_seconds = answer->adapt_seconds,
      .prepare_seconds = answer->prepare_seconds,
      .draw_seconds = answer->draw_seconds};
  snprintf(found.adapted, sizeof found.adapted, "%s", answer->adapted);
  return lib_give("info", info, sizeof found, &found, err);
}

/* Checks the arguments that all functions have. */
static enum hsr_status check(const struct lib_answer *answer, const void *to,
                             const char *what, struct hsr_error *err) {
  return answer && to ? HSR_OK : lib_null(answer ? what : "answer", err);
}

/* --- A line about it ------------------------------------------------------ */

/* The line, with its newline; the caller frees it. NULL: memory ran out. */
static char *print_line(const struct lib_answer *answer) {
  char *line = NULL;
  size_t length;
  FILE *stream = open_memstream(&line, &length);
  const struct hsr_showing showing = lib_showing(answer, HSR_COLOUR_LAMBERT);
  if (!stream)
    return NULL;
  answer->answer.form.type->print(&answer->answer, &showing, stream);
  bool good = !ferror(stream);
  if (!fclose(stream) && good)
    return line;
  free(line);
  return NULL;
}

enum hsr_status hsr_get_summary(const struct lib_answer *answer, char *text,
                                size_t size, struct hsr_error *err) {
  enum hsr_status status = check(answer, text, "text", err);
  if (status)
    return status;
  lib_scene_read(answer->scene);
  char *line = print_line(answer);
  lib_scene_leave(answer->scene);
  if (!line)
    return hsr_fail_nomem(err);
  const size_t length = strcspn(line, "\n");
  if (length < size) {
    memcpy(text, line, length);
    text[length] = '\0';
  } else {
    status =
        hsr_fail(err, HSR_E_USAGE, "the line has %zu bytes, not less than %zu",
                 length, size);
  }
  free(line);
  return status;
}

/* --- Arrays of the answer's own ------------------------------------------- */

static enum hsr_status has_not(const struct lib_answer *answer,
                               const char *what, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_USAGE, "an answer of the kind %s has no %s",
                  answer->answer.form.type->name, what);
}

enum hsr_status hsr_get_ids(const struct lib_answer *answer,
                            const uint32_t **ids, struct hsr_error *err) {
  enum hsr_status status = check(answer, ids, "ids", err);
  if (status)
    return status;
  if (!answer->answer.ids)
    return has_not(answer, "ids", err);
  *ids = answer->answer.ids;
  return HSR_OK;
}

enum hsr_status hsr_get_lit(const struct lib_answer *answer,
                            const unsigned char **lit, struct hsr_error *err) {
  enum hsr_status status = check(answer, lit, "lit", err);
  if (status)
    return status;
  const bool *own = hsr_answer_lit_of(&answer->answer);
  if (!own)
    return has_not(answer, "shadows", err);
  *lit = (const unsigned char *)own; /* a bool is a byte, 0 or 1 */
  return HSR_OK;
}

enum hsr_status hsr_get_segments(const struct lib_answer *answer,
                                 const struct lib_segment **segment, size_t *n,
                                 struct hsr_error *err) {
  enum hsr_status status = check(answer, segment, "segment", err);
  if (status || !n)
    return status ? status : lib_null("n", err);
  const struct hsr_drawing *own = hsr_answer_drawing_of(&answer->answer);
  if (!own)
    return has_not(answer, "segments", err);
  *segment = (const struct lib_segment *)own->segment; /* as twins.c checks */
  *n = own->n;
  return HSR_OK;
}

enum hsr_status hsr_get_areas(const struct lib_answer *answer,
                              const double **bounds, struct hsr_error *err) {
  enum hsr_status status = check(answer, bounds, "bounds", err);
  if (status)
    return status;
  const struct hsr_area_bounds *own = hsr_answer_areas_of(&answer->answer);
  if (!own)
    return has_not(answer, "areas", err);
  *bounds = &own->lo;
  return HSR_OK;
}

enum hsr_status hsr_get_sums(const struct lib_answer *answer,
                             const uint32_t **sum, struct hsr_error *err) {
  enum hsr_status status = check(answer, sum, "sum", err);
  if (status)
    return status;
  const uint32_t *own = hsr_answer_sums_of(&answer->answer);
  if (!own)
    return has_not(answer, "sums", err);
  *sum = own;
  return HSR_OK;
}

enum hsr_status hsr_get_rgba(const struct lib_answer *answer,
                             const uint16_t **rgba, int *channels,
                             struct hsr_error *err) {
  enum hsr_status status = check(answer, rgba, "rgba", err);
  if (status || !channels)
    return status ? status : lib_null("channels", err);
  const uint16_t *three = hsr_answer_colours_of(&answer->answer);
  const uint16_t *four = hsr_answer_rgba_of(&answer->answer);
  if (!three && !four)
    return has_not(answer, "channels of 16 bits", err);
  *rgba = three ? three : four;
  *channels = three ? 3 : 4;
  return HSR_OK;
}

enum hsr_status hsr_get_voxels(const struct lib_answer *answer,
                               struct hsr_voxel_array *voxels,
                               struct hsr_error *err) {
  if (!answer)
    return lib_null("answer", err);
  const struct hsr_solid_voxels *own = hsr_answer_voxels_of(&answer->answer);
  if (!own)
    return has_not(answer, "voxels", err);
  struct hsr_voxel_array found = {.side = own->grid.size, .solid = own->solid};
  memcpy(found.lo, own->grid.lo, sizeof found.lo);
  memcpy(found.n, own->grid.n, sizeof found.n);
  return lib_give("voxels", voxels, sizeof found, &found, err);
}

enum hsr_status hsr_get_counts(const struct lib_answer *answer,
                               const uint64_t **count, size_t *n,
                               struct hsr_error *err) {
  enum hsr_status status = check(answer, count, "count", err);
  if (status || !n)
    return status ? status : lib_null("n", err);
  if (!answer->counts)
    return hsr_fail(err, HSR_E_USAGE,
                    "the answer was drawn without request.counts");
  const struct hsr_counter *counters =
      answer->variant.listed->counting->counters;
  *n = 0;
  while (counters && counters[*n].name)
    ++*n;
  *count = answer->tally.count;
  return HSR_OK;
}

enum hsr_status hsr_get_work(const struct lib_answer *answer,
                             const float **work, struct hsr_error *err) {
  enum hsr_status status = check(answer, work, "work", err);
  if (status)
    return status;
  *work = answer->work;
  return answer->work ? HSR_OK
                      : hsr_fail(err, HSR_E_USAGE,
                                 "the answer was drawn without request.work");
}

/* --- Arrays of the caller's ----------------------------------------------- */

/* Makes colours, and depths too if they are wanted. *shaded is to be freed also
 * after a failure. */
static enum hsr_status shade(const struct lib_answer *answer,
                             enum hsr_shading_choice shading, bool depth,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  struct hsr_showing showing = lib_showing(answer, shading);
  showing.depth = depth;
  *shaded = (struct hsr_shaded){.rgb = NULL};
  lib_scene_read(answer->scene);
  enum hsr_status status =
      answer->answer.form.type->shade(&answer->answer, &showing, shaded, err);
  lib_scene_leave(answer->scene);
  return status;
}

/* Checks the length of the caller's array, which has `each` numbers a place. */
static enum hsr_status check_length(const struct lib_answer *answer,
                                    size_t each, size_t n,
                                    struct hsr_error *err) {
  size_t all = each * (size_t)answer->view.m * (size_t)answer->view.n;
  return n == all
             ? HSR_OK
             : hsr_fail(err, HSR_E_USAGE,
                        "the array has %zu numbers; there are %zu", n, all);
}

enum hsr_status hsr_get_depths(const struct lib_answer *answer, float *depth,
                               size_t n, struct hsr_error *err) {
  struct hsr_shaded shaded;
  enum hsr_status status = check(answer, depth, "depth", err);
  if (!status)
    status = check_length(answer, 1, n, err);
  if (status)
    return status;
  if (!answer->answer.form.type->shade)
    return has_not(answer, "depths", err);
  status = shade(answer, HSR_COLOUR_LAMBERT, true, &shaded, err);
  if (!status && !shaded.depth)
    status = has_not(answer, "depths", err);
  if (!status)
    memcpy(depth, shaded.depth, n * sizeof *depth);
  hsr_shaded_free(&shaded);
  return status;
}

enum hsr_status hsr_get_colours(const struct lib_answer *answer,
                                enum hsr_shading_choice shading, float *rgb,
                                size_t n, struct hsr_error *err) {
  struct hsr_shaded shaded;
  enum hsr_status status = check(answer, rgb, "rgb", err);
  if (!status)
    status = check_length(answer, 3, n, err);
  if (status)
    return status;
  if ((int)shading < 0 || (int)shading > HSR_COLOUR_GOURAUD)
    return hsr_fail(err, HSR_E_USAGE, "there is no shading %d", (int)shading);
  if (!answer->answer.form.type->shade)
    return has_not(answer, "colours", err);
  if (shading)
    status = lib_takes(answer, HSR_SHADING, "shading", err);
  if (status)
    return status;
  status = shade(answer, shading, false, &shaded, err);
  if (!status)
    memcpy(rgb, shaded.rgb, n * sizeof *rgb);
  hsr_shaded_free(&shaded);
  return status;
}
