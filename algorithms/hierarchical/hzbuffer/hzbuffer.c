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
static const struct hsr_word coherences[] = {
    {"off", "every frame for itself", 0},
    {"list", "a list of visible cubes, rendered first and pruned, as in 1993",
     HSR_FRAME_STATE},
    {"passes", "two passes, as in the thesis", HSR_FRAME_STATE},
    {NULL}};
static const struct hsr_word movings[] = {
    {"octree", "an octree of them in every frame, beside the other", 0},
    {"lazy", "the same, divided only where it is visible", 0},
    {"behind", "one by one, after all that does not move", 0},
    {"update", "an octree of them that is kept and brought up to date",
     HSR_FRAME_STATE},
    {"bounded",
     "the same; each is put again every `interval` frames only, in a box that "
     "holds it for so long, where its speed is known to be limited",
     HSR_FRAME_STATE},
    {"fixed",
     "the same; where it is known that something stays in a volume, it is put "
     "once, with that",
     HSR_FRAME_STATE},
    {"space-time",
     "clusters, in boxes that hold them for an interval, behind all that does "
     "not move; what is not hidden is divided in space or in time",
     HSR_FRAME_STATE},
    {NULL}};
static const struct hsr_option options[] = {
    [OCTREE] = {"octree", "cull by cubes", octrees, 0, 2, ON},
    [PLACEMENT] = {"placement", "in which cube a face is", placements, 0, 1,
                   PUSHED},
    [LEAST] = {"least", "an octant of fewer faces is its parent's", NULL, 1,
               100000, 20},
    [PYRAMID] = {"pyramid", "test by the z-pyramid", pyramids, 0, 2, ON},
    [VOLUMES] = {"volumes", "what is tested for a cube", volumes, 0, 1, CUBE},
    [CUBES] = {"cubes", "how a cube is tested", cube_tests, 0, 2, RECTANGLE},
    [POLYGONS] = {"polygons", "how a face is tested", polygon_tests, 0, 3,
                  FAST},
    [COHERENCE] = {"coherence", "what is kept from frame to frame", coherences,
                   0, 2, NO_COHERENCE},
    [MOVERS] = {"movers", "what is done with objects that move", movings, 0, 6,
                FRESH},
    [INTERVAL] = {"interval", "movers=bounded or space-time: so many frames",
                  NULL, 1, 1024, 16},
    {NULL}};

/* --- A frame -------------------------------------------------------------- */

static enum hsr_status render_loose(struct hsr_hz_walk *w) {
  struct hsr_tiler t;
  if (hsr_cube_loose(&w->frame, &t))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < t.screen.n_relevant; k++)
    hsr_hz_tile_face(w, &t, t.screen.relevant[k]);
  hsr_hz_refresh(w);
  return HSR_OK;
}

