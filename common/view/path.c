/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/view/path.h"

#include <math.h>
#include <string.h>

bool hsr_view_has_path(const struct hsr_view *view) {
  return view->before.exists && view->before.parallel == view->parallel;
}

/* --- Vectors -------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double length(const double v[3]) {
  return sqrt(dot(v, v));
}

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* v / |v|. The result is not `v`. */
static void direction(const double v[3], double out[3]) {
  double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
  for (int k = 0; k < 3; k++)
    out[k] = v[k] / largest;
  double size = length(out);
  for (int k = 0; k < 3; k++)
    out[k] /= size;
}

static double mix(double from, double to, double share) {
  return from + share * (to - from);
}

/* --- Frames --------------------------------------------------------------- */

/* Directions of length 1, at right angles; and how long R and U are. */
enum { RIGHT, UP, FORWARD };
struct frame {
  double axis[3][3], R, U;
};

static struct frame frame_of(const double F[3], const double R[3],
                             const double U[3]) {
  struct frame f = {.R = length(R), .U = length(U)};
  direction(R, f.axis[RIGHT]);
  direction(U, f.axis[UP]);
  direction(F, f.axis[FORWARD]);
  return f;
}

/* --- The turn ------------------------------------------------------------- */

/* A turn about an axis of length 1, to the right of who looks along it. The
 * axis is 0 if the angle is. */
struct turn {
  double axis[3], angle;
};

/* The matrix of the turn from one frame to another: the sum of the products of
 * their axes. Its trace, and the differences of opposite entries, `odd`. These
 * are found from the changes of the axes, so that they are small if the changes
 * are, and 0 without one. */
struct matrix {
  double of[3][3], odd[3], trace;
};

static struct matrix matrix_of(const struct frame *from,
                               const struct frame *to) {
  struct matrix m = {.trace = 0};
  for (int i = 0; i < 3; i++) {
    const double *a = from->axis[i], *b = to->axis[i];
    double change[3], odd[3];
    for (int k = 0; k < 3; k++)
      change[k] = b[k] - a[k];
    cross(a, change, odd);
    for (int j = 0; j < 3; j++) {
      m.odd[j] += odd[j];
      for (int k = 0; k < 3; k++)
        m.of[j][k] += b[j] * a[k];
    }
  }
  m.trace = m.of[0][0] + m.of[1][1] + m.of[2][2];
  return m;
}

/* The quaternion of a turn: q[3] is the cosine of half the angle, and q[0 .. 2]
 * are the axis times its sine. The largest of its parts is found first, and the
 * others from it (S. W. Shepperd, "Quaternion from rotation matrix", Journal of
 * Guidance and Control 1, 1978). */
static void quaternion_of(const struct matrix *m, double q[4]) {
  int k = 0;
  for (int a = 1; a < 3; a++)
    k = m->of[a][a] > m->of[k][k] ? a : k;
  if (m->trace >= m->of[k][k]) {
    q[3] = sqrt(1 + m->trace) / 2;
    for (int a = 0; a < 3; a++)
      q[a] = m->odd[a] / (4 * q[3]);
    return;
  }
  q[k] = sqrt(1 + 2 * m->of[k][k] - m->trace) / 2;
  q[3] = m->odd[k] / (4 * q[k]);
  for (int a = (k + 1) % 3; a != k; a = (a + 1) % 3)
    q[a] = (m->of[a][k] + m->of[k][a]) / (4 * q[k]);
}

/* At most half a turn. */
static struct turn turn_of(const struct frame *from, const struct frame *to) {
  struct turn turn = {.angle = 0};
  const struct matrix m = matrix_of(from, to);
  double q[4];
  quaternion_of(&m, q);
  double sine = length(q), sign = q[3] < 0 ? -1 : 1;
  if (sine == 0)
    return turn;
  turn.angle = 2 * atan2(sine, sign * q[3]);
  for (int a = 0; a < 3; a++)
    turn.axis[a] = sign * q[a] / sine;
  return turn;
}

