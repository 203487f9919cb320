# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes and cameras, and how they are drawn."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Callable, NamedTuple, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _arrays
from ._answer import Answer, Verdict, judged
from ._errors import UsageError
from ._library import NO_FACE, call, ffi, lib, string, struct, text
from ._lists import read

Progress = Callable[[float], Any]


# --- Cameras ------------------------------------------------------------------


@dataclass(frozen=True)
class Camera:
    """A camera, in world units and degrees. dataclasses.replace changes one.

    eye       where it is
    at        a point that it looks at
    up        a direction that is upwards in the picture
    fov       vertical angle of view; of no effect in parallel projection
    near      points with depth <= near do not exist
    parallel  above 0: parallel projection, and this is the picture's height
    light     for shadows: x, y, z, 1: a light at this point; x, y, z, 0: a sun
              in this direction; all 0: a sun above the eye's left shoulder
    """

    eye: Sequence[float]
    at: Sequence[float]
    up: Sequence[float] = (0.0, 1.0, 0.0)
    fov: float = 45.0
    near: float = 0.0
    parallel: float = 0.0
    light: Sequence[float] = (0.0, 0.0, 0.0, 0.0)


_VECTORS = {"eye": 3, "at": 3, "up": 3, "light": 4}
_NUMBERS = ("fov", "near", "parallel")


def _camera_struct(camera: Camera) -> Any:
    members: dict[str, Any] = {}
    for name, length in _VECTORS.items():
        members[name] = _numbers(f"camera: {name}", getattr(camera, name), length)
    members.update({name: float(getattr(camera, name)) for name in _NUMBERS})
    return struct("hsr_camera", **members)


def _camera_of(info: Any) -> Camera:
    vectors = {name: tuple(getattr(info, name)) for name in _VECTORS}
    return Camera(**vectors, **{name: getattr(info, name) for name in _NUMBERS})


def _numbers(what: str, values: Sequence[float], length: int) -> list[float]:
    numbers = [float(value) for value in values]
    if len(numbers) != length:
        raise UsageError(f"{what} has {len(numbers)} numbers, not {length}")
    return numbers


# --- Steps --------------------------------------------------------------------


class Subject(NamedTuple):
    """What a step is about, in the scene's ids. Its kind says what the ids are:
    "face": face; "piece": face, number; "edge": vertex, vertex, face; "implied
    edge": face, face, part; "vertex": vertex; "volume": number; others: none."""

    kind: str
    id: tuple[int, int, int]


class Event(NamedTuple):
    """A step of an algorithm.

    number   in the run, from 0
    counter  its place in Algorithm.counters
    step     the counter's kind of step, "compare"
    a, b     what it is about
    window   x0, y0, x1, y1 in samples; empty: about no window
    outcome  the number of one of the counter's outcomes, or 0
    """

    number: int
    counter: int
    step: str
    a: Subject
    b: Subject
    window: tuple[int, int, int, int]
    outcome: int


# The types of these functions, as hsr.h has them.
_PROGRESS = dict(ffi.typeof("struct hsr_request").fields)["progress"].type
_LISTEN = ffi.typeof(lib.hsr_trace).args[2]


class _Caller:
    """The caller's functions, as C calls them. What they raise is kept, and then
    they are not called any more."""

    def __init__(self, progress: Progress | None, listen: Any = None):
        self.raised: BaseException | None = None
        self._progress, self._listen = progress, listen
        self._texts: dict[Any, str | None] = {}
        self.progress = self.listen = None
        if progress or listen:
            self.progress = ffi.callback(_PROGRESS, self._told)
        if listen:
            self.listen = ffi.callback(_LISTEN, self._heard)

    def call(self, function: Any, *arguments: Any) -> None:
        """Calls the library, and raises what the caller's functions raised."""
        try:
            call(function, *arguments)
        finally:
            if self.raised:
                raise self.raised

    def _told(self, _: Any, share: float) -> int:
        go_on = self._run(self._progress, share) if self._progress else None
        return int(not self.raised and (go_on is None or bool(go_on)))

    def _heard(self, _: Any, event: Any) -> None:
        if not self.raised:
            self._run(self._hear, event)

    def _run(self, function: Any, argument: Any) -> Any:
        try:
            return function(argument)
        except BaseException as error:
            self.raised = self.raised or error
            return False

    def _hear(self, e: Any) -> None:
        window = tuple(e.window)
        a, b = self._subject(e.a), self._subject(e.b)
        step = self._text(e.step)
        self._listen(Event(e.number, e.counter, step, a, b, window, e.outcome))

    def _subject(self, subject: Any) -> Subject:
        return Subject(self._text(subject.kind), tuple(subject.id))

    def _text(self, chars: Any) -> Any:
        if chars not in self._texts:
            self._texts[chars] = text(chars)
        return self._texts[chars]


