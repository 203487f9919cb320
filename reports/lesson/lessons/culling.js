// SPDX-License-Identifier: GPL-3.0-or-later
// Algorithms that leave groups of faces out: by trees, by boxes, by cells and portals.
// all.js says what a lesson is.
import { countOf, perEach, share, times } from "../telling/figures.js";

const THESIS = "N. Greene, Hierarchical Rendering of Complex Environments, thesis 1995, 2.1";

export const clark = {
  idea: "Leave out whole groups that are not in view",
  text: ["A z-buffer looks at every face of a scene, also at those beside the picture " +
    "and behind the eye. Clark puts faces into boxes, and these into larger boxes. Here " +
    "they are the cubes of an octree: its nodes. A node that is outside of the view is left " +
    "out with all that is in it. One test takes the place of many.",
  "A node that is inside of the view as a whole needs no test of what is below it. Only " +
    "nodes that a side of the view cuts are opened, and their children are looked at.",
  "Nothing is asked about what hides what. A face that is in view is drawn, also if " +
    "others hide it. The hierarchical z-buffer asks that, too."],
  source: `J. H. Clark, Communications of the ACM 19, 1976; ${THESIS}`,
  needs: [{ name: "nodes out", instead: "rooms:4",
    why: "All of this scene is in view, so that no group of faces is left out." }],
  moments: [
    ["A node of the octree is come to", { name: "nodes visited", pick: "largest" }],
    ["A node is outside of the view: all that is in it is left out",
      { name: "nodes out", pick: "largest" }],
    ["A node is inside as a whole: nothing below it is tested again",
      { name: "nodes inside", pick: "largest" }],
    ["A face is met in a node that is in view", { name: "faces met", pick: "largest" }],
    ["A face is written where it is nearer than what was recorded", { name: "writes",
      pick: "largest" }],
  ],
  find: ["How many of the nodes that were come to are outside of the view?", (run) => {
    const out = countOf(run, "nodes out"), all = countOf(run, "nodes visited");
    return `${times(out)} of ${times(all)}: ${share(out, all)}.`;
  }],
};

export const octreeRaycast = {
  idea: "Ask a ray only about faces that are near it",
  text: ["From the eye a ray goes through each sample, and the nearest face on it is " +
    "shown. Plain ray casting tests each ray against all faces. Here the faces are in the " +
    "cubes of an octree. A ray looks into a cube only if it meets it. A cube that it misses " +
    "is left out with all faces in it.",
  "The cubes on a ray are entered from the eye on. Once the ray has hit a face, a cube " +
    "that begins behind the hit cannot hold a nearer face. It is left out, too.",
  "Each ray begins at the root again. What two neighboring rays have in common is not used."],
  source: `S. Rubin and T. Whitted 1980; A. Glassner 1984; ${THESIS}`,
  moments: [
    ["A ray goes through a sample", { name: "rays", nth: 1 }],
    ["The ray misses a cube: no face in it is tested", { name: "cubes visited",
      outcome: "missed", pick: "largest" }, "Does the ray through the sample meet the cube?"],
    ["The ray meets a cube, and looks into it", { name: "cubes visited", outcome: "met",
      pick: "largest" }, "Does the ray through the sample meet the cube?"],
    ["A face in the cube is hit", { name: "ray tests", outcome: "hit", pick: "largest" },
      "Does the ray through the sample hit the face?"],
    ["A face in the cube is missed", { name: "ray tests", outcome: "missed",
      pick: "largest" }, "Does the ray through the sample hit the face?"],
    ["Another hit is nearer: it takes the place of the first", { name: "depth tests",
      outcome: "nearer", pick: "largest" }],
    ["A cube begins behind the hit: it is not entered", { name: "cubes behind",
      pick: "largest" }],
    ["The nearest hit is shown", { name: "samples shown", nth: 2 }],
  ],
  find: ["How many faces is a ray tested against, of all in the scene?", (run) =>
    perEach(run, "ray tests", "rays")],
};

