# SPDX-License-Identifier: GPL-3.0-or-later
# The oracles, which have one build; it counts, and is never timed. And the list
# of all that -a can name.
noinst_LIBRARIES += liboracles.a
oracle_files = \
  %D%/area_oracle.cc \
  %D%/line_oracle.cc \
  %D%/oracle.cc \
  %D%/polygon_oracle.cc \
  %D%/shadow_oracle.cc \
  %D%/splat_oracle.cc \
  %D%/transparent_oracle.cc \
  %D%/voxel_oracle.cc
liboracles_a_SOURCES = $(oracle_files)
liboracles_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=1
libhsr_a_LIBADD += $(liboracles_a_OBJECTS)
nobase_pkginclude_HEADERS += bench/modules/modules.h bench/modules/variant.h
libhsr_a_SOURCES += bench/modules/list.c bench/modules/modules.c \
  bench/modules/oracles.def bench/modules/variant.c %D%/rounding.h %D%/surface.h \
  %D%/vectors.h \
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
  %D%/areas/shapes.h

# No two algorithms have one name: the library is not built.
libhsr_a_DEPENDENCIES += %D%/names-once
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
