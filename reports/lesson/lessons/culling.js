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
  "A node that is wholly inside of the view needs no test of what is below it. Only " +
    "nodes that a side of the view cuts are opened, and their children are looked at.",
  "Nothing is asked about what hides what. A face that is in view is drawn, even if " +
    "others hide it. The hierarchical z-buffer asks that, too."],
  source: `J. H. Clark, Communications of the ACM 19, 1976; ${THESIS}`,
  needs: [{ name: "nodes out", instead: "rooms:4",
    why: "All of this scene is in view, so that no group of faces is left out." }],
  moments: [
    ["The first node holds all faces", { name: "nodes visited", nth: 1 }],
    ["A side of the view is compared with the node: it may cut it",
      { name: "inequalities", outcome: "leaves it open", nth: 1 }],
    ["So its own faces are met, and then its children", { name: "faces met",
      nth: 1, id: "met" }],
    ["A face that is met is drawn as in a z-buffer", { name: "writes", after: "met" }],
    ["At this sample it is farther than what was drawn: it stays hidden",
      { name: "depth tests", outcome: "farther", real: true, pick: "largest" },
      "Is the solid one nearer or farther than the dashed one here?"],
    ["At this sample it is written over what was drawn", { name: "writes", covers: true }],
    ["This node lies beyond a side of the view", { name: "inequalities",
      outcome: "outside", pick: "largest" }],
    ["It is left out with all that is in it", { name: "nodes out", pick: "largest" }],
    ["A node is wholly inside of the view: nothing below it is tested again",
      { name: "nodes inside", pick: "largest" }],
    ["Half of the nodes are done", { name: "nodes visited", at: 0.5 }],
  ],
  find: ["How many of the nodes that were reached are outside of the view?", (run) => {
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
    ["A cube begins behind the hit: it is not entered", { name: "cubes behind",
      at: 0.5, id: "behind" }],
    ["A ray goes through a sample", { name: "rays", before: "behind",
      with: ["behind", "place"], id: "ray", or: { name: "rays", at: 0.5, id: "ray" } }],
    ["The ray meets a cube, and looks into it", { name: "cubes visited", outcome: "met",
      after: "ray", with: ["ray", "place"] }, "Does the ray through the sample meet the cube?"],
    ["The ray misses this cube: no face in it is tested", { name: "cubes visited",
      outcome: "missed", after: "ray", with: ["ray", "place"], pick: "over",
      or: { name: "cubes visited", outcome: "missed", pick: "over" } },
    "Does the ray through the sample meet the cube?"],
    ["A face in a cube is missed", { name: "ray tests", outcome: "missed", after: "ray",
      with: ["ray", "place"], pick: "over", or: { name: "ray tests", outcome: "missed",
        pick: "over" } }, "Does the ray through the sample hit the face?"],
    ["A face in a cube is hit", { name: "ray tests", outcome: "hit", after: "ray",
      with: ["ray", "place"] }, "Does the ray through the sample hit the face?"],
    ["Another ray: a second hit is nearer, and takes the place of the first",
      { name: "depth tests", outcome: "nearer", at: 0.6 },
      "Is the solid one nearer or farther than the dashed one here?"],
    ["The nearest hit is shown", { name: "samples shown", after: "behind",
      with: ["behind", "place"], or: { name: "samples shown", nth: 2 } }],
    ["Another ray begins at the root again", { name: "rays", at: 0.75 }],
  ],
  find: ["How many faces is a ray tested against, of all in the scene?", (run) =>
    perEach(run, "ray tests", "rays")],
};

// Whether the window is not the whole picture.
const isNarrow = (run, { window: w }) => Boolean(w) &&
  (w.width < run.width || w.height < run.height);

// Whether something of the face is in the picture: its box meets it.
function isInView({ header, width, height }, { a }) {
  const points = header.faces[a.ids[0]]?.[4] ?? [];
  return points.some(([x]) => x > 0) && points.some(([x]) => x < width) &&
    points.some(([, y]) => y > 0) && points.some(([, y]) => y < height);
}

