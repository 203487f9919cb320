# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/splat.c \
  %D%/splat_blur.c \
  %D%/splat_frame.c \
  %D%/splat_kernel.c \
  %D%/splat_light.c \
  %D%/splat_picture.c \
  %D%/splat_place.c \
  %D%/splat_put.c \
  %D%/splat_put_avx2.c \
  %D%/splat_put_avx512.c \
  %D%/splat_sheet.c \
  %D%/splat_twin.h \
  %D%/splat_volume.c \
  %D%/splat_weigh.c \
  %D%/splat_xray.c \
  %D%/splats.h
