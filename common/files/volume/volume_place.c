/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/volume/volume_check.h"

#include <math.h>

/* Of a sine. Headers in floats have turns by a quarter that are wrong by this
 * much; over 1,000 samples it is a hundredth of one. */
static const double STRAIGHT = 1e-5;

static double length_of(const double v[3]) {
  return hypot(hypot(v[0], v[1]), v[2]);
}

static double determinant(const double m[3][3]) {
  double sum = 0;
  for (int a = 0; a < 3; a++) {
    int b = (a + 1) % 3, c = (a + 2) % 3;
    sum += m[0][a] * (m[1][b] * m[2][c] - m[1][c] * m[2][b]);
  }
  return sum;
}

/* Whether steps are finite, and not all in one plane. */
static bool is_frame(const struct hsr_volume_frame *frame) {
  double unit[3][3];
  for (int f = 0; f < 3; f++) {
    double length = length_of(frame->step[f]);
    if (!(length > 0) || !isfinite(length) || !isfinite(frame->origin[f]))
      return false;
    for (int a = 0; a < 3; a++)
      unit[f][a] = frame->step[f][a] / length;
  }
  return fabs(determinant(unit)) > 1e-6;
}

/* Of the six ways to pair axes, that by which they are nearest. */
static void pair_axes(const struct hsr_volume_frame *frame, int axis[3]) {
  static const int way[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  double most = -1;
  for (int k = 0; k < 6; k++) {
    double sum = 0;
    for (int a = 0; a < 3; a++) {
      const double *step = frame->step[way[k][a]];
      sum += fabs(step[a]) / length_of(step);
    }
    if (!(sum > most))
      continue;
    most = sum;
    for (int a = 0; a < 3; a++)
      axis[a] = way[k][a];
  }
}

/* The tangent of the turn that is left out: the greatest of the axes'. */
static double turn_of(const struct hsr_volume_frame *frame, const int axis[3]) {
  double most = 0;
  for (int a = 0; a < 3; a++) {
    const double *step = frame->step[axis[a]];
    most =
        fmax(most, hypot(step[(a + 1) % 3], step[(a + 2) % 3]) / fabs(step[a]));
  }
  return most;
}

/* Where the middle of all samples is along an axis of the world. */
static double middle_of(const struct hsr_volume_file *file,
                        const struct hsr_volume_frame *frame, int a) {
  double middle = frame->origin[a];
  for (int f = 0; f < 3; f++)
    middle += frame->step[f][a] * (file->n[f] - 1) / 2;
  return middle;
}

enum hsr_status hsr_volume_settle(struct hsr_volume_file *file,
                                  const struct hsr_volume_frame *frame,
                                  struct hsr_error *err) {
  struct hsr_volume_place *place = &file->place;
  if (!is_frame(frame))
    return hsr_volume_refuse(file, err,
                             "its header has axes that are no frame: a step is "
                             "0 or no number, or all lie in one plane");
  pair_axes(frame, place->axis);
  double turn = turn_of(frame, place->axis);
  for (int a = 0; a < 3; a++) {
    int f = place->axis[a];
    const double *step = frame->step[f];
    place->step[a] = step[a];
    place->first[a] = frame->origin[a];
    if (turn <= STRAIGHT)
      continue;
    place->step[a] = copysign(length_of(step), step[a]);
    place->first[a] =
        middle_of(file, frame, a) - place->step[a] * (file->n[f] - 1) / 2;
  }
  if (turn > STRAIGHT)
    hsr_volume_note(file,
                    "its axes are oblique, and a grid's are not: a turn of "
                    "%.3g degrees is left out; the centre and the spacings "
                    "are kept",
                    atan(turn) * 180 / 3.14159265358979323846);
  file->has_place = true;
  return HSR_OK;
}

void hsr_volume_find_way(struct hsr_volume_file *file) {
  struct hsr_volume_way *way = &file->way;
  const ptrdiff_t step[3] = {1, file->n[0], (ptrdiff_t)file->n[0] * file->n[1]};
  way->first = 0;
  for (int a = 0; a < 3; a++) {
    int f = file->has_place ? file->place.axis[a] : a;
    bool is_turned = file->has_place && file->place.step[a] < 0;
    way->n[a] = file->n[f];
    way->step[a] = is_turned ? -step[f] : step[f];
    way->first += is_turned ? step[f] * (ptrdiff_t)(file->n[f] - 1) : 0;
  }
}