# --- Scenes -------------------------------------------------------------------


@dataclass(frozen=True)
class SceneInfo:
    """What is known of a scene.

    n_vertices      laid out: those of each instance count
    n_views         cameras of its own
    is_grid         it is a volume of cells
    is_transparent  some faces are not opaque
    enlarged        e: all lengths are 2^e times those of the file
    n_dropped       faces without area that were left out
    notes           what else was left out of the file, lines
    """

    name: str
    n_faces: int
    n_vertices: int
    n_objects: int
    n_instances: int
    n_views: int
    is_grid: bool
    is_transparent: bool
    enlarged: int
    n_dropped: int
    notes: str


class Geometry(NamedTuple):
    """The faces of a scene as arrays that share the library's memory.

    xyz          (n_vertices, 3) world units; those of one instance follow those of
                 another
    ring         the number of corners of each face, by its id
    vertex       the vertices of face 0, then of face 1 ..., counter-clockwise seen
                 from the front
    rgb          (n_faces, 3) the face's own colour, linear, 0 to 1
    opacity      of each face, 0 to 1
    object       which object each face is of
    object_name  of each object
    one_sided    of each face: 1 if it exists only when it is seen from its front
    """

    xyz: NDArray[np.float64]
    ring: NDArray[np.uint32]
    vertex: NDArray[np.uint32]
    rgb: NDArray[np.float32]
    opacity: NDArray[np.float32]
    object: NDArray[np.uint32]
    object_name: tuple[str, ...]
    one_sided: NDArray[np.uint8]


