// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes: the orders in which the cells of a grid are visited, splats, textures that
// they are compared with, and solids as voxels. all.js says what a lesson is.
import { perEach } from "../telling/figures.js";

const THESIS = "J. E. Swan II, Object-Order Rendering of Discrete Objects, thesis 1998";
const ORDERS = {
  btf: ["Three nested loops, each from its far end", "The three loops go through the grid " +
    "from its far end along each axis, as seen along the direction of view. That is right in parallel " +
    "projection. In perspective the eye may be within the extent of an axis. Then no single " +
    "direction along it is right on both sides of the eye."],
  wbtf: ["Slices along the axis that one looks along most", "The outermost loop goes along " +
    "the axis closest to the direction of view, and the innermost one along the axis farthest from it. In " +
    "perspective this is wrong in fewer views than plain loops are, but in some."],
  vbuffer: ["Slices, and in a slice by distance", "The slices lie along the axis closest to " +
    "the direction of view. Within a slice, cells come by their distance from the view plane. In " +
    "perspective this is wrong in some views."],
  pbtf: ["Divide each axis at the eye", "Each axis is divided at the cell that holds the eye. That " +
    "makes up to eight parts, the octants. In each of them one direction along each axis is " +
    "right. The octants come one after the other, each from its far corner to the eye. It is right from every " +
    "eye, and that is proved."],
  ippbtf: ["Divide each axis at the eye, and take both sides in turn", "Each axis is divided " +
    "at the cell that holds the eye. Each loop then takes cells from both sides of the eye in turn, by their " +
    "distance from it, the farthest first."],
  "octree-order": ["The far children of a node first", "The grid is halved along each axis, again " +
    "and again: an octree that need not be stored. At each node the eye’s place says in which " +
    "order the eight children come."],
};

// The lesson of an order of the cells of a grid.
const orderLesson = ([idea, how]) => ({
  idea,
  text: [how, "Two cells of a grid never penetrate, and a plane between two slices parts them. " +
    "So an order is found by the eye’s place alone, and no two cells are ever compared. A cell is drawn by its " +
    "sides that face the eye. From back to front, what comes later covers what came before."],
  source: `${THESIS}, chapter 2`,
  moments: [
    ["A row of cells is come to", { name: "runs", pick: "largest" }],
    ["The first cell of the order that is drawn", { name: "cells", outcome: "drawn" }],
    ["A side of it that faces the eye is drawn", { name: "sides", nth: 1 }],
    ["A cell that comes later covers what was there", { name: "writes", covers: true }],
    ["A cell is out of sight", { name: "cells", outcome: "out of sight" }],
    ["Half of the sides are drawn", { name: "sides", at: 0.5 }],
    ["The last side of the order, the nearest to the eye", { name: "sides", nth: -1 }],
  ],
  find: ["How often is a sample written on the mean, of those that show something?", (run) => {
    const covered = run.painting.at(run.n).reduce((n, f) => n + (f >= 0 ? 1 : 0), 0);
    return perEach(run, "writes", covered, "samples that show a face");
  }],
});

export const orders = Object.fromEntries(Object.entries(ORDERS).map(([name, words]) =>
  [name, orderLesson(words)]));

const SPLATS = "Each sample of the grid is thrown at the picture like a ball of paint that is soft at its rim: a splat. " +
  "Its footprint is the same for all samples in parallel projection, and is looked up in a table.";
const SPLAT_MOMENTS = [
  ["A row of samples is in the picture", { name: "rows", pick: "largest" }],
  ["A sample of the grid is visited", { name: "samples", nth: 1 }],
  ["A splat is put into the picture", { name: "splats", outcome: "drawn",
    pick: "largest" }],
  ["A pixel gets its part of a splat, by the distance from the middle", { name: "updates",
    nth: 1 }],
  ["A quarter of the splats", { name: "splats", at: 0.25 }],
  ["Half of the splats", { name: "splats", at: 0.5 }],
];
const perSplat = ["How many pixels does a splat touch on the mean?", (run) =>
  perEach(run, "updates", "splats")];
const splatLesson = (idea, text, more = []) => ({ idea, text: [SPLATS, ...text],
  source: `L. Westover, SIGGRAPH 1990; ${THESIS}, chapter 1`,
  moments: [...SPLAT_MOMENTS, ...more], find: perSplat });

export const splat = splatLesson("Throw the samples at the picture, one after the other", [
  "Splats are put over one another from back to front, or under one another from front to " +
  "back. The order of the grid is known without a comparison.",
  "Splats are wider than the distance between samples, so they overlap in depth. No order " +
  "of whole splats is right then: color of a farther sample comes to lie over a nearer one."]);
