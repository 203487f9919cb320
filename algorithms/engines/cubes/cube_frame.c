/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    u = 2^-53; S the view's screen matrix; M, m the instance's; r the
 *             largest coordinate of a cube, at most 3 times the object's reach
 *             (its root cube is as long as its longest side); |.| by entries.
 *
 * Error. What a cube holds lies, in the world, within 16 u (|M| r + |m|) of the
 * cube as an exact transformation has it (algorithms/engines/cubes/cubes.c).
 * grow is 2^-45 (|M| r + |m|), which holds that and the rounding of the
 * transformed box, by far.
 *
 * In (w sx, w sy, w), rows = S M and origin = S (m - E) carry a few roundings,
 * S itself 2u; a corner's sums a few more: all is within e = 2^-44 |S| (|M| r +
 * |m| + |E|), by coordinates, together with what was said above. If w >= 2^20
 * e_w, then 1/w is within 2^-19 of itself; sx moves by at most (e_x + |sx| e_w)
 * / w, which is less than 2^-4 + 2^-20 |sx| if w >= 2^4 e_x too, and so less
 * than HSR_CUBE_MARGIN up to the guard band, beyond which it matters no more.
 * `least` is the larger of these. Rounding to float adds 2^-24; q is taken
 * 2^-18 larger, so that it is never less than the truth.
 *
 * Vertices. A vertex is off by at most 4u (|M| r + |m|); rows by 5u |S| |M|,
 * origin by 6u |S| (|m| + |E|), the sums by 4u of all: 14u in all, less than
 * 2^-5 e. If w >= 2^41 2^-5 e_w and w >= 2^26 2^-5 e_x, then sx, below 2^15, is
 * off by less than 2^-26 + 2^-26 and roundings of 2^-36, so by less than 2^-24.
 * `sure` is the larger of these.
 *
 * Range. 2^-960 more covers what underflows in grow, e and slack, and what of
 * such a size is left of 1e30 times an entry that underflows. Where something
 * overflows, a comparison with it does not hold, and nothing is culled.
 *
 * Parallel. w is 1. A corner's sx is within e_x, since the origin's m/2 and n/2
 * add less than 2^-52 of themselves; there is an image if 2^4 e_x < 1. Row 2
 * makes t, within e_t = 2^-44 |depth| (|M| r + |m| + |E|). q is far - t, taken
 * e_t and 2^-18 of itself larger. The range of depths is that of the root cube,
 * so e_t is below 2^-24 of q. A vertex is sure if e_x is below 2^-21, as above,
 * and its t within 2^-26 of the range.
 *
 * The eye. By Cramer's rule, E' = adj(M) (E - m) / det M, with an error of at
 * most 32 u |adj(M)| (|E| + |m|) / |det M|, as long as det M itself is 2^-20
 * exact; slack is 2^10 times that. A side that may face the eye is tested, so
 * that more are tested than must be. */
#include "algorithms/engines/cubes/cube_frame.h"
#include "common/base/vector.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

/* --- Placing -------------------------------------------------------------- */

