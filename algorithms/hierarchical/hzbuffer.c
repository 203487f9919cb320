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
 *             hidden, or is loose (algorithms/hierarchical/cubes.h). Whenever a
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
 *             time, by fewer and tighter tests. pyramid=queries emulates a
 *             machine with z-queries (thesis, 3.5.6): its steps are performed
 *             here, and only its latency is a pause. octree=lazy keeps what it
 *             has divided for later frames (thesis, 3.4). The build that is
 *             timed projects the octants of a cube together, and tests the
 *             whole of one before its sides; answers are the same.
 * Cost        proportional to what is visible, and to the cubes around it */
#include "algorithms/hierarchical/cube_frame.h"
#include "algorithms/hierarchical/cube_list.h"
#include "algorithms/hierarchical/cube_octants.h"
#include "algorithms/hierarchical/movers.h"
#include "algorithms/hierarchical/pyramid.h"
#include "algorithms/hierarchical/space_time.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
  NODES = HSR_N_TILER_COUNTERS,
  INEQUALITIES,
  OUT,
  CUBES_TESTED,
  CUBES_CULLED,
  CUBES_VISIBLE,
  QUERIES,
  CUBE_READS,
  SIDES_SCANNED,
  SIDE_SAMPLES,
  FACES,
  REPEATED,
  FACES_TESTED,
  FACES_CULLED,
  FACES_TILED,
  FACE_READS,
  FACES_BEFORE,
  COMPLETED,
  CUBES_AGAIN,
  MOVED,
  SPLITS,
  LOOKED,
  DIVIDED,
  FACES_DOWN,
  STILL_DOWN,
  MOVERS_MET,
  BOUNDED,
  IN_TIME
};

static const struct hsr_counter counters[] = {
    HSR_TILER_COUNTERS,
    [NODES] = {"nodes visited", "octree nodes come to", HSR_ACTIVATE,
               HSR_OF_CELL, HSR_OF_NOTHING},
    [INEQUALITIES] = HSR_INEQUALITIES_COUNTER,
    [OUT] = {"nodes out", "outside of the frustum", HSR_REJECT, HSR_OF_CELL,
             HSR_OF_WINDOW},
    [CUBES_TESTED] = {"cubes tested", "whether they are hidden", HSR_COMPARE,
                      HSR_OF_CELL, HSR_OF_NOTHING, "hidden|visible"},
    [CUBES_CULLED] = {"cubes culled", "found to be hidden", HSR_REJECT,
                      HSR_OF_CELL, HSR_OF_NOTHING},
    [CUBES_VISIBLE] = {"cubes visible", "not known to be hidden", HSR_ACTIVATE,
                       HSR_OF_CELL, HSR_OF_NOTHING},
    [QUERIES] = {"z-queries",
                 "cubes of which it was asked if a sample is visible",
                 HSR_COMPARE, HSR_OF_CELL, HSR_OF_NOTHING, "hidden|visible"},
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
    [COMPLETED] = {"completed", "samples known to be done", HSR_RETIRE,
                   HSR_OF_CELL, HSR_OF_WINDOW},
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
     HSR_RAISES(INEQUALITIES) | HSR_RAISES(OUT)},
    {"  return unless cube_visible", HSR_RAISES(CUBES_TESTED) |
                                         HSR_RAISES(CUBES_CULLED) |
                                         HSR_RAISES(CUBES_VISIBLE)},
    {"    for each front face of the cube: is it behind a pyramid value?",
     HSR_RAISES(CUBE_READS)},
    {"    or ask by a z-query, if it holds enough faces", HSR_RAISES(QUERIES)},
    {"    or scan-convert it", HSR_RAISES(SIDES_SCANNED)},
    {"      is a sample of it visible?", HSR_RAISES(SIDE_SAMPLES)},
    {"      tag the sample as completed", HSR_RAISES(COMPLETED)},
    {"  lazily: divide the cube, if it is not divided yet",
     HSR_RAISES(DIVIDED)},
    {"    hand a primitive down to an octant",
     HSR_RAISES(FACES_DOWN) | HSR_RAISES(STILL_DOWN)},
    {"  for each instance that moves, in the node", HSR_RAISES(MOVERS_MET)},
    {"  for each polygon attached to the node", HSR_RAISES(FACES)},
    {"    skip it if it has been rendered in this frame", HSR_RAISES(REPEATED)},
    {"    skip it if it is hidden",
     HSR_RAISES(FACES_TESTED) | HSR_RAISES(FACES_CULLED)},
    {"      is it behind a pyramid value?", HSR_RAISES(FACE_READS)},
    {"    tile it", HSR_RAISES(FACES_TILED)},
    {"      without comparisons if it is before all that is there",
     HSR_RAISES(FACES_BEFORE)},
    HSR_TILER_LINES("      "),
    {"    update the z-pyramid"},
    {"  process_node for each octant"},
    {NULL}};

enum option {
  OCTREE,
  PLACEMENT,
  LEAST,
  SMALL,
  PYRAMID,
  VOLUMES,
  CUBES,
  POLYGONS,
  NEAR,
  COMPLETED_SAMPLES,
  COHERENCE,
  MOVERS,
  INTERVAL,
  THRESHOLD,
  LATENCY,
  WORK
};
enum { OFF, ON, BY_QUERIES };
enum { LAZILY = 2 };
enum { PUSHED, ENCLOSING };
enum { CUBE, TIGHT };
enum { RECTANGLE, SIDES, WHOLE };
enum { FAST, BASIC, DEFINITIVE, NONE };
enum { NO_COHERENCE, LIST, PASSES };
enum { FRESH, LAZY, BEHIND, KEPT, BY_SPEED, BY_VOLUME, SPACE_TIME };
enum { WORK_ALL, WORK_PYRAMID, WORK_BOXES, WORK_POLYGONS };

static const struct hsr_word off_on[] = {
    {"off", "without it", 0}, {"on", "with it", 0}, {NULL, NULL, 0}};
static const struct hsr_word octrees[] = {
    {"off", "without it", 0},
    {"on", "with it", 0},
    {"lazy",
     "with one whose cubes are divided when they are first found to be visible",
     HSR_FRAME_STATE},
    {NULL, NULL, 0}};
static const struct hsr_word pyramids[] = {
    {"off", "without it", 0},
    {"on", "with it", 0},
    {"queries",
     "without it: by z-queries of a machine, which tell if a sample of a "
     "cube's sides is visible; as on the Titan and Denali of the thesis",
     0},
    {NULL, NULL, 0}};
static const struct hsr_word placements[] = {
    {"pushed",
     "a small face that crosses a median plane goes into the octants "
     "that it meets",
     0},
    {"enclosing", "it stays in the smallest cube that encloses it", 0},
    {NULL, NULL, 0}};
static const struct hsr_word volumes[] = {
    {"cubes", "the octree's", 0},
    {"tight", "the boxes, within them, of what they hold", 0},
    {NULL, NULL, 0}};
