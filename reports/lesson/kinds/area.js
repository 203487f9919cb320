// SPDX-License-Identifier: GPL-3.0-or-later
// Intervals that hold the integrals of red, green and blue over each pixel, of which
// the middles are shown.
import { ofChannels } from "./shared/channels.js";

const shown = (bounds) => [...[0, 2, 4].map((k) =>
  Math.min(65535, Math.max(0, 65535 * (bounds[k] + bounds[k + 1]) / 2))), 65535];

const DEEPEST = 20; // a cell of level k is 2^(k - 20) pixels wide

function squareOfCell([level, x, y]) {
  const side = 2 ** (level - DEEPEST);
  return { x: x * side, y: y * side, side };
}

function cellWords(ids) {
  const { x, y, side } = squareOfCell(ids);
  return side === 1 ? `the cell of pixel ${x}, ${y}`
    : side > 1 ? `the cell of ${side} × ${side} pixels at ${x}, ${y}`
      : `a cell 1/${1 / side} of a pixel wide at ${x.toFixed(2)}, ${y.toFixed(2)}`;
}

export const area = { ...ofChannels("area", { many: 6, shown }), windows: "pixels",
  squareOfCell, cellWords };
