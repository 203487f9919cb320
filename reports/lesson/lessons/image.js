// SPDX-License-Identifier: GPL-3.0-or-later
// The four algorithms in image space. all.js says what a lesson is.
import { countOf, perEach, share, times, withOutcome } from "../telling/figures.js";

const WINDOW = "Is the face disjoint from the window, does it intersect or surround it?";
const KINDS = { disjoint: "disjoint", intersecter: "it intersects",
  surrounder: "it surrounds" };
const isLarge = (run, { window: w }) => w && w.width >= run.width / 16;
const isSmall = (run, e) => isLarge(run, e) && e.window.width < run.width / 2;

export const warnock = {
  idea: "Divide until it is simple",
  text: ["Look at a window. If one face surrounds it and all others are behind, it is " +
    "done; also if nothing is in it. Otherwise divide it into four and look at each " +
    "quarter. Large areas cost little; the work gathers along edges.",
  "A face is disjoint from a window, surrounds it, or intersects it. A face that " +
    "surrounds a window, or is disjoint from it, is so for its quarters, too, and is " +
    "not tested again."],
  source: "The survey, chapter III, area sampling, figures 25 and 26; Warnock 1969",
  moments: [
    ["The first window is the whole picture", { name: "windows" }],
    ["A face intersects it", { of: "window-test", outcome: "intersecter" }],
    ["Too much is in it: it is divided into four", { of: "subdivision" }],
    ["A quarter is divided again", { of: "subdivision", nth: 2 }],
    ["The surround hides all else: the window is shown",
      { of: "homogeneous-window", pick: "largest", id: "shown" }],
    ["A face surrounds this window", { of: "window-test", outcome: "surrounder",
      where: (run, e) => e.window?.width > 1, pick: "largest" }, WINDOW, KINDS],
    ["A face is disjoint from this window: it is left out, here and in its quarters",
      { of: "window-test", outcome: "disjoint", pick: "largest",
        where: isLarge }, WINDOW, KINDS],
    ["A face intersects this window", { of: "window-test", outcome: "intersecter",
      pick: "largest", where: isSmall }, WINDOW, KINDS],
    ["That a face surrounds is inherited, not tested", { name: "inherited surrounders",
      pick: "largest" }],
    ["Solid is a surround. The dashed face is behind all of it in the window",
      { name: "depth search", outcome: "behind", pick: "largest", real: true }],
    ["An empty window shows the background", { of: "empty-window", pick: "largest" }],
    ["One face before its background", { name: "one in front", pick: "largest" }],
    ["Along an edge, windows become single samples", { of: "sample", real: true }],
    ["Half of the windows are done", { name: "windows", at: 0.5 }],
  ],
  find: ["What share of the picture is shown in windows larger than a sample?",
    (run) => {
      const { width, height } = run.trace;
      const size = (k) => width[k] * height[k];
      const large = run.accepts.reduce((sum, k) =>
        sum + (height[k] > 1 ? size(k) : 0), 0);
      return `${times(large)} of ${times(run.width * run.height)} samples: ${share(
        large, run.width * run.height)}.`;
    }],
};

const YSORT = ["Each edge goes into the bucket of the scan line where it begins",
  { name: "Y sort", pick: "largest" }];

const NEARER = "Is the solid one nearer or farther than the dashed one, at this place?";

export const romney = {
  idea: "Buckets along the line, and lines that repeat",
  text: ["Triangles go into a bucket for the line where each begins. On a line, their " +
    "left and right ends go into a bucket for each sample. Going along the buckets, " +
    "it is known at each place which triangles are there. Where that changes, the " +
    "nearest is searched.",
  "If the ends come in the same order as on the line before, the same faces are " +
    "visible. Then no depth is compared."],
  source: "The survey, chapter III, scan lines; Wylie, Romney, Evans and Erdahl 1967",
  needs: [{ of: "line-reused", instead: "color-cube:2",
    why: "No line of this picture repeats the order of the line before." }],
  moments: [
    ["Each triangle goes into the bucket of the line where it begins",
      { name: "Y sort", pick: "largest" }],
    ["Two triangles are here, and the new one is nearer",
      { of: "depth-search", outcome: "nearer", pick: "largest", real: true,
        id: "depth" }, NEARER],
    ["On a line, the ends of a triangle go into X buckets", { name: "X sort",
      with: ["depth", "row"] }],
    ["An empty X bucket: nothing changes here",
      { of: "x-bucket", outcome: "empty", with: ["depth", "row"], at: 0.5 }],
    ["A bucket that holds ends: something may change",
      { of: "x-bucket", outcome: "holds intercepts", with: ["depth", "row"] }],
    ["The nearest is shown up to the next change", { of: "span", pick: "largest",
      real: true, with: ["depth", "row"] }],
    ["Two triangles are here, and the new one is farther",
      { of: "depth-search", outcome: "farther", pick: "largest", real: true }, NEARER],
    ["The ends are in the order of the last line: the same face is shown",
      { of: "span-reused", pick: "largest", real: true }],
    ["A whole line needed no search", { of: "line-reused", at: 0.5 }],
    ["Half of the picture", { of: "span", at: 0.5 }],
  ],
  find: ["How many lines are drawn without a depth search?", (run) =>
    `${times(countOf(run, "line-reused"))} of ${times(run.height)} lines; ${times(
      countOf(run, "span-reused"))} spans were shown again.`],
};

