#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An independent judge of a line drawing on paper.

  overlay.py SCENE.obj CAMERA.json VIEW ANSWER.json DRAWING.svg

From the scene, the camera and the intervals of all edges (docs/schemas/
drawing.schema.json) it finds what a drawing must show: edges whose images lie on
one line of the picture are laid over one another, and of what lies there the most
visible is drawn. All of this is done in exact numbers. Then it reads the .svg
file, which must be of the standard page, with --hidden dashed. It prints what is
wrong, a line each, and ends with 1; else it prints a summary, and ends with 0.

It shares nothing with hsr. Names are those of docs/correct-drawing.md.
"""

import json
import math
import re
import sys
import xml.etree.ElementTree as ET
from collections import defaultdict
from fractions import Fraction

ERROR = Fraction(2, 10**12)  # of the parameter of a change of visibility
MOST_ERROR = Fraction(1, 10**6)  # px, for it
NEAR = 0.0015  # px: coordinates of the file are whole thousandths
LEFT_OVER = 0.003  # px: of a piece, at its ends
TWICE = 0.01  # px
FAULTS_SHOWN = 8  # faults of a kind that are printed

# --- Exact vectors ------------------------------------------------------------
# A place is four whole numbers (x, y, z, w), w > 0: the point (x, y, z)/w.


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def whole(vector):
    """A multiple of a vector of Fractions that is whole, and the factor."""
    factor = 1
    for x in vector:
        factor = factor * x.denominator // math.gcd(factor, x.denominator)
    return tuple(int(x * factor) for x in vector), factor


def place(point):
    xyz, w = whole([Fraction(x) for x in point])
    return xyz + (w,)


def primitive(vector):
    """The same for all multiples of a vector."""
    divisor = math.gcd(*vector)
    first = next(x for x in vector if x)
    divisor = -divisor if first < 0 else divisor
    return tuple(x // divisor for x in vector)


def between(a, b, t):
    """The place at t of the way from a to b."""
    p, q = t.numerator, t.denominator
    u, v = (q - p) * b[3], p * a[3]
    return tuple(u * a[k] + v * b[k] for k in range(3)) + (q * a[3] * b[3],)


# --- The scene ----------------------------------------------------------------


class Scene:
    """Vertices and faces by number, as an .obj file has them."""

    def __init__(self, path):
        self.vertex, self.face = [], []
        for line in open(path, encoding="utf-8"):
            word = line.split()
            if word[:1] == ["v"]:
                self.vertex.append(place([float(x) for x in word[1:4]]))
            elif word[:1] == ["f"]:
                self.face.append([int(w.split("/")[0]) - 1 for w in word[1:]])

    def plane(self, f):
        """Newell's normal, and N . P of the points P of the plane."""
        corner = [[Fraction(x, self.vertex[v][3]) for x in self.vertex[v][:3]]
                  for v in self.face[f]]
        normal = [Fraction(0)] * 3
        for a, b in zip(corner, corner[1:] + corner[:1]):
            normal = [n + c for n, c in zip(normal, cross(a, b))]
        return normal, dot(normal, corner[0]), corner

    def implied(self, f, g):
        """The implied edges of two faces: pairs of places."""
        (nf, df, cf), (ng, dg, cg) = self.plane(f), self.plane(g)
        along = cross(nf, ng)
        square = dot(along, along)
        # The point of both planes that is nearest to the origin.
        base = [(df * a + dg * b) / square
                for a, b in zip(cross(ng, along), cross(along, nf))]
        met = [crossings(base, along, c, n) for c, n in ((cf, nf), (cg, ng))]
        stop = sorted({t for points, _ in met for t in points})
        edges = []
        for s, t in zip(stop, stop[1:]):
            middle = (s + t) / 2
            if all(is_inside(middle, crossing) for _, crossing in met):
                edges.append(tuple(place([b + x * a for a, b in
                                          zip(along, base)]) for x in (s, t)))
        return edges


def crossings(base, along, corner, normal):
    """Where the line base + t along meets the border of a face, in whose plane
    it lies; and where it crosses it, each t as often as it does. A side in the
    line is counted as one on its left."""
    side_of = cross(normal, along)
    height = [dot(side_of, [c - b for c, b in zip(p, base)]) for p in corner]
    at = [dot(along, [c - b for c, b in zip(p, base)]) / dot(along, along)
          for p in corner]
    met, crossed, sides = set(), [], defaultdict(int)
    for k, p in enumerate(corner):
        q = corner[(k + 1) % len(corner)]
        sides[tuple(sorted((tuple(p), tuple(q))))] += 1
    for k, p in enumerate(corner):
        j = (k + 1) % len(corner)
        if sides[tuple(sorted((tuple(p), tuple(corner[j]))))] % 2 == 0:
            continue  # a bridge
        for i in (k, j):
            if height[i] == 0:
                met.add(at[i])
        if (height[k] < 0) != (height[j] < 0):
            share = height[k] / (height[k] - height[j])
            crossed.append(at[k] + share * (at[j] - at[k]))
            met.add(crossed[-1])
        if height[k] == 0 == height[j]:
            crossed.append((min(at[k], at[j]), max(at[k], at[j])))
    return met, crossed


