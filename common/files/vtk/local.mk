# SPDX-License-Identifier: GPL-3.0-or-later
# The formats of VTK. VTK itself is in hsr-vtk.so, which hsr loads when such a
# file is read or written.
libcore_a_SOURCES += %D%/vtk_library.h
if WITH_VTK
libcore_a_SOURCES += \
  %D%/mesh_vtp.cc \
  %D%/volume_scan_xml.cc \
  %D%/vtk.cc \
  %D%/xml_array.cc \
  %D%/xml_array.h \
  %D%/xml_markup.cc \
  %D%/xml_markup.h \
  %D%/xml_scan.cc \
  %D%/xml_scan.h
pkglibexec_PROGRAMS += hsr-vtk.so
hsr_vtk_so_SOURCES = \
  %D%/drawing_vtk.cc \
  %D%/library_vtk.cc \
  %D%/polygons_vtk.cc \
  %D%/volume_vtk.cc \
  %D%/voxels_vtk.cc \
  %D%/vtk_library.h \
  %D%/vtk_parts.h \
  %D%/vtk_text.h \
  %D%/xml_reader.h \
  common/base/status.c \
  common/files/whole_file.c
hsr_vtk_so_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
hsr_vtk_so_CFLAGS = $(AM_CFLAGS) -fvisibility=default
hsr_vtk_so_CXXFLAGS = $(AM_CXXFLAGS) -fvisibility=default
hsr_vtk_so_LDFLAGS = -shared
hsr_vtk_so_LDADD = $(VTK_LIBS)
else
libcore_a_SOURCES += %D%/no_vtk.cc
endif
