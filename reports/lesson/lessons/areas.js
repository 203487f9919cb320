// SPDX-License-Identifier: GPL-3.0-or-later
// Algorithms after the survey that decide areas, not points, and one for lines. all.js
// says what a lesson is.
import { countOf, perEach, share, times } from "../telling/figures.js";

export const warnockEdges = {
  idea: "Find crossings of edges along a line that sweeps the picture",
  text: ["Appel’s algorithm compares each edge with each contour edge, to find where they " +
    "cross. Only there its visibility can change. Most pairs are far apart.",
  "Here edges are sorted as a scan-line algorithm sorts them: by where they begin, and then by their " +
    "order along the line. Two edges that cross are neighbors just before. So only neighbors " +
    "are tested.",
  "The rest is Appel’s: how many faces hide a point is counted once, and changes by one at each crossing."],
  source: "The survey, chapter IV, other combinations of sorting, where Warnock’s " +
    "proposal is reported",
  moments: [
    ["An edge goes into its bucket", { name: "bucket sort", pick: "largest" }],
    ["An edge enters the list, by comparisons with those in it", { name: "X merge",
      pick: "largest" }],
    ["Neighbors in the list are compared", { name: "bubble sort", pick: "largest" }],
    ["Neighbors have changed places: they may cross", { name: "interchanges", pick: "largest" }],
    ["A pair is tested exactly", { name: "crossings noted", pick: "largest" }],
    ["Two edges cross: from here on one of them is hidden, or seen", { name: "crossings confirmed",
      pick: "largest" }],
    ["A visible interval is drawn", { name: "intervals drawn", pick: "largest" }],
  ],
  find: ["How many of the pairs that were tested cross?", (run) => {
    const cross = countOf(run, "crossings confirmed"), all = countOf(run, "crossings noted");
    return `${times(cross)} of ${times(all)}: ${share(cross, all)}.`;
  }],
};

export const weilerAtherton = {
  idea: "Cut the picture along the borders of faces",
  text: ["The nearest polygon becomes the clip polygon. All others are cut by its " +
    "border. What is inside of it makes one list, and what is outside another.",
  "Inside, all that is behind the clip polygon is thrown away: it is hidden. If something " +
    "there is in front of it, the rough order was wrong. Then that polygon is the next to " +
    "cut, within this list.",
  "When nothing is left in front, the clip polygon is shown as a whole. Then the same is done with " +
    "the list outside. The answer consists of polygons, not of samples: it can be drawn at any size."],
  source: "K. Weiler and P. Atherton, SIGGRAPH 1977",
  moments: [
    ["Polygons are put into rough order, the nearest first", { name: "polygons",
      pick: "largest" }],
    ["A polygon becomes the clip polygon", { name: "clip polygons", pick: "largest" }],
    ["A polygon is examined against the clip polygon", { name: "examinations", pick: "largest" }],
    ["A piece of a polygon is inside the clip polygon", { name: "pieces", outcome: "inside", pick: "largest" }],
    ["A piece is outside of it", { name: "pieces", outcome: "outside", pick: "largest" }],
    ["A piece inside is behind the clip polygon", { name: "depth comparisons",
      outcome: "behind", pick: "largest" },
    "Is the solid piece behind the dashed polygon, or before it?"],
    ["A hidden piece is thrown away", { name: "culled", pick: "largest" }],
    ["Something inside is before the clip polygon: it cuts next", { name: "recursions",
      pick: "largest" }],
    ["Two polygons penetrate: one is divided where their planes meet", { name: "penetrations",
      pick: "largest" }],
    ["A region is shown", { name: "regions", pick: "largest" }],
  ],
  find: ["How many pieces were made for each region that is shown?", (run) =>
    perEach(run, "pieces", "regions")],
};

