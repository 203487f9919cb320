/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Weiler-Atherton algorithm: the picture is divided along the borders of
 * polygons, until each part shows one of them.
 *
 * Source      K. Weiler and P. Atherton, "Hidden surface removal using polygon
 *             area sorting", SIGGRAPH 1977, 214-222, as described by Greene
 *             1995, "The Weiler-Atherton Algorithm", pp. 10-11.
 * Notation    polygon -> struct hsr_area, of a face or of a part of it; clip
 *             polygon -> `clip`; inside list, outside list -> `inside`,
 *             `outside`
 * Invariants  the polygons of a list are in the rough order in which their
 *             faces were sorted, but that a clip polygon which has others
 *             before it is the last of the list inside it. Of any two lists
 *             that are still to be done, the polygons of one do not overlap
 *             those of the other.
 * Recursion   the polygons inside a clip polygon that are before it make a list
 *             with the clip polygon at its end. One of them is the next clip
 *             polygon. So along the recursion clip polygons come ever nearer,
 *             and no face is among them twice: cyclic overlap needs no test.
 * Penetration where a polygon inside the clip polygon is partly behind it, it
 * is
 *             divided along the line where their planes meet.
 * Ties        faces on one plane: the lower id is before the other
 * Departures  a polygon is clipped to the picture first, and to what lies
 *             beyond near. The clip polygons of the recursion are the parts
 *             inside the outer clip polygon, not the whole polygons that they
 *             are parts of. A polygon is found outside without clipping if a
 *             line along an edge separates it from the clip polygon.
 * Areas       asked for areas (docs/area-picture.md), the visible polygons are
 *             integrated over each pixel: integrate.h
 * Options     sort=none leaves the first step out, which is not essential. Thin
 *             faces about one vertex may then be divided without end: clips=N
 *             refuses a picture that divides too much.
 * Cost        every polygon is examined once at least, and once more for each
 *             clip polygon that is taken before it and does not remove it. So n
 *             polygons that overlap one another, and do not hide each other
 *             whole, are clipped n^2 / 2 times at least, and their pieces too. */
#include "algorithms/image_space/area/sorting/area_slots.h"
#include "algorithms/image_space/area/sorting/integrate.h"
#include "common/answers/kinds/polygons.h"

#include <float.h>
#include <stdlib.h>

enum {
  SORTED,
  CLIP,
  EXAMINED,
  CLIPPED,
  COMPARED,
  CUT,
  CULLED,
  RECURSION,
  SHOWN,
  PIECES,
  PIXELS
};