export const pvs = {
  idea: "Look from room to room, through the doors",
  text: ["A building has rooms, which are the cells, and openings between them, which are the portals. " +
    "The eye is in a cell. It sees the faces of that cell. It sees those of another cell only " +
    "through a portal.",
  "So the search goes from cell to cell. The cull box is the rectangle of the picture that is seen " +
    "through all portals passed so far. It becomes smaller at each portal. Where nothing is left " +
    "of it, the search ends.",
  "The faces that were met are the potentially visible set. It holds all that is visible, and " +
    "some more. A z-buffer draws it."],
  source: `D. Luebke and C. Georges, Portals and mirrors, 1995; ${THESIS}`,
  needs: [{ name: "portals", instead: "rooms:4",
    why: "This scene has no rooms with openings between them." }],
  moments: [
    ["The eye is in this cell", { name: "start cells", pick: "largest" }],
    ["A cell is looked at, within what is seen of it", { name: "cells visited",
      pick: "largest" }],
    ["A portal is compared with the cull box", { name: "portals", pick: "largest" }],
    ["A face of the cell is met", { name: "faces met", pick: "largest" }],
    ["A face is outside of what is seen: it is left out", { name: "faces outside",
      pick: "largest" }],
    ["A face belongs to the potentially visible set, and is drawn", { name: "faces drawn",
      pick: "largest" }],
    ["What is hidden in the set, the z-buffer finds", { name: "depth tests",
      pick: "largest" }],
  ],
  find: ["How many of the faces that were met had to be drawn?", (run) => {
    const drawn = countOf(run, "faces drawn"), met = countOf(run, "faces met");
    return `${times(drawn)} of ${times(met)}: ${share(drawn, met)}.`;
  }],
};

export const naylor = {
  idea: "A tree of the scene against a tree of the picture",
  text: ["A BSP tree of the scene gives an order from front to back for every eye. So " +
    "each piece that comes later is behind all that came before, where they overlap.",
  "A second tree divides the picture: its visibility map. A node of it has a line, and what is on " +
    "either side. A region of the map shows a face, or is still vacant. Each piece goes down " +
    "this tree. Its parts in vacant regions are seen, and the others are hidden. The piece’s " +
    "sides become lines of the map.",
  "A box around a whole subtree of the scene goes down the map as well. If it falls into " +
    "regions that are taken, nothing in the subtree is seen: it is culled."],
  source: `B. Naylor, Graphics Interface 1992; ${THESIS}`,
  moments: [
    ["A node of the scene’s tree is come to", { name: "nodes visited", pick: "largest" }],
    ["A subtree is outside of the view", { name: "nodes out", pick: "largest" }],
    ["The box around a subtree is compared with the map", { name: "boxes compared", pick: "largest" }],
    ["The map hides a subtree: all of it is left out", { name: "nodes culled",
      pick: "largest" }],
    ["A piece is compared with a line of the map", { name: "lines compared",
      pick: "largest" }],
    ["A part of the piece is behind a face of the map", { name: "parts hidden",
      pick: "largest" }],
    ["A side of the piece divides a region", { name: "divisions", pick: "largest" }],
    ["A vacant region is given to the face", { name: "regions filled", pick: "largest" }],
  ],
  find: ["How many lines is a piece compared with?", (run) =>
    perEach(run, "lines compared", "pieces")],
};

export const meagher = {
  idea: "An octree from front to back, into a quadtree",
  text: ["The scene is a grid of cubes, kept as an octree. From any eye there is an order " +
    "of the eight children of a node in which nearer ones come first. So no depth is compared: " +
    "what is drawn stays.",
  "The picture is a quadtree. A cell of it is covered, or vacant, or divided. A node of the " +
    "octree is compared with it by its outline. If all cells there are covered, the node is " +
    "hidden with all that is in it.",
  "Cubes that are not hidden are tiled: their sides that face the eye go down the quadtree, and cover " +
    "vacant cells."],
  source: `D. Meagher 1982; ${THESIS}`,
  moments: [
    ["A node of the octree is come to", { name: "nodes visited", pick: "largest" }],
    ["A cell of the quadtree is compared with the outline of a node", { name: "silhouette tests",
      pick: "largest" }],
    ["A node lies where all is covered: it is hidden with all that is in it",
      { name: "nodes hidden", pick: "largest" }],
    ["A cube is not hidden: it is drawn", { name: "cubes drawn", pick: "largest" }],
    ["A side of a cube is tiled", { name: "sides tiled", pick: "largest" }],
    ["A cell is divided, as the side’s edge crosses it", { name: "subdivisions",
      pick: "largest" }],
    ["A sample is written, once and for all", { name: "samples", nth: 3 }],
  ],
  find: ["How many nodes of the octree were found to be hidden?", (run) => {
    const hidden = countOf(run, "nodes hidden"), all = countOf(run, "nodes visited");
    return `${times(hidden)} of the ${times(all)} that were come to: ${share(hidden, all)}.`;
  }],
};
