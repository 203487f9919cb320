# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of the library, through hsr.h alone.
library_tests = %D%/draw_test %D%/fuzz_test %D%/judge_test %D%/lists_test \
  %D%/memory_test %D%/redraw_test
library_scripts = %D%/install.test %D%/same.test
check_PROGRAMS += $(library_tests) %D%/write
dist_check_SCRIPTS += $(library_scripts)
TESTS += $(library_tests) $(library_scripts)
EXTRA_DIST += %D%/first.c %D%/first.cc %D%/public.h

library_test_flags = -I$(top_srcdir) -I$(top_srcdir)/bench/library
%C%_draw_test_CPPFLAGS = $(library_test_flags)
%C%_draw_test_LDADD = libhsr.so.1
%C%_fuzz_test_CPPFLAGS = $(library_test_flags)
%C%_fuzz_test_LDADD = libhsr.so.1
%C%_judge_test_CPPFLAGS = $(library_test_flags)
%C%_judge_test_LDADD = libhsr.so.1
%C%_lists_test_CPPFLAGS = $(library_test_flags)
%C%_lists_test_LDADD = libhsr.so.1
%C%_memory_test_CPPFLAGS = $(library_test_flags)
%C%_memory_test_LDADD = libhsr.so.1
%C%_redraw_test_CPPFLAGS = $(library_test_flags)
%C%_redraw_test_LDADD = libhsr.so.1
%C%_write_CPPFLAGS = $(library_test_flags)
%C%_write_LDADD = libhsr.so.1
