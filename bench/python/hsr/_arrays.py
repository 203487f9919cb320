# SPDX-License-Identifier: GPL-3.0-or-later
"""numpy arrays of memory that the library owns, and of the caller's."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._errors import UsageError
from ._library import ffi


class Memory:
    """Memory that belongs to a handle. It is the base of an array, and keeps the
    handle for as long as the array is there."""

    def __init__(self, handle: Any, pointer: Any, shape: Any, typestr: str):
        self.handle = handle
        address = int(ffi.cast("uintptr_t", pointer))
        self.__array_interface__ = {
            "version": 3,
            "data": (address, True),  # it is only read
            "shape": shape,
            "typestr": typestr,
        }

    def __repr__(self) -> str:
        return f"<memory of {self.handle!r}>"


def shared(handle: Any, pointer: Any, shape: Any, dtype: Any) -> Any:
    """An array of the memory at a pointer, without a copy. Nobody may write to
    it."""
    plain = np.dtype(dtype)
    if 0 in shape:
        return frozen(np.empty(shape, plain))
    array = np.asarray(Memory(handle, pointer, shape, plain.str))
    return array.view(plain) if plain.names else array


def frozen(array: Any) -> Any:
    """The array, to which nobody may write any more."""
    array.flags.writeable = False
    return array


def dtype_of(name: str) -> np.dtype[Any]:
    """The dtype of a struct. Reserved members are left out."""
    fields = [f for f in ffi.typeof(f"struct {name}").fields if f[0] != "reserved"]
    return np.dtype(
        {
            "names": [name for name, _ in fields],
            "formats": [_format(field.type) for _, field in fields],
            "offsets": [field.offset for _, field in fields],
            "itemsize": ffi.sizeof(f"struct {name}"),
        }
    )


def _format(type_: Any) -> Any:
    if type_.kind == "array":
        return (_format(type_.item), (type_.length,))
    if type_.cname in ("double", "float"):
        return f"f{ffi.sizeof(type_)}"
    return f"u{ffi.sizeof(type_)}"


# --- The caller's -------------------------------------------------------------


def taken(what: str, value: Any, dtype: Any, shape: tuple[Any, ...]) -> Any:
    """The caller's numbers as an array that C can read. A word in the shape stands
    for any number."""
    try:
        array = np.ascontiguousarray(value, dtype)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{what}: {_line(error)}") from None
    fits = [isinstance(want, str) or want == n for n, want in zip(array.shape, shape)]
    if array.ndim != len(shape) or not all(fits):
        wanted = ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "")
        raise UsageError(f"{what}: the shape is {array.shape}, not ({wanted})")
    return array


def taken_ids(what: str, value: Any, most: int) -> Any:
    """The caller's whole numbers, 0 to `most`, as an array of uint32."""
    array = any_array(what, value)
    if array.dtype.kind not in "iu":
        raise UsageError(f"{what}: not whole numbers, but {array.dtype}")
    if array.size and not 0 <= int(array.min()) <= int(array.max()) <= most:
        raise UsageError(f"{what}: a number is not in 0 to {most}")
    return array.astype(np.uint32, order="C", copy=False)


def any_array(what: str, value: Any) -> Any:
    """The caller's numbers as an array, of any kind."""
    try:
        return np.asarray(value)
    except ValueError as error:
        raise UsageError(f"{what}: {_line(error)}") from None


def _line(error: Exception) -> str:
    return " ".join(str(error).split())


def pointer_to(kind: str, array: Any) -> Any:
    """A pointer for C, which keeps the array."""
    return ffi.from_buffer(kind, array)
