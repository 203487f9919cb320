/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Greene's thesis (3.3.1 to 3.3.3) and the paper of 1993 claim about
 * hierarchical z-buffer visibility.
 *
 * Nodes       The nodes visited are the visible ones, their children and the
 *             root, and no others; none is visited twice.
 * Tiled       Every face that is tiled is in a visible cube, or loose. Every
 *             face that is seen is tiled. No face is tiled twice in a frame.
 * Final       The result of a cube's test holds for the finished picture. A
 *             hidden cube has no sample where one of its sides is in front of
 *             the picture. If cubes are tested definitively and each instance
 *             has its own, a visible cube has a sample where one of its sides
 *             is not behind the picture, or may not be, as the side's place has
 *             an error.
 * Coherence   Along a walk, with a cut and back in time, every picture equals
 *             that of the frame drawn alone. Few faces are tiled that were not
 *             in the frame before. The lists do not grow.
 *
 * The steps of a frame are taken one by one. The walk through the octrees is
 * written again here; it notes the result of each step, and must count the same
 * as the true one, counter by counter. */
#define HSR_COUNTING 1
#include "algorithms/counting-names.h" /* the functions of that build */
#include "algorithms/hierarchical/hzbuffer/walk.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "bench/modules/variant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 64, N = 48, SAMPLES = M * N };

/* --- Pictures ------------------------------------------------------------- */

/* One prepared object and the memory of its frames. The choice is what the
 * options of the variant say. */
struct run {
  struct hsr_setup setup;
  struct hsr_hz_choice choice;
  struct hsr_arena scratch;
  struct hsr_tally tally;
  struct hsr_view view;
  struct hsr_answer answer;
  struct hsr_job job;
  uint32_t ids[SAMPLES];
};

static bool has(const char *text, const char *word) {
  return strstr(text, word);
}

static struct hsr_hz_choice choice_of(const char *text) {
  return (struct hsr_hz_choice){
      .octree = HSR_HZ_OCTREE_ON,
      .pyramid = HSR_HZ_PYRAMID_ON,
      .cubes = has(text, "cubes=sides") ? HSR_HZ_CUBES_SIDES
                                        : HSR_HZ_CUBES_RECTANGLE,
      .coherence = has(text, "coherence=list")     ? HSR_HZ_COHERENCE_LIST
                   : has(text, "coherence=passes") ? HSR_HZ_COHERENCE_PASSES
                                                   : HSR_HZ_COHERENCE_OFF};
}

static void begin_run(struct run *r, const struct both_worlds *s,
                      const char *text) {
  struct hsr_variant variant;
  struct hsr_error err;
  memset(r, 0, sizeof *r);
  r->choice = choice_of(text);
  if (hsr_variant_parse(text, &variant, &err))
    bail("%s: %s", text, err.text);
  must_setup(&r->setup, variant.listed->counting, &variant.choice, &s->roster);
}

static void end_run(struct run *r) {
  hsr_setup_free(&r->setup);
  hsr_arena_free(&r->scratch);
}

/* Prepares the job of a view. */
static void set_view(struct run *r, const struct both_worlds *s,
                     uint32_t view) {
  must_view(&r->view, &s->scene->views[view], M, N);
  hsr_arena_reset(&r->scratch);
  memset(&r->tally, 0, sizeof r->tally);
  hsr_tally_begin(&r->tally, r->setup.algorithm);
  memset(r->ids, 0xfe, sizeof r->ids);
  r->answer = hsr_answer_of_ids(r->ids, M, N);
  r->job = (struct hsr_job){.world = r->setup.world,
                            .view = &r->view,
                            .prepared = r->setup.prepared,
                            .option = r->setup.choice.values.option,
                            .scratch = &r->scratch,
                            .tally = &r->tally,
                            .answer = &r->answer};
}

static void draw_run(struct run *r) {
  struct hsr_error err;
  if (hsr_setup_render(&r->setup, &r->job, &err))
    bail("%s: %s", r->setup.algorithm->name, err.text);
}

/* Draws the scene, laid out, with the z-buffer. */
static void draw_right(const struct both_worlds *s, const struct hsr_view *view,
                       uint32_t *ids) {
  draw_plain("zbuffer-fast", &s->world, view, ids);
}

/* --- A walk that takes notes ---------------------------------------------- */

enum said { IS_OUT, IS_HIDDEN, IS_UNTESTED, IS_VISIBLE };

/* A node that was visited. If it has no instance, it is of the octree of
 * instances. */
struct note {
  uint32_t instance, node;
  enum said said;
};
#define NO_INSTANCE UINT32_MAX

struct notes {
  struct hsr_hz_walk walk;
  struct note *note;
  size_t n, room;
  long strays; /* outside the frustum but not found to be, or the reverse */
};

