# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/area.c \
  %D%/area.h \
  %D%/quadtree.h \
  %D%/warnock.c \
  %D%/warnock.h \
  %D%/warnock_depth.c \
  %D%/warnock_newell.c \
  %D%/warnock_watkins.c \
  %D%/zz_buffer.c
# This file counts nothing and is compiled once.
libhsr_a_SOURCES += %D%/quadtree.c
