/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiling of solids: which solid of a scene each voxel of a grid is in.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 8: tiling in three dimensions, which he thought
 *             possible and did not build.
 * Notation    solids are numbered from 1; (C_c, C_v) and listing 1:
 *             algorithms/volume/solid_pyramid.h
 * Invariant   a voxel that is covered keeps its solid
 * Ties        a centre is never on a face: docs/solid-voxels.md
 * Departures  a solid that is not convex is tiled part by part. As its parts
 *             only touch, no voxel is in two of them.
 * Cost        cells that faces cross, times the planes that cross them; not
 *             the voxels. Their writing takes one step a voxel.
 */
#include "algorithms/volume/solid_pyramid.h"
#include "common/adapt/adapt.h"
#include "common/answers/kinds/voxels.h"

#include <stdlib.h>

enum { PARTS = HSR_SOLID_COUNTERS, PYRAMID_BITS };

/* --- Before any frame ----------------------------------------------------- */

struct solids {
  struct hsr_edges edges;
  struct hsr_volumes volumes;
};

/* Every face must be of a solid. */
static enum hsr_status check(const struct hsr_volumes *volumes,
                             struct hsr_error *err) {
  for (uint32_t b = 0; b < volumes->n_bodies; b++)
    if (volumes->solid_start[b] == volumes->solid_start[b + 1])
      return hsr_fail(
          err, HSR_E_REFUSED,
          "%s: face %u is not of a closed solid that can be divided "
          "into convex parts",
          hsr_restriction_code(HSR_CC), volumes->face[volumes->face_start[b]]);
  return HSR_OK;
}

static void release(void *prepared) {
  struct solids *solids = prepared;
  hsr_volumes_free(&solids->volumes);
  hsr_edges_free(&solids->edges);
  free(solids);
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct solids *solids = calloc(1, sizeof *solids);
  (void)option;
  if (!solids)
    return hsr_fail_nomem(err);
  *prepared = solids;
  enum hsr_status status = hsr_edges_init(&solids->edges, world, err);
  if (!status)
    status = hsr_volumes_init(&solids->volumes, &solids->edges, err);
  return status ? status : check(&solids->volumes, err);
}

/* --- The tiling ----------------------------------------------------------- */

static void cover(void *context, const struct hsr_voxel_cubes *cubes) {
  hsr_solid_voxels_put(context, cubes);
}

/* All parts of a solid. */
static void tile_solid(struct hsr_solid_pyramid *pyramid, uint32_t body,
                       struct hsr_tally *tally) {
  const struct hsr_volumes *volumes = pyramid->volumes;
  for (uint32_t v = volumes->solid_start[body];
       v < volumes->solid_start[body + 1]; v++) {
    HSR_STEP(tally, PARTS, HSR_VOLUME(body + 1), HSR_NOTHING, HSR_NOWHERE, 0);
    hsr_solid_pyramid_tile(pyramid, v, body + 1, tally);
  }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  const struct solids *solids = job->prepared;
  struct hsr_solid_voxels *voxels = hsr_answer_voxels_of(job->answer);
  struct hsr_voxel_grid grid;
  struct hsr_solid_pyramid pyramid;
  enum hsr_status status = hsr_voxel_grid_init(
      &grid, job->world, hsr_form_voxels(&job->answer->form), err);
  if (status)
    return status;
  if (hsr_solid_voxels_open(voxels, &grid) ||
      hsr_solid_pyramid_init(&pyramid, &grid, &solids->volumes, job->scratch))
    return hsr_fail_nomem(err);
  pyramid.cover = cover;
  pyramid.context = voxels;
  HSR_COMPUTED(job->tally, PYRAMID_BITS, 8 * pyramid.bytes);
  for (uint32_t b = 0; b < solids->volumes.n_bodies; b++)
    tile_solid(&pyramid, b, job->tally);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [HSR_SOLID_CELL] = {"cells", "cells visited above the finest level",
                        HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_VOLUME, NULL, false},
    [HSR_SOLID_FINEST] = {"finest cells", "cells visited of 4 x 4 x 4 voxels",
                          HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_VOLUME, NULL,
                          false},
    [HSR_SOLID_MASK] = {"masks of planes", "masks of planes over cells, made",
                        HSR_COMPARE, HSR_OF_FACE, HSR_OF_CELL,
                        "outside|inside|crossing", false},
    [HSR_SOLID_EXACT] = {"exact decisions",
                         "centres of voxels before planes, decided exactly",
                         HSR_COMPARE, HSR_OF_FACE, HSR_OF_CELL,
                         "outside|inside", false},
    [HSR_SOLID_COVERED] = {"covered", "masks of voxels and cells written",
                           HSR_ACCEPT, HSR_OF_VOLUME, HSR_OF_CELL, NULL, false},
    [PARTS] = {"convex parts", "convex solids, and convex parts of others",
               HSR_ACTIVATE, HSR_OF_VOLUME, HSR_OF_NOTHING, NULL, false},
    [PYRAMID_BITS] = {"pyramid bits", "size of the coverage pyramid, in bits",
                      HSR_ACTIVATE, HSR_OF_NOTHING, HSR_OF_NOTHING, NULL, true},
    {NULL}};

static const struct hsr_line outline[] = {
    {"clear the coverage pyramid", HSR_RAISES(PYRAMID_BITS)},
    {"for each convex part of each solid:", HSR_RAISES(PARTS)},
    {"  begin with the root cell"},
    {"  for each cell that is visited:",
     HSR_RAISES(HSR_SOLID_CELL, HSR_SOLID_FINEST)},
    {"    compose the part's triage mask out of those of its planes",
     HSR_RAISES(HSR_SOLID_MASK)},
    {"    in a finest cell, decide each active voxel by its centre",
     HSR_RAISES(HSR_SOLID_EXACT)},
    {"    cover what is vacant here and inside the part",
     HSR_RAISES(HSR_SOLID_COVERED)},
    {"    visit the active subcells; then propagate their coverage"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(tiling_solids) = {
    .name = "tiling-solids",
    .numbered = HSR_NUMBERED_SOLIDS,
    .title = "Greene's hierarchical tiling of solids",
    .authors = "N. Greene",
    .year = 1996,
    .source = "N. Greene, \"Hierarchical Polygon Tiling with Coverage Masks\", "
              "SIGGRAPH 1996, section 8",
    .taxonomy = HSR_VOLUME_SPACE,
    .coherence = "area coherence, in three dimensions",
    .restrictions = HSR_CC,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_VOXELS}},
    .counters = counters,
    .outline = outline,
    .prepare = prepare,
    .render = render,
    .release = release};
