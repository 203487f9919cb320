/* SPDX-License-Identifier: GPL-3.0-or-later */
/* NIfTI-1 in one file, .nii or .nii.gz.
 *
 * Source      R. W. Cox et al., "nifti1.h", National Institutes of Health,
 *             2003: the header's places, and its three methods to say where
 *             samples are. The frame is the sform's if there is one, else the
 *             qform's, else the spacings alone. */
#include "common/files/volume/volume_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* Where numbers stand in the header. */
enum {
  DIM = 40,
  DATATYPE = 70,
  BITPIX = 72,
  PIXDIM = 76,
  VOX_OFFSET = 108,
  SCL_SLOPE = 112,
  SCL_INTER = 116,
  QFORM_CODE = 252,
  SFORM_CODE = 254,
  QUATERN = 256,
  QOFFSET = 268,
  SROW = 280,
  MAGIC = 344,
  HEADER = 352
};

/* The numbers of a header, of either byte order. */
struct nifti {
  unsigned char bytes[HEADER];
  bool swapped;
};

static long get_short(const struct nifti *h, int at) {
  unsigned lo = h->bytes[at + h->swapped], hi = h->bytes[at + !h->swapped];
  long value = (long)(hi << 8 | lo);
  return value < 0x8000 ? value : value - 0x10000;
}

