// SPDX-License-Identifier: GPL-3.0-or-later
// Algorithms after the survey that decide areas, not points, and one for lines. all.js
// says what a lesson is.
import { countOf, perEach, share, times } from "../telling/figures.js";
import { QUESTION, WORDS } from "./object.js";

const WIDE = 0.4; // the sine of an angle that is easily seen

// Whether the images of two edges cross at an angle that is easily seen.
function crossWell({ header }, { a, b }) {
  const [p, q] = [a, b].map(({ ids }) => {
    const [from, to] = ids.slice(0, 2).map((v) => header.vertices[v]);
    return from && to ? [to[0] - from[0], to[1] - from[1]] : [0, 0];
  });
  return Math.abs(p[0] * q[1] - p[1] * q[0]) >
    WIDE * Math.hypot(...p) * Math.hypot(...q);
}

export const warnockEdges = {
  idea: "Find crossings of edges along a line that sweeps the picture",
  text: ["Appel’s algorithm compares each edge with each contour edge, to find where they " +
    "cross. The visibility of an edge can change only there. But most pairs are far apart.",
  "Here a line sweeps over the picture from the top. A list holds the edges that the line " +
    "crosses, from left to right. Two edges that cross change places in this list. So " +
    "only neighbors in the list are compared. A pair that has changed places is noted.",
  "Then each edge is followed, as Appel does. How many faces hide its first point is " +
    "counted once. The number changes by one where the edge crosses a contour edge " +
    "that is nearer. Only the pairs that were noted are tested."],
  source: "The survey, chapter IV, other combinations of sorting, where Warnock’s " +
    "proposal is reported",
  moments: [
    ["An edge goes into the bucket of the row where it begins", { name: "bucket sort",
      outcome: "to enter", pick: "largest" }],
    ["An edge enters the list, by comparisons with those in it", { name: "X merge",
      pick: "apart" }],
    ["Out of order: these two have crossed", { name: "bubble sort",
      outcome: "out of order", where: crossWell, pick: "largest", id: "pair" }],
    ["Neighbors in the list are compared: still in order", { name: "bubble sort",
      outcome: "in order", where: crossWell, before: "pair" }],
    ["They change places in the list", { name: "interchanges", after: "pair" }],
    ["The pair is noted", { name: "crossings noted", where: crossWell, after: "pair" }],
    ["How many faces hide this vertex? This one does", { name: "initial visibility",
      outcome: "hides", at: 0.5 }],
    ["The edge crosses a contour edge that is nearer: one face more hides it, or one less",
      { name: "crossings confirmed", outcome: "nearer", where: crossWell, id: "nearer" },
      QUESTION, WORDS],
    ["The other one is farther: it changes nothing", { name: "crossings confirmed",
      outcome: "farther", where: crossWell, pick: "largest" }, QUESTION, WORDS],
    ["An interval is drawn: where no face hides it, or as hidden", { name: "intervals drawn",
      after: "nearer", pick: "largest", or: { name: "intervals drawn", at: 0.5 } }],
  ],
  find: ["How many of the pairs that were noted cross?", (run) => {
    const cross = countOf(run, "crossings confirmed"), all = countOf(run, "crossings noted");
    return `${times(cross)} of ${times(all)}: ${share(cross, all)}.`;
  }],
};

// Whether both are of two faces.
const areOfTwo = (run, { a, b }) => a.ids[0] !== b.ids[0];

