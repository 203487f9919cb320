/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of hsr-cells.so; only for common/files/cells. */
#ifndef HSR_COMMON_CELLS_LIBRARY_H
#define HSR_COMMON_CELLS_LIBRARY_H

#include "common/files/cells/cells.h"

/* As hsr_cells_write in cells.h. */
struct hsr_cells_library {
  enum hsr_status (*write)(const struct hsr_cells *cells, const char *path,
                           struct hsr_error *err);
};

#endif
