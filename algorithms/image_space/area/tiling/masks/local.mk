# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/canvas.c \
  %D%/canvas.h \
  %D%/masks.c \
  %D%/masks.h \
  %D%/masks_avx2.h \
  %D%/masks_avx512.h \
  %D%/outline.c \
  %D%/outline.h \
  %D%/polygon.c \
  %D%/polygon.h \
  %D%/silhouette.c
