# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/drawing.h \
  %D%/edges.h \
  %D%/polygons.h \
  %D%/volumes.h
libcore_a_SOURCES += \
  %D%/drawing.c \
  %D%/edges_cgal.cc \
  %D%/exact_points.h \
  %D%/polygons.c \
  %D%/volumes_cgal.cc
