# SPDX-License-Identifier: GPL-3.0-or-later
# What other programs open.
libcore_a_SOURCES += \
  %D%/cells.h
libcore_a_SOURCES += \
  %D%/cells.c \
  %D%/cells_library.h \
  %D%/obj.c \
  %D%/ply.c
if WITH_VTK
# Loaded by hsr when such a file is written.
pkglibexec_PROGRAMS += hsr-cells.so
hsr_cells_so_SOURCES = \
  %D%/cells_library.h \
  %D%/cells_vtk.cc \
  common/base/status.c \
  common/files/whole_file.c
hsr_cells_so_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
hsr_cells_so_CFLAGS = $(AM_CFLAGS) -fvisibility=default
hsr_cells_so_CXXFLAGS = $(AM_CXXFLAGS) -fvisibility=default
hsr_cells_so_LDFLAGS = -shared
hsr_cells_so_LDADD = $(VTK_CELLS_LIBS)
endif
