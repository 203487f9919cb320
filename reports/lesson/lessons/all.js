// SPDX-License-Identifier: GPL-3.0-or-later
// The lessons, in the order of the course. A lesson is
//
// idea, text, source
//            what the algorithm does: a line, paragraphs, where it is from
// moments    [caption, rule, question, answers]: the steps that tell the idea, in
//            any order. telling/moments.js says what a rule is. The question can be
//            answered from the picture before the step; answers: other words for
//            outcomes
// needs      [{ of or name, why, instead }]: what a scene has to make happen to show the
//            idea; if it does not, why, and a scene that does
// find       [question, answer(run)]: something to find out, and what the run says
import { aBuffer, errorBounded, warnockEdges, weilerAtherton, zzBuffer } from "./areas.js";
import { clark, meagher, naylor, octreeRaycast, pvs } from "./culling.js";
import { bspPainter, painter, raycast, zbuffer } from "./first.js";
import { bouknight, romney, warnock, watkins } from "./image.js";
import { hzbuffer, tiling } from "./later.js";
import { newell, schumacker } from "./lists.js";
import { appel, galimberti, loutrel, roberts } from "./object.js";
import { sortStages } from "./stages.js";
import { yzx } from "./untried.js";
import { orders, splat, splatSheet, splatVolume, splatXray, textureConvolve,
  textureMipmap, texturePoint, textureTable, tilingSolids } from "./volumes.js";

export const LESSONS = { painter, zbuffer, raycast, "bsp-painter": bspPainter,
  roberts, appel, galimberti, loutrel, schumacker, newell, warnock, romney, bouknight,
  watkins, hzbuffer, tiling, yzx, "sort-stages": sortStages,
  "warnock-edges": warnockEdges, "weiler-atherton": weilerAtherton,
  "a-buffer": aBuffer, "zz-buffer": zzBuffer, "error-bounded": errorBounded,
  clark, "octree-raycast": octreeRaycast, pvs, naylor, meagher, ...orders,
  splat, "splat-sheet": splatSheet, "splat-volume": splatVolume,
  "splat-xray": splatXray, "texture-point": texturePoint,
  "texture-mipmap": textureMipmap, "texture-table": textureTable,
  "texture-convolve": textureConvolve, "tiling-solids": tilingSolids };

// Algorithms that work as another one does, for the most part.
const LIKE = { "zbuffer-fast": "zbuffer", "bsp-front": "bsp-painter",
  "appel-visible": "appel", "newell-frame-buffer": "newell",
  "newell-previous": "newell", "warnock-vertices": "warnock",
  "warnock-depth": "warnock", "warnock-watkins": "warnock",
  "warnock-newell": "warnock", "schumacker-newell": "schumacker",
  "schumacker-watkins": "schumacker", "schumacker-newell-watkins": "schumacker",
  "newell-watkins": "newell",
  "hzbuffer-moving": "hzbuffer", "tiling-lazy": "tiling", "tiling-merged": "tiling",
  oracle: "raycast" };

// The lesson of a run: its own, that of its like, or null.
export function lessonOf(run) {
  const { name } = run.header.algorithm;
  return LESSONS[name] ?? LESSONS[LIKE[name]] ?? null;
}
