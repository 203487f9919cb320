# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/box.h
libcore_a_SOURCES += \
  %D%/box.c \
  %D%/box_polygon.c \
  %D%/bsp.cc \
  %D%/bsp.h \
  %D%/bsp_tree.cc \
  %D%/bsp_tree.h \
  %D%/grain.c \
  %D%/grain.h \
  %D%/octree.c \
  %D%/octree_build.h \
  %D%/octree_shared.c \
  %D%/octree.h
