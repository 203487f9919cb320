# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += \
  %D%/mesh_materials.cc \
  %D%/mesh_materials.h \
  %D%/mesh_obj.cc \
  %D%/mesh_off.cc \
  %D%/mesh_ply.cc \
  %D%/mesh_ply_header.cc \
  %D%/mesh_ply_header.h \
  %D%/mesh_ply_plain.cc \
  %D%/mesh_stl.cc
