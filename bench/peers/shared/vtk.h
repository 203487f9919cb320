/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all that draw by VTK have in common. */
#ifndef HSR_BENCH_PEERS_SHARED_VTK_H
#define HSR_BENCH_PEERS_SHARED_VTK_H

#include "bench/peers/shared/projection.h"

#include <vtkRenderer.h>

/* Looks as `view` does; what is outside the box is not drawn. */
void vtk_aim(vtkRenderer *renderer, const struct box *box,
             const struct hsr_view *view);

/* The status for whatever was thrown. */
enum hsr_status vtk_fail(struct hsr_error *err);

#endif
