/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading volumes and height maps as grid scenes.
 *
 * VTK reads .nii .nii.gz (NIfTI), .vtk (structured points and rectilinear
 * grids), .vti (images) and .vtr (rectilinear grids); samples are their point
 * data. OpenImageIO reads height maps: "heights-of:" and the name of any picture
 * that it reads. hsr itself reads .mhd .mha (MetaImage), .nrrd .nhdr (NRRD) and
 * bytes without a header. A sample that is not a finite number is not kept.
 *
 * Words may follow the name, each after a colon.
 *
 * For all volumes:
 *   least=X most=X  a sample is kept if its density is in this range, in the
 *                   data's own units. Default: from Otsu's threshold on
 *                   (common/grids/densities.h), without an upper limit
 *   gradient=X a sample is kept if its gradient has at least this size, too
 *   sides=all sides between two kept cells are faces, too
 * For bytes without a header:
 *   size=NXxNYxNZ   the numbers of samples. This word must be there
 *   type=T          u8, i8, u16-le, u16-be, i16-le, i16-be, f32-le or f32-be.
 *                   Default: u8
 *   offset=N        bytes before the first sample. Default: 0
 *   spacing=XxYxZ   distances of samples. Default: 1x1x1
 * For height maps:
 *   levels=N        how many cells the greatest height has. Default: 64
 *   photograph=FILE a picture with the colour of each height */
#ifndef HSR_COMMON_FILES_VOLUME_H
#define HSR_COMMON_FILES_VOLUME_H

#include "common/files/mesh/exchange.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether a name, perhaps with words, is that of a volume or a height map. */
bool hsr_is_volume_name(const char *name);

/* Fills an empty scene from a file. `name` has words as above. What of a header
 * is not used is noted in *import, which may be NULL. Memory is at
 * most that of the grid and a small multiple of the file's size, whatever its
 * header claims; for a compressed file, of the most that it can hold.
 * HSR_E_INPUT: the file is unreadable, malformed or truncated; a word is
 * unknown; no sample is kept; this build has no VTK. HSR_E_REFUSED: there are
 * more faces than ids. HSR_E_NOMEM. HSR_E_INTERNAL: a library fails. */
enum hsr_status hsr_volume_read(struct hsr_scene *scene, const char *name,
                                struct hsr_import *import,
                                struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
