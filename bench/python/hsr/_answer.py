# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers: as arrays, judged, and written to files."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _arrays
from ._errors import UsageError
from ._library import call, ffi, lib, string, struct, value_of, words_of
from ._lists import Algorithm, algorithms, read

_SHADINGS = words_of("hsr_shading_choice", "HSR_COLOUR_")
_HIDDEN = words_of("hsr_hidden_lines", "HSR_LINES_")
_SEGMENT = _arrays.dtype_of("hsr_segment")


# --- Judging ------------------------------------------------------------------


@dataclass(frozen=True)
class Verdict:
    """What the judge says.

    compared   how many places, as the kind of answer has them
    differing  how many of them differ
    first      the first difference in words, "(3, 4): face 5, not background"
    places     rows and columns of the first places that differ, so that
               ids[verdict.places] are the ids there. None are listed of kinds
               that are compared as a whole
    """

    compared: int
    differing: int
    first: str
    places: tuple[NDArray[np.intp], NDArray[np.intp]]

    @property
    def is_right(self) -> bool:
        """Whether nothing differs."""
        return not self.differing

    def __repr__(self) -> str:
        first = f": {self.first}" if self.first else ""
        return (
            f"<hsr.Verdict: {self.compared} compared, {self.differing} differ{first}>"
        )


def judged(
    shape: tuple[int, int], room: int, function: Any, *arguments: Any
) -> Verdict:
    """A verdict by a function of the library."""
    try:
        place = np.empty(room, np.uint32)
    except (TypeError, ValueError):
        raise UsageError(f"room is {room}") from None
    info = struct(
        "hsr_verdict", place=_arrays.pointer_to("uint32_t[]", place), room=room
    )
    call(function, *arguments, info)
    places = np.unravel_index(place[: info.n_places].astype(np.intp), shape)
    return read(Verdict, info, places=places)


# --- Parts of answers ---------------------------------------------------------


@dataclass(frozen=True)
class AnswerInfo:
    """What is known of an answer.

    kind_name   its kind, "ids"
    algorithm   the text of the request
    m, n        columns and rows
    window      what was drawn: x0, y0, x1, y1
    adapted     how the scene was adapted, "triangulate"; ""
    """

    kind_name: str
    algorithm: str
    m: int
    n: int
    window: tuple[int, int, int, int]
    adapted: str
    adapt_seconds: float
    prepare_seconds: float
    draw_seconds: float


@dataclass(frozen=True, repr=False)
class Polygons:
    """The regions of the picture where faces are visible. Region r is of face[r]
    and has the cycles cycle[r] to cycle[r + 1] - 1: its outer boundary, then
    holes. Cycle c has the points xy[point[c]:point[c + 1]], in pixels to the right
    and down from the corner of the picture. The region is to the right of each
    side."""

    face: NDArray[np.uint32]
    cycle: NDArray[np.uintp]
    point: NDArray[np.uintp]
    xy: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.face)

    def __iter__(self) -> Iterator[tuple[int, list[NDArray[np.float64]]]]:
        """Each region: its face, and an array of points for each cycle."""
        for r, face in enumerate(self.face):
            cycles = range(int(self.cycle[r]), int(self.cycle[r + 1]))
            yield int(face), [
                self.xy[self.point[c] : self.point[c + 1]] for c in cycles
            ]

    def __repr__(self) -> str:
        return f"<hsr.Polygons: {len(self)} regions, {len(self.xy)} points>"


@dataclass(frozen=True, repr=False)
class Voxels:
    """Cubes of the world, and the solid that each is in.

    lo     the lowest corner of the first; world units
    side   of a cube; world units
    solid  [z, y, x]: from 1; 0: in none
    """

    lo: tuple[float, float, float]
    side: float
    solid: NDArray[np.uint32]

    def __repr__(self) -> str:
        z, y, x = self.solid.shape
        return f"<hsr.Voxels: {x} x {y} x {z} cubes of {self.side:g}>"


# --- Answers ------------------------------------------------------------------


