# SPDX-License-Identifier: GPL-3.0-or-later
# Every algorithm is compiled twice: counting and not counting.
libcore_a_SOURCES += %D%/algorithm.h %D%/part.h %D%/prices.h %D%/setup.h
libcore_a_SOURCES += %D%/choice.c %D%/prices.c %D%/registry.c \
  %D%/setup.c %D%/list.def %D%/prices.def %D%/proposals.def

algorithm_files =
include %D%/engines/local.mk
include %D%/object_space/local.mk
include %D%/list_priority/local.mk
include %D%/image_space/local.mk
include %D%/brute_force/local.mk
include %D%/hierarchical/local.mk
include %D%/volume/local.mk

noinst_LIBRARIES += libplain.a libcounting.a
libplain_a_SOURCES = $(algorithm_files)
libplain_a_CPPFLAGS = $(AM_CPPFLAGS) -DHSR_COUNTING=0
libcounting_a_SOURCES = $(algorithm_files)
libcounting_a_CPPFLAGS = -include %D%/counting-names.h $(AM_CPPFLAGS) \
  -DHSR_COUNTING=1
libcore_a_LIBADD += $(libplain_a_OBJECTS) $(libcounting_a_OBJECTS)

# The names of the counting build. The header changes only if a name does.
EXTRA_DIST += %D%/names-again
%D%/counting-names.stamp: $(libplain_a_OBJECTS)
	@NM="$(NM)" $(srcdir)/%D%/names-again _counting $(libplain_a_OBJECTS) \
	  >%D%/counting-names.new
	@cmp -s %D%/counting-names.new %D%/counting-names.h || \
	  cp %D%/counting-names.new %D%/counting-names.h
	@: >$@
%D%/counting-names.h: %D%/counting-names.stamp
	@test -f $@ || { rm -f %D%/counting-names.stamp; $(MAKE) $(AM_MAKEFLAGS) %D%/counting-names.stamp; }
$(libcounting_a_OBJECTS): %D%/counting-names.h
CLEANFILES += %D%/counting-names.new %D%/counting-names.h %D%/counting-names.stamp
