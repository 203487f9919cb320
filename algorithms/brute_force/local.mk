# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/null.c \
  %D%/raycast.c \
  %D%/tiler.c \
  %D%/tiler.h \
  %D%/zbuffer.c
