// SPDX-License-Identifier: GPL-3.0-or-later
// The lessons: the ten algorithms of Sutherland, Sproull and Schumacker, "A
// Characterization of Ten Hidden-Surface Algorithms", Computing Surveys 6(1),
// 1974, in the order of its taxonomy, and two later ones. `bench/lesson` says
// which scene each is on.
//
// see: [words, { key, outcome, nth }]: a step worth seeing, the nth (from 1) of the
// counter of that key, with that outcome. ask: what a reader can find out.

export const LESSONS = {
  roberts: {
    idea: "Edges against volumes",
    text: ["Everything is a convex volume. Each edge is put to each volume: which " +
      "part of the line from the eye to the edge lies inside? That is a linear " +
      "programme, and a volume leaves at most two pieces of an edge. What is left " +
      "after all volumes is drawn.",
    "Most pairs never get that far. Boxes on the screen are compared first, and " +
      "whole objects are left out at once. The count of box tests grows with " +
      "edges times objects all the same."],
    see: [["an edge that no front face has is culled",
      { key: "back-edge-cull", outcome: "does not exist" }],
    ["an edge is put to a volume that hides all of it",
      { key: "edge-volume", outcome: "hidden whole" }],
    ["a volume leaves one piece", { key: "one-left" }],
    ["the first interval is drawn", { key: "interval-drawn" }]],
    ask: "How many box tests are there for each edge/volume test?",
    source: "The survey, chapter III, object-space algorithms; Roberts 1963",
  },
  appel: {
    idea: "Edges against edges: quantitative invisibility",
    text: ["Follow an edge and keep one number: how many faces hide it here. The " +
      "number changes only where the edge passes behind a contour edge, which is " +
      "an edge between a front face and a back face. Between crossings nothing " +
      "is asked.",
    "The number at the start of an edge comes from its neighbour: edges that " +
      "share a vertex share it there, but for the faces at that corner. Only one " +
      "vertex of each cluster is put to all faces."],
    see: [["one vertex is put to a face that hides it",
      { key: "initial-visibility", outcome: "hides" }],
    ["the edge passes behind a contour edge",
      { key: "edge-intersection", outcome: "nearer" }],
    ["the number is promoted to the other end", { key: "promoted" }],
    ["a hidden interval is found on the way", { key: "interval-drawn", nth: 3 }]],
    ask: "Below the picture is the edge from end to end. Where does its " +
      "number change, and by how much at a time?",
    source: "The survey, chapter III, edge intersection, figures 14 to " +
      "16; Appel 1967",
  },
  galimberti: {
    idea: "The same, with the set of the faces that hide",
    text: ["In place of a number, the set of faces that hide the edge is kept. So " +
      "each edge is compared with all edges, not only with contour edges, and " +
      "each crossing says which face is entered or left.",
    "Beside Appel’s, the same picture comes of more comparisons: that is the " +
      "price of knowing who hides, and not only how many."],
    see: [["an edge is crossed by a nearer one",
      { key: "edge-intersection", outcome: "nearer" }],
    ["the set changes", { key: "nature-change" }]],
    ask: "Put it beside appel. Which counter differs most?",
    source: "The survey, chapter III, edge intersection; Galimberti and " +
      "Montanari 1969",
  },
  loutrel: {
    idea: "The same, with the crossing found on the screen",
    text: ["Loutrel keeps Appel’s number, but finds a crossing in two steps: do " +
      "the images of the edges cross in the picture plane, and is the contour " +
      "edge nearer there? Boxes of the images are compared before that."],
    see: [["the boxes of two edges overlap", { key: "boxes-overlap" }],
      ["their images cross, but the other one is farther",
        { key: "plane-intersection", outcome: "farther" }],
      ["and here it is nearer", { key: "plane-intersection",
        outcome: "nearer" }]],
    ask: "What share of all pairs is settled by their boxes?",
    source: "The survey, chapter III, edge intersection; Loutrel 1967",
  },
  schumacker: {
    idea: "Priority before the picture is known",
    text: ["Within a convex cluster, the order of faces can be found once, for all " +
      "places of the eye. Between clusters, planes that separate them make a tree: " +
      "on which side of each plane the eye is tells which cluster comes first. So " +
      "a frame needs no comparison of two faces at all.",
    "The hardware then had a pair of counters for each face, which count along " +
      "the scan line to where it begins and ends. At each sample the first pair " +
      "that is inside shows its face."],
    see: [["the eye is compared with a separating plane",
      { key: "inter-cluster" }],
    ["a back face is left out", { key: "back-face-cull", outcome: "back" }],
    ["counters find the highest priority at a sample",
      { key: "priority-search", outcome: "there, with the highest priority" }]],
    ask: "Which counters grow with the samples, and which do not?",
    source: "The survey, chapter III, list priority, figures 18 to 20; " +
      "Schumacker, Brand, Gilliland and Sharp 1969",
  },
  newell: {
    idea: "Priority for each frame: the painter’s list, made safe",
    text: ["Sort the faces by their farthest points, and paint from the back. " +
      "Before one is painted, six tests, the cheap ones first, ask of later ones: " +
      "may it obscure them? If no test rules that out, the other one is painted " +
      "first.",
    "Three bars, each over the next, have no order. A marker notices that one " +
      "is to be moved twice, and then it is divided by the plane of the other."],
    see: [["two pieces are apart in X", { key: "list-test",
      outcome: "test 2: apart in X" }],
    ["one may obscure the other", { key: "list-test",
      outcome: "P may obscure Q" }],
    ["the list is changed", { key: "list-move" }],
    ["a circle: the piece is divided", { key: "list-division" }],
    ["the first run of samples is written, when all is in order",
      { key: "span-written" }]],
    ask: "Which of the six tests decides most often?",
    source: "The survey, chapter III, list priority, figures 21 to 23; " +
      "Newell, Newell and Sancha 1972",
  },
  warnock: {
    idea: "Area sampling: divide until it is simple",
    text: ["Look at a window. If one face surrounds it and all others are behind, or " +
      "if nothing is in it, it is done. Otherwise divide it into four. Large areas " +
      "of one face cost little; the work gathers along edges.",
    "A face is disjoint from a window, intersects it or surrounds it. What " +
      "surrounds or misses a window does so for its quarters too, and is not " +
      "tested again."],
    see: [["the picture is divided into four", { key: "subdivision" }],
      ["a face surrounds a window", { key: "window-test",
        outcome: "surrounder" }],
      ["an empty window is shown", { key: "empty-window" }],
      ["a surround hides the rest: the window is shown",
        { key: "homogeneous-window" }],
      ["a window of one sample", { key: "sample" }]],
    ask: "Move by rows or windows. Where are the smallest windows?",
    source: "The survey, chapter III, depth priority, figures 25 and 26; " +
      "Warnock 1969",
  },
  romney: {
    idea: "Scan lines: bucket sorts, and lines that repeat",
    text: ["Triangles are put into a bucket for the line where each begins, and on a " +
      "line their ends into a bucket for each sample. Going along the buckets, it " +
      "is known at each place which triangles are there; the nearest one is " +
      "searched where that changes.",
    "If the ends come in the same order as on the line before, so do the " +
      "visible faces, and no depth is compared."],
    see: [["a bucket with ends in it", { key: "x-bucket",
      outcome: "holds intercepts" }],
    ["a depth search", { key: "depth-search" }],
    ["a span is shown as on the line before", { key: "span-reused" }],
    ["a whole line needed no search", { key: "line-reused" }]],
    ask: "How many lines are drawn without a depth search?",
    source: "The survey, chapter III, scan lines; Wylie, Romney, Evans " +
      "and Erdahl 1967",
  },
  bouknight: {
    idea: "Scan lines: spans between neighbouring edges",
    text: ["The edges that cross a line are kept in a list, in order of X. From line " +
      "to line the list hardly changes, so a bubble sort mends it. Between each " +
      "edge and the next, one span: which face is nearest at both its ends?",
    "If two different faces are, they penetrate, and the span is divided there."],
    see: [["two neighbours in the list change places",
      { key: "interchange" }],
    ["the nearest face of a span is searched", { key: "depth-search" }],
    ["two faces penetrate: the span is divided", { key: "span-division" }],
    ["a span is shown", { key: "span" }]],
    ask: "Put it beside watkins. Which of them shows more spans?",
    source: "The survey, chapter III, scan lines, figure 27a; Bouknight 1969",
  },
  watkins: {
    idea: "Scan lines: spans as long as possible",
    text: ["As Bouknight’s, but a span may pass over edges behind what is visible: " +
      "its right end moves to the left only where a nearer segment comes into " +
      "view. So there are fewer spans, and fewer comparisons in depth.",
    "Two segments are compared by the depths of their ends; where that does " +
      "not tell, one is divided at its midpoint, as a logarithmic search."],
    see: [["a segment lies outside of the span", { key: "span-cull",
      outcome: "outside" }],
    ["two segments are compared", { key: "depth-search" }],
    ["their ends do not tell: one is divided", { key: "depth-division" }],
    ["a span is shown", { key: "span" }]],
    ask: "Click a sample where faces penetrate. How often was a segment divided?",
    source: "The survey, chapter III, scan lines, figures 12, 27b and " +
      "28; Watkins 1970",
  },
  hzbuffer: {
    idea: "Later: a pyramid of depths, and an octree of faces",
    text: ["Greene, Kass and Miller ask of a whole cube of an octree whether any of " +
      "it can be seen. A pyramid keeps the farthest depth of each square of " +
      "samples, so that one comparison may hide a cube with all that is in it."],
    see: [["a cube is asked about", { key: "cube-tested" }],
      ["a cube is hidden, with all its faces", { key: "cube-tested",
        outcome: "hidden" }],
      ["an entry of the pyramid decides", { key: "cube-read",
        outcome: "decides" }],
      ["a sample is written", { key: "write" }]],
    ask: "How many of the cubes that were asked about were hidden?",
    source: "Greene, Kass and Miller 1993",
  },
  tiling: {
    idea: "Later: coverage masks, from front to back",
    text: ["Greene’s tiling goes from front to back, and writes each sample once. It " +
      "is Warnock’s division again, with masks of 8 × 8 cells in place of windows: " +
      "a few words tell which cells a polygon covers, touches or misses."],
    see: [["a cube’s silhouette is looked at", { key: "cube-tested" }],
      ["a cell that has to be divided", { key: "polygon-cell",
        outcome: "active" }],
      ["a cell of the finest level", { key: "finest-cell" }],
      ["samples are shown by a mask", { key: "sample" }]],
    ask: "Put it beside warnock. What does Warnock compare that this does not?",
    source: "Greene 1996",
  },
};

// Step k at which the mark is reached; null: there is none in this run.
export function stepOf(run, { key, outcome, nth = 1 }) {
  const c = run.counterOf(key);
  const word = outcome === undefined ? -1
    : run.header.counters[c]?.outcomes?.indexOf(outcome);
  const { counter: counters, outcome: outcomes, kept } = run.trace;
  for (let k = 0, left = nth; c >= 0 && word !== undefined && k < kept; k++) {
    if (counters[k] !== c || (word >= 0 && outcomes[k] !== word)) continue;
    left -= 1;
    if (left === 0) return k + 1;
  }
  return null;
}
