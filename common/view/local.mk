# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/clip.h \
  %D%/depths.h \
  %D%/gouraud.h \
  %D%/line_name.h \
  %D%/path.h \
  %D%/picture.h \
  %D%/standard.h \
  %D%/view.h
libcore_a_SOURCES += \
  %D%/clip.c \
  %D%/gouraud.c \
  %D%/matrices_cgal.cc \
  %D%/path.c \
  %D%/picture.c \
  %D%/standard.c \
  %D%/view.c
