# SPDX-License-Identifier: GPL-3.0-or-later
# Every algorithm is compiled twice: counting and not counting.
nobase_pkginclude_HEADERS += %D%/algorithm.h %D%/setup.h %D%/variant.h
libhsr_a_SOURCES += %D%/registry.c %D%/setup.c %D%/variant.c \
  %D%/list.def %D%/proposals.def

algorithm_files = %D%/box_rows.c %D%/box_rows.h %D%/glass.c %D%/glass.h \
  %D%/shadow.c %D%/shadow.h \
  %D%/object_space/corner_boxes.c %D%/object_space/corner_boxes.h
include %D%/object_space/volumes/local.mk
include %D%/object_space/edges/local.mk
include %D%/list_priority/fixed/local.mk
include %D%/list_priority/fixed/cells/local.mk
include %D%/list_priority/per_frame/local.mk
include %D%/image_space/area/local.mk
include %D%/image_space/area/sorting/local.mk
include %D%/image_space/area/tiling/local.mk
include %D%/image_space/area/warnock/local.mk
include %D%/image_space/area/tiling/masks/local.mk
include %D%/image_space/point/local.mk
include %D%/brute_force/local.mk
include %D%/hierarchical/local.mk
include %D%/hierarchical/culling/local.mk
include %D%/volume/local.mk
include %D%/volume/splats/local.mk
include %D%/volume/textures/local.mk
include bench/judge/oracles.mk

noinst_LIBRARIES += libplain.a libcounting.a
libplain_a_SOURCES = $(algorithm_files)
libplain_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=0
libcounting_a_SOURCES = $(algorithm_files) $(oracle_files)
libcounting_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=1
libhsr_a_LIBADD += $(libplain_a_OBJECTS) $(libcounting_a_OBJECTS)

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
