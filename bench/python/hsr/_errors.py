# SPDX-License-Identifier: GPL-3.0-or-later
"""A class for each status of hsr.h."""

from __future__ import annotations


class Error(Exception):
    """A failure, in one line of text. `status` is hsr.h's number for it."""

    status = 0


class UsageError(Error, ValueError):
    """An argument is wrong."""

    status = 2


class InputError(Error, ValueError):
    """A file, a scene or a camera cannot be used as it is."""

    status = 3


class NoMemoryError(Error, MemoryError):
    """Memory ran out, or a limit was met."""

    status = 4


class InternalError(Error, RuntimeError):
    """A fault of hsr, or of a library below it."""

    status = 5


class RefusedError(Error):
    """The algorithm cannot take this scene."""

    status = 6


class StoppedError(Error):
    """The caller's progress function stopped the work."""

    status = 7


_classes = {c.status: c for c in Error.__subclasses__()}


def error_of(status: int, text: str) -> Error:
    """The exception for a status."""
    return _classes.get(status, InternalError)(text)