export const splatSheet = splatLesson("Add the splats of a slice, then put slices over one another", [
  "The slices of the grid that face the eye most are taken one by one. The splats of a slice are added " +
  "in a buffer of its own, the sheet. Then the sheet is put over the picture.",
  "Within a sheet nothing hides anything, so its order does not matter. When the view turns far enough, another axis " +
  "has the sheets, and the picture changes at once: it pops."],
[["The sheet is complete: it is put over the picture", { name: "folds", nth: 1 }],
  ["The last sheet", { name: "folds", nth: -1 }]]);
export const splatVolume = splatLesson("Add what splats give to slabs that are parallel to the picture", [
  "The space before the eye is divided into slabs that are parallel to the picture. A splat gives to each slab " +
  "the part of it that lies there. Slabs are put over one another from back to front.",
  "So the slabs turn with the view, and nothing pops when it turns. It takes more work: a splat " +
  "reaches several slabs."],
[["A slab is complete: it is put over the picture", { name: "folds", nth: 1 }]]);
export const splatXray = splatLesson("Add all splats", [
  "In an X-ray picture nothing hides anything. All splats are added, in any order. The sum " +
  "is what the ray meets on its way."]);

const TEXTURES = "Here the grid is one layer, a texture, which the picture shows in perspective. It is the one " +
  "case in which splats and the methods of texture mapping answer the same question.";
const textureLesson = (idea, how, source) => ({ idea, text: [how, TEXTURES], source,
  moments: [
    ["The ray of a pixel is met with the layer", { name: "rays", nth: 1 }],
    ["What is made before the picture", { name: "built", nth: 1 }],
    ["A texel is read", { name: "texels", nth: 1 }],
    ["A pixel gets its color", { name: "writes", nth: 1 }],
    ["A pixel that is far away: its texels", { name: "texels", at: 0.1 }],
    ["A pixel that is near: its texels", { name: "texels", nth: -1 }],
  ],
  find: ["How many texels are read for a pixel?", (run) => perEach(run, "texels", "writes")] });

export const texturePoint = textureLesson("The texel that the ray meets",
  "A pixel takes the color of the one texel that its ray meets. Far away a pixel covers many " +
  "texels, and takes one of them by chance: so patterns appear that are not there.",
  "E. Catmull, thesis, University of Utah 1974");
export const textureMipmap = textureLesson("Read from a pyramid of ever smaller textures",
  "Beforehand the texture is halved again and again; a texel of a level is the mean of four of the level " +
  "before. A pixel reads the two levels whose texels are about as large as what it covers. " +
  "What it covers is taken for a square, so that it may be too soft in one direction.",
  "L. Williams, SIGGRAPH 1983");
export const textureTable = textureLesson("The mean of a rectangle by its four corners",
  "Beforehand a table is made: for each texel the sum of all texels before it in both directions. The sum of any " +
  "rectangle is then found from its four corners. So a pixel costs the same, however many " +
  "texels it covers.",
  "F. C. Crow, SIGGRAPH 1984");
export const textureConvolve = textureLesson("Read every texel that the filter reaches",
  "All texels that the pixel’s filter reaches are read, each with its weight. It is the " +
  "best of the four, and its cost grows with what a pixel covers.",
  "E. Feibush, M. Levoy and R. Cook, SIGGRAPH 1980; P. Heckbert 1989");

export const tilingSolids = {
  idea: "Which solid is each voxel in?",
  text: ["A convex solid is what lies behind all of its planes. A cell of space is divided into " +
    "smaller cells, four along each axis. For each plane a mask of a bit a cell tells which of these " +
    "are behind it, which are not, and which it crosses. The masks of all planes together tell it of the solid.",
  "What is inside is written with all that is in it. What is outside is left. Only " +
    "what a plane crosses is divided again.",
  "So it is hierarchical tiling in three dimensions instead of two. Greene thought it possible " +
    "and did not build it."],
  source: "N. Greene, SIGGRAPH 1996, section 8",
  moments: [
    ["A convex solid, or a convex part of one", { name: "convex parts", pick: "largest" }],
    ["A cell is visited", { name: "cells", pick: "largest" }],
    ["The mask of a plane over the cell", { name: "masks of planes", pick: "largest" }],
    ["A cell of voxels is visited", { name: "finest cells", pick: "largest" }],
    ["A voxel’s middle is too close to a plane for doubles: exact numbers decide",
      { name: "exact decisions", pick: "largest" }],
    ["What is in the solid is written", { name: "covered", pick: "largest" }],
  ],
  find: ["How many finest cells are visited for each larger one?", (run) =>
    perEach(run, "finest cells", "cells")],
};

