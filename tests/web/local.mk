# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of the core as WebAssembly, where `make web` has built it.
check_PROGRAMS += %D%/hashes
%C%_hashes_SOURCES = %D%/hashes.c bench/web/hash.c bench/web/hash.h
%C%_hashes_LDADD = libhsr.so.1
dist_check_SCRIPTS += %D%/web.test
TESTS += %D%/web.test
EXTRA_DIST += %D%/core.mjs %D%/equal.mjs %D%/times.mjs %D%/worker.mjs
