# SPDX-License-Identifier: GPL-3.0-or-later
# The oracles have one build, which counts. They are never timed.
oracle_files = \
  %D%/area_oracle.cc \
  %D%/line_oracle.cc \
  %D%/oracle.cc \
  %D%/polygon_oracle.cc \
  %D%/shadow_oracle.cc \
  %D%/splat_oracle.cc \
  %D%/transparent_oracle.cc \
  %D%/voxel_oracle.cc
libhsr_a_SOURCES += bench/registry.c %D%/list.def %D%/rounding.h %D%/surface.h \
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