/* The eye in the object's coordinates. */
static void place_eye(struct hsr_placing *p, const struct hsr_view *view) {
  double adj[3][3], adj_size[3][3], size[3], det = 0, det_size = 0, v[3];
  for (int k = 0; k < 3; k++) { /* columns of M are rows of the transposed */
    int l = (k + 1) % 3, n = (k + 2) % 3;
    size[k] = 0;
    for (int c = 0; c < 3; c++) {
      int d = (c + 1) % 3, e = (c + 2) % 3;
      double plus = p->m[4 * d + l] * p->m[4 * e + n];
      double minus = p->m[4 * e + l] * p->m[4 * d + n];
      adj[k][c] = plus - minus;
      adj_size[k][c] = fabs(plus) + fabs(minus);
      size[k] += adj_size[k][c] * (fabs(view->E[c]) + fabs(p->m[4 * c + 3]));
    }
    v[k] = view->E[k] - p->m[4 * k + 3];
  }
  const double *F = view->F;
  for (int c = 0; c < 3; c++) {
    det += p->m[4 * c] * adj[0][c];
    det_size += fabs(p->m[4 * c] * adj[0][c]);
  }
  p->slack = TINY;
  for (int k = 0; k < 3; k++) {
    p->eye[k] = (adj[k][0] * v[0] + adj[k][1] * v[1] + adj[k][2] * v[2]) / det;
    p->slack = fmax(p->slack, 0x1p15 * U * size[k] / fabs(det));
  }
  if (!(fabs(det) > 0x1p-24 * det_size && p->slack < INFINITY))
    p->eye[0] = p->eye[1] = p->eye[2] = NAN;
  for (int k = 0; k < 3 && view->parallel; k++) {
    p->from[k] = p->eye[k];
    p->along[k] =
        (adj[k][0] * F[0] + adj[k][1] * F[1] + adj[k][2] * F[2]) / det;
    p->along_error[k] = 0;
    for (int c = 0; c < 3; c++)
      p->along_error[k] += 0x1p-24 * fabs(F[c]) * (adj_size[k][c] / fabs(det));
    p->eye[k] = p->along[k] > p->along_error[k]    ? -INFINITY
                : p->along[k] < -p->along_error[k] ? INFINITY
                                                   : NAN;
    if (p->from[k] != p->from[k])
      p->eye[k] = NAN;
  }
  const double reach[3] = {1, view->m, view->n};
  for (int k = 0; k < 3; k++) {
    p->across_error[k] = 0;
    for (int c = 0; c < 3; c++) {
      const double *ray = view->ray[c];
      p->across[k][c] =
          (adj[k][0] * ray[0] + adj[k][1] * ray[1] + adj[k][2] * ray[2]) / det;
      for (int d = 0; d < 3; d++)
        p->across_error[k] +=
            0x1p-24 * reach[c] * fabs(ray[d]) * (adj_size[k][d] / fabs(det));
    }
  }
}

/* `range` is that of the depths, in parallel. */
static void place(struct hsr_placing *p, const struct hsr_view *view,
                  const double m[12], double reach, double range) {
  double offset[3], far[3], error[3];
  memcpy(p->m, m, sizeof p->m);
  for (int k = 0; k < 3; k++) {
    const double *row = m + 4 * k;
    double size =
        (fabs(row[0]) + fabs(row[1]) + fabs(row[2])) * 3 * reach + fabs(row[3]);
    p->grow[k] = 0x1p-45 * size + TINY;
    far[k] = size + fabs(view->E[k]);
    offset[k] = row[3] - view->E[k];
  }
  for (int k = 0; k < 3; k++) {
    const double *s = k < 2 ? view->screen[k] : view->depth;
    for (int l = 0; l < 3; l++)
      p->way.rows[k][l] = s[0] * m[l] + s[1] * m[4 + l] + s[2] * m[8 + l];
    p->way.origin[k] = s[0] * offset[0] + s[1] * offset[1] + s[2] * offset[2];
    error[k] = 0x1p-44 * (fabs(s[0]) * far[0] + fabs(s[1]) * far[1] +
                          fabs(s[2]) * far[2]) +
               TINY * (1 + fabs(s[0]) + fabs(s[1]) + fabs(s[2]));
    if (k < 2)
      p->way.origin[k] += view->origin[k];
  }
  double e_x = fmax(error[0], error[1]);
  p->way.sure = fmax(0x1p36 * error[2], 0x1p21 * e_x);
  p->least = fmax(0x1p20 * error[2], 0x1p4 * e_x);
  if (view->parallel) {
    p->way.sure = fmax(0x1p26 * error[2] / range, 0x1p21 * e_x);
    p->least = 0x1p4 * e_x < 1 ? error[2] : INFINITY;
  }
  place_eye(p, view);
}

void hsr_cube_instance(struct hsr_cube_frame *frame, uint32_t i) {
  const struct hsr_scene *scene = frame->cubes->scene;
  const struct hsr_instance *instance = &scene->instances[i];
  frame->instance = i;
  frame->object = &frame->cubes->object[instance->object];
  frame->tiler.first_id = frame->job->world->roster.first[i];
  frame->world.mesh.one_sided = scene->objects[instance->object].one_sided
                                    ? frame->one_sided
                                    : frame->two_sided;
  place(&frame->placing, frame->job->view, instance->m, frame->object->reach,
        frame->range);
}

enum hsr_status hsr_cube_loose(const struct hsr_cube_frame *frame,
                               struct hsr_tiler *tiler) {
  const struct hsr_job *job = frame->job;
  *tiler = frame->tiler;
  tiler->few = NULL;
  tiler->lay_out = NULL;
  tiler->id = frame->cubes->loose_id;
  tiler->first_id = 0;
  return hsr_screen_make(&tiler->screen, &frame->cubes->loose, job->view,
                         job->scratch, job->tally);
}

