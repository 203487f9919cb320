#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""raycast.py SUITE RESULTS: draws the pictures of a suite by casting rays, with
numpy, in plain doubles and without a tolerance. It knows nothing of hsr but the
suite's README.md."""
import json
import pathlib
import sys

import numpy


def read_obj(path):
    """The corners of each face, an array of k x 3."""
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        word = line.split()
        if word and word[0] == "v":
            vertices.append([float(x) for x in word[1:4]])
        elif word and word[0] == "f":
            faces.append([int(c.split("/")[0]) - 1 for c in word[1:]])
    vertices = numpy.array(vertices)
    return [vertices[face] for face in faces]


def make_rays(case):
    """Where the rays start, and how they run: two arrays of samples x 3."""
    m, n, rays = case["width"], case["height"], case["rays"]
    e, f, r, u = (numpy.array(rays[k]) for k in "EFRU")
    x = (2 * numpy.arange(m) + 1 - m) / m
    y = (n - 1 - 2 * numpy.arange(n)) / n
    across = x[None, :, None] * r + y[:, None, None] * u
    across = across.reshape(-1, 3)
    if rays["parallel"]:
        return e + across, numpy.broadcast_to(f, across.shape)
    return numpy.broadcast_to(e, across.shape), f + across


def is_inside(points, corners):
    """Whether points are in a polygon of the plane, by parity."""
    inside = numpy.zeros(len(points), bool)
    x, y = points.T
    for (ax, ay), (bx, by) in zip(corners, numpy.roll(corners, -1, axis=0)):
        if ay != by:
            crosses = (ay > y) != (by > y)
            inside ^= crosses & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    return inside


def draw(faces, one_sided, case):
    start, along = make_rays(case)
    nearest = numpy.full(len(start), numpy.inf)
    ids = numpy.full(len(start), 4294967295, numpy.uint32)
    for number, corners in enumerate(faces):
        normal = numpy.cross(corners, numpy.roll(corners, -1, axis=0)).sum(axis=0)
        slope = along @ normal
        t = (corners.mean(axis=0) - start) @ normal / slope
        hit = (t > case["camera"]["near"]) & (t < nearest)
        if one_sided[number]:
            hit &= slope < 0
        place = numpy.flatnonzero(hit)
        if not len(place):
            continue
        # seen along the axis in which the face is largest
        axes = [k for k in range(3) if k != numpy.argmax(abs(normal))]
        points = start[place] + t[place, None] * along[place]
        place = place[is_inside(points[:, axes], corners[:, axes])]
        nearest[place] = t[place]
        ids[place] = number
    return ids.reshape(case["height"], case["width"])


def main(suite, results):
    suite, results = pathlib.Path(suite), pathlib.Path(results)
    everything = json.loads((suite / "cases.json").read_text())
    results.mkdir(exist_ok=True)
    scenes = {}
    for scene in everything["scenes"]:
        faces = read_obj(suite / "scenes" / (scene["name"] + ".obj"))
        one_sided = numpy.zeros(len(faces), bool)
        for first, after in scene["one_sided"]:
            one_sided[first:after] = True
        scenes[scene["name"]] = faces, one_sided
    with numpy.errstate(all="ignore"):  # a ray may run along a plane
        for case in everything["cases"]:
            ids = draw(*scenes[case["scene"]], case)
            numpy.save(results / (case["name"] + ".npy"), ids)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: raycast.py SUITE RESULTS")
    main(*sys.argv[1:])
