// SPDX-License-Identifier: GPL-3.0-or-later
// What stands beside the scene: the priority list, the tree of planes, the pyramid, the
// row at hand from above. Each is a canvas with its words.
import { h } from "../../page/parts/dom.js";
import { listStrip } from "./list.js";
import { pyramidCells } from "./pyramid.js";
import { isFromAbove, rowFromAbove } from "./row.js";
import { planeTree } from "./tree.js";

// What this run has of these; show(k, e) draws them all.
export function beside(run) {
  const all = [isFromAbove(run) && rowFromAbove(run), run.list && listStrip(run),
    run.tree && planeTree(run), run.pyramid && pyramidCells(run)].filter(Boolean);
  return { element: all.length ? h("div", { class: "beside-scene" },
    all.map(({ element }) => element)) : null,
  show: (k, e) => all.forEach((part) => part.show(k, e)) };
}