static bool visit(struct notes *ns, const struct hsr_placing *placing,
                  const struct hsr_octree_node *node, uint32_t instance,
                  uint32_t k, bool *inside) {
  struct hsr_hz_walk *w = &ns->walk;
  const struct hsr_tally *tally = w->tally;
  uint64_t out = hsr_tally_count(tally, HSR_HZ_NODES_OUT),
           tested = hsr_tally_count(tally, HSR_HZ_CUBES_TESTED);
  struct hsr_octree_box cube = hsr_octree_cube(node);
  struct hsr_subject subject = hsr_cube_subject(instance, k);
  struct hsr_tally before = *w->tally;
  bool truly_out =
      hsr_cube_classify(&w->frame, placing, &cube, subject) == HSR_BOX_OUT;
  *w->tally = before;
  bool visible = hsr_hz_is_cube_visible(w, placing, hsr_hz_volume(w, node),
                                        subject, inside);
  enum said said = hsr_tally_count(tally, HSR_HZ_NODES_OUT) > out ? IS_OUT
                   : !visible                                     ? IS_HIDDEN
                   : hsr_tally_count(tally, HSR_HZ_CUBES_TESTED) > tested
                       ? IS_VISIBLE
                       : IS_UNTESTED;
  ns->strays += (said == IS_OUT) != truly_out;
  if (ns->n == ns->room) {
    ns->room = 2 * ns->room + 1000;
    ns->note = realloc(ns->note, ns->room * sizeof *ns->note);
    if (!ns->note)
      bail("notes: out of memory");
  }
  ns->note[ns->n++] = (struct note){instance, k, said};
  if (visible)
    HSR_STEP(w->tally, HSR_HZ_CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE,
             0);
  return visible;
}

static void visit_cube(struct notes *ns, uint32_t k, bool inside) {
  struct hsr_hz_walk *w = &ns->walk;
  const struct hsr_octree_node *node = &w->frame.object->octree.node[k];
  if (!visit(ns, &w->frame.placing, node, w->frame.instance, k, &inside))
    return;
  hsr_hz_tile_cell(w, k);
  int nearest = hsr_cube_nearest(&w->frame.placing, node);
  for (int o = 0; o < 8; o++) {
    uint32_t child = node->child[nearest ^ hsr_octant_order[o]];
    if (child != HSR_NO_NODE)
      visit_cube(ns, child, inside);
  }
}

static void visit_instances(struct notes *ns, uint32_t k, bool inside) {
  struct hsr_hz_walk *w = &ns->walk;
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  bool single = node->n == 1 && hsr_octree_is_leaf(node);
  if (!single && !visit(ns, &w->frame.as_it_is, node, NO_INSTANCE, k, &inside))
    return;
  for (uint32_t i = 0; i < node->n; i++)
    if (hsr_cube_is_new(&w->frame, octree->item[node->first + i])) {
      hsr_hz_set_instance(w, octree->item[node->first + i]);
      visit_cube(ns, 0, false);
    }
  int nearest = hsr_cube_nearest(&w->frame.as_it_is, node);
  for (int o = 0; o < 8; o++) {
    uint32_t child = node->child[nearest ^ hsr_octant_order[o]];
    if (child != HSR_NO_NODE)
      visit_instances(ns, child, inside);
  }
}

/* Draws a frame; its z-buffer and pyramid are left as they are at its end. */
static void take_notes(struct notes *ns, struct run *r) {
  memset(ns, 0, sizeof *ns);
  if (hsr_hz_begin(&ns->walk, &r->job, r->setup.prepared, &r->choice))
    bail("notes: out of memory");
  visit_instances(ns, 0, false);
}

/* --- Nodes ---------------------------------------------------------------- */

static int compare_notes(const void *a, const void *b) {
  const struct note *m = a, *n = b;
  if (m->instance != n->instance)
    return m->instance < n->instance ? -1 : 1;
  return (m->node > n->node) - (m->node < n->node);
}

static bool was_visible(const struct notes *ns, uint32_t instance,
                        uint32_t node) {
  struct note key = {instance, node, IS_OUT};
  const struct note *found =
      bsearch(&key, ns->note, ns->n, sizeof key, compare_notes);
  return found && found->said >= IS_UNTESTED;
}

/* Sorts the notes; false if two are of one node. */
static bool none_twice(struct notes *ns) {
  qsort(ns->note, ns->n, sizeof *ns->note, compare_notes);
  for (size_t k = 1; k < ns->n; k++)
    if (!compare_notes(&ns->note[k - 1], &ns->note[k]))
      return false;
  return true;
}

/* Counts the visible nodes of an instance's octree, their children, and the
 * root, from the octree itself. */
static uint64_t count_family(const struct notes *ns, uint32_t i) {
  const struct hsr_cubes *cubes = ns->walk.frame.cubes;
  const struct hsr_octree *octree =
      &cubes->object[cubes->scene->instances[i].object].octree;
  uint64_t n = 1;
  for (uint32_t k = 0; k < octree->n_nodes; k++)
    for (int o = 0; o < 8 && was_visible(ns, i, k); o++)
      n += octree->node[k].child[o] != HSR_NO_NODE;
  return n;
}

/* The same for the octree of instances, in which the node of a single instance
 * is not visited; plus the families of the instances in the visited cubes. */
