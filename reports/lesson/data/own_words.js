// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that have words of their own: what is done, in the words of the lesson. What
// comes of it follows after a colon. a, b: both subjects, in words.
import { mergedFace } from "./lists.js";

const splats = {
  rows: (a, b) => a === b ? `A row of samples, of ${a}`
    : `A row of samples, from ${a} to ${b}`,
  samples: (a) => `The sample of ${a} is visited`,
  splats: (a, b) => b ? `The splat of ${a}, within ${b}` : `The splat of ${a}`,
  updates: (a, b) => `The splat of ${a} gives its part to ${b}`,
};
const withSums = (what) => ({ ...splats,
  folds: (a, b) => `What the ${what} holds for ${b} is put over the picture` });

const order = {
  runs: (a) => `The row that begins with ${a} is reached`,
  groups: (a, b) => `The rectangle around ${a} to ${b} is tested`,
  cells: (a) => `${a} is reached`,
  sides: (a) => `${a}, a side of the cell, is drawn`,
};

const texture = {
  rays: (a, b) => `The ray of ${b} and the layer`,
  built: (a) => `${a} is computed`,
  tries: (a, b) => `${a} and the filter of ${b}`,
  texels: (a, b) => `${a} is read for ${b}`,
};

const hzbuffer = {
  "nodes visited": (a) => `${a} is reached`,
  "nodes out": (a) => `${a} is left out: it is outside of the view`,
  "cubes culled": (a) => `${a} is left out, with all faces in it`,
  "cube reads": (a, b) => `The entry of ${a} is read for ${b}`,
  "face reads": (a, b) => `The entry of ${a} is read for ${b}`,
  "faces culled": (a) => `${a} is left out: it is hidden`,
  "faces tiled": (a) => `${a} is drawn as in a z-buffer`,
};

const tiling = {
  "cubes tested": (a, b) => `The outline of ${a}, in ${b}`,
  "cubes culled": (a) => `${a} is left out, with all polygons in it`,
  pieces: (a) => `${a} comes next`,
  "pieces hidden": (a) => `${a} is left out: all of its box is covered`,
};

const inSpan = {
  "span cull": (a, b) => /^sample/.test(b) ? `The segment of ${a} and the span’s left end, ${b}`
    : `The segment of ${a} begins in what may be the span, ${b}`,
  "depth divisions": (a, b) => `The segment of ${a} is divided, against that of ${b}`,
};