export const pvs = {
  idea: "Look from room to room, through the doors",
  text: ["A building has rooms, which are the cells, and openings between them, which are the " +
    "portals. " +
    "The eye is in a cell. It sees the faces of that cell. It sees those of another cell only " +
    "through a portal.",
  "So a search goes from cell to cell. Each cell has a cull box: the rectangle of the picture " +
    "that is seen " +
    "through all portals passed so far. For the cell of the eye it is the whole picture. At " +
    "a portal it becomes smaller: what is left is where the cull box and the rectangle around " +
    "the portal overlap. Where nothing is left, the search ends.",
  "A cell may be reached by several ways. Then its cull box is the rectangle around all of " +
    "them. It is looked at again only if the box has become larger.",
  "When all cells are found, each of their faces is compared with its cell’s cull box. A face " +
    "that is outside is left out. The others are the potentially visible set. It holds all " +
    "that is visible, and some more. A z-buffer draws it."],
  source: `D. Luebke and C. Georges, Portals and mirrors, 1995; ${THESIS}`,
  needs: [{ name: "portals", instead: "rooms:4",
    why: "This scene has no rooms with openings between them." }],
  moments: [
    ["The eye is in this cell", { name: "start cells", nth: 1, id: "start" }],
    ["Its cull box is the whole picture", { name: "cells visited", nth: 1 }],
    ["A portal of it is seen. The window around it is the cull box of the cell beyond",
      { name: "portals", outcome: "seen", with: ["start", "a"], where: isNarrow,
        pick: "widest", id: "seen" }],
    ["This portal is outside of its cell’s cull box, the thin frame: the search ends here",
      { name: "portals", outcome: "outside", pick: "largest" }],
    ["This way leads to a cell that is known, and shows no more of it",
      { name: "portals", outcome: "seen before", pick: "largest" }],
    ["Another cell is looked at, through a part of the picture only",
      { name: "cells visited", where: isNarrow, after: "seen" }],
    ["All cells are found. Now a face of one of them is met", { name: "faces met",
      where: isInView }],
    ["A face is outside of its cell’s cull box: it is left out", { name: "faces outside",
      pick: "over" }],
    ["A face belongs to the potentially visible set, and is drawn", { name: "faces drawn",
      pick: "largest" }],
    ["The set holds more than is visible: the z-buffer finds that this one is farther",
      { name: "depth tests", outcome: "farther", real: true, pick: "largest" },
      "Is the solid one nearer or farther than the dashed one here?"],
    ["Half of the set is drawn", { name: "faces drawn", at: 0.5 }],
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
  "A second tree divides the picture: its visibility map. A node of it has a line, with a " +
    "part of the picture on either side. What is not divided is a region. A region shows " +
    "a face, or is still vacant.",
  "Each piece goes down the map. Where it comes to a region that shows a face, it is " +
    "hidden. Where it comes to a vacant region, it is seen: its sides become lines of " +
    "the map, and the region between them shows it. The map is " +
    "turned into samples when all pieces are done.",
  "A box around a whole subtree of the scene goes down the map as well. If one region that " +
    "shows a face holds it, nothing in the subtree is seen: it is culled."],
  source: `B. Naylor, Graphics Interface 1992; ${THESIS}`,
  moments: [
    ["The walk through the scene’s tree begins at its root", { name: "nodes visited", nth: 1 }],
    ["A subtree is outside of the view: it is left out", { name: "nodes out", nth: 1 }],
    ["A side of the piece divides a region that is vacant", { name: "divisions",
      pick: "largest", id: "cut" }],
    ["What is inside of all its sides shows the piece", { name: "regions filled",
      after: "cut", with: ["cut", "a"], or: { name: "regions filled", pick: "largest" } }],
    ["A later piece goes down the map: on which side of this line is it?",
      { name: "lines compared", outcome: "both", after: "cut", pick: "largest",
        among: 200 }],
    ["A part of a piece comes to a region that shows a face: it is hidden",
      { name: "parts hidden", pick: "largest" }],
    ["The box around a subtree goes down the map", { name: "boxes compared",
      pick: "largest" }],
    ["One region hides a subtree: all of it is left out", { name: "nodes culled",
      pick: "largest" }],
    ["Half of the pieces are in the map", { name: "pieces", at: 0.5 }],
    ["All pieces are in the map. Now it is turned into samples",
      { name: "regions shown", nth: 1 }],
    ["All samples here are of one region: its face is shown", { name: "samples", at: 0.5 }],
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
  "Cubes that are not hidden are tiled: their sides that face the eye go down the quadtree, " +
    "and cover " +
    "vacant cells."],
  source: `D. Meagher 1982; ${THESIS}`,
  moments: [
    ["The first node of the octree holds all", { name: "nodes visited", nth: 1 }],
    ["The outline of a node is compared with a cell of the quadtree", { name: "silhouette tests",
      nth: 1 }],
    ["A cube is not hidden: it is drawn", { name: "cubes drawn", nth: 1, id: "cube" }],
    ["A side of it goes down the quadtree", { name: "sides tiled", after: "cube",
      id: "side" }],
    ["An edge of the side crosses this cell: it is divided", { name: "subdivisions",
      after: "side" }],
    ["This cell is inside of the side, and vacant", { name: "cells", outcome: "inside",
      pick: "widest", id: "inside" }],
    ["So its samples are written, once and for all", { name: "samples", after: "inside" }],
    ["A cell that is covered: nothing there is asked again", { name: "cells",
      outcome: "covered", after: "inside", pick: "widest" }],
    ["So the node is hidden with all that is in it", { name: "nodes hidden",
      pick: "largest", id: "hidden" }],
    ["Where the outline of a node is, this cell is covered", { name: "silhouette tests",
      outcome: "covered", before: "hidden" }],
    ["Half of the samples are written", { name: "samples", at: 0.5 }],
  ],
  find: ["How many nodes of the octree were found to be hidden?", (run) => {
    const hidden = countOf(run, "nodes hidden"), all = countOf(run, "nodes visited");
    return `${times(hidden)} of the ${times(all)} that were reached: ${share(hidden, all)}.`;
  }],
};
