/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ray casting through an octree.
 *
 * Source      S. Rubin and T. Whitted, "A 3-dimensional representation for fast
 *             rendering of complex scenes", SIGGRAPH 1980; A. Glassner, "Space
 *             subdivision for fast ray tracing", IEEE CG&A 4(10), 1984; as told
 *             by N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.4.
 * Notation    primitive -> face; a ray's point at t is o + t d
 * Invariants  A face lies in the cubes that list it. A ray's nearest hit so far
 *             is the picture's face among those tested. A cube that is passed
 *             over is missed by the ray, or begins behind that hit.
 * Ties        by hsr_nearer: the picture's order. A cube that may begin as near
 *             as the hit is entered.
 * Departures  Rays go down from the root to cubes, instead of from one cube to
 *             the next. A face that is in several cubes of a ray is tested in
 *             the first one only. A face that is not flat is seen on its plane,
 *             which may be outside of all cubes of its vertices: such faces are
 *             in no cube, and every ray tests them.
 * Cost        For each ray, the cubes that it meets as far as its hit. The root
 *             is visited once a sample; hzbuffer visits it once a frame.
 *
 * A ray against a cube. With u = 2^-53, a component of D is a sum of three
 * products of coefficients that have a relative error of 2u: it is off by less
 * than 16u of the sum of their sizes. In parallel the same holds of P, E
 * included, and F is exact. 2^-960 covers underflow. A cube's bounds are
 * differences of two doubles: `grow` is above their rounding, and above that of
 * what is subtracted from them. A slab is then entered no earlier than the least
 * quotient of these intervals says. Quotients round by u; `ROUND` is above
 * that. If a component of d may be 0, the ray stays within |d| t of o along
 * that axis, and the other axes say how far t goes. */
#include "algorithms/algorithm.h"
#include "common/base/numbers.h"
#include "common/exact/screen.h"
#include "common/trees/octree.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;
static const double ROUND = 4 * DBL_EPSILON;

enum { RAYS, CUBES, BEHIND, FACES, AGAIN, TESTS, DEPTHS, SHOWN };

/* The faces of a world in an octree. */
struct prepared {
  struct hsr_octree octree; /* item[] are faces */
  uint32_t *loose;          /* faces that are in no cube */
  uint32_t n_loose;
  struct hsr_arena arena;
};

struct ray {
  int i, j;
  uint32_t number; /* from 1 */
  double o[3], o_error[3], d[3], d_error[3];
  uint32_t hit; /* HSR_BACKGROUND: none yet */
  double until; /* the hit is no farther than this t */
};

/* What is known of a face in this view. */
enum { UNKNOWN, IN_SIGHT, NOT_IN_SIGHT };

struct caster {
  const struct hsr_job *job;
  const struct prepared *prepared;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  unsigned char *known; /* a face */
  uint32_t *met;        /* a face: the number of the last ray that met it */
  struct ray ray;
};

/* --- A ray ---------------------------------------------------------------- */

static void set_ray(struct caster *c, int i, int j) {
  const struct hsr_view *view = c->job->view;
  double sx = hsr_sample_x(view, i), sy = hsr_sample_y(view, j);
  struct ray *r = &c->ray;
  r->i = i;
  r->j = j;
  r->number++;
  r->hit = HSR_BACKGROUND;
  r->until = INFINITY;
  for (int k = 0; k < 3; k++) {
    double a = view->ray[0][k], b = sx * view->ray[1][k],
           e = sy * view->ray[2][k];
    double sum = a + b + e, size = fabs(a) + fabs(b) + fabs(e);
    double error = 16 * U * size + TINY;
    r->o[k] = view->E[k];
    r->o_error[k] = 0;
    r->d[k] = sum;
    r->d_error[k] = error;
    if (view->parallel) {
      r->o[k] += sum;
      r->o_error[k] = error + 2 * U * fabs(r->o[k]);
      r->d[k] = view->F[k];
      r->d_error[k] = 0;
    }
  }
}

/* The t between two planes across an axis, which are from a to b ahead of o;
 * d, which is positive, is within `error`. */
static void narrow(double a, double b, double d, double error, double *t0,
                   double *t1) {
  double enter = a / (a > 0 ? d + error : d - error);
  double leave = b / (b > 0 ? d - error : d + error);
  *t0 = hsr_max(*t0, enter - ROUND * fabs(enter));
  *t1 = hsr_min(*t1, leave + ROUND * fabs(leave));
}