bool hsr_cube_is_new(struct hsr_cube_frame *frame, uint32_t i) {
  uint32_t bit = 1u << i % 32, met = frame->met[i / 32];
  frame->met[i / 32] = met | bit;
  return !(met & bit);
}

/* --- Cubes ---------------------------------------------------------------- */

enum hsr_box_verdict hsr_cube_classify(const struct hsr_cube_frame *frame,
                                       const struct hsr_placing *p,
                                       const struct hsr_octree_box *box,
                                       struct hsr_subject cube) {
  struct hsr_box_work work = {0, 0};
  struct hsr_box grown;
  for (int k = 0; k < 3; k++) {
    const double *row = p->m + 4 * k;
    double centre = row[0] * box->centre[0] + row[1] * box->centre[1] +
                    row[2] * box->centre[2] + row[3];
    double half = fabs(row[0]) * box->half[0] + fabs(row[1]) * box->half[1] +
                  fabs(row[2]) * box->half[2] + p->grow[k];
    grown.lo[k] = centre - half;
    grown.hi[k] = centre + half;
  }
  enum hsr_box_verdict verdict = hsr_box_classify(&frame->frustum, &grown, NULL,
                                                  HSR_COUNTING ? &work : NULL);
  for (unsigned k = 1; HSR_COUNTING && k <= work.deciding; k++)
    HSR_STEP(frame->job->tally, HSR_INEQUALITIES, cube, HSR_THE_WINDOW,
             frame->job->view->window,
             k == work.deciding && verdict == HSR_BOX_OUT);
  return verdict;
}

static unsigned front_sides(const struct hsr_placing *p,
                            const struct hsr_octree_box *box) {
  unsigned front = 0;
  for (int k = 0; k < 3; k++) {
    double off = p->eye[k] - box->centre[k], reach = box->half[k] - p->slack;
    front |= (unsigned)!(off > -reach) << k; /* NaN: all six */
    front |= (unsigned)!(off < reach) << (k + 3);
  }
  return front;
}

/* In parallel: base and step make sx, sy and t. `more` is the error of t. */
static void parallel_corners(const double *base, double step[3][3], double far,
                             double more, struct hsr_cube_image *image) {
  for (int o = 0; o < 8; o++) {
    double i = o & 1 ? 1 : -1, j = o & 2 ? 1 : -1, k = o & 4 ? 1 : -1;
    double t = base[2] + i * step[2][0] + j * step[2][1] + k * step[2][2];
    image->x[o] = base[0] + i * step[0][0] + j * step[0][1] + k * step[0][2];
    image->y[o] = base[1] + i * step[1][0] + j * step[1][1] + k * step[1][2];
    image->q[o] = fmaxf((float)((far - t + more) * (1 + 0x1p-18)), FLT_MIN);
  }
}

HSR_VECTOR static void corners(const double *restrict base,
                               double step[restrict 3][3], double *restrict x,
                               double *restrict y, float *restrict q) {
  static const double sign[3][8] = {{-1, 1, -1, 1, -1, 1, -1, 1},
                                    {-1, -1, 1, 1, -1, -1, 1, 1},
                                    {-1, -1, -1, -1, 1, 1, 1, 1}};
  for (int o = 0; o < 8; o++) {
    double i = sign[0][o], j = sign[1][o], k = sign[2][o];
    double w = base[2] + i * step[2][0] + j * step[2][1] + k * step[2][2];
    double r = 1 / w;
    x[o] = (base[0] + i * step[0][0] + j * step[0][1] + k * step[0][2]) * r;
    y[o] = (base[1] + i * step[1][0] + j * step[1][1] + k * step[1][2]) * r;
    q[o] = (float)(r * (1 + 0x1p-18));
  }
}

bool hsr_cube_project(const struct hsr_cube_frame *frame,
                      const struct hsr_placing *p,
                      const struct hsr_octree_box *box,
                      struct hsr_cube_image *image) {
  double base[3], step[3][3];
  for (int k = 0; k < 3; k++) {
    const double *row = p->way.rows[k];
    base[k] = row[0] * box->centre[0] + row[1] * box->centre[1] +
              row[2] * box->centre[2] + p->way.origin[k];
    for (int l = 0; l < 3; l++)
      step[k][l] = row[l] * box->half[l];
  }
  const struct hsr_view *view = frame->job->view;
  double w = base[2] - fabs(step[2][0]) - fabs(step[2][1]) - fabs(step[2][2]);
  double least = view->parallel ? view->near + p->least
                                : fmax(p->least, view->near * (1 + 0x1p-16));
  if (!(w > least))
    return false;
  if (view->parallel)
    parallel_corners(base, step, frame->tiler.far, p->least, image);
  else
    corners(base, step, image->x, image->y, image->q);
  image->nearest = image->q[0];
  for (int o = 1; o < 8; o++)
    if (image->q[o] > image->nearest)
      image->nearest = image->q[o];
  image->front = front_sides(p, box);
  return true;
}

