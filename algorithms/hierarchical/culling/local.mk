# SPDX-License-Identifier: GPL-3.0-or-later
# Algorithms that pass over what is hidden without a z-buffer's help.
algorithm_files += \
  %D%/meagher.c \
  %D%/naylor.c \
  %D%/octree_raycast.c \
  %D%/box_samples.h \
  %D%/pvs.c \
  %D%/visibility_map.c \
  %D%/visibility_map.h
# These files count nothing and are compiled once.
libhsr_a_SOURCES += \
  %D%/cell_sets.c \
  %D%/cell_sets.h \
  %D%/portals.c \
  %D%/portals.h
