# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/image.h \
  %D%/plot.h \
  %D%/scene_json.h \
  %D%/whole_file.h
libhsr_a_SOURCES += \
  %D%/image.cc \
  %D%/json.c \
  %D%/json.h \
  %D%/json_read.c \
  %D%/json_read.h \
  %D%/plot.c \
  %D%/plot_cairo.c \
  %D%/plot_svg.c \
  %D%/scene_json.c \
  %D%/srgb.h \
  %D%/suffix.h \
  %D%/whole_file.c
