// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the field that outlines and sentences use: [word, what it means, how it
// is found in a text].
import { h } from "../../page/parts/dom.js";

export const GLOSSARY = [
  ["back face", "a face whose back is turned to the eye; a solid hides it",
    /back[ -](face|edge)/i],
  ["bead", "a stretch of a scan line that shows one face", /\bbeads?\b/],
  ["body", "all faces that hang together", /\bbod(y|ies)\b/],
  ["box", "the smallest rectangle, with its sides along rows and columns, around an image",
    /\bbox(es)?\b/],
  ["BSP tree", "a tree of planes; each divides what is before it from what is behind",
    /\bBSP\b|\bthe tree\b/],
  ["bubble sort", "neighbors that are out of order change places until none are",
    /bubble sort/],
  ["bucket", "a list of all things with the same place, such as the first scan line",
    /\bbuckets?\b/],
  ["circle", "pieces each of which may obscure the next, and the last the first: they have " +
    "no order", /\bcircle\b/],
  ["clip polygon", "the polygon along whose border all others are cut", /clip polygon/],
  ["cluster", "faces whose order is known from every eye", /\bclusters?\b/],
  ["concave, convex", "a convex face or solid has no dent: it lies on one side of the line or " +
    "plane of each of its sides; a concave one has a dent", /conca|convex/],
  ["contour edge", "an edge between a front face and a back face",
    /contour|boundary edge/],
  ["critical surrounder", "the nearest of the window’s surrounders",
    /critical surrounder/],
  ["crossing", "where the images of two edges cross", /\bcrossings?\b/],
  ["cull", "to leave out what cannot be seen, before more is asked", /\bcull/],
  ["cull box", "the rectangle of the picture that is seen through the portals passed so far",
    /cull box/],
  ["depth", "how far a point is from the eye, along the line of sight", /\bdepth/],
  ["disjoint", "a face is disjoint from a window if no part of it is in the window",
    /disjoint/],
  ["footprint", "the pixels that a splat covers", /footprint/],
  ["fragment", "a part of an edge that is still to be compared; in the A-buffer: what a face " +
    "covers of a pixel", /\bfragments?\b/],
  ["front face", "a face whose front is turned to the eye", /front[ -]face/i],
  ["frustum", "all that is in view: the pyramid of sight", /frustum/],
  ["homogeneous", "the same everywhere: one face is seen in all of it, or none",
    /homogeneous/],
  ["image", "what a thing looks like on the screen", /\bimages?\b/],
  ["inherit", "to keep for a smaller window what is known of the larger one",
    /inherit/],
  ["intercept", "where an edge crosses the scan line", /\bintercepts?\b/],
  ["intersecter", "a face that covers a part of the window", /intersecter/],
  ["interval", "a part of an edge that is hidden by the same number of faces",
    /\bintervals?\b/],
  ["invisibility correction", "where two edges meet in a corner, faces at the corner may hide " +
    "one of them and not the other: the number at its end is corrected for these",
    /invisibility correction/],
  ["leaf", "a node of a tree that is not divided", /\blea(f|ves)\b/],
  ["linear programme", "the search for a place that meets several conditions at once, " +
    "each on one side of a plane", /linear programme/],
  ["logarithmic search", "halves a thing again and again, and keeps the half with what is " +
    "looked for", /logarithmic/],
  ["marker", "a sign that a piece was moved since a piece was last painted or divided; to " +
    "move it again would be a circle",
    /\bmarker\b/],
  ["mask", "a word with a bit for each cell of a small grid", /\bmasks?\b/],
  ["W, A, Cv, Pc, Pv, Cc", "masks of cells. Cv: vacant so far. Cc: covered so far. Pc: " +
    "covered by the polygon. Pv: outside of the polygon. W = Cv & Pc: to be written " +
    "now. A = ~(W | Pv | Cc): all others, to be divided", /\bCv\b|bit in [AW]\b|W is/],
  ["minimax test", "are the boxes around two images apart?", /minimax/],
  ["L, R", "where the left and right edges of a face cross the scan line",
    /\bL < 0|max L/],
  ["midpoint", "the place half way along a segment: the mean of its ends", /midpoint/],
  ["nature", "the set of faces that hide the edge", /\bnature\b/],
  ["obscure", "to hide from the eye", /\bobscures?\b/],
  ["octree", "a cube divided into eight cubes, and these again", /octree|octant/i],
  ["penetrate", "two faces penetrate where they pass through each other", /penetrate/],
  ["piece", "a face or an edge, or what is left of one that was divided",
    /\bpieces?\b/],
  ["P, Q", "P: the piece that is to be painted next. Q: one that comes after it in the list",
    /\bP may\b|\bP's plane/],
  ["plane of a face", "it goes on beyond the face without end. Before it: on the eye’s side. " +
    "Beyond it: on the other", /\bplane\b/],
  ["{Q}", "all pieces after P in the list, up to the first that is wholly nearer than P",
    /\{Q\}|each Q/],
  ["portal", "an opening between two cells of a building", /\bportals?\b/],
  ["priority", "what hides what: of two faces, the one with the higher priority is " +
    "shown", /priority/],
  ["pyramid", "a picture, and above it pictures of half the size, each entry for four " +
    "below", /pyramid/],
  ["quadtree", "a square divided into four squares, and these again", /quad ?tree/],
  ["quantitative invisibility", "of a point of an edge: how many faces hide it; where it " +
    "is 0, the edge is visible", /invisibility/],
  ["raster element", "a sample of the picture", /raster element/],
  ["relevant", "what is left after the culls", /\brelevant\b/],
  ["scan line", "a row of samples", /scan line/],
  ["segment", "the part of a scan line that a face covers", /\bsegments?\b/],
  ["separating plane", "a plane between clusters, with none on both of its sides",
    /separating plane/],
  ["span", "a stretch of a scan line that is looked at as a whole", /\bspans?\b/],
  ["splat", "what a sample of a grid gives to the pixels around its image", /\bsplats?\b/],
  ["surround test", "is a point inside of the outline of a face?", /surround test/],
  ["surrounder", "a face that covers all of the window", /surrounder/],
  ["texel", "an element of a texture", /\btexels?\b/],
  ["visible bit", "a bit of each face: is the place between its two edges? It is set " +
    "for hidden faces, too",
    /visible bit/],
  ["vertex", "a corner of a face", /\bvert(ex|ices)\b/],
  ["volume", "a convex solid: all that is inside of its planes",
    /(?<!bounding )\bvolumes?\b/],
  ["vorticity", "the sense in which a side turns about a point: if it is the same for all " +
    "sides of a triangle, the point is inside", /vorticit/],
  ["voxel", "a small cube of space, an element of a volume", /\bvoxels?\b/],
  ["Warnock special", "the survey’s name for the tests of a face against a window",
    /Warnock special/],
  ["window", "a rectangle of the picture", /\bwindows?\b/],
  ["X occupied table, Y occupied table", "the faces that are at this column of the line; the " +
    "faces that this line crosses", /occupied table/],
  ["X sort, Y sort, Z sort", "a sort by column, by row, by depth", /\b[XYZ] sort\b/],
];

const SHOWN = 3; // terms at most below an outline

// The words of a text that want to be explained, as elements.
export const glossed = (text) => explained(GLOSSARY.filter(([, , pattern]) =>
  pattern.test(text)).slice(0, SHOWN));

export const explained = (all) => all.map(([word, meaning]) => h("span", {},
  h("b", {}, word), `: ${meaning}. `));
