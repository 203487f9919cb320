# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/triage.h \
  %D%/voxels.h
libhsr_a_SOURCES += \
  %D%/triage.c \
  %D%/voxels.c