const unsigned char hsr_cube_side[6][4] = {{0, 2, 6, 4}, {0, 1, 5, 4},
                                           {0, 1, 3, 2}, {1, 3, 7, 5},
                                           {2, 3, 7, 6}, {4, 5, 7, 6}};

/* The samples from lo to hi, of those in [first, end). */
static bool samples_between(double lo, double hi, double sample0, int *first,
                            int *end) {
  lo = ceil(lo - HSR_CUBE_MARGIN - sample0);
  hi = floor(hi + HSR_CUBE_MARGIN - sample0) + 1;
  if (!(lo < *end && hi > *first && lo < hi))
    return false;
  if (lo > *first)
    *first = (int)lo;
  if (hi < *end)
    *end = (int)hi;
  return true;
}

bool hsr_cube_bounds(const struct hsr_cube_frame *frame,
                     const struct hsr_cube_image *image,
                     const unsigned char *corner, int n_corners,
                     struct hsr_bounds *b) {
  const struct hsr_view *view = frame->job->view;
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (int k = 0; k < n_corners; k++) {
    double x = image->x[corner[k]], y = image->y[corner[k]];
    x0 = x < x0 ? x : x0;
    x1 = x > x1 ? x : x1;
    y0 = y < y0 ? y : y0;
    y1 = y > y1 ? y : y1;
  }
  *b = (struct hsr_bounds){view->window.x0, view->window.y0, view->window.x1,
                           view->window.y1};
  return samples_between(x0, x1, hsr_sample_x(view, 0), &b->x0, &b->x1) &&
         samples_between(y0, y1, hsr_sample_y(view, 0), &b->y0, &b->y1);
}

/* In parallel: the ray is at `at` where along t = at - from - across (1, sx,
 * sy). */
static struct hsr_side_depth parallel_depth(const struct hsr_placing *p, int k,
                                            double at, double far,
                                            float nearest) {
  if (!(fabs(p->along[k]) > 0x1p20 * p->along_error[k]))
    return (struct hsr_side_depth){0, 0, nearest};
  double inverse = 1 / p->along[k], t = (at - p->from[k] - p->across[k][0]);
  double error = p->slack + 0x1p6 * p->across_error[k] +
                 0x1p-19 * (fabs(at) + fabs(p->from[k]));
  return (struct hsr_side_depth){p->across[k][1] * inverse,
                                 p->across[k][2] * inverse,
                                 far - t * inverse + error * fabs(inverse)};
}

struct hsr_side_depth hsr_cube_side_depth(const struct hsr_cube_frame *frame,
                                          const struct hsr_placing *p,
                                          const struct hsr_octree_box *box,
                                          const struct hsr_cube_image *image,
                                          int side) {
  int k = side % 3;
  double far = frame->tiler.far;
  double at = box->centre[k] + (side < 3 ? -box->half[k] : box->half[k]);
  if (frame->job->view->parallel)
    return parallel_depth(p, k, at, far, image->nearest);
  double away = at - p->eye[k];
  if (!(fabs(away) > 0x1p20 * p->slack))
    return (struct hsr_side_depth){0, 0, image->nearest};
  double inverse = (1 + 0x1p-18) / away;
  return (struct hsr_side_depth){
      p->across[k][1] * inverse, p->across[k][2] * inverse,
      p->across[k][0] * inverse + p->across_error[k] * fabs(inverse)};
}

int hsr_cube_nearest(const struct hsr_placing *p,
                     const struct hsr_octree_node *node) {
  return (p->eye[0] > node->centre[0]) | (p->eye[1] > node->centre[1]) << 1 |
         (p->eye[2] > node->centre[2]) << 2;
}

/* --- Cells ---------------------------------------------------------------- */