const OWN = {
  watkins: inSpan,
  warnock: { "minimax culls": (a, b) => `The box of ${a} against ${b}` },
  bouknight: {
    "span divisions": (a, b) => `The span is divided where ${a} and ${b} penetrate`,
  },
  "warnock-edges": {
    "bucket sort": (a) => `${a} is put into a bucket`,
    "crossings noted": (a, b) => `${a} and ${b} may cross: they will be tested`,
    "crossings confirmed": (a, b) => `${b} crosses ${a}`,
  },
  "weiler-atherton": {
    polygons: (a) => `${a} is put into its place in the list`,
    "clip polygons": (a) => `${a} becomes the clip polygon`,
    examinations: (a, b) => `${a} and the clip polygon, ${b}`,
    pieces: (a, b) => `A piece of ${a}, cut by the border of ${b}`,
    "depth comparisons": (a, b) => `The piece of ${a} against the clip polygon, ${b}`,
    culled: (a, b) => `The piece of ${a} is thrown away, behind ${b}`,
    recursions: (a) => `What is before ${a} is a list of its own now, with ${a} at its end`,
  },
  "a-buffer": {
    fragments: (a, b) => `${a} has a fragment in ${b}`,
    masks: (a, b) => `The fragment of ${a} in ${b} gets a mask`,
    hidden: (a, b) => `The fragment of ${a} is thrown away, behind that of ${b}`,
    "simple pixels": (a) => `No fragment in ${a} has a mask`,
    "complex pixels": (a) => `The fragments in ${a} are packed`,
    packed: (a) => `The color of ${a} is added`,
  },
  "zz-buffer": {
    faces: (a) => `${a} starts at the window of the whole picture`,
    subdivisions: (a, b) => `For ${a}, ${b} is divided into four`,
    listed: (a, b) => `${a} is put into the list of ${b}`,
    surrounders: (a, b) => `${a} is now the nearest surrounder of ${b}`,
    cells: (a) => `The list for ${a} is collected, and rays are cast`,
    dropped: (a, b) => `${a} is dropped from the list for ${b}`,
    "ray tests": (a, b) => `The ray through ${b} and ${a}`,
  },
  "error-bounded": {
    "polygons stored": (a, b) => `${a} is put into the list of ${b}`,
    "polygons farther": (a, b) => `${a} is left out of ${b}`,
    "polygons beside": (a, b) => `${a} is not in ${b}`,
    "polygons removed": (a, b) => `${a} is taken out of the list of ${b}`,
    "covering structures": (a, b) => `${a} completes what covers ${b}`,
    "cubes culled": (a) => `${a} is left out, with all faces in it`,
    "cells bounded": (a) => `The mean over ${a}`,
    "exact cells of one": (a) => `${a} shows one face at most: its mean is exact`,
    "exact cells of two": (a) => `Two faces are in the list of ${a}: its mean is exact`,
    "exact cells of more": (a) => `A few faces are in the list of ${a}: its mean is exact`,
    "cells refined": (a) => `The interval of ${a} is too wide: it is to be divided`,
  },
  clark: {
    "nodes visited": (a) => `${a} is reached`,
    "nodes out": (a) => `${a} is left out, with all that is in it`,
    "nodes inside": (a) => `${a} is inside of the view, with all that is in it`,
    "faces met": (a, b) => `${a} is met in ${b}`,
  },
  "octree-raycast": {
    rays: (a, b, where) => `A ray goes through ${a || where}`,
    "cubes visited": (a, b) => `The ray through ${b} and ${a}`,
    "cubes behind": (a, b) => `${a} is left out: it begins behind the hit on ${b}`,
    "faces met": (a, b) => b ? `${a} is met in ${b}` : `${a} is met`,
    "ray tests": (a, b) => `The ray through ${b} and ${a}`,
  },
  pvs: {
    "start cells": (a) => `The eye is in ${a}`,
    "cells visited": (a, b) => `${a} is looked at; its cull box is ${b}`,
    portals: (a, b) => `The portal from ${a} to ${b}`,
    "faces met": (a, b) => `${a} is met in ${b}`,
    "faces outside": (a, b) => `${a} is left out: nothing of it is in ${b}`,
    "faces drawn": (a) => `${a} is drawn by the z-buffer`,
  },
  naylor: {
    "nodes visited": (a) => `${a} is reached`,
    "nodes out": (a) => `What is below ${a} is left out: it is outside of the view`,
    "nodes culled": (a) => `What is below ${a} is left out: the map hides it`,
    "boxes compared": (a, b) => `The box around what is below ${a}, against ${b}`,
    "lines compared": (a, b) => `${a} against the line of ${b}`,
    "parts hidden": (a, b) => `A part of ${a} is hidden by ${b}`,
    divisions: (a, b) => `A side of ${a} divides ${b}`,
    "regions filled": (a, b) => `${b} shows ${a} from now on`,
  },
  meagher: {
    "nodes visited": (a) => `${a} is reached`,
    "nodes out": (a) => `${a} is left out: it is outside of the picture`,
    "silhouette tests": (a, b) => `The outline of ${a} and ${b}`,
    "nodes hidden": (a) => `${a} is hidden, with all that is in it`,
    "cubes drawn": (a) => `${a} is drawn`,
    "sides tiled": (a) => `${a}, a side of the cube, goes down the quadtree`,
    subdivisions: (a, b) => `For ${a}, ${b} is divided into four`,
  },
  roberts: {
    "collections rejected": (a, b) => `${b} is left out for ${a}: it cannot be before it`,
    "volumes rejected": (a, b) => `${b} is left out for ${a}: it cannot be before it`,
    "own volumes": (a, b) => `${b} is left out for ${a}, which lies in its front`,
    "hidden whole": (a, b) => `${b} hides all that was left of ${a}`,
    "one piece left": (a, b) => `${b} hides a part of ${a}: one piece is left`,
    "two pieces left": (a, b) => `${b} hides a part of ${a}: two pieces are left`,
    "bodies apart": (a) => `${a} is taken face by face`,
  },
  "tiling-solids": {
    "convex parts": (a) => `${a} comes next`,
    cells: (a, b) => `${a} is looked at, for ${b}`,
    "finest cells": (a, b) => `The voxels of ${a} are looked at, for ${b}`,
    "masks of planes": (a, b) => `The plane of ${a} and ${b}`,
    "exact decisions": (a, b) => `The plane of ${a} and ${b}`,
    covered: (a, b) => `${a} is written in ${b}`,
  },
  hzbuffer, "hzbuffer-moving": hzbuffer,
  tiling, "tiling-lazy": tiling, "tiling-merged": tiling,
  splat: splats, "splat-xray": splats,
  "splat-sheet": withSums("sheet"), "splat-volume": withSums("slab"),
};
for (const name of ["btf", "wbtf", "vbuffer", "pbtf", "ippbtf", "octree-order"])
  OWN[name] = order;
for (const name of ["point", "mipmap", "table", "convolve"])
  OWN[`texture-${name}`] = texture;

// Outcomes that are said in more words.
const OUTCOMES = {
  "error-bounded": { between: "between two bounds" },
  pvs: { seen: "something is seen through it", outside: "nothing is seen through it" },
};

export const outcomeWords = ({ header: { algorithm } }, { outcome }) =>
  OUTCOMES[algorithm.name]?.[outcome] ?? outcome;

// null: the step has none.
export function ownWords(run, e, a, b, where) {
  const merged = mergedFace(run, e);
  if (merged >= 0) return `The segment of ${run.faceName(merged)} against the bead of ${
    a}, ${where}`;
  return OWN[run.header.algorithm.name]?.[e.counter.name]?.(a, b, where) ?? null;
}

// --- Cells ---

// The words of a cell that is no cube, by its level and its place there; null: it has
// none of its own.
export const ownCellWords = (run, ids) =>
  CELL_WORDS[run.trace.structure.numbered]?.(ids) ?? run.kind.cellWords?.(ids) ?? null;

const PIXELS = 20; // the level of squares that are pixels: HSR_SQUARES_OF_PIXELS

// The square of a cell, in samples: { x, y, side }; null: it has none.
export const squareOfCell = (run, ids) =>
  run.trace.structure.numbered === "squares" ? square(ids) : null;

function square([level, x, y]) {
  const side = 2 ** (level - PIXELS);
  return { x: x * side, y: y * side, side };
}

const CELL_WORDS = {
  squares: (ids) => {
    const { x, y, side } = square(ids);
    return side === 1 ? `the cell of pixel ${x}, ${y}`
      : side > 1 ? `the cell of ${side} × ${side} pixels at ${x}, ${y}`
        : `a cell 1/${1 / side} of a pixel wide at ${x.toFixed(2)}, ${y.toFixed(2)}`;
  },
  entries: ([, x, y]) => `entry ${x}, ${y} of the table`,
  texels: ([level, x, y]) => level ? `texel ${x}, ${y} of level ${level}`
    : `texel ${x}, ${y}`,
};