/* Whether the ray may meet the cube, and then no nearer than *begins. */
static bool meets(const struct caster *c, const struct hsr_octree_node *node,
                  double *begins) {
  const struct ray *r = &c->ray;
  double t0 = c->job->view->near, t1 = INFINITY, a[3], b[3];
  bool across[3];
  for (int k = 0; k < 3; k++) {
    double grow =
        16 * U * (fabs(node->centre[k]) + node->half + fabs(r->o[k])) +
        r->o_error[k] + TINY;
    a[k] = node->centre[k] - node->half - r->o[k] - grow;
    b[k] = node->centre[k] + node->half - r->o[k] + grow;
    across[k] = fabs(r->d[k]) > 2 * r->d_error[k];
    if (across[k] && r->d[k] > 0)
      narrow(a[k], b[k], r->d[k], r->d_error[k], &t0, &t1);
    else if (across[k])
      narrow(-b[k], -a[k], -r->d[k], r->d_error[k], &t0, &t1);
  }
  for (int k = 0; k < 3; k++) {
    double rate = fabs(r->d[k]) + r->d_error[k];
    double strays = rate > 0 ? rate * t1 * (1 + ROUND) : 0;
    if (!across[k] && (a[k] > strays || b[k] < -strays))
      return false;
  }
  *begins = t0;
  return t0 <= t1;
}

/* --- Faces ---------------------------------------------------------------- */

/* Is there anything of the face in the window? Its plane is found when the
 * first ray meets it. */
static bool is_in_sight(struct caster *c, uint32_t f) {
  if (c->known[f] == UNKNOWN) {
    hsr_screen_plane(&c->screen, f);
    c->known[f] =
        hsr_screen_place(&c->screen, f, c->tally) ? IN_SIGHT : NOT_IN_SIGHT;
  }
  return c->known[f] == IN_SIGHT;
}

/* A t that the hit is not beyond; infinite if too little is known. */
static double farthest(const struct caster *c, uint32_t f) {
  double q = hsr_depth(&c->screen, f, c->ray.i, c->ray.j);
  double least = q - 2 * c->screen.plane[f].error;
  if (!(least > (c->job->view->parallel ? -INFINITY : 0)))
    return INFINITY;
  double t = hsr_view_depth(c->job->view, least);
  return t + ROUND * fabs(t);
}

static void test_face(struct caster *c, uint32_t f, struct hsr_subject cube) {
  struct ray *r = &c->ray;
  struct hsr_window here = HSR_AT(r->i, r->j);
  HSR_STEP(c->tally, FACES, HSR_FACE(f), cube, here, 0);
  if (c->met[f] == r->number) {
    HSR_STEP(c->tally, AGAIN, HSR_FACE(f), HSR_THE_WINDOW, here, 0);
    return;
  }
  c->met[f] = r->number;
  if (!is_in_sight(c, f))
    return;
  HSR_TOUCH(c->tally, r->i, r->j);
  bool hit = hsr_covers(&c->screen, f, r->i, r->j, c->tally);
  HSR_STEP(c->tally, TESTS, HSR_FACE(f), HSR_THE_WINDOW, here, hit);
  if (!hit)
    return;
  if (r->hit != HSR_BACKGROUND) {
    bool nearer = hsr_nearer(&c->screen, f, r->hit, r->i, r->j, c->tally);
    HSR_STEP(c->tally, DEPTHS, HSR_FACE(f), HSR_FACE(r->hit), here, nearer);
    if (!nearer)
      return;
  }
  r->hit = f;
  r->until = farthest(c, f);
}

/* --- The octree ----------------------------------------------------------- */

/* The octant whose side of each median plane the eye is on. In parallel the eye
 * is infinitely far away (common/view/view.h). */
static unsigned nearest_octant(const struct caster *c,
                               const struct hsr_octree_node *node) {
  const double *eye = c->job->view->eye;
  return (unsigned)(eye[0] > node->centre[0]) |
         (unsigned)(eye[1] > node->centre[1]) << 1 |
         (unsigned)(eye[2] > node->centre[2]) << 2;
}

