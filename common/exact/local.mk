# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/named_lines.h \
  %D%/order.h \
  %D%/predicates.h \
  %D%/sample_ray.h \
  %D%/screen.h \
  %D%/shadow.h
libcore_a_SOURCES += \
  %D%/alone.c \
  %D%/alone.h \
  %D%/exact_plane.h \
  %D%/footprint.h \
  %D%/footprint_cgal.cc \
  %D%/light_balls.c \
  %D%/named_lines_cgal.cc \
  %D%/order.c \
  %D%/pair.c \
  %D%/pair.h \
  %D%/predicates_cgal.cc \
  %D%/screen.c \
  %D%/shadow_cgal.cc