static const struct hsr_word cube_tests[] = {
    {"rectangle", "sides by their bounding rectangles, as in the thesis", 0},
    {"sides", "where that leaves it open, scan-converted, as in 1993", 0},
    {"whole", "the cube, instead of its sides, by its bounding rectangle", 0},
    {NULL, NULL, 0}};
static const struct hsr_word polygon_tests[] = {
    {"fast", "bounding rectangles, by recursion", 0},
    {"basic", "bounding rectangles, by one entry", 0},
    {"definitive", "recursion into what the face covers", 0},
    {"none", "no test", 0},
    {NULL, NULL, 0}};
static const struct hsr_word coherences[] = {
    {"off", "every frame for itself", 0},
    {"list", "a list of visible cubes, rendered first and pruned, as in 1993",
     HSR_FRAME_STATE},
    {"passes", "two passes, as in the thesis", HSR_FRAME_STATE},
    {NULL, NULL, 0}};
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
    {NULL, NULL, 0}};
static const struct hsr_word works[] = {
    {"all", "everything", 0},
    {"pyramid", "pyramid tests", 0},
    {"boxes", "scan-converted sides of cubes", 0},
    {"polygons", "tiling", 0},
    {NULL, NULL, 0}};

static const struct hsr_option options[] = {
    [OCTREE] = {"octree", "cull by cubes", octrees, 0, 2, ON},
    [PLACEMENT] = {"placement", "in which cube a face is", placements, 0, 1,
                   PUSHED},
    [LEAST] = {"least", "an octant of fewer faces is its parent's", NULL, 1,
               100000, 20},
    [SMALL] = {"small", "small is an area of less than 1/N of a cube's side",
               NULL, 1, 100000, 10},
    [PYRAMID] = {"pyramid", "test by the z-pyramid", pyramids, 0, 2, ON},
    [VOLUMES] = {"volumes", "what is tested for a cube", volumes, 0, 1, CUBE},
    [CUBES] = {"cubes", "how a cube is tested", cube_tests, 0, 2, RECTANGLE},
    [POLYGONS] = {"polygons", "how a face is tested", polygon_tests, 0, 3,
                  FAST},
    [NEAR] = {"near", "a second pyramid, of the nearest depths", off_on, 0, 1,
              OFF},
    [COMPLETED_SAMPLES] = {"completed",
                           "tag samples behind which a cube's side was found, "
                           "where instances are apart and sides scanned",
                           off_on, 0, 1, OFF},
    [COHERENCE] = {"coherence", "what is kept from frame to frame", coherences,
                   0, 2, NO_COHERENCE},
    [MOVERS] = {"movers", "what is done with objects that move", movings, 0, 6,
                FRESH},
    [INTERVAL] = {"interval", "movers=bounded or space-time: so many frames",
                  NULL, 1, 1024, 16},
    [THRESHOLD] = {"threshold",
                   "pyramid=queries: cubes of fewer faces are not asked of",
                   NULL, 0, 1000000, 800},
    [LATENCY] = {"latency",
                 "pyramid=queries: microseconds until a z-query is answered",
                 NULL, 0, 1000000, 0},
    [WORK] = {"work", "what the work picture shows", works, 0, 3, WORK_ALL},
    {NULL, NULL, NULL, 0, 0, 0}};

/* What lasts from frame to frame. */
struct prepared {
  struct hsr_cubes cubes;
  struct hsr_cube_list
      list[2]; /* visible cubes, of the last frame and of this */
  int last;    /* which one is the last frame's */

  bool half_divided; /* octree=lazy: memory ran out in the middle of it */

  struct hsr_movers movers;       /* movers=update, bounded, fixed: kept */
  struct hsr_space_time clusters; /* movers=space-time */
  struct hsr_arena movers_arena;  /* of either */

  /* With z-queries: how many faces are in a cube and below. */
  uint32_t **in_object; /* an object, a node of its octree */
  uint64_t *below;      /* a node of the octree of instances */
  struct hsr_arena arena;
};

struct walk {
  struct hsr_cube_frame frame;
  struct hsr_cube_list *last, *next; /* NULL without coherence */
  struct hsr_cube_marks rendered;    /* what of the last frame's was */
  struct hsr_movers movers;
  bool out_of_memory;
  struct hsr_pyramid pyramid;
  struct hsr_bounds
      stale;  /* the pyramid above it is not up to date; or empty */
  bool plain; /* no tests, and the pyramid is left as it is */
  const long *option;
  struct hsr_tally *tally;
  float *work;     /* the work picture, or NULL */
  uint32_t *tiled; /* a face of the object at hand: the visit when it was met */
  uint32_t visit;
};

/* Samples that are touched from now on are touched by work of that kind. */
static void touch_for(struct walk *w, int kind) {
  long wanted = w->option[WORK];
  w->tally->work = wanted == WORK_ALL || wanted == kind ? w->work : NULL;
}

/* --- Is a cube visible? --------------------------------------------------- */

/* What the pyramid is read for from now on. */
static inline void read_for(struct walk *w, int counter,
                            struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  w->pyramid.count.reads = counter;
  w->pyramid.count.whom = whom;
}

/* The columns of row j, within HSR_CUBE_MARGIN, of a convex polygon's. */
static bool row_of_side(const struct hsr_cube_image *image,
                        const unsigned char *corner, double y, double *lo,
                        double *hi) {
  double top = y - HSR_CUBE_MARGIN, bottom = y + HSR_CUBE_MARGIN;
  *lo = INFINITY;
  *hi = -INFINITY;
  for (int k = 0; k < 4; k++) {
    double ax = image->x[corner[k]], ay = image->y[corner[k]];
    double bx = image->x[corner[(k + 1) % 4]],
           by = image->y[corner[(k + 1) % 4]];
    if (fmin(ay, by) > bottom || fmax(ay, by) < top)
      continue;
    double from = fmin(fmax(fmin(ay, by), top), bottom);
    double to = fmin(fmax(fmax(ay, by), top), bottom);
    double slope = ay == by ? 0 : (bx - ax) / (by - ay);
    double p = ay == by ? ax : ax + slope * (from - ay);
    double q = ay == by ? bx : ax + slope * (to - ay);
    *lo = fmin(*lo, fmin(p, q));
    *hi = fmax(*hi, fmax(p, q));
  }
  *lo -= 2 * HSR_CUBE_MARGIN;
  *hi += 2 * HSR_CUBE_MARGIN;
  return *lo <= *hi;
}

/* Tags a sample that is before the side of a cube. Cubes come from front to
 * back, so nothing that is still to come is nearer there. */
static void complete(struct walk *w, struct hsr_subject cube, float *z, int i,
                     int j) {
  if (*z == HUGE_VALF)
    return;
  *z = HUGE_VALF;
  HSR_STEP(w->tally, COMPLETED, cube, HSR_THE_WINDOW, HSR_AT(i, j), 0);
  hsr_pyramid_update(&w->pyramid, (struct hsr_bounds){i, j, i + 1, j + 1});
}

/* Is a point on the screen within a side, wherever its corners are within
 * HSR_CUBE_MARGIN? */
