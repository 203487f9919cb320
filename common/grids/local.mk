# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/grid.h \
  %D%/heights.h \
  %D%/normal.h \
  %D%/order.h \
  %D%/palette.h \
  %D%/splatting.h
libcore_a_SOURCES += \
  %D%/densities.c \
  %D%/densities.h \
  %D%/grid.c \
  %D%/heights.c \
  %D%/normal.c \
  %D%/order.c \
  %D%/palette.c
