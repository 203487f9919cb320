# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/bounded/bounded.h \
  %D%/bounded/covering.c \
  %D%/bounded/error_bounded.c \
  %D%/bounded/leaf.c \
  %D%/bounded/pixels.c \
  %D%/bounded/quadtree.c \
  %D%/bounded/refine.c \
  %D%/bounded/refine.h \
  %D%/bounded/side.c \
  %D%/bounded/spread.c \
  %D%/bounded/strict.c \
  %D%/bounded/strict.h \
  %D%/clark.c \
  %D%/culling/box_samples.h \
  %D%/culling/meagher.c \
  %D%/culling/naylor.c \
  %D%/culling/octree_raycast.c \
  %D%/culling/pvs.c \
  %D%/culling/visibility_map.c \
  %D%/culling/visibility_map.h \
  %D%/hzbuffer/cell.c \
  %D%/hzbuffer/coherence.c \
  %D%/hzbuffer/cube.c \
  %D%/hzbuffer/hzbuffer.c \
  %D%/hzbuffer/hzbuffer_moving.c \
  %D%/hzbuffer/moving/movers.c \
  %D%/hzbuffer/moving/movers.h \
  %D%/hzbuffer/moving/space_time.c \
  %D%/hzbuffer/moving/space_time.h \
  %D%/hzbuffer/octrees.c \
  %D%/hzbuffer/walk.c \
  %D%/hzbuffer/walk.h
# These files count nothing and are compiled once.
libcore_a_SOURCES += \
  %D%/bounded/cut.cc \
  %D%/bounded/queue.c \
  %D%/bounded/queue.h \
  %D%/bounded/shape.c \
  %D%/bounded/shape.h \
  %D%/bounded/surface.cc \
  %D%/bounded/surface.h \
  %D%/culling/cell_sets.c \
  %D%/culling/cell_sets.h \
  %D%/culling/portals.c \
  %D%/culling/portals.h