export const weilerAtherton = {
  idea: "Cut the picture along the borders of faces",
  text: ["The nearest polygon of the list becomes the clip polygon. All others are cut by its " +
    "border. A piece is inside of it or outside.",
  "A piece inside that is behind the clip polygon is thrown away: it is hidden. If all " +
    "are behind, the clip polygon is seen as a whole, and is shown.",
  "The order of the list is rough, by the nearest corner. So a piece inside may be before " +
    "the clip polygon. Then all such pieces make a list of their own, with the " +
    "clip polygon at its end. The same is done with this list first. What is left " +
    "of the clip polygon is shown when its turn comes.",
  "After that the pieces outside are the list, and the nearest one of them is next. The " +
    "answer consists of polygons, not of samples: it can be drawn at any size."],
  source: "K. Weiler and P. Atherton, SIGGRAPH 1977",
  moments: [
    ["Polygons are put into rough order. This one has the nearest corner of all",
      { name: "polygons", nth: 1 }],
    ["A polygon becomes the clip polygon", { name: "clip polygons", pick: "largest",
      id: "clip" }],
    ["The boxes of these two are apart: nothing is cut", { name: "examinations",
      outcome: "boxes apart", after: "clip", where: areOfTwo }],
    ["A piece of a polygon is inside the clip polygon", { name: "pieces", outcome: "inside",
      after: "clip", pick: "largest", among: 12, id: "inside" }],
    ["Another piece of it is outside: it stays in the list", { name: "pieces",
      outcome: "outside", after: "inside", with: ["inside", "a"] }],
    ["The piece inside is behind the clip polygon", { name: "depth comparisons",
      outcome: "behind", after: "inside", with: ["inside", "a"],
      or: { name: "depth comparisons", outcome: "behind", pick: "largest" } },
    "Is the solid piece behind the dashed polygon, or before it?"],
    ["A piece that is behind is hidden: it is thrown away", { name: "culled", after: "inside",
      with: ["inside", "a"], or: { name: "culled", pick: "largest" } }],
    ["This piece inside is before the clip polygon: the rough order was wrong",
      { name: "depth comparisons", outcome: "before", after: "clip", pick: "largest",
        id: "before", or: { name: "depth comparisons", outcome: "before",
          pick: "largest", id: "before" } },
      "Is the solid piece behind the dashed polygon, or before it?"],
    ["What is before it makes a list of its own, which is done first", { name: "recursions",
      after: "before" }],
    ["Two polygons penetrate: one is divided where their planes meet", { name: "penetrations",
      pick: "largest" }],
    ["Nothing is before it any more: a region is shown", { name: "regions",
      pick: "largest" }],
    ["Half of the regions are shown", { name: "regions", at: 0.5 }],
  ],
  find: ["How many pieces were made for each region that is shown?", (run) =>
    perEach(run, "pieces", "regions")],
};

export const aBuffer = {
  idea: "Keep small masks of what faces cover of a pixel",
  text: ["A pixel on an edge should have a mixture of colors. " +
    "The A-buffer keeps what faces cover of each pixel: fragments. A fragment has a mask: " +
    "a bit for each of some places in the pixel. Row by row, all fragments of the row are " +
    "found first.",
  "Most pixels are simple. One face covers all of the pixel, and fragments behind it are " +
    "thrown away. Only complex pixels need masks.",
  "When a row is done, its pixels are packed. The fragments of a pixel are gone " +
    "through from front to back. Each takes the places of its mask that are still free. " +
    "Its color counts by how many these are.",
  "A fragment has one depth order with another in the whole pixel. Where two faces " +
    "penetrate within a pixel, that is wrong."],
  source: "L. Carpenter, SIGGRAPH 1984",
  moments: [
    ["No face is in this pixel, or one covers all of it: it is simple",
      { name: "simple pixels", nth: 1 }],
    ["Two fragments overlap: which one is nearer?", { name: "fragment comparisons",
      pick: "largest", among: 60, id: "pair" },
    "Is the solid one nearer or farther than the dashed one here?"],
    ["A face touches a pixel: a fragment", { name: "fragments", before: "pair",
      with: ["pair", "place"] }],
    ["It covers a part of the pixel: it needs a mask", { name: "masks",
      before: "pair", with: ["pair", "place"] }],
    ["All fragments of the row are known. A pixel with masks is packed",
      { name: "complex pixels", before: "pair", with: ["pair", "place"],
        or: { name: "complex pixels", nth: 3 } }],
    ["A face’s color is added to the pixel, by the places that are its own",
      { name: "packed", after: "pair", with: ["pair", "place"] }],
    ["A fragment covers the whole pixel, and is compared with the one that did",
      { name: "covering", pick: "largest" },
      "Is the solid one nearer or farther than the dashed one here?"],
    ["A fragment is behind one that covers the pixel: it is thrown away",
      { name: "hidden", pick: "largest" }],
    ["Half of the pixels are packed", { name: "packed", at: 0.5 }],
  ],
  find: ["How many pixels are complex?", (run) => {
    const complex = countOf(run, "complex pixels");
    const all = complex + countOf(run, "simple pixels");
    return `${times(complex)} of ${times(all)}: ${share(complex, all)}.`;
  }],
};

