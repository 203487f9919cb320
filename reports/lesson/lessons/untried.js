// SPDX-License-Identifier: GPL-3.0-or-later
// The order of sorting that the survey found and that nobody had tried. all.js says what
// a lesson is.
import { countOf, perEach, share, times } from "../telling/figures.js";

const PLACE = "Solid: the face that enters. Dashed: one that is active. Do their bounds " +
  "overlap?";
const NEARER = "Is the solid one nearer or farther than the dashed one?";

const isOfTwo = (run, e) => e.a.ids[0] !== e.b.ids[0];

export const yzx = {
  idea: "Sort in Y, then in Z, then in X",
  text: ["A face is active on the lines from its first to its last. The active faces " +
    "stand in one list of priority, the nearest first. When a face begins, it is put " +
    "into its place in this list by tests like Newell’s: against each active face, do " +
    "their bounds overlap in X and in Y, and do their extents in depth overlap? Only if " +
    "all do are corners of one put to the plane of the other. If no order " +
    "is right, a face is divided.",
  "With that, no depth has to be compared any more. On each line the active faces are numbered in the order of " +
    "the list. Along the line, the faces that cover a place are kept in the " +
    "order of these numbers, and the first one is shown. To find who is nearer takes a " +
    "comparison of two numbers, at whatever place.",
  "Between lines little changes: a face goes to the place among the others that it had on " +
    "the line before. Only where edges have crossed since, its number is compared with " +
    "those of its neighbors.",
  "The survey proposes this on one page, as an order that had not been tried. How the " +
    "place in the list is found is this testbed’s own."],
  source: "The survey, chapter IV, an untried sorting order",
  needs: [{ of: "face-division", instead: "cyclic-overlap",
    why: "No faces of this scene overlap in a circle or penetrate, so that none is divided." }],
  moments: [
    ["Each face goes into the bucket of the line where it begins",
      { name: "Y order", pick: "largest" }],
    ["A corner of one face is before the plane of the other",
      { name: "Z sort", outcome: "in front", pick: "largest", id: "plane" },
      "Is the corner in front of the dashed face’s plane, or behind it?"],
    ["A face enters. It and an active one are apart in X: no more is asked",
      { name: "minimax tests", outcome: "test 2: apart in X", pick: "apart",
        where: isOfTwo }, PLACE],
    ["They overlap in X: the next question is asked", { name: "minimax tests",
      outcome: "test 2: overlap in X", before: "plane", where: isOfTwo }, PLACE],
    ["They overlap in Y, too", { name: "minimax tests", outcome: "test 3: overlap in Y",
      before: "plane", where: isOfTwo }, PLACE],
    ["Their extents in depth do not overlap: one is nearer as a whole",
      { name: "Z minimax", outcome: "nearer", pick: "largest", where: isOfTwo,
        or: { name: "Z minimax", outcome: "farther", pick: "largest" } },
      "Solid: the face that enters. Dashed: the other. Which is nearer?"],
    ["Their extents in depth overlap: corners are put to planes", { name: "Z minimax",
      outcome: "overlap", before: "plane", where: isOfTwo }],
    ["A corner is behind the plane. If all are on one side, the two are in order", { name: "Z sort", outcome: "behind",
      pick: "largest" }, "Is the corner in front of the dashed face’s plane, or behind it?"],
    ["Both stand in the list in the wrong order: one is moved behind the other",
      { name: "interchanges", pick: "largest" }],
    ["No order is right: the face is divided by the plane of the other",
      { name: "divisions", pick: "largest" }],
    ["On a line, the face begins: it joins those that are there", { name: "segments",
      after: "plane", pick: "widest", where: (run, e) => e.a.ids[0] >= 0, id: "enter" }],
    ["It stands where it stood on the line before: nothing is compared",
      { name: "places kept", after: "plane", pick: "largest" }],
    ["Two are compared by their numbers in the list: no depth is asked", { name: "priority tests",
      after: "plane", pick: "largest", real: true }, NEARER],
    ["The first of them is shown", { name: "spans", real: true, after: "enter",
      pick: "widest", or: { name: "spans", real: true, pick: "widest" } }],
    ["Half of the lines are done", { name: "spans", at: 0.5 }],
  ],
  find: ["How many faces keep their places along the lines, and how often is a number " +
    "compared?", (run) => {
    const all = countOf(run, "segments"), kept = countOf(run, "places kept");
    return `${times(kept)} of ${times(all)} segments keep their places: ${share(kept, all)}. ${
      perEach(run, "priority tests", "segments")}`;
  }],
};
