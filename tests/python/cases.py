# SPDX-License-Identifier: GPL-3.0-or-later
"""The module hsr, function by function. The word is a folder for files."""

import copy
import dataclasses
import gc
import inspect
import pydoc
import re
import sys
import threading
import weakref
from pathlib import Path

import hsr
import numpy as np
from hsr import _header, _library
from tap import ok, raises, run

SIZE = (64, 48)
ALL = 64 * 48
folder = Path(sys.argv[1])
house = hsr.scene("house")


# --- hsr.h --------------------------------------------------------------------

PACKAGE = Path(hsr.__file__).parent


def test_functions():
    names = re.findall(r"\b(hsr_[a-z_]+)\(", _header.declarations(header()))
    source = "".join(path.read_text() for path in PACKAGE.glob("_*.py"))
    missing = [name for name in names if f"lib.{name}" not in source]
    ok(len(names) > 25 and not missing, f"{len(names)} functions: {missing}")


def header():
    return _header.find().read_text()


STRUCTS = {
    hsr.Builtin: "hsr_builtin_info",
    hsr.Kind: "hsr_kind_info",
    hsr.Word: "hsr_word_info",
    hsr.Option: "hsr_option_info",
    hsr.Counter: "hsr_counter_info",
    hsr.Algorithm: "hsr_algorithm_info",
    hsr.SceneInfo: "hsr_scene_info",
    hsr.Camera: "hsr_camera",
    hsr.Geometry: "hsr_geometry",
    hsr.AnswerInfo: "hsr_answer_info",
    hsr.Verdict: "hsr_verdict",
    hsr.Polygons: "hsr_polygon_arrays",
    hsr.Voxels: "hsr_voxel_array",
    hsr.Event: "hsr_event",
    hsr.Subject: "hsr_subject",
}
# What Python shows in another way.
OTHER = {
    "Option": {"n_words"},
    "Algorithm": {"n_options", "n_counters"},
    "Geometry": {"n_vertices", "n_faces", "n_corners", "n_objects"},
    "AnswerInfo": {"kind", "algorithm_number"},
    "Verdict": {"place", "room", "n_places"},
    "Polygons": {"n_regions", "n_cycles", "n_points"},
    "Voxels": {"n"},
}


def test_structs():
    for cls, name in STRUCTS.items():
        members = {m for m, _ in _library.ffi.typeof(f"struct {name}").fields}
        missing = members - {"size"} - OTHER.get(cls.__name__, set())
        missing -= set(cls.__annotations__)
        ok(not missing, f"{cls.__name__} has what struct {name} has: {missing}")


def test_statuses():
    statuses = _library.ffi.typeof("enum hsr_status").elements
    numbers = {c.status for c in hsr.Error.__subclasses__()}
    ok(numbers == set(statuses) - {0, 1}, f"a class for each status: {numbers}")


# --- Lists --------------------------------------------------------------------


def test_lists():
    ok(re.fullmatch(r"\d+\.\d+\.\d+.*", hsr.__version__), hsr.__version__)
    ok("house" in [s.name for s in hsr.scenes()], f"{len(hsr.scenes())} scenes")
    ok("ids" in [k.name for k in hsr.kinds()], f"{len(hsr.kinds())} kinds")
    names = [a.name for a in hsr.algorithms()]
    ok(len(names) > 30 and hsr.algorithms()[0].is_oracle, f"{len(names)} algorithms")
    same = [hsr.algorithm(name) is a for name, a in zip(names, hsr.algorithms())]
    ok(all(same), "each is found by its name")


def test_algorithm():
    watkins = hsr.algorithm("watkins")
    ok((watkins.kind, watkins.year) == ("ids", 1970), f"{watkins!r}")
    ok({"ids", "filtered"} <= set(watkins.kinds), f"it makes {watkins.kinds}")
    words = {o.name: [w.name for w in o.words] for o in watkins.options}
    ok(words["x-list"] == ["list", "tree"] and not words["window"], f"{words}")
    steps = {c.name: c.step for c in watkins.counters}
    ok(steps["Y sort"] == "sort", f"{len(steps)} counters")
    unique = [len({c.name for c in a.counters}) for a in hsr.algorithms()]
    ok(unique == [len(a.counters) for a in hsr.algorithms()], "names are unique")
    raises(hsr.UsageError, "watkins", hsr.algorithm, "watkin")