static enum hsr_status begin(struct hsr_hz_walk *w, const struct hsr_job *job) {
  struct hsr_hz_prepared *prepared = job->prepared;
  const struct hsr_cubes *cubes = &prepared->cubes;
  struct hsr_arena *arena = job->scratch;
  struct hsr_tiler *t = &w->frame.tiler;
  const struct hsr_window *window = &job->view->window;
  w->option = job->option;
  w->tally = job->tally;
  if (w->option[COHERENCE]) {
    w->last = &prepared->list[prepared->last];
    w->next = &prepared->list[prepared->last ^ 1];
    hsr_cube_list_clear(w->next);
  }
  w->tiled = HSR_NEW_ZEROED(arena, uint32_t, cubes->most_object_faces);
  if (!w->tiled || hsr_cube_frame_begin(&w->frame, job, cubes) ||
      hsr_pyramid_init(&w->pyramid, window, w->option[PYRAMID] == DUAL,
                       &t->z_stride, arena))
    return HSR_E_NOMEM;
  w->pyramid.count =
      (struct hsr_pyramid_count){.tally = job->tally,
                                 .work = job->tally->work,
                                 .work_stride = job->tally->work_stride};
  t->z = w->pyramid.far[0];
  t->ids_stride = job->ids_stride;
  t->ids = job->ids + (size_t)window->y0 * job->ids_stride + window->x0;
  hsr_tiler_begin_part(t, *window);
  hsr_pyramid_clear(&w->pyramid);
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_hz_walk w = {.visit = 0};
  const struct hsr_hz_prepared *prepared = job->prepared;
  if (prepared->half_divided || begin(&w, job))
    return hsr_fail_nomem(err);
  if (render_loose(&w))
    return hsr_fail_nomem(err);
  if (w.last && hsr_hz_render_last(&w))
    return hsr_fail_nomem(err);
  if (!w.option[OCTREE])
    hsr_hz_render_all(&w);
  else if (hsr_hz_render_octrees(&w))
    return hsr_fail_nomem(err);
  if (w.last)
    hsr_hz_end_coherence(&w);
  return w.out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct hsr_hz_prepared *made = calloc(1, sizeof *made);
  *prepared = made;
  if (!made)
    return hsr_fail_nomem(err);
  struct hsr_octree_rule rule = {.small = option[PLACEMENT] == PUSHED ? 0.1 : 0,
                                 .most = (uint32_t)option[LEAST],
                                 .least = (uint32_t)option[LEAST]};
  if (option[OCTREE] == LAZILY)
    return hsr_cubes_init_lazily(&made->cubes, world, &rule, err);
  return hsr_cubes_init(&made->cubes, world, &rule, err);
}

