# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/zbuffer_fast/groups.c \
  %D%/zbuffer_fast/groups.h \
  %D%/zbuffer_fast/groups_make.c \
  %D%/zbuffer_fast/light_view.c \
  %D%/zbuffer_fast/light_view.h \
  %D%/null.c \
  %D%/zbuffer_fast/peel.c \
  %D%/zbuffer_fast/peel.h \
  %D%/raycast.c \
  %D%/zbuffer_fast/stream.c \
  %D%/zbuffer_fast/stream.h \
  %D%/zbuffer.c \
  %D%/zbuffer_fast/zbuffer_fast.c
