# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/exchange.h
libcore_a_SOURCES += \
  %D%/exchange.cc \
  %D%/mesh_blocks.h \
  %D%/mesh_colours.cc \
  %D%/mesh_colours.h \
  %D%/mesh_corners.cc \
  %D%/mesh_corners.h \
  %D%/mesh_file.cc \
  %D%/mesh_file.h \
  %D%/mesh_groups.cc \
  %D%/mesh_groups.h \
  %D%/mesh_scene.cc \
  %D%/mesh_scene.h \
  %D%/mesh_solid.cc \
  %D%/mesh_text.cc \
  %D%/mesh_text.h \
  %D%/mesh_weld.cc