static uint64_t count_families(const struct notes *ns) {
  const struct hsr_cubes *cubes = ns->walk.frame.cubes;
  const struct hsr_octree *octree = &cubes->octree;
  bool *reached = calloc(octree->n_nodes, sizeof *reached),
       *met = calloc(cubes->scene->n_instances, sizeof *met);
  uint64_t n = 0;
  if (!reached || !met)
    bail("nodes: out of memory");
  reached[0] = true;
  for (uint32_t k = 0; k < octree->n_nodes; k++) { /* parents come first */
    const struct hsr_octree_node *node = &octree->node[k];
    bool single = node->n == 1 && hsr_octree_is_leaf(node);
    if (!reached[k])
      continue;
    n += !single;
    if (!single && !was_visible(ns, NO_INSTANCE, k))
      continue;
    for (int o = 0; o < 8; o++)
      if (node->child[o] != HSR_NO_NODE)
        reached[node->child[o]] = true;
    for (uint32_t i = 0; i < node->n; i++)
      met[octree->item[node->first + i]] = true;
  }
  for (uint32_t i = 0; i < cubes->scene->n_instances; i++)
    n += met[i] ? count_family(ns, i) : 0;
  free(reached);
  free(met);
  return n;
}

/* --- Final ---------------------------------------------------------------- */

/* A side of a cube in the world: corner + s u + t v, s and t in [0, 1]. */
struct side {
  double corner[3], u[3], v[3];
};

static void to_world_point(const double m[12], const double *p, double *q) {
  hsr_instance_vertex(m, p, q);
}

static struct side side_of_cube(const double m[12],
                                const struct hsr_octree_node *node, int side) {
  int k = side % 3, a = (k + 1) % 3, b = (k + 2) % 3;
  double p[3], q[3], r[3];
  struct side s;
  for (int c = 0; c < 3; c++)
    p[c] = node->centre[c] - node->half;
  if (side >= 3)
    p[k] += 2 * node->half;
  memcpy(q, p, sizeof q);
  memcpy(r, p, sizeof r);
  q[a] += 2 * node->half;
  r[b] += 2 * node->half;
  to_world_point(m, p, s.corner);
  to_world_point(m, q, s.u);
  to_world_point(m, r, s.v);
  for (int c = 0; c < 3; c++) {
    s.u[c] -= s.corner[c];
    s.v[c] -= s.corner[c];
  }
  return s;
}

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int k = 0, l = 1, m = 2; k < 3; k++, l = (l + 1) % 3, m = (m + 1) % 3)
    c[k] = a[l] * b[m] - a[m] * b[l];
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Where the ray of a screen point meets the plane of a side. Returns 1/t of the
 * ray, and s and t of the side. */
static double meet(const struct hsr_view *view, const struct side *side,
                   double sx, double sy, double *s, double *t) {
  double D[3], O[3], n[3], c[3];
  for (int k = 0; k < 3; k++) {
    D[k] = view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    O[k] = side->corner[k] - view->E[k];
  }
  cross(side->u, side->v, n);
  double q = dot(n, D) / dot(n, O), P[3];
  for (int k = 0; k < 3; k++)
    P[k] = D[k] / q - O[k];
  cross(P, side->v, c);
  *s = dot(n, c) / dot(n, n);
  cross(side->u, P, c);
  *t = dot(n, c) / dot(n, n);
  return q;
}

/* The finished picture: 1/t of the visible face, 0 where there is none. */
static void find_depths(const struct both_worlds *st, struct run *r,
                        double *depth) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  if (hsr_screen_make(&screen, &st->world, &r->view, &arena, &r->tally))
    bail("depths: out of memory");
  for (int j = 0; j < N; j++)
    for (int i = 0; i < M; i++) {
      uint32_t id = r->ids[j * M + i];
      depth[j * M + i] =
          id == HSR_BACKGROUND ? 0 : hsr_depth(&screen, id, i, j);
    }
  hsr_arena_free(&arena);
}

/* A side at the samples: is it certainly in front of the picture; is it not
 * behind; or is that in doubt, since it comes within half a sample? */
struct seen {
  bool before, not_behind, in_doubt;
};

static void to_screen(const struct hsr_view *view, const struct side *side,
                      double s, double t, double p[3]) {
  double V[3];
  for (int k = 0; k < 3; k++)
    V[k] = side->corner[k] + s * side->u[k] + t * side->v[k] - view->E[k];
  double w = dot(view->screen[2], V);
  p[0] = dot(view->screen[0], V) / w;
  p[1] = dot(view->screen[1], V) / w;
  p[2] = 1 / w;
}

/* The samples around a side, which is in front of the eye like all sides that
 * are tested. */
static struct hsr_bounds samples_of(const struct hsr_view *view,
                                    const struct side *side) {
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
  for (int c = 0; c < 4; c++) {
    double p[3];
    to_screen(view, side, c & 1, c >> 1, p);
    for (int k = 0; k < 2; k++) {
      lo[k] = fmin(lo[k], p[k]);
      hi[k] = fmax(hi[k], p[k]);
    }
  }
  return (struct hsr_bounds){
      (int)fmin(fmax(lo[0] - 1, 0), M), (int)fmin(fmax(lo[1] - 1, 0), N),
      (int)fmin(fmax(hi[0] + 1, 0), M), (int)fmin(fmax(hi[1] + 1, 0), N)};
}