/* v turned about an axis (O. Rodrigues, 1840). The result is not `v`. */
static void rotate(const double axis[3], double angle, const double v[3],
                   double out[3]) {
  double across[3], back[3];
  cross(axis, v, across);
  cross(axis, across, back);
  double half = sin(angle / 2);
  for (int k = 0; k < 3; k++)
    out[k] = v[k] + sin(angle) * across[k] + 2 * half * half * back[k];
}

/* --- The eye -------------------------------------------------------------- */

/* The eye's shift is one part along the axis and one across it. Across it, the
 * eye goes on a circle, whose chord that part is. From the beginning to the
 * share s of an arc of angle 2 h the chord is sin(s h) / sin(h) as long, and it
 * is turned back by (1 - s) h. So the middle of the circle, which may be far
 * away, is not needed. */
static void place_eye(const struct turn *turn, const double from[3],
                      const double to[3], double share, double E[3]) {
  double shift[3], chord[3], turned[3], half = turn->angle / 2;
  for (int k = 0; k < 3; k++)
    shift[k] = to[k] - from[k];
  double along = dot(shift, turn->axis);
  for (int k = 0; k < 3; k++)
    chord[k] = shift[k] - along * turn->axis[k];
  rotate(turn->axis, (share - 1) * half, chord, turned);
  double part = half > 0 ? sin(share * half) / sin(half) : share;
  for (int k = 0; k < 3; k++)
    E[k] = from[k] + share * along * turn->axis[k] + part * turned[k];
}

/* --- The view ------------------------------------------------------------- */

static void take_ends(const struct hsr_view_before *b, struct hsr_view *view) {
  memcpy(view->E, b->E, sizeof view->E);
  memcpy(view->F, b->F, sizeof view->F);
  memcpy(view->R, b->R, sizeof view->R);
  memcpy(view->U, b->U, sizeof view->U);
  view->near = b->near;
}

/* *view is that at the end of the way, and becomes that at `share`. */
static void go_back(const struct frame *from, const struct frame *to,
                    double share, struct hsr_view *view) {
  const struct hsr_view_before *b = &view->before;
  const struct turn turn = turn_of(from, to);
  double right[3], up[3], R = mix(from->R, to->R, share),
                          U = mix(from->U, to->U, share), E[3];
  place_eye(&turn, b->E, view->E, share, E);
  memcpy(view->E, E, sizeof E);
  rotate(turn.axis, share * turn.angle, from->axis[RIGHT], right);
  rotate(turn.axis, share * turn.angle, from->axis[UP], up);
  rotate(turn.axis, share * turn.angle, from->axis[FORWARD], view->F);
  for (int k = 0; k < 3; k++) {
    view->R[k] = R * right[k];
    view->U[k] = U * up[k];
  }
  view->near = mix(b->near, view->near, share);
}

/* A camera of this view. */
static void aim(struct hsr_view *view, const struct frame *frame) {
  struct hsr_camera *c = &view->camera;
  double far[3];
  for (int k = 0; k < 3; k++)
    far[k] = c->at[k] - c->eye[k];
  double distance = length(far);
  for (int k = 0; k < 3; k++) {
    c->eye[k] = view->E[k];
    c->at[k] = view->E[k] + distance * view->F[k];
    c->up[k] = frame->axis[UP][k];
  }
  c->near = view->near;
  if (view->parallel)
    c->parallel = 2 * frame->U;
  else
    c->fov = atan(frame->U) * (360 / 3.14159265358979323846);
}

enum hsr_status hsr_view_between(const struct hsr_view *view, int part,
                                 int parts, struct hsr_view *between,
                                 struct hsr_error *err) {
  const struct hsr_view_before *b = &view->before;
  const struct frame from = frame_of(b->F, b->R, b->U),
                     to = frame_of(view->F, view->R, view->U);
  *between = *view;
  if (part == 0)
    take_ends(b, between);
  else if (part < parts)
    go_back(&from, &to, (double)part / parts, between);
  between->before = (struct hsr_view_before){.exists = false};
  const struct frame now = frame_of(between->F, between->R, between->U);
  aim(between, &now);
  return hsr_view_complete(between, now.axis[RIGHT], now.axis[UP], err);
}