static void visit(struct caster *c, uint32_t k) {
  const struct hsr_octree *octree = &c->prepared->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_subject cube = HSR_CELL(k, HSR_NO_ID, 0);
  struct hsr_window here = HSR_AT(c->ray.i, c->ray.j);
  double begins = 0;
  bool met = meets(c, node, &begins);
  HSR_STEP(c->tally, CUBES, cube, HSR_THE_WINDOW, here, met);
  if (!met)
    return;
  if (c->ray.until < begins) {
    HSR_STEP(c->tally, BEHIND, cube, HSR_FACE(c->ray.hit), here, 0);
    return;
  }
  for (uint32_t p = 0; p < node->n; p++)
    test_face(c, octree->item[node->first + p], cube);
  unsigned nearest = nearest_octant(c, node);
  for (int o = 0; o < 8; o++) {
    uint32_t child = node->child[nearest ^ hsr_octant_order[o]];
    if (child != HSR_NO_NODE)
      visit(c, child);
  }
}

static uint32_t cast(struct caster *c, int i, int j) {
  const struct prepared *p = c->prepared;
  set_ray(c, i, j);
  HSR_STEP(c->tally, RAYS, HSR_THE_WINDOW, HSR_NOTHING, HSR_AT(i, j), 0);
  for (uint32_t k = 0; k < p->n_loose; k++)
    test_face(c, p->loose[k], HSR_NOTHING);
  if (p->octree.n_items)
    visit(c, 0);
  if (c->ray.hit != HSR_BACKGROUND)
    HSR_STEP(c->tally, SHOWN, HSR_FACE(c->ray.hit), HSR_THE_WINDOW,
             HSR_AT(i, j), 0);
  return c->ray.hit;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct caster c = {
      .job = job, .prepared = job->prepared, .tally = job->tally};
  c.known = HSR_NEW_ZEROED(job->scratch, unsigned char, job->world->n_faces);
  c.met = HSR_NEW_ZEROED(job->scratch, uint32_t, job->world->n_faces);
  if (!c.known || !c.met ||
      hsr_screen_init(&c.screen, job->world, job->view, job->scratch))
    return hsr_fail_nomem(err);
  hsr_screen_vertices(&c.screen);
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      hsr_job_row(job, j)[i] = cast(&c, i, j);
  return HSR_OK;
}

/* --- Once for all frames -------------------------------------------------- */

/* The faces that go into cubes. */
struct placed {
  const struct hsr_world *world;
  uint32_t *face;
};

static struct hsr_box face_bounds(const void *context, uint32_t k) {
  const struct placed *placed = context;
  struct hsr_loop loop = hsr_face_loop(placed->world, placed->face[k]);
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t c = 0; c < loop.n; c++) {
    uint32_t v = loop.vertex[c];
    const double at[3] = {loop.x[v], loop.y[v], loop.z[v]};
    for (int a = 0; a < 3; a++) {
      box.lo[a] = hsr_min(box.lo[a], at[a]);
      box.hi[a] = hsr_max(box.hi[a], at[a]);
    }
  }
  return box;
}

/* Every face is small: it goes into each octant that it meets. */
static double no_area(const void *context, uint32_t k) {
  (void)context;
  (void)k;
  return -1;
}

static unsigned face_meets(const void *context, uint32_t k,
                           const struct hsr_eight_boxes *boxes) {
  const struct placed *placed = context;
  const struct hsr_mesh *mesh = &placed->world->mesh;
  uint32_t f = placed->face[k];
  const double normal[3] = {mesh->nx[f], mesh->ny[f], mesh->nz[f]};
  return hsr_boxes_that_meet_polygon(boxes, hsr_face_loop(placed->world, f),
                                     normal, 0);
}

