# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/crease.h \
  %D%/drawing.h \
  %D%/edges.h \
  %D%/polygons.h \
  %D%/volumes.h
libcore_a_SOURCES += \
  %D%/crease.c \
  %D%/drawing.c \
  %D%/edges_cgal.cc \
  %D%/exact_points.h \
  %D%/polygons.c \
  %D%/volumes_cgal.cc
