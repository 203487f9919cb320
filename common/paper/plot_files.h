/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The writers of hsr_plot_write, one a format. Errors are as of that. */
#ifndef HSR_COMMON_PAPER_PLOT_FILES_H
#define HSR_COMMON_PAPER_PLOT_FILES_H

#include "common/paper/plot.h"

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_status hsr_plot_write_svg(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err);
/* PDF, or EPS. */
enum hsr_status hsr_plot_write_page(const struct hsr_plot *plot,
                                    const char *path, bool is_eps,
                                    struct hsr_error *err);
enum hsr_status hsr_plot_write_dxf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err);

/* Reads one character of UTF-8 that XML 1.0 allows in a text. Returns how many
 * bytes it has; 0 if the first byte begins none. */
int hsr_plot_character(const char *text, uint32_t *code);

#ifdef __cplusplus
}
#endif
#endif
