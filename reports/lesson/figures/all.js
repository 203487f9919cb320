// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of the lessons: [what it is after, its text, draw(run, others), the
// other runs that it wants]. Each is drawn from the events of the lesson's run.
import { h } from "../../page/parts/dom.js";
import { depthOrder, keptDepths, raySide } from "./first.js";
import { alongAnEdge, cubesVisited, logarithmic, masks, pyramid, spans,
  windows } from "./image.js";
import { clusterPriority, division, facePriority, intercepts,
  wrongOrder } from "./lists.js";
import { natures } from "./natures.js";
import { appearances, faceAndWindow, fourResults, repeatedLine, walk } from "./steps.js";
import { segmentsOn } from "../data/projection.js";

const FIGURES = {
  painter: [["The order in depth", "Each bar goes from the nearest corner of a face to " +
    "its farthest one, the dot, which is what is sorted. A bracket joins two faces that " +
    "are painted on a common sample while their depths overlap: there the order by " +
    "farthest corners may be wrong. It is dashed where the run paints a face over a " +
    "nearer one.", depthOrder]],
  zbuffer: [["What is kept at a sample", "The first sample is one that is written most " +
    "often; those beside it have other histories. Each dot is a face that covers the sample, in " +
    "the order in which they come. Filled: nearer than what is kept, and written. " +
    "Hollow: farther, and refused. What is kept, the line, only comes nearer.", keptDepths]],
  raycast: [["A ray from the side", "The faces on one column, with the eye at the left, " +
    "and the ray of one of its samples. The hits are numbered in the order in which the " +
    "faces are asked, which need not be the order along the ray. The depth is stretched where " +
    "it is near, so that faces stay straight.", raySide]],
  galimberti: [["The set along an edge", "The faces that hide an edge, from its one end " +
    "to the other. Where the edge passes behind a nearer edge, a face is entered or left. " +
    "The steps name these edges, and how many faces hide each part; which faces these " +
    "are is found from the scene.", natures]],
  "bsp-painter": [["The walk", "The pieces in the order of the walk, the farthest first. " +
    "Bars that lie over one another in a circle have an order, too, since the planes of " +
    "the tree have cut them.", walk]],
  roberts: [["The four results of the edge/volume test", "Broad: what is left of the " +
    "fragment. Dotted: what the volume hides. As the volume is convex, no more than two " +
    "pieces can be left.", fourResults]],
  loutrel: [["Figure 10", "The image of the edge AB crosses that of CD at I. Only where CD " +
    "is nearer does the number of the faces that hide AB change.", appearances]],
  romney: [["A line that repeats", "Each line leads from where a face begins or ends on a " +
    "row to where it does so on the next; above and below, the faces that are visible. " +
    "Where no two of these lines cross, the same faces stay visible.",
  (run) => repeatedLine(run, (j) => segmentsOn(run, j))]],
  appel: [["Figure 14", "λ, the number of faces that hide the edge, changes only " +
    "where its image crosses that of a nearer contour edge. The edge is drawn " +
    "where λ is 0.", alongAnEdge]],
  schumacker: [
    ["Figure 18", "A cluster from above. Its faces have numbers that hold from " +
      "every eye: once the back faces are left out, dashed in b, a lower number " +
      "hides a higher one. These numbers are found once.", facePriority],
    ["Figure 19", "The clusters from above, with the planes that separate them, " +
      "and the tree of these planes. After each cluster’s number stands its place " +
      "in the order of priority for this eye. Clusters that lie over one another " +
      "share their square.", clusterPriority],
    ["Figure 20", "A convex face on two scan lines. The left edges are blue, the " +
      "right ones red, all drawn as infinite lines. The line meets the face if the " +
      "last of the left intercepts comes before the first of the right ones.",
    intercepts]],
  newell: [
    ["Figure 22", "The Z sort goes by farthest points: P is to be painted before Q. " +
      "But P may obscure Q, so that the six tests change their order.", wrongOrder],
    ["Figure 23", "Cyclic overlap: no order of the whole faces will do. The plane of " +
      "P divides Q into Qa and Qb, which go into the list apart.", division]],
  warnock: [["Figure 25", "All windows that were shown: outlined where they are " +
    "larger than a sample, filled where they are single samples. Where a face " +
    "ends, or penetrates another, windows are small.", windows],
  ["Figure 26", "What a test of a face and a window finds. It looks at X and Y alone, not " +
    "at depth.", faceAndWindow]],
  bouknight: [["Figures 12 and 27", "The segments of one row, seen from above with " +
    "the eye below, and dotted lines between the spans. In a, each edge begins a " +
    "new span, as in Bouknight’s algorithm; in b, spans end where the visible face " +
    "does, as in Watkins’.", spans, ["watkins"]]],
  watkins: [
    ["Figures 12 and 27", "The same row by both algorithms: a span of Watkins’ " +
      "passes over the edges of what is hidden.", spans, ["bouknight"]],
    ["Figure 28", "The ranges of depth of A and B overlap, as the dotted boxes show. " +
      "After A is divided at its midpoint, the depths of one half tell, and the " +
      "search ends.",
    logarithmic]],
  hzbuffer: [
    ["Greene, Kass and Miller: the z-pyramid", "The depths of the finished picture, " +
      "and above them, level by level, the farthest depth of each square of four. " +
      "Near is light; black is the background.", pyramid],
    ["Greene, Kass and Miller: cubes visited", "The cubes of the octree that were " +
      "asked about: green if something of them might be seen, red if they were " +
      "hidden with all that is in them.", cubesVisited]],
  tiling: [["Greene: coverage masks", "One cell of the finest level while a polygon " +
    "is tiled. Three words of 64 bits tell what becomes of its samples; no depth " +
    "is compared, for what comes first is nearest.", masks]],
};

export const figureCount = (name) => FIGURES[name]?.length ?? 0;

// The figures of a lesson, as they come. runNamed(name): a promise of a run, or
// null if the page has none.
export function figures(run, runNamed) {
  const all = FIGURES[run.name] ?? [];
  if (!all.length) return null;
  const element = h("div", { class: "figures" });
  Promise.all(all.map(async ([what, words, draw, more]) => {
    const others = (await Promise.all((more ?? []).map(runNamed))).filter(Boolean);
    const runs = [run, ...others].sort((a, b) => a.name < b.name ? -1 : 1);
    const drawn = draw(more ? runs : run);
    return drawn && h("figure", {}, drawn, h("figcaption", {},
      h("b", {}, `${what}. `), words));
  })).then((made) => element.replaceChildren(...made.filter(Boolean)));
  return h("section", { class: "figures-box" },
    h("h2", {}, "Figures of the paper, from this run"), element);
}
