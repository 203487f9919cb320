/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical z-buffer visibility.
 *
 * Source      N. Greene, M. Kass and G. Miller, "Hierarchical Z-Buffer
 *             Visibility", SIGGRAPH 1993 ("1993" below); N. Greene,
 *             "Hierarchical Rendering of Complex Environments", PhD thesis, UC
 *             Santa Cruz, 1995, chapter 3 ("the thesis"). Of coherence=chc and chc++:
 *             coherence.c; of pyramid=masked and pyramid=maps:
 *             algorithms/engines/pyramid/masked.h and maps.h
 * Notation    octree cube -> node. Primitive, polygon -> face. z -> q = 1/t:
 *             greater is nearer. z-pyramid -> pyramid.far[]; znear pyramid ->
 *             pyramid.near[]. ProcessOctreeNode -> process_node (octrees.c);
 *             IsCubeVisible -> hsr_hz_is_cube_visible (cube.c).
 * Invariants  Every face that is tiled lies in a cube that was not found to be
 *             hidden: in this frame, or with coherence in the last one.
 *             Exceptions are loose faces (algorithms/engines/cubes/cubes.h),
 *             and octree=off, which tests no cube. Whenever a cube or a face is
 *             tested, the pyramid agrees with the z-buffer.
 * Ties        A cube or a face is hidden only if it is farther than what hides
 *             it, by more than rounding may change; as near as that is not
 *             hidden. Which of two faces wins a sample is decided as tiler.h
 *             says.
 * Departures  - The faces of a cell go by batches: all faces of a batch are
 *             tested, then those left are tiled. The paper tests and tiles one
 *             face after the other.
 *             - A face is not tested if one of its corners is not safely before
 *             the eye, or lies far outside of the picture (hsr_tiler_bound).
 *             - Loose faces are tiled before anything else.
 *             - The octree of instances has no cube around a single instance.
 *             The root of the instance's own octree is tested instead.
 *             - The fast test begins at the finest level where the rectangle
 *             meets at most 2 x 2 entries, not at the one entry around it.
 *             - pyramid=maps: the occluders are the faces that come first, from
 *             front to back, until there are `occluders` of them. Cubes and
 *             faces are tested from then on. The paper chooses them by size and
 *             nearness from a database, and renders them before the rest.
 *             - octree=lazy keeps for later frames what it has divided (thesis,
 *             3.4).
 *             - The build that is timed projects the octants of a cube
 *             together. It tests an octant's whole rectangle before those of
 *             its sides. Which cubes are hidden is the same.
 * Options     The standard ones are Greene's.
 *             cubes=whole:volumes=tight:least=80 makes the same picture in less
 *             time, by fewer and tighter tests. pyramid=off:cubes=sides does
 *             what the thesis does on a machine with z-queries (3.5.6); least=
 *             is then the number of polygons from which on a cube is asked
 *             about.
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
    {"masked",
     "a masked depth buffer instead: for tiles of 8 x 8 samples two depths and "
     "a mask, as Hasselgren and others have it (2016)",
     0},
    {"maps",
     "hierarchical occlusion maps instead, of the occluders that are tiled "
     "first, as Zhang and others have it (1997)",
     0},
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
    {"sides", "where that leaves it open, scan-converted", 0},
    {"whole", "the cube, instead of its sides, by its bounding rectangle", 0},
    {"entry",
     "sides by one entry of the pyramid, and where that leaves it open, "
     "scan-converted, as in 1993",
     0},
    {NULL}};
static const struct hsr_word polygon_tests[] = {
    {"fast", "bounding rectangles, by recursion", 0},
    {"basic", "bounding rectangles, by one entry", 0},
    {"definitive", "recursion into what the face covers", 0},
    {"none", "no test", 0},
    {NULL}};
enum {
  OCTREE,
  PLACEMENT,
  LEAST,
  PYRAMID,
  OCCLUDERS,
  VOLUMES,
  CUBES,
  POLYGONS,
  COHERENCE,
  ASSUMED
};
enum { PLACEMENT_PUSHED, PLACEMENT_ENCLOSING };

static const struct hsr_option options[] = {
    [OCTREE] = {"octree", "cull by cubes", octrees, 0, 2, HSR_HZ_OCTREE_ON},
    [PLACEMENT] = {"placement", "in which cube a face is", placements, 0, 1,
                   PLACEMENT_PUSHED},
    [LEAST] = {"least", "an octant of fewer faces is its parent's", NULL, 1,
               100000, HSR_HZ_LEAST},
    [PYRAMID] = {"pyramid", "test by the z-pyramid", pyramids, 0, 4,
                 HSR_HZ_PYRAMID_ON},
    [OCCLUDERS] =
        {"occluders",
         "pyramid=maps: the faces to be tiled before the maps are made", NULL,
         1, 1000000, 2000},
    [VOLUMES] = {"volumes", "what is tested for a cube", volumes, 0, 1,
                 HSR_HZ_VOLUMES_CUBES},
    [CUBES] = {"cubes", "how a cube is tested", cube_tests, 0, 3,
               HSR_HZ_CUBES_RECTANGLE},
    [POLYGONS] = {"polygons", "how a face is tested", polygon_tests, 0, 3,
                  HSR_HZ_POLYGONS_FAST},
    [COHERENCE] = {"coherence", "what is kept from frame to frame",
                   hsr_hz_coherences, 0, HSR_HZ_COHERENCE_CHC_PP,
                   HSR_HZ_COHERENCE_OFF},
    [ASSUMED] =
        {"assumed",
         "coherence=chc++: frames for which what is visible is assumed to "
         "be so",
         NULL, 1, 1000, HSR_HZ_ASSUMED},
    {NULL}};

static struct hsr_hz_choice choice_of(const long *option) {
  return (struct hsr_hz_choice){.octree = option[OCTREE],
                                .pyramid = option[PYRAMID],
                                .occluders = option[OCCLUDERS],
                                .volumes = option[VOLUMES],
                                .cubes = option[CUBES],
                                .polygons = option[POLYGONS],
                                .coherence = option[COHERENCE],
                                .assumed = option[ASSUMED]};
}

/* --- Once for all frames -------------------------------------------------- */

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

static void show(const void *prepared, struct hsr_shown *shown) {
  shown->cubes = &((const struct hsr_hz_prepared *)prepared)->cubes;
}

/* --- A frame -------------------------------------------------------------- */

/* octree=off: tiles all cells, by their numbers. No cube is tested. */
static void tile_all(struct hsr_hz_walk *w) {
  for (uint32_t i = 0; i < w->frame.cubes->scene->n_instances; i++) {
    hsr_hz_set_instance(w, i);
    for (uint32_t k = 0; k < w->frame.object->octree.n_nodes; k++)
      hsr_hz_tile_cell(w, k);
  }
}

/* The instances that stand still, by their octree from front to back; then
 * those that move, one by one in any order. */
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
    {"then ProcessOctreeNode for each object that moves, one by one"},
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
    .makes = {{HSR_IDS}},
    .flags = HSR_INSTANCED,
    .parts = uses,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .show = show,
    .release = release};
