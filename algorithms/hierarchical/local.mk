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
  %D%/cube_frame.c \
  %D%/cube_frame.h \
  %D%/cube_list.c \
  %D%/cube_list.h \
  %D%/cube_octants.c \
  %D%/cube_octants.h \
  %D%/hzbuffer/cell.c \
  %D%/hzbuffer/coherence.c \
  %D%/hzbuffer/cube.c \
  %D%/hzbuffer/hzbuffer.c \
  %D%/hzbuffer/octrees.c \
  %D%/hzbuffer/walk.h \
  %D%/movers.c \
  %D%/movers.h \
  %D%/pyramid.c \
  %D%/pyramid.h \
  %D%/space_time.c \
  %D%/space_time.h
# These files count nothing and are compiled once.
libhsr_a_SOURCES += \
  %D%/bounded/cut.cc \
  %D%/bounded/queue.c \
  %D%/bounded/queue.h \
  %D%/bounded/shape.c \
  %D%/bounded/shape.h \
  %D%/bounded/surface.cc \
  %D%/bounded/surface.h \
  %D%/cube_cells.c \
  %D%/cube_cells.h \
  %D%/cube_objects.c \
  %D%/cube_objects.h \
  %D%/cubes.c \
  %D%/cubes.h
