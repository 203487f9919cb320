// SPDX-License-Identifier: GPL-3.0-or-later
// The orders of sorting. all.js says what a lesson is.
import { perEach } from "../telling/figures.js";

const NEARER = "Is the solid one nearer or farther than the dashed one, here?";

export const sortStages = {
  idea: "Sorts in X, Y and Z, in any order",
  text: ["To find what is visible is to sort: in Y and X, which faces are at a place, " +
    "and in Z, which of these is nearest. The survey tells algorithms apart by the order " +
    "of their sorts. Here the order can be chosen, so that orders are compared with all " +
    "else the same.",
  "The first sort of X and Y divides the picture into lines, and each face into runs of " +
    "samples. The second one divides a line into spans, in which the same runs are " +
    "active. A sort in Z puts what there is in the order of its nearest depths. At the " +
    "end the nearest is searched. If Z was sorted before, the search ends at the first " +
    "item that is farther than the nearest face so far."],
  source: "The survey, chapter IV, other combinations of sorting",
  moments: [
    ["Each face goes into the bucket of its first row", { name: "Y buckets" }],
    ["Each face goes into the bucket of its first column", { name: "X buckets" }],
    ["Each face goes into a bucket by its nearest depth", { name: "Z buckets" }],
    ["Two neighbors are compared in Z: out of order", { name: "Z sort",
      outcome: "out of order" }],
    ["A run: the samples of a line that a face covers", { name: "runs",
      pick: "largest", id: "run" }],
    ["A surrounder: the face covers all of the window", { name: "window tests",
      outcome: "surrounder", pick: "largest" }],
    ["An intersecter covers a part of the window, which is divided", { name: "subdivisions",
      pick: "largest" }],
    ["In a span, two are compared: nearer", { name: "depths in spans",
      outcome: "nearer", pick: "largest", real: true }, NEARER],
    ["In a span, two are compared: farther", { name: "depths in spans",
      outcome: "farther", pick: "largest", real: true }, NEARER],
    ["At a sample, two are compared", { name: "depths at samples", real: true },
      NEARER],
    ["One is nearest at one end of the span, another at the other: they penetrate",
      { name: "halved spans", pick: "largest" }],
    ["The nearest is shown in all of the span", { name: "shown", pick: "largest" }],
    ["Half of the picture", { name: "shown", at: 0.5 }],
  ],
  find: ["How many faces are searched for depth in a span?",
    (run) => perEach(run, "depths in spans", "shown")],
};
