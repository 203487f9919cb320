# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/solid_triage.h \
  %D%/triage.h \
  %D%/voxel_solids.h \
  %D%/voxels.h
libhsr_a_SOURCES += \
  %D%/solid_triage.c \
  %D%/triage.c \
  %D%/voxel_solids.c \
  %D%/voxels.c
