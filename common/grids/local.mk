# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += \
  %D%/grid.h \
  %D%/heights.h \
  %D%/normal.h \
  %D%/order.h \
  %D%/palette.h \
  %D%/splatting.h
libhsr_a_SOURCES += \
  %D%/grid.c \
  %D%/heights.c \
  %D%/normal.c \
  %D%/order.c \
  %D%/palette.c