/* hsr_instance_vertex of many, rounded alike. */
HSR_VECTOR static void to_world(size_t n, const double *restrict m,
                                const double *restrict x,
                                const double *restrict y,
                                const double *restrict z, double *restrict wx,
                                double *restrict wy, double *restrict wz) {
  for (size_t v = 0; v < n; v++) {
    wx[v] = ((m[0] * x[v] + m[1] * y[v]) + m[2] * z[v]) + m[3];
    wy[v] = ((m[4] * x[v] + m[5] * y[v]) + m[6] * z[v]) + m[7];
    wz[v] = ((m[8] * x[v] + m[9] * y[v]) + m[10] * z[v]) + m[11];
  }
}

/* The cell that is laid out, in the world and on the screen. */
static void lay_out(void *context) {
  struct hsr_cube_frame *frame = context;
  const struct hsr_cubes_object *object = frame->object;
  struct hsr_world *world = &frame->world;
  size_t v = frame->cell->first_vertex;
  to_world(world->mesh.n_vertices, frame->placing.m, object->x + v,
           object->y + v, object->z + v, world->mesh.x, world->mesh.y,
           world->mesh.z);
  hsr_screen_vertices(&frame->tiler.screen);
}

/* Most cells are so far away that their vertices need not be laid out. */
const struct hsr_cell *hsr_cube_cell(struct hsr_cube_frame *frame,
                                     uint32_t place) {
  const struct hsr_cubes_object *object = frame->object;
  const struct hsr_cell *cell = &object->cell[place];
  struct hsr_world *world = &frame->world;
  struct hsr_tiler *tiler = &frame->tiler;
  struct hsr_placing *p = &frame->placing;
  size_t v = cell->first_vertex;
  frame->cell = cell;
  world->mesh.n_vertices = cell->n_vertices;
  world->n_faces = cell->n_faces;
  world->mesh.start = object->start + cell->first_start;
  world->mesh.vertex = object->vertex + cell->first_corner;
  tiler->id = object->face + cell->first_face;
  tiler->context = frame;
  tiler->lay_out = lay_out;
  if (!hsr_tiler_snap_far(tiler, cell->n_vertices, object->x + v, object->y + v,
                          object->z + v, &p->way)) {
    tiler->lay_out = NULL;
    lay_out(frame);
    hsr_tiler_snap(tiler);
  }
  return cell;
}

/* A fan of triangles is its polygon as the tiler needs it. The polygon is
 * convex and flat, and its instance is exact (cube_objects.c), so its image is
 * convex if it is before the eye; a triangle with a corner that is not takes the
 * general way. A sample that a fast triangle covers for certain lies farther
 * inside than its corners were moved by snapping; so it is on the triangle's
 * side of the lines to both neighbours, and in no other triangle. A sample that
 * none covers perhaps is outside of all. All others are put to the face
 * itself. */
uint32_t hsr_cube_fans(struct hsr_cube_frame *frame, struct hsr_cube_fans *fans,
                       uint32_t f, uint32_t end, int *n) {
  struct hsr_world *world = &frame->world;
  const uint32_t *start = world->mesh.start;
  uint32_t made = 0;
  for (; f < end && made + start[f + 1] - start[f] - 2 <= HSR_BATCH; f++) {
    const uint32_t *v = world->mesh.vertex + start[f];
    for (uint32_t k = 1; k + 1 < start[f + 1] - start[f]; k++, made++) {
      fans->vertex[3 * made] = v[0];
      fans->vertex[3 * made + 1] = v[k];
      fans->vertex[3 * made + 2] = v[k + 1];
      fans->face[made] = f;
    }
  }
  fans->list = (struct hsr_triangle_list){fans->vertex, fans->face,
                                          world->mesh.one_sided};
  frame->tiler.list = &fans->list;
  *n = (int)made;
  return f;
}

/* The end of the triangles of one face, from the k-th on. */
static int face_end(const struct hsr_tiler *t, const struct hsr_batch *b,
                    int k) {
  uint32_t face = hsr_tiler_face(t, b, k++);
  while (k < b->n && hsr_tiler_face(t, b, k) == face)
    k++;
  return k;
}

void hsr_cube_join_looked_at(const struct hsr_tiler *t, struct hsr_batch *b) {
  int drop[HSR_BATCH], generally[HSR_BATCH], fast = 0;
  if (!b->general)
    return;
  for (int k = 0, end; k < b->n; k = end) {
    end = face_end(t, b, k);
    generally[k] = 0;
    for (int l = k; l < end; l++)
      generally[k] |= b->fate[l] == HSR_GENERALLY;
    for (int l = k; l < end; l++)
      if (b->fate[l] == HSR_TILE)
        drop[fast++] = generally[k];
  }
  hsr_tiler_drop(b, drop);
  for (int k = 0, end; k < b->n; k = end) {
    end = face_end(t, b, k);
    for (int l = k; l < end && generally[k]; l++)
      b->fate[l] = l == k ? HSR_GENERALLY : HSR_DROP;
  }
}

