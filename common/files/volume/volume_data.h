/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An open volume; for common/files/volume and common/files/vtk. */
#ifndef HSR_COMMON_FILES_VOLUME_DATA_H
#define HSR_COMMON_FILES_VOLUME_DATA_H

#include "common/grids/grid.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Samples that are somewhere. `slice` is as in hsr_grid_samples, but any slice
 * may be asked for at any time. */
struct hsr_volume {
  uint32_t n[3];
  double *position[3]; /* n of each axis; malloc'ed, freed with the volume */
  enum hsr_status (*slice)(void *data, uint32_t k, float *density,
                           struct hsr_error *err);
  void (*close)(void *data); /* frees data; NULL if there are none */
  void *data;
};

enum { HSR_VOLUME_MOST = 1 << 20 }; /* samples along an axis */

/* A format that VTK reads. */
enum hsr_volume_format {
  HSR_NIFTI,
  HSR_META_IMAGE,
  HSR_VTK_LEGACY,
  HSR_VTK_IMAGE, /* .vti */
  HSR_VTK_GRID   /* .vtr */
};

/* A file that was checked: VTK may read it. */
struct hsr_volume_file {
  enum hsr_volume_format format;
  const char *path; /* borrowed */
  uint32_t n[3];    /* what it holds */
  bool is_rectilinear;
  char *text; /* of VTK's own formats: all that VTK is to see; malloc'ed */
  size_t size;
};

/* Checks that a file holds what its header claims, and nothing that VTK would
 * take on trust. file->format and path are set; file->text is freed by the
 * caller, also after a failure. HSR_E_INPUT, HSR_E_NOMEM, HSR_E_INTERNAL. */
enum hsr_status hsr_volume_check(struct hsr_volume_file *file,
                                 struct hsr_error *err);

/* The part of hsr_volume_check for HSR_VTK_IMAGE and HSR_VTK_GRID:
 * file->is_rectilinear is set, and file->text is all of the file. Blanks what
 * VTK is not to see. HSR_E_INPUT, also in a build without VTK; HSR_E_NOMEM;
 * HSR_E_INTERNAL. */
enum hsr_status hsr_volume_scan_xml(struct hsr_volume_file *file,
                                    struct hsr_error *err);

/* Opens a checked file through VTK. HSR_E_INPUT, also in a build without VTK;
 * HSR_E_NOMEM; HSR_E_INTERNAL. *volume is empty after a failure. */
enum hsr_status hsr_volume_open_vtk(struct hsr_volume *volume,
                                    const struct hsr_volume_file *file,
                                    struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
