# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/area.h \
  %D%/composited.h \
  %D%/filtered.h \
  %D%/ids.h \
  %D%/polygons.h \
  %D%/segments.h \
  %D%/shadowed.h \
  %D%/transparent.h \
  %D%/voxels.h
libcore_a_SOURCES += \
  %D%/area.c \
  %D%/composited.c \
  %D%/filtered.c \
  %D%/ids.c \
  %D%/polygons.c \
  %D%/segments.c \
  %D%/shadowed.c \
  %D%/transparent.c \
  %D%/voxels.c