static bool is_within(const struct hsr_cube_image *image,
                      const unsigned char *corner, double x, double y) {
  int turns = 0;
  for (int k = 0; k < 4; k++) {
    int a = corner[k], b = corner[(k + 1) % 4];
    double dx = image->x[b] - image->x[a], dy = image->y[b] - image->y[a];
    double e = dx * (y - image->y[a]) - dy * (x - image->x[a]);
    double bound = 4 * HSR_CUBE_MARGIN *
                   (fabs(dx) + fabs(dy) + fabs(x - image->x[a]) +
                    fabs(y - image->y[a]) + 2 * HSR_CUBE_MARGIN);
    turns += e > bound ? 1 : e < -bound ? -1 : 0;
  }
  return turns == 4 || turns == -4;
}

/* Scan-converts a side, to the first sample where it is not hidden. */
static bool scan_side(struct walk *w, const struct hsr_placing *placing,
                      const struct hsr_octree_box *cube,
                      const struct hsr_cube_image *image, int side,
                      const struct hsr_bounds *box,
                      struct hsr_subject subject) {
  const struct hsr_view *view = w->frame.job->view;
  const struct hsr_tiler *t = &w->frame.tiler;
  struct hsr_side_depth depth =
      hsr_cube_side_depth(&w->frame, placing, cube, image, side);
  bool tags = w->option[COMPLETED_SAMPLES] && w->frame.cubes->apart;
  touch_for(w, WORK_BOXES);
  for (int j = box->y0; j < box->y1; j++) {
    double y = hsr_sample_y(view, j), lo, hi;
    if (!row_of_side(image, hsr_cube_side[side], y, &lo, &hi))
      continue;
    float *z = t->z + (size_t)(j - t->part.y0) * t->z_stride;
    for (int i = box->x0; i < box->x1; i++) {
      double x = hsr_sample_x(view, i);
      if (x < lo || x > hi)
        continue;
      HSR_TOUCH(w->tally, i, j);
      float q = (float)(depth.c + depth.a * x + depth.b * y);
      q = q < image->nearest ? q : image->nearest;
      q = q > 0 ? q : 0;
      bool visible = !(q * HSR_CLEAR < z[i - t->part.x0]);
      HSR_STEP(w->tally, SIDE_SAMPLES, subject, HSR_THE_WINDOW, HSR_AT(i, j),
               visible);
      if (visible)
        return true;
      if (tags && is_within(image, hsr_cube_side[side], x, y))
        complete(w, subject, &z[i - t->part.x0], i, j);
    }
  }
  return false;
}

/* The nearest of a side's corners. */
static float nearest_of(const struct hsr_cube_image *image,
                        const unsigned char *corner) {
  float q = image->q[corner[0]];
  for (int k = 1; k < 4; k++)
    q = image->q[corner[k]] > q ? image->q[corner[k]] : q;
  return q;
}

/* Does the pyramid hide a rectangle of a cube, whose depth is q? *visible: the
 * pyramid of the nearest tells that it is visible. */
static bool is_rectangle_hidden(struct walk *w, struct hsr_bounds box, float q,
                                bool *visible) {
  *visible = w->option[NEAR] && w->option[CUBES] != SIDES &&
             hsr_pyramid_before(&w->pyramid, box, q);
  return !*visible && hsr_pyramid_hides(&w->pyramid, box, q);
}

/* Is a front side not known to be hidden? */
static bool is_side_visible(struct walk *w, const struct hsr_placing *placing,
                            const struct hsr_octree_box *cube,
                            const struct hsr_cube_image *image, int side,
                            struct hsr_subject subject) {
  const unsigned char *corner = hsr_cube_side[side];
  struct hsr_bounds box;
  if (!hsr_cube_bounds(&w->frame, image, corner, 4, &box))
    return false;
  bool visible = false;
  if (w->option[PYRAMID] == ON &&
      is_rectangle_hidden(w, box, nearest_of(image, corner), &visible))
    return false;
  if (w->option[CUBES] != SIDES && w->option[PYRAMID] != BY_QUERIES)
    return true;
  visible = scan_side(w, placing, cube, image, side, &box, subject);
  HSR_STEP(w->tally, SIDES_SCANNED, subject, HSR_THE_WINDOW,
           hsr_window_make(box.x0, box.y0, box.x1, box.y1), visible);
  return visible;
}