def is_inside(t, crossed):
    """Inside, and not on a border. No crossing is at t itself."""
    inside = False
    for c in crossed:
        if isinstance(c, tuple):
            if c[0] < t < c[1]:
                return False
        elif c > t:
            inside = not inside
    return inside


# --- The view -----------------------------------------------------------------


class View:
    """The image of a place, and the line of the picture that an edge is on."""

    def __init__(self, camera, size):
        self.size = size
        eye, at, up = (camera[k] for k in ("eye", "at", "up"))
        self.parallel = camera.get("parallel", 0)
        forward = unit([a - e for a, e in zip(at, eye)])
        right = unit(cross(forward, up))
        half = (self.parallel / 2 if self.parallel
                else math.tan(math.radians(camera["fov"]) / 2))
        # The directions of the rays are those of the doubles of hsr only if
        # these are exact. Of what lies on one line, only F in parallel
        # projection decides; there it must be.
        U = [half * x for x in cross(right, forward)]
        R = [size[0] / size[1] * half * x for x in right]
        self.eye = place(eye)
        (F, f), (R, r), (U, u) = (whole([Fraction(x) for x in v])
                                  for v in (forward, R, U))
        self.F = F
        det = dot(F, cross(R, U))
        # P - E = w (F/f + x R/r + y U/u), or without the first w if parallel.
        self.row = (cross(U, F), r), (cross(F, R), u)
        self.low = (det, 1) if self.parallel else (cross(R, U), f)

    def from_eye(self, p):
        return tuple(p[k] * self.eye[3] - self.eye[k] * p[3] for k in range(3))

    def image(self, p):
        """Pixels, exact."""
        q = self.from_eye(p)
        if self.parallel:
            below = self.low[0] * p[3] * self.eye[3]
        else:
            below = dot(q, self.low[0]) * self.low[1]
        x, y = (Fraction(dot(q, row) * factor, below) for row, factor in self.row)
        return (x + 1) * self.size[0] / 2, (1 - y) * self.size[1] / 2

    def clamp(self, at):
        return tuple(min(max(float(x), 0.0), float(n))
                     for x, n in zip(at, self.size))

    def line(self, a, b):
        """The plane of an edge and the eye, the same for all edges in it."""
        if not self.parallel:
            return primitive(cross(self.from_eye(a), self.from_eye(b)))
        n = cross([b[k] * a[3] - a[k] * b[3] for k in range(3)], self.F)
        return primitive([x * a[3] for x in n] + [dot(n, a)])

    def is_on(self, line, p):
        """Whether the image of a place is on a line of the picture."""
        if not self.parallel:
            return dot(line, self.from_eye(p)) == 0
        return dot(line, p) == line[3] * p[3]


def unit(v):
    length = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return [x / length for x in v]


# --- What the drawing must show -----------------------------------------------


class End:
    """An end of an interval."""

    def __init__(self, view, edge, t):
        self.at = view.image(between(*edge, t))
        self.named = t in (0, 1)
        self.slack = 0
        if not self.named:
            other = view.image(between(*edge, t + ERROR * t))
            self.slack = min(MOST_ERROR, max(abs(a - b) for a, b in
                                             zip(self.at, other)))


class Piece:
    """A stretch of a line between two nodes, of one visibility."""

    def __init__(self, ends, nodes, hidden):
        (self.a, self.b), self.nodes, self.hidden = ends, nodes, hidden


