/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes that are open; for common/files/volume and common/files/vtk. */
#ifndef HSR_COMMON_FILES_VOLUME_DATA_H
#define HSR_COMMON_FILES_VOLUME_DATA_H

#include "common/grids/grid.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The samples of an open volume. `slice` is as in hsr_grid_samples, but it may
 * be called for any k at any time. */
struct hsr_volume {
  uint32_t n[3];
  double *position[3]; /* n along each axis; malloc'ed, freed with the volume */
  enum hsr_status (*slice)(void *data, uint32_t k, float *density,
                           struct hsr_error *err);
  void (*close)(void *data); /* frees `data`; NULL: nothing is to be freed */
  void *data;
};

enum { HSR_VOLUME_MOST = 1 << 20 }; /* most samples along an axis */

/* A format that VTK reads. */
enum hsr_volume_format {
  HSR_NIFTI,
  HSR_META_IMAGE,
  HSR_VTK_LEGACY,
  HSR_VTK_IMAGE, /* .vti */
  HSR_VTK_GRID   /* .vtr */
};

/* A file that is checked before VTK reads it. */
struct hsr_volume_file {
  enum hsr_volume_format format;
  const char *path;    /* borrowed */
  uint32_t n[3];       /* samples along each axis */
  bool is_rectilinear; /* a rectilinear grid, not an image */
  char *text;  /* of VTK's own formats: the bytes that VTK reads; malloc'ed */
  size_t size; /* of the text */
};

/* Checks that a file holds what its header claims, and nothing that VTK would
 * believe without a check. The caller sets file->format and path. The function
 * sets the rest. The caller frees file->text, also after a failure.
 * HSR_E_INPUT, HSR_E_NOMEM, HSR_E_INTERNAL. */
enum hsr_status hsr_volume_check(struct hsr_volume_file *file,
                                 struct hsr_error *err);

/* The part of hsr_volume_check for HSR_VTK_IMAGE and HSR_VTK_GRID. Before the
 * call, file->is_rectilinear is set and file->text is all of the file. Parts
 * that VTK must not see are overwritten by spaces. HSR_E_INPUT, also in a build
 * without VTK; HSR_E_NOMEM; HSR_E_INTERNAL. */
enum hsr_status hsr_volume_scan_xml(struct hsr_volume_file *file,
                                    struct hsr_error *err);

/* Opens a checked file through VTK. After a failure *volume is empty.
 * HSR_E_INPUT, also in a build without VTK; HSR_E_NOMEM; HSR_E_INTERNAL if VTK
 * fails. */
enum hsr_status hsr_volume_open_vtk(struct hsr_volume *volume,
                                    const struct hsr_volume_file *file,
                                    struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