class Scene:
    """A scene. hsr.scene and hsr.scene_from_arrays make it.

    It is freed when nothing needs it any more; `close`, or the end of a `with`,
    lets go of it before."""

    def __init__(self, handle: Any):
        self._handle = handle

    @property
    def info(self) -> SceneInfo:
        """What is known of it."""
        info = struct("hsr_scene_info")
        call(lib.hsr_get_scene, self._handle, info)
        return read(SceneInfo, info)

    @property
    def name(self) -> str:
        """Its name."""
        return self.info.name

    @property
    def n_faces(self) -> int:
        """How many faces it has. Their ids are 0 to n_faces - 1."""
        return self.info.n_faces

    @property
    def geometry(self) -> Geometry:
        """Its faces. scene_from_arrays makes a scene of such arrays. That is one
        object, which is one-sided if it is closed."""
        info = struct("hsr_geometry")
        call(lib.hsr_get_geometry, self._handle, info)
        names = [text(info.object_name[k]) for k in range(info.n_objects)]
        n, ids = info.n_faces, np.uint32

        def array(name: str, dtype: Any, *shape: int) -> Any:
            return _arrays.shared(self._handle, getattr(info, name), shape, dtype)

        return Geometry(
            xyz=array("xyz", np.float64, info.n_vertices, 3),
            ring=array("ring", ids, n),
            vertex=array("vertex", ids, info.n_corners),
            rgb=array("rgb", np.float32, n, 3),
            opacity=array("opacity", np.float32, n),
            object=array("object", ids, n),
            object_name=tuple(names),
            one_sided=array("one_sided", np.uint8, n),
        )

    @property
    def cameras(self) -> tuple[Camera, ...]:
        """The cameras of its own."""
        return tuple(self.camera(view) for view in range(self.info.n_views))

    def camera(self, view: int = 0) -> Camera:
        """A camera of its own. View 0 is the command's view 1."""
        info = struct("hsr_camera")
        call(lib.hsr_get_camera, self._handle, view, info)
        return _camera_of(info)

    def render(
        self,
        algorithm: str,
        size: tuple[int, int] = (640, 480),
        *,
        camera: Camera | None = None,
        view: int = 0,
        window: tuple[int, int, int, int] | None = None,
        offset: tuple[float, float] = (0.0, 0.0),
        threads: int = 1,
        counts: bool = False,
        work: bool = False,
        progress: Progress | None = None,
    ) -> Answer:
        """Draws.

        algorithm  with options, as the command takes it: "watkins",
                   "zbuffer-fast:filter=box:jitter=4"
        size       samples, or pixels, a row; rows
        camera     else the scene's own, number `view`
        window     x0, y0, x1, y1: only columns x0 to x1 - 1 of rows y0 to y1 - 1
                   are drawn
        offset     right, down: how far each sample lies from the middle of its
                   place, in samples, above -1/2 and below 1/2
        threads    that draw, 1 to 64
        counts     the build that counts draws, for Answer.counts. It is slower
        work       that build draws, for Answer.work too
        progress   called with the share that is drawn, 0 to 1, now and then, not
                   always in the caller's thread. If it returns False the drawing
                   stops: StoppedError. What it raises stops it too
        """
        caller = _Caller(progress)
        request = _request(
            size, camera, view, window,
            algorithm=string("algorithm", algorithm), offset=offset,
            threads=threads, counts=bool(counts), work=bool(work),
            progress=caller.progress,
        )  # fmt: skip
        answer = ffi.new("struct hsr_answer **")
        caller.call(lib.hsr_draw, self._handle, request, answer)
        return Answer(ffi.gc(answer[0], lib.hsr_free))

    def prepare(
        self, algorithm: str, *, threads: int = 1, counts: bool = False
    ) -> Drawer:
        """Makes an algorithm ready to draw many pictures: what is the same for all
        of them is done once. The arguments are as in `render`."""
        request = struct(
            "hsr_request",
            algorithm=string("algorithm", algorithm),
            threads=threads,
            counts=bool(counts),
        )
        drawer = ffi.new("struct hsr_drawer **")
        call(lib.hsr_prepare, self._handle, request, drawer)
        return Drawer(ffi.gc(drawer[0], lib.hsr_release), algorithm)

    def trace(
        self,
        algorithm: str,
        listen: Callable[[Event], Any],
        size: tuple[int, int] = (640, 480),
        *,
        camera: Camera | None = None,
        view: int = 0,
        window: tuple[int, int, int, int] | None = None,
        progress: Progress | None = None,
    ) -> Answer:
        """Draws in the caller's thread, with the build that counts, and calls
        `listen` with an Event for each step, in order. A picture of 64 x 48
        already has thousands. What `listen` raises ends the trace. The rest is
        as in `render`."""
        caller = _Caller(progress, listen)
        request = _request(
            size, camera, view, window,
            algorithm=string("algorithm", algorithm), progress=caller.progress,
        )  # fmt: skip
        answer = ffi.new("struct hsr_answer **")
        caller.call(
            lib.hsr_trace, self._handle, request, caller.listen, ffi.NULL, answer
        )
        return Answer(ffi.gc(answer[0], lib.hsr_free))

    def judge(
        self,
        ids: Any,
        *,
        camera: Camera | None = None,
        view: int = 0,
        window: tuple[int, int, int, int] | None = None,
        offset: tuple[float, float] = (0.0, 0.0),
        room: int = 1000,
    ) -> Verdict:
        """Compares ids that anybody has found with the right ones.

        ids   an array of rows: the visible face of every sample, as whole numbers
              of any type, floats too. No face is -1, NO_FACE, or the largest
              number of the array's type where no face has that number
        room  how many places are listed at most

        The rest is as in `render`."""
        array = _ids_of(ids, self.n_faces)
        rows, columns = array.shape
        request = _request((columns, rows), camera, view, window, offset=offset)
        pointer = _arrays.pointer_to("uint32_t[]", array)
        return judged(
            (rows, columns), room, lib.hsr_judge_ids, self._handle, request, pointer
        )

    def close(self) -> None:
        """Lets go of the scene. Its answers stay valid."""
        self._handle = ffi.NULL

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        if not self._handle:
            return "<hsr.Scene, closed>"
        info = self.info
        return f"<hsr.Scene {info.name}: {info.n_faces} faces, {info.n_views} views>"


