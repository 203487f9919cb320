// SPDX-License-Identifier: GPL-3.0-or-later
// The two algorithms of list priority. all.js says what a lesson is.
import { countOf, mostOutcomes, times } from "../telling/figures.js";

const SIDES = { "in front": "in front", behind: "behind" };
const FACING = { front: "yes, its front", back: "no, its back" };

const FEW = 60; // steps at a sample that are looked at

// Whether another face is there, too, at the same sample, after event e.
function hasRival(run, e) {
  const { x, y, counter, kept } = run.trace;
  for (let k = e.k + 1; k < Math.min(kept, e.k + FEW); k++) {
    if (x[k] !== x[e.k] || y[k] !== y[e.k]) return false;
    if (counter[k] === counter[e.k] && run.event(k).outcome === "there") return true;
  }
  return false;
}

export const schumacker = {
  idea: "Know the order before the picture",
  text: ["Within a convex cluster the faces have an order that holds from every eye; " +
    "it is found once. Between clusters, planes that separate them make a tree. On " +
    "which side of a plane the eye is tells which cluster comes first. So no depth " +
    "is compared in a frame.",
  "The machine had a pair of counters for each face. They count along the scan line " +
    "to where the face begins and ends. At each sample, the first pair in the order " +
    "that is inside shows its face."],
  source: "The survey, chapter III, list priority, figures 18 to 20; Schumacker, " +
    "Brand, Gilliland and Sharp 1969",
  needs: [{ of: "inter-cluster", instead: "color-cube:2",
    why: "This scene is one cluster: no plane separates anything." }],
  moments: [
    ["On which side of a separating plane is the eye?", { of: "inter-cluster" },
      "Is the eye in front of the dashed plane, or behind it?", SIDES],
    ["The next plane of the tree divides what is on the eye’s side",
      { of: "inter-cluster", nth: 2 },
      "Is the eye in front of the dashed plane, or behind it?", SIDES],
    ["The nearest cluster is found: its faces come first",
      { of: "back-face-cull" }],
    ["A face that looks away is left out",
      { of: "back-face-cull", outcome: "back", pick: "largest" },
      "Does this face look at the eye?", FACING],
    ["A face that looks at the eye gets the next place in the list",
      { of: "back-face-cull", outcome: "front", pick: "largest" },
      "Does this face look at the eye?", FACING],
    ["One more plane, and one more cluster", { of: "inter-cluster", nth: -1 },
      "Is the eye in front of the dashed plane, or behind it?", SIDES],
    ["The first face of the list that is inside wins",
      { of: "priority-search", outcome: "there, with the highest priority", at: 0.5,
        where: hasRival, id: "wins", or: { of: "priority-search", at: 0.5,
          outcome: "there, with the highest priority" } }],
    ["At this sample the counters of a face say: not inside",
      { of: "priority-search", outcome: "not there", with: ["wins", "place"] }],
    ["Another face is inside, too, but lower in the list",
      { of: "priority-search", outcome: "there", with: ["wins", "place"] }],
    ["The winner is shown: no depth was compared",
      { name: "samples shown", with: ["wins", "place"] }],
    ["A scan line passes an edge by",
      { name: "Y cull", outcome: "does not meet it", pick: "largest" }],
    ["A scan line meets an edge", { name: "Y cull", outcome: "meets it",
      pick: "largest" }],
    ["A pair of counters is loaded for the face", { of: "counter-pair",
      pick: "largest" }],
  ],
  find: ["Which work grows with the samples, and which does not?", (run) =>
    `For each sample and listed face: ${times(countOf(run, "priority-search"))} looks ` +
    `at counters, in ${times(run.width * run.height)} samples. For each frame only: ` +
    `${times(countOf(run, "inter-cluster"))} planes and ${times(countOf(run,
      "back-face-cull"))} faces.`],
};

// Whether two whole faces without a common corner are compared.
function areApart(run, { k, a, b }) {
  const [p, q] = [a, b].map(({ ids: [f, piece] }) => run.outline(k, piece, f) ? null
    : run.header.faces[f]?.[3]);
  return Boolean(p && q) && !p.some((v) => q.includes(v));
}

const TEST = "P is solid, Q is dashed. Which test shows that P does not obscure Q?";
const OVERLAP = "P is solid, Q is dashed. Do their images overlap?";
const answersOf = (apart) => ({ "test 6: overlap": "yes", [apart]: "no" });
const BETWEEN = "test 6: an edge is between them";
const ON_NO_ROW = "test 6: on no row do their samples meet";
// Of the first pair that no test clears: the steps before its last one.
const ofFirst = (of, nth = -1) => ({ of, before: "first", nth, with: ["first", "a"] });

