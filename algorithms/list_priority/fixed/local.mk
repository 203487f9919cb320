# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/bsp_frame.c \
  %D%/bsp_frame.h \
  %D%/bsp_painter.c \
  %D%/bsp_walk.c \
  %D%/bsp_walk.h \
  %D%/cluster_faces.h \
  %D%/cluster_order.h \
  %D%/schumacker.c \
  %D%/schumacker_newell.c \
  %D%/schumacker_watkins.c
