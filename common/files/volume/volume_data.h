/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes that are open; for common/files/volume and common/files/vtk. */
#ifndef HSR_COMMON_FILES_VOLUME_DATA_H
#define HSR_COMMON_FILES_VOLUME_DATA_H

#include "common/grids/grid.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The samples of an open volume, along the axes of the world. `slice` is as in
 * hsr_grid_samples, but it may be called for any k at any time. */
struct hsr_volume {
  uint32_t n[3];
  double *position[3]; /* n along each axis; malloc'ed, freed with the volume */
  enum hsr_status (*slice)(void *data, uint32_t k, float *density,
                           struct hsr_error *err);
  void (*close)(void *data); /* frees `data`; NULL: nothing is to be freed */
  void *data;
};

enum { HSR_VOLUME_MOST = 1 << 20 }; /* most samples along an axis */

/* A format of files. */
enum hsr_volume_format {
  HSR_NIFTI,
  HSR_META_IMAGE,
  HSR_NRRD,
  HSR_VTK_LEGACY,
  HSR_VTK_IMAGE, /* .vti */
  HSR_VTK_GRID   /* .vtr */
};

/* What the axes of the world mean. */
enum hsr_volume_space {
  HSR_NO_SPACE, /* the header does not say it */
  HSR_RAS,      /* x to a patient's right, y to the front, z to the head */
  HSR_LPS       /* x to a patient's left, y to the back, z to the head */
};

/* A type of numbers in a file. */
enum hsr_volume_type {
  HSR_NO_TYPE,
  HSR_U8,
  HSR_I8,
  HSR_U16,
  HSR_I16,
  HSR_U32,
  HSR_I32,
  HSR_U64,
  HSR_I64,
  HSR_F32,
  HSR_F64
};

/* Where samples are: sample (i, j, k) of a file, i varying fastest, is at
 * origin + i step[0] + j step[1] + k step[2] in the world. */
struct hsr_volume_frame {
  double origin[3], step[3][3];
};

/* The same along the axes of the world: axis a of the world runs along axis
 * axis[a] of the file, and sample k of that is at first[a] + k step[a]. A step
 * below 0 turns the axis round. */
struct hsr_volume_place {
  int axis[3];
  double first[3], step[3];
};

/* The way through a file's samples along the axes of the world: there are n[a]
 * along axis a, and from one to the next it is step[a] of them, from number
 * `first` on. */
struct hsr_volume_way {
  uint32_t n[3];
  ptrdiff_t first, step[3];
};

enum hsr_volume_encoding {
  HSR_PLAIN,  /* numbers as they are */
  HSR_PACKED, /* by zlib or gzip */
  HSR_TEXT
};

/* Samples that hsr reads, in files: all in one, or, if they are plain, one
 * slice in each. */
struct hsr_volume_bytes {
  char **path; /* `n` malloc'ed paths, malloc'ed; NULL: VTK reads the file */
  size_t n;
  enum hsr_volume_encoding encoding;
  uint64_t offset; /* bytes before the first sample of each file */
  enum hsr_volume_type type;
  bool is_big_endian;
};

/* A file that is checked before it is read. */
struct hsr_volume_file {
  enum hsr_volume_format format;
  const char *path;    /* borrowed */
  uint32_t n[3];       /* samples along each axis of the file */
  bool is_rectilinear; /* a rectilinear grid, not an image */
  bool has_place;      /* `place` is set; else samples are where VTK says */
  struct hsr_volume_place place;
  struct hsr_volume_way way;
  enum hsr_volume_space space;
  double slope, intercept; /* a density is slope times the number in the file,
                              plus intercept */
  struct hsr_volume_bytes bytes;
  char *text;  /* of VTK's own formats: the bytes that VTK reads; malloc'ed */
  size_t size; /* of the text */
  char notes[700]; /* what of the header is not used: lines, each with its
                      newline and the path */
};

/* Checks that a file holds what its header claims, and nothing that VTK would
 * believe without a check. The caller sets file->format and path. The function
 * sets the rest. The caller frees with hsr_volume_file_free, also after a
 * failure. HSR_E_INPUT, HSR_E_NOMEM, HSR_E_INTERNAL. */
enum hsr_status hsr_volume_check(struct hsr_volume_file *file,
                                 struct hsr_error *err);

/* Frees what the file owns. */
void hsr_volume_file_free(struct hsr_volume_file *file);

/* The part of hsr_volume_check for HSR_VTK_IMAGE and HSR_VTK_GRID. Before the
 * call, file->is_rectilinear is set and file->text is all of the file. Parts
 * that VTK must not see are overwritten by spaces. HSR_E_INPUT, also in a build
 * without VTK; HSR_E_NOMEM; HSR_E_INTERNAL. */
enum hsr_status hsr_volume_scan_xml(struct hsr_volume_file *file,
                                    struct hsr_error *err);

/* Opens a checked file that has file->bytes; positions are not set. HSR_E_INPUT
 * if the samples are not what the header claims; HSR_E_NOMEM. */
enum hsr_status hsr_volume_open_bytes(struct hsr_volume *volume,
                                      const struct hsr_volume_file *file,
                                      struct hsr_error *err);

/* Opens a checked file through VTK. Positions are set unless the file has a
 * place. After a failure *volume is empty.
 * HSR_E_INPUT, also in a build without VTK; HSR_E_NOMEM; HSR_E_INTERNAL if VTK
 * fails. */
enum hsr_status hsr_volume_open_vtk(struct hsr_volume *volume,
                                    const struct hsr_volume_file *file,
                                    struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
