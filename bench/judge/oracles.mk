# SPDX-License-Identifier: GPL-3.0-or-later
# The oracles have one build, which counts. They are never timed.
oracle_files = \
  %D%/line_oracle.cc \
  %D%/oracle.cc \
  %D%/splat_oracle.cc \
  %D%/voxel_oracle.cc
libhsr_a_SOURCES += bench/registry.c %D%/list.def
