/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical z-buffer visibility.
 *
 * Source      N. Greene, M. Kass and G. Miller, "Hierarchical Z-Buffer
 *             Visibility", SIGGRAPH 1993 ("1993" below); N. Greene,
 *             "Hierarchical Rendering of Complex Environments", PhD thesis, UC
 *             Santa Cruz, 1995, chapter 3 ("the thesis").
 * Notation    octree cube -> node; z-pyramid -> far[]; z -> q = 1/t, greater is
 *             nearer; primitive -> face
 * Invariants  a face that is tiled lies in a cube that is not known to be
 *             hidden, or is loose (algorithms/engines/cubes/cubes.h). Whenever a
 *             cube or a face is tested, the pyramid agrees with the z-buffer.
 * Ties        a cube or a face that is as near as what hides it is not hidden;
 *             which face wins at a sample, tiler.h decides
 * Departures  the faces of a cell are all tested, then all tiled, many at a
 *             time; the paper tests and tiles one after the other. Loose faces
 *             are tiled first. The octree of instances has no cube around a
 *             single instance: the root of its own octree is tested instead.
 *             The fast test begins where the rectangle meets at most four
 *             entries. The standard choice of options is Greene's;
 *             cubes=whole:volumes=tight:least=80 makes the same picture in less
 *             time, by fewer and tighter tests. octree=lazy keeps what it has
 *             divided for later frames (thesis, 3.4). The build that is timed
 *             projects the octants of a cube together, and tests the whole of
 *             one before its sides; answers are the same.
 * Z-queries   pyramid=off:cubes=sides does what the thesis does on a machine
 *             with z-queries (3.5.6); least= is the number of polygons from
 *             which on it asks about a cube.
 * Cost        proportional to what is visible, and to the cubes around it */
#include "algorithms/hierarchical/hzbuffer/walk.h"

#include <stdlib.h>

/* --- Options -------------------------------------------------------------- */

static const struct hsr_word octrees[] = {
    {"off", "without it", 0},
    {"on", "with it", 0},
    {"lazy",
     "with one whose cubes are divided when they are first found to be visible",
     HSR_FRAME_STATE},
    {NULL}};
static const struct hsr_word pyramids[] = {
    {"off", "without it", 0},
    {"on", "with it", 0},
    {"dual", "with it, and a second one of the nearest depths", 0},
    {NULL}};
static const struct hsr_word placements[] = {
    {"pushed",
     "a face that crosses a median plane goes into the octants that it "
     "meets, if its area is less than a tenth of a cube's side",
     0},
    {"enclosing", "it stays in the smallest cube that encloses it", 0},
    {NULL}};
static const struct hsr_word volumes[] = {
    {"cubes", "the octree's", 0},
    {"tight", "the boxes, within them, of what they hold", 0},
    {NULL}};
static const struct hsr_word cube_tests[] = {
    {"rectangle", "sides by their bounding rectangles, as in the thesis", 0},
    {"sides", "where that leaves it open, scan-converted, as in 1993", 0},
    {"whole", "the cube, instead of its sides, by its bounding rectangle", 0},
    {NULL}};
static const struct hsr_word polygon_tests[] = {
    {"fast", "bounding rectangles, by recursion", 0},
    {"basic", "bounding rectangles, by one entry", 0},
    {"definitive", "recursion into what the face covers", 0},
    {"none", "no test", 0},
    {NULL}};
enum { OCTREE, PLACEMENT, LEAST, PYRAMID, VOLUMES, CUBES, POLYGONS, COHERENCE };
enum { PLACEMENT_PUSHED, PLACEMENT_ENCLOSING };

