# SPDX-License-Identifier: GPL-3.0-or-later
# The comparison with other people's renderers, built by configure --with-peers;
# nothing else needs it.
if WITH_PEERS
noinst_PROGRAMS += %D%/peers
%C%_peers_SOURCES = %D%/own.c %D%/peers.c %D%/peers.h
%C%_peers_LDADD = libinexact.a $(HSR_LIBS) $(EMBREE_LIBS) $(OSMESA_LIBS)
nodist_EXTRA_%C%_peers_SOURCES = force_cxx_link.cc
if WITH_EMBREE
%C%_peers_SOURCES += %D%/embree.c
endif
if WITH_OSMESA
%C%_peers_SOURCES += %D%/osmesa.c
endif
if WITH_GL2PS
noinst_PROGRAMS += %D%/gl2ps-lines
%C%_gl2ps_lines_SOURCES = %D%/gl2ps_lines.c
%C%_gl2ps_lines_LDADD = $(HSR_LIBS) -lgl2ps $(OSMESA_LIBS)
nodist_EXTRA_%C%_gl2ps_lines_SOURCES = force_cxx_link.cc
endif

# zbuffer once more, without its exact fallback and under another name.
noinst_LIBRARIES += libinexact.a
libinexact_a_SOURCES = algorithms/zbuffer.c
libinexact_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=0 \
  -DHSR_ZBUFFER_INEXACT=1 \
  -Dhsr_algorithm_zbuffer=hsr_algorithm_zbuffer_inexact
endif
