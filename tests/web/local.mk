# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of the core as WebAssembly, where `make web` has built it; and of what it
# computes in another way.
check_PROGRAMS += %D%/hashes %D%/upward_test
%C%_hashes_SOURCES = %D%/hashes.c bench/web/hash.c bench/web/hash.h
%C%_hashes_LDADD = libhsr.so.1
%C%_upward_test_SOURCES = %D%/upward_test.cc
%C%_upward_test_LDADD = $(CGAL_LIBS)
dist_check_SCRIPTS += %D%/web.test
TESTS += %D%/upward_test %D%/web.test
EXTRA_DIST += %D%/core.mjs %D%/differing.mjs %D%/equal.mjs \
  %D%/firefox.mjs %D%/times.mjs %D%/worker.mjs
