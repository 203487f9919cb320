# SPDX-License-Identifier: GPL-3.0-or-later
# .gltf and .glb: reading through jansson, and writing.
libcore_a_SOURCES += \
  %D%/glb_frame.c \
  %D%/glb_frame.h \
  %D%/glb_write.c \
  %D%/gltf_accessor.cc \
  %D%/gltf_accessor.h \
  %D%/gltf_file.cc \
  %D%/gltf_file.h \
  %D%/gltf_mesh.cc \
  %D%/gltf_mesh.h \
  %D%/gltf_read.cc \
  %D%/gltf_value.cc
