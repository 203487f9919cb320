# SPDX-License-Identifier: GPL-3.0-or-later
# Other people's renderers for hsr bench, built by configure --with-peers.
# Nothing else needs them.
EXTRA_DIST += \
  %D%/README.md \
  %D%/make-scenes \
  %D%/suite/raycast.py
if WITH_PEERS
hsrlibexecdir = $(libexecdir)/hsr
hsrlibexec_PROGRAMS = %D%/hsr-peers
if WITH_VOLUMES
hsrlibexec_PROGRAMS += %D%/hsr-volumes
endif
%C%_hsr_peers_SOURCES = \
  %D%/main.c \
  %D%/surfaces/own.c \
  %D%/shared/peers.h \
  %D%/shared/projection.c \
  %D%/shared/projection.h \
  %D%/lines/lines.c \
  %D%/lines/lines.h \
  %D%/lines/line_pixels.c \
  %D%/lines/line_pixels.h \
  %D%/lines/clipped.cc \
  %D%/lines/clipped.h
%C%_hsr_peers_LDADD = libinexact.a
if WITH_EMBREE
noinst_LIBRARIES += libembreepeer.a
libembreepeer_a_SOURCES = %D%/surfaces/embree.c %D%/surfaces/embree_query.h
libembreepeer_a_CFLAGS = $(AM_CFLAGS) $(OPENMP_CFLAGS)
%C%_hsr_peers_LDADD += libembreepeer.a $(EMBREE_LIBS) $(OPENMP_CFLAGS)
endif
if WITH_TINYBVH
noinst_LIBRARIES += libtinybvhpeer.a
libtinybvhpeer_a_SOURCES = %D%/surfaces/tinybvh.cc
libtinybvhpeer_a_CPPFLAGS = $(AM_CPPFLAGS) $(TINYBVH_CPPFLAGS)
libtinybvhpeer_a_CXXFLAGS = $(AM_CXXFLAGS) -mavx2 -mfma
%C%_hsr_peers_LDADD += libtinybvhpeer.a
endif
if WITH_MASKED_CULLING
noinst_LIBRARIES += libcullerpeer.a
libcullerpeer_a_SOURCES = \
  %D%/surfaces/culler.cc \
  %D%/surfaces/culler_groups.cc \
  %D%/surfaces/culler_groups.h
libcullerpeer_a_CPPFLAGS = $(AM_CPPFLAGS) $(MASKED_CULLING_CPPFLAGS)
%C%_hsr_peers_LDADD += libcullerpeer.a $(MASKED_CULLING_LIBS)
endif
if WITH_OFFSCREEN
%C%_hsr_peers_SOURCES += \
  %D%/surfaces/llvmpipe.c \
  %D%/shared/offscreen.c \
  %D%/shared/offscreen.h
%C%_hsr_peers_LDADD += $(OFFSCREEN_LIBS)
# A stranger to hsr, which tries a suite. It links none of it.
noinst_PROGRAMS += %D%/suite/rasterise
%C%_suite_rasterise_SOURCES = %D%/suite/rasterise.c
%C%_suite_rasterise_LDADD = $(OFFSCREEN_LIBS) $(JANSSON_LIBS)
endif
if WITH_GL2PS
%C%_hsr_peers_SOURCES += %D%/lines/gl2ps.c
%C%_hsr_peers_LDADD += -lgl2ps
endif
if WITH_SKETCH
%C%_hsr_peers_SOURCES += \
  %D%/surfaces/sketch.cc \
  %D%/surfaces/painted.cc \
  %D%/surfaces/painted.h
endif
if WITH_OCCT
noinst_LIBRARIES += libocctpeer.a
libocctpeer_a_SOURCES = %D%/lines/occt.cc
libocctpeer_a_CPPFLAGS = $(AM_CPPFLAGS) $(OCCT_CPPFLAGS)
%C%_hsr_peers_LDADD += libocctpeer.a $(OCCT_LIBS)
endif
if WITH_VTK_RENDERER
noinst_LIBRARIES += libvtkpeer.a
libvtkpeer_a_SOURCES = \
  %D%/surfaces/vtk.cc \
  %D%/lines/vtk.cc \
  %D%/shared/vtk.cc \
  %D%/shared/vtk.h \
  %D%/shared/vtk_window.cc \
  %D%/shared/vtk_window.h \
  %D%/shared/vtk_cast.cc \
  %D%/shared/vtk_cast.h \
  %D%/surfaces/vtk_volume.cc \
  %D%/volumes/vtk.cc
libvtkpeer_a_CPPFLAGS = $(AM_CPPFLAGS) $(VTK_CPPFLAGS)
%C%_hsr_peers_SOURCES += %D%/shared/samples.c %D%/shared/samples.h
%C%_hsr_peers_LDADD += libvtkpeer.a $(VTK_RENDERER_LIBS)
endif
%C%_hsr_peers_LDADD += $(BENCH_LIBS)

# Renderers of volumes, beside our splats.
%C%_hsr_volumes_SOURCES = \
  %D%/volumes/volumes.c \
  %D%/volumes/volumes.h \
  %D%/shared/samples.c \
  %D%/shared/samples.h \
  %D%/shared/projection.c \
  %D%/shared/projection.h
%C%_hsr_volumes_LDADD =
if WITH_VTK_RENDERER
%C%_hsr_volumes_LDADD += libvtkpeer.a $(VTK_RENDERER_LIBS)
endif
if WITH_VOLPACK
%C%_hsr_volumes_SOURCES += %D%/volumes/volpack.c
%C%_hsr_volumes_LDADD += -lvolpack
endif
if WITH_TEEM
%C%_hsr_volumes_SOURCES += %D%/volumes/teem.c
%C%_hsr_volumes_LDADD += -lteem
endif
%C%_hsr_volumes_LDADD += $(BENCH_LIBS)

# zbuffer-fast compiled again, without its exact fallback and under another name.
noinst_LIBRARIES += libinexact.a
libinexact_a_SOURCES = algorithms/engines/tiler/tiler.c algorithms/engines/tiler/tiler.h \
  algorithms/brute_force/zbuffer_fast/groups.c algorithms/brute_force/zbuffer_fast/groups.h \
  algorithms/brute_force/zbuffer_fast/groups_make.c \
  algorithms/brute_force/zbuffer_fast/peel.c algorithms/brute_force/zbuffer_fast/peel.h algorithms/engines/light/glass.c \
  algorithms/brute_force/zbuffer_fast/light_view.c algorithms/brute_force/zbuffer_fast/light_view.h \
  algorithms/brute_force/zbuffer_fast/stream.c algorithms/brute_force/zbuffer_fast/stream.h \
  algorithms/engines/light/glass.h algorithms/engines/light/shadow.c algorithms/engines/light/shadow.h \
  algorithms/brute_force/zbuffer_fast/zbuffer_fast.c
libinexact_a_CPPFLAGS = -include %D%/inexact-names.h $(AM_CPPFLAGS) \
  -DHSR_COUNTING=0 -DHSR_INEXACT=1
%D%/inexact-names.h: $(libplain_a_OBJECTS)
	@NM="$(NM)" $(srcdir)/algorithms/names-again _inexact \
	  `echo $(libinexact_a_OBJECTS) | sed 's/libinexact_a-/libplain_a-/g'` >$@.new && \
	  mv $@.new $@
$(libinexact_a_OBJECTS): %D%/inexact-names.h
CLEANFILES += %D%/inexact-names.h
endif
