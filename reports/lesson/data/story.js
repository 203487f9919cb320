// SPDX-License-Identifier: GPL-3.0-or-later
// The story of a sample: the events that decided it, in order. An event belongs
// to it if its window holds the sample. One without a window, or with the whole
// picture as its window, belongs to it if all faces that it names lie over the
// sample. So do comparisons elsewhere in a span that holds the sample, if they
// decided the span, and what led to the division of a piece over the sample.
// `own` are those of them that are about the sample itself: not those that sort
// edges of its whole row or of the picture.
import { facesOf, NONE } from "./run.js";

export function sampleStory(run, place) {
  const { trace, width: m, height: n } = run;
  const { x, y, width, height, counter } = trace;
  const { i, j } = place;
  const over = facesOver(run, i + 0.5, j + 0.5);
  const accepts = run.header.counters.map((c) => c.kind === "accept");
  const inRows = countersWithWindows(trace);
  const decided = [limitsOf(run, place), divisionsOf(run, place)];
  const events = [], own = [];
  let row = NONE; // of the last event that is about one
  for (let k = 0; k < trace.kept; k++) {
    if (height[k] === 1) row = y[k];
    const wide = !width[k] || (x[k] <= 0 && y[k] <= 0 &&
      x[k] + width[k] >= m && y[k] + height[k] >= n);
    const holds = width[k] && holdsSample(trace, k, place);
    const led = decided.some((these) => these.has(k));
    const elsewhere = !width[k] && inRows.has(counter[k]) && row !== j;
    if (led || (wide && !accepts[counter[k]]
      ? !elsewhere && isOver(run, k, over, holds) : holds)) {
      events.push(k);
      if (led || accepts[counter[k]] || (holds && width[k] < m) ||
          isOver(run, k, over, false, true)) own.push(k);
    }
  }
  return { events, own, place: `column ${i}, row ${j}`, end: "" };
}

const holdsSample = ({ x, y, width, height }, k, { i, j }) =>
  i >= x[k] && i < x[k] + width[k] && j >= y[k] && j < y[k] + height[k];

// An event of these without a window is about no sample of its row.
function countersWithWindows({ counter, width, height }) {
  const found = new Set();
  for (let k = 0; k < counter.length; k++)
    if (height[k] === 1 && width[k]) found.add(counter[k]);
  return found;
}

// Where depths are compared at the limits of a span, or where it is to be
// divided, these comparisons decide all of its samples: the comparisons of two
// faces at single samples of those spans that hold the sample.
function limitsOf(run, place) {
  const { trace, header } = run;
  const { x, y, width, height, counter } = trace;
  const deep = header.counters.map(({ kind, a, b }) => kind === "compare" &&
    a === "face" && b === "face");
  const bounds = header.counters.map(({ kind, a, b }) => kind === "accept" ||
    (kind === "subdivide" && a === "face" && b === "face"));
  const found = new Set();
  let left = Infinity, right = -Infinity, last = NONE;
  for (let k = 0; k < trace.kept; k++) {
    if (!bounds[counter[k]] || height[k] !== 1 || !holdsSample(trace, k, place))
      continue;
    left = Math.min(left, x[k]);
    right = Math.max(right, x[k] + width[k]);
    last = k;
  }
  for (let k = 0; k < last; k++)
    if (deep[counter[k]] && y[k] === place.j && width[k] === 1 &&
        height[k] === 1 && x[k] >= left && x[k] < right) found.add(k);
  return found;
}

// The divisions of pieces over the sample, and what led to them since the piece
// before was painted or divided: the comparisons and interchanges of the pieces
// that are in a circle.
function divisionsOf(run, { i, j }) {
  const { trace, header } = run;
  const kinds = header.counters.map(({ kind }) => kind);
  const found = new Set();
  for (let k = 0, begin = 0; k < trace.kept; k++) {
    const kind = kinds[trace.counter[k]];
    if (kind === "split" && isPieceOver(run, k, i + 0.5, j + 0.5)) {
      const circle = new Set(run.facesOf(k));
      for (let e = begin; e < k; e++)
        if (kinds[trace.counter[e]] === "sort")
          run.facesOf(e).forEach((f) => circle.add(f));
      for (let e = begin; e <= k; e++)
        if (run.facesOf(e).every((f) => circle.has(f)) &&
            (trace.height[e] !== 1 || trace.y[e] === j)) found.add(e);
    }
    if (/split|span|accept/.test(kind) || (kind === "sort" && begin === k))
      begin = k + 1; // halves are put back at once
  }
  return found;
}

function isPieceOver(run, k, x, y) {
  const { a } = run.event(k);
  return a.kind === "piece" && isInside(run.outline(k, a.ids[1], a.ids[0]) ??
    run.header.faces[a.ids[0]][4], x, y);
}

function isOver(run, k, over, holds, withoutEdges = false) {
  const { a, b } = run.event(k);
  if (withoutEdges && (/edge/.test(a.kind) || /edge/.test(b.kind))) return false;
  const faces = [...facesOf(a), ...facesOf(b)];
  if (faces.length) return faces.every((f) => over.has(f));
  return holds && (a.kind === "window" || b.kind === "window");
}

// The faces whose image holds the point.
function facesOver(run, x, y) {
  return new Set(run.header.faces.filter(([, , , , polygon]) =>
    isInside(polygon, x, y)).map(([id]) => id));
}

function isInside(polygon, x, y) {
  let inside = false;
  for (let k = 0, l = polygon.length - 1; k < polygon.length; l = k++) {
    const [xk, yk] = polygon[k], [xl, yl] = polygon[l];
    if ((yk > y) !== (yl > y) && x < (xl - xk) * (y - yk) / (yl - yk) + xk)
      inside = !inside;
  }
  return inside;
}