export const newell = {
  idea: "The painter’s list, made safe",
  text: ["Sort the pieces by their farthest points, and paint from the back. Before P " +
    "is painted, up to six tests ask of each Q that comes after it: may P obscure Q? " +
    "The cheap tests come first, and the first that says no ends them. A test can prove " +
    "that P does not obscure Q, but never that it does. If none says no, Q is moved to " +
    "the place before P in the list: it will be painted first. It gets a marker, and is " +
    "the new P. When a piece is painted or divided, all markers are taken away.",
  "Three bars, each over the next, have no order. The list notices it when a piece " +
    "that has a marker is to be moved again. Then that piece is divided by the plane " +
    "of the other, and the halves find their places in the list. A circle may be of two, " +
    "where the tests let each of them obscure the other. So it is with two faces that " +
    "penetrate, and with two that overlap while neither plane tells: they are divided in " +
    "the same way.",
  "The six tests: is all of Q nearer than all of P; are they apart in X; are they apart in " +
    "Y; is P wholly beyond the plane of Q; is Q wholly before the plane of P; are their " +
    "images apart?",
  "A piece that is in order is painted row by row: on each row it overwrites what was " +
    "there before. The picture here shows in pale colours what has been painted so. " +
    "The rows are shown when all pieces are done."],
  source: "The survey, chapter III, list priority, figures 21 to 23; Newell, Newell " +
    "and Sancha 1972",
  needs: [{ of: "list-move", instead: "cyclic-overlap",
    why: "No order has to be changed in this scene: the Z sort is right already." },
  { of: "list-division", instead: "cyclic-overlap",
    why: "No faces of this scene overlap in a circle, so that nothing is divided." }],
  moments: [
    ["A piece with a marker is not moved again: it is divided by the plane of the other",
      { of: "list-division", id: "cut" }],
    ["Q has a marker already: a circle. Does the plane of one pass through the other?",
      { name: "circle search", before: "cut" }],
    ["Again no test says no. But this Q was moved before: it has a marker",
      { of: "list-test", like: /may obscure/, before: "cut", id: "again" }],
    ["", { of: "list-test", like: /may obscure/, id: "first" }],
    ["P is solid, Q dashed, and not all nearer (test 1). Are they apart in X (test 2)?", ofFirst("list-minimax", -2)],
    ["Test 3: are they apart in Y?", ofFirst("list-minimax")],
    ["Test 4: is P beyond the plane of Q? Test 5: is Q before the plane of P?",
      ofFirst("list-planes")],
    ["Test 6: do the images of P and Q overlap?", ofFirst("list-overlap"),
      OVERLAP, answersOf(BETWEEN)],
    ["No test has said no: P may obscure Q",
      { of: "list-test", like: /may obscure/ }],
    ["Q is moved before P. It is the new P, and bears a marker, the flag",
      { of: "list-move" }],
    ["Q is moved before P in turn: both bear a marker now",
      { of: "list-move", before: "again" }],
    ["A half finds its place in the list", { of: "list-insertion", after: "cut" }],
    ["The Z sort puts pieces in order by their farthest points", { of: "list-sort" }],
    ["Cleared by test 1: all of Q is nearer than all of P", { of: "list-test",
      outcome: "test 1: apart in Z", pick: "largest" }],
    ["Cleared by test 2: P and Q are apart in X",
      { of: "list-test", outcome: "test 2: apart in X", pick: "apart" }, TEST],
    ["Cleared by test 3: P and Q are apart in Y",
      { of: "list-test", outcome: "test 3: apart in Y", pick: "apart" }, TEST],
    ["Cleared by test 4: P is wholly beyond the plane of Q, the dashed sheet",
      { of: "list-test", like: /^test 4/, pick: "largest", where: areApart,
        or: { of: "list-test", like: /^test 4/, pick: "largest" } }, TEST],
    ["Cleared by test 5: Q is wholly before the plane of P, the pale sheet",
      { of: "list-test", like: /^test 5/, pick: "largest", where: areApart,
        or: { of: "list-test", like: /^test 5/, pick: "largest" } }, TEST],
    ["Cleared by test 6: boxes overlap, but a line is between the images",
      { of: "list-overlap", outcome: BETWEEN, pick: "largest", where: areApart }, OVERLAP,
      answersOf(BETWEEN)],
    ["Cleared by test 6: on each row of both their samples are apart",
      { of: "list-overlap", outcome: ON_NO_ROW, pick: "largest" }, OVERLAP,
      answersOf(ON_NO_ROW)],
    ["P is in order: its rows are generated", { of: "list-segment", pick: "widest",
      id: "rows" }],
    ["The painted face, dashed, overwrites on this row all that the other shows",
      { name: "X merge", outcome: "covered", after: "rows", pick: "widest",
        or: { name: "X merge", outcome: "covered" } }],
    ["The rows are shown", { of: "span-written", real: true, pick: "largest" }],
  ],
  find: ["Which of the six tests decides most often?", (run) =>
    mostOutcomes(run, "list-test", /^test/)],
};