static void look_at_side(const struct hsr_view *view, const struct side *side,
                         const double *depth, struct seen *seen) {
  struct hsr_bounds box = samples_of(view, side);
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      double picture = depth[j * M + i], s, t;
      double q = meet(view, side, i + 0.5, j + 0.5, &s, &t);
      double in = fmin(fmin(s, 1 - s), fmin(t, 1 - t));
      seen->not_behind |= q > 0 && in > -1e-9 && q * (1 + 1e-9) >= picture;
      seen->before |= q > 0 && in > 1e-9 && q * (1 - 1e-9) > picture;
    }
}

/* Compares points all over a side with the samples of their pixels. Each sample
 * is at most half a sample away in both directions. There the plane of the side
 * is taken, but no nearer than the cube's nearest corner. */
static void doubt_side(const struct hsr_view *view, const struct side *side,
                       double nearest, const double *depth, struct seen *seen) {
  struct hsr_bounds box = samples_of(view, side);
  int width = box.x1 - box.x0, height = box.y1 - box.y0;
  int n = 4 * (width > height ? width : height) + 4;
  for (int k = 0; k <= n && !seen->in_doubt; k++)
    for (int l = 0; l <= n && !seen->in_doubt; l++) {
      double p[3], s, t;
      to_screen(view, side, (double)k / n, (double)l / n, p);
      if (!(p[0] > 0 && p[0] < M && p[1] > 0 && p[1] < N))
        continue;
      int i = (int)p[0], j = (int)p[1];
      double q = fmin(meet(view, side, i + 0.5, j + 0.5, &s, &t), nearest);
      seen->in_doubt |= fmax(p[2], q) * (1 + 1e-4) >= depth[j * M + i];
    }
}

/* The largest 1/t of a cube, at one of its corners. */
static double nearest_corner(const struct hsr_view *view, const double m[12],
                             const struct hsr_octree_node *node) {
  double nearest = 0;
  for (int k = 0; k < 6; k++)
    for (int c = 0; c < 4; c++) {
      struct side side = side_of_cube(m, node, k);
      double p[3];
      to_screen(view, &side, c & 1, c >> 1, p);
      nearest = fmax(nearest, p[2]);
    }
  return nearest;
}

static struct seen look_at_cube(const struct notes *ns, const struct note *note,
                                const double *depth) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const struct hsr_cubes *cubes = ns->walk.frame.cubes;
  const struct hsr_view *view = ns->walk.frame.job->view;
  struct seen seen = {false, false, false};
  const struct hsr_octree_node *node = &cubes->octree.node[note->node];
  const double *m = identity;
  if (note->instance != NO_INSTANCE) {
    const struct hsr_instance *instance =
        &cubes->scene->instances[note->instance];
    m = instance->m;
    node = &cubes->object[instance->object].octree.node[note->node];
  }
  for (int k = 0; k < 6; k++) {
    struct side side = side_of_cube(m, node, k);
    look_at_side(view, &side, depth, &seen);
  }
  for (int k = 0; k < 6 && !seen.not_behind; k++) {
    struct side side = side_of_cube(m, node, k);
    doubt_side(view, &side, nearest_corner(view, m, node), depth, &seen);
  }
  return seen;
}

struct final {
  long hidden, visible; /* cubes that were tested */
  long wrongly_hidden, covered, in_doubt;
};

static void retest(const struct notes *ns, const double *depth,
                   struct final *f) {
  for (size_t k = 0; k < ns->n; k++) {
    enum said said = ns->note[k].said;
    if (said != IS_HIDDEN && said != IS_VISIBLE)
      continue;
    struct seen seen = look_at_cube(ns, &ns->note[k], depth);
    f->hidden += said == IS_HIDDEN;
    f->visible += said == IS_VISIBLE;
    f->wrongly_hidden += said == IS_HIDDEN && seen.before;
    f->covered += said == IS_VISIBLE && !seen.not_behind && !seen.in_doubt;
    f->in_doubt += said == IS_VISIBLE && !seen.not_behind && seen.in_doubt;
  }
}

/* --- What is tiled -------------------------------------------------------- */

/* Which faces were compared at a sample, and which were written. */
struct keys {
  uint64_t *key; /* face << 32 | sample */
  size_t n, room;
};

struct watched {
  const struct hsr_world *world;
  struct keys compared;
  struct keys unsure; /* samples near an edge, of faces of over three corners */
  bool *written;
};

static void add_key(struct keys *keys, const struct hsr_event *event) {
  if (keys->n == keys->room) {
    keys->room = 2 * keys->room + 1000;
    keys->key = realloc(keys->key, keys->room * sizeof *keys->key);
    if (!keys->key)
      bail("events: out of memory");
  }
  keys->key[keys->n++] = (uint64_t)event->a.id[0] << 32 |
                         (uint64_t)(event->window.y0 * M + event->window.x0);
}

