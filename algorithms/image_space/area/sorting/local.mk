# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/area_slots.c \
  %D%/area_slots.h \
  %D%/areas.h \
  %D%/border.c \
  %D%/clipper.c \
  %D%/face_area.c \
  %D%/trace.c \
  %D%/weiler_atherton.c
