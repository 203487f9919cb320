/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The visible polygons: docs/visible-polygons.md. Two answers are equal if they
 * agree on every face: their boundaries are the same sums of sides, exactly. */
#include "common/answers/kinds/polygons.h"
#include "common/answers/coded.h"
#include "common/answers/on_paper.h"
#include "common/files/image.h"
#include "common/files/mesh/exchange.h"
#include "common/files/suffix.h"

#include <stdlib.h>
#include <string.h>

struct hsr_polygons *hsr_answer_polygons_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_polygons ? answer->body : NULL;
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  answer->body = calloc(1, sizeof(struct hsr_polygons));
  return answer->body ? HSR_OK : hsr_fail_nomem(err);
}

static void clear(struct hsr_answer *answer) {
  hsr_polygons_clear(answer->body);
}

static void free_body(struct hsr_answer *answer) {
  hsr_polygons_free(answer->body);
  free(answer->body);
}

/* --- Comparing ------------------------------------------------------------ */

/* An answer that cannot be compared is wrong, too. */
static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  struct hsr_polygons_difference found;
  struct hsr_error err = {.text = ""};
  if (hsr_polygons_compare(c->got->body, c->wanted->body, c->view, &found,
                           &err)) {
    difference->compared = difference->differing = 1;
    snprintf(difference->first, sizeof difference->first, "%.199s", err.text);
    return;
  }
  difference->compared = found.faces;
  difference->differing = found.differing;
  if (found.differing)
    snprintf(difference->first, sizeof difference->first,
             "face %u is seen in another part of the picture", found.first);
}

/* --- Showing -------------------------------------------------------------- */

static size_t count_samples(const struct hsr_answer *answer) {
  return (size_t)answer->m * (size_t)answer->n;
}

/* The ids of all samples, and what an ids picture shows of them. */
static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  size_t n = count_samples(answer);
  uint32_t *ids = malloc(n * sizeof *ids);
  if (showing->depth)
    shaded->depth = malloc(n * sizeof *shaded->depth);
  shaded->rgb = malloc(3 * n * sizeof *shaded->rgb);
  enum hsr_status status =
      ids && shaded->rgb && (!showing->depth || shaded->depth)
          ? hsr_polygons_ids(answer->body, showing->view, ids, err)
          : hsr_fail_nomem(err);
  if (!status)
    status =
        hsr_picture_finish(showing->world, showing->view, ids, showing->shading,
                           shaded->depth, shaded->rgb, err);
  if (!status)
    hsr_show_background(showing, ids, n, shaded->rgb);
  free(ids);
  return status;
}

static bool fits(const char *path) {
  return !hsr_is_array_file(path) && !hsr_is_depth_file(path) &&
         !hsr_ends_in(path, ".json");
}

/* On paper. */
static enum hsr_status write_paper(const struct hsr_answer *answer,
                                   const struct hsr_showing *showing,
                                   const char *path, struct hsr_error *err) {
  if (hsr_ends_in(path, ".dxf") && !showing->hatch)
    return hsr_fail(
        err, HSR_E_USAGE,
        "%.200s: holds no filled faces; --hatch draws their hatches", path);
  return hsr_show_on_paper(showing, NULL, answer->body, path, err);
}

/* A .vtp file holds the regions in world space; pictures hold their samples. */
static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  if (hsr_ends_in(path, ".vtp"))
    return hsr_polygons_write_vtp(answer->body, showing->view, path, err);
  if (hsr_is_line_file(path))
    return write_paper(answer, showing, path, err);
  struct hsr_picture picture = {.m = answer->m,
                                .n = answer->n,
                                .depth = shaded->depth,
                                .rgb = shaded->rgb};
  return hsr_image_write(path, &picture, showing->text, err);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const struct hsr_polygons *p = answer->body;
  size_t faces = 0;
  double area = 0;
  (void)showing;
  for (size_t r = 0; r < p->n_regions; r++) {
    faces += !r || p->region[r].face != p->region[r - 1].face;
    area += hsr_polygon_area(p, &p->region[r]);
  }
  fprintf(out, "%zu faces in %zu regions of %zu sides, %.1f %% covered\n",
          faces, p->n_regions, p->n_sides,
          100 * area / (double)count_samples(answer));
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an accepted event is a struct hsr_polygons of one region. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  return event->part ? hsr_polygons_append(answer->body, event->part) : HSR_OK;
}

/* The sides of what is displayed. */
static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  const struct hsr_polygons *p = event->part;
  (void)painted, (void)view, (void)face;
  for (size_t c = 0; step == HSR_ACCEPT && p && c < p->n_cycles; c++) {
    const struct hsr_polygon_side *side = p->side + p->cycle[c].first;
    for (size_t k = 0, n = p->cycle[c].n; k < n; k++)
      slide->line(slide->on, side[k].at, side[(k + 1) % n].at);
  }
}

static enum hsr_status settle(struct hsr_answer *answer) {
  hsr_polygons_sort(answer->body);
  return HSR_OK;
}

/* [kind, a, b, sx, sy] */
static json_t *side_json(const struct hsr_polygon_side *side) {
  return json_pack("[iIIff]", (int)side->line.kind, (json_int_t)side->line.a,
                   (json_int_t)side->line.b, side->at[0], side->at[1]);
}

static json_t *region_json(const struct hsr_polygons *p,
                           const struct hsr_polygon_region *region) {
  json_t *cycles = json_array();
  for (size_t c = region->first; c < region->first + region->n; c++) {
    json_t *sides = json_array();
    for (size_t k = 0; k < p->cycle[c].n; k++)
      hsr_json_append(&sides, side_json(&p->side[p->cycle[c].first + k]));
    hsr_json_append(&cycles, sides);
  }
  return json_pack("[I o]", (json_int_t)region->face, cycles);
}

static json_t *part_json(const void *part, const struct hsr_view *view) {
  const struct hsr_polygons *p = part;
  (void)view;
  return region_json(p, &p->region[0]);
}

static json_t *polygons_json(const struct hsr_answer *answer,
                             const struct hsr_view *view) {
  const struct hsr_polygons *p = answer->body;
  json_t *regions = json_array();
  (void)view;
  for (size_t r = 0; r < p->n_regions; r++)
    hsr_json_append(&regions, region_json(p, &p->region[r]));
  return regions;
}

const struct hsr_answer_type hsr_answer_polygons = {
    .name = "polygons",
    .meaning = "the regions of the picture in which every face is seen",
    .draws = "polygons",
    .places = "faces",
    .grains = "pixels",
    .takes = 1 << HSR_HATCH | 1 << HSR_SHADING | 1 << HSR_BACKDROP,
    .make = make,
    .clear = clear,
    .free = free_body,
    .compare = compare,
    .shade = shade,
    .fits = fits,
    .write = write,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .settle = settle,
    .json = polygons_json,
    .part_json = part_json};