class Drawer:
    """An algorithm that is ready to draw a scene. Scene.prepare makes it. Threads
    that use one at once take turns."""

    def __init__(self, handle: Any, algorithm: str):
        self._handle = handle
        self._algorithm = algorithm

    def render(
        self,
        size: tuple[int, int] = (640, 480),
        *,
        camera: Camera | None = None,
        view: int = 0,
        window: tuple[int, int, int, int] | None = None,
        offset: tuple[float, float] = (0.0, 0.0),
        progress: Progress | None = None,
    ) -> Answer:
        """Draws. The arguments are those of Scene.render."""
        caller = _Caller(progress)
        request = _request(
            size, camera, view, window, offset=offset, progress=caller.progress
        )
        answer = ffi.new("struct hsr_answer **")
        caller.call(lib.hsr_redraw, self._handle, request, answer)
        return Answer(ffi.gc(answer[0], lib.hsr_free))

    def __repr__(self) -> str:
        return f"<hsr.Drawer: {self._algorithm}>"


def _request(
    size: tuple[int, int],
    camera: Camera | None,
    view: int,
    window: tuple[int, int, int, int] | None,
    **members: Any,
) -> Any:
    try:
        m, n = size
    except (TypeError, ValueError):
        raise UsageError(f"size is {size}, not (columns, rows)") from None
    if window is not None and (len(window) != 4 or not any(window)):
        raise UsageError(f"window is {window}, not x0, y0, x1, y1")
    if "offset" in members:
        members["offset"] = _numbers("offset", members["offset"], 2)
    if camera is not None:
        members["camera"] = _camera_struct(camera)
    return struct("hsr_request", m=m, n=n, view=view, window=window, **members)


def _ids_of(ids: Any, n_faces: int) -> Any:
    """Ids as an array of uint32, by the rules of hsr judge."""
    array = _arrays.any_array("ids", ids)
    if array.ndim != 2:
        raise UsageError(f"ids: the shape is {array.shape}, not (rows, columns)")
    if array.dtype.kind not in "iuf":
        return _arrays.taken_ids("ids", array, NO_FACE)
    none = array == -1
    if array.dtype.kind == "u" and np.iinfo(array.dtype).max >= n_faces:
        none |= array == np.iinfo(array.dtype).max
    if array.dtype.kind == "f":
        none |= array == 2.0**32  # NO_FACE in 32 bits
        if not (none | (array == np.floor(array)) & np.isfinite(array)).all():
            raise UsageError("ids: a number is not whole")
        array = np.clip(array, -2, 2.0**40)
    whole = np.where(none, NO_FACE, array.astype(np.int64))
    return _arrays.taken_ids("ids", whole, NO_FACE)


# --- Opening ------------------------------------------------------------------


def scene(
    name: str | os.PathLike[str],
    *,
    threads: int = 1,
    strict: bool = False,
    two_sided: bool = False,
    weld: float = 0,
) -> Scene:
    """Opens a scene.

    name       a built-in one with its parameters ("house", "soup:1000:7"), or a
               file (.obj .off .ply .stl .vtp .gltf .glb .scene.json, volumes and
               height fields), each as the command hsr names it
    threads    that import it, lay it out and prepare it, 1 to 64
    strict     a file with faces that have no area is refused; else they are left
               out and counted
    two_sided  all faces are seen from both sides; else those of a closed mesh are
               seen from outside only
    weld       vertices of a mesh file that are no farther apart are joined, in its
               unit; 0: none are
    """
    options = struct(
        "hsr_open_options",
        threads=threads,
        strict=bool(strict),
        two_sided=bool(two_sided),
        weld=weld,
    )
    return _opened(lib.hsr_open, string("name", name), options)


