// SPDX-License-Identifier: GPL-3.0-or-later
// Two later algorithms. all.js says what a lesson is.
import { countOf, mostOutcomes, share, times, withOutcome } from
  "../telling/figures.js";

export const hzbuffer = {
  idea: "Ask a whole cube whether it can be seen",
  text: ["The faces are in an octree of cubes. Above the z-buffer stands a pyramid: each " +
    "entry is the farthest depth of the four below it. The lowest level is the z-buffer itself.",
  "From front to back, a cube is compared with the smallest entry whose square holds its image. If " +
    "the cube is farther, all that is in it is hidden: no face of it is looked at. If the " +
    "entry leaves it open, the four entries below it are asked, and so on.",
  "A cube that may be seen is opened. Its own faces are drawn as in a z-buffer, and then its " +
    "eight children are asked in the same way. Each sample that is written changes the " +
    "entries above it. So later cubes meet a pyramid that hides more."],
  source: "Greene, Kass and Miller 1993",
  needs: [{ of: "cube-culled", instead: "color-cube:6",
    why: "No cube of this scene is hidden as a whole." }],
  moments: [
    ["The first cube holds all", { of: "cube-visited" }],
    ["Is it outside of the picture’s pyramid of sight?", { of: "inequality",
      outcome: "leaves it open" }],
    ["A cube is asked about: is it behind the entry that holds its image?",
      { of: "cube-read" }],
    ["The entry is farther than the cube’s nearest point: it leaves it open", { of: "cube-read",
      outcome: "leaves it open", pick: "largest" }],
    ["The cube can be seen: on to its faces", { of: "cube-tested", outcome: "visible",
      pick: "largest" }],
    ["A face of the cube is drawn as in a z-buffer", { of: "face-tiled", id: "face" }],
    ["A sample of it is written, and the entries above it are changed", { of: "write",
      after: "face" }],
    ["A sample is nearer than what is kept", { of: "depth-test", outcome: "nearer",
      real: true }],

    ["The cube is hidden, with all its faces", { of: "cube-tested",
      outcome: "hidden", at: 0.5, id: "hidden" },
    "Is the cube hidden by what is painted?"],
    ["It is left out at once", { of: "cube-culled", after: "hidden" }],
    ["One entry decides: the cube is behind it", { of: "cube-read",
      outcome: "decides", before: "hidden" }],
    ["A face is compared with an entry, too", { of: "face-read", outcome: "decides",
      pick: "largest" }],
    ["And left out", { name: "faces culled", pick: "largest" }],
    ["Half of the cubes are done", { of: "cube-visited", at: 0.5 }],
  ],
  find: ["How many of the cubes that were asked about were hidden?", (run) => {
    const hidden = withOutcome(run, "cube-tested", "hidden");
    const all = countOf(run, "cube-tested");
    return `${times(hidden)} of ${times(all)}: ${share(hidden, all)}.`;
  }],
};

export const tiling = {
  idea: "Cover the picture once, from front to back",
  text: ["The polygons come from front to back: octree cubes in order, and within a cube " +
    "the pieces of its BSP tree. So the first polygon at a sample is seen there, and each " +
    "sample is written once. No depth is kept.",
  "It is Warnock’s division again, with masks in place of windows. A square of the picture is " +
    "divided into 8 × 8 cells, and these again. A mask has 64 bits, one for each " +
    "cell. Masks tell which cells the polygon covers, touches or misses. What it covers is written " +
    "where it is vacant. Only the cells that an edge passes through are divided again.",
  "A pyramid of masks remembers which cells are covered by all that came before. A polygon " +
    "or a cube whose cells are all covered is hidden. A hidden cube is left out with all its " +
    "polygons."],
  source: "Greene 1996",
  moments: [
    ["A cube is asked about: is anything vacant in its outline?",
      { of: "cube-tested", outcome: "visible" }],
    ["A polygon of the cube, the nearest first", { of: "piece", id: "piece" }],
    ["A cell of the finest level, whose bits are samples: an edge passes through it",
      { of: "finest-cell", outcome: "active", after: "piece" }],
    ["A cell of the pyramid: an edge of the polygon passes through it, so it is divided",
      { of: "polygon-cell", outcome: "active", pick: "widest", real: true }],
    ["A cell that is settled at once: it needs no division", { of: "polygon-cell",
      outcome: "done", pick: "over", real: true }],
    ["A large polygon, in the order of the tree", { of: "piece", pick: "largest" }],
    ["Samples are shown by a mask", { of: "sample", pick: "largest", real: true }],
    ["A cube whose outline is full: it is hidden", { of: "cube-tested",
      outcome: "hidden", pick: "largest" }, "Is anything of this cube still to be seen?",
    { hidden: "no, it is hidden", visible: "yes" }],
    ["It is left out with all its polygons", { of: "cube-culled", pick: "largest" }],
    ["A polygon is hidden in the cell that holds it", { name: "pieces hidden",
      pick: "largest" }],
    ["Half of the polygons are done", { of: "piece", at: 0.5 }],
    ["The background is shown where nothing was", { of: "sample", nth: -1 }],
  ],
  find: ["How many depths are compared?", (run) => {
    const depths = countOf(run, "thickness checks");
    return `${depths ? times(depths) : "None"}: the order decides. ${mostOutcomes(run,
      "polygon-cell")}`;
  }],
};
