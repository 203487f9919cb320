# SPDX-License-Identifier: GPL-3.0-or-later
# The files that use VTK.
if WITH_VTK
libhsr_a_LIBADD += $(libvtkshim_a_OBJECTS)
noinst_LIBRARIES += libvtkshim.a
libvtkshim_a_SOURCES = \
  %D%/drawing_vtk.cc \
  %D%/exchange_vtk.cc \
  %D%/mesh_array.cc \
  %D%/mesh_array.h \
  %D%/mesh_markup.cc \
  %D%/mesh_markup.h \
  %D%/mesh_scan_vtp.cc \
  %D%/voxels_vtk.cc \
  %D%/vtk_text.h
libvtkshim_a_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS) $(ZLIB_CFLAGS)
else
libhsr_a_SOURCES += common/files/mesh/exchange_no_vtk.cc
endif
