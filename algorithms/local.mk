# SPDX-License-Identifier: GPL-3.0-or-later
# Every algorithm is compiled twice, to count and not to.
pkginclude_algorithms_HEADERS += %D%/algorithm.h %D%/setup.h \
  %D%/variant.h
libhsr_a_SOURCES += %D%/registry.c %D%/setup.c %D%/variant.c %D%/list.def

algorithm_files = \
  %D%/appel.c \
  %D%/bouknight.c \
  %D%/bsp_frame.c \
  %D%/bsp_frame.h \
  %D%/bsp_painter.c \
  %D%/bsp_walk.c \
  %D%/bsp_walk.h \
  %D%/clark.c \
  %D%/cube_frame.c \
  %D%/cube_frame.h \
  %D%/cube_list.c \
  %D%/cube_list.h \
  %D%/cluster_order.h \
  %D%/edge_intersection.c \
  %D%/edge_intersection.h \
  %D%/galimberti.c \
  %D%/hzbuffer.c \
  %D%/line_oracle.cc \
  %D%/loutrel.c \
  %D%/movers.c \
  %D%/movers.h \
  %D%/newell.c \
  %D%/newell.h \
  %D%/newell_watkins.c \
  %D%/null.c \
  %D%/oracle.cc \
  %D%/painter.c \
  %D%/priority_list.c \
  %D%/priority_list.h \
  %D%/pyramid.c \
  %D%/pyramid.h \
  %D%/raycast.c \
  %D%/roberts.c \
  %D%/romney.c \
  %D%/scan_line.c \
  %D%/scan_line.h \
  %D%/schumacker.c \
  %D%/schumacker_newell.c \
  %D%/tiler.c \
  %D%/tiling/canvas.c \
  %D%/tiling/canvas.h \
  %D%/tiling/clip.c \
  %D%/tiling/clip.h \
  %D%/tiling/frame.c \
  %D%/tiling/frame.h \
  %D%/tiling/lazy.c \
  %D%/tiling/lazy_pyramid.c \
  %D%/tiling/lazy_pyramid.h \
  %D%/tiling/loose.c \
  %D%/tiling/loose.h \
  %D%/tiling/masks.c \
  %D%/tiling/masks.h \
  %D%/tiling/masks_avx512.h \
  %D%/tiling/merged.c \
  %D%/tiling/polygon.c \
  %D%/tiling/polygon.h \
  %D%/tiling/separate.c \
  %D%/tiling/separate.h \
  %D%/tiling/tiling.c \
  %D%/tiler.h \
  %D%/warnock.c \
  %D%/warnock.h \
  %D%/warnock_depth.c \
  %D%/warnock_edges.c \
  %D%/warnock_newell.c \
  %D%/warnock_watkins.c \
  %D%/watkins.c \
  %D%/watkins.h \
  %D%/yzx.c \
  %D%/zbuffer.c

noinst_LIBRARIES += libplain.a libcounting.a
libplain_a_SOURCES = $(algorithm_files)
libplain_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=0
libcounting_a_SOURCES = $(algorithm_files)
libcounting_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=1
libhsr_a_LIBADD += $(libplain_a_OBJECTS) $(libcounting_a_OBJECTS)
