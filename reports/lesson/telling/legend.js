// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn over the picture beside the two subjects of a step: [what it looks like,
// what it is]. A legend stands below the outline.
import { cellsOfRow, partOfRow, rowAcross } from "../data/grids.js";
import { nodeLook } from "../looks/all.js";
import { mergedLook } from "../looks/faces.js";
import { openingLook } from "../looks/solids.js";
import { readLook } from "../looks/texels.js";

export function legendOf(run, e) {
  const all = [];
  if (nodeLook(run, e).length) all.push(["grey plane", "the plane of the BSP tree’s node at " +
    "which the walk is; this piece lies in it. What is on the eye’s side of the plane " +
    "cannot be hidden by what is on the other side"]);
  if (openingLook(run, e).length) all.push(["filled", "the portal, an opening between two " +
    "cells"], ["thin frame", "the cull box of the first cell"], ["dashed",
    "the cell beyond the portal"]);
  if (readLook(run, e).length) all.push(["map", "the texels of the texture, or of a level; " +
    "those that were read for this pixel are filled, in the map and in the picture"]);
  if (mergedLook(run, e).length) all.push(["dashed", "the face that is painted now"]);
  if (run.counterOf("splat-update") >= 0) all.push(["grey", "the darker a pixel is, the more splats have " +
    "touched it so far"]);
  if (cellsOfRow(run, e)) all.push(...rowLegend(run, e));
  if (e.shape && e.b.kind === "face") all.push(["dashed", "the clip polygon, with what " +
    "earlier cuts have left of it"]);
  return all;
}

function rowLegend(run, e) {
  const part = partOfRow(run, e);
  return [["solid box", "the cells of the row that are looked at"],
    ...part ? [["dashed box", part.axis === undefined
      ? "the octant that the row is in" : "the slice that the row is in"]] : [],
    ...rowAcross(run, e)
      ? [["dotted box", "the cells before, on the other side of the eye"]] : []];
}
