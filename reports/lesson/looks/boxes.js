// SPDX-License-Identifier: GPL-3.0-or-later
// The boxes that minimax tests compare: around the images of both subjects.
import { hasOutcome } from "../data/run.js";
import { facesOfVolume } from "./solids.js";

export function boxLooks(run, e) {
  if (!hasOutcome(e, "boxes")) return [];
  return [e.a, e.b].map((s) => boxOf(run, e, s)).filter(Boolean)
    .map(({ x0, y0, x1, y1 }, k) => ({ closed: true, width: 1.2, role: "ink",
      dashed: k === 1, points: [[x0, y0], [x1, y0], [x1, y1], [x0, y1]] }));
}

// The box around the image of a subject; null: it is not known.
export function boxOf(run, e, subject) {
  const points = pointsOf(run, e, subject);
  if (!points.length) return null;
  const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (const [x, y] of points) {
    box.x0 = Math.min(box.x0, x);
    box.y0 = Math.min(box.y0, y);
    box.x1 = Math.max(box.x1, x);
    box.y1 = Math.max(box.y1, y);
  }
  return box;
}

function pointsOf(run, e, { kind, ids: [p, q] }) {
  const { faces, vertices } = run.header;
  if (kind === "edge") return [vertices[p], vertices[q]].filter(Boolean);
  if (kind === "face") return faces[p]?.[4] ?? [];
  if (kind === "piece") return run.outline(e.k, q, p) ?? faces[p]?.[4] ?? [];
  if (kind === "volume") return (facesOfVolume(run, e, p) ?? [])
    .flatMap((f) => faces[f]?.[4] ?? []);
  return [];
}