/* The same of the cube as a whole. */
static bool is_whole_visible(struct walk *w,
                             const struct hsr_cube_image *image) {
  static const unsigned char all[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  struct hsr_bounds box;
  bool visible;
  return hsr_cube_bounds(&w->frame, image, all, 8, &box) &&
         !(w->option[PYRAMID] == ON &&
           is_rectangle_hidden(w, box, image->nearest, &visible));
}

static bool is_any_side_visible(struct walk *w,
                                const struct hsr_placing *placing,
                                const struct hsr_octree_box *cube,
                                const struct hsr_cube_image *image,
                                struct hsr_subject subject) {
  for (int side = 0; side < 6; side++)
    if (image->front >> side & 1 &&
        is_side_visible(w, placing, cube, image, side, subject))
      return true;
  return false;
}

static double seconds_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* What a machine answers: whether a sample of the cube's front sides is
 * visible, as the z-buffer is now. In the build that is timed, it takes the
 * time that the option says, or longer if the sides take longer. */
static bool ask(struct walk *w, const struct hsr_placing *placing,
                const struct hsr_octree_box *cube,
                const struct hsr_cube_image *image,
                struct hsr_subject subject) {
  double begin = w->option[LATENCY] && !HSR_COUNTING ? seconds_now() : 0;
  bool visible = is_any_side_visible(w, placing, cube, image, subject);
  HSR_STEP(w->tally, QUERIES, subject, HSR_NOTHING, HSR_NOWHERE, visible);
  while (w->option[LATENCY] && !HSR_COUNTING &&
         seconds_now() - begin < 1e-6 * (double)w->option[LATENCY])
    ;
  return visible;
}

/* *inside: the cube is all inside of the frustum, and so are the cubes in it. */
static bool is_in_frustum(struct walk *w, const struct hsr_placing *placing,
                          const struct hsr_octree_box *cube,
                          struct hsr_subject subject, bool *inside) {
  HSR_STEP(w->tally, NODES, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  if (*inside)
    return true;
  enum hsr_box_verdict verdict =
      hsr_cube_classify(&w->frame, placing, cube, INEQUALITIES, subject);
  *inside = verdict == HSR_BOX_IN;
  if (verdict == HSR_BOX_OUT)
    HSR_STEP(w->tally, OUT, subject, HSR_THE_WINDOW, HSR_NOWHERE, 0);
  return verdict != HSR_BOX_OUT;
}

/* cube_visible of the thesis. n_faces: as many are in the cube. */
static bool is_box_visible(struct walk *w, const struct hsr_placing *placing,
                           struct hsr_octree_box cube, uint64_t n_faces,
                           struct hsr_subject subject, bool *inside) {
  if (!is_in_frustum(w, placing, &cube, subject, inside))
    return false;
  struct hsr_cube_image image;
  bool asks = w->option[PYRAMID] == BY_QUERIES;
  if (asks && n_faces < (uint64_t)w->option[THRESHOLD])
    return true;
  if (!hsr_cube_project(&w->frame, placing, &cube, &image))
    return true; /* the eye may be inside, or the near plane meet it */
  read_for(w, CUBE_READS, subject);
  bool visible = asks ? ask(w, placing, &cube, &image, subject)
                 : w->option[CUBES] == WHOLE
                     ? is_whole_visible(w, &image)
                     : is_any_side_visible(w, placing, &cube, &image, subject);
  HSR_STEP(w->tally, CUBES_TESTED, subject, HSR_NOTHING, HSR_NOWHERE, visible);
  if (!visible)
    HSR_STEP(w->tally, CUBES_CULLED, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  return visible;
}

static bool is_cube_visible(struct walk *w, const struct hsr_placing *placing,
                            const struct hsr_octree_node *node,
                            uint64_t n_faces, struct hsr_subject subject,
                            bool *inside) {
  return is_box_visible(w, placing,
                        w->option[VOLUMES] == TIGHT ? node->tight
                                                    : hsr_octree_cube(node),
                        n_faces, subject, inside);
}

/* Are octants projected and tested together? Not in the counting build, which
 * counts what the paper's steps read; nor where a test needs more than an
 * octant's rectangles. */
static bool tests_together(const struct walk *w) {
  return !HSR_COUNTING && w->option[PYRAMID] == ON &&
         w->option[CUBES] != SIDES && !w->option[NEAR] &&
         !w->frame.job->view->parallel;
}

/* is_box_visible of an octant, with the same answer. What hides the whole hides
 * each of its sides. */
static bool is_octant_visible(struct walk *w, const struct hsr_octants *octants,
                              int o, const struct hsr_octree_node *node,
                              struct hsr_subject subject, bool *inside) {
  struct hsr_octree_box cube =
      w->option[VOLUMES] == TIGHT ? node->tight : hsr_octree_cube(node);
  if (!is_in_frustum(w, &w->frame.placing, &cube, subject, inside))
    return false;
  if (!octants->has_image[o])
    return true;
  struct hsr_bounds box;
  if (!hsr_octant_bounds(octants, HSR_WHOLE_CUBE, o, &box) ||
      hsr_pyramid_hides(&w->pyramid, box, octants->q[HSR_WHOLE_CUBE][o]))
    return false;
  if (w->option[CUBES] == WHOLE)
    return true;
  for (int side = 0; side < 6; side++)
    if (octants->front[o] >> side & 1 &&
        hsr_octant_bounds(octants, side, o, &box) &&
        !hsr_pyramid_hides(&w->pyramid, box, octants->q[side][o]))
      return true;
  return false;
}

/* How many faces are in a cube of the object at hand, or of the octree of
 * instances, if z-queries need it. */
static uint64_t faces_in(const struct walk *w, uint32_t k) {
  const struct prepared *prepared = w->frame.job->prepared;
  const struct hsr_lazy_octree *lazy = w->frame.object->lazy;
  uint32_t object = w->frame.cubes->scene->instances[w->frame.instance].object;
  if (lazy)
    return hsr_lazy_node(lazy, k)->n;
  return prepared->in_object ? prepared->in_object[object][k] : 0;
}

/* What was handed down to a cube of instances. */
static uint64_t faces_handed_down(const struct hsr_cubes *cubes, uint32_t k) {
  const struct hsr_lazy_node *node = hsr_lazy_node(cubes->lazy, k);
  uint64_t n = 0;
  for (uint32_t i = 0; i < node->n; i++) {
    uint32_t still = cubes->still[cubes->octree.item[node->first + i]];
    n += cubes->scene->objects[cubes->scene->instances[still].object].n_faces;
  }
  return n;
}

static uint64_t faces_below(const struct walk *w, uint32_t k) {
  const struct prepared *prepared = w->frame.job->prepared;
  if (w->option[PYRAMID] == BY_QUERIES && w->frame.cubes->lazy)
    return faces_handed_down(w->frame.cubes, k);
  return prepared->below ? prepared->below[k] : 0;
}

/* --- Tiling what is in a cube --------------------------------------------- */

/* What a face of a tiler's world is called. */
static uint32_t name_of(const struct hsr_tiler *t, uint32_t f) {
  return t->id ? t->first_id + t->id[f] : f;
}

/* The box of the k-th of a batch's triangles. */
static struct hsr_bounds box_of(const struct hsr_corners *r, int k) {
  struct hsr_bounds box = {r->x0[k], r->y0[k], r->x1[k], r->y1[k]};
  return box;
}

static struct hsr_window window_of(struct hsr_bounds box) {
  return hsr_window_make(box.x0, box.y0, box.x1, box.y1);
}

/* Was the face met before in this visit? */
static bool is_repeated(struct walk *w, uint32_t f) {
  uint32_t *tiled = &w->tiled[w->frame.tiler.id[f]];
  if (*tiled != w->visit) {
    *tiled = w->visit;
    return false;
  }
  HSR_STEP(w->tally, REPEATED, HSR_FACE(name_of(&w->frame.tiler, f)),
           HSR_NOTHING, HSR_NOWHERE, 0);
  return true;
}

/* Drops the faces that go the general way and were met before. */
static void drop_repeated(struct walk *w, struct hsr_batch *b) {
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY && is_repeated(w, b->first + (uint32_t)k))
      b->fate[k] = HSR_DROP;
}

/* Which of the triangles to be tiled are hidden. */
static void find_hidden(struct walk *w, const struct hsr_batch *b,
                        int *hidden) {
  const struct hsr_corners *r = &b->corners;
  if (w->option[POLYGONS] != BASIC) {
    hsr_pyramid_hides_triangles(&w->pyramid, b->n_fast, r, hidden);
    return;
  }
  for (int k = 0; k < b->n_fast; k++) {
    read_for(w, FACE_READS, HSR_FACE(r->id[k]));
    hidden[k] =
        hsr_pyramid_basic(&w->pyramid, box_of(r, k), hsr_nearest_corner(r, k));
  }
}

static void count_tested(const struct walk *w, const struct hsr_corners *r,
                         int k, bool hidden) {
  HSR_STEP(w->tally, FACES_TESTED, HSR_FACE(r->id[k]), HSR_THE_WINDOW,
           window_of(box_of(r, k)), !hidden);
  if (hidden)
    HSR_STEP(w->tally, FACES_CULLED, HSR_FACE(r->id[k]), HSR_THE_WINDOW,
             window_of(box_of(r, k)), 0);
}

/* Leaves out of a batch what was met before, and what is hidden. */
static void filter(struct walk *w, struct hsr_batch *b) {
  int drop[HSR_BATCH];
  for (int k = 0; k < b->n_fast; k++)
    drop[k] = is_repeated(w, b->first + (uint32_t)b->place[k]);
  hsr_tiler_drop(b, drop);
  if (w->option[PYRAMID] != ON || w->option[POLYGONS] == NONE || w->plain)
    return;
  read_for(w, FACE_READS, HSR_NOTHING);
  find_hidden(w, b, drop);
  for (int k = 0; HSR_COUNTING && k < b->n_fast; k++)
    count_tested(w, &b->corners, k, drop[k]);
  hsr_tiler_drop(b, drop);
}

/* Brings the pyramid up to date, before anything is tested. */
static void refresh(struct walk *w) {
  if (w->stale.x0 < w->stale.x1)
    hsr_pyramid_update(&w->pyramid, w->stale);
  w->stale = (struct hsr_bounds){0, 0, 0, 0};
}

static long area_of_box(const struct hsr_bounds *b) {
  return (long)(b->x1 - b->x0) * (b->y1 - b->y0);
}

static int lesser(int a, int b) {
  return a < b ? a : b;
}
static int greater(int a, int b) {
  return a > b ? a : b;
}

/* Something was tiled in a box. Boxes that one box holds without more samples
 * are brought up to date together. */
static void make_stale(struct walk *w, struct hsr_bounds box) {
  const struct hsr_bounds *s = &w->stale;
  struct hsr_bounds both = {lesser(s->x0, box.x0), lesser(s->y0, box.y0),
                            greater(s->x1, box.x1), greater(s->y1, box.y1)};
  if (area_of_box(&both) > area_of_box(s) + area_of_box(&box)) {
    refresh(w);
    both = box;
  }
  w->stale = both;
}

/* A face that is placed on the tiler's screen. */
static void tile_face(struct walk *w, struct hsr_tiler *t, uint32_t f) {
  HSR_STEP(w->tally, FACES_TILED, HSR_FACE(name_of(t, f)), HSR_THE_WINDOW,
           window_of(t->screen.bounds[f]), 0);
  hsr_tiler_tile_generally(t, f);
  if (w->option[PYRAMID] == ON && !w->plain)
    make_stale(w, t->screen.bounds[f]);
}

static void tile_generally(struct walk *w, uint32_t f) {
  if (hsr_tiler_place(&w->frame.tiler, f))
    tile_face(w, &w->frame.tiler, f);
}

/* The definitive test, of those that are set up and that the fast one left. */
static void filter_definitively(struct walk *w, struct hsr_batch *b) {
  for (int k = 0; k < b->n_fast; k++) {
    struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, k);
    struct hsr_subject face = HSR_FACE(b->corners.id[k]);
    read_for(w, FACE_READS, face);
    if (b->good[k] &&
        hsr_pyramid_hides_triangle(&w->pyramid, &w->frame.tiler, &triangle)) {
      HSR_STEP(w->tally, FACES_CULLED, face, HSR_THE_WINDOW,
               window_of(box_of(&b->corners, k)), 0);
      b->good[k] = 0;
    }
  }
}

/* Those that are nearer than anything where they are, by the pyramid of the
 * nearest: their depths need not be compared. */
static void tile_before_all(struct walk *w, struct hsr_batch *b) {
  const struct hsr_corners *r = &b->corners;
  for (int k = 0; k < b->n_fast; k++) {
    struct hsr_bounds box = box_of(r, k);
    struct hsr_subject face = HSR_FACE(r->id[k]);
    read_for(w, FACE_READS, face);
    float q = r->qa[k] < r->qb[k] ? r->qa[k] : r->qb[k];
    q = r->qc[k] < q ? r->qc[k] : q;
    if (!b->good[k] || !hsr_pyramid_before(&w->pyramid, box, q))
      continue;
    struct hsr_triangle triangle = hsr_tiler_take(&w->frame.tiler, b, k);
    hsr_tiler_tile_before(&w->frame.tiler, &triangle);
    hsr_pyramid_update(&w->pyramid, box);
    HSR_STEP(w->tally, FACES_TILED, face, HSR_THE_WINDOW, window_of(box), 0);
    HSR_STEP(w->tally, FACES_BEFORE, face, HSR_THE_WINDOW, window_of(box), 0);
    b->good[k] = 0;
  }
}

static void tile_batch(struct walk *w, struct hsr_batch *b) {
  const struct hsr_corners *r = &b->corners;
  bool tests = w->option[PYRAMID] == ON && !w->plain;
  if (tests && w->option[POLYGONS] == DEFINITIVE)
    filter_definitively(w, b);
  touch_for(w, WORK_POLYGONS);
  if (tests && w->option[NEAR])
    tile_before_all(w, b);
  hsr_tiler_tile_batch(&w->frame.tiler, b);
  for (int k = 0; k < b->n_fast; k++) {
    if (!b->good[k])
      continue;
    HSR_STEP(w->tally, FACES_TILED, HSR_FACE(r->id[k]), HSR_THE_WINDOW,
             window_of(box_of(r, k)), 0);
    if (tests)
      make_stale(w, box_of(r, k));
  }
  for (int k = 0; k < b->n && b->general; k++)
    if (b->fate[k] == HSR_GENERALLY)
      tile_generally(w, b->first + (uint32_t)k);
  refresh(w);
}

/* The faces of a cell of the object at hand. */
static void tile_cell(struct walk *w, uint32_t place) {
  if (!w->frame.object->cell[place].n_faces)
    return;
  const struct hsr_cell *cell = hsr_cube_cell(&w->frame, place);
  struct hsr_tiler *t = &w->frame.tiler;
  uint32_t n = t->on_grid ? cell->n_triangles : 0;
  struct hsr_batch batch;
  struct hsr_subject cube = hsr_cube_subject(w->frame.instance, place);
  for (uint32_t f = 0; HSR_COUNTING && f < cell->n_faces; f++)
    HSR_STEP(w->tally, FACES, HSR_FACE(name_of(t, f)), cube, HSR_NOWHERE, 0);
  for (uint32_t f = 0; f < n; f += HSR_BATCH) {
    hsr_tiler_look(t, &batch, f, n - f < HSR_BATCH ? (int)(n - f) : HSR_BATCH);
    drop_repeated(w, &batch);
    filter(w, &batch);
    hsr_tiler_set_up(t, &batch);
    tile_batch(w, &batch);
  }
  touch_for(w, WORK_POLYGONS);
  for (uint32_t f = n; f < cell->n_faces; f++)
    if (!is_repeated(w, f))
      tile_generally(w, f);
  refresh(w);
}

/* --- The octrees, from front to back -------------------------------------- */

/* Lists a cube of the object at hand as visible. */
static void list_cube(struct walk *w, uint32_t k) {
  if (!hsr_cube_list_add(w->next, w->frame.instance, k))
    w->out_of_memory = true;
}

/* Divides a cube of the object at hand, if that has been left until now. */
static void divide_cube(struct walk *w, uint32_t k) {
  struct prepared *prepared = w->frame.job->prepared;
  const struct hsr_cubes_object *object = w->frame.object;
  uint32_t i = w->frame.instance,
           o = w->frame.cubes->scene->instances[i].object;
  enum hsr_status status = HSR_OK;
  if (!hsr_cubes_divide(&prepared->cubes, o, k, &status))
    return;
  w->out_of_memory |= prepared->half_divided = status;
  HSR_STEP(w->tally, DIVIDED, hsr_cube_subject(i, k), HSR_NOTHING, HSR_NOWHERE,
           0);
  uint32_t first = w->frame.job->world->outline.first[i];
  for (int c = 0; HSR_COUNTING && c < 8; c++) {
    uint32_t child = object->octree.node[k].child[c];
    for (uint32_t n = 0;
         child != HSR_NO_NODE && n < object->octree.node[child].n; n++) {
      uint32_t item = object->octree.item[object->octree.node[child].first + n];
      HSR_STEP(w->tally, FACES_DOWN, HSR_FACE(first + object->number[item]),
               hsr_cube_subject(i, child), HSR_NOWHERE, 0);
    }
  }
}

/* The same of a cube of instances. */
static void divide_instances(struct walk *w, uint32_t k) {
  struct prepared *prepared = w->frame.job->prepared;
  const struct hsr_cubes *cubes = &prepared->cubes;
  enum hsr_status status = HSR_OK;
  if (!hsr_cubes_divide_instances(&prepared->cubes, k, &status))
    return;
  w->out_of_memory |= prepared->half_divided = status;
  HSR_STEP(w->tally, DIVIDED, hsr_cube_subject(HSR_NO_ID, k), HSR_NOTHING,
           HSR_NOWHERE, 0);
  for (int c = 0; HSR_COUNTING && c < 8; c++) {
    uint32_t child = cubes->octree.node[k].child[c];
    for (uint32_t n = 0;
         child != HSR_NO_NODE && n < cubes->octree.node[child].n; n++) {
      uint32_t item = cubes->octree.item[cubes->octree.node[child].first + n];
      HSR_STEP(w->tally, STILL_DOWN, HSR_VOLUME(cubes->still[item]),
               hsr_cube_subject(HSR_NO_ID, child), HSR_NOWHERE, 0);
    }
  }
}

static bool is_leaf(const struct hsr_octree_node *node) {
  static const uint32_t none[8] = {HSR_NO_NODE, HSR_NO_NODE, HSR_NO_NODE,
                                   HSR_NO_NODE, HSR_NO_NODE, HSR_NO_NODE,
                                   HSR_NO_NODE, HSR_NO_NODE};
  return !memcmp(node->child, none, sizeof none);
}

static void render_octants(struct walk *w, const struct hsr_octree_node *node,
                           bool inside);

/* A cube of the object at hand. One on the list of 1993 is not tested before
 * the list is pruned. It may be octant o of those that are projected. */
static void render_cube(struct walk *w, uint32_t k, bool inside,
                        const struct hsr_octants *octants, int o) {
  const struct hsr_octree *octree = &w->frame.object->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  bool rendered =
      w->last && hsr_cube_is_marked(&w->rendered, w->frame.instance, k);
  struct hsr_subject subject = hsr_cube_subject(w->frame.instance, k);
  if (!(rendered && w->option[COHERENCE] == LIST) &&
      !(octants ? is_octant_visible(w, octants, o, node, subject, &inside)
                : is_cube_visible(w, &w->frame.placing, node, faces_in(w, k),
                                  subject, &inside)))
    return;
  HSR_STEP(w->tally, CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  if (w->next)
    list_cube(w, k);
  divide_cube(w, k);
  if (w->out_of_memory)
    return;
  if (!rendered)
    tile_cell(w, k);
  node = &octree->node[k]; /* dividing may have moved it */
  if (!is_leaf(node))
    render_octants(w, node, inside);
}

static void render_octants(struct walk *w, const struct hsr_octree_node *node,
                           bool inside) {
  const struct hsr_octree *octree = &w->frame.object->octree;
  struct hsr_octants octants;
  bool together = tests_together(w);
  if (together)
    hsr_octants_project(&w->frame, &w->frame.placing, octree, node,
                        w->option[VOLUMES] == TIGHT, &octants);
  int nearest = hsr_cube_nearest(&w->frame.placing, node);
  uint32_t child[8];
  memcpy(child, node->child, sizeof child); /* dividing may move the node */
  for (int k = 0; k < 8; k++) {
    int o = nearest ^ hsr_octant_order[k];
    if (child[o] != HSR_NO_NODE)
      render_cube(w, child[o], inside, together ? &octants : NULL, o);
  }
}

/* Its faces that have been rendered in this frame count as met. */
static void take_in_hand(struct walk *w, uint32_t instance) {
  hsr_cube_instance(&w->frame, instance);
  w->visit++;
  const struct hsr_listed_instance *group =
      w->rendered.list ? hsr_cube_marks_group(&w->rendered, instance) : NULL;
  for (uint32_t k = 0; group && k < group->n; k++) {
    const struct hsr_cubes_object *object = w->frame.object;
    const struct hsr_cell *cell =
        &object->cell[hsr_cube_list_cubes(w->last, group)[k]];
    for (uint32_t f = 0; f < cell->n_faces; f++)
      w->tiled[object->face[cell->first_face + f]] = w->visit;
  }
}

/* Once a frame. The instance may reach out of the cube in which it is met. */
static void render_instance(struct walk *w, uint32_t i) {
  if (!hsr_cube_is_new(&w->frame, i))
    return;
  take_in_hand(w, i);
  render_cube(w, 0, false, NULL, 0);
}

static void render_mover(struct walk *w, uint32_t i) {
  HSR_STEP(w->tally, MOVERS_MET, HSR_VOLUME(i), HSR_NOTHING, HSR_NOWHERE, 0);
  render_instance(w, i);
}

/* The movers of a cube. Those that fit into octants are moved there first, if
 * that has not been done yet. */
static bool render_movers(struct walk *w, uint32_t node,
                          const struct hsr_octree_node *cube) {
  if (!hsr_movers_divide(&w->movers, node, cube)) {
    w->out_of_memory = true;
    return false;
  }
  for (uint32_t k = hsr_mover_node(&w->movers, node)->first; k != HSR_NO_MOVER;
       k = w->movers.mover[k].next)
    render_mover(w, w->movers.mover[k].instance);
  return true;
}

/* Whether the octree of what moves is kept from frame to frame. */
static bool keeps_movers(const struct walk *w) {
  long how = w->option[MOVERS];
  return how == KEPT || how == BY_SPEED || how == BY_VOLUME;
}

/* A cube of instances, both octrees at once: node `still` of those that do not
 * move, node `moving` of those that do, or HSR_NO_NODE. */
static void render_instances(struct walk *w, const struct hsr_octree_node *cube,
                             uint32_t still, uint32_t moving, bool inside) {
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  const struct hsr_octree_node *node =
      still != HSR_NO_NODE ? &octree->node[still] : NULL;
  bool single = moving == HSR_NO_NODE && node && node->n == 1 && is_leaf(node);
  if (!single) {
    struct hsr_subject subject =
        node ? hsr_cube_subject(HSR_NO_ID, still) : HSR_MOVERS_CUBE(moving);
    if (!is_cube_visible(
            w, &w->frame.as_it_is, moving == HSR_NO_NODE ? node : cube,
            moving == HSR_NO_NODE ? faces_below(w, still) : UINT64_MAX, subject,
            &inside))
      return;
    HSR_STEP(w->tally, CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  }
  if (node && !single) {
    divide_instances(w, still);
    if (w->out_of_memory)
      return;
    node = &octree->node[still]; /* dividing may have moved it */
  }
  const uint32_t *name = w->frame.cubes->still;
  for (uint32_t i = 0; node && i < node->n; i++) {
    uint32_t item = octree->item[node->first + i];
    render_instance(w, name ? name[item] : item);
  }
  if (moving != HSR_NO_NODE && !render_movers(w, moving, cube))
    return;
  int nearest = hsr_cube_nearest(&w->frame.as_it_is, cube);
  for (int k = 0; k < 8; k++) {
    int o = nearest ^ hsr_octant_order[k];
    uint32_t child = node ? node->child[o] : HSR_NO_NODE;
    uint32_t mover = moving != HSR_NO_NODE
                         ? hsr_mover_node(&w->movers, moving)->child[o]
                         : HSR_NO_NODE;
    if (mover != HSR_NO_NODE && keeps_movers(w) &&
        hsr_mover_is_empty(&w->movers, mover))
      mover = HSR_NO_NODE;
    if (child == HSR_NO_NODE && mover == HSR_NO_NODE)
      continue;
    struct hsr_octree_node octant = hsr_octree_octant(cube, o);
    render_instances(w, &octant, child, mover, inside);
  }
}

/* The movers' octree of the last frame, brought up to date; *w borrows it. */
static enum hsr_status keep_movers(struct walk *w) {
  static const enum hsr_mover_knowledge knowledge[] = {
      [BY_SPEED] = HSR_MOVERS_KNOW_SPEED, [BY_VOLUME] = HSR_MOVERS_KNOW_VOLUME};
  struct prepared *prepared = w->frame.job->prepared;
  prepared->movers.knowledge = knowledge[w->option[MOVERS]];
  prepared->movers.every = w->option[INTERVAL];
  enum hsr_status status =
      hsr_movers_update(&prepared->movers, w->frame.cubes, w->tally, MOVED,
                        LOOKED, &prepared->movers_arena);
  if (status) {
    hsr_arena_free(&prepared->movers_arena);
    prepared->movers = (struct hsr_movers){.n = 0};
  }
  w->movers = prepared->movers;
  return status;
}

/* --- Clusters in space-time ----------------------------------------------- */

/* What rounding may take off is added. */
static struct hsr_octree_box by_its_middle(const struct hsr_box *box) {
  struct hsr_octree_box made;
  for (int a = 0; a < 3; a++) {
    made.centre[a] = 0.5 * (box->lo[a] + box->hi[a]);
    made.half[a] = 0.5 * (box->hi[a] - box->lo[a]) +
                   0x1p-50 * (fabs(box->lo[a]) + fabs(box->hi[a]));
  }
  return made;
}

/* A box outside of the root's cube, where too little is known of rounding on
 * the screen, counts as visible. */
static void render_cluster(struct walk *w, uint32_t k) {
  struct hsr_space_time *clusters =
      &((struct prepared *)w->frame.job->prepared)->clusters;
  const struct hsr_cluster *c = hsr_cluster_at(clusters, k);
  struct hsr_box root = hsr_cube_box(&w->frame.cubes->octree.node[0]);
  bool inside = false;
  uint32_t part[2];
  if (!c->n || (hsr_box_holds(&root, &c->box) &&
                !is_box_visible(w, &w->frame.as_it_is, by_its_middle(&c->box),
                                UINT64_MAX, HSR_MOVERS_CUBE(k), &inside)))
    return;
  if (c->n == 1) {
    render_mover(w, hsr_member_at(clusters, c->first)->instance);
    return;
  }
  int n = hsr_space_time_divide(clusters, k, part);
  w->out_of_memory |= !n;
  for (int p = 0; p < n; p++)
    render_cluster(w, part[p]);
}

static enum hsr_status render_clusters(struct walk *w) {
  struct prepared *prepared = w->frame.job->prepared;
  struct hsr_space_time *clusters = &prepared->clusters;
  const struct hsr_space_time_count count = {.tally = w->tally,
                                             .bounded = BOUNDED,
                                             .in_space = SPLITS,
                                             .in_time = IN_TIME,
                                             .moved = MOVED};
  if (hsr_space_time_begin(clusters, w->frame.cubes, w->option[INTERVAL],
                           &count, &prepared->movers_arena))
    w->out_of_memory = true;
  else
    render_cluster(w, 0);
  for (uint32_t k = 0; k < clusters->n_loose && !w->out_of_memory; k++)
    render_mover(w, clusters->loose[k]);
  if (w->out_of_memory) {
    hsr_arena_free(&prepared->movers_arena);
    *clusters = (struct hsr_space_time){.n_loose = 0};
    return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* --- All octrees ---------------------------------------------------------- */

/* What moves is in w->movers, but for clusters. */
static enum hsr_status make_movers(struct walk *w,
                                   const struct hsr_octree_node *root) {
  long how = w->option[MOVERS];
  w->movers = (struct hsr_movers){.outside = HSR_NO_MOVER};
  if (how == SPACE_TIME)
    return HSR_OK;
  if (keeps_movers(w))
    return keep_movers(w);
  if (hsr_movers_init(&w->movers, w->frame.cubes, w->tally, MOVED, SPLITS,
                      w->frame.job->scratch) ||
      (how == FRESH && !hsr_movers_divide_all(&w->movers, 0, root)))
    return HSR_E_NOMEM;
  return HSR_OK;
}

/* The octrees from front to back; what moves is among them, or behind them, as
 * the option says. */
static enum hsr_status render_octrees(struct walk *w) {
  struct hsr_octree_node root = w->frame.cubes->octree.node[0];
  struct hsr_movers *movers = &w->movers;
  long how = w->option[MOVERS];
  root.tight = hsr_octree_cube(&root); /* what moves may be all over it */
  if (make_movers(w, &root))
    return HSR_E_NOMEM;
  bool together = movers->n && how != BEHIND;
  render_instances(w, &root, 0, together ? 0 : HSR_NO_NODE, false);
  if (how == SPACE_TIME && render_clusters(w))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < movers->n && how == BEHIND; k++)
    render_mover(w, movers->mover[k].instance);
  for (uint32_t k = movers->outside; k != HSR_NO_MOVER;
       k = movers->mover[k].next)
    render_mover(w, movers->mover[k].instance);
  return HSR_OK;
}

/* Without cubes: cell after cell, as they come. */
static void render_all(struct walk *w) {
  for (uint32_t i = 0; i < w->frame.cubes->scene->n_instances; i++) {
    take_in_hand(w, i);
    for (uint32_t k = 0; k < w->frame.object->octree.n_nodes; k++)
      tile_cell(w, k);
  }
}

/* --- Temporal coherence --------------------------------------------------- */

/* The cubes that were visible in the last frame, into the plain z-buffer; then
 * the pyramid is built. */
static enum hsr_status render_last(struct walk *w) {
  const struct hsr_cubes *cubes = w->frame.cubes;
  const struct hsr_window *window = &w->frame.job->view->window;
  w->plain = true;
  for (size_t g = 0; g < w->last->group.n; g++) {
    const struct hsr_listed_instance *group = hsr_cube_list_group(w->last, g);
    const uint32_t *cube = hsr_cube_list_cubes(w->last, group);
    take_in_hand(w, group->instance);
    for (uint32_t k = 0; k < group->n; k++) {
      HSR_STEP(w->tally, CUBES_AGAIN,
               hsr_cube_subject(group->instance, cube[k]), HSR_NOTHING,
               HSR_NOWHERE, 0);
      tile_cell(w, cube[k]);
    }
  }
  w->plain = false;
  hsr_pyramid_update(&w->pyramid, (struct hsr_bounds){window->x0, window->y0,
                                                      window->x1, window->y1});
  return hsr_cube_marks_init(&w->rendered, w->last, cubes,
                             w->frame.job->scratch);
}

/* 1993: the listed cubes stay unless the finished pyramid hides them. */
static void prune(struct walk *w) {
  struct hsr_cube_list *kept = w->last;
  const struct hsr_cube_list *all = w->next;
  w->rendered.list = NULL;
  hsr_cube_list_clear(kept);
  for (size_t g = 0; g < all->group.n; g++) {
    const struct hsr_listed_instance *group = hsr_cube_list_group(all, g);
    const uint32_t *cube = hsr_cube_list_cubes(all, group);
    take_in_hand(w, group->instance);
    for (uint32_t k = 0; k < group->n; k++) {
      bool inside = false;
      if (is_cube_visible(
              w, &w->frame.placing, &w->frame.object->octree.node[cube[k]],
              faces_in(w, cube[k]), hsr_cube_subject(group->instance, cube[k]),
              &inside) &&
          !hsr_cube_list_add(kept, group->instance, cube[k]))
        w->out_of_memory = true;
    }
  }
}

static enum hsr_status render_loose(struct walk *w) {
  struct hsr_tiler t;
  if (hsr_cube_loose(&w->frame, &t))
    return HSR_E_NOMEM;
  touch_for(w, WORK_POLYGONS);
  for (uint32_t k = 0; k < t.screen.n_relevant; k++)
    tile_face(w, &t, t.screen.relevant[k]);
  refresh(w);
  return HSR_OK;
}

/* --- A frame -------------------------------------------------------------- */

static enum hsr_status begin(struct walk *w, const struct hsr_job *job) {
  struct prepared *prepared = job->prepared;
  const struct hsr_cubes *cubes = &prepared->cubes;
  struct hsr_arena *arena = job->scratch;
  struct hsr_tiler *t = &w->frame.tiler;
  const struct hsr_window *window = &job->view->window;
  w->option = job->option;
  w->tally = job->tally;
  w->work = job->tally->work;
  if (w->option[COHERENCE]) {
    w->last = &prepared->list[prepared->last];
    w->next = &prepared->list[prepared->last ^ 1];
    hsr_cube_list_clear(w->next);
  }
  w->tiled = HSR_NEW_ZEROED(arena, uint32_t, cubes->most_object_faces);
  if (!w->tiled || hsr_cube_frame_begin(&w->frame, job, cubes) ||
      hsr_pyramid_init(&w->pyramid, window, job->option[NEAR], &t->z_stride,
                       arena))
    return HSR_E_NOMEM;
  touch_for(w, WORK_PYRAMID);
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

/* The list for the next frame; none, rather than half of one. */
static void end_coherence(struct walk *w) {
  struct prepared *prepared = w->frame.job->prepared;
  if (w->option[COHERENCE] == LIST)
    prune(w);
  else
    prepared->last ^= 1;
  if (w->out_of_memory)
    hsr_cube_list_clear(&prepared->list[prepared->last]);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct walk w = {.visit = 0};
  const struct prepared *prepared = job->prepared;
  if (prepared->half_divided || begin(&w, job))
    return hsr_fail_nomem(err);
  if (render_loose(&w))
    return hsr_fail_nomem(err);
  if (w.last && render_last(&w))
    return hsr_fail_nomem(err);
  if (!w.option[OCTREE])
    render_all(&w);
  else if (render_octrees(&w))
    return hsr_fail_nomem(err);
  if (w.last)
    end_coherence(&w);
  job->tally->work = w.work;
  return w.out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

/* Children come after their parents. */
static uint32_t *count_in_object(const struct hsr_cubes_object *object,
                                 struct hsr_arena *arena) {
  uint32_t n = object->octree.n_nodes;
  uint32_t *in = HSR_NEW(arena, uint32_t, n);
  for (uint32_t k = n; in && k-- > 0;) {
    in[k] = object->cell[k].n_faces;
    for (int o = 0; o < 8; o++) {
      uint32_t child = object->octree.node[k].child[o];
      in[k] += child == HSR_NO_NODE ? 0 : in[child];
    }
  }
  return in;
}

/* An instance that is in several cubes counts in each. */
static enum hsr_status count_faces(struct prepared *made) {
  const struct hsr_cubes *cubes = &made->cubes;
  const struct hsr_scene *scene = cubes->scene;
  const struct hsr_octree *octree = &cubes->octree;
  struct hsr_arena *arena = &made->arena;
  made->in_object = HSR_NEW(arena, uint32_t *, scene->n_objects);
  made->below = HSR_NEW(arena, uint64_t, octree->n_nodes);
  if (!made->in_object || !made->below)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < scene->n_objects; k++)
    if (!(made->in_object[k] = count_in_object(&cubes->object[k], arena)))
      return HSR_E_NOMEM;
  for (uint32_t k = octree->n_nodes; k-- > 0;) {
    const struct hsr_octree_node *node = &octree->node[k];
    made->below[k] = 0;
    for (uint32_t i = 0; i < node->n; i++) {
      uint32_t instance = octree->item[node->first + i];
      made->below[k] += made->in_object[scene->instances[instance].object][0];
    }
    for (int o = 0; o < 8; o++)
      if (node->child[o] != HSR_NO_NODE)
        made->below[k] += made->below[node->child[o]];
  }
  return HSR_OK;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct prepared *made = calloc(1, sizeof *made);
  *prepared = made;
  if (!made)
    return hsr_fail_nomem(err);
  struct hsr_octree_rule rule = {
      .small = option[PLACEMENT] == PUSHED ? 1.0 / (double)option[SMALL] : 0,
      .most = (uint32_t)option[LEAST],
      .least = (uint32_t)option[LEAST]};
  if (option[OCTREE] == LAZILY)
    return hsr_cubes_init_lazily(&made->cubes, world, &rule, err);
  enum hsr_status status = hsr_cubes_init(&made->cubes, world, &rule, err);
  if (!status && option[PYRAMID] == BY_QUERIES && count_faces(made))
    return hsr_fail_nomem(err);
  return status;
}

static void release(void *object) {
  struct prepared *prepared = object;
  hsr_cubes_free(&prepared->cubes);
  hsr_arena_free(&prepared->list[0].arena);
  hsr_arena_free(&prepared->list[1].arena);
  hsr_arena_free(&prepared->arena);
  hsr_arena_free(&prepared->movers_arena);
  free(prepared);
}

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
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release};
