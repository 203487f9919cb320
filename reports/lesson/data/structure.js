// SPDX-License-Identifier: GPL-3.0-or-later
// What stands beside the scene: lists of priority, trees of planes, pyramids of
// cells, and what pieces and cubes look like. All of it is read from the trace.
import { listOf } from "./lists.js";
import { piecesOf } from "./pieces.js";
import { pyramidOf } from "./pyramids.js";
import { regionsOf } from "./regions.js";
import { treeOf } from "./trees.js";

export const structureOf = (run) => ({ list: listOf(run), tree: treeOf(run),
  pyramid: pyramidOf(run), ...piecesOf(run), ...regionsOf(run),
  cubes: cubesOf(run), openings: openingsOf(run),
  isCube: cubeSides(run) });

// "node,instance" -> the images of a cube's corners.
function cubesOf(run) {
  return new Map((run.trace.structure.cubes ?? []).map(([node, instance, at]) =>
    [`${node},${instance}`, at]));
}

// Likewise, the image of a rectangle: an opening between two cells, by the cell beyond.
function openingsOf(run) {
  return new Map((run.trace.structure.cubes ?? []).filter(([, , , image]) => image)
    .map(([node, number, , image]) => [`${node},${number}`, image]));
}

// (counter, "a" or "b") -> whether its cells are cubes: all of them are known.
function cubeSides(run) {
  const cubes = cubesOf(run), { trace } = run;
  const are = (c, side) => {
    if (run.header.counters[c][side] !== "cell" || !cubes.size) return false;
    for (let k = 0; k < trace.kept; k++)
      if (trace.counter[k] === c && (trace[`${side}2`][k] !== 0 || !cubes.has(
        `${trace[`${side}0`][k]},${trace[`${side}1`][k]}`))) return false;
    return true;
  };
  const known = run.header.counters.map((_, c) => ({ a: are(c, "a"),
    b: are(c, "b") }));
  return (c, side) => known[c][side];
}