static enum hsr_status build_octree(struct prepared *p,
                                    const struct placed *placed, uint32_t n) {
  static const struct hsr_octree_rule rule = {
      .small = 1, .most = 8, .least = 1};
  struct hsr_primitives primitives = {n, placed, face_bounds, no_area,
                                      face_meets};
  struct hsr_box all = {{0, 0, 0}, {0, 0, 0}};
  double side = 0;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_box box = face_bounds(placed, k);
    for (int a = 0; a < 3; a++) {
      all.lo[a] = k ? hsr_min(all.lo[a], box.lo[a]) : box.lo[a];
      all.hi[a] = k ? hsr_max(all.hi[a], box.hi[a]) : box.hi[a];
    }
  }
  for (int a = 0; a < 3; a++)
    side = hsr_max(side, all.hi[a] - all.lo[a]);
  return hsr_octree_init(&p->octree, &primitives, &rule, all.lo, side,
                         placed->world->roster.scene->threads, &p->arena);
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  (void)option;
  struct prepared *p = calloc(1, sizeof *p);
  struct placed placed = {
      world, malloc(((size_t)world->n_faces + 1) * sizeof *placed.face)};
  uint32_t n = 0;
  *prepared = p;
  bool good = p && placed.face &&
              (p->loose = HSR_NEW(&p->arena, uint32_t, world->n_faces));
  for (uint32_t f = 0; good && f < world->n_faces; f++)
    if (world->mesh.deviation[f] > 0)
      p->loose[p->n_loose++] = f;
    else
      placed.face[n++] = f;
  good = good && !build_octree(p, &placed, n);
  for (uint32_t k = 0; good && k < p->octree.n_items; k++)
    p->octree.item[k] = placed.face[p->octree.item[k]];
  free(placed.face);
  return good ? HSR_OK : hsr_fail_nomem(err);
}

static void release(void *prepared) {
  struct prepared *p = prepared;
  hsr_arena_free(&p->arena);
  free(p);
}

static void show(const void *prepared, struct hsr_shown *shown) {
  shown->octree = &((const struct prepared *)prepared)->octree;
}

/* Rays, and those faces which every ray tests. */
static double expense(const struct hsr_world *world,
                      const struct hsr_view *view) {
  double n_loose = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    n_loose += world->mesh.deviation[f] > 0;
  return (double)view->m * view->n * (1 + n_loose);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [RAYS] = {"rays", "rays cast", HSR_ACTIVATE, HSR_OF_WINDOW, HSR_OF_NOTHING},
    [CUBES] = {"cubes visited", "octree cubes compared with a ray", HSR_COMPARE,
               HSR_OF_CELL, HSR_OF_WINDOW, "missed|met"},
    [BEHIND] = {"cubes behind", "of the cubes met, those behind the ray's hit",
                HSR_REJECT, HSR_OF_CELL, HSR_OF_FACE},
    [FACES] = {"faces met", "in cubes that rays enter, or in no cube",
               HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_CELL},
    [AGAIN] = {"faces repeated", "met again by the same ray", HSR_REJECT,
               HSR_OF_FACE, HSR_OF_WINDOW},
    [TESTS] = {"ray tests", "rays tested against faces", HSR_SAMPLE,
               HSR_OF_FACE, HSR_OF_WINDOW, "missed|hit"},
    [DEPTHS] = {"depth tests", "hits of one ray compared in depth", HSR_COMPARE,
                HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [SHOWN] = {"samples shown", "samples at which a face is visible",
               HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each sample, cast a ray", HSR_RAISES(RAYS)},
    {"  visit the root; at a cube: does the ray meet it?", HSR_RAISES(CUBES)},
    {"    look no farther if it is behind what was hit", HSR_RAISES(BEHIND)},
    {"    for each face in the cube", HSR_RAISES(FACES)},
    {"      skip it if this ray has met it already", HSR_RAISES(AGAIN)},
    {"      does the ray hit it?", HSR_RAISES(TESTS)},
    {"      is it nearer than the nearest hit so far?", HSR_RAISES(DEPTHS)},
    {"    visit the eight octants from front to back"},
    {"  show the nearest hit", HSR_RAISES(SHOWN)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "XYZ", "octree", "once for all frames"},
    {"cubes", "Z", "fixed order of octants", "once a ray"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(octree_raycast) = {
    .name = "octree-raycast",
    .title = "Ray casting through an octree",
    .authors = "S. Rubin and T. Whitted; A. Glassner",
    .year = 1980,
    .source = "Rubin and Whitted, SIGGRAPH 1980; Glassner, IEEE Computer "
              "Graphics and Applications 4(10), 1984; Greene, PhD thesis, UC "
              "Santa Cruz, 1995, 2.1.4",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "(XY)Z",
    .coherence = "of objects, in space",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .counters = counters,
    .outline = outline,
    .expense = expense,
    .prepare = prepare,
    .render = render,
    .release = release,
    .show = show};
