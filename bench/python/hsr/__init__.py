# SPDX-License-Identifier: GPL-3.0-or-later
"""hsr: hidden-surface algorithms, a judge of their answers, and a count of their
work.

    import hsr
    house = hsr.scene("house")
    p = house.render("watkins", size=(640, 480), counts=True)
    p.ids[240, 320]             # the face in the middle; hsr.NO_FACE: none
    p.depth, p.colors           # arrays of the same size
    p.counts["X merge"]         # what the algorithm did
    hsr.judge(p)                # 307200 compared, 0 differ
    hsr.judge(house, p.ids)     # the same for ids that any program has found
    p.write("house.png")

hsr.algorithms(), hsr.kinds() and hsr.scenes() list what there is. An algorithm
has options and counters:

    hsr.algorithm("watkins").options

Other kinds of answers are drawn by algorithms that make them:

    house.render("appel").segments              # a line drawing
    house.render("weiler-atherton").polygons    # the visible regions
    house.render("zbuffer-fast:filter=box").colors

Many pictures of one scene are drawn by an algorithm that is made ready once:

    d = house.prepare("bsp-front")
    frames = [d.render(view=k) for k in range(len(house.cameras))]

A scene is built in, a file, or made of arrays:

    hsr.scene("bunny.ply")
    hsr.scene_from_arrays([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    hsr.scene_from_grid(density, least=0.5)

Conventions: the world is right-handed, in any unit. Arrays of pictures are
[row, column], rows from the top. Depth is the parameter of a point on its ray,
which starts at the eye. Colours are linear. Errors are of class hsr.Error: one
class for each cause. Functions may be called by several threads at once; they
draw in parallel.

The library libhsr is found in the tree where the package is installed, by the
variable HSR_LIBRARY, or by the system's loader. hsr.h says more about each
function.
"""

from __future__ import annotations

from typing import Any

from ._answer import Answer, AnswerInfo, Polygons, Verdict, Voxels
from ._errors import (
    Error,
    InputError,
    InternalError,
    NoMemoryError,
    RefusedError,
    StoppedError,
    UsageError,
)
from ._library import NO_FACE, lib as _lib, path as library_path, text as _text
from ._lists import (
    Algorithm,
    Builtin,
    Counter,
    Kind,
    Option,
    Word,
    algorithm,
    algorithms,
    kinds,
    scenes,
)
from ._scene import (
    Camera,
    Drawer,
    Event,
    Geometry,
    Scene,
    SceneInfo,
    Subject,
    scene,
    scene_from_arrays,
    scene_from_grid,
)

__version__: str = _text(_lib.hsr_version()) or ""


def judge(what: Scene | Answer, ids: Any = None, **more: Any) -> Verdict:
    """Compares an answer with the right one: judge(answer). Or ids that anybody
    has found for a scene: judge(scene, ids, camera=...), which takes what
    Scene.judge takes."""
    if isinstance(what, Scene):
        return what.judge(ids, **more)
    if ids is not None:
        raise UsageError("ids are judged with a scene, not with an answer")
    return what.judge(**more)


__all__ = [
    "NO_FACE",
    "Algorithm",
    "Answer",
    "AnswerInfo",
    "Builtin",
    "Camera",
    "Counter",
    "Drawer",
    "Error",
    "Event",
    "Geometry",
    "InputError",
    "InternalError",
    "Kind",
    "NoMemoryError",
    "Option",
    "Polygons",
    "RefusedError",
    "Scene",
    "SceneInfo",
    "StoppedError",
    "Subject",
    "UsageError",
    "Verdict",
    "Voxels",
    "Word",
    "algorithm",
    "algorithms",
    "judge",
    "kinds",
    "library_path",
    "scene",
    "scene_from_arrays",
    "scene_from_grid",
    "scenes",
]

for _class in [Error, *Error.__subclasses__()]:
    _class.__module__ = __name__  # tracebacks name them so
