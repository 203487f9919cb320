/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a frame of the hierarchical z-buffer begins and ends, what is prepared
 * for it, and what is counted. See walk.h. */
#include "algorithms/hierarchical/hzbuffer/walk.h"

const struct hsr_word hsr_hz_coherences[] = {
    {"off", "every frame for itself", 0},
    {"list", "a list of visible cubes, rendered first and pruned, as in 1993",
     HSR_FRAME_STATE},
    {"passes", "two passes, as in the thesis", HSR_FRAME_STATE},
    {"chc",
     "coherent hierarchical culling: inner cubes in which something was "
     "visible "
     "are not tested, as Bittner and others have it (2004)",
     HSR_FRAME_STATE},
    {"chc++",
     "the same; what is visible is assumed to be so for some frames, as "
     "Mattausch and others have it (2008)",
     HSR_FRAME_STATE},
    {NULL}};

/* --- Once for all frames -------------------------------------------------- */

enum hsr_status hsr_hz_prepare(struct hsr_hz_prepared *p,
                               const struct hsr_world *world,
                               const struct hsr_octree_rule *rule, bool lazily,
                               struct hsr_error *err) {
  return lazily ? hsr_cubes_init_lazily(&p->cubes, world, rule, err)
                : hsr_cubes_init(&p->cubes, world, rule, err);
}

void hsr_hz_release(struct hsr_hz_prepared *p) {
  hsr_cubes_free(&p->cubes);
  hsr_arena_free(&p->list[0].arena);
  hsr_arena_free(&p->list[1].arena);
}

/* --- A frame -------------------------------------------------------------- */

/* Without coherence both lists stay NULL. */
static void begin_lists(struct hsr_hz_walk *w) {
  struct hsr_hz_prepared *p = w->prepared;
  if (w->choice.coherence == HSR_HZ_COHERENCE_OFF)
    return;
  w->last = &p->list[p->last];
  w->next = &p->list[p->last ^ 1];
  hsr_cube_list_clear(w->next);
}

/* Makes level 0 of the pyramid the tiler's z-buffer, and clears both. */
static enum hsr_status begin_depths(struct hsr_hz_walk *w,
                                    const struct hsr_job *job) {
  const struct hsr_window *window = &job->view->window;
  struct hsr_tiler *t = &w->frame.tiler;
  if (hsr_pyramid_init(&w->pyramid, window,
                       w->choice.pyramid == HSR_HZ_PYRAMID_DUAL, &t->z_stride,
                       job->scratch))
    return HSR_E_NOMEM;
  if ((w->choice.pyramid == HSR_HZ_PYRAMID_MASKED &&
       hsr_masked_init(&w->masked, window, job->scratch)) ||
      (w->choice.pyramid == HSR_HZ_PYRAMID_MAPS &&
       hsr_maps_init(&w->maps, window, job->scratch)))
    return HSR_E_NOMEM;
  w->count = (struct hsr_entry_count){.tally = job->tally};
  w->pyramid.count = w->masked.count = w->maps.count = &w->count;
  w->masked.updates = HSR_HZ_TILES_MASKED;
  t->z = w->pyramid.far[0];
  t->ids_stride = (size_t)job->answer->m;
  t->ids = hsr_job_row(job, window->y0) + window->x0;
  hsr_tiler_begin_part(t, *window);
  hsr_pyramid_clear(&w->pyramid);
  return HSR_OK;
}

static enum hsr_status tile_loose(struct hsr_hz_walk *w) {
  struct hsr_tiler t;
  if (hsr_cube_loose(&w->frame, &t))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < t.screen.n_relevant; k++)
    hsr_hz_tile_face(w, &t, t.screen.relevant[k]);
  hsr_hz_refresh(w);
  return HSR_OK;
}

enum hsr_status hsr_hz_begin(struct hsr_hz_walk *w, const struct hsr_job *job,
                             struct hsr_hz_prepared *prepared,
                             const struct hsr_hz_choice *choice) {
  *w = (struct hsr_hz_walk){
      .choice = *choice,
      .prepared = prepared,
      .tally = job->tally,
      .met = HSR_NEW_ZEROED(job->scratch, uint32_t,
                            prepared->cubes.most_object_faces)};
  if (prepared->half_divided || !w->met)
    return HSR_E_NOMEM;
  begin_lists(w);
  if (hsr_cube_frame_begin(&w->frame, job, &prepared->cubes) ||
      begin_depths(w, job) || tile_loose(w))
    return HSR_E_NOMEM;
  if (hsr_hz_is_chc(w))
    return hsr_hz_begin_chc(w);
  return w->last ? hsr_hz_render_last(w) : HSR_OK;
}