const RIGHT = "Does the solid edge cross this line right or left of the dashed one?";

// What happens on a row, before its spans; `row` is the id of a moment on it.
const scanLine = (row) => [
  YSORT,
  ["Edges that begin here are merged into the list, by X",
    { name: "X merge", pick: "largest" }],
  ["Two neighbors in the list are compared: in order",
    { of: "x-sort", outcome: "to the right", with: [row, "row"], pick: "largest" },
    RIGHT],
  ["Out of order: the edges have crossed since the last line",
    { of: "x-sort", outcome: "to the left", pick: "largest", id: "order" }, RIGHT],
  ["They change places in the list", { of: "interchange", after: "order" }],
];

export const bouknight = {
  idea: "Spans between neighboring edges",
  text: ["The edges that cross a line are kept in a list in order of X. From line to " +
    "line the list hardly changes, so that a bubble sort mends it. Between each edge " +
    "and the next is a span: which face is nearest at both of its ends?",
  "If two different faces are, they penetrate, and the span is divided there."],
  source: "The survey, chapter III, scan lines, figure 27a; Bouknight 1969",
  needs: [{ of: "span-division", instead: "penetration",
    why: "No two faces of this scene penetrate, so that no span is divided." }],
  moments: [
    ["The faces that are on are compared at an end of the span: nearer",
      { of: "depth-search", outcome: "nearer", real: true, pick: "largest",
        id: "depth" }, NEARER],
    ...scanLine("depth"),
    ["At its edge, a face is turned on", { name: "span cull", outcome: "turned on",
      with: ["depth", "row"], pick: "largest" }],
    ["At its other edge, it is turned off", { name: "span cull", outcome: "turned off",
      with: ["depth", "row"], pick: "largest" }],
    ["The nearest face is shown in the span", { of: "span", real: true,
      with: ["depth", "row"], pick: "largest" }],
    ["The faces that are on are compared: farther",
      { of: "depth-search", outcome: "farther", real: true, pick: "largest" }, NEARER],
    ["A different face is nearest at each end: they penetrate, and the span is divided",
      { of: "span-division", pick: "largest", id: "cut" }],
    ["The first part of the divided span is shown", { of: "span", after: "cut" }],
    ["Half of the lines are done", { of: "span", at: 0.5 }],
  ],
  find: ["How many spans and depth comparisons are there for each line?", (run) =>
    `${perEach(run, "span", run.height, "line")} ${perEach(run, "depth-search",
      run.height, "line")}`],
};

export const watkins = {
  idea: "Spans as long as possible",
  text: ["As in Bouknight’s algorithm the edges of a line are in order. But a span may " +
    "pass over edges of what is hidden: its right end moves to the left only where a " +
    "nearer segment comes into view. So there are few spans.",
  "Two segments are compared by the depths of their ends. If these do not tell, one " +
    "segment is divided at its midpoint: a logarithmic search."],
  source: "The survey, chapter III, scan lines, figures 12, 27b and 28; Watkins 1970",
  needs: [{ of: "depth-division", instead: "penetration",
    why: "In this scene the ends of segments always tell: nothing is divided." }],
  moments: [
    ["Two segments are compared: their ends tell",
      { of: "depth-search", outcome: "nearer", pick: "largest", real: true,
        id: "depth" }, NEARER],
    ...scanLine("depth"),
    ["A segment is outside of the span: it does not matter",
      { of: "span-cull", outcome: "outside", with: ["depth", "row"],
        pick: "largest" }, "Is the segment of this face inside the span?"],
    ["A segment is inside the span: it is searched",
      { of: "span-cull", outcome: "inside", with: ["depth", "row"],
        pick: "largest" }, "Is the segment of this face inside the span?"],
    ["The visible segment is shown, over edges of what it hides",
      { of: "span", real: true, with: ["depth", "row"], pick: "largest" }],
    ["The solid segment is farther", { of: "depth-search", outcome: "farther",
      pick: "largest", real: true }, NEARER],
    ["The depths of the ends overlap: undecided",
      { of: "depth-search", outcome: "undecided", pick: "largest", real: true,
        id: "open" }],
    ["One segment is divided at its midpoint", { of: "depth-division",
      after: "open" }],
    ["The half is compared again", { of: "depth-search", after: "open" }],
    ["Half of the lines are done", { of: "span", at: 0.5 }],
  ],
  find: ["How many comparisons of segments end without a division?", (run) => {
    const all = countOf(run, "depth-search");
    const open = withOutcome(run, "depth-search", "undecided");
    return `${times(all - open)} of ${times(all)}: ${share(all - open, all)}. ${times(
      countOf(run, "depth-division"))} divisions were made.`;
  }],
};