# --- Scenes -------------------------------------------------------------------


def test_scene():
    info = house.info
    ok((info.name, house.name, house.n_faces) == ("house", "house", 231), f"{info}")
    ok(len(house.cameras) == info.n_views, f"{info.n_views} cameras")
    with hsr.scene("soup:50:7", threads=2, two_sided=True) as soup:
        ok(soup.n_faces == 50, repr(soup))
    raises(hsr.UsageError, "NULL", lambda: soup.info)
    ok("closed" in repr(soup), repr(soup))


def test_weld():
    path = folder / "near.obj"
    with open(path, "w") as near:
        near.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0.001 0\nv 0 1 0.001\nv 1 1 0\n")
        near.write("f 1 2 3\nf 4 6 5\n")
    with hsr.scene(path, weld=0.01) as joined:
        ok("2 vertices joined" in joined.info.notes, joined.info.notes)
    with hsr.scene(path) as apart:
        ok(not apart.info.notes, apart.info.notes)
    raises(hsr.UsageError, "weld must be", lambda: hsr.scene("house", weld=-1))


TETRAHEDRON = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
SIDES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
COLORS = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]]


def test_arrays_scene():
    s = hsr.scene_from_arrays(TETRAHEDRON, SIDES, COLORS, name="little")
    ok((s.name, s.n_faces, s.info.n_vertices) == ("little", 4, 4), repr(s))
    p = s.render("newell", SIZE)
    seen = p.ids != hsr.NO_FACE
    ok(seen.any() and p.ids[seen].max() < 4 and p.judge().is_right, "it is drawn")
    own = np.array(COLORS, np.float32)[p.ids[seen]]
    ok((p.shaded("flat")[seen] == own).all(), "its faces have their colors")


def test_faces():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]])
    mixed = hsr.scene_from_arrays(vertices, [[0, 3, 2, 1], (0, 1, 4)])
    ok(mixed.n_faces == 2, "faces of 4 and 3 vertices")
    table = np.array([[0, 1, 2], [0, 2, 3]], np.int64)
    ok(hsr.scene_from_arrays(vertices, table).n_faces == 2, "a table of triangles")
    strided = np.zeros((5, 6), np.float32)
    strided[:, ::2] = vertices
    same = hsr.scene_from_arrays(strided[:, ::2], table[::-1])
    ok(same.render("zbuffer", SIZE).judge().is_right, "arrays with gaps")


def test_geometry():
    glass = hsr.scene("greenhouse", two_sided=True)
    g = glass.geometry
    ok(len(g.ring) == glass.n_faces and g.ring.sum() == len(g.vertex), "its faces")
    ok(0 < g.opacity.min() < 1 and not g.xyz.flags.writeable, "glass, to be read only")
    ok(len(g.object_name) == glass.info.n_objects > g.object.max(), f"{g.object_name}")
    faces = np.split(g.vertex, np.cumsum(g.ring)[:-1])
    made = hsr.scene_from_arrays(
        g.xyz, faces, g.rgb, opacity=g.opacity, two_sided=True
    )
    ok(not g.one_sided.any(), "all two-sided")
    camera, algorithm = glass.camera(0), "transparent-oracle"
    a, b = (s.render(algorithm, SIZE, camera=camera) for s in (glass, made))
    ok((a.rgba == b.rgba).all(), "they make the same scene")
    raises(hsr.UsageError, "opacity", hsr.scene_from_arrays, TETRAHEDRON, SIDES,
           opacity=[1, 2])  # fmt: skip
    raises(hsr.InputError, "face 3", hsr.scene_from_arrays, TETRAHEDRON, SIDES,
           opacity=[1, 0, 0.5, 1.5])  # fmt: skip


def test_instances():
    places = np.zeros((2, 3, 4))
    places[:] = np.eye(3, 4)
    places[1, 0, 3] = 5
    s = hsr.scene_from_arrays(TETRAHEDRON, SIDES, instances=places)
    ok((s.n_faces, s.info.n_instances, s.info.n_objects) == (8, 2, 1), f"{s.info}")
    front = hsr.Camera(eye=(5.2, 0.2, -9), at=(5.2, 0.2, 0), parallel=0.1)
    p = s.render("zbuffer", (3, 3), camera=front)
    ok(p.ids[1, 1] == 4, "face 0 of instance 1")
    make, usage = hsr.scene_from_arrays, hsr.UsageError
    raises(usage, "(n, 3, 4)", make, TETRAHEDRON, SIDES, instances=np.eye(4))
    places[1, 0, 3] = np.inf
    raises(hsr.InputError, "instance 1", make, TETRAHEDRON, SIDES, instances=places)