static void release(void *object) {
  struct hsr_hz_prepared *prepared = object;
  hsr_cubes_free(&prepared->cubes);
  hsr_arena_free(&prepared->list[0].arena);
  hsr_arena_free(&prepared->list[1].arena);
  hsr_arena_free(&prepared->movers_arena);
  free(prepared);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiler_part}, {&hsr_inequalities_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [NODES] = {"nodes visited", "octree nodes come to", HSR_ACTIVATE,
               HSR_OF_CELL, HSR_OF_NOTHING},
    [OUT] = {"nodes out", "outside of the frustum", HSR_REJECT, HSR_OF_CELL,
             HSR_OF_WINDOW},
    [CUBES_TESTED] = {"cubes tested", "whether they are hidden", HSR_COMPARE,
                      HSR_OF_CELL, HSR_OF_NOTHING, "hidden|visible"},
    [CUBES_CULLED] = {"cubes culled", "found to be hidden", HSR_REJECT,
                      HSR_OF_CELL, HSR_OF_NOTHING},
    [CUBES_VISIBLE] = {"cubes visible", "not known to be hidden", HSR_ACTIVATE,
                       HSR_OF_CELL, HSR_OF_NOTHING},
    [CUBE_READS] = {"cube reads", "pyramid entries read to test cubes",
                    HSR_COMPARE, HSR_OF_CELL, HSR_OF_CELL,
                    HSR_PYRAMID_READ_OUTCOMES},
    [SIDES_SCANNED] = {"sides scanned", "sides of cubes scan-converted",
                       HSR_COMPARE, HSR_OF_CELL, HSR_OF_WINDOW,
                       "hidden|visible"},
    [SIDE_SAMPLES] = {"side samples", "samples looked at for that", HSR_SAMPLE,
                      HSR_OF_CELL, HSR_OF_WINDOW, "hidden|visible"},
    [FACES] = {"faces met", "in cubes that are not known to be hidden",
               HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_CELL},
    [REPEATED] = {"faces repeated", "met again in the frame", HSR_REJECT,
                  HSR_OF_FACE, HSR_OF_NOTHING},
    [FACES_TESTED] = {"faces tested", "by the pyramid", HSR_COMPARE,
                      HSR_OF_FACE, HSR_OF_WINDOW, "hidden|visible"},
    [FACES_CULLED] = {"faces culled", "found to be hidden", HSR_REJECT,
                      HSR_OF_FACE, HSR_OF_WINDOW},
    [FACES_TILED] = {"faces tiled", "scan-converted", HSR_ACTIVATE, HSR_OF_FACE,
                     HSR_OF_WINDOW},
    [FACE_READS] = {"face reads", "pyramid entries read to test faces",
                    HSR_COMPARE, HSR_OF_CELL, HSR_OF_FACE,
                    HSR_PYRAMID_READ_OUTCOMES},
    [FACES_BEFORE] = {"faces before",
                      "nearer than anything: tiled without comparisons",
                      HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW},
    [CUBES_AGAIN] = {"cubes again",
                     "rendered first, since they were visible in the frame "
                     "before",
                     HSR_ACTIVATE, HSR_OF_CELL, HSR_OF_NOTHING},
    [MOVED] = {"moved down", "instances that move, from a cube to an octant",
               HSR_SORT, HSR_OF_VOLUME, HSR_OF_CELL},
    [SPLITS] = {"splits", "cubes of instances that move, divided",
                HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_NOTHING},
    [LOOKED] = {"movers looked at",
                "in their cubes of the last frame, which may hold them still",
                HSR_COMPARE, HSR_OF_VOLUME, HSR_OF_CELL, "left|kept"},
    [DIVIDED] = {"cubes divided", "when they were first found to be visible",
                 HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_NOTHING},
    [FACES_DOWN] = {"faces down", "handed down to an octant then", HSR_SORT,
                    HSR_OF_FACE, HSR_OF_CELL},
    [STILL_DOWN] = {"instances down",
                    "that do not move, handed down to an octant then", HSR_SORT,
                    HSR_OF_VOLUME, HSR_OF_CELL},
    [MOVERS_MET] = {"movers met", "instances that move, in no hidden cube",
                    HSR_ACTIVATE, HSR_OF_VOLUME, HSR_OF_NOTHING},
    [BOUNDED] = {"ways bounded",
                 "the way of an instance for the frames of a cluster",
                 HSR_COMPARE, HSR_OF_VOLUME, HSR_OF_CELL, "unknown|known"},
    [IN_TIME] = {"splits in time", "of a cluster's frames in halves",
                 HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line outline[] = {
    {"render the cubes that were visible in the last frame",
     HSR_RAISES(CUBES_AGAIN)},
    {"make an octree of what moves: divide a cube", HSR_RAISES(SPLITS)},
    {"or keep it: does its cube still hold an instance?", HSR_RAISES(LOOKED)},
    {"  move an instance down to an octant", HSR_RAISES(MOVED)},
    {"or clusters of it, in boxes for several frames: bound its ways",
     HSR_RAISES(BOUNDED)},
    {"  divide a visible one in time, instead of in space",
     HSR_RAISES(IN_TIME)},
    {"process_node: for each node, from front to back", HSR_RAISES(NODES)},
    {"  return if the cube is outside of the frustum",
     HSR_RAISES(HSR_INEQUALITIES, OUT)},
    {"  return unless cube_visible",
     HSR_RAISES(CUBES_TESTED, CUBES_CULLED, CUBES_VISIBLE)},
    {"    for each front face of the cube: is it behind a pyramid value?",
     HSR_RAISES(CUBE_READS)},
    {"    or scan-convert it", HSR_RAISES(SIDES_SCANNED)},
    {"      is a sample of it visible?", HSR_RAISES(SIDE_SAMPLES)},
    {"  lazily: divide the cube, if it is not divided yet",
     HSR_RAISES(DIVIDED)},
    {"    hand a primitive down to an octant",
     HSR_RAISES(FACES_DOWN, STILL_DOWN)},
    {"  for each instance that moves, in the node", HSR_RAISES(MOVERS_MET)},
    {"  for each polygon attached to the node", HSR_RAISES(FACES)},
    {"    skip it if it has been rendered in this frame", HSR_RAISES(REPEATED)},
    {"    skip it if it is hidden", HSR_RAISES(FACES_TESTED, FACES_CULLED)},
    {"      is it behind a pyramid value?", HSR_RAISES(FACE_READS)},
    {"    tile it", HSR_RAISES(FACES_TILED)},
    {"      without comparisons if it is before all that is there",
     HSR_RAISES(FACES_BEFORE)},
    {"      ", .part = &hsr_tiler_part},
    {"    update the z-pyramid"},
    {"  process_node for each octant"},
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
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release};