export const zzBuffer = {
  idea: "Lists of faces for small windows, and then rays",
  text: ["First all faces are put into lists, one after the other, in any order. A face starts " +
    "at the window of the whole picture. If it covers a part of the window, the " +
    "window is divided into four, and the face goes on to each quarter. The smallest " +
    "windows are the cells. A face that covers a part of a cell is put into the cell’s list.",
  "A face that covers all of a window is a surrounder. It is listed there, and goes no " +
    "further down. A face that comes later, and is behind this surrounder everywhere in the " +
    "window, is not listed. A face that came before is dropped when the cell " +
    "is rendered.",
  "Then a ray goes through each sample. It is tested against the faces in its cell’s list " +
    "and in those of the windows above, and against no others. A surrounder needs no " +
    "test: each ray of the window hits it. Of all hits the nearest is shown.",
  "So it stands between Warnock’s subdivision and ray casting: windows decide most, and " +
    "rays the rest."],
  source: "D. Salesin and J. Stolfi 1989; N. Greene, thesis 1995, 2.1.4",
  moments: [
    ["A face starts at the window of the whole picture", { name: "faces", pick: "largest",
      id: "face" }],
    ["It covers a part of the window: an intersecter", { name: "Warnock special",
      outcome: "intersecter", after: "face", with: ["face", "a"] },
    "How does the face lie to the window?"],
    ["So the window is divided, and the face goes on to the quarters",
      { name: "subdivisions", after: "face", with: ["face", "a"] }],
    ["It is disjoint from this window: not listed here", { name: "Warnock special",
      outcome: "disjoint", after: "face", with: ["face", "a"] },
    "How does the face lie to the window?"],
    ["It covers a part of a cell, and is put into the cell’s list", { name: "listed",
      after: "face", with: ["face", "a"], pick: "over" }],
    ["It covers all of this window: a surrounder", { name: "Warnock special",
      outcome: "surrounder", after: "face", with: ["face", "a"], pick: "over" },
    "How does the face lie to the window?"],
    ["The nearest surrounder is kept: it hides all behind it in the window",
      { name: "surrounders", after: "face", with: ["face", "a"],
        or: { name: "surrounders", pick: "over" } }],
    ["A face is farther than the surrounder: it is not listed here",
      { name: "depth search", outcome: "hidden", pick: "largest" }],
    ["All faces are listed. Now the cells are rendered, one by one", { name: "cells",
      nth: 1 }],
    ["A face was listed before the surrounder came: it is dropped", { name: "dropped",
      pick: "over" }],
    ["Two hits of one ray: the nearer one is kept", { name: "depth tests",
      outcome: "nearer", pick: "largest", id: "two" },
    "Is the solid one nearer or farther than the dashed one here?"],
    ["A ray hits a face of the list", { name: "ray tests", outcome: "hit",
      before: "two", with: ["two", "place"], or: { name: "ray tests", outcome: "hit",
        pick: "largest" } }, "Does the ray through the sample hit the face?"],
    ["A ray misses a face of the list", { name: "ray tests", outcome: "missed",
      pick: "over" }, "Does the ray through the sample hit the face?"],
    ["Half of the cells are rendered", { name: "cells", at: 0.5 }],
  ],
  find: ["How many ray tests are made for each sample?", (run) =>
    perEach(run, "ray tests", run.width * run.height, "samples")],
};

