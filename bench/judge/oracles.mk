# SPDX-License-Identifier: GPL-3.0-or-later
# The oracles are algorithms, too: compiled with them.
algorithm_files += \
  %D%/line_oracle.cc \
  %D%/oracle.cc \
  %D%/voxel_oracle.cc
libhsr_a_SOURCES += bench/registry.c %D%/list.def
