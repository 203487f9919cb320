#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in drawings on paper, for drawings.test.

  paper.py layers FILE.svg        the layers, a line each: name, strokes
  paper.py dashes FILE.svg        complains of dashed strokes whose dashes do not
                                  add up, or that have no gap
  paper.py lengths FILE.svg       mm of line by layer
  paper.py dxf FILE.dxf           the same of polylines
  paper.py longest FILE.pdf N     complains if the thinner of two pens draws more
                                  than N points at once
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


def check_dashes(name):
    """A dash list ends with ink; it may have a gap of 0 at its end."""
    wrong = 0
    for path in ET.parse(name).getroot().iter(SVG + "path"):
        dashes = path.get("stroke-dasharray")
        if dashes is None:
            continue
        numbers = [float(x) for x in dashes.split()]
        (stroke,) = strokes_of(path)
        if abs(sum(numbers) - length(stroke)) > .002 * (len(numbers) + len(stroke)):
            print("a sum of", sum(numbers), "for", length(stroke))
            wrong += 1
        if length(stroke) > .05 and not max(numbers[1::2]) > 0:
            print("solid:", path.get("d"))
            wrong += 1
    return wrong


def show_lengths(name):
    for layer in layers(ET.parse(name).getroot()):
        total = sum(length(s) for path in layer.iter(SVG + "path")
                    for s in strokes_of(path))
        print(layer.get(INK + "label"), f"{total * 25.4 / 96:.1f}")


def show_dxf(name):
    """Group codes and values take turns, a line each."""
    lines = open(name).read().splitlines()
    pairs = [(int(c), v.strip()) for c, v in zip(lines[::2], lines[1::2])]
    total, stroke, x, closed, layer, inside = {}, [], 0, False, "", False
    for code, value in pairs + [(0, "END")]:
        if code == 0:
            if inside and stroke:
                way = stroke + (stroke[:1] if closed else [])
                total[layer] = total.get(layer, 0) + length(way)
            inside, stroke, closed = value == "LWPOLYLINE", [], False
        elif inside and code == 8:
            layer = value
        elif inside and code == 70:
            closed = bool(int(value) & 1)
        elif inside and code == 10:
            x = float(value)
        elif inside and code == 20:
            stroke.append((x, float(value)))
    for layer in total:
        print(layer, f"{total[layer]:.1f}")


def check_longest(name, most):
    """The longest straight way of the PDF's thin pen, in points."""
    data = open(name, "rb").read()
    text = ""
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
        try:
            text += zlib.decompress(stream).decode("latin-1")
        except zlib.error:
            continue
    width, at, way, longest = 0.0, None, 0.0, {}
    number = r"(-?[0-9.]+)"
    for numbers in re.findall(rf"{number}\s+(w)\b|{number}\s+{number}\s+([ml])\b", text):
        *numbers, command = [word for word in numbers if word]
        if command == "w":
            width = float(numbers[-1])
        elif command == "m":
            at, way = tuple(float(x) for x in numbers[-2:]), 0.0
        elif command == "l" and at:
            to = tuple(float(x) for x in numbers[-2:])
            way += math.dist(at, to)
            at = to
            longest[width] = max(longest.get(width, 0), way)
    thin = min(longest)
    print(f"pens {len(longest)}, the thin one draws at most {longest[thin]:.2f}")
    return not (len(longest) > 1 and longest[thin] < most)


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
        sys.exit(1 if check_dashes(name) else 0)
    elif what == "lengths":
        show_lengths(name)
    elif what == "dxf":
        show_dxf(name)
    elif what == "colours":
        sys.exit(0 if count_colours(name, sys.argv[3:]) else 1)
    elif what == "ink":
        show_ink(name)
    else:
        sys.exit(1 if check_longest(name, float(sys.argv[3])) else 0)


main()
