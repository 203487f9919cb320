# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/dashes.c \
  %D%/dashes.h \
  %D%/hatch.c \
  %D%/hatch.h \
  %D%/page.c \
  %D%/page.h \
  %D%/pen_travel.c \
  %D%/plot.c \
  %D%/plot.h \
  %D%/plot_cairo.c \
  %D%/plot_dxf.cc \
  %D%/plot_files.h \
  %D%/plot_svg.c \
  %D%/shared_sides.c \
  %D%/shared_sides.h \
  %D%/sheet.c \
  %D%/sheet.h \
  %D%/strokes.c \
  %D%/strokes.h
