# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/area.c \
  %D%/area.h \
  %D%/quadtree.h \
  %D%/zz_buffer.c
# This file counts nothing and is compiled once.
libhsr_a_SOURCES += %D%/quadtree.c