static void watch(void *context, const struct hsr_event *event) {
  struct watched *w = context;
  if (event->counter == HSR_WRITES % HSR_PART_SIZE)
    w->written[event->a.id[0]] = true;
  if (event->counter == HSR_DEPTH_TESTS % HSR_PART_SIZE)
    add_key(&w->compared, event);
  if (event->counter == HSR_UNSURE_COVER % HSR_PART_SIZE &&
      hsr_face_size(w->world, (uint32_t)event->a.id[0]) > 3)
    add_key(&w->unsure, event);
}

static int compare_numbers(const void *a, const void *b) {
  const uint64_t *m = a, *n = b;
  return (*m > *n) - (*m < *n);
}

/* How often a face was compared again at the same sample, but where that is so
 * near the diagonal of a fan that both triangles have to ask the face. */
static long count_twice(struct watched *w) {
  long twice = 0;
  struct keys *c = &w->compared, *u = &w->unsure;
  if (!c->n)
    return 0;
  qsort(c->key, c->n, sizeof *c->key, compare_numbers);
  for (size_t k = 1; k < c->n; k++) {
    bool asked = false;
    if (c->key[k] != c->key[k - 1])
      continue;
    for (size_t l = 0; l < u->n && !asked; l++)
      asked = u->key[l] == c->key[k];
    twice += !asked || (k > 1 && c->key[k] == c->key[k - 2]);
  }
  return twice;
}

/* Marks the faces that are in visible cubes, or loose. */
static void mark_in_visible(const struct notes *ns, bool *in) {
  const struct hsr_cubes *cubes = ns->walk.frame.cubes;
  const uint32_t *first = ns->walk.frame.job->world->roster.first;
  for (uint32_t k = 0; k < cubes->loose.n_faces; k++)
    in[cubes->loose_id[k]] = true;
  for (size_t k = 0; k < ns->n; k++) {
    const struct note *note = &ns->note[k];
    if (note->instance == NO_INSTANCE || note->said < IS_UNTESTED)
      continue;
    const struct hsr_cubes_object *object =
        &cubes->object[cubes->scene->instances[note->instance].object];
    const struct hsr_cell *cell = &object->cell[note->node];
    for (uint32_t f = 0; f < cell->n_faces; f++)
      in[first[note->instance] + object->face[cell->first_face + f]] = true;
  }
}

/* Whether an instance's own root cube lies in a cube. */
static bool holds_root(const struct hsr_cubes *cubes,
                       const struct hsr_octree_node *node, uint32_t i) {
  const struct hsr_instance *instance = &cubes->scene->instances[i];
  const struct hsr_octree_node *root =
      &cubes->object[instance->object].octree.node[0];
  struct hsr_box box = hsr_cube_box(node);
  for (int k = 0; k < 3; k++) {
    const double *row = instance->m + 4 * k;
    double centre = row[0] * root->centre[0] + row[1] * root->centre[1] +
                    row[2] * root->centre[2] + row[3];
    double half = (fabs(row[0]) + fabs(row[1]) + fabs(row[2])) * root->half;
    if (centre - half < box.lo[k] || centre + half > box.hi[k])
      return false;
  }
  return true;
}

/* Whether each instance has a cube to itself, and no other. */
static bool are_apart(const struct hsr_cubes *cubes) {
  const struct hsr_octree *octree = &cubes->octree;
  bool apart = octree->n_items == cubes->scene->n_instances;
  for (uint32_t k = 0; k < octree->n_nodes && apart; k++) {
    const struct hsr_octree_node *node = &octree->node[k];
    uint32_t children = 0;
    for (int o = 0; o < 8; o++)
      children += node->child[o] != HSR_NO_NODE;
    apart =
        node->n == 0 || (node->n == 1 && !children &&
                         (octree->n_items == 1 ||
                          holds_root(cubes, node, octree->item[node->first])));
  }
  return apart;
}

/* --- One picture, all claims ---------------------------------------------- */

struct found {
  long pictures, nodes, visible, differ;
  long not_alike, strays, families, twice, outside, unseen, again;
  struct final final;
};

/* Whether the true run and the noted one count the same. */
static bool count_alike(const struct run *a, const struct run *b) {
  return !memcmp(a->tally.count, b->tally.count, sizeof a->tally.count);
}

