#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A z-buffer in Python with numpy, which hsr judges and times: docs/programs.md.

    hsr check house -a ./zbuffer.py

Every quantity of a triangle is c0 + c1 x + c2 y in the coordinates of the screen,
so the samples of the whole picture are decided at once, and nothing is clipped."""
import json, sys, time
import numpy as np

begin = time.perf_counter()
folder = sys.argv[1]
words = {}
for line in open(folder + "/job"):
    name, *rest = line.split()
    words[name] = rest  # one camera: each name comes once
if words["cameras"] != ["1"] or words["answer"] != ["ids"]:
    sys.exit(6)  # it declines walks, and lines
m, n = map(int, words["size"])
E, F, R, U = (np.array(words[k], float) for k in ("eye", "forward", "right", "up"))
near, parallel = float(words["near"][0]), words["camera"] == ["parallel"]

head, body = open(folder + "/triangles.ply").read().split("end_header\n")
n_vertices = int(head.split("element vertex ")[1].split()[0])
n_triangles = int(head.split("element face ")[1].split()[0])
numbers = np.array(body.split(), float)
V = numbers[: 3 * n_vertices].reshape(-1, 3) - E
triangles = numbers[3 * n_vertices :].reshape(-1, 6).astype(int)  # 3 a b c face side
ids = np.memmap(folder + "/ids", np.uint32, "r+", shape=(n, m))
x = (2 * np.arange(m) + 1 - m) / m
y = ((n - 2 * np.arange(n) - 1) / n)[:, None]


def edge(a, b):
    """det(a, b, ray): on which side of the edge a sample is. If it is on it, the
    sample is thought of as a little to the right, and much less down."""
    if parallel:
        c0, (c1, c2) = np.cross(a, b) @ F, np.array([R, U]) @ np.cross(F, b - a)
    else:
        c0, c1, c2 = np.array([F, R, U]) @ np.cross(a, b)
    e = c0 + c1 * x + c2 * y
    return np.where(e != 0, e, c1 if c1 else -c2) > 0


def draw():
    nearest = np.full((n, m), -np.inf)
    ids[:] = 0xFFFFFFFF
    depths = writes = 0
    for _, i, j, k, face, one_sided in triangles:
        a, b, c = V[i], V[j], V[k]
        N = np.cross(b - a, c - a)
        front = N @ F if parallel else N @ a  # < 0: the eye sees its front
        if front == 0 or (one_sided and front > 0):
            continue
        ab, bc, ca = edge(a, b), edge(b, c), edge(c, a)
        # 1/t of the plane or, in parallel projection, -t: the greater is nearer.
        plane = N @ R * x + N @ U * y
        q = (plane - N @ a) / front if parallel else (plane + N @ F) / front
        seen = (ab == bc) & (bc == ca) & ((-q > near) if parallel else (q > 0) & (q * near < 1))
        depths += int(seen.sum())
        seen &= q > nearest
        writes += int(seen.sum())
        nearest[seen] = q[seen]
        ids[seen] = face
    return {"depth tests": depths, "writes": writes}


print(json.dumps({"import": time.perf_counter() - begin}), flush=True)
while byte := sys.stdin.buffer.read(1):
    print(json.dumps({"counts": draw()}), flush=True)
