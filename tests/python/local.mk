# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of Python's module, with the library of this build.
dist_check_SCRIPTS += %D%/python.test
TESTS += %D%/python.test
EXTRA_DIST += %D%/cases.py %D%/tap.py
