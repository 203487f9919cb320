// SPDX-License-Identifier: GPL-3.0-or-later
// The looks of windows, rows and samples, of buckets, and of a segment that is halved.
import { hasOutcome } from "../data/run.js";
import { searchAt } from "../data/stretches.js";

const rectangle = (x, y, width, height) =>
  [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];

// Whether the algorithm goes from window to window, and not from scan line to scan line.
export const isByWindows = (run) => run.counterOf("subdivision") >= 0;

// The window of a step, unless that is the whole picture and nothing is asked of it.
export function windowLook(run, e) {
  const w = e.window;
  if (!w || hasOutcome(e, "first-row")) return [];
  const isWhole = w.width >= run.width && w.height >= run.height;
  if (isWhole && e.a.kind !== "window" && e.b.kind !== "window") return [];
  const shapes = [];
  if (w.height === 1 && w.width < run.width && !isByWindows(run)) // its row
    shapes.push({ points: rectangle(0, w.y, run.width, 1), closed: true, width: 0,
      fill: 0.13 });
  const box = { points: rectangle(w.x, w.y, w.width, w.height), closed: true,
    width: e.kind === "accept" ? 3 : 2, dashed: e.kind === "retire",
    isSmall: w.width * w.height === 1 };
  return [...shapes, box, ...signs(e, w)];
}

// A cross for four quarters, a stroke for what is rejected.
function signs({ kind }, { x, y, width, height }) {
  const stroke = (...points) => ({ points, width: 2 });
  if (kind === "subdivide" && height > 1)
    return [stroke([x + width / 2, y], [x + width / 2, y + height]),
      stroke([x, y + height / 2], [x + width, y + height / 2])];
  return kind === "reject" ? [stroke([x, y], [x + width, y + height])] : [];
}

// The bucket that a thing is put into: the scan line where it begins.
export function bucketLook(run, e) {
  if (!hasOutcome(e, "first-row")) return [];
  const { ids: [p, q] } = e.a;
  const points = e.a.kind === "edge"
    ? [run.header.vertices[p], run.header.vertices[q]].filter(Boolean)
    : run.header.faces[p]?.[4] ?? [];
  if (!points.length) return [];
  const top = e.window?.y ?? Math.ceil(Math.min(...points.map(([, y]) => y)) - 0.5);
  const row = Math.max(0, Math.min(run.height - 1, top));
  return [{ points: rectangle(0, row, run.width, 1), closed: true, width: 1,
    fill: 0.4 }];
}

const REACH = 0.05; // of the picture's height: how far the line goes

// A segment that a logarithmic search divides: a dashed line at its midpoint, and the
// half that is kept.
export function halvedLook(run, e) {
  if (e.counter.key !== "depth-division" || !e.window) return [];
  const half = searchAt(run, e.k)?.half;
  if (!half) return [];
  const y = e.window.y, reach = REACH * run.height;
  const line = { points: [[half.middle, y - reach], [half.middle, y + 1 + reach]],
    width: 2.5, dashed: true, role: "ink" };
  return half.kept ? [{ points: rectangle(half.kept[0], y, half.kept[1] + 1 - half.kept[0],
    1), closed: true, width: 1, fill: 0.9, role: "ink" }, line] : [line];
}