def test_grid():
    density = np.zeros((2, 3, 4))
    density[1, 2, 3] = 9
    colors = np.zeros((2, 3, 4, 3))
    colors[1, 2, 3] = (1, 0, 0)
    make, usage = hsr.scene_from_grid, hsr.UsageError
    s = make(density, 5, 9, colors, places=(None, None, [1, 4]), name="box")
    ok((s.name, s.n_faces, s.info.is_grid) == ("box", 6, True), f"{s.info}")
    front = hsr.Camera(eye=(3, 2, 10), at=(3, 2, 0), parallel=0.1)
    p = s.render("btf", (3, 3), camera=front)
    ok(p.ids[1, 1] == 5 and p.depth[1, 1] == 4.5, "x, y, z are where they should be")
    ok((p.shaded("flat")[1, 1] == (1, 0, 0)).all(), "it is red")
    ok(p.judge().is_right, "it is right")
    raises(usage, "(z, y, x)", make, density[0], 1)
    raises(usage, "colors", make, density, 1, colors=colors[:1])
    raises(usage, "places[2]", make, density, 1, places=(None, None, [1]))
    raises(hsr.InputError, "kept", make, density, 10)


def test_drawer():
    d = house.prepare("bsp-front", threads=2, counts=True)
    for k, size in enumerate([SIZE, (31, 17), SIZE]):
        p, once = d.render(size, view=k), house.render("bsp-front", size, view=k)
        ok((p.ids == once.ids).all() and p.judge().is_right, f"view {k}")
    ok(p.counts and "bsp-front" in repr(d), repr(d))
    moved = d.render(SIZE, view=2, offset=(0.25, -0.25))
    ok((moved.ids != once.ids).any(), "samples lie elsewhere")
    ok(house.judge(moved.ids, view=2, offset=(0.25, -0.25)).is_right, "rightly")
    raises(hsr.UsageError, "offset", d.render, SIZE, offset=(0.5, 0))
    raises(hsr.UsageError, "offset", d.render, SIZE, offset=(0,))
    ids = p.ids
    del d, p
    gc.collect()
    ok((ids == once.ids).all(), "the array outlives its drawer")
    raises(hsr.UsageError, "no algorithm", house.prepare, "newel")
    raises(hsr.RefusedError, "btf", house.prepare, "btf")


def test_bad_arrays():
    make, usage = hsr.scene_from_arrays, hsr.UsageError
    raises(usage, "shape", make, [[0, 0]], SIDES)
    raises(usage, "shape", make, [], SIDES)
    raises(usage, "vertices", make, "house", SIDES)
    raises(usage, "0 to 4294967295", make, TETRAHEDRON, [[0, 1, -1]])
    raises(usage, "whole", make, TETRAHEDRON, [[0, 1, 2.5]])
    raises(usage, "lists", make, TETRAHEDRON, [0, 1, 2])
    raises(usage, "faces:", make, TETRAHEDRON, "abc")
    raises(usage, "face 1:", make, TETRAHEDRON, [[0, 1, 2], [0, 1, 2, "3"]])
    raises(usage, "corners", make, TETRAHEDRON, [[[0, 1], [1, 2]]])
    raises(usage, "0 faces", make, TETRAHEDRON, [])
    raises(usage, "colors", make, TETRAHEDRON, SIDES, COLORS[:3])
    raises(usage, "NUL", make, TETRAHEDRON, SIDES, name="a\0b")
    raises(hsr.InputError, "face 0", make, TETRAHEDRON, [[0, 1, 9]])
    raises(hsr.InputError, "colour", make, TETRAHEDRON, SIDES, [[2, 0, 0]] * 4)
    raises(hsr.InputError, "vertex 1", make, [[0, 0, 0], [np.nan, 0, 0]], SIDES)


