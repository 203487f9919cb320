#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much work each algorithm does for the same picture. A program, or a notebook
of the cells between the lines # %%.

    counts.py [--text] [SCENE [PICTURE]]

It writes the picture, counts.png, by matplotlib. With --text, or without
matplotlib, it prints a chart.
"""

# %% What is drawn
import sys
from collections import Counter
from math import log10

import hsr

words = [word for word in sys.argv[1:] if not word.startswith("-")]
scene = hsr.scene(words[0] if words else "house")
picture = words[1] if len(words) > 1 else "counts.png"
SIZE = (160, 120)


# %% The counts of an algorithm, by the kind of step
def count_steps(algorithm):
    answer = scene.render(algorithm.name, SIZE, counts=True)
    if not answer.judge().is_right:
        return None
    steps = Counter()
    for counter, count in zip(algorithm.counters, answer.count.tolist()):
        if not counter.is_computed:
            steps[counter.step] += count
    return steps


# %% Those of all algorithms that take the scene and are right
work = {}
for algorithm in hsr.algorithms():
    if algorithm.kind == "ids" and algorithm.counters and not algorithm.is_oracle:
        try:
            steps = count_steps(algorithm)
        except hsr.RefusedError:
            continue
        if steps:
            work[algorithm.name] = steps
order = sorted(work, key=lambda name: sum(work[name].values()))


# %% A chart of text. Its bars are logarithmic
def print_chart():
    least = sum(work[order[0]].values())
    for name in order:
        total = sum(work[name].values())
        kind, _ = work[name].most_common(1)[0]
        bar = "#" * (1 + round(9 * log10(total / least)))
        print(f"{name:19} {bar:28} {total:12,}  most: {kind}")
    print("9 signs # are ten times as many steps")


# %% A plot. The colour says which kind of step is the most frequent
def make_plot(pyplot):
    most = [work[name].most_common(1)[0][0] for name in order]
    figure, axes = pyplot.subplots(figsize=(9, 9))
    for kind in sorted(set(most)):
        rows = [k for k in range(len(order)) if most[k] == kind]
        axes.barh(rows, [sum(work[order[k]].values()) for k in rows], label=kind)
    axes.set_yticks(range(len(order)))
    axes.set_yticklabels(order)
    axes.set_xscale("log")
    axes.set_xlabel(f"steps for {scene.name}, {SIZE[0]} x {SIZE[1]}")
    axes.legend(title="most of them")
    figure.savefig(picture, bbox_inches="tight")
    print(picture)


# %% What is here
try:
    if "--text" in sys.argv:
        raise ImportError
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    print_chart()
else:
    make_plot(pyplot)
