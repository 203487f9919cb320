# SPDX-License-Identifier: GPL-3.0-or-later
# Reading .gltf and .glb.
libcore_a_SOURCES += \
  %D%/gltf_file.cc \
  %D%/gltf_file.h \
  %D%/gltf_read.cc \
  %D%/gltf_value.cc
