// SPDX-License-Identifier: GPL-3.0-or-later
// The four algorithms in image space. all.js says what a lesson is.
import { searchAt } from "../data/stretches.js";
import { countOf, perEach, share, times, withOutcome } from "../telling/figures.js";

const WINDOW = "Is the face disjoint from the window, an intersecter or a surrounder?";
const isLarge = (run, { window: w }) => w && w.width >= run.width / 16;
const isSmall = (run, e) => isLarge(run, e) && e.window.width < run.width / 2;

// The first such window is the picture's own upper right quarter.
const isUpperRight = (run, { window: w }) => w && w.y === 0 && w.x > 0 &&
  w.x + w.width === run.width && w.height < run.height;

export const warnock = {
  idea: "Divide until it is simple",
  text: ["Look at a window. If no face is in it, or if one face covers all of it and " +
    "is nearer than all others there, the window is shown at once. If one " +
    "face is left that covers a part of it, the window shows what is behind this face, " +
    "and then the face. Otherwise it is divided into four, and each quarter is looked at " +
    "in the same way. A window of " +
    "a single sample shows the face that is nearest there. Large areas cost little; " +
    "the work gathers along edges.",
  "To a window, a face is one of three: disjoint, if no part of it is in the window; a " +
    "surrounder, if it covers all of the window; an intersecter, if it covers a part. " +
    "A surrounder of a window is a surrounder of its quarters, too; and what is disjoint " +
    "from a window is disjoint from its quarters. Neither is tested " +
    "again. Of all surrounders the nearest one is the critical one: it is compared " +
    "with the planes of the other faces at the corners of the window, since a plane is at " +
    "all four corners, even where its face is not. The faces come " +
    "in order of depth, so that the search ends at the first one that is behind a " +
    "surrounder.",
  "There are no scan lines. The quarters of a window are taken in this order: upper left, " +
    "upper right, lower left, lower right. Each is done with all its own quarters before " +
    "the next one begins, so that the picture fills in square by square."],
  source: "The survey, chapter III, area sampling, figures 25 and 26; Warnock 1969",
  moments: [
    ["First, the faces are put in order of depth", { name: "Z sort", pick: "largest" }],
    ["The first window is the whole picture", { name: "windows" }],
    ["An intersecter: the face covers a part of the window",
      { of: "window-test", outcome: "intersecter" }, WINDOW],
    ["It is not empty, and no face hides all else in it: it is divided into four",
      { of: "subdivision" }],
    ["A quarter is divided again, before the next quarter is taken", { of: "subdivision",
      nth: 2 }],
    ["The upper left quarter is done: the upper right one is next",
      { name: "windows", where: isUpperRight }],
    ["A surrounder: the face covers all of this window",
      { of: "window-test", outcome: "surrounder", where: isLarge, id: "surrounder",
        or: { of: "window-test", outcome: "surrounder", pick: "largest" } }, WINDOW],
    ["A surrounder that hides all else in its window: it is shown",
      { of: "homogeneous-window", pick: "largest", after: "surrounder" }],
    ["The face is disjoint from this window: it is left out, here and in its quarters",
      { of: "window-test", outcome: "disjoint", where: isLarge }, WINDOW],
    ["Another intersecter, of a smaller window",
      { of: "window-test", outcome: "intersecter", pick: "largest",
        where: isSmall }, WINDOW],
    ["A surrounder of the larger window: its quarter inherits that, without a test",
      { name: "inherited surrounders", pick: "largest" }],
    ["Dashed: the critical surrounder. Solid: a face behind it at all corners",
      { name: "depth search", outcome: "behind", pick: "largest", real: true }],
    ["An empty window shows the background", { of: "empty-window", pick: "largest" }],
    ["One intersecter is left: what is behind it is shown in all of the window, then itself",
      { name: "one in front", pick: "largest" }],
    ["Along an edge, windows become single samples", { of: "sample", real: true }],
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
  text: ["Faces are triangles, or are cut into triangles, and go into a bucket for the " +
    "line where each begins. On a line, their " +
    "left and right ends go into a bucket for each sample. Going along the buckets, " +
    "it is known at each place which triangles are there. Where that changes, the " +
    "nearest is searched.",
  "If the ends come in the same order as on the line before, the same faces are " +
    "visible, since no faces penetrate each other: Romney's scenes have none that do, " +
    "and hsr divides such faces first. Then no depth is compared. This holds for the " +
    "left part of a line, too, up to the first change."],
  source: "The survey, chapter III, scan lines; Wylie, Romney, Evans and Erdahl 1967",
  needs: [{ of: "line-reused", instead: "color-cube:2",
    why: "No line of this picture repeats the order of the line before." }],
  moments: [
    ["Each face goes into the bucket of the line where it begins",
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

// What happens on rows before their spans: before the moment of that id, if it can be.
const scanLine = (id) => [
  YSORT,
  ["Edges that begin here are merged into the list, by X",
    { name: "X merge", before: id, pick: "largest",
      or: { name: "X merge", pick: "largest" } }],
  ["Out of order: the edges have crossed since the last line",
    { of: "x-sort", outcome: "to the left", before: id, pick: "largest", id: "order",
      or: { of: "x-sort", outcome: "to the left", pick: "largest" } }, RIGHT],
  ["Two neighbors in the list are compared: in order",
    { of: "x-sort", outcome: "to the right", with: ["order", "row"], before: "order",
      pick: "largest", or: { of: "x-sort", outcome: "to the right", pick: "largest" } },
    RIGHT],
  ["They change places in the list", { of: "interchange", after: "order" }],
];

// Whether the span before this one, on its row, shows the same face and ends here.
function isRepeated(run, e) {
  const c = run.counterOf("span"), { trace } = run;
  for (let k = e.k - 1; k >= 0 && trace.y[k] === e.window.y; k--)
    if (trace.counter[k] === c) return trace.a0[k] === e.a.ids[0] &&
      trace.x[k] + trace.width[k] === e.window.x && e.window.width > 2;
  return false;
}

export const bouknight = {
  idea: "Spans between neighboring edges",
  text: ["The edges that cross a line are kept in a list in order of X. From line to " +
    "line the list hardly changes, so that a bubble sort mends it. Between each edge " +
    "and the next is a span: which face is nearest at both of its ends?",
  "A face is on between its two edges: at the first it is turned on, at the second off. " +
    "In every span all faces that are on are searched, one after the other: each is " +
    "compared with the nearest so far. So each edge begins a new search, even the edge of " +
    "a face that is hidden there.",
  "If two different faces are, they penetrate, and the span is divided there."],
  source: "The survey, chapter III, scan lines, figure 27a; Bouknight 1969",
  needs: [{ of: "span-division", instead: "penetration",
    why: "No two faces of this scene penetrate, so that no span is divided." }],
  moments: [
    ["Of the faces that are on, this is nearer than the nearest so far",
      { of: "depth-search", outcome: "nearer", real: true, pick: "largest",
        id: "depth" }, NEARER],
    ...scanLine("depth"),
    ["At its edge, a face is turned on", { name: "span cull", outcome: "turned on",
      with: ["depth", "row"], pick: "largest" }],
    ["At its other edge, it is turned off", { name: "span cull", outcome: "turned off",
      with: ["depth", "row"], pick: "largest" }],
    ["The nearest face is shown in the span", { of: "span", real: true,
      with: ["depth", "row"], after: "depth", pick: "widest",
      or: { of: "span", real: true, after: "depth" } }],
    ["Another face that is on is farther: the nearest so far stays",
      { of: "depth-search", outcome: "farther", real: true, with: ["depth", "row"],
        after: "depth" }, NEARER],
    ["A hidden face’s edge began this span: searched anew, for the same face",
      { of: "span", real: true, where: isRepeated, after: "depth", nth: 1 }],
    ["A different face is nearest at each end: they penetrate, and the span is divided",
      { of: "span-division", pick: "largest", id: "cut" }],
    ["The first part of the divided span is shown", { of: "span", after: "cut" }],
  ],
  find: ["How many spans and depth comparisons are there for each line?", (run) =>
    `${perEach(run, "span", run.height, "line")} ${perEach(run, "depth-search",
      run.height, "line")}`],
};

// The span that is shown next after event e, on its row.
function spanAfter(run, e) {
  const c = run.counterOf("span");
  for (let k = e.k + 1; k < run.trace.kept && run.trace.y[k] === e.window.y; k++)
    if (run.trace.counter[k] === c) return run.event(k).window;
  return null;
}

const WIDE = 1 / 12; // of the row: a span that can be seen

// Whether the segments are compared where one begins within the span that is shown next.
function isPassedOver(run, e) {
  const w = spanAfter(run, e);
  return w && w.width > WIDE * run.width && w.x + 2 < e.window.x &&
    e.window.x < w.x + w.width - 2;
}

// Whether the span that is shown next ends where these segments are compared.
function endsSpan(run, e) {
  const w = spanAfter(run, e);
  return w && w.x + w.width === e.window.x && w.width > WIDE * run.width;
}

// Whether the comparison after step k is of a half.
const isDivision = (run, k) => k >= 0 && k < run.trace.kept &&
  ["depth-division", "second-half"].includes(run.event(k).counter.key);

// Whether the span that begins where these segments are compared shows the first one.
function showsNext(run, e) {
  const c = run.counterOf("span"), { trace } = run;
  for (let k = e.k + 1; k < trace.kept && trace.y[k] === e.window.y; k++)
    if (trace.counter[k] === c && trace.x[k] === e.window.x)
      return trace.a0[k] === trace.a0[e.k];
  return false;
}

const isFirst = (run, e) => !isDivision(run, e.k - 1) && e.window.width > 2;
const isAtOnce = (run, e) => isFirst(run, e) && run.event(e.k - 1).counter !== e.counter;

const keepsHalf = (run, e) => e.window.width > 2 &&
  Boolean(searchAt(run, e.k)?.half?.kept);
const dividesSpan = (run, e) => e.window.width > 4 &&
  searchAt(run, e.k)?.half?.side === null;
// Whether it took several divisions.
const isPaid = (run, e) => e.window.width > 1 && isDivision(run, e.k - 1) &&
  searchAt(run, e.k)?.divisions > 1;

export const watkins = {
  idea: "Spans as long as possible",
  text: ["As in Bouknight’s algorithm the edges of a line are kept in order of X, from " +
    "line to line. But a span may pass over edges of what is hidden. Its left end is " +
    "where the last span ended; its right end floats. It begins at the end of the " +
    "line, and moves to the left only where the visible segment ends, or where " +
    "another one comes to be nearer. So there are few spans.",
  "Two segments are compared by the depths of their ends: if the nearest end of one " +
    "is deeper than the farthest end of the other, all is known. If these do not " +
    "tell, the longer segment is divided at its midpoint. A half that lies outside of " +
    "the span is dropped, and the other one is compared again: a logarithmic search. " +
    "If both halves reach into the span, the span is divided there: the left part is " +
    "searched first, and the right part only if one face is nearer in all of the left " +
    "part. Otherwise the span ends where the order changes, and what is right of it " +
    "waits for the next span. So it is where two faces penetrate.",
  "The price: each midpoint costs one more comparison of the same two segments. As " +
    "halves shrink to a single sample at the latest, that is as many comparisons as the " +
    "length can be halved. A midpoint needs no multiplication: a sum and a shift by one " +
    "bit give its column and its depth."],
  source: "The survey, chapter III, scan lines, figures 12, 27b and 28; Watkins 1970",
  needs: [{ of: "depth-division", instead: "penetration",
    why: "In this scene the ends of segments always tell: nothing is divided." }],
  moments: [
    ["A segment begins inside the span, but is farther: the span goes on over it",
      { of: "depth-search", outcome: "farther", pick: "largest", real: true,
        where: isPassedOver, id: "over",
        or: { of: "depth-search", outcome: "farther", pick: "largest", real: true } },
      NEARER],
    ...scanLine("over"),
    ["The span begins at the left. A segment that begins in it: inside",
      { of: "span-cull", outcome: "inside", with: ["over", "row"], before: "over" },
      "Is the segment of this face inside the span?"],
    ["The visible segment is shown in one span, over the edge of what it hides",
      { of: "span", real: true, after: "over" }],
    ["A segment that ends left of the span, or begins right of it: outside",
      { of: "span-cull", outcome: "outside", with: ["over", "row"], after: "over",
        pick: "largest" }, "Is the segment of this face inside the span?"],
    ["Here the solid segment comes to be nearer: the span’s right end moves to here",
      { of: "depth-search", outcome: "nearer", real: true, after: "over",
        where: (run, e) => endsSpan(run, e) && showsNext(run, e), pick: "largest",
        id: "ends" }, NEARER],
    ["So this span ends before it, and the next one begins there",
      { of: "span", after: "ends" }],
    ["The depths of two segments overlap: their ends do not tell",
      { of: "depth-search", outcome: "undecided", after: "over", pick: "largest",
        real: true, where: isFirst, id: "open" }],
    ["One segment is divided at its midpoint, the dashed line", { of: "depth-division",
      after: "open" }],
    ["The price of a division: the same two are compared again",
      { of: "depth-search", after: "open" }],
    ["The half that holds the columns searched is kept, the other dropped",
      { of: "depth-division", pick: "largest", where: keepsHalf, after: "open" }],
    ["Both midpoints are within the columns: these are divided, left first",
      { of: "depth-division", pick: "largest", where: dividesSpan }],
    ["The ends of what was kept tell at last", { of: "depth-search", real: true,
      where: isPaid, like: /nearer|farther/, pick: "largest" }, NEARER],
    ["The ends of these two tell at once", { of: "depth-search", real: true,
      where: isAtOnce, before: "over", pick: "largest", like: /nearer|farther/,
      or: { of: "depth-search", real: true, where: isAtOnce, pick: "largest",
        like: /nearer|farther/ } }, NEARER],
  ],
  find: ["How many comparisons of segments end without a division?", (run) => {
    const all = countOf(run, "depth-search");
    const open = withOutcome(run, "depth-search", "undecided");
    return `${times(all - open)} of ${times(all)}: ${share(all - open, all)}. ${times(
      countOf(run, "depth-division"))} divisions were made.`;
  }],
};
