# SPDX-License-Identifier: GPL-3.0-or-later
nobase_pkginclude_HEADERS += %D%/polygon.h
libhsr_a_SOURCES += %D%/exact_numbers.h %D%/polygon_cgal.cc \
  %D%/polygon_residue.cc
