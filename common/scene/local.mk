# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/clusters.h \
  %D%/flat.h \
  %D%/grid_object.h \
  %D%/motion.h \
  %D%/part.h \
  %D%/pieces.h \
  %D%/scene.h \
  %D%/standard.h \
  %D%/unused.h \
  %D%/world.h
libcore_a_SOURCES += \
  %D%/extract.c \
  %D%/flat.c \
  %D%/grid_object.c \
  %D%/motion.c \
  %D%/roster.c \
  %D%/part.c \
  %D%/pieces.c \
  %D%/plane_classes.c \
  %D%/planes.c \
  %D%/planes.h \
  %D%/scene.c \
  %D%/take.c \
  %D%/unused.c \
  %D%/world.c
