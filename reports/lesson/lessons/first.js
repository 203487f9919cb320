// SPDX-License-Identifier: GPL-3.0-or-later
// The first four lessons: painter, z-buffer, ray casting, BSP tree. all.js says what
// a lesson is.
import { numbersOf } from "../data/numbers.js";
import { countOf, share, times } from "../telling/figures.js";
import { paintsWrong, wrongSamples } from "../telling/wrong.js";

// Whether the two numbers that are compared differ.
const tells = (run, e) => {
  const found = numbersOf(run, e);
  return Boolean(found) && Math.abs(found.a - found.b) > 0.01;
};

const isTie = (run, e) => {
  const found = numbersOf(run, e);
  return Boolean(found) && found.a === found.b;
};

export const painter = {
  idea: "Paint from back to front",
  text: ["Sort the faces by their farthest corners. Paint them in that order, the " +
    "farthest first. A nearer face covers what was painted before.",
  "The order by farthest corners is not always right: a long face may reach from " +
    "far away to before another one. Then a sample is wrong, and this page marks it. " +
    "The lessons of Newell and of the BSP tree show two ways to mend that."],
  source: "The survey, chapter III, list priority",
  moments: [
    ["Two faces are compared by their farthest corners",
      { of: "face-sort", pick: "largest", where: tells },
      "Which of the two is painted first, by its farthest corner?"],
    ["A tie: the farthest corners of both are equally deep, and nothing tells the order",
      { of: "face-sort", pick: "largest", where: isTie }],
    ["The farthest face is painted", { name: "samples" }],
    ["A nearer face is painted over it", { name: "samples", covers: true }],
    ["Here the order is wrong: this face is painted over a nearer one",
      { name: "samples", where: paintsWrong }],
    ["Half of the painting", { name: "samples", at: 0.5 }],
  ],
  find: ["How many samples were painted in vain, and how many are wrong?",
    (run) => {
      const painted = run.accepts.reduce((sum, k) => sum + run.trace.width[k] *
        run.trace.height[k], 0);
      const kept = run.painting.at(run.n).filter((f) => f >= 0).length;
      return `${times(painted)} samples were painted and ${times(kept)} of them are ` +
        `seen: ${share(painted - kept, painted)} was in vain. ${times(
        wrongSamples(run).size)} samples are wrong.`;
    }],
};

export const zbuffer = {
  idea: "Remember a depth for each sample",
  text: ["For each sample keep the face that is nearest so far, and its depth. Take " +
    "the faces in any order. Where a face covers a sample and is nearer than what is " +
    "kept there, it is kept instead.",
  "Nothing is sorted. The price is a memory for all samples, and a comparison for " +
    "each sample of each face."],
  source: "The survey, chapter II, brute force; Catmull 1974",
  moments: [
    ["The first face meets an empty memory", { name: "writes" }],
    ["A face is nearer than what is kept: it is written",
      { name: "depth tests", outcome: "nearer", real: true },
      "Solid: the new face. Dashed: the face that is kept here. Which is nearer?"],
    ["A face is farther than what is kept: nothing changes",
      { name: "depth tests", outcome: "farther", real: true },
      "Solid: the new face. Dashed: the face that is kept here. Which is nearer?"],
    ["What was kept is thrown away", { name: "overwrites" }],
    ["Half of the comparisons are made", { name: "depth tests", at: 0.5 },
      "Solid: the new face. Dashed: the face that is kept here. Which is nearer?"],
    ["A late face may still win", { name: "depth tests", outcome: "nearer", real: true,
      nth: -1 }, "Solid: the new face. Dashed: the face that is kept. Which is nearer?"],
  ],
  find: ["How many depths are compared for each sample of the picture?", (run) => {
    const tests = countOf(run, "depth tests");
    return `${times(tests)} comparisons for ${times(run.width * run.height)} samples: ` +
      `${(tests / run.width / run.height).toFixed(2)} for each.`;
  }],
};

export const raycast = {
  idea: "Ask each sample for its nearest face",
  text: ["Take the samples one by one. For each, look at all faces: does the face " +
    "cover the sample, and is it nearer than the nearest so far? Show that one.",
  "No memory is needed but for one sample. Every face is asked about for every " +
    "sample; a box around its image spares the longer question."],
  source: "The survey, chapter II, brute force; Appel 1968",
  moments: [
    ["A second face covers the sample, and is nearer",
      { name: "depth tests", outcome: "nearer", real: true, pick: "largest",
        id: "second" }, "Solid: this face. Dashed: the nearest so far. Which is nearer?"],
    ["The sample is outside of a face’s box: done with that face",
      { name: "minimax tests", outcome: "outside", with: ["second", "place"],
        pick: "largest" }, "Is the sample inside the face’s box?"],
    ["It is inside the box: a longer question follows",
      { name: "minimax tests", outcome: "inside", with: ["second", "place"] },
      "Is the sample inside the face’s box?"],
    ["A first face covers the sample: the nearest so far",
      { name: "surround tests", outcome: "surrounds", with: ["second", "place"] },
      "Does the face cover the sample?"],
    ["The nearest of all is shown", { name: "samples shown", with: ["second", "place"] }],
    ["Inside the box, but the face does not cover the sample",
      { name: "surround tests", outcome: "does not surround", after: "second",
        pick: "largest", or: { name: "surround tests", outcome: "does not surround" } },
      "Does the face cover the sample?"],
    ["A second face covers the sample, but is farther",
      { name: "depth tests", outcome: "farther", real: true, after: "second",
        pick: "largest", or: { name: "depth tests", outcome: "farther", real: true } },
      "Solid: this face. Dashed: the nearest so far. Which is nearer?"],
    ["Half of the samples are done", { name: "samples shown", at: 0.5 }],
  ],
  find: ["What share of the questions do the boxes answer?", (run) => {
    const all = countOf(run, "minimax tests"), rest = countOf(run, "surround tests");
    return `${times(all)} boxes were looked at, and ${times(rest)} faces after that: ` +
      `${share(all - rest, all)} was answered by the boxes.`;
  }],
};

export const bspPainter = {
  idea: "A tree of planes, and any eye has its order",
  text: ["Once, before any picture, a tree is made: each node is the plane of a face " +
    "and divides all other faces into those before it and those behind it. A face " +
    "on both sides is cut in two.",
  "For an eye, walk the tree: first the side of the plane where the eye is not, then " +
    "the face in the plane, then the eye’s side. That is an order from back to front, " +
    "and the painter’s method is right in it."],
  source: "Fuchs, Kedem and Naylor 1980",
  moments: [
    ["The walk begins with the farthest piece", { of: "piece" }],
    ["It is painted", { name: "samples" }],
    ["The next piece of the walk", { of: "piece", nth: 2 }],
    ["A large face in its plane: all that is behind it is painted already",
      { of: "piece", pick: "largest" }],
    ["A piece of a face that was cut in two", { of: "piece", where: (run, e) =>
      run.outline(e.k, e.a.ids[1], e.a.ids[0]) !== null && e.a.ids[1] > 0 }],
    ["A nearer piece covers what was painted", { name: "overwrites" }],
    ["Half of the walk", { of: "piece", at: 0.5 }],
    ["The last piece is the nearest one", { of: "piece", nth: -1 }],
  ],
  find: ["How many pieces did the faces become, and how many are painted over?",
    (run) => {
      const pieces = run.trace.structure.pieces?.length ?? 0;
      return `${times(run.header.faces.length)} faces are ${times(pieces)} pieces of ` +
        `the tree. ${times(countOf(run, "overwrites"))} of ${times(countOf(run,
          "samples"))} painted samples covered another face.`;
    }],
};