export const errorBounded = {
  idea: "Pixels that are right within a bound that one chooses",
  text: ["A pixel’s color is the mean of what is seen in all of it. This algorithm finds for " +
    "each pixel an interval that holds this mean for certain. The reader chooses how wide " +
    "it may be.",
  "In the first pass, the cubes of an octree come from front to back. The faces in them go " +
    "down a quadtree over the picture. A leaf keeps the list of all faces that may be seen " +
    "in it. A leaf whose list is full is divided into four.",
  "A cell is covered when one face covers it, or a few that share edges. Then the farthest " +
    "depth of these is kept. A face behind it is not listed, and one that is listed " +
    "already is taken out. A cube that is behind it in all of its cells is " +
    "left out with all its faces.",
  "In the second pass, each leaf gets an interval of colors. With few faces in the list, their " +
    "areas " +
    "are computed, and the mean is exact. Otherwise the color may be that of any face in the " +
    "list: " +
    "the interval goes from the darkest to the brightest. A pixel’s interval is the sum of " +
    "those of " +
    "its cells. While a pixel’s interval is too wide, the most uncertain cell is divided."],
  source: "N. Greene and M. Kass, SIGGRAPH 1994; N. Greene, thesis 1995, chapter 5",
  needs: [{ name: "cells refined", instead: "cyclic-overlap",
    why: "Every leaf of this scene is known well enough: none is divided in the second pass." },
  { name: "cubes culled", instead: "color-cube:6",
    why: "No cube of this scene is hidden as a whole." }],
  moments: [
    ["The cubes of the octree come from front to back", { name: "nodes visited", nth: 1 }],
    ["A cube is compared with the cells: is all of it hidden?", { name: "cubes tested",
      pick: "largest" }],
    ["A cube is hidden: none of its faces is looked at", { name: "cubes culled",
      pick: "largest" }],
    ["A face of a cube goes down the quadtree. It meets this cell",
      { name: "polygons against cells", outcome: "meets", pick: "over", id: "meets" },
      "How does the face lie on the cell?"],
    ["It is put into the list of a leaf", { name: "polygons stored", after: "meets" }],
    ["The list of a leaf is full: the cell is divided", { name: "cells divided",
      pick: "largest" }],
    ["So the cell is covered: what is behind is hidden here", { name: "covering structures",
      outcome: "a polygon", pick: "over", id: "covered", or: { name: "covering structures",
        pick: "over", id: "covered" } }],
    ["A face covers this cell", { name: "polygons against cells", outcome: "covers",
      before: "covered", with: ["covered", "a"] }, "How does the face lie on the cell?"],
    ["A face that was listed is behind it: it is taken out", { name: "polygons removed",
      pick: "over" }],
    ["A face is behind all that may be seen in the cell: it is not listed",
      { name: "polygons farther", pick: "over" }],
    ["All faces are listed. Now a leaf gets its interval of colors",
      { name: "cells bounded", nth: 1 }],
    ["Two faces in the list: the mean is exact", { name: "exact cells of two",
      pick: "largest" }],
    ["The interval is too wide: the cell is divided", { name: "cells refined",
      pick: "largest" }],
    ["Each pixel is known to within the bound, and is written", { name: "pixels",
      nth: 1 }],
    ["Half of the pixels are written", { name: "pixels", at: 0.5 }],
  ],
  find: ["In how many of the leaves is the mean exact, since few faces are in the list?",
    (run) => {
      const exact = ["one", "two", "more"].map((n) => countOf(run, `exact cells of ${n}`))
        .reduce((sum, n) => sum + n, 0);
      const all = countOf(run, "cells bounded");
      return `${["one", "two", "more"].map((n) => `of ${n}: ${
        times(countOf(run, `exact cells of ${n}`))}`).join(", ")}; of ${
        times(all)} that were bounded: ${share(exact, all)}.`;
    }],
};
