# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/adapt.h \
  %D%/surfaces.h
libhsr_a_SOURCES += \
  %D%/adapt_cgal.cc \
  %D%/cluster_cgal.cc \
  %D%/convex.cc \
  %D%/convex.h \
  %D%/division.h \
  %D%/heights.c \
  %D%/heights.h \
  %D%/surfaces.cc
