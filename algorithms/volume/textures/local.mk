# SPDX-License-Identifier: GPL-3.0-or-later
algorithm_files += \
  %D%/texture.c \
  %D%/texture_convolve.c \
  %D%/texture_mipmap.c \
  %D%/texture_point.c \
  %D%/texture_table.c \
  %D%/textures.h
