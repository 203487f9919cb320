# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/answer.h \
  %D%/area.h \
  %D%/filter.h \
  %D%/list.def \
  %D%/shader.h \
  %D%/transparent.h
libhsr_a_SOURCES += \
  %D%/answer.c \
  %D%/area.c \
  %D%/coded.c \
  %D%/composited.c \
  %D%/coded.h \
  %D%/filter.c \
  %D%/filtered.c \
  %D%/ids.c \
  %D%/list.c \
  %D%/polygons.c \
  %D%/segments.c \
  %D%/shader.c \
  %D%/shadowed.c \
  %D%/transparent.c \
  %D%/voxels.c