enum hsr_status hsr_hz_end(struct hsr_hz_walk *w) {
  if (w->last)
    hsr_hz_end_coherence(w);
  return w->out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

/* --- What is counted ------------------------------------------------------ */

/* In the order of HSR_HZ_NODES and so on. */
static const struct hsr_counter counters[] = {
    {"nodes visited", "octree nodes come to", HSR_ACTIVATE, HSR_OF_CELL,
     HSR_OF_NOTHING, .key = "cube-visited"},
    {"nodes out", "outside of the frustum", HSR_REJECT, HSR_OF_CELL,
     HSR_OF_WINDOW, .key = "cube-out"},
    {"cubes tested", "whether they are hidden", HSR_COMPARE, HSR_OF_CELL,
     HSR_OF_NOTHING, "hidden|visible", .key = "cube-tested"},
    {"cubes culled", "found to be hidden", HSR_REJECT, HSR_OF_CELL,
     HSR_OF_NOTHING, .key = "cube-culled"},
    {"cubes visible", "not known to be hidden", HSR_ACTIVATE, HSR_OF_CELL,
     HSR_OF_NOTHING, .key = "cube-visible"},
    {"cube reads",
     "entries of the pyramid or the maps, or masked tiles, read to test cubes",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_CELL, HSR_ENTRY_READ_OUTCOMES,
     .key = "cube-read"},
    {"sides scanned", "sides of cubes scan-converted", HSR_COMPARE, HSR_OF_CELL,
     HSR_OF_WINDOW, "hidden|visible"},
    {"side samples", "samples looked at for that", HSR_SAMPLE, HSR_OF_CELL,
     HSR_OF_WINDOW, "hidden|visible", .key = "side-sample"},
    {"faces met", "in cubes that are not known to be hidden", HSR_ACTIVATE,
     HSR_OF_FACE, HSR_OF_CELL, .key = "face-met"},
    {"faces repeated", "met again in the frame", HSR_REJECT, HSR_OF_FACE,
     HSR_OF_NOTHING},
    {"faces tested", "by the pyramid", HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW,
     "hidden|visible", .key = "face-tested"},
    {"faces culled", "found to be hidden", HSR_REJECT, HSR_OF_FACE,
     HSR_OF_WINDOW},
    {"faces tiled", "scan-converted", HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW,
     .key = "face-tiled"},
    {"face reads",
     "entries of the pyramid or the maps, or masked tiles, read to test faces",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_FACE, HSR_ENTRY_READ_OUTCOMES,
     .key = "face-read"},
    {"faces before", "nearer than anything: tiled without comparisons",
     HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW},
    {"cubes again",
     "rendered first, since they were visible in the frame before",
     HSR_ACTIVATE, HSR_OF_CELL, HSR_OF_NOTHING},
    {"cubes divided", "when they were first found to be visible", HSR_SUBDIVIDE,
     HSR_OF_CELL, HSR_OF_NOTHING},
    {"faces down", "handed down to an octant then", HSR_SORT, HSR_OF_FACE,
     HSR_OF_CELL},
    {"instances down", "that do not move, handed down to an octant then",
     HSR_SORT, HSR_OF_VOLUME, HSR_OF_CELL},
    {"tiles masked",
     "of the masked buffer, updated for a face that covers them", HSR_COMPARE,
     HSR_OF_CELL, HSR_OF_FACE, HSR_MASKED_UPDATE_OUTCOMES},
    {"occluders", "faces tiled before the occlusion maps are made",
     HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line last_lines[] = {
    {"render the cubes that were visible in the last frame",
     HSR_RAISES(HSR_HZ_CUBES_AGAIN)},
    {NULL}};

static const struct hsr_line node_lines[] = {
    {"ProcessOctreeNode: for each node, from front to back",
     HSR_RAISES(HSR_HZ_NODES)},
    {"  return if the cube is outside of the frustum",
     HSR_RAISES(HSR_INEQUALITIES, HSR_HZ_NODES_OUT)},
    {"  return unless IsCubeVisible",
     HSR_RAISES(HSR_HZ_CUBES_TESTED, HSR_HZ_CUBES_CULLED,
                HSR_HZ_CUBES_VISIBLE)},
    {"    for each front face of the cube: is it behind a pyramid value?",
     HSR_RAISES(HSR_HZ_CUBE_READS)},
    {"    or scan-convert it", HSR_RAISES(HSR_HZ_SIDES_SCANNED)},
    {"      is a sample of it visible?", HSR_RAISES(HSR_HZ_SIDE_SAMPLES)},
    {"  lazily: divide the cube, if it is not divided yet",
     HSR_RAISES(HSR_HZ_CUBES_DIVIDED)},
    {"    hand a primitive down to an octant",
     HSR_RAISES(HSR_HZ_FACES_DOWN, HSR_HZ_INSTANCES_DOWN)},
    {NULL}};

static const struct hsr_line polygon_lines[] = {
    {"  for each polygon attached to the node", HSR_RAISES(HSR_HZ_FACES_MET)},
    {"    skip it if it has been rendered in this frame",
     HSR_RAISES(HSR_HZ_FACES_REPEATED)},
    {"    skip it if it is hidden",
     HSR_RAISES(HSR_HZ_FACES_TESTED, HSR_HZ_FACES_CULLED)},
    {"      is it behind a pyramid value?", HSR_RAISES(HSR_HZ_FACE_READS)},
    {"    tile it", HSR_RAISES(HSR_HZ_FACES_TILED)},
    {"      without comparisons if it is before all that is there",
     HSR_RAISES(HSR_HZ_FACES_BEFORE)},
    {"      ", .part = &hsr_tiler_part},
    {"    update the z-pyramid"},
    {"    or the masked buffer: merge its samples of a tile, or drop others",
     HSR_RAISES(HSR_HZ_TILES_MASKED)},
    {"    or it is an occluder: with enough of them, make the occlusion maps",
     HSR_RAISES(HSR_HZ_OCCLUDERS)},
    {"  ProcessOctreeNode for each octant"},
    {NULL}};

const struct hsr_part hsr_hz_part = {
    .number = HSR_PART_HZ,
    .counters = counters,
    .lines = {last_lines, node_lines, polygon_lines}};
