# SPDX-License-Identifier: GPL-3.0-or-later
libcore_a_SOURCES += %D%/polygon.h
libcore_a_SOURCES += %D%/exact_numbers.h %D%/polygon_cgal.cc \
  %D%/polygon_residue.cc
