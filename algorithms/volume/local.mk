# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/solid_pyramid.c \
  %D%/solid_pyramid.h \
  %D%/splats/slab.c \
  %D%/splats/slab.h \
  %D%/splats/splat.c \
  %D%/splats/splat_sheet.c \
  %D%/splats/splat_volume.c \
  %D%/splats/splat_xray.c \
  %D%/textures/texture.c \
  %D%/textures/texture_convolve.c \
  %D%/textures/texture_mipmap.c \
  %D%/textures/texture_point.c \
  %D%/textures/texture_table.c \
  %D%/textures/textures.h \
  %D%/tiling_solids.c
# These files count nothing and are compiled once.
libcore_a_SOURCES += \
  %D%/solid_triage.c \
  %D%/solid_triage.h
