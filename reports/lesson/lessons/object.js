// SPDX-License-Identifier: GPL-3.0-or-later
// The four algorithms in object space, which draw lines. all.js says what a lesson is.
import { numbersOf } from "../data/numbers.js";
import { isPart } from "../data/volumes.js";
import { countOf, perEach, share, times, withOutcome } from "../telling/figures.js";

const VOLUME = "Solid: the edge. Dashed: the volume. How much of the edge does it hide?";

// A run of Roberts is long. To tell its idea early, rules look at the first so many
// events of a kind.
const EARLY = 12;

export const roberts = {
  idea: "Each edge against each volume",
  text: ["The scene is made of convex volumes. Each edge is compared with each " +
    "volume: which part of the edge does the volume hide? It may hide all of it, " +
    "nothing, one end, or a part between two pieces that stay. Each piece that stays " +
    "is compared with the volumes that follow. What no volume hides is visible. The " +
    "drawing gets the hidden parts, too, as hidden ones.",
  "A volume is convex: it lies behind the plane of each of its faces. Where a solid is " +
    "concave, as in the corner of an L, it lies on both sides of the plane of some face. " +
    "It is cut along this plane, and each part again, until all parts are convex: they " +
    "are its volumes. That is done before the first step, and for all views. The cuts " +
    "are no faces and have no edges, so that none is drawn.",
  "A point of the edge is hidden if the line of sight to it passes through the volume. " +
    "At first all of the edge may be hidden. Each front plane of the volume takes away " +
    "what lies before it, and each edge of its contour what lies beside it, until all " +
    "have been asked or nothing is left: a linear programme, as the survey says. Its two " +
    "unknowns are a place along the edge and a place along the line of sight.",
  "An edge is left out at once if all its faces look away from the eye, or if it lies " +
    "outside of the picture.",
  "Boxes come before volumes: if the box of an edge’s image and that of a volume are apart, or " +
    "the edge is nearer, the volume cannot hide it. Whole bodies are left out so, first of " +
    "all from the edges of another body. Even so that takes as many box tests as " +
    "there are pairs of bodies."],
  source: "The survey, chapter III, object-space algorithms; Roberts 1963",
  moments: [
    ["The volume hides the middle, thin and dotted: two pieces are left",
      { of: "edge-volume", outcome: "two pieces left", pick: "largest", among: EARLY,
        id: "two" },
      VOLUME],
    ["The volume hides nothing of the fragment",
      { of: "edge-volume", outcome: "untouched", pick: "largest", among: EARLY,
        id: "none" },
      VOLUME],
    ["The edge starts as one fragment: none of it is known to be hidden",
      { name: "fragments", before: "none", or: { name: "fragments", before: "two" } }],
    ["Its boxes and those of a body are apart: the body is left out",
      { of: "minimax", outcome: "body out of the way", before: "none", pick: "apart",
        or: { of: "minimax", outcome: "body out of the way", with: ["two", "a"],
          pick: "apart" } }, "Solid: the edge. Dashed: the body. Can it hide the edge?",
      { "body out of the way": "no, by its box", "body in the way": "perhaps" }],
    ["The boxes overlap: the body is in the way, perhaps",
      { of: "minimax", outcome: "body in the way", before: "none",
        or: { of: "minimax", outcome: "body in the way", before: "two" } }],
    ["A front plane of the volume: of the edge, some lies behind it",
      { name: "conditions", like: /may be hidden/, before: "two" }],
    ["One of the two pieces waits as a fragment of its own",
      { name: "two pieces left", after: "two" }],
    ["What all volumes left is drawn", { of: "interval-drawn", with: ["two", "a"],
      where: (run, e) => e.part?.[1] === 0 }],
    ["All of the fragment is beside a contour edge of this face: the volume hides none of it",
      { name: "conditions", outcome: "contour: no part hidden", before: "none" }],
    ["The volume hides the whole fragment: nothing visible of it is left",
      { of: "edge-volume", outcome: "hidden whole", pick: "largest", among: EARLY },
      VOLUME],
    ["The volume hides one end: one piece is left",
      { of: "edge-volume", outcome: "one piece left", pick: "largest", among: EARLY },
      VOLUME],
    ["This volume is a part of a concave solid, which was divided into convex ones",
      { of: "edge-volume", where: (run, { b }) => isPart(run, b.ids[0]), pick: "largest" }],
    ["What is left goes on to the next volume", { of: "one-left", pick: "largest",
      among: EARLY }],
    ["The edge lies in the front of this volume, which cannot hide it",
      { name: "own volumes", pick: "largest", among: EARLY }],
    ["A face that looks away from the eye does not count for its edge",
      { of: "back-edge-cull", outcome: "a back, or edge on", pick: "largest",
        among: EARLY }],
    ["A face that looks at the eye: its edge is kept",
      { of: "back-edge-cull", outcome: "may be seen", pick: "largest", among: EARLY }],
    ["Outside of the picture: the edge is left out",
      { name: "clipping cull", outcome: "outside" }],
  ],
  find: ["How many box tests are there for each edge/volume test?", (run) =>
    perEach(run, "minimax", "edge-volume")],
};

// The plane of the face is farther than the vertex.
const isBeyond = (run, e) => {
  const found = numbersOf(run, e);
  return Boolean(found) && found.a > found.b * 1.01;
};

