// SPDX-License-Identifier: GPL-3.0-or-later
// The drawing on which the reader decides: the outlines of faces, samples, and what
// is painted so far.
import { colourOf } from "../../lesson/data/kinds.js";
import { projection } from "../../lesson/data/projection.js";
import { h } from "../../page/parts/dom.js";
import { M, N } from "./over.js";

// The name of the k-th of sixteen colours: those of the page, and paler ones (lab.css).
const HUES = 16;
export const hue = (k) => `--hue-${k % HUES}`;

// polygons: of each face the corners in the world.
export function board(polygons, camera, label) {
  const canvas = h("canvas", { class: "board-canvas", role: "img",
    "aria-label": label });
  const context = canvas.getContext("2d");

  // { painted: a colour for each sample, or null; strong: Map face -> colour name;
  //   filled: Set of faces; sample: { i, j }; bad: samples that are wrong }
  const draw = ({ painted, strong = new Map(), filled = new Set(), sample, bad }) => {
    const dots = Math.min(2, globalThis.devicePixelRatio || 1);
    canvas.width = Math.max(1, canvas.clientWidth * dots);
    canvas.height = Math.round(canvas.width * N / M);
    const unit = canvas.width / M;
    const see = projection({ ...camera, width: canvas.width, height: canvas.height });
    context.lineJoin = "round";
    context.fillStyle = colourOf("--paper");
    context.fillRect(0, 0, canvas.width, canvas.height);
    painted?.forEach((colour, k) => {
      if (!colour) return;
      context.fillStyle = colour;
      context.fillRect(k % M * unit, Math.floor(k / M) * unit, unit + 0.5, unit + 0.5);
    });
    const pathOf = (points) => {
      const at = points.map(see), path = new Path2D();
      if (at.some((p) => !p)) return null;
      at.forEach(([x, y], k) => k ? path.lineTo(x, y) : path.moveTo(x, y));
      path.closePath();
      return path;
    };
    for (const [face, points] of polygons) {
      const path = pathOf(points), colour = strong.get(face);
      if (!path) continue;
      if (filled.has(face)) {
        context.globalAlpha = 0.25;
        context.fillStyle = colourOf(colour ?? "--ink");
        context.fill(path);
        context.globalAlpha = 1;
      }
      context.lineWidth = (colour ? 2.4 : 0.7) * dots;
      context.globalAlpha = colour ? 1 : 0.4;
      context.strokeStyle = colourOf(colour ?? "--ink");
      context.stroke(path);
      context.globalAlpha = 1;
    }
    for (const k of bad ?? []) {
      context.fillStyle = colourOf("--bad");
      const r = Math.max(2 * dots, unit / 3);
      context.fillRect((k % M + 0.5) * unit - r / 2,
        (Math.floor(k / M) + 0.5) * unit - r / 2, r, r);
    }
    if (sample) mark((sample.i + 0.5) * unit, (sample.j + 0.5) * unit, dots);
  };

  const mark = (x, y, dots) => {
    for (const [colour, width] of [["--paper", 6], ["--ink", 2.5]]) {
      context.strokeStyle = colourOf(colour);
      context.lineWidth = width * dots;
      context.beginPath();
      context.arc(x, y, 9 * dots, 0, 2 * Math.PI);
      context.moveTo(x + 2 * dots, y);
      context.arc(x, y, 2 * dots, 0, 2 * Math.PI);
      context.stroke();
    }
  };
  return { canvas, draw };
}
