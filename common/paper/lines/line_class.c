/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/lines/line_class.h"

#include <string.h>

static const char *const names[HSR_N_LINE_CLASSES] = {
    [HSR_LINE_SILHOUETTE] = "silhouette",
    [HSR_LINE_BOUNDARY] = "boundary",
    [HSR_LINE_INTERSECTION] = "intersection",
    [HSR_LINE_CREASE] = "crease",
    [HSR_LINE_COLOUR] = "colour",
    [HSR_LINE_SEAM] = "seam",
    [HSR_LINE_SMOOTH] = "smooth"};

const char *hsr_line_class_name(enum hsr_line_class line_class) {
  return names[line_class];
}

enum hsr_line_class hsr_line_class_named(const char *name) {
  int k = 0;
  while (k < HSR_N_LINE_CLASSES && strcmp(names[k], name) != 0)
    k++;
  return (enum hsr_line_class)k;
}