static void try_view(const struct both_worlds *s, struct run *r,
                     struct run *noted, const uint32_t *right, uint32_t view,
                     struct found *f) {
  static struct notes ns;
  static double depth[SAMPLES];
  struct watched watched = {.world = &s->world,
                            .written = calloc(s->world.n_faces, sizeof(bool))};
  bool *in = calloc(s->world.n_faces, sizeof *in);
  if (!watched.written || !in)
    bail("%s: out of memory", s->scene->name);
  set_view(r, s, view);
  struct hsr_trace trace = {.listen = watch, .context = &watched};
  r->tally.trace = &trace;
  draw_run(r);
  set_view(noted, s, view);
  take_notes(&ns, noted);
  f->pictures++;
  f->differ += count_differences(&r->view, r->ids, right) +
               count_differences(&r->view, noted->ids, right);
  f->not_alike += !count_alike(r, noted);

  const struct hsr_tally *tally = &r->tally;
  f->nodes += (long)hsr_tally_count(tally, HSR_HZ_NODES);
  f->visible += (long)hsr_tally_count(tally, HSR_HZ_CUBES_VISIBLE);
  f->strays += ns.strays;
  f->twice += !none_twice(&ns);
  f->families += hsr_tally_count(tally, HSR_HZ_NODES) != count_families(&ns) ||
                 hsr_tally_count(tally, HSR_HZ_NODES) !=
                     hsr_tally_count(tally, HSR_HZ_CUBES_VISIBLE) +
                         hsr_tally_count(tally, HSR_HZ_CUBES_CULLED) +
                         hsr_tally_count(tally, HSR_HZ_NODES_OUT);
  mark_in_visible(&ns, in);
  for (uint32_t g = 0; g < s->world.n_faces; g++)
    f->outside += watched.written[g] && !in[g];
  for (int k = 0; k < SAMPLES; k++)
    f->unseen += right[k] != HSR_BACKGROUND && !watched.written[right[k]];
  f->again += count_twice(&watched);
  find_depths(s, noted, depth);
  retest(&ns, depth, &f->final);
  free(ns.note);
  free(in);
  free(watched.written);
  free(watched.compared.key);
  free(watched.unsure.key);
}

static void try_claims(struct tap *tap, const struct both_worlds *s,
                       const char *text, int n_views) {
  static struct run r, noted;
  static uint32_t right[SAMPLES];
  struct found f;
  memset(&f, 0, sizeof f);
  begin_run(&r, s, text);
  begin_run(&noted, s, text);
  for (int v = 0; v < n_views; v++) {
    uint32_t view = (uint32_t)v * (s->scene->n_views / (uint32_t)n_views);
    set_view(&r, s, view);
    draw_right(s, &r.view, right);
    try_view(s, &r, &noted, right, view, &f);
  }
  const struct hsr_hz_prepared *prepared = r.setup.prepared;
  bool sides = r.choice.cubes == HSR_HZ_CUBES_SIDES;
  bool apart = are_apart(&prepared->cubes);
  ok(tap, !f.differ && !f.not_alike,
     "%s, %s: %ld pictures as the z-buffer's, and as the noted ones",
     s->scene->name, text, f.pictures);
  ok(tap, !f.families && !f.twice && !f.strays && f.visible > 0,
     "%ld nodes visited are the root, %ld visible nodes and their hidden "
     "children, each once",
     f.nodes, f.visible);
  ok(tap, !f.outside && !f.unseen && !f.again,
     "what is tiled is in visible cubes, and is tiled once (%ld are not, %ld "
     "samples lack theirs, %ld twice)",
     f.outside, f.unseen, f.again);
  ok(tap,
     !f.final.wrongly_hidden && f.final.hidden + f.final.visible > 10 &&
         (!sides || !apart || !f.final.covered),
     "%ld hidden cubes are hidden in the end (%ld are not); of %ld visible "
     "ones%s %ld are covered and %ld nearly",
     f.final.hidden, f.final.wrongly_hidden, f.final.visible,
     apart ? "" : ", in instances that are not apart,", f.final.covered,
     f.final.in_doubt);
  end_run(&r);
  end_run(&noted);
}

/* --- Temporal coherence --------------------------------------------------- */

/* Views 1 to 50 with a cut to 120 and back, then back in time. */
enum { STEPS = 50, CUT = 25, CUT_TO = 120, FRAMES = 2 * STEPS + 1 };

static uint32_t view_of_frame(int k) {
  if (k > STEPS)
    return (uint32_t)(2 * STEPS + 1 - k);
  return k < CUT ? (uint32_t)(k + 1) : k == CUT ? CUT_TO : (uint32_t)k;
}

/* What the two passes of a frame tile. */
struct passes {
  uint64_t first, second, again, listed;
};

/* Draws a frame as `render` does, and looks at what the first pass did. */
static struct passes draw_in_passes(struct run *r) {
  struct hsr_hz_walk w;
  const struct hsr_tally *tally = &r->tally;
  struct passes p = {0, 0, 0, 0};
  if (hsr_hz_begin(&w, &r->job, r->setup.prepared, &r->choice))
    bail("passes: out of memory");
  p.first = hsr_tally_count(tally, HSR_HZ_FACES_TILED);
  p.again = hsr_tally_count(tally, HSR_HZ_CUBES_AGAIN);
  hsr_hz_process_instances(&w, 0, false);
  p.second = hsr_tally_count(tally, HSR_HZ_FACES_TILED) - p.first;
  if (hsr_hz_end(&w))
    bail("passes: out of memory");
  const struct hsr_hz_prepared *prepared = r->setup.prepared;
  p.listed = prepared->list[prepared->last].cube.n;
  return p;
}