class Answer:
    """What an algorithm has drawn: Scene.render and Scene.trace make it.

    Its arrays are the library's own memory. Nobody may write to them, and they
    stay valid when the answer is gone. Only depths and colors are made when they
    are asked for. An answer of a kind that has not what is asked for raises
    UsageError: what there is depends on `kind`.

    ids, shadowed  ids, depth, colors; shadowed: lit too
    segments       segments
    polygons       polygons, depth, colors
    area           areas, colors
    filtered       sums, colors
    transparent    rgba, colors
    composited     rgba, colors
    voxels         voxels
    """

    def __init__(self, handle: Any):
        self._handle = handle

    # What is known of it

    @property
    def info(self) -> AnswerInfo:
        """What is known of it: times, the window, how the scene was adapted."""
        info = self._info()
        return read(AnswerInfo, info, window=tuple(info.window))

    @property
    def kind(self) -> str:
        """The name of its kind, "ids"."""
        return self.info.kind_name

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        info = self._info()
        return info.m, info.n

    @property
    def algorithm(self) -> Algorithm:
        """The algorithm that drew it."""
        return algorithms()[self._info().algorithm_number]

    # Arrays of the library's

    @property
    def ids(self) -> NDArray[np.uint32]:
        """(n, m) the face at each sample, or NO_FACE."""
        pointer = self._pointer(lib.hsr_get_ids, "uint32_t")
        return self._array(pointer, self._shape(), np.uint32)

    @property
    def summary(self) -> str:
        """A line about what is in it, as hsr render prints it."""
        text = ffi.new("char[]", 400)
        call(lib.hsr_get_summary, self._handle, text, len(text))
        return ffi.string(text).decode()

    @property
    def lit(self) -> NDArray[np.bool_]:
        """(n, m) whether light reaches the face that is seen."""
        pointer = self._pointer(lib.hsr_get_lit, "unsigned char")
        return self._array(pointer, self._shape(), np.bool_)

    @property
    def segments(self) -> NDArray[np.void]:
        """The intervals of a line drawing, edge by edge: an array with the fields
        of struct hsr_segment. a, b: the vertices of the edge, or the faces whose
        implied edge it is; part: its number then; invisibility: how many faces
        hide it; t0, t1: in [0, 1] along the edge; from, to: its ends."""
        n = ffi.new("size_t *")
        pointer = self._pointer(lib.hsr_get_segments, "struct hsr_segment", n)
        return self._array(pointer, (n[0],), _SEGMENT)

    @property
    def polygons(self) -> Polygons:
        """The regions where faces are visible."""
        p = struct("hsr_polygon_arrays")
        call(lib.hsr_get_polygons, self._handle, p)
        return Polygons(
            self._array(p.face, (p.n_regions,), np.uint32),
            self._array(p.cycle, (p.n_regions + 1,), np.uintp),
            self._array(p.point, (p.n_cycles + 1,), np.uintp),
            self._array(p.xy, (p.n_points, 2), np.float64),
        )

    @property
    def areas(self) -> NDArray[np.float64]:
        """(n, m, 3, 2) for red, green and blue of each pixel the ends of an
        interval that holds the exact area integral."""
        pointer = self._pointer(lib.hsr_get_areas, "double")
        return self._array(pointer, (*self._shape(), 3, 2), np.float64)

    @property
    def sums(self) -> NDArray[np.uint32]:
        """(n, m, 3) weighted sums of samples."""
        pointer = self._pointer(lib.hsr_get_sums, "uint32_t")
        return self._array(pointer, (*self._shape(), 3), np.uint32)

    @property
    def rgba(self) -> NDArray[np.uint16]:
        """(n, m, 3) red, green and blue, linear, 65535 is 1; or (n, m, 4): these,
        premultiplied, and opacity."""
        channels = ffi.new("int *")
        pointer = self._pointer(lib.hsr_get_rgba, "uint16_t", channels)
        return self._array(pointer, (*self._shape(), channels[0]), np.uint16)

    @property
    def voxels(self) -> Voxels:
        """The cubes, and the solid that each is in."""
        v = struct("hsr_voxel_array")
        call(lib.hsr_get_voxels, self._handle, v)
        solid = self._array(v.solid, tuple(v.n)[::-1], np.uint32)
        return Voxels(tuple(v.lo), v.side, solid)

    @property
    def count(self) -> NDArray[np.uint64]:
        """The counts, by the number of the counter: see Algorithm.counters. Of an
        answer that was drawn with counts=True, or traced."""
        n = ffi.new("size_t *")
        pointer = self._pointer(lib.hsr_get_counts, "uint64_t", n)
        return self._array(pointer, (n[0],), np.uint64)

    @property
    def counts(self) -> dict[str, int]:
        """The counts, by the name of the counter."""
        names = [counter.name for counter in self.algorithm.counters]
        return dict(zip(names, self.count.tolist()))

    @property
    def work(self) -> NDArray[np.float32]:
        """(n, m) how often the algorithm looked at each sample. Of an answer that
        was drawn with work=True."""
        pointer = self._pointer(lib.hsr_get_work, "float")
        return self._array(pointer, self._shape(), np.float32)

    # Arrays that are made

    @cached_property
    def depth(self) -> NDArray[np.float32]:
        """(n, m) the depth of the face that is seen, or infinity."""
        depth = np.empty(self._shape(), np.float32)
        pointer = _arrays.pointer_to("float[]", depth)
        call(lib.hsr_get_depths, self._handle, pointer, depth.size)
        return _arrays.frozen(depth)

    @cached_property
    def colors(self) -> NDArray[np.float32]:
        """(n, m, 3) linear red, green and blue, 0 to 1, as the command shows
        them."""
        return _arrays.frozen(self.shaded("lambert"))

    def shaded(self, shading: str) -> NDArray[np.float32]:
        """(n, m, 3) colors, with another shading: "lambert", "flat" (the face's
        own), "ids" (a colour for each id) or "gouraud"."""
        rgb = np.empty((*self._shape(), 3), np.float32)
        call(
            lib.hsr_get_colours,
            self._handle,
            value_of("shading", shading, _SHADINGS),
            _arrays.pointer_to("float[]", rgb),
            rgb.size,
        )
        return rgb

    # What is done with it

    def judge(self, room: int = 1000) -> Verdict:
        """Compares it with the oracle's answer, which is drawn for that. At most
        `room` places are listed."""
        return judged(self._shape(), room, lib.hsr_judge, self._handle)

    def write(
        self,
        path: str | os.PathLike[str],
        *,
        shading: str = "lambert",
        hidden: str = "left-out",
        crease: float = 0.0,
        background: Sequence[float] | None = None,
        style: str | os.PathLike[str] | None = None,
    ) -> None:
        """Writes it to a file, as hsr render -o does: .exr .png ... of pictures,
        .svg .pdf .eps .dxf .vtp .json of drawings, .vti of voxels.

        shading     as in `shaded`
        hidden      how hidden lines are drawn: "left-out", "dashed", "thin", "all"
        crease      edges where faces meet at less than so many degrees are left
                    out, unless they are outlines; 0: all are drawn
        background  linear red, green and blue
        style       how lines are drawn: "screen", "iso", "plotter", or a .json file;
                    `hidden` and `crease` overrule it, unless they are standard
        """
        style = struct(
            "hsr_style",
            shading=value_of("shading", shading, _SHADINGS),
            hidden=value_of("hidden", hidden, _HIDDEN),
            crease=crease,
            background=None if background is None else _background(background),
            style=None if style is None else string("style", style),
        )
        call(lib.hsr_write, self._handle, string("path", path), style)

    def close(self) -> None:
        """Lets go of the answer. Its arrays stay valid."""
        self._handle = ffi.NULL

    def __enter__(self) -> Answer:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        if not self._handle:
            return "<hsr.Answer, closed>"
        i = self.info
        return f"<hsr.Answer: {i.kind_name} by {i.algorithm}, {i.m} x {i.n}>"

    # How it is read

    def _info(self) -> Any:
        info = struct("hsr_answer_info")
        call(lib.hsr_get_answer, self._handle, info)
        return info

    def _shape(self) -> tuple[int, int]:
        m, n = self.size
        return n, m

    def _pointer(self, function: Any, type_: str, *more: Any) -> Any:
        pointer = ffi.new(f"{type_} *[1]")
        call(function, self._handle, pointer, *more)
        return pointer[0]

    def _array(self, pointer: Any, shape: tuple[int, ...], dtype: Any) -> Any:
        return _arrays.shared(self._handle, pointer, shape, dtype)


def _background(rgb: Sequence[float]) -> Any:
    if len(rgb) != 3:
        raise UsageError(f"background has {len(rgb)} numbers, not 3")
    return ffi.new("float[3]", [float(value) for value in rgb])