def scene_from_arrays(
    vertices: Any,
    faces: Any,
    colors: Any = None,
    *,
    opacity: Any = None,
    instances: Any = None,
    name: str = "arrays",
    threads: int = 1,
    two_sided: bool = False,
) -> Scene:
    """Makes a scene of polygons with common vertices. Face f of the arrays is
    face f of the scene; with instances, face f of instance k is face
    f + k * len(faces). Its own cameras are eight around it.

    vertices  (n, 3) coordinates, world units
    faces     (n, k) vertices of each face, counter-clockwise seen from the front;
              or a list of faces of different lengths
    colors    (n, 3) linear red, green and blue of each face, 0 to 1; None: grey
    opacity   (n,) of each face, 0 to 1; None: all are opaque
    instances (n, 3, 4) where the faces stand: world = M (x, y, z, 1); None: as
              they are

    All are copied."""
    xyz = _arrays.taken("vertices", vertices, np.float64, ("n", 3))
    ring, vertex = _rings(faces)
    arrays = struct(
        "hsr_arrays",
        name=string("name", name),
        xyz=_arrays.pointer_to("double[]", xyz),
        n_vertices=len(xyz),
        ring=_arrays.pointer_to("uint32_t[]", ring),
        n_faces=len(ring),
        vertex=_arrays.pointer_to("uint32_t[]", vertex),
        n_corners=len(vertex),
        rgb=None if colors is None else _colors(colors, (len(ring),)),
        opacity=None if opacity is None else _opacity(opacity, len(ring)),
        **_places(instances),
    )
    options = struct("hsr_open_options", threads=threads, two_sided=bool(two_sided))
    return _opened(lib.hsr_open_arrays, arrays, options)


def _opacity(opacity: Any, n: int) -> Any:
    shares = _arrays.taken("opacity", opacity, np.float32, (n,))
    return _arrays.pointer_to("float[]", shares)


def _places(instances: Any) -> dict[str, Any]:
    if instances is None:
        return {}
    matrices = _arrays.taken("instances", instances, np.float64, ("n", 3, 4))
    pointer = _arrays.pointer_to("double[]", matrices)
    return {"instance": pointer, "n_instances": len(matrices)}


def scene_from_grid(
    density: Any,
    least: float,
    most: float = float("inf"),
    colors: Any = None,
    *,
    places: tuple[Any, Any, Any] = (None, None, None),
    name: str = "grid",
    threads: int = 1,
) -> Scene:
    """Makes a scene of a volume. A sample with a density of least to most, both
    included, is kept: it is an opaque box that reaches half-way to its
    neighbours. hsr_open_grid in hsr.h says how its faces are numbered.

    density  (z, y, x), as float32; NaN is never kept
    colors   (z, y, x, 3) linear red, green and blue, 0 to 1; None: grey
    places   ascending x, y and z of the samples, world units; None: 0, 1, 2 ...

    All are copied."""
    samples = _arrays.taken("density", density, np.float32, ("z", "y", "x"))
    shape = samples.shape
    at = [_axis(k, places[k], shape[2 - k]) for k in range(3)]
    grid = struct(
        "hsr_grid_arrays",
        name=string("name", name),
        n=shape[::-1],
        at=at,
        density=_arrays.pointer_to("float[]", samples),
        least=least,
        most=most,
        rgb=None if colors is None else _colors(colors, shape),
    )
    options = struct("hsr_open_options", threads=threads)
    return _opened(lib.hsr_open_grid, grid, options)


def _axis(k: int, places: Any, n: int) -> Any:
    """A pointer to the places of n samples along axis k."""
    if places is None:
        return ffi.NULL
    numbers = _arrays.taken(f"places[{k}]", places, np.float64, (n,))
    return _arrays.pointer_to("double[]", numbers)


def _opened(function: Any, what: Any, options: Any) -> Scene:
    opened = ffi.new("struct hsr_scene **")
    call(function, what, options, opened)
    return Scene(ffi.gc(opened[0], lib.hsr_close))


def _rings(faces: Any) -> tuple[Any, Any]:
    """The number of corners of each face, and all corners."""
    try:
        ring = np.array([len(face) for face in faces], np.uint32)
    except TypeError:
        raise UsageError("faces: not a list of lists of vertices") from None
    if len(set(ring.tolist())) == 1:
        table = _arrays.taken_ids("faces", faces, NO_FACE)
        return ring, table.ravel()
    rows = [_arrays.taken_ids(f"face {f}", row, NO_FACE) for f, row in enumerate(faces)]
    return ring, np.concatenate(rows or [ring])


def _colors(colors: Any, shape: tuple[int, ...]) -> Any:
    rgb = _arrays.taken("colors", colors, np.float32, (*shape, 3))
    return _arrays.pointer_to("float[]", rgb)
