/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes and height maps from files, as scenes of a grid.
 *
 * Read through VTK: .nii .nii.gz (NIfTI), .mhd .mha (MetaImage), .vtk
 * (structured points and rectilinear grids), .vti (images) and .vtr
 * (rectilinear grids), the samples being data of points. Through OpenImageIO:
 * height maps, as "heights-of:" and any picture that it reads. By itself: bytes
 * without a header. A sample that is not a finite number is not kept.
 *
 * Words follow the name, each after a colon:
 *
 *   least=X most=X  a sample is kept if its density lies within; standard: from
 *                   half way between the least and the greatest of the file
 *   gradient=X      and if the density's gradient has this size at least
 *   sides=all       the sides between two kept cells are faces, too
 *   size=NXxNYxNZ   of bytes without a header, which have this word, and may
 *   type=T          have these: u8, i8, u16, i16, f32 with -le or -be behind
 *                   those of more bytes (standard: u8);
 *   offset=N        bytes before the first sample (standard: 0);
 *   spacing=XxYxZ   of samples (standard: 1x1x1)
 *   levels=N        of a height map: how many cells its greatest height has
 *                   (standard: 64) */
#ifndef HSR_COMMON_FILES_VOLUME_H
#define HSR_COMMON_FILES_VOLUME_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether this names a volume or a height map, with its words. */
bool hsr_is_volume_name(const char *name);

/* Fills an empty scene. Never takes more memory than a small multiple of the
 * file's size, whatever its header claims (of a compressed one: of what it can
 * hold at best), and what the grid takes.
 * HSR_E_INPUT: unreadable, malformed, truncated; unknown words; no sample is
 * kept; this build has no VTK. HSR_E_REFUSED: more faces than can be named.
 * HSR_E_NOMEM; HSR_E_INTERNAL. */
enum hsr_status hsr_volume_read(struct hsr_scene *scene, const char *name,
                                struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