export const aBuffer = {
  idea: "Keep small masks of what faces cover of a pixel",
  text: ["An edge of a face crosses pixels. Such a pixel should have a mixture of colors. " +
    "The A-buffer keeps for each pixel what faces cover of it: fragments. A fragment has a mask: " +
    "a bit for each of some places in the pixel.",
  "Most pixels are simple. A face covers all of them, and fragments behind it are thrown away as " +
    "they come. Only complex pixels keep a list.",
  "At the end a pixel is packed: its fragments are gone through from front to back, and each takes " +
    "the places of its mask that are still free."],
  source: "L. Carpenter, SIGGRAPH 1984",
  moments: [
    ["A face touches a pixel: a fragment", { name: "fragments", nth: 1 }],
    ["A fragment covers a part of the pixel: it needs a mask", { name: "masks", nth: 1 }],
    ["A fragment covers the whole pixel, and is compared with the one that did", { name: "covering",
      pick: "largest" }],
    ["A fragment is behind one that covers the pixel: it is thrown away",
      { name: "hidden", nth: 1 }],
    ["Two fragments overlap: their order in depth is asked", { name: "fragment comparisons",
      nth: 1 }],
    ["A pixel of one face", { name: "simple pixels", nth: 3 }],
    ["A pixel with masks is packed", { name: "complex pixels", nth: 3 }],
    ["A color is added to a pixel, by the places that are its own", { name: "packed", nth: 3 }],
  ],
  find: ["How many pixels are complex?", (run) => {
    const complex = countOf(run, "complex pixels");
    const all = complex + countOf(run, "simple pixels");
    return `${times(complex)} of ${times(all)}: ${share(complex, all)}.`;
  }],
};

export const zzBuffer = {
  idea: "Lists of faces for small windows, and then rays",
  text: ["First each face is put into the lists of the windows that it meets. Windows are divided " +
    "in four, down to small cells. A face that surrounds a window is listed there once. A " +
    "face that is behind such a surrounder is not listed at all.",
  "Then a ray goes through each sample. It is tested against the faces in its cell’s list, " +
    "and in those of the windows above, and against no others.",
  "So it stands between Warnock’s subdivision and ray casting: windows decide most, and rays the rest."],
  source: "D. Salesin and J. Stolfi 1989; N. Greene, thesis 1995, 2.1.4",
  moments: [
    ["A face is put into the windows", { name: "faces", pick: "largest" }],
    ["A face is compared with a window", { name: "Warnock special", pick: "largest" }],
    ["A window is divided for a face", { name: "subdivisions", pick: "largest" }],
    ["A face surrounds a window, and hides all behind", { name: "surrounders",
      pick: "largest" }],
    ["A face is farther than a surrounder of the window: it is not listed",
      { name: "depth search", outcome: "hidden", pick: "largest" }],
    ["A face is put into a window’s list", { name: "listed", pick: "largest" }],
    ["A cell is rendered", { name: "cells", nth: 3 }],
    ["A ray hits a face of the list", { name: "ray tests", outcome: "hit", pick: "largest" },
      "Does the ray through the sample hit the face?"],
    ["Of two hits the nearer one is kept", { name: "depth tests", pick: "largest" }],
  ],
  find: ["How many ray tests are made for each sample?", (run) =>
    perEach(run, "ray tests", run.width * run.height, "samples")],
};

export const errorBounded = {
  idea: "Pixels that are right within a bound that one chooses",
  text: ["A pixel’s color is the mean of what is seen in it. This algorithm computes for " +
    "each pixel an interval that holds this mean for certain, and makes it narrower until it is " +
    "narrow enough.",
  "In the first pass, cubes of an octree come from front to back, and faces are put into the " +
    "cells of a quadtree. A cube that is behind what covers its cells is left out. A leaf keeps the list of all " +
    "faces that may be seen in it.",
  "In the second pass leaves are bounded. With one or two polygons in a cell the mean is known in " +
    "closed form. Otherwise it is an interval. Where a pixel’s interval is too wide, its " +
    "cell is divided."],
  source: "N. Greene and M. Kass, SIGGRAPH 1994; N. Greene, thesis 1995, chapter 5",
  moments: [
    ["A cube of the octree is tested: is it hidden?", { name: "cubes tested",
      pick: "largest" }],
    ["A cube is hidden, with all faces in it", { name: "cubes culled", pick: "largest" }],
    ["A polygon is compared with a cell", { name: "polygons against cells",
      pick: "largest" }],
    ["A polygon is farther than all that is seen in the cell", { name: "polygons farther",
      pick: "largest" }],
    ["A cell is covered: what comes later can be hidden by that",
      { name: "covering structures", pick: "largest" }],
    ["A polygon is stored in a leaf", { name: "polygons stored", pick: "largest" }],
    ["A leaf is bounded", { name: "cells bounded", pick: "largest" }],
    ["Two polygons in a cell: the mean is exact", { name: "exact cells of two",
      pick: "largest" }],
    ["An interval is too wide: the cell is divided", { name: "cells refined",
      pick: "largest" }],
    ["A pixel is written", { name: "pixels", nth: 3 }],
  ],
  find: ["How many cells had to be divided in the second pass, for each pixel?", (run) =>
    perEach(run, "cells refined", "pixels")],
};
