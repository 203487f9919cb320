#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in drawings on paper, for drawings.test.

  paper.py layers FILE.svg        the layers, a line each: name, strokes
  paper.py dashes FILE.svg D G    walks along dashed strokes; complains of one that
                                  has no gap, that does not begin and end with ink,
                                  or of which a corner has none; D and G are the px of a
                                  dash and a gap
  paper.py lengths FILE.svg       mm of line by layer
  paper.py pdf FILE.pdf N         complains if the thinner of two pens draws more
                                  than N points at once, or a stroke of one dash
  paper.py colours FILE.ppm RRGGBB ...  how many pixels have each; complains of
                                  less than 20
  paper.py ink FILE.ppm           how dark all pixels are together, of 1 each
"""

import math
import re
import sys
import xml.etree.ElementTree as ET
import zlib
from collections import Counter

SVG = "{http://www.w3.org/2000/svg}"
INK = "{http://www.inkscape.org/namespaces/inkscape}"


def strokes_of(path):
    """The polylines of a path, as lists of places."""
    strokes = []
    for command, numbers in re.findall(r"([MLZ])([^MLZ]*)", path.get("d")):
        if command == "Z":
            strokes[-1].append(strokes[-1][0])
            continue
        place = tuple(float(x) for x in numbers.split())
        if command == "M":
            strokes.append([])
        strokes[-1].append(place)
    return strokes


def length(stroke):
    return sum(math.dist(a, b) for a, b in zip(stroke, stroke[1:]))


def layers(root):
    return [g for g in root if g.get(INK + "groupmode") == "layer"]


def show_layers(name):
    for layer in layers(ET.parse(name).getroot()):
        print(layer.get(INK + "label"), len(layer.findall(f".//{SVG}path")))


def turns(a, b, c):
    """By how many degrees a way from a by b to c turns."""
    u, v = ((q[0] - p[0], q[1] - p[1]) for p, q in ((a, b), (b, c)))
    return abs(math.degrees(math.atan2(u[0] * v[1] - u[1] * v[0],
                                       u[0] * v[0] + u[1] * v[1])))


def corners_of(stroke, least):
    """How far along a stroke its corners are: where it turns by 30 degrees or more,
    at least so far from the last and from the end."""
    way, last, total = 0, 0, length(stroke)
    for a, b, c in zip(stroke, stroke[1:], stroke[2:]):
        way += math.dist(a, b)
        if (way - last > least + .01 and total - way > least + .01
                and turns(a, b, c) > 30.5):
            last = way
            yield way


def walk(dashes, total):
    """The dashes along a stroke, from and to."""
    at, k = 0, 0
    while at < total:
        to = at + dashes[k % len(dashes)]
        if k % 2 == 0:
            yield at, min(to, total)
        at, k = to, k + 1


CLOSE = .01  # px


def faults(path, dashes, least):
    (stroke,) = strokes_of(path)
    total = length(stroke)
    ink = []
    for a, b in walk(dashes, total):
        if ink and a == ink[-1][1]:
            a = ink.pop()[0]
        ink.append((a, b))
    if total > .05 and not any(b[0] - a[1] > .005 for a, b in zip(ink, ink[1:])):
        yield "solid"
    if stroke[0] != stroke[-1] and ink[-1][1] < total - CLOSE:
        yield "no ink at the end"
    if stroke[0] != stroke[-1] and ink[-1][1] - ink[-1][0] < CLOSE < ink[0][1]:
        yield "hardly any ink at the end"
    for corner in corners_of(stroke, least):
        if not any(a < corner < b for a, b in ink):
            yield f"no ink at a corner, {corner:.2f} from the beginning"


def check_dashes(name, dash, gap):
    wrong = 0
    for path in ET.parse(name).getroot().iter(SVG + "path"):
        dashes = path.get("stroke-dasharray")
        if dashes is None:
            continue
        for fault in faults(path, [float(x) for x in dashes.split()],
                            2 * dash + gap):
            print(fault, path.get("d")[:200])
            wrong += 1
    return wrong


def show_lengths(name):
    for layer in layers(ET.parse(name).getroot()):
        total = sum(length(s) for path in layer.iter(SVG + "path")
                    for s in strokes_of(path))
        print(layer.get(INK + "label"), f"{total * 25.4 / 96:.1f}")


def strokes_of_pdf(name):
    """What is painted at once, by the width of its pen: lists of polylines."""
    text = ""
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", open(name, "rb").read(), re.S):
        try:
            text += zlib.decompress(stream).decode("latin-1")
        except zlib.error:
            continue
    found, width, lines = {}, 0.0, []
    number = r"(-?[0-9.]+)"
    for w, x, y, to, end in re.findall(
            rf"{number}\s+w\b|{number}\s+{number}\s+([ml])\b|\b([Sf])\b", text):
        if w:
            width = float(w)
        elif to == "m":
            lines.append([(float(x), float(y))])
        elif to == "l":
            lines[-1].append((float(x), float(y)))
        elif end:
            found.setdefault(width, []).append(lines)
            lines = []
    return found


def check_pdf(name, most):
    """Of the thin pen: the longest dash, and strokes of one dash."""
    found = strokes_of_pdf(name)
    thin = found[min(found)]
    longest = max(length(dash) for stroke in thin for dash in stroke)
    solid = sum(len(stroke) < 2 and length(stroke[0]) > .05 for stroke in thin)
    print(f"{len(thin)} strokes, {solid} of them solid, no dash longer than {longest:.2f}")
    return len(found) > 1 and longest < most and not solid


def pixels(name):
    """Of a binary .ppm file of 8 bits, as RRGGBB."""
    data = open(name, "rb").read()
    size = int(data.split()[1]) * int(data.split()[2])
    rgb = data[-3 * size:]
    return [rgb[k:k + 3].hex() for k in range(0, len(rgb), 3)]


def count_colours(name, wanted):
    found = Counter(pixels(name))
    print(", ".join(f"{colour} {found[colour]}" for colour in wanted))
    return all(found[colour] >= 20 for colour in wanted)


def show_ink(name):
    print(f"{sum(1 - int(p[:2], 16) / 255 for p in pixels(name)):.1f}")


def main():
    what, name = sys.argv[1:3]
    if what == "layers":
        show_layers(name)
    elif what == "dashes":
        sys.exit(1 if check_dashes(name, *(float(x) for x in sys.argv[3:])) else 0)
    elif what == "lengths":
        show_lengths(name)
    elif what == "colours":
        sys.exit(0 if count_colours(name, sys.argv[3:]) else 1)
    elif what == "ink":
        show_ink(name)
    else:
        sys.exit(0 if check_pdf(name, float(sys.argv[3])) else 1)


main()