// kept: what is kept of an edge, with what is said of it.
const crossings = (other, kept) => [
  ["A face that looks away from the eye does not count for its edge",
    { name: "edge cull", outcome: "a back, or edge on", pick: "largest" }],
  [`A face hides the vertex: ${kept.begins}`,
    { of: "initial-visibility", outcome: "hides", pick: "largest", id: "hides" },
    "Does the dashed face hide the vertex?"],
  ["A search begins: nothing is known of this vertex", { of: "search",
    before: "hides" }],
  ["A face is farther than the vertex, or beside it: it does not hide it",
    { of: "initial-visibility", outcome: "does not hide", with: ["hides", "a"],
      where: isBeyond, pick: "largest" }, "Does the dashed face hide the vertex?"],
  ...other,
  [`The crossing is noted: the ${kept.what} changes here`, { name: "crossings",
    after: "behind" }],
  ["The crossings are put in order along an edge", { name: "sort along edge",
    after: "behind" }],
  ["The visible part of the edge is drawn", { of: "interval-drawn",
    with: ["behind", "a"], pick: "largest", where: (run, e) => e.part?.[1] === 0 }],
  [`The hidden part: its ${kept.what} is not ${kept.none}`, { of: "interval-drawn",
    with: ["behind", "a"], pick: "largest", where: (run, e) => e.part?.[1] > 0 }],
  [`The ${kept.what} at this end goes to the neighbors: no new search`,
    { of: "promoted", pick: "largest" }],
  ["At a corner, a face of the corner itself may hide the edge",
    { name: "correction", outcome: "hides", pick: "largest" }],
  ["Hidden everywhere: no crossing has to be sorted",
    { name: "sorts to save", pick: "largest" }],
];

const NUMBER = { what: "number", none: "zero",
  begins: "the number begins at one or more" };
const SET = { what: "set", none: "empty", begins: "it begins the set" };

export const QUESTION = "Solid: this edge. Dashed: the other. At the crossing, which is nearer?";
export const WORDS = { farther: "the other is farther", nearer: "the other is nearer" };

export const appel = {
  idea: "Count how many faces hide the edge",
  text: ["Follow an edge and keep one number: how many faces hide it here. It is visible " +
    "where the number is zero. The number changes only where the edge passes behind " +
    "a contour edge, one between a face that looks at the eye and one that does not.",
  "At the start of an edge the number comes from its neighbor, which ends at the same " +
    "vertex. So only one vertex of each connected body is compared with all faces."],
  source: "The survey, chapter III, edge intersection, figures 14 to 16; Appel 1967",
  moments: crossings([
    ["The images of two edges do not cross",
      { of: "edge-intersection", outcome: "do not cross", pick: "largest" }],
    ["They cross, but the contour edge is farther: nothing changes",
      { of: "edge-intersection", outcome: "farther", pick: "largest" }, QUESTION,
      WORDS],
    ["The edge passes behind a contour edge that is nearer",
      { of: "edge-intersection", outcome: "nearer", pick: "largest", id: "behind" },
      QUESTION,
      WORDS]], NUMBER),
  find: ["How many pairs of edges are looked at for each crossing that counts?",
    (run) => perEach(run, "edge-intersection", "crossings")],
};

export const loutrel = {
  idea: "The same, with crossings found on the screen",
  text: ["Loutrel keeps Appel’s number. A crossing is found in two steps: do the images " +
    "of the two edges cross, and is the contour edge nearer there? The boxes of the " +
    "images are compared first, and most pairs end there."],
  source: "The survey, chapter III, edge intersection; Loutrel 1967",
  moments: crossings([
    ["The boxes of two edges are apart: done",
      { of: "edge-intersection", outcome: "boxes apart", pick: "apart" }],
    ["The boxes of two edges overlap: a longer question follows",
      { of: "boxes-overlap", pick: "largest", where: (run, { a, b }) =>
        a.ids.slice(0, 2).every((v) => !b.ids.slice(0, 2).includes(v)) }],
    ["Their images cross, but the other one is farther",
      { of: "plane-intersection", outcome: "farther", pick: "largest" }, QUESTION,
      WORDS],
    ["Their images cross, and the other one is nearer",
      { of: "plane-intersection", outcome: "nearer", pick: "largest", id: "behind" },
      QUESTION,
      WORDS]], NUMBER),
  find: ["What share of all pairs is settled by their boxes?", (run) => {
    const all = countOf(run, "edge-intersection");
    const apart = withOutcome(run, "edge-intersection", "boxes apart");
    return `${times(apart)} of ${times(all)} pairs: ${share(apart, all)}.`;
  }],
};

export const galimberti = {
  idea: "Keep the set of the faces that hide",
  text: ["In place of a number, the set of faces that hide the edge is kept. So each " +
    "edge is compared with all edges, and each crossing says which face is entered " +
    "or left.",
  "The drawing is the same as Appel’s. What is gained is to know who hides."],
  source: "The survey, chapter III, edge intersection; Galimberti and Montanari 1969",
  moments: crossings([
    ["An edge crosses, but is farther",
      { of: "edge-intersection", outcome: "farther", pick: "largest" }, QUESTION,
      WORDS],
    ["An edge crosses that is nearer: a face is entered or left",
      { of: "edge-intersection", outcome: "nearer", pick: "largest", id: "behind" },
      QUESTION,
      WORDS],
    ["The set of hiding faces changes", { of: "nature-change", pick: "largest" }]], SET),
  find: ["How many of the pairs would Appel have looked at?", (run) => {
    const [all, contour] = ["edge-intersection", "contour-pair"].map((name) =>
      countOf(run, name));
    return `${times(contour)} of ${times(all)}: those with a contour edge, ${share(
      contour, all)}.`;
  }],
};
