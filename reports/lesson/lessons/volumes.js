// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes: the orders in which the cells of a grid are visited, splats, textures that
// they are compared with, and solids as voxels. all.js says what a lesson is.
import { beginsPart, isOnlyPart, rowAcross } from "../data/grids.js";
import { perEach } from "../telling/figures.js";
import { paintsWrong } from "../telling/wrong.js";

const THESIS = "J. E. Swan II, Object-Order Rendering of Discrete Objects, thesis 1998";
const ORDERS = {
  btf: ["Three nested loops, each from its far end", "Three nested loops go through the " +
    "grid. Each begins at the end of its axis that is farther along the direction of view. That " +
    "is right in parallel projection. In perspective the eye may be between the ends of an " +
    "axis. Then one direction is right on one side of the eye, and wrong on the other."],
  wbtf: ["Slices along the axis that one looks along most", "The outermost loop goes along " +
    "the axis that is closest to the direction of view, the innermost one along the axis that is " +
    "farthest from it. Each loop has one direction. In perspective this is wrong in fewer " +
    "views than plain loops are, but in some."],
  vbuffer: ["Slices, and in a slice by distance", "The slices lie along the axis that is " +
    "closest to the direction of view, and come from the far end. Within a slice, cells come " +
    "by their distance from the view plane, the farthest first. In perspective the order " +
    "of the slices is wrong in some views."],
  pbtf: ["Divide each axis at the eye", "Each axis is divided at the cell that holds the " +
    "eye. That makes up to eight parts, the octants. If the eye is outside of the grid, there " +
    "are fewer. Within an octant the eye is at one end of each axis, so that one direction " +
    "along it is right: from the far end to the eye.",
  "The octants come one after the other. Cells of two octants do not hide one another, but for " +
    "the slices that the eye is in: a cell there reaches to both sides of the eye. So the " +
    "octants with these slices come last. It is right from every eye, and that is proved."],
  ippbtf: ["Divide each axis at the eye, and take both sides in turn", "Each axis is divided " +
    "at the cell that holds the eye. Each loop then takes slices, rows or cells from both " +
    "sides of " +
    "the eye in turn, by their distance from it, the farthest first. So no octant is done " +
    "before the others."],
  "octree-order": ["The far children of a node first", "The grid is halved along each axis, " +
    "again and again: an octree that need not be stored. The planes that halve a node part " +
    "its children. On which side of them the eye is says in which order the eight come: " +
    "the one opposite to the eye first, and the eye’s own one last."],
};

const begins = (where) => ({ of: "row-of-cells", where });
const lastOf = (where) => ({ of: "row-of-cells", where, nth: -1 });

// What each order has of its own: the parts that it goes by.
const SLICES = [
  ["The first slice is done. The one beside it is next", begins(beginsPart)],
  ["The last slice, at the other end of the axis", lastOf(beginsPart)]];
const PARTS = {
  btf: SLICES, wbtf: SLICES,
  vbuffer: [...SLICES, ["Within a slice: the next cell, by its distance from the view plane",
    { of: "row-of-cells", at: 0.2 }]],
  pbtf: [["The first octant is done. The next one begins", begins(beginsPart)],
    ["The last octant begins: nothing in the others hides it", lastOf(beginsPart)],
    ["This octant is the only one: along each axis, all cells are on one side of the eye",
      begins(isOnlyPart)]],
  "octree-order": [["An octant, a child of the root, is done. The next one begins",
    { ...begins(beginsPart), at: 0.5 }],
  ["The last octant begins: nothing in the others hides it", lastOf(beginsPart)]],
  ippbtf: [["The cells before were on the other side of the eye: the sides take turns",
    begins((run, e) => isSeen(run, e) && rowAcross(run, e) !== null)]],
};

// Whether both ends of the turn are in the picture.
function isSeen(run, e) {
  const before = rowAcross(run, e);
  return [e, before].every((row) => row && (run.cubes.get(`${row.a.ids[0]},0`) ?? [])
    .some((p) => p && p[0] > 0 && p[1] > 0 && p[0] < run.width && p[1] < run.height));
}

