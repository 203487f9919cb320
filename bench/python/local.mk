# SPDX-License-Identifier: GPL-3.0-or-later
# The module hsr of Python. It reads hsr.h when it is imported, so that is
# installed beside it too.
if WITH_PYTHON
pkgpython_PYTHON = \
  %D%/hsr/__init__.py \
  %D%/hsr/_answer.py \
  %D%/hsr/_arrays.py \
  %D%/hsr/_errors.py \
  %D%/hsr/_header.py \
  %D%/hsr/_library.py \
  %D%/hsr/_lists.py \
  %D%/hsr/_scene.py
pkgpython_DATA = %D%/hsr/py.typed bench/library/hsr.h
endif
EXTRA_DIST += %D%/examples/counts.py %D%/hsr/py.typed