def test_file():
    path = folder / "triangle \u00e9.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\n")
    s = hsr.scene(path)
    ok((s.n_faces, s.info.n_dropped) == (1, 1), f"{s.info}")
    raises(hsr.InputError, ":5:", hsr.scene, path, strict=True)


# --- Pictures -----------------------------------------------------------------


def test_picture():
    p = house.render("watkins", size=(640, 480), threads=2)
    verdict = hsr.judge(p)
    ok(verdict.compared == 307200 and not verdict.differing, f"{verdict}")
    ok(p.ids.shape == (480, 640) and p.ids.dtype == np.uint32, f"{p!r}")
    ok((p.kind, p.size, p.algorithm.name) == ("ids", (640, 480), "watkins"), "info")
    info = p.info
    ok(info.window == (0, 0, 640, 480) and info.draw_seconds > 0, f"{info}")
    seen = p.ids != hsr.NO_FACE
    ok(np.isfinite(p.depth[seen]).all() and np.isinf(p.depth[~seen]).all(), "depth")
    ok(p.colors.shape == (480, 640, 3) and 0 <= p.colors.min(), "colors")
    ok(p.colors is p.colors and not p.colors.flags.writeable, "made once")
    raises(hsr.UsageError, "phong", p.shaded, "phong")
    ok((p.shaded("ids") != p.colors).any(), "another shading")


def test_summary():
    p = house.render("watkins", SIZE)
    covered = 100 * (p.ids != hsr.NO_FACE).mean()
    ok(p.summary == f"{covered:.1f} % covered", p.summary)
    lines = house.render("appel", SIZE)
    ok(f"{len(lines.segments)} intervals" in lines.summary, lines.summary)


def test_judge_ids():
    p = house.render("watkins", SIZE)
    ok(hsr.judge(house, p.ids).is_right, "ids are right")
    ids = p.ids.copy()
    ids[7, 11] = 1000000
    v = hsr.judge(house, ids)
    rows, columns = v.places
    ok((v.compared, v.differing) == (ALL, 1), f"{v}")
    ok((rows.tolist(), columns.tolist()) == ([7], [11]), "that place")
    ok(ids[v.places].tolist() == [1000000], "ids[places]")
    ok(v.first.startswith("(11, 7): face 1000000"), v.first)
    ids[20] = 1000000
    v = hsr.judge(house, ids, room=3)
    ok(v.differing == 65 and v.places[0].tolist() == [7, 20, 20], "the first of 65")
    v = hsr.judge(house, ids, window=(10, 5, 14, 9))
    ok((v.compared, v.differing) == (16, 1), "of a window")


def test_judge_cameras():
    p = house.render("watkins", SIZE, view=3)
    camera = house.camera(3)
    ok(not hsr.judge(house, p.ids).is_right, "another view is not the same")
    ok(hsr.judge(house, p.ids, view=3).is_right, "this view is")
    ok(hsr.judge(house, p.ids, camera=camera).is_right, "and so is its camera")
    signed = np.where(p.ids == hsr.NO_FACE, -1, p.ids.astype(np.int64))
    ok(hsr.judge(house, signed.astype(np.int32), view=3).is_right, "-1 is no face")
    ok(hsr.judge(house, p.ids.tolist(), view=3).is_right, "lists of rows")
    for kind in ["u1", "u2", ">u4", "u8", "i2", "i8", "f4", "f8"]:
        ids = signed.astype(kind)
        ok(hsr.judge(house, ids, view=3).is_right, f"ids as {kind}")
        ids[0, 0] = ids[0, 0] == 7 or 7
        v = hsr.judge(house, ids, view=3)
        ok(v.differing == 1, f"one is wrong as {kind}")
    ok(hsr.judge(house, p.ids.astype("f4"), view=3).is_right, "NO_FACE as a float")
    grid = hsr.scene("grid:8")  # which has a face 255
    ids = np.full((2, 2), 255, np.uint8)
    v = hsr.judge(grid, ids)
    ok(grid.n_faces > 256 and "face 255" in v.first, f"255 is a face: {v.first}")