// The lesson of an order of the cells of a grid.
const orderLesson = ([idea, ...how], parts) => ({
  idea,
  text: ["The scene is a grid of cells, in slices along each of three axes. A plane between two " +
    "slices parts them: what is on the eye’s side of it cannot be hidden by what is beyond. " +
    "So the eye’s place alone gives an order, and no two cells are ever compared.",
  ...how, "Each cell is drawn by its sides that face the eye. What comes later covers what came " +
    "before, so that no depth is kept."],
  source: `${THESIS}, chapter 2`,
  moments: [
    ["The first row of the order", { of: "row-of-cells", nth: 1 }],
    ["The first cell that is drawn", { name: "cells", outcome: "drawn" }],
    ["A side of it that faces the eye is drawn", { name: "sides", nth: 1 }],
    ["A cell that comes later covers what was there", { name: "writes", covers: true }],
    ["This cell is passed over: it shows at no sample of the picture", { name: "cells",
      outcome: "out of sight" }],
    ["A quarter of the sides are drawn", { name: "sides", at: 0.25 }],
    ["Half of the sides are drawn", { name: "sides", at: 0.5 }],
    ["Three quarters of the sides are drawn", { name: "sides", at: 0.75 }],
    ["A farther cell comes later, and covers a nearer one: that is wrong", { name: "writes",
      where: (run, e) => run.trace.knownWrong && paintsWrong(run, e), at: 0.5 }],
    ["The last side of the order", { name: "sides", nth: -1 }],
    ...parts,
  ],
  find: ["How often is a sample written on the mean, of those that show something?", (run) => {
    const covered = run.painting.at(run.n).reduce((n, f) => n + (f >= 0 ? 1 : 0), 0);
    return perEach(run, "writes", covered, "samples that show a face");
  }],
});

export const orders = Object.fromEntries(Object.entries(ORDERS).map(([name, words]) =>
  [name, orderLesson(words, PARTS[name] ?? [])]));

const SPLATS = "Each sample of the grid is thrown at the picture like a ball of paint that is " +
    "soft " +
  "at its rim: a splat. The pixels that it covers are its footprint. A pixel gets the more " +
  "of its color, the closer it is to the middle of the splat.";
const GREY = "The colors are written when all splats are done. Until then the page shows in " +
  "grey how often each pixel was touched.";
const SPLAT_MOMENTS = [
  ["The box around a row of samples is in the picture", { name: "rows", outcome: "in it",
    nth: 1 }],
  ["A sample of the grid is visited", { name: "samples", pick: "largest", among: 12,
    id: "sample" }],
  ["The rectangle around its splat is in the picture", { name: "splats", outcome: "drawn",
    after: "sample", with: ["sample", "a"] }],
  ["A pixel gets its part of the splat, by the distance from the middle", { name: "updates",
    after: "sample", with: ["sample", "a"], pick: "over", id: "pixel" }],
  ["A later splat touches the same pixel", { name: "updates", after: "pixel",
    with: ["pixel", "place"] }],
  ["Half of the splats", { name: "splats", at: 0.5 }],
  ["All splats are done. Now the pixels get their colors", { name: "writes", nth: 1 }],
];
const perSplat = ["How many pixels does a splat touch on the mean?", (run) =>
  perEach(run, "updates", "splats")];
const splatLesson = (idea, text, more = []) => ({ idea, text: [SPLATS, ...text, GREY],
  source: `L. Westover, SIGGRAPH 1990; ${THESIS}, chapter 1`,
  moments: [...SPLAT_MOMENTS, ...more], find: perSplat });
const foldMoments = (what) => [
  [`The first ${what} is complete. Pixel by pixel, it is put over the picture`,
    { name: "folds", nth: 1, id: "fold" }],
  [`After it, the splats of the next ${what} are added`, { name: "splats", after: "fold" }],
  [`The last pixel of the last ${what}`, { name: "folds", nth: -1 }]];

export const splat = splatLesson("Throw the samples at the picture, one after the other", [
  "Splats are put over one another from back to front. What lies below a splat shines " +
  "through it, as it is not opaque. The order of the grid is known without a comparison.",
  "But splats are wider than the distance between samples, so they overlap in depth. No order " +
  "of whole splats is right then: color of a farther sample comes to lie over a nearer one."]);
export const splatSheet = splatLesson("Add the splats of a slice, then put slices over one " +
    "another", [
  "The slices of the grid that are most parallel to the picture are taken one by one, " +
  "from back to front. The splats of a slice are added " +
  "in a buffer of their own, the sheet. Then the sheet is put over the picture, and is empty " +
    "again.",
  "Within a sheet nothing hides anything, so that the order does not matter there. Between " +
  "sheets, splats still overlap in depth. When the view turns far enough, another axis " +
  "has the sheets. Then the brightness of faces changes at once: the picture pops."],
foldMoments("sheet"));
export const splatVolume = splatLesson("Add what splats give to slabs that are parallel to the " +
    "picture", [
  "The space before the eye is divided into slabs that are parallel to the picture. The steps " +
  "call them buckets. A splat gives to each slab the part of it that lies there, and there " +
  "it is added. The slabs are put over one another from back to front.",
  "So the slabs turn with the view, and nothing pops when it turns. It takes more work: a splat " +
  "reaches several slabs."],
foldMoments("slab"));
export const splatXray = splatLesson("Add all splats", [
  "In an X-ray picture nothing hides anything. All splats are added, in any order. The sum " +
  "in a pixel tells how much its ray meets on its way."]);

const TEXTURES = "Here the grid is one layer, a texture, which the picture shows in perspective. " +
  "An element of it is a texel. It is the one case in which splats and the methods of texture " +
  "mapping answer the same question: what color has a pixel that covers many texels, or a " +
  "part of one?";