/* A view alone: the right picture, and its work without coherence. */
struct cold {
  uint32_t right[SAMPLES];
  uint64_t tiled, visible;
  long differ;
};

static void draw_cold(const struct both_worlds *s, struct run *plain,
                      uint32_t view, struct cold *cold) {
  set_view(plain, s, view);
  draw_right(s, &plain->view, cold->right);
  draw_run(plain);
  cold->differ = count_differences(&plain->view, plain->ids, cold->right);
  cold->tiled = hsr_tally_count(&plain->tally, HSR_HZ_FACES_TILED);
  cold->visible = hsr_tally_count(&plain->tally, HSR_HZ_CUBES_VISIBLE);
}

struct hsr_hz_walked {
  long differ, unlike;
  uint64_t visible, listed, most_listed;
  uint64_t cut, cut_cold, smooth, smooth_cold; /* faces tiled: newly exposed; of
                                                  all; after cuts, and else */
  size_t halfway, peak;                        /* bytes of the lists */
};

static size_t bytes_of_lists(const struct run *r) {
  const struct hsr_hz_prepared *prepared = r->setup.prepared;
  return prepared->list[0].arena.peak_bytes +
         prepared->list[1].arena.peak_bytes;
}

static void walk_frame(const struct both_worlds *s, struct run *stepped,
                       struct run *whole, const struct cold *cold, int k,
                       struct hsr_hz_walked *t) {
  set_view(stepped, s, view_of_frame(k));
  set_view(whole, s, view_of_frame(k));
  struct passes p = draw_in_passes(stepped);
  draw_run(whole);
  t->differ += cold->differ +
               count_differences(&whole->view, stepped->ids, cold->right) +
               count_differences(&whole->view, whole->ids, cold->right);
  t->unlike += !count_alike(stepped, whole);
  bool cut = k == 0 || k == CUT || k == CUT + 1;
  *(cut ? &t->cut : &t->smooth) += p.second;
  *(cut ? &t->cut_cold : &t->smooth_cold) += cold->tiled;
  t->visible += cold->visible;
  t->listed += p.listed;
  t->most_listed = p.listed > t->most_listed ? p.listed : t->most_listed;
  if (k == STEPS)
    t->halfway = bytes_of_lists(stepped);
  t->peak = bytes_of_lists(stepped);
}

static void try_walk(struct tap *tap, const struct both_worlds *s,
                     const struct cold *cold, const char *text) {
  static struct run stepped, whole;
  struct hsr_hz_walked t;
  memset(&t, 0, sizeof t);
  begin_run(&stepped, s, text);
  begin_run(&whole, s, text);
  for (int k = 0; k < FRAMES; k++)
    walk_frame(s, &stepped, &whole, &cold[view_of_frame(k)], k, &t);
  ok(tap, !t.differ && !t.unlike,
     "%s: %d frames, with a cut and back in time: %ld samples differ", text,
     (int)FRAMES, t.differ);
  ok(tap, 20 * t.smooth < t.smooth_cold && 2 * t.cut > t.cut_cold,
     "of %llu faces %llu are newly exposed; of %llu in the three frames after "
     "cuts %llu",
     (unsigned long long)t.smooth_cold, (unsigned long long)t.smooth,
     (unsigned long long)t.cut_cold, (unsigned long long)t.cut);
  ok(tap, t.listed > 0 && t.listed <= t.visible && t.peak <= 2 * t.halfway,
     "%llu cubes are listed, of %llu visible in frames for themselves; at most "
     "%llu; lists of %zu bytes, halfway %zu",
     (unsigned long long)t.listed, (unsigned long long)t.visible,
     (unsigned long long)t.most_listed, t.peak, t.halfway);
  end_run(&stepped);
  end_run(&whole);
}

static void try_walks(struct tap *tap) {
  static struct cold cold[CUT_TO + 1];
  static struct run plain;
  struct both_worlds s;
  open_worlds(&s, "office:3");
  begin_run(&plain, &s, "hzbuffer");
  for (uint32_t v = 1; v <= STEPS; v++)
    draw_cold(&s, &plain, v, &cold[v]);
  draw_cold(&s, &plain, CUT_TO, &cold[CUT_TO]);
  end_run(&plain);
  try_walk(tap, &s, cold, "hzbuffer:coherence=list");
  try_walk(tap, &s, cold, "hzbuffer:coherence=passes");
  close_worlds(&s);
}

/* Counts of frames of one view each, drawn twice: the second time by what was seen
 * in the first. */
struct twice {
  uint64_t tested[2], culled[2], tiled[2];
  long differ;
};

