// SPDX-License-Identifier: GPL-3.0-or-later
// The scan line at hand, or the one through the middle of the window, from above: the
// segments of its faces, the eye below; what the step compares, and its span.
import { colourOf, kindColour } from "../data/kinds.js";
import { closeness, segmentsOn } from "../data/projection.js";
import { searchAt } from "../data/stretches.js";
import { isByWindows } from "../looks/windows.js";
import { board } from "./board.js";

const HIGH = 190; // of the canvas

// Algorithms that go along rows or from window to window, and compare depths there.
export const isFromAbove = (run) => (isByWindows(run) ||
  /^(YXZ|ZYX|YZX)$/.test(run.trace.order ?? "")) &&
  run.kind.holdsFaces && run.header.faces.every((f) => f[3].length);

export function rowFromAbove(run) {
  const { element, draw, say } = board("The row from above",
    "The row from above, the eye below");
  const near = closeness(run);
  const rows = new Map();
  const of = (j) => {
    if (!rows.has(j)) rows.set(j, segmentsOn(run, j, near).filter(({ x0, x1 }) =>
      x1 > 0 && x0 < run.width));
    return rows.get(j);
  };

  const show = (k, e) => {
    const w = e?.window;
    const isShown = w && (w.height === 1 || isByWindows(run));
    element.hidden = !isShown;
    if (!isShown) return;
    const j = w.y + (w.height >> 1), own = of(j);
    const middle = w.height > 1 ? ", through the middle of the window" : "";
    say(own.length ? `Row ${j}${middle}: ${own.length} ${own.length === 1 ? "segment"
      : "segments"}` : `Row ${j}${middle} meets no face.`);
    draw(HIGH, (context, width) => drawRow(context, run, own, { width, e }));
  };
  return { element, show };
}

function drawRow(context, run, segments, { width, e }) {
  const px = (x) => x / run.width * width;
  const z = segments.flatMap(({ z0, z1 }) => [z0, z1]);
  const [low, high] = [Math.min(...z), Math.max(...z)];
  const py = (value) => 14 + (HIGH - 40) *
    (high > low ? (value - low) / (high - low) : 0.5);
  const w = e.window;
  context.fillStyle = kindColour(e.kind);
  context.globalAlpha = 0.13;
  context.fillRect(px(w.x), 0, Math.max(2, px(w.x + w.width) - px(w.x)), HIGH - 12);
  context.globalAlpha = 1;
  for (const g of segments) drawSegment(context, run, g, { px, py, e });
  drawStretches(context, run, e, { px, py });
  drawPlaces(context, run, e, px);
  context.fillStyle = colourOf("--faint");
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "left";
  context.fillText("near", 0, HIGH - 16);
  context.fillText("far", 0, 10);
}

function drawSegment(context, run, g, { px, py, e }) {
  const names = (s) => /face|piece/.test(s.kind) && s.ids[0] === g.face;
  const [isA, isB] = [names(e.a), names(e.b)];
  const stroke = (colour, size, dash = []) => {
    context.strokeStyle = colour;
    context.lineWidth = size;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(px(g.x0), py(g.z0));
    context.lineTo(px(g.x1), py(g.z1));
    context.stroke();
    context.setLineDash([]);
  };
  if (isA || isB) stroke(kindColour(e.kind), 8, isA ? [] : [6, 4]);
  stroke(colourOf("--paper"), 5);
  stroke(run.header.faces[g.face][2], 3.5);
}

// The stretches that a logarithmic search compares, between their ends; where one is
// divided, a dashed line at its midpoint, and a bar under the half that is kept.
function drawStretches(context, run, e, { px, py }) {
  const found = searchAt(run, e.k);
  if (!found) return;
  const { two, half } = found;
  context.fillStyle = colourOf("--ink");
  const tick = (x, y, high) => context.fillRect(px(x) - 1, py(y) - high, 2, 2 * high);
  for (const { x0, x1, q0, q1 } of two) {
    tick(x0 + 0.5, q0, 6);
    tick(x1 + 0.5, q1, 6);
  }
  if (!half) return;
  stroke(context, [px(half.middle), 0], [px(half.middle), HIGH - 12], [5, 4]);
  if (!half.kept) return;
  const [from, to] = half.kept.map((x) => px(x + 0.5));
  stroke(context, [from, HIGH - 13], [to, HIGH - 13], []);
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "center";
  context.fillText("kept", (from + to) / 2, HIGH - 18);
}

function stroke(context, from, to, dash) {
  context.strokeStyle = colourOf("--ink");
  context.lineWidth = 2.5;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
  context.setLineDash([]);
}

// Where the edges of the step cross the row.
function drawPlaces(context, run, e, px) {
  [e.a, e.b].forEach(({ kind, ids: [p, q] }, k) => {
    const [from, to] = [run.header.vertices[p], run.header.vertices[q]];
    if (kind !== "edge" || !from || !to || from[1] === to[1]) return;
    const t = (e.window.y + 0.5 - from[1]) / (to[1] - from[1]);
    const x = px(from[0] + t * (to[0] - from[0]));
    context.strokeStyle = kindColour(e.kind);
    context.lineWidth = 2.5;
    context.setLineDash(k ? [5, 4] : []);
    context.beginPath();
    context.moveTo(x, 0);
    context.lineTo(x, HIGH - 12);
    context.stroke();
    context.setLineDash([]);
  });
}