void hsr_cube_join_set_up(struct hsr_batch *b) {
  for (int k = 0, end; k < b->n_fast && b->general; k = end) {
    end = hsr_cube_fan_end(b, k);
    bool all = true;
    for (int l = k; l < end; l++)
      all &= b->good[l] != 0;
    for (int l = k; l < end && !all; l++) {
      b->good[l] = 0;
      b->fate[b->place[l]] = l == k ? HSR_GENERALLY : HSR_DROP;
    }
  }
}

/* --- A frame -------------------------------------------------------------- */

/* How far away, in units of |D| > F, the farthest point of a box is, and more.
 */
static double farthest(const struct hsr_view *view,
                       const struct hsr_octree_node *root) {
  double far = 1;
  for (int k = 0; k < 3; k++)
    far += fabs(root->centre[k] - view->E[k]) + root->half;
  return 2 * far + 2 * view->near;
}

/* In parallel: how far all that is in the root cube may lie along F. */
static void set_range(struct hsr_cube_frame *frame,
                      const struct hsr_octree_node *root) {
  const struct hsr_view *view = frame->job->view;
  double centre = 0, half = 0, size = 0;
  for (int k = 0; k < 3; k++) {
    double along = view->depth[k], from = root->centre[k] - view->E[k];
    centre += along * from;
    half += fabs(along) * root->half * (1 + 0x1p-20);
    size += fabs(along) * (fabs(from) + root->half);
  }
  hsr_tiler_set_range(&frame->tiler, centre - half, centre + half, size);
  frame->range = frame->tiler.far - (centre + half);
}

enum hsr_status hsr_cube_frame_begin(struct hsr_cube_frame *frame,
                                     const struct hsr_job *job,
                                     const struct hsr_cubes *cubes) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  struct hsr_arena *arena = job->scratch;
  struct hsr_tiler *tiler = &frame->tiler;
  struct hsr_world *world = &frame->world;
  const struct hsr_octree_node *root = &cubes->octree.node[0];
  uint32_t most_sides =
      cubes->most_faces > HSR_BATCH ? cubes->most_faces : HSR_BATCH;
  frame->job = job;
  frame->cubes = cubes;
  hsr_frustum_init(&frame->frustum, job->view, farthest(job->view, root));
  hsr_tiler_begin(tiler, job);
  if (job->view->parallel)
    set_range(frame, root);
  place(&frame->as_it_is, job->view, identity,
        fabs(root->centre[0]) + fabs(root->centre[1]) + fabs(root->centre[2]) +
            root->half,
        frame->range);

  *world = (struct hsr_world){.roster.scene = cubes->scene,
                              .mesh.n_vertices = cubes->most_vertices,
                              .n_faces = cubes->most_faces,
                              .mesh.n_corners = cubes->most_corners,
                              .roster.first = job->world->roster.first};
  tiler->few = world;
  tiler->pair = &frame->pair;
  tiler->corner = HSR_NEW(arena, struct hsr_corner, cubes->most_vertices);
  tiler->columns =
      HSR_NEW(arena, int, (size_t)hsr_largest_face(cubes->scene) + 4);
  frame->two_sided = HSR_NEW_ZEROED(arena, bool, most_sides);
  frame->one_sided = HSR_NEW(arena, bool, most_sides);
  frame->met = HSR_NEW_ZEROED(arena, uint32_t,
                              cubes->scene->n_instances / 32 + (size_t)1);
  if (!tiler->corner || !tiler->columns || !frame->two_sided ||
      !frame->one_sided || !frame->met || hsr_world_allocate(world, arena) ||
      hsr_screen_init(&tiler->screen, world, job->view, arena) ||
      hsr_pair_init(&frame->pair, job->world, job->view, arena))
    return HSR_E_NOMEM;
  memset(frame->one_sided, 1, most_sides * sizeof *frame->one_sided);
  return HSR_OK;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"inequalities", "of appendix A, to tell where nodes lie", HSR_COMPARE,
     HSR_OF_CELL, HSR_OF_WINDOW, "leaves it open|outside", .key = "inequality"},
    {NULL}};

const struct hsr_part hsr_inequalities_part = {
    HSR_PART_INEQUALITIES, counters, NULL, NULL, {NULL}};