static void draw_twice(const struct both_worlds *s, struct run *r,
                       uint32_t view, struct twice *t) {
  static uint32_t right[SAMPLES];
  for (int k = 0; k < 2; k++) {
    set_view(r, s, view);
    draw_run(r);
    draw_right(s, &r->view, right);
    for (int i = 0; i < SAMPLES; i++)
      t->differ += r->ids[i] != right[i];
    t->tested[k] += hsr_tally_count(&r->tally, HSR_HZ_CUBES_TESTED);
    t->culled[k] += hsr_tally_count(&r->tally, HSR_HZ_CUBES_CULLED);
    t->tiled[k] += hsr_tally_count(&r->tally, HSR_HZ_FACES_TILED);
  }
}

/* coherence=chc: the first frame of a run is as without coherence; the second of
 * the same view tests fewer cubes, and tiles hardly more faces. */
static void try_chc(struct tap *tap, const char *scene) {
  struct both_worlds s;
  struct twice with, without;
  memset(&with, 0, sizeof with);
  memset(&without, 0, sizeof without);
  open_worlds(&s, scene);
  for (uint32_t v = 0; v < s.scene->n_views; v += s.scene->n_views / 8 + 1) {
    static struct run chc, plain;
    begin_run(&chc, &s, "hzbuffer:coherence=chc");
    begin_run(&plain, &s, "hzbuffer");
    draw_twice(&s, &chc, v, &with);
    draw_twice(&s, &plain, v, &without);
    end_run(&chc);
    end_run(&plain);
  }
  ok(tap,
     !with.differ && with.tested[0] == without.tested[0] &&
         with.culled[0] == without.culled[0] &&
         with.tiled[0] == without.tiled[0],
     "%s, coherence=chc: %ld samples differ; a first frame tests %llu cubes, "
     "as without",
     scene, with.differ, (unsigned long long)with.tested[0]);
  ok(tap,
     with.tested[1] < with.tested[0] && with.tiled[1] >= with.tiled[0] &&
         20 * (with.tiled[1] - with.tiled[0]) <= with.tiled[0],
     "the same view once more tests %llu; tiles %llu faces, first %llu",
     (unsigned long long)with.tested[1], (unsigned long long)with.tiled[1],
     (unsigned long long)with.tiled[0]);
  close_worlds(&s);
}

/* Cubes tested in frames 3 to 10 of one view; frames that show something wrong are
 * told. */
static uint64_t count_tests(const struct both_worlds *s, const char *variant,
                            uint64_t *tiled, long *differ) {
  static uint32_t right[SAMPLES];
  static struct run r;
  uint64_t tested = 0;
  *tiled = 0;
  begin_run(&r, s, variant);
  for (int frame = 1; frame <= 10; frame++) {
    set_view(&r, s, 0);
    draw_run(&r);
    draw_right(s, &r.view, right);
    for (int i = 0; i < SAMPLES; i++)
      *differ += r.ids[i] != right[i];
    if (frame < 3)
      continue;
    tested += hsr_tally_count(&r.tally, HSR_HZ_CUBES_TESTED);
    *tiled += hsr_tally_count(&r.tally, HSR_HZ_FACES_TILED);
  }
  end_run(&r);
  return tested;
}

/* coherence=chc++: assumed for one frame it is chc. For four frames, fewer cubes are
 * tested while the same is visible, and no more faces are tiled. */
static void try_chc_pp(struct tap *tap, const char *scene) {
  struct both_worlds s;
  uint64_t tiled[3];
  long differ = 0;
  open_worlds(&s, scene);
  uint64_t chc = count_tests(&s, "hzbuffer:coherence=chc", &tiled[0], &differ);
  uint64_t one =
      count_tests(&s, "hzbuffer:coherence=chc++:assumed=1", &tiled[1], &differ);
  uint64_t four =
      count_tests(&s, "hzbuffer:coherence=chc++:assumed=4", &tiled[2], &differ);
  ok(tap,
     !differ && one == chc && tiled[1] == tiled[0] && four < chc &&
         tiled[2] == tiled[0],
     "%s, coherence=chc++: %ld samples differ; %llu cubes tested, by chc %llu; "
     "%llu faces tiled, by chc %llu",
     scene, differ, (unsigned long long)four, (unsigned long long)chc,
     (unsigned long long)tiled[2], (unsigned long long)tiled[0]);
  close_worlds(&s);
}

int main(void) {
  static const struct {
    const char *scene;
    int views;
  } stages[] = {{"office:1", 5},      {"office:2", 4},    {"harbor", 3},
                {"terrain:16:12", 3}, {"house", 9},       {"soup:500:3", 4},
                {"twist:5", 3},       {"color-cube:4", 3}};
  enum { STAGES = sizeof stages / sizeof *stages };
  struct tap tap = plan(4 * 2 * STAGES + 12);
  for (int k = 0; k < STAGES; k++) {
    struct both_worlds s;
    open_worlds(&s, stages[k].scene);
    try_claims(&tap, &s, "hzbuffer", stages[k].views);
    try_claims(&tap, &s, "hzbuffer:cubes=sides", stages[k].views);
    close_worlds(&s);
  }
  try_walks(&tap);
  try_chc(&tap, "office:3");
  try_chc(&tap, "harbor");
  try_chc_pp(&tap, "office:3");
  try_chc_pp(&tap, "harbor");
  return finish(&tap);
}
