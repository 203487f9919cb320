# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/base64.h \
  %D%/colour_tiles.h \
  %D%/image.h \
  %D%/npy.h \
  %D%/whole_file.h \
  %D%/whole_input.h
libcore_a_SOURCES += \
  %D%/image.c \
  %D%/image_library.h \
  %D%/library.c \
  %D%/library.h \
  %D%/npy.c \
  %D%/srgb.h \
  %D%/suffix.h \
  %D%/whole_file.c \
  %D%/whole_input.c

# Loaded by hsr when a picture is written: as a .png file, and as any other.
pkglibexec_PROGRAMS += hsr-png.so
hsr_png_so_SOURCES = \
  %D%/image_library.h \
  %D%/image_png.c \
  common/base/status.c \
  common/files/whole_file.c
hsr_png_so_CPPFLAGS = $(AM_CPPFLAGS) $(PNG_CFLAGS)
hsr_png_so_CFLAGS = $(AM_CFLAGS) -fvisibility=default
hsr_png_so_LDFLAGS = -shared
hsr_png_so_LDADD = $(PNG_LIBS)

pkglibexec_PROGRAMS += hsr-images.so
hsr_images_so_SOURCES = \
  %D%/image_library.h \
  %D%/image_oiio.cc \
  common/base/status.c \
  common/files/whole_file.c
hsr_images_so_CPPFLAGS = $(AM_CPPFLAGS) $(OIIO_CFLAGS)
hsr_images_so_CFLAGS = $(AM_CFLAGS) -fvisibility=default
hsr_images_so_CXXFLAGS = $(AM_CXXFLAGS) -fvisibility=default
hsr_images_so_LDFLAGS = -shared
hsr_images_so_LDADD = $(OIIO_LIBS)
