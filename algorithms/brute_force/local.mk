# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/groups.c \
  %D%/groups.h \
  %D%/groups_make.c \
  %D%/light_view.c \
  %D%/light_view.h \
  %D%/null.c \
  %D%/peel.c \
  %D%/peel.h \
  %D%/raycast.c \
  %D%/stream.c \
  %D%/stream.h \
  %D%/tiler.c \
  %D%/tiler.h \
  %D%/tiler_avx2.h \
  %D%/tiler_avx512.h \
  %D%/tiler_twin.h \
  %D%/zbuffer.c