def test_bad_ids():
    raises(hsr.UsageError, "shape", hsr.judge, house, [1, 2])
    raises(hsr.UsageError, "whole", hsr.judge, house, np.full((2, 2), 0.5))
    raises(hsr.UsageError, "whole", hsr.judge, house, np.full((2, 2), np.nan))
    raises(hsr.UsageError, "0 to", hsr.judge, house, np.full((2, 2), 1e300))
    raises(hsr.UsageError, "whole", hsr.judge, house, [["a"]])
    raises(hsr.UsageError, "0 to", hsr.judge, house, [[-2, 0]])
    raises(hsr.UsageError, "ids", hsr.judge, house, [[1], [1, 2]])
    raises(hsr.UsageError, "room", hsr.judge, house, [[1]], room=-1)
    raises(hsr.UsageError, "scene", hsr.judge, house.render("watkins", SIZE), [[1]])
    raises(hsr.RefusedError, "null", hsr.judge, house.render("null", SIZE))


def test_camera():
    camera = hsr.Camera(eye=(12, 14, 20), at=np.zeros(3), fov=38)
    p = house.render("newell", SIZE, camera=camera)
    ok(p.judge().is_right and (p.ids != hsr.NO_FACE).any(), f"{camera}")
    flat = dataclasses.replace(camera, parallel=30.0)
    q = house.render("newell", SIZE, camera=flat)
    ok(q.judge().is_right and (q.ids != p.ids).any(), "in parallel projection")
    raises(hsr.UsageError, "eye", draw, camera=dataclasses.replace(camera, eye=(1, 2)))
    raises(hsr.InputError, "", draw, camera=dataclasses.replace(camera, fov=180))


def draw(algorithm="watkins", size=SIZE, **more):
    return house.render(algorithm, size, **more)


def test_window():
    p = draw(window=(10, 20, 30, 40))
    ok(p.info.window == (10, 20, 30, 40) and p.judge().compared == 400, "a window")
    ok((p.ids[20:40, 10:30] == draw().ids[20:40, 10:30]).all(), "is the same there")
    ok((p.ids[:20] == hsr.NO_FACE).all(), "and nothing elsewhere")


def test_counts():
    p = draw(counts=True)
    names = [c.name for c in p.algorithm.counters]
    ok(list(p.counts) == names and p.counts["X merge"] > 0, f"{p.counts}")
    ok(p.count.tolist() == list(p.counts.values()), "by number")
    raises(hsr.UsageError, "counts", lambda: draw().counts)
    p = hsr.scene("house").render("zbuffer", (40, 30), work=True)
    ok(p.work.shape == (30, 40) and p.work.sum() == p.counts["depth tests"],
       "the work at the samples")
    raises(hsr.UsageError, "request.work", lambda: draw().work)


# --- Memory -------------------------------------------------------------------


def shares(name, scene, algorithm, read, shape, dtype):
    """An array is the library's memory, which it keeps."""
    p = hsr.scene(scene).render(algorithm, (12, 9), counts=True)
    array = read(p)
    ok(array.shape == shape and array.dtype == dtype, f"{name}: {array.shape}")
    flags = array.flags
    ok(not flags.owndata and not flags.writeable, f"{name} is not a copy")
    ok(read(p).ctypes.data == array.ctypes.data, f"{name} has one place")
    saved = array.copy()
    p.close()
    del p
    gc.collect()
    more = [house.render("zbuffer", (12, 9)) for _ in range(20)]
    ok((array == saved).all() and more, f"{name} outlives its answer")


def test_shared():
    shares("ids", "house", "watkins", lambda p: p.ids, (9, 12), np.uint32)
    shares(
        "lit", "house", "raycast:shadows=cast", lambda p: p.lit, (9, 12), np.bool_
    )
    shares("counts", "house", "watkins", lambda p: p.count,
           (len(draw(counts=True).counts),), np.uint64)
    areas = (9, 12, 3, 2)
    shares("areas", "house", "error-bounded", lambda p: p.areas, areas, np.float64)
    box = "zbuffer-fast:filter=box"
    shares("sums", "house", box, lambda p: p.sums, (9, 12, 3), np.uint32)
    mix = "newell:mix=linear"
    shares("rgb", "greenhouse", mix, lambda p: p.rgba, (9, 12, 3), np.uint16)
    shares("rgba", "grid:3", "splat", lambda p: p.rgba, (9, 12, 4), np.uint16)


