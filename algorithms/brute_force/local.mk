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
  %D%/zbuffer.c
