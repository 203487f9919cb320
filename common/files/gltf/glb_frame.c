/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/gltf/glb_frame.h"

#include <math.h>
#include <string.h>

/* A point or direction in the file's frame: from z up to y up, and scaled. Of a
 * matrix of 3 x 4, column c. */
static void to_frame(const struct hsr_glb_frame *frame, double scale, double *m,
                     int c) {
  const double x = m[c], y = m[4 + c], z = m[8 + c];
  m[c] = scale * x;
  m[4 + c] = scale * (frame->z_up ? z : y);
  m[8 + c] = scale * (frame->z_up ? 0 - y : z);
}

/* Matrices of glTF go by columns. */
static void by_columns(const double m[12], double matrix[16]) {
  for (int c = 0; c < 4; c++)
    for (int r = 0; r < 4; r++)
      matrix[4 * c + r] = r < 3 ? m[4 * r + c] : c == 3;
}

void hsr_glb_place(const struct hsr_glb_frame *frame, const double m[12],
                   const double offset[3], double matrix[16]) {
  double placed[12], origin[3];
  memcpy(placed, m, sizeof placed);
  hsr_instance_vertex(m, offset, origin);
  for (int k = 0; k < 3; k++)
    placed[4 * k + 3] = origin[k];
  for (int c = 0; c < 4; c++)
    to_frame(frame, frame->metres, placed, c);
  by_columns(placed, matrix);
}

bool hsr_glb_mirrors(const double m[12]) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) -
             m[1] * (m[4] * m[10] - m[6] * m[8]) +
             m[2] * (m[4] * m[9] - m[5] * m[8]) <
         0;
}

bool hsr_glb_find_camera(const struct hsr_glb_frame *frame,
                         const struct hsr_camera *camera,
                         struct hsr_glb_camera *out) {
  struct hsr_view view;
  if (hsr_view_init(&view, camera, 1, 1, NULL))
    return false;
  double right = 0, up = 0, distance = 0, m[12];
  for (int k = 0; k < 3; k++) {
    right += view.R[k] * view.R[k];
    up += view.U[k] * view.U[k];
    distance = fmax(distance, fabs(camera->at[k] - camera->eye[k]));
  }
  for (int k = 0; k < 3; k++) {
    m[4 * k] = view.R[k] / sqrt(right);
    m[4 * k + 1] = view.U[k] / sqrt(up);
    m[4 * k + 2] = -view.F[k];
    m[4 * k + 3] = view.E[k];
  }
  const double metres = frame->metres;
  for (int c = 0; c < 4; c++)
    to_frame(frame, c < 3 ? 1 : metres, m, c);
  by_columns(m, out->matrix);
  const double degree = 3.14159265358979323846 / 180;
  out->is_parallel = view.parallel;
  out->size =
      view.parallel ? metres * camera->parallel / 2 : camera->fov * degree;
  out->near = metres * (view.parallel ? camera->near
                                      : fmax(camera->near, distance / 1000));
  out->far = metres * (camera->near + 1000 * distance);
  return true;
}
