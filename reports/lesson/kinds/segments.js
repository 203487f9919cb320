// SPDX-License-Identifier: GPL-3.0-or-later
// A line drawing: edges in intervals, each hidden by so many faces. Places of a part:
// edge, invisibility, t0, t1, from, to, and the images of these two.
import { colourOf } from "../data/kinds.js";
import { edgeStrip } from "../parts/edge_strip.js";
import { partsPainting, PROGRESS } from "./shared/parts.js";

// --- The drawing ---

// An interval that goes on where the last one of its edge ended, with the same
// invisibility, lengthens that one.
function joined(parts) {
  const out = [];
  for (const [edge, invisibility, t0, t1] of parts) {
    const last = out.at(-1);
    if (last && last.key === String(edge) && last.t1 === t0 &&
        last.invisibility === invisibility) last.t1 = t1;
    else out.push({ key: String(edge), invisibility, t0, t1 });
  }
  return out.map((s) => `${s.key} ${s.invisibility} ${s.t0} ${s.t1}`).sort();
}

function draw({ context, line }, parts) {
  const visible = new Path2D(), hidden = new Path2D();
  for (const [, invisibility, , , , , from, to] of parts) {
    if (!from || !to) continue;
    const path = invisibility ? hidden : visible;
    path.moveTo(...from);
    path.lineTo(...to);
  }
  context.strokeStyle = colourOf("--faint");
  context.globalAlpha = 0.5;
  context.setLineDash([2, 3].map(line));
  context.lineWidth = line(1);
  context.stroke(hidden);
  context.setLineDash([]);
  context.globalAlpha = 1;
  context.strokeStyle = colourOf("--ink");
  context.lineWidth = line(1.8);
  context.stroke(visible);
}

// --- The story of the edge that passes closest ---

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

function story(run, { i, j }) {
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

// --- All ---

export const segments = { name: "segments", progress: PROGRESS, draw, story,
  windows: "samples",
  painting: (run) => partsPainting(run, joined), strip: edgeStrip,
  hint: "Click an edge to read its story.", verb: "drawn",
  // Some algorithms know that a part is hidden, but not by how many faces. They say one.
  doneWith: (part) => part?.[1] ? "goes into the drawing as hidden" : null,
  partWords: ([, n]) => !n ? ": visible" : n > 1 ? `, behind ${n} faces` : "",
  partLine: ([, n, , , , , from, to]) =>
    from && to ? { points: [from, to], dashed: n > 0 } : null };
