// SPDX-License-Identifier: GPL-3.0-or-later
// Regions of the visible faces. A region is filled but for its holes.
import { colourOf } from "../data/kinds.js";
import { partsPainting, PROGRESS } from "./shared/parts.js";

function draw({ run, context, line }, parts) {
  for (const [face, cycles] of parts) {
    const path = new Path2D();
    for (const sides of cycles) {
      sides.forEach(([, , , x, y], k) =>
        k ? path.lineTo(x, y) : path.moveTo(x, y));
      path.closePath();
    }
    context.fillStyle = run.header.faces[face][2];
    context.fill(path, "evenodd");
    context.strokeStyle = colourOf("--paper");
    context.lineWidth = line(0.5);
    context.stroke(path);
  }
}

export const polygons = { name: "polygons", progress: PROGRESS, draw, hasShapes: true,
  painting: (run) => partsPainting(run, (parts) => parts.map(String).sort()) };
