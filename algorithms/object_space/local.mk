# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/edges/active_edges.c \
  %D%/edges/active_edges.h \
  %D%/edges/appel.c \
  %D%/edges/edge_intersection.c \
  %D%/edges/edge_intersection.h \
  %D%/edges/galimberti.c \
  %D%/edges/loutrel.c \
  %D%/edges/warnock_edges.c \
  %D%/volumes/roberts.c