class Expected:
    def __init__(self, scene, view, answer):
        self.scene, self.view = scene, view
        self.piece = []
        self.named_at = defaultdict(set)  # named places, by their images
        on_line = defaultdict(list)
        for edge, intervals in self.edges(answer):
            on_line[view.line(*edge)].append((edge, intervals))
        for line, edges in on_line.items():
            self.lay_over(line, edges)

    def edges(self, answer):
        """Each edge as its two places, and its intervals."""
        of = defaultdict(list)
        for s in answer["segments"]:
            name = tuple(s["edge"]) if "edge" in s else ("implied", *s["implied"])
            t0, t1 = s["t"]
            of[name].append((Fraction(t0), Fraction(t1), s["invisibility"]))
        known = {}
        found = []
        for name, intervals in of.items():
            if name[0] != "implied":
                ends = tuple(self.scene.vertex[v] for v in name)
            else:
                pair = name[1:3]
                if pair not in known:
                    known[pair] = self.scene.implied(*pair)
                ends = known[pair][name[3]]
            for p in ends:
                self.put_named(p)
            found.append((ends, intervals))
        return found

    def put_named(self, p):
        try:
            at = self.view.image(p)
        except ZeroDivisionError:
            return
        self.named_at[tuple(round(float(c) * 1e5) for c in at)].add((at, p))

    def named_near(self, end, line):
        """The image of a named place on this line, near an end."""
        x, y = (round(float(c) * 1e5) for c in end.at)
        for i in (x - 1, x, x + 1):
            for j in (y - 1, y, y + 1):
                for at, p in self.named_at.get((i, j), ()):
                    if (max(abs(a - b) for a, b in zip(at, end.at)) <= end.slack
                            and self.view.is_on(line, p)):
                        return at
        return None

    def lay_over(self, line, edges):
        spans = []
        for edge, intervals in edges:
            for t0, t1, hidden in intervals:
                spans.append((End(self.view, edge, t0), End(self.view, edge, t1),
                              hidden))
        p, q = max(((p.at, q.at) for p, q, _ in spans),
                   key=lambda s: max(abs(a - b) for a, b in zip(*s)))
        axis = int(abs(p[1] - q[1]) > abs(p[0] - q[0]))
        # The ends of all spans, those that are one put together.
        ends = sorted((end for p, q, _ in spans for end in (p, q)),
                      key=lambda end: end.at[axis])
        stops = []
        for end in ends:
            if not stops or (end.at[axis] - stops[-1][-1].at[axis] >
                             end.slack + stops[-1][-1].slack):
                stops.append([])
            stops[-1].append(end)
            end.stop = len(stops) - 1
        node = [self.node(line, k, stop) for k, stop in enumerate(stops)]
        # Between two stops, the least invisibility.
        best = [None] * len(stops)
        for p, q, hidden in spans:
            for i in range(*sorted((p.stop, q.stop))):
                if best[i] is None or hidden < best[i]:
                    best[i] = hidden
        for i, hidden in enumerate(best):
            if hidden is not None:
                two = [self.view.clamp(stops[j][0].at) for j in (i, i + 1)]
                self.piece.append(Piece(two, (node[i], node[i + 1]), hidden))

    def node(self, line, k, stop):
        for end in stop:
            if end.named:
                return end.at
        return self.named_near(stop[0], line) or (line, k)

    def strokes(self, group):
        """How few strokes there can be of a group."""
        degree, parent = defaultdict(int), {}

        def root(x):
            parent.setdefault(x, x)
            while parent[x] != x:
                parent[x] = parent[parent[x]]
                x = parent[x]
            return x

        for piece in self.piece:
            if group(piece):
                p, q = piece.nodes
                degree[p] += 1
                degree[q] += 1
                parent[root(p)] = root(q)
        odd = defaultdict(int)
        for x, d in degree.items():
            odd[root(x)] += d % 2
        return sum(max(1, n // 2) for n in odd.values())


# --- The drawing --------------------------------------------------------------

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def strokes_of(text):
    """The polylines of a path's d, in pixels; a closed one ends where it began."""
    strokes = []
    for command, x, y in re.findall(r"([MLZ])(?:([-.\d]+) ([-.\d]+))?", text):
        if command == "M":
            strokes.append([])
        strokes[-1].append(strokes[-1][0] if command == "Z"
                           else (float(x), float(y)))
    return strokes


def layers_of(path):
    """The strokes of each layer of an .svg file, by its id."""
    layers = {}
    for layer in ET.parse(path).getroot().findall(SVG + "g"):
        if layer.get(INKSCAPE + "groupmode") != "layer":
            continue
        layers[layer.get("id")] = [s for p in layer.iter(SVG + "path")
                                   for s in strokes_of(p.get("d"))]
    return layers


def segments_of(strokes):
    return [(a, b) for s in strokes for a, b in zip(s, s[1:]) if a != b]


# --- Laying one over the other ------------------------------------------------


class Cells:
    """Segments, to be found by place."""

    SIDE = 8.0

    def __init__(self, segments):
        self.segments = segments
        self.cell = defaultdict(list)
        for k, s in enumerate(segments):
            for c in self.reach(*s):
                self.cell[c].append(k)

    def reach(self, a, b):
        n = 1 + int(math.dist(a, b) / self.SIDE)
        found = set()
        for k in range(n + 1):
            x, y = (p + k / n * (q - p) for p, q in zip(a, b))
            i, j = int(x // self.SIDE), int(y // self.SIDE)
            found.update((i + u, j + v) for u in (-1, 0, 1) for v in (-1, 0, 1))
        return found

    def near(self, a, b):
        return sorted({k for c in self.reach(a, b) for k in self.cell.get(c, ())})


def overlap(a, b, c, d, near):
    """The part (from, to) of the segment a b, in pixels from a, along which c d
    lies on it; or None."""
    length = math.dist(a, b)
    if length == 0:
        return None
    ux, uy = (b[0] - a[0]) / length, (b[1] - a[1]) / length
    s = [((p[0] - a[0]) * ux + (p[1] - a[1]) * uy,
          (p[1] - a[1]) * ux - (p[0] - a[0]) * uy) for p in (c, d)]
    if s[0][0] > s[1][0]:
        s.reverse()
    (u0, v0), (u1, v1) = s
    low, high = max(0.0, u0), min(length, u1)
    if low >= high:
        return None
    for u in (low, high):
        if abs(v0 + (u - u0) / (u1 - u0) * (v1 - v0)) > near:
            return None
    return low, high


def uncovered(segment, cells):
    """How much of a segment has no other one on it, in pixels."""
    a, b = segment
    spans = sorted(filter(None, (overlap(a, b, *cells.segments[k], NEAR)
                                 for k in cells.near(a, b))))
    bare, done = 0.0, 0.0
    for low, high in spans + [(math.dist(a, b), math.inf)]:
        bare = max(bare, low - done)
        done = max(done, high)
    return bare


def lie_at(point, direction, cells, near):
    """How many segments pass a point, in this direction."""
    a = tuple(p - 0.004 * u for p, u in zip(point, direction))
    b = tuple(p + 0.004 * u for p, u in zip(point, direction))
    n = 0
    for k in cells.near(a, b):
        part = overlap(a, b, *cells.segments[k], near)
        n += part is not None and part[0] <= 0.004 <= part[1]
    return n


def doubled(cells, expected_cells):
    """Places where more segments lie on one another than there are lines."""
    for k, (a, b) in enumerate(cells.segments):
        for j in cells.near(a, b):
            if j <= k:
                continue
            part = overlap(a, b, *cells.segments[j], NEAR)
            if part is None or part[1] - part[0] <= TWICE:
                continue
            length = math.dist(a, b)
            u = tuple((q - p) / length for p, q in zip(a, b))
            middle = tuple(p + (part[0] + part[1]) / 2 * x for p, x in zip(a, u))
            if (lie_at(middle, u, cells, NEAR) >
                    lie_at(middle, u, expected_cells, 2 * NEAR)):
                yield middle, part[1] - part[0]


# --- The judgement ------------------------------------------------------------


def tell(what, faults, wrong):
    faults = list(faults)
    for f in faults[:FAULTS_SHOWN]:
        wrong.append(f"{what}: {f}")
    if len(faults) > FAULTS_SHOWN:
        wrong.append(f"{what}: {len(faults) - FAULTS_SHOWN} more")


def show(a, b):
    return f"from {a[0]:.3f},{a[1]:.3f} to {b[0]:.3f},{b[1]:.3f}"


def judge(expected, layers):
    wrong, summary, drawn, wanted = [], [], [], []
    for name, group in (("visible", lambda p: p.hidden == 0),
                        ("hidden", lambda p: p.hidden > 0)):
        pieces = [(p.a, p.b) for p in expected.piece if group(p)]
        strokes = layers.pop(name, [])
        segments = segments_of(strokes)
        drawn += segments
        wanted += pieces
        ink = sum(math.dist(*s) for s in segments)
        due = sum(math.dist(*p) for p in pieces)
        if abs(ink - due) > NEAR * (len(segments) + 1):
            wrong.append(f"{name}: {ink:.3f} px of ink, not {due:.3f}")
        few = expected.strokes(group)
        if len(strokes) != few:
            wrong.append(f"{name}: {len(strokes)} strokes, not {few}")
        svg, exact = Cells(segments), Cells(pieces)
        tell(f"{name}: nothing is to be drawn",
             (show(*s) for s in segments if uncovered(s, exact) > LEFT_OVER), wrong)
        tell(f"{name}: is missing",
             (show(*p) for p in pieces if uncovered(p, svg) > LEFT_OVER), wrong)
        summary.append(f"{name} {due:.3f} px in {few} strokes")
    tell("drawn twice",
         (f"{n:.3f} px at {p[0]:.3f},{p[1]:.3f}"
          for p, n in doubled(Cells(drawn), Cells(wanted))), wrong)
    wrong += [f"{name}: no such layer is known" for name in layers]
    return wrong, ", ".join(summary)


def main(obj, cameras, number, answer, svg):
    answer = json.load(open(answer, encoding="utf-8"))
    camera = json.load(open(cameras, encoding="utf-8"))["views"][int(number) - 1]
    view = View(camera, answer["size"])
    expected = Expected(Scene(obj), view, answer)
    wrong, summary = judge(expected, layers_of(svg))
    print("\n".join(wrong) or summary)
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
