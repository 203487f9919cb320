# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/adapt.h \
  %D%/surfaces.h
libcore_a_SOURCES += \
  %D%/adapt_cgal.cc \
  %D%/cluster_cgal.cc \
  %D%/convex.cc \
  %D%/convex.h \
  %D%/division.h \
  %D%/heights.c \
  %D%/heights.h \
  %D%/kept_priorities.cc \
  %D%/kept_priorities.h \
  %D%/priority_graph.h \
  %D%/surfaces.cc
