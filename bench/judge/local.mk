# SPDX-License-Identifier: GPL-3.0-or-later
# The oracles, which have one build; it counts, and is never timed. And the list
# of all that -a can name.
noinst_LIBRARIES += liboracles.a
oracle_files = \
  %D%/oracles/area_oracle.cc \
  %D%/oracles/line_oracle.cc \
  %D%/oracles/oracle.cc \
  %D%/oracles/polygon_oracle.cc \
  %D%/oracles/shadow_oracle.cc \
  %D%/oracles/splat_oracle.cc \
  %D%/oracles/transparent_oracle.cc \
  %D%/oracles/voxel_oracle.cc
liboracles_a_SOURCES = $(oracle_files)
liboracles_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=1
libcore_a_LIBADD += $(liboracles_a_OBJECTS)
libcore_a_SOURCES += bench/modules/modules.h bench/modules/variant.h
libcore_a_SOURCES += bench/modules/list.c bench/modules/modules.c \
  bench/modules/oracles.def bench/modules/variant.c %D%/oracles/steps.h \
  %D%/rounding.h %D%/samples.h %D%/surface.h %D%/vectors.h \
  %D%/areas/areas.cc \
  %D%/areas/areas.h \
  %D%/areas/cells.cc \
  %D%/areas/cells.h \
  %D%/areas/jets.h \
  %D%/areas/moments.cc \
  %D%/areas/moments.h \
  %D%/areas/numbers.cc \
  %D%/areas/numbers.h \
  %D%/areas/shaded.cc \
  %D%/areas/shaded.h \
  %D%/areas/shading.h \
  %D%/areas/shapes.cc \
  %D%/areas/shapes.h \
  %D%/integral/field.cc \
  %D%/integral/field.h \
  %D%/integral/integral.cc \
  %D%/integral/integral.h \
  %D%/integral/numbers.h \
  %D%/integral/path.cc \
  %D%/integral/path.h \
  %D%/integral/pieces.h \
  %D%/integral/post_piece.cc \
  %D%/integral/pre_piece.cc

# No two algorithms have one name: the library is not built.
libcore_a_DEPENDENCIES += %D%/names-once
%D%/names-once: $(algorithm_files) $(oracle_files)
	@$(MKDIR_P) %D%; (cd $(srcdir) && $(AWK) ' \
	  FNR == 1 { found = 0 } \
	  /struct hsr_algorithm HSR_ALGORITHM/ { found = 1 } \
	  found && match($$0, /\.name = "[^"]*"/) { found = 0; \
	    name = substr($$0, RSTART + 9, RLENGTH - 10); \
	    if (name in file) { bad = 1; print FILENAME ": the name " name \
	      " is that of " file[name] > "/dev/stderr" } \
	    file[name] = FILENAME } \
	  END { exit bad }' $(algorithm_files) $(oracle_files)) && : >$@
CLEANFILES += %D%/names-once
