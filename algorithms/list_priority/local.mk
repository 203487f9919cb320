# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/fixed/bsp_painter.c \
  %D%/fixed/cells/btf.c \
  %D%/fixed/cells/ippbtf.c \
  %D%/fixed/cells/octree_order.c \
  %D%/fixed/cells/pbtf.c \
  %D%/fixed/cells/vbuffer.c \
  %D%/fixed/cells/wbtf.c \
  %D%/fixed/cluster_faces.h \
  %D%/fixed/cluster_order.c \
  %D%/fixed/cluster_order.h \
  %D%/fixed/schumacker.c \
  %D%/fixed/schumacker_newell.c \
  %D%/fixed/schumacker_newell_watkins.c \
  %D%/fixed/schumacker_watkins.c \
  %D%/per_frame/kept_order.c \
  %D%/per_frame/kept_order.h \
  %D%/per_frame/newell.c \
  %D%/per_frame/newell.h \
  %D%/per_frame/newell_watkins.c \
  %D%/per_frame/painter.c \
  %D%/per_frame/priority_index.c \
  %D%/per_frame/priority_list.c \
  %D%/per_frame/priority_list.h \
  %D%/per_frame/priority_pieces.h \
  %D%/per_frame/priority_scan.c \
  %D%/per_frame/priority_scan.h