static const struct hsr_option options[] = {
    [OCTREE] = {"octree", "cull by cubes", octrees, 0, 2, HSR_HZ_OCTREE_ON},
    [PLACEMENT] = {"placement", "in which cube a face is", placements, 0, 1,
                   PLACEMENT_PUSHED},
    [LEAST] = {"least", "an octant of fewer faces is its parent's", NULL, 1,
               100000, HSR_HZ_LEAST},
    [PYRAMID] = {"pyramid", "test by the z-pyramid", pyramids, 0, 2,
                 HSR_HZ_PYRAMID_ON},
    [VOLUMES] = {"volumes", "what is tested for a cube", volumes, 0, 1,
                 HSR_HZ_VOLUMES_CUBES},
    [CUBES] = {"cubes", "how a cube is tested", cube_tests, 0, 2,
               HSR_HZ_CUBES_RECTANGLE},
    [POLYGONS] = {"polygons", "how a face is tested", polygon_tests, 0, 3,
                  HSR_HZ_POLYGONS_FAST},
    [COHERENCE] = {"coherence", "what is kept from frame to frame",
                   hsr_hz_coherences, 0, 2, HSR_HZ_COHERENCE_OFF},
    {NULL}};

static struct hsr_hz_choice choice_of(const long *option) {
  return (struct hsr_hz_choice){.octree = option[OCTREE],
                                .pyramid = option[PYRAMID],
                                .volumes = option[VOLUMES],
                                .cubes = option[CUBES],
                                .polygons = option[POLYGONS],
                                .coherence = option[COHERENCE]};
}

/* --- Once ----------------------------------------------------------------- */

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  const struct hsr_octree_rule rule = {
      .small = option[PLACEMENT] == PLACEMENT_PUSHED ? HSR_HZ_SMALL : 0,
      .most = (uint32_t)option[LEAST],
      .least = (uint32_t)option[LEAST]};
  *prepared = calloc(1, sizeof(struct hsr_hz_prepared));
  if (!*prepared)
    return hsr_fail_nomem(err);
  return hsr_hz_prepare(*prepared, world, &rule,
                        option[OCTREE] == HSR_HZ_OCTREE_LAZY, err);
}

static void release(void *prepared) {
  hsr_hz_release(prepared);
  free(prepared);
}

/* --- A frame -------------------------------------------------------------- */

/* octree=off: cell after cell, as they come. */
static void tile_all(struct hsr_hz_walk *w) {
  for (uint32_t i = 0; i < w->frame.cubes->scene->n_instances; i++) {
    hsr_hz_set_instance(w, i);
    for (uint32_t k = 0; k < w->frame.object->octree.n_nodes; k++)
      hsr_hz_tile_cell(w, k);
  }
}

/* What stands still, from front to back; then what moves, one by one. */
static void process_all(struct hsr_hz_walk *w) {
  const struct hsr_cubes *cubes = w->frame.cubes;
  hsr_hz_process_instances(w, 0, false);
  for (uint32_t k = 0; k < cubes->n_movers; k++)
    hsr_hz_process_instance(w, cubes->mover[k]);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_hz_walk w;
  const struct hsr_hz_choice choice = choice_of(job->option);
  if (hsr_hz_begin(&w, job, job->prepared, &choice))
    return hsr_fail_nomem(err);
  if (choice.octree == HSR_HZ_OCTREE_OFF)
    tile_all(&w);
  else
    process_all(&w);
  return hsr_hz_end(&w) ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiler_part}, {&hsr_inequalities_part}, {&hsr_hz_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_hz_part, .group = HSR_HZ_LAST_LINES},
    {"", .part = &hsr_hz_part, .group = HSR_HZ_NODE_LINES},
    {"", .part = &hsr_hz_part, .group = HSR_HZ_POLYGON_LINES},
    {"then process_node for each object that moves, one by one"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(hzbuffer) = {
    .name = "hzbuffer",
    .title = "Hierarchical z-buffer visibility",
    .authors = "N. Greene, M. Kass and G. Miller",
    .year = 1993,
    .source = "Greene, Kass and Miller, SIGGRAPH 1993; Greene, PhD thesis, UC "
              "Santa Cruz, 1995, chapter 3",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "of hidden regions, in space and on the screen",
    .subjects = 1 << HSR_FACES,
    .kind = HSR_IDS,
    .flags = HSR_INSTANCED,
    .parts = uses,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release};
