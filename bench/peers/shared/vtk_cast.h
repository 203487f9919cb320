/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's ray caster for volumes, vtkFixedPointVolumeRayCastMapper, without a
 * window on a screen: what its uses here have in common.
 *
 * Blocks      VTK notes which blocks of the volume are clear, and rays leap
 *             over them. Its filter does that in pieces, on several threads.
 *             With bytes as colours, VTK 9.1 reads the wrong voxels for all
 *             pieces but the first, so that rays leap over kept cells: at 256 x
 *             256 samples of tubules, 4,583 of the 7,534 that show a cell
 *             showed none. So the filter is given one piece.
 * Context     There is none: rays are cast by the processor to memory. The
 *             texture in which VTK would bring the picture to a window is not
 *             made. */
#ifndef HSR_BENCH_PEERS_SHARED_VTK_CAST_H
#define HSR_BENCH_PEERS_SHARED_VTK_CAST_H

#include "bench/peers/shared/projection.h"

#include <vtkFixedPointRayCastImage.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>

struct Cast {
  vtkNew<vtkGenericOpenGLRenderWindow> window; /* has a size, draws nothing */
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkImageData> image;
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  vtkNew<vtkVolume> volume;
  struct box box;
};

/* Makes filters that are made from now on work in one piece. */
void forbid_pieces();

/* Makes room for n voxels of four bytes, the first at `corner`. */
void place_image(Cast *cast, const int n[3], const double corner[3],
                 const double size[3]);

/* Joins the parts for a picture of m x n: a ray for each sample, and steps of
 * this length, in world units. */
void connect_cast(Cast *cast, int m, int n, double step, int threads);

/* What the mapper does when it renders, without the texture at the end. */
void cast_rays(Cast *cast, const struct hsr_view *view);

/* VTK's picture is of the part of the window that the volume may cover: calls
 * take(at, pixel) for each sample in it, `at` being its place from the top, and
 * `pixel` four values of 15 bits. */
template <class Take>
void take_pixels(const Cast *cast, int m, int n, Take take) {
  vtkFixedPointRayCastImage *image = cast->mapper->GetRayCastImage();
  int corner[2], size[2], room[2];
  image->GetImageOrigin(corner);
  image->GetImageInUseSize(size);
  image->GetImageMemorySize(room);
  for (int j = 0; j < size[1]; j++) {
    const unsigned short *from =
        image->GetImage() + 4 * (size_t)j * (size_t)room[0];
    size_t at = (size_t)(n - 1 - corner[1] - j) * (size_t)m + (size_t)corner[0];
    for (int i = 0; i < size[0]; i++)
      take(at + (size_t)i, from + 4 * i);
  }
}

#endif