def test_pointer():
    p = draw()
    pointer = _library.ffi.new("uint32_t *[1]")
    _library.call(_library.lib.hsr_get_ids, p._handle, pointer)
    address = int(_library.ffi.cast("uintptr_t", pointer[0]))
    ok(p.ids.ctypes.data == address, "ids are where the library has them")
    try:
        p.ids.flags.writeable = True
        ok(False, "nobody may write to them")
    except ValueError as error:
        ok(True, f"nobody may write to them: {error}")


def test_freed():
    p = draw()
    handle = weakref.ref(p._handle)
    part = p.ids[::2, 3:]
    del p
    gc.collect()
    ok(handle() is not None, "a part of an array keeps the answer")
    del part
    gc.collect()
    ok(handle() is None, "nothing keeps it any more")
    s = hsr.scene("soup:50:7")
    q = s.render("watkins", SIZE)
    s.close()
    ok(q.judge().is_right, "an answer outlives its scene")


# --- Other kinds --------------------------------------------------------------


def test_segments():
    p = house.render("appel", SIZE)
    s = p.segments
    ok(s.dtype.itemsize == _library.ffi.sizeof("struct hsr_segment"), f"{len(s)}")
    edges = s[s["is_implied"] == 0]
    ok((edges["a"] < edges["b"]).all() and (s["t0"] < s["t1"]).all(), "edges")
    ok((s["invisibility"] == 0).any() and s["from"].shape == (len(s), 3), "ends")
    ok(not s.flags.writeable and np.may_share_memory(s, p.segments), "shared")
    ok(p.judge().is_right and not len(p.judge().places[0]), "judged as a whole")
    raises(hsr.UsageError, "no ids", lambda: p.ids)
    raises(hsr.UsageError, "no segments", lambda: draw().segments)
    away = hsr.Camera(eye=(0, 0, 900), at=(0, 0, 1800))
    none = house.render("appel", SIZE, camera=away).segments
    ok(none.shape == (0,) and none.dtype == s.dtype, "an empty drawing")


def test_polygons():
    p = house.render("weiler-atherton", SIZE)
    polygons = p.polygons
    regions = list(polygons)
    ok(len(regions) == len(polygons) == len(polygons.face) > 50, f"{polygons}")
    points = sum(len(cycle) for _, cycles in regions for cycle in cycles)
    ok(points == len(polygons.xy) == polygons.point[-1], "all points")
    kept = polygons.xy
    saved = kept.copy()
    del p, polygons, regions
    gc.collect()
    ok((kept == saved).all() and not kept.flags.owndata, "they outlive the answer")


def test_voxels():
    v = house.render("tiling-solids:side=12", SIZE).voxels
    ok(v.solid.ndim == 3 and v.side > 0 and v.solid.max() > 0, f"{v}")
    ok(not v.solid.flags.owndata and len(v.lo) == 3, "cubes")


# --- Callbacks ----------------------------------------------------------------


def test_progress():
    shares_told = []
    p = draw(size=(320, 240), threads=2, progress=shares_told.append)
    ok(p.judge().is_right, "drawn with progress")
    ok(shares_told[0] == 0 and shares_told[-1] == 1, f"{len(shares_told)} calls")
    raises(hsr.StoppedError, "", draw, progress=lambda share: False)
    raises(ZeroDivisionError, "", draw, threads=2, progress=lambda share: 1 / 0)


def test_trace():
    events = []
    p = house.trace("watkins", events.append, SIZE)
    numbers = [e.number for e in events]
    ok(numbers == list(range(len(events))), f"{len(events)} events")
    counted = np.bincount([e.counter for e in events], minlength=len(p.count))
    computed = np.array([c.is_computed for c in p.algorithm.counters])
    ok((counted == p.count)[~computed].all(), "as many as the counts say")
    ok((p.count == draw(counts=True).count).all(), "and as without a listener")
    steps = [c.step for c in p.algorithm.counters]
    ok(all(e.step == steps[e.counter] for e in events), "their steps")
    ok({e.a.kind for e in events} > {"edge"} and p.judge().is_right, f"{events[9]}")
    raises(hsr.UsageError, "oracle", house.trace, "oracle", events.append)


def test_listener_fails():
    heard = []

    def listen(event):
        heard.append(event)
        raise KeyError("enough")

    raises(KeyError, "enough", house.trace, "watkins", listen, SIZE)
    ok(len(heard) == 1, "it is called no more")


# --- Files --------------------------------------------------------------------


