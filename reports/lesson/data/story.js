// SPDX-License-Identifier: GPL-3.0-or-later
// The story of a sample: the events that decided it, in order. An event belongs
// to it if its window holds the sample. One without a window, or with the whole
// picture as its window, belongs to it if all faces that it names lie over the
// sample. `own` are those of them that are about the sample itself: not those
// that sort edges of its whole row or of the picture. In a line drawing, it is the
// story of the edge that passes closest.
import { facesOf, NONE } from "./run.js";

export function storyOf(run, place) {
  return run.kind === "segments" ? edgeStory(run, place)
    : sampleStory(run, place);
}

function sampleStory(run, { i, j }) {
  const { trace, width: m, height: n } = run;
  const { x, y, width, height } = trace;
  const over = facesOver(run, i + 0.5, j + 0.5);
  const accepts = run.header.counters.map((c) => c.kind === "accept");
  const events = [], own = [];
  for (let k = 0; k < trace.kept; k++) {
    const wide = !width[k] || (x[k] <= 0 && y[k] <= 0 &&
      x[k] + width[k] >= m && y[k] + height[k] >= n);
    const holds = width[k] && i >= x[k] && i < x[k] + width[k] &&
      j >= y[k] && j < y[k] + height[k];
    if (wide && !accepts[trace.counter[k]] ? isOver(run, k, over, holds) : holds) {
      events.push(k);
      if (accepts[trace.counter[k]] || (holds && width[k] < m) ||
          isOver(run, k, over, false, true)) own.push(k);
    }
  }
  const face = run.kind === "ids"
    ? Math.max(run.painting.at(run.n)[j * m + i], NONE) : NONE;
  return { events, own, place: `column ${i}, row ${j}`,
    end: run.kind !== "ids" ? "" : face === NONE
      ? "Nothing is seen here but the background."
      : `Seen here in the end: ${run.faceName(face)}.`, face };
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
  const over = new Set();
  run.header.faces.forEach(([id, , , , polygon]) => {
    let inside = false;
    for (let k = 0, l = polygon.length - 1; k < polygon.length; l = k++) {
      const [xk, yk] = polygon[k], [xl, yl] = polygon[l];
      if ((yk > y) !== (yl > y) && x < (xl - xk) * (y - yk) / (yl - yk) + xk)
        inside = !inside;
    }
    if (inside) over.add(id);
  });
  return over;
}

// --- Edges ---

const keyOf = ({ kind, ids }) => kind === "edge" && ids[0] >= 0
  ? `${Math.min(ids[0], ids[1])},${Math.max(ids[0], ids[1])}`
  : kind === "implied edge" ? `implied ${ids}` : null;

function distance([px, py], [ax, ay], [bx, by]) {
  const dx = bx - ax, dy = by - ay;
  const t = Math.max(0, Math.min(1,
    ((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(px - ax - t * dx, py - ay - t * dy);
}

// The edge, of those that were drawn or asked about, closest to the sample.
function closestEdge(run, point) {
  let best = null, least = Infinity;
  const offer = (key, from, to, k) => {
    if (!key || !from || !to) return;
    const d = distance(point, from, to);
    if (d < least) { least = d; best = key; }
  };
  const known = new Set();
  for (let k = 0; k < run.trace.kept; k++) {
    const { a } = run.event(k);
    const key = keyOf(a);
    if (!key || known.has(key) || a.kind !== "edge") continue;
    known.add(key);
    offer(key, run.header.vertices[a.ids[0]], run.header.vertices[a.ids[1]]);
  }
  return best;
}

function edgeStory(run, { i, j }) {
  const edge = closestEdge(run, [i + 0.5, j + 0.5]);
  const events = [];
  let drawn = 0;
  for (let k = 0; edge && k < run.trace.kept; k++) {
    const e = run.event(k);
    if (keyOf(e.a) !== edge) continue;
    events.push(k);
    if (e.kind === "accept" && e.part?.[1] === 0) drawn += 1;
  }
  return { events, own: events,
    place: edge ? `edge ${edge.replace(",", "–")}` : "no edge",
    end: drawn ? `Of this edge, ${drawn === 1 ? "one interval is"
      : `${drawn} intervals are`} visible.` : "No part of this edge is visible." };
}
