# SPDX-License-Identifier: GPL-3.0-or-later
"""libhsr: found, loaded, and called."""

# By cffi in ABI mode: it reads the declarations from hsr.h itself, so that none
# is written twice, as ctypes would need; and the user needs no compiler.

from __future__ import annotations

import os
import sysconfig
from pathlib import Path
from typing import Any, Iterator
from weakref import WeakKeyDictionary

import cffi

from . import _header
from ._errors import UsageError, error_of

ffi = cffi.FFI()
ffi.cdef(_header.declarations(_header.find().read_text(encoding="utf-8")))


# --- Where it is --------------------------------------------------------------


def _places(name: str) -> Iterator[str]:
    """The files that it may be, best first; the last is for the loader."""
    own = os.environ.get("HSR_LIBRARY")
    if own:
        yield own
        return
    architecture = sysconfig.get_config_var("MULTIARCH") or ""
    for folder in list(Path(__file__).resolve().parent.parents)[:5]:
        for lib in ("lib", "lib64", f"lib/{architecture}"):
            if (folder / lib / name).is_file():
                yield str(folder / lib / name)
    yield name


def _load() -> tuple[Any, str]:
    name = "libhsr.so.%d" % _major()
    place = next(_places(name))
    try:
        found = ffi.dlopen(place)
        found.hsr_version  # else it is some other library
        return found, place
    except (OSError, AttributeError) as error:
        why = " ".join(str(error).split())
        raise ImportError(
            f"hsr: {name} is not found; HSR_LIBRARY may name it ({why})"
        ) from None


def _major() -> int:
    """HSR_VERSION_MAJOR of hsr.h."""
    constants = ffi.dlopen(None)  # a constant needs no library
    return constants.HSR_VERSION_MAJOR


lib, path = _load()

NO_FACE: int = lib.HSR_NO_FACE


# --- Calls --------------------------------------------------------------------


def call(function: Any, *arguments: Any) -> None:
    """Calls a function that can fail, and raises its error."""
    error = ffi.new("struct hsr_error *")
    try:
        status = function(*arguments, error)
    except OverflowError as wrong:
        raise UsageError(f"a number is out of range: {wrong}") from None
    if status:
        raise error_of(status, text(error.text) or "")


def text(chars: Any) -> str | None:
    """What a C string says; None for NULL."""
    return ffi.string(chars).decode("utf-8", "replace") if chars else None


def string(what: str, value: str | os.PathLike[str]) -> Any:
    """A C string. File names keep their bytes."""
    chars = os.fsencode(value)
    if b"\0" in chars:
        raise UsageError(f"{what}: there is a NUL character in it")
    return ffi.new("char[]", chars)


# What a struct points to lives as long as the struct.
_kept: WeakKeyDictionary[Any, list[Any]] = WeakKeyDictionary()


def struct(name: str, /, **members: Any) -> Any:
    """A struct with its size and these members set; None leaves one as it is."""
    made = ffi.new(f"struct {name} *")
    made.size = ffi.sizeof(f"struct {name}")
    members = {m: v for m, v in members.items() if v is not None}
    kept = [v for v in members.values() if isinstance(v, ffi.CData)]
    if kept:
        _kept[made] = kept
    for member, value in members.items():
        try:
            setattr(made, member, value)
        except OverflowError:
            raise UsageError(f"{member} is {value}: out of range") from None
    return made


def words_of(enum: str, prefix: str) -> dict[str, int]:
    """The words for the values of an enum: "left-out" for PREFIX_LEFT_OUT."""
    values = ffi.typeof(f"enum {enum}").elements
    return {
        name[len(prefix) :].lower().replace("_", "-"): value
        for value, name in sorted(values.items())
    }


def value_of(what: str, word: str, words: dict[str, int]) -> int:
    """The value of a word."""
    if word not in words:
        raise UsageError(f"{what}: {word!r} is none of {', '.join(words)}")
    return words[word]