def test_write():
    p = draw()
    p.write(folder / "x.png", shading="ids", background=(0, 0, 1))
    ok((folder / "x.png").read_bytes()[1:4] == b"PNG", "a picture")
    house.render("appel", SIZE).write(str(folder / "x.svg"), hidden="dashed", crease=5)
    ok("<svg" in (folder / "x.svg").read_text(), "a drawing")
    house.render("appel", SIZE).write(folder / "x.svg", style="iso")
    ok('stroke-width="1.89"' in (folder / "x.svg").read_text(), "by a style")
    raises(hsr.UsageError, "screen, iso", house.render("appel", SIZE).write, "y.svg", style="no")
    raises(hsr.UsageError, "svg", p.write, folder / "y.svg")
    raises(hsr.UsageError, "left-out", p.write, "y.png", hidden="none")
    raises(hsr.UsageError, "background", p.write, "y.png", background=[1])
    raises(hsr.InputError, "", p.write, folder / "nowhere" / "y.png")
    ok(not (folder / "y.svg").exists(), "no file is left")


# --- Errors -------------------------------------------------------------------


def test_errors():
    raises(hsr.InputError, "nix", hsr.scene, "nix")
    raises(hsr.UsageError, "NUL", hsr.scene, "house\0")
    raises(hsr.UsageError, "threads", hsr.scene, "house", threads=65)
    raises(hsr.UsageError, "threads", draw, threads=2**40)
    raises(hsr.UsageError, "newel", draw, "newel")
    raises(hsr.UsageError, "x-list", draw, "watkins:x-list=no")
    raises(hsr.UsageError, "9 views", draw, view=9)
    raises(hsr.UsageError, "view", draw, view=-1)
    raises(hsr.UsageError, "range", house.camera, -1)
    raises(hsr.UsageError, "", draw, size=(0, 5))
    raises(hsr.UsageError, "size", draw, size=5)
    raises(hsr.UsageError, "window", draw, window=(5, 5, 5, 9))
    raises(hsr.UsageError, "window", draw, window=(0, 0, 0, 0))
    raises(hsr.UsageError, "window", draw, window=(1, 2))
    raises(hsr.RefusedError, "btf", draw, "btf")
    ok(issubclass(hsr.UsageError, ValueError), "UsageError is a ValueError")
    closed = draw()
    closed.close()
    raises(hsr.UsageError, "NULL", lambda: closed.ids)


# --- Threads ------------------------------------------------------------------


def in_threads(work, n=2):
    found = [None] * n

    def run_one(k):
        found[k] = work()

    threads = [threading.Thread(target=run_one, args=(k,)) for k in range(n)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


def test_threads():
    names = ["watkins", "newell", "warnock", "zbuffer", "raycast"]
    wanted = draw("oracle").ids

    def one_scene():
        return all((draw(a).ids == wanted).all() for a in names * 4)

    def own_scenes():
        s = hsr.scene("house")
        return all(s.render(a, SIZE).judge().is_right for a in names)

    ok(all(in_threads(one_scene)), "two threads draw one scene")
    ok(all(in_threads(own_scenes)), "and scenes of their own")


# --- Help ---------------------------------------------------------------------


def test_help():
    text = pydoc.plain(pydoc.render_doc(hsr))
    ok("hsr.scene(" in text and "class Answer" in text, "help(hsr)")
    public = [getattr(hsr, name) for name in hsr.__all__]
    bare = [x for x in public if callable(x) and not x.__doc__]
    ok(not bare, f"all have docstrings: {bare}")
    methods = [
        getattr(cls, name)
        for cls in (hsr.Scene, hsr.Answer, hsr.Drawer)
        for name in vars(cls)
        if not name.startswith("_")
    ]
    ok(all(inspect.getdoc(m) for m in methods), f"{len(methods)} methods too")
    ok(hsr.UsageError.__module__ == "hsr", "errors are of hsr")


def test_repr():
    p = draw()
    for thing in (house, p, hsr.judge(p), *hsr.scenes()[:1], *hsr.kinds()[:1]):
        ok(repr(thing).startswith("<hsr.") and "\n" not in repr(thing), f"{thing!r}")
    ok(copy.copy(hsr.Camera((0, 0, 1), (0, 0, 0))).fov == 45, "a camera")


run(globals())
