/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solid that each voxel is in: docs/solid-voxels.md. Two answers are equal
 * if they agree in every voxel. They do not depend on the view. */
#include "common/answers/kinds/voxels.h"
#include "common/answers/coded.h"
#include "common/files/mesh/exchange.h"
#include "common/files/suffix.h"

#include <math.h>
#include <stdlib.h>

static const struct hsr_option options[] = {
    {.name = "side",
     .meaning = "voxels along the longest side of the scene's box",
     .least = 1,
     .most = HSR_VOXELS_MOST,
     .standard = 64},
    {.name = NULL}};

struct hsr_solid_voxels *hsr_answer_voxels_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_voxels ? answer->body : NULL;
}

int hsr_form_voxels(const struct hsr_form *form) {
  return (int)form->values.option[0];
}

/* The voxels are opened by the algorithm that finds them: the grid depends on
 * the scene. */
static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  answer->body = calloc(1, sizeof(struct hsr_solid_voxels));
  return answer->body ? HSR_OK : hsr_fail_nomem(err);
}

static void free_body(struct hsr_answer *answer) {
  if (answer->body)
    hsr_solid_voxels_free(answer->body);
  free(answer->body);
}

/* --- Comparing ------------------------------------------------------------ */

/* If the grids differ, all voxels do. */
static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const struct hsr_solid_voxels *got = c->got->body, *wanted = c->wanted->body;
  const struct hsr_voxel_grid *grid = &wanted->grid;
  size_t n = hsr_voxel_count(grid), row = (size_t)grid->n[0];
  difference->compared = n;
  if (!got->solid || !hsr_same_voxel_grid(&got->grid, grid)) {
    difference->differing = n;
    snprintf(difference->first, sizeof difference->first,
             "the grid is of %d x %d x %d, not %d x %d x %d", got->grid.n[0],
             got->grid.n[1], got->grid.n[2], grid->n[0], grid->n[1],
             grid->n[2]);
    return;
  }
  for (size_t k = 0; k < n; k++)
    if (got->solid[k] != wanted->solid[k] && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu, %zu): solid %u, not %u", k % row,
               k / row % (size_t)grid->n[1], k / row / (size_t)grid->n[1],
               got->solid[k], wanted->solid[k]);
}

/* --- Showing -------------------------------------------------------------- */

static bool fits(const char *path) {
  return hsr_ends_in(path, ".vti");
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  (void)showing;
  (void)shaded;
  return hsr_voxels_write_vti(answer->body, path, err);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const struct hsr_solid_voxels *voxels = answer->body;
  const int *n = voxels->grid.n;
  uint64_t set, surface;
  (void)showing;
  hsr_solid_voxels_count(voxels, &set, &surface);
  fprintf(out, "%d x %d x %d voxels, %llu of them in a solid\n", n[0], n[1],
          n[2], (unsigned long long)set);
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an accepted event is a struct hsr_voxel_cubes. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  struct hsr_solid_voxels *voxels = answer->body;
  const struct hsr_voxel_cubes *cubes = event->part;
  if (!voxels->solid && hsr_solid_voxels_open(voxels, cubes->grid))
    return HSR_E_NOMEM;
  hsr_solid_voxels_put(voxels, cubes);
  return HSR_OK;
}

/* A colour of its own for each solid, as on the page: of every hue, with a
 * saturation of .45 and a lightness of .55. */
static uint32_t solid_colour(uint32_t solid) {
  double hue = (double)(solid * 137ULL % 360) / 30, spread = 0.45 * (1 - 0.55);
  uint32_t rgb = 0;
  for (int c = 0; c < 3; c++) {
    double k = fmod((c == 0 ? 0 : c == 1 ? 8 : 4) + hue, 12);
    double x = 0.55 - spread * fmax(-1, fmin(fmin(k - 3, 9 - k), 1));
    rgb = rgb << 8 | (uint32_t)lrint(255 * x);
  }
  return rgb;
}

/* One of the cubes of a part, if it is before the eye. */
static void sketch_cube(const struct hsr_voxel_cubes *part, int bit,
                        const struct hsr_view *view,
                        const struct hsr_slide *slide) {
  const struct hsr_voxel_grid *grid = part->grid;
  const struct hsr_camera *camera = &view->camera;
  const int place[3] = {bit & 3, bit >> 2 & 3, bit >> 4};
  double point[3], image[3];
  for (int k = 0; k < 3; k++)
    point[k] = grid->lo[k] +
               grid->size * (part->corner[k] + part->size * (place[k] + 0.5));
  hsr_view_project(view, point, image);
  double w = hsr_view_w(view, image);
  if (image[2] <= view->near || w <= 0)
    return;
  double high = view->parallel
                    ? camera->parallel
                    : 2 * w * tan(camera->fov * 3.141592653589793 / 360);
  slide->square(slide->on, (const double[2]){image[0] / w, image[1] / w},
                fmax(0.5, 0.6 * grid->size * part->size * view->n / high),
                image[2], solid_colour(part->solid));
}

static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  const struct hsr_voxel_cubes *part = event->part;
  (void)painted, (void)face;
  for (int bit = 0; step == HSR_ACCEPT && part && bit < 64; bit++)
    if (part->mask >> bit & 1)
      sketch_cube(part, bit, view, slide);
}

static json_t *vector_json(const int v[3]) {
  return json_pack("[iii]", v[0], v[1], v[2]);
}

/* A number in JSON holds 53 bits, so the mask is written as two numbers of 32
 * bits, the lower half first. */
static json_t *cubes_json(const void *part, const struct hsr_view *view) {
  const struct hsr_voxel_cubes *cubes = part;
  (void)view;
  return json_pack("[I o i I I]", (json_int_t)cubes->solid,
                   vector_json(cubes->corner), cubes->size,
                   (json_int_t)(cubes->mask & UINT32_MAX),
                   (json_int_t)(cubes->mask >> 32));
}

/* Runs of one solid, x fastest: solid, length, solid, length ... */
static json_t *runs_json(const struct hsr_solid_voxels *voxels) {
  size_t n = voxels->solid ? hsr_voxel_count(&voxels->grid) : 0;
  return hsr_runs_json(voxels->solid, n, HSR_NO_ID);
}

static json_t *voxels_json(const struct hsr_answer *answer,
                           const struct hsr_view *view) {
  const struct hsr_solid_voxels *voxels = answer->body;
  const struct hsr_voxel_grid *grid = &voxels->grid;
  (void)view;
  return json_pack("{so s[fff] sf so}", "n", vector_json(grid->n), "lo",
                   grid->lo[0], grid->lo[1], grid->lo[2], "size", grid->size,
                   "solids", runs_json(voxels));
}

const struct hsr_answer_type hsr_answer_voxels = {
    .name = "voxels",
    .meaning = "the solid that each voxel is in",
    .draws = "solids",
    .places = "voxels",
    .grains = "samples",
    .options = options,
    .make = make,
    .free = free_body,
    .compare = compare,
    .fits = fits,
    .write = write,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .json = voxels_json,
    .part_json = cubes_json};