static double get_real(const struct nifti *h, int at) {
  uint32_t bits = 0;
  for (int k = 0; k < 4; k++)
    bits |= (uint32_t)h->bytes[at + (h->swapped ? 3 - k : k)] << 8 * k;
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

/* Reads the header, and counts all bytes; of a file that is packed, those that
 * it holds. Returns what is wrong, or NULL. */
static const char *read_header(struct nifti *h, const char *path,
                               uint64_t *size) {
  static const unsigned char little[] = {0x5c, 1, 0, 0},
                             big[] = {0, 0, 1, 0x5c},
                             little_2[] = {0x1c, 2, 0, 0},
                             big_2[] = {0, 0, 2, 0x1c};
  gzFile in = gzopen(path, "rb");
  if (!in)
    return "cannot be read";
  unsigned char rest[1 << 14];
  int n = gzread(in, h->bytes, sizeof h->bytes), more = n;
  for (*size = n > 0 ? (uint64_t)n : 0; more > 0;) {
    more = gzread(in, rest, sizeof rest);
    *size += more > 0 ? (uint64_t)more : 0;
  }
  if (gzclose(in) != Z_OK || more < 0)
    *size = 0;
  if (n >= 4 && (!memcmp(h->bytes, little_2, 4) || !memcmp(h->bytes, big_2, 4)))
    return "has a header of NIfTI-2; only NIfTI-1 is read";
  h->swapped = !memcmp(h->bytes, big, 4);
  if (n != HEADER || (!h->swapped && memcmp(h->bytes, little, 4) != 0))
    return "has no header of NIfTI-1";
  if (!memcmp(h->bytes + MAGIC, "ni1", 4))
    return "has a header whose samples are in a file .img; only files with "
           "both are read";
  return memcmp(h->bytes + MAGIC, "n+1", 4) ? "has no header of NIfTI-1" : NULL;
}

static enum hsr_volume_type type_of(const struct nifti *h) {
  switch (get_short(h, DATATYPE)) {
  case 2:
    return HSR_U8;
  case 4:
    return HSR_I16;
  case 8:
    return HSR_I32;
  case 16:
    return HSR_F32;
  case 64:
    return HSR_F64;
  case 256:
    return HSR_I8;
  case 512:
    return HSR_U16;
  case 768:
    return HSR_U32;
  case 1024:
    return HSR_I64;
  case 1280:
    return HSR_U64;
  default:
    return HSR_NO_TYPE;
  }
}

/* --- Densities ------------------------------------------------------------ */

/* A slope of 0 means that numbers are not scaled. */
static void take_scale(struct hsr_volume_file *file, const struct nifti *h) {
  double slope = get_real(h, SCL_SLOPE), intercept = get_real(h, SCL_INTER);
  if (slope == 0)
    return;
  if (!isfinite(slope) || !isfinite(intercept)) {
    hsr_volume_note(file,
                    "its scl_slope %g and scl_inter %g are no numbers, and "
                    "are not used",
                    slope, intercept);
    return;
  }
  file->slope = slope;
  file->intercept = intercept;
}

/* --- Places --------------------------------------------------------------- */

/* A spacing along an axis; 1 where the header has none. */
static double spacing_of(const struct nifti *h, int axis) {
  double spacing = fabs(get_real(h, PIXDIM + 4 * (axis + 1)));
  return spacing > 0 && isfinite(spacing) ? spacing : 1;
}

/* An entry of a turn that floats have made of -1, 0 or 1. */
static double unblurred(double x) {
  double whole = nearbyint(x);
  return fabs(x - whole) < 1e-6 ? whole : x;
}

static void frame_of_qform(const struct nifti *h,
                           struct hsr_volume_frame *frame) {
  double b = get_real(h, QUATERN), c = get_real(h, QUATERN + 4),
         d = get_real(h, QUATERN + 8), square = b * b + c * c + d * d;
  bool is_half = 1 - square < 1e-7; /* a half turn, but for roundings */
  double a = is_half ? 0 : sqrt(1 - square);
  if (is_half) {
    double length = sqrt(square);
    b /= length;
    c /= length;
    d /= length;
  }
  const double turn[3][3] = {
      {a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
      {2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)},
      {2 * (b * d - a * c), 2 * (c * d + a * b),
       a * a + d * d - b * b - c * c}};
  for (int w = 0; w < 3; w++) {
    frame->origin[w] = get_real(h, QOFFSET + 4 * w);
    for (int f = 0; f < 3; f++) {
      double sign = f == 2 && get_real(h, PIXDIM) < 0 ? -1 : 1;
      frame->step[f][w] = sign * unblurred(turn[w][f]) * spacing_of(h, f);
    }
  }
}

static void frame_of_sform(const struct nifti *h,
                           struct hsr_volume_frame *frame) {
  for (int w = 0; w < 3; w++) {
    for (int f = 0; f < 3; f++)
      frame->step[f][w] = get_real(h, SROW + 16 * w + 4 * f);
    frame->origin[w] = get_real(h, SROW + 16 * w + 12);
  }
}

static void frame_of_spacings(struct hsr_volume_file *file,
                              const struct nifti *h,
                              struct hsr_volume_frame *frame) {
  *frame = (struct hsr_volume_frame){.origin = {0, 0, 0}};
  for (int f = 0; f < 3; f++) {
    frame->step[f][f] = spacing_of(h, f);
    if (get_real(h, PIXDIM + 4 * (f + 1)) != frame->step[f][f])
      hsr_volume_note(
          file, "its spacing along %c is %g, which is not used: %g is",
          "xyz"[f], get_real(h, PIXDIM + 4 * (f + 1)), frame -> step[f][f]);
  }
}

/* The greatest distance of a corner in two frames, by a step of the one. */
static double apart(const struct hsr_volume_file *file,
                    const struct hsr_volume_frame *one,
                    const struct hsr_volume_frame *other) {
  double most = 0, step = INFINITY;
  for (int f = 0; f < 3; f++)
    step = fmin(
        step, hypot(hypot(one->step[f][0], one->step[f][1]), one->step[f][2]));
  for (int corner = 0; corner < 8; corner++)
    for (int w = 0; w < 3; w++) {
      double by = one->origin[w] - other->origin[w];
      for (int f = 0; f < 3; f++)
        by += corner >> f & 1
                  ? (file->n[f] - 1) * (one->step[f][w] - other->step[f][w])
                  : 0;
      most = fmax(most, fabs(by));
    }
  return most / step;
}

/* Spacings that differ from the sform's steps by more than a thousandth. */
static void note_spacings(struct hsr_volume_file *file, const struct nifti *h,
                          const struct hsr_volume_frame *frame) {
  for (int f = 0; f < 3; f++) {
    const double *step = frame->step[f];
    double length = hypot(hypot(step[0], step[1]), step[2]);
    if (fabs(length - spacing_of(h, f)) > 1e-3 * length)
      hsr_volume_note(file,
                      "its pixdim says a spacing of %g along axis %d, which is "
                      "not used: its sform says %g",
                      get_real(h, PIXDIM + 4 * (f + 1)), f + 1, length);
  }
}

static enum hsr_status take_frame(struct hsr_volume_file *file,
                                  const struct nifti *h,
                                  struct hsr_error *err) {
  bool has_qform = get_short(h, QFORM_CODE) > 0,
       has_sform = get_short(h, SFORM_CODE) > 0;
  struct hsr_volume_frame frame, other;
  file->space = has_sform || has_qform ? HSR_RAS : HSR_NO_SPACE;
  if (!has_sform && !has_qform)
    frame_of_spacings(file, h, &frame);
  if (has_qform)
    frame_of_qform(h, &frame);
  if (!has_sform)
    return hsr_volume_settle(file, &frame, err);
  other = frame;
  frame_of_sform(h, &frame);
  note_spacings(file, h, &frame);
  if (has_qform && apart(file, &frame, &other) > 0.5)
    hsr_volume_note(file,
                    "its qform puts a corner %.3g samples away from where its "
                    "sform does, and is not used",
                    apart(file, &frame, &other));
  return hsr_volume_settle(file, &frame, err);
}

/* --- The whole ------------------------------------------------------------ */

enum hsr_status hsr_volume_check_nifti(struct hsr_volume_file *file,
                                       struct hsr_error *err) {
  struct nifti h = {.swapped = false};
  uint64_t size = 0;
  enum hsr_status status = hsr_volume_size_of(file->path, &size, err);
  if (status)
    return status;
  const char *wrong = read_header(&h, file->path, &size);
  if (wrong)
    return hsr_volume_refuse(file, err, "%s", wrong);
  long n_axes = get_short(&h, DIM);
  if (n_axes < 3 || n_axes > 7)
    return hsr_volume_refuse(file, err, "has not three axes");
  for (int k = 4; k <= n_axes; k++)
    if (get_short(&h, DIM + 2 * k) != 1)
      return hsr_volume_refuse(file, err, "has more than one number a sample");
  if (!hsr_volume_set_sizes(file, (const long long[3]){get_short(&h, DIM + 2),
                                                       get_short(&h, DIM + 4),
                                                       get_short(&h, DIM + 6)}))
    return hsr_volume_refuse(file, err, "has a size that is not positive");
  int bytes = hsr_volume_type_bytes(type_of(&h));
  if (!bytes || get_short(&h, BITPIX) != 8 * bytes)
    return hsr_volume_refuse(file, err,
                             "has samples of no known type: its datatype is "
                             "%ld, of %ld bits",
                             get_short(&h, DATATYPE), get_short(&h, BITPIX));
  double before = get_real(&h, VOX_OFFSET);
  if (!(before >= HEADER) || !hsr_volume_can_hold(file, size, before, bytes))
    return hsr_volume_refuse(file, err,
                             "is too short for the samples that it claims");
  take_scale(file, &h);
  return take_frame(file, &h, err);
}
