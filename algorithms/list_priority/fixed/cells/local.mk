# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/btf.c \
  %D%/cell_box.c \
  %D%/cell_frame.c \
  %D%/cell_side.c \
  %D%/cells.h \
  %D%/ippbtf.c \
  %D%/octree_order.c \
  %D%/pbtf.c \
  %D%/vbuffer.c \
  %D%/wbtf.c