const textureLesson = (idea, how, source, reads, built) => ({ idea, text: [TEXTURES, how],
  source,
  moments: [
    ...built ? [[built, { name: "built", nth: 1 }],
      ["All of that is made beforehand", { name: "built", nth: -1 }]] : [],
    ["The ray of this pixel misses the layer: it shows the background", { name: "rays",
      outcome: "misses", nth: 1 }],
    ["The ray of this pixel meets the layer", { name: "rays", outcome: "meets", at: 0.02,
      id: "ray" }],
    [reads, { name: "texels", after: "ray", with: ["ray", "place"], id: "read" }],
    ["The pixel gets its color, from what was read", { name: "writes", after: "ray",
      nth: 1 }],
    ["A pixel that is far away, and what was read for it", { name: "writes", at: 0.1 }],
    ["A pixel that is near, and what was read for it", { name: "writes", at: 0.95 }],
  ],
  find: ["How many texels are read for a pixel?", (run) => perEach(run, "texels", "writes")] });

export const texturePoint = textureLesson("The texel that the ray meets",
  "A pixel takes the color of the one texel that its ray meets. Far away a pixel covers many " +
  "texels, and takes one of them by chance: so patterns appear that are not there.",
  "E. Catmull, thesis, University of Utah 1974", "The texel that the ray meets is read");
export const textureMipmap = textureLesson("Read from a pyramid of ever smaller textures",
  "Beforehand the texture is halved again and again: a texel of a level is the mean of four of " +
    "the " +
  "level before. A pixel reads the two levels whose texels are about as large as what it covers, " +
  "four texels of each, and takes a mean of these. " +
  "What it covers is taken for a square, so that it may be too soft in one direction.",
  "L. Williams, SIGGRAPH 1983", "The first of the texels around the ray is read",
  "A texel of the next level: the mean of four");
export const textureTable = textureLesson("The mean of a rectangle by its four corners",
  "Beforehand a table is made: for each texel the sum of all texels before it in both " +
    "directions. " +
  "The sum over any rectangle is then found from its four corners: that of the far corner, " +
    "less those of " +
  "the two corners beside it, and with that of the near corner, which was taken away twice. So a " +
  "pixel costs the same, however many texels it covers.",
  "F. C. Crow, SIGGRAPH 1984", "The first entry at the corners of the rectangle is read",
  "An entry of the table: a texel, and what three other entries say");
export const textureConvolve = textureLesson("Read every texel that the filter reaches",
  "All texels that the pixel’s filter reaches are read, each with its weight. It is the " +
  "best of the four, and its cost grows with what a pixel covers.",
  "E. Feibush, M. Levoy and R. Cook, SIGGRAPH 1980; P. Heckbert 1989",
  "The first texel within the filter is read");

export const tilingSolids = {
  idea: "Which solid is each voxel in?",
  text: ["Space is a grid of small cubes, the voxels. A voxel belongs to a solid if its middle " +
    "is " +
    "inside. A convex solid is what lies behind all of its planes. A solid with a dent is " +
    "divided into convex parts first.",
  "A cell of space, at first all of it, is divided into smaller cells, four along each axis. " +
    "For each plane a mask of a bit a cell tells which of these are behind it, which are not, " +
    "and " +
    "which it crosses. The masks of all planes together tell it of the solid.",
  "What is inside is written with all that is in it. What is outside is left. Only " +
    "what a plane crosses is divided again, down to the voxels.",
  "So it is hierarchical tiling in three dimensions instead of two. Greene thought it possible " +
    "and did not build it."],
  source: "N. Greene, SIGGRAPH 1996, section 8",
  moments: [
    ["A convex solid, or a convex part of one", { name: "convex parts", nth: 1, id: "part" }],
    ["The first cell holds all of space", { name: "cells", after: "part" }],
    ["A plane of the solid crosses the cell: it has a mask of its smaller cells",
      { name: "masks of planes", outcome: "crossing", after: "part" }],
    ["This plane has all of a cell behind it", { name: "masks of planes",
      outcome: "inside", pick: "largest" }],
    ["This plane has all of a cell before it: it is outside of the solid",
      { name: "masks of planes", outcome: "outside", pick: "largest" }],
    ["A cell that a plane crosses is divided again", { name: "cells",
      where: (run, { a: { ids: [level] } }) => level > 0 }],
    ["A cell whose smaller cells are voxels", { name: "finest cells", after: "part" }],
    ["What is inside of all planes is written", { name: "covered", nth: 1 }],
    ["A voxel’s middle is too close to a plane for doubles: exact numbers decide",
      { name: "exact decisions", pick: "largest" }],
    ["Half of the solids are done", { name: "convex parts", at: 0.5 }],
  ],
  find: ["How many masks of planes are made for each convex part?", (run) =>
    perEach(run, "masks of planes", "convex parts")],
};

