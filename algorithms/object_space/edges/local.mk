# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/active_edges.c \
  %D%/active_edges.h \
  %D%/appel.c \
  %D%/edge_intersection.c \
  %D%/edge_intersection.h \
  %D%/galimberti.c \
  %D%/loutrel.c \
  %D%/near_boxes.c \
  %D%/near_boxes.h \
  %D%/warnock_edges.c
