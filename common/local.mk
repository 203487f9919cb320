# SPDX-License-Identifier: GPL-3.0-or-later
pkginclude_common_HEADERS += %D%/adapt.h %D%/arena.h %D%/box.h %D%/clip.h %D%/clusters.h %D%/count.h %D%/drawing.h %D%/edges.h %D%/sight.h \
  %D%/exchange.h %D%/filter.h %D%/image.h %D%/order.h %D%/picture.h %D%/pieces.h %D%/predicates.h %D%/scene.h \
  %D%/scene_json.h %D%/screen.h %D%/statistics.h %D%/status.h %D%/view.h \
  %D%/solid_triage.h %D%/triage.h %D%/volumes.h %D%/voxel_solids.h %D%/voxels.h %D%/world.h
libhsr_a_SOURCES += %D%/adapt_cgal.cc %D%/arena.c %D%/box.c %D%/bsp.cc %D%/bsp.h %D%/clip.c %D%/cluster_cgal.cc %D%/convex.cc %D%/convex.h %D%/count.c %D%/cubes.c %D%/cubes.h %D%/grain.c %D%/grain.h %D%/grove.c %D%/grove.h %D%/triage.c %D%/division.h %D%/drawing.c %D%/edges_cgal.cc %D%/exact_points.h %D%/sight.c %D%/sight_cgal.cc %D%/sight_events.cc %D%/sight_face.cc %D%/sight_volume.cc %D%/sight_numbers.h %D%/solid_triage.c %D%/exact_plane.h %D%/exchange.cc \
  %D%/mesh_file.cc %D%/mesh_file.h %D%/mesh_scan_obj.cc %D%/mesh_scan_off.cc \
  %D%/mesh_scan_ply.cc %D%/mesh_scan_stl.cc %D%/mesh_text.cc %D%/mesh_text.h \
  %D%/filter.c %D%/image.cc %D%/octree.c %D%/octree.h %D%/order.c %D%/picture.c %D%/pieces.c %D%/predicates_cgal.cc %D%/scene.c \
  %D%/json_read.c %D%/json_read.h %D%/scene_json.c %D%/srgb.h %D%/screen.c %D%/statistics.c %D%/pair.c %D%/pair.h %D%/penetration.cc %D%/penetration.h %D%/status.c %D%/vector.h %D%/bits.h \
  %D%/view.c %D%/volumes_cgal.cc %D%/voxel_solids.c %D%/voxels.c %D%/world.c

# Line drawings as files.
pkginclude_common_HEADERS += %D%/crease.h %D%/plot.h %D%/whole_file.h
libhsr_a_SOURCES += %D%/crease.c %D%/plot.c %D%/plot_cairo.c %D%/plot_svg.c \
  %D%/whole_file.c

if WITH_VTK
libhsr_a_LIBADD += $(libvtkshim_a_OBJECTS)
noinst_LIBRARIES += libvtkshim.a
libvtkshim_a_SOURCES = %D%/drawing_vtk.cc %D%/exchange_vtk.cc %D%/mesh_array.cc \
  %D%/mesh_array.h %D%/mesh_markup.cc %D%/mesh_markup.h %D%/mesh_scan_vtp.cc \
  %D%/voxels_vtk.cc %D%/vtk_text.h
libvtkshim_a_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS) $(ZLIB_CFLAGS)
else
libhsr_a_SOURCES += %D%/exchange_no_vtk.cc
endif
EXTRA_DIST += docs/correct-drawing.md docs/correct-picture.md docs/filtered-picture.md docs/scene.schema.json docs/bench.schema.json