enum { SORT, CLIPS }; /* options */
enum { ROUGH, NONE };
static const struct hsr_word orders[] = {
    [ROUGH] = {"rough", "by the nearest vertex", 0},
    [NONE] = {"none", "not at all: the polygons are taken as they come", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [SORT] = {"sort", "how the polygons are sorted first", orders, 0, NONE,
              ROUGH},
    [CLIPS] = {"clips",
               "millions of polygons clipped; a scene that needs more "
               "is refused",
               NULL, 1, 1000, 2},
    {NULL}};

struct state {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_clipper c;
  struct hsr_area_slots slots; /* the lists that are still to be done */
  struct hsr_polygons *polygons;
  struct hsr_polygons shape; /* of the piece that a step is about */
  bool integrates; /* areas are wanted: the polygons are not the answer */
  uint64_t left;   /* polygons that may still be clipped */
  bool refused;
};

/* --- Areas as polygons ---------------------------------------------------- */

static enum hsr_status add_region(const struct state *s, struct hsr_polygons *p,
                                  const struct hsr_area *area) {
  enum hsr_status status = hsr_polygons_add_region(p, area->face);
  for (uint32_t k = 0; k < area->n_cycles && !status; k++) {
    status = hsr_polygons_add_cycle(p);
    for (uint32_t e = area->start[k]; e < area->start[k + 1] && !status; e++) {
      const struct hsr_border_edge *edge = &area->edge[e];
      struct hsr_polygon_side side = {hsr_line_name_of(s->c.lines, edge->line),
                                      {edge->at[0][0], edge->at[0][1]}};
      status = hsr_polygons_add_side(p, &side);
    }
  }
  return status;
}

/* The polygon of an area, for who listens; until the next call. NULL: none, as the
 * polygons are not the answer. */
static const struct hsr_polygons *shape_of(struct state *s,
                                           const struct hsr_area *area) {
  if (s->integrates || !area)
    return NULL;
  hsr_polygons_clear(&s->shape);
  s->shape.world = s->job->world;
  if (add_region(s, &s->shape, area)) {
    s->c.failed = true;
    return NULL;
  }
  return &s->shape;
}

/* A step about a piece, against the clip polygon. */
#define STEP_ON(s, counter, piece, clip, outcome)                              \
  HSR_TOLD((s)->tally, counter, HSR_FACE((piece)->face), clip, HSR_NOWHERE,    \
           outcome, shape_of(s, piece))

/* --- Sorting -------------------------------------------------------------- */

/* A face of a one-sided object exists if the eye is in front of it. */
static bool exists(struct state *s, uint32_t face) {
  int sign = hsr_plane_sign(s->c.lines, face);
  return s->job->world->mesh.one_sided[face] ? sign < 0 : sign != 0;
}

/* The depth of the nearest vertex, but no less than near. */
static double nearest_of(const struct state *s, uint32_t face) {
  const struct hsr_view *view = s->job->view;
  const struct hsr_mesh *mesh = &s->job->world->mesh;
  double nearest = DBL_MAX;
  for (uint32_t k = mesh->start[face]; k < mesh->start[face + 1]; k++) {
    uint32_t v = mesh->vertex[k];
    double at[3] = {mesh->x[v], mesh->y[v], mesh->z[v]}, image[3];
    hsr_view_project(view, at, image);
    nearest = image[2] < nearest ? image[2] : nearest;
  }
  return nearest > view->near ? nearest : view->near;
}

static int by_depth(const void *a, const void *b) {
  const struct hsr_area *p = *(struct hsr_area *const *)a,
                        *q = *(struct hsr_area *const *)b;
  if (p->nearest < q->nearest || p->nearest > q->nearest)
    return p->nearest < q->nearest ? -1 : 1;
  return (p->face > q->face) - (p->face < q->face);
}

/* Puts the areas of all faces into the list, from front to back, or as they
 * come. */
static void sort(struct state *s, struct hsr_area_list *list) {
  struct hsr_area_list all = {NULL, NULL};
  for (uint32_t f = 0; f < s->job->world->n_faces && !s->c.failed; f++)
    if (exists(s, f))
      hsr_areas_of_face(&s->c, s->job->world, s->job->view, f, nearest_of(s, f),
                        &all);
  size_t n = 0;
  for (struct hsr_area *a = all.first; a; a = a->next)
    n++;
  struct hsr_area **order = HSR_NEW(s->job->scratch, struct hsr_area *, n);
  if (!order) {
    s->c.failed = true;
    return;
  }
  for (size_t k = 0; k < n; k++)
    order[k] = hsr_areas_pop(&all);
  if (s->job->option[SORT] == ROUGH)
    qsort(order, n, sizeof *order, by_depth);
  for (size_t k = 0; k < n; k++) {
    STEP_ON(s, SORTED, order[k], HSR_NOTHING, 0);
    hsr_areas_push(list, order[k]);
  }
}

/* --- Displaying ----------------------------------------------------------- */

static void display(struct state *s, struct hsr_area *area) {
  struct hsr_polygons *p = s->polygons;
  if (add_region(s, p, area)) {
    s->c.failed = true;
    return;
  }
  struct hsr_polygons part = *p;
  part.region = &p->region[p->n_regions - 1];
  part.n_regions = 1;
  if (!s->integrates)
    HSR_ACCEPTED(s->tally, SHOWN, HSR_FACE(area->face), HSR_NOTHING,
                 HSR_NOWHERE, &part);
  hsr_area_free(&s->c, area);
}

/* --- Depth ---------------------------------------------------------------- */

enum { BEHIND, BEFORE, BOTH };

/* Where a piece lies of the clip polygon that it is inside of. BOTH: doubles do
 * not tell it at every corner, or it is on both sides. */
static int compare_roughly(struct state *s, const struct hsr_area *piece,
                           const struct hsr_area *clip) {
  int first =
      hsr_nearer_at(s->c.lines, piece->face, clip->face, piece->edge[0].from);
  for (uint32_t k = 1; k < piece->n_edges && first; k++)
    if (hsr_nearer_at(s->c.lines, piece->face, clip->face,
                      piece->edge[k].from) != first)
      return BOTH;
  return first ? first > 0 ? BEFORE : BEHIND : BOTH;
}

/* Where a piece lies of the clip polygon that it is inside of. *line and *sign
 * are set if it is on both sides: it is before where sign times the line's
 * function is positive. */
static int compare_depths(struct state *s, const struct hsr_area *piece,
                          const struct hsr_area *clip, uint32_t *line,
                          int *sign) {
  int roughly = compare_roughly(s, piece, clip);
  *line = HSR_NO_LINE;
  *sign = 0;
  if (roughly != BOTH)
    return roughly;
  bool lower = piece->face < clip->face, before = false, behind = false;
  struct hsr_line_name name = {HSR_LINE_MEETING,
                               lower ? piece->face : clip->face,
                               lower ? clip->face : piece->face};
  *line = hsr_line_number(s->c.lines, name, sign);
  if (*line == HSR_NO_LINE)
    return lower ? BEFORE : BEHIND;
  *sign = lower ? *sign : -*sign;
  for (uint32_t k = 0; k < piece->n_edges && !(before && behind); k++) {
    int side =
        *sign * hsr_crossing_side(s->c.lines, piece->edge[k].from, *line);
    before = before || side > 0;
    behind = behind || side < 0;
  }
  return before && behind ? BOTH : before ? BEFORE : BEHIND;
}

/* Divides a piece where its plane meets that of the clip polygon. */
static void cut(struct state *s, struct hsr_area *piece,
                const struct hsr_area *clip, uint32_t line, int sign,
                struct hsr_area_list *before) {
  struct hsr_area_list behind = {NULL, NULL};
  struct hsr_area *half = hsr_area_of_half(&s->c, line, sign), *part;
  STEP_ON(s, CUT, piece, HSR_FACE(clip->face), 0);
  if (!half || !hsr_areas_clip(&s->c, piece, half, before, &behind)) {
    s->c.faulty = true; /* it has points on both sides */
    return;
  }
  hsr_area_free(&s->c, half);
  while ((part = hsr_areas_pop(&behind))) {
    STEP_ON(s, CULLED, part, HSR_FACE(clip->face), 0);
    hsr_area_free(&s->c, part);
  }
}

/* Culls of the pieces what is behind the clip polygon. */
static void cull(struct state *s, struct hsr_area_list *pieces,
                 const struct hsr_area *clip, struct hsr_area_list *before) {
  struct hsr_area *piece;
  while ((piece = hsr_areas_pop(pieces)) && !s->c.failed && !s->c.faulty) {
    uint32_t line;
    int sign, found = compare_depths(s, piece, clip, &line, &sign);
    STEP_ON(s, COMPARED, piece, HSR_FACE(clip->face), found);
    if (found == BOTH) {
      cut(s, piece, clip, line, sign, before);
    } else if (found == BEFORE) {
      hsr_areas_push(before, piece);
    } else {
      STEP_ON(s, CULLED, piece, HSR_FACE(clip->face), 0);
      hsr_area_free(&s->c, piece);
    }
  }
}

/* --- Area sorting --------------------------------------------------------- */

static void count_pieces(struct state *s, const struct hsr_area_list *list,
                         const struct hsr_area *clip, int outcome) {
  for (const struct hsr_area *a = list->first; a && HSR_COUNTING; a = a->next)
    STEP_ON(s, CLIPPED, a, HSR_FACE(clip->face), outcome);
}

/* Examines a polygon against the clip polygon: what is outside of it goes to
 * the outside list, what is inside and before it to the inside list. */
static void examine(struct state *s, struct hsr_area *polygon,
                    const struct hsr_area *clip, struct hsr_area_list *inside,
                    struct hsr_area_list *outside) {
  uint32_t face = polygon->face;
  const struct hsr_polygons *shape =
      HSR_LISTENED(s->tally) ? shape_of(s, polygon) : NULL;
  struct hsr_area_list in = {NULL, NULL}, out = {NULL, NULL};
  bool apart = face == clip->face || hsr_areas_apart(polygon, clip);
  bool outside_it = apart || hsr_areas_beside(polygon, clip);
  if (!outside_it && !s->left--)
    s->refused = s->c.failed = true;
  bool divided = !outside_it && !s->c.failed &&
                 hsr_areas_clip(&s->c, polygon, clip, &in, &out);
  HSR_TOLD(s->tally, EXAMINED, HSR_FACE(face), HSR_FACE(clip->face),
           HSR_NOWHERE,
           apart     ? 0
           : divided ? 2
                     : 1,
           shape);
  if (!divided) {
    hsr_areas_push(outside, polygon);
    return;
  }
  count_pieces(s, &in, clip, 0);
  count_pieces(s, &out, clip, 1);
  cull(s, &in, clip, inside);
  hsr_areas_join(outside, &out);
}

/* Counts the polygons of a slot, whose boxes are not near the clip polygon's. */
static void count_apart(struct state *s, size_t k,
                        const struct hsr_area *clip) {
  const struct hsr_area_slot *slot = hsr_area_slot(&s->slots, k);
  const struct hsr_area *a = slot->list.first;
  for (; a && HSR_COUNTING; a = a->next)
    STEP_ON(s, EXAMINED, a, HSR_FACE(clip->face), 0);
}

/* Examines the polygons of a slot. Returns whether none is left. */
static bool examine_slot(struct state *s, size_t k, const struct hsr_area *clip,
                         struct hsr_area_list *inside) {
  struct hsr_area_slot *slot = hsr_area_slot(&s->slots, k);
  struct hsr_area_list outside = {NULL, NULL};
  struct hsr_area *polygon;
  while ((polygon = hsr_areas_pop(&slot->list)) && !s->c.failed && !s->c.faulty)
    examine(s, polygon, clip, inside, &outside);
  slot->list = outside;
  hsr_area_slots_box(&s->slots, k);
  return !outside.first;
}

/* Examines all polygons from slot k on; returns how many slots are empty now
 * that were not. */
static size_t examine_all(struct state *s, size_t k,
                          const struct hsr_area *clip,
                          struct hsr_area_list *inside) {
  size_t end = hsr_area_slots_n(&s->slots), n, emptied = 0;
  for (; k < end; k += n) {
    uint8_t near[HSR_SLOTS_AT_ONCE];
    n = end - k < HSR_SLOTS_AT_ONCE ? end - k : HSR_SLOTS_AT_ONCE;
    if (!hsr_area_slots_near(&s->slots, k, n, clip, near) && !HSR_COUNTING)
      continue;
    for (size_t i = 0; i < n; i++)
      if (near[i])
        emptied += examine_slot(s, k + i, clip, inside);
      else
        count_apart(s, k + i, clip);
  }
  return emptied;
}

static void process(struct state *s, struct hsr_area_list *list) {
  size_t first = hsr_area_slots_n(&s->slots), k = first, empty = 0;
  if (!hsr_area_slots_add(&s->slots, s->job->scratch, list))
    s->c.failed = true;
  while (k < hsr_area_slots_n(&s->slots) && !s->c.failed && !s->c.faulty) {
    struct hsr_area_slot *slot = hsr_area_slot(&s->slots, k);
    struct hsr_area *clip = hsr_areas_pop(&slot->list);
    slot->n -= clip != NULL;
    if (!clip) {
      k++;
      continue;
    }
    struct hsr_area_list inside = {NULL, NULL};
    STEP_ON(s, CLIP, clip, HSR_NOTHING, 0);
    empty += examine_all(s, k, clip, &inside);
    if (inside.first) {
      STEP_ON(s, RECURSION, clip, HSR_NOTHING, 0);
      hsr_areas_push(&inside, clip);
      process(s, &inside);
    } else {
      display(s, clip);
    }
    if (2 * empty > hsr_area_slots_n(&s->slots) - k) {
      hsr_area_slots_close(&s->slots, k);
      empty = 0;
    }
  }
  hsr_area_slots_cut(&s->slots, first);
}

/* --- A picture ------------------------------------------------------------ */

static enum hsr_status find_polygons(const struct hsr_job *job,
                                     struct hsr_polygons *polygons,
                                     struct hsr_error *err) {
  struct state s = {.job = job,
                    .tally = job->tally,
                    .c = {.lines = hsr_named_lines_new(job->world, job->view),
                          .arena = job->scratch},
                    .polygons = polygons,
                    .integrates = !hsr_answer_polygons_of(job->answer),
                    .left = UINT64_C(1000000) * (uint64_t)job->option[CLIPS]};
  struct hsr_area_list list = {NULL, NULL};
  if (!s.c.lines)
    return hsr_fail_nomem(err);
  s.polygons->world = job->world;
  sort(&s, &list);
  process(&s, &list);
  hsr_polygons_sort(s.polygons);
  hsr_polygons_free(&s.shape);
  bool failed = s.c.failed || hsr_named_lines_failed(s.c.lines);
  job->tally->exact[HSR_ASK_EDGE] += hsr_named_lines_exact(s.c.lines);
  hsr_named_lines_free(s.c.lines);
  if (s.refused)
    return hsr_fail(err, HSR_E_REFUSED,
                    "weiler-atherton: more than %ld million polygons to be "
                    "clipped, each to every one before it; clips=N allows N "
                    "million",
                    job->option[CLIPS]);
  if (failed)
    return hsr_fail_nomem(err);
  return s.c.faulty ? hsr_fail(err, HSR_E_INTERNAL,
                               "weiler-atherton: a border does not close")
                    : HSR_OK;
}

/* Analytic antialiasing: the areas of the polygons in each pixel. */
static enum hsr_status find_areas(const struct hsr_job *job,
                                  struct hsr_error *err) {
  const struct hsr_integral_counters counters = {PIECES, PIXELS};
  struct hsr_polygons polygons = {NULL};
  if (hsr_form_area(&job->answer->form).shader != HSR_SHADER_FLAT)
    return hsr_fail(err, HSR_E_REFUSED,
                    "weiler-atherton: a polygon has one colour: shader=flat");
  enum hsr_status status = find_polygons(job, &polygons, err);
  if (!status)
    status = hsr_integrate(job, &polygons, counters, err);
  hsr_polygons_free(&polygons);
  return status;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_polygons *polygons = hsr_answer_polygons_of(job->answer);
  return polygons ? find_polygons(job, polygons, err) : find_areas(job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [SORTED] = {"polygons", "polygons put into rough order", HSR_SORT,
                HSR_OF_FACE, HSR_OF_NOTHING},
    [CLIP] = {"clip polygons", "polygons that others were clipped to",
              HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_NOTHING, .key = "clip-polygon"},
    [EXAMINED] = {"examinations",
                  "polygons examined against a clip polygon; what of them is "
                  "left is examined again",
                  HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                  "boxes apart|outside|divided or inside", .key = "examination",
                  .outcome_keys = "boxes"},
    [CLIPPED] = {"pieces", "pieces that clipping made, inside and outside",
                 HSR_SPLIT, HSR_OF_FACE, HSR_OF_FACE, "inside|outside",
                 .outcome_keys = "cut-piece|cut-piece"},
    [COMPARED] = {"depth comparisons",
                  "inside pieces compared with the clip polygon's plane",
                  HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "behind|before|both",
                  .outcome_keys = "cut-piece|cut-piece|cut-piece"},
    [CUT] = {"penetrations", "inside pieces divided where two planes meet",
             HSR_SPLIT, HSR_OF_FACE, HSR_OF_FACE, .key = "plane-division"},
    [CULLED] = {"culled", "inside pieces behind the clip polygon", HSR_REJECT,
                HSR_OF_FACE, HSR_OF_FACE, .key = "piece-culled",
                .outcome_keys = "cut-piece"},
    [RECURSION] = {"recursions", "inside lists that had to be processed",
                   HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_NOTHING,
                   .key = "inside-list"},
    [SHOWN] = {"regions", "pieces displayed", HSR_ACCEPT, HSR_OF_FACE,
               HSR_OF_NOTHING, .key = "piece-shown"},
    [PIECES] = {"pieces of sides", "in a pixel, of which the area is found",
                HSR_SAMPLE, HSR_OF_FACE, HSR_OF_NOTHING},
    [PIXELS] = {"pixels", "written", HSR_ACCEPT, HSR_OF_NOTHING,
                HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line outline[] = {
    {"sort the polygons from front to back, roughly", HSR_RAISES(SORTED)},
    {"while the list is not empty"},
    {"  the nearest of the list is the clip polygon", HSR_RAISES(CLIP)},
    {"  for each other polygon of the list", HSR_RAISES(EXAMINED)},
    {"    clip it: inside list and outside list", HSR_RAISES(CLIPPED)},
    {"  for each polygon of the inside list", HSR_RAISES(COMPARED)},
    {"    if it penetrates the clip polygon, divide it", HSR_RAISES(CUT)},
    {"    if it is behind the clip polygon, cull it", HSR_RAISES(CULLED)},
    {"  if polygons are left before the clip polygon"},
    {"    process the inside list, the clip polygon at its end",
     HSR_RAISES(RECURSION)},
    {"  else display the clip polygon", HSR_RAISES(SHOWN)},
    {"  the outside list is the list"},
    {"areas: for each side of a displayed polygon, each pixel that it is in",
     HSR_RAISES(PIECES)},
    {"  add up, from right to left; write the pixels", HSR_RAISES(PIXELS)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"polygons", "Z of the nearest vertex", "sort", "once a frame"},
    {"polygons", "X, Y", "clipping to the borders of others",
     "once a clip polygon"},
    {"polygons", "Z", "comparison of planes", "once an inside polygon"},
    {NULL}};

static const struct hsr_step steps[] = {
    {"rough sort", SORTED, HSR_KIND_BUCKET},
    {"examine", EXAMINED, HSR_KIND_BOX},
    {"clip", CLIPPED, HSR_KIND_FACE_WINDOW},
    {"compare", COMPARED, HSR_KIND_FACES, NULL, NULL, {{CUT, HSR_KIND_FACES}}},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(weiler_atherton) = {
    .name = "weiler-atherton",
    .title = "Weiler and Atherton's polygon area sorting",
    .authors = "K. Weiler and P. Atherton",
    .year = 1977,
    .source = "SIGGRAPH 1977, 214-222; Greene 1995, \"The Weiler-Atherton "
              "Algorithm\", pp. 10-11",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "Z(XY)Z",
    .coherence = "area: a polygon hides all that is behind it at once",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_POLYGONS}, {HSR_AREAS, 1 << HSR_AREA_BOX}},
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .render = render};
