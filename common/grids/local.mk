# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/grid.h \
  %D%/grid_object.h \
  %D%/order.h \
  %D%/triage.h \
  %D%/voxels.h
libhsr_a_SOURCES += \
  %D%/grid.c \
  %D%/grid_object.c \
  %D%/order.c \
  %D%/triage.c \
  %D%/voxels.c
