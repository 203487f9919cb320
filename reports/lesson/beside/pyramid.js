// SPDX-License-Identifier: GPL-3.0-or-later
// The pyramid, with a square for each of its cells.
import { colourOf, kindColour } from "../data/kinds.js";
import { board } from "./board.js";

export function pyramidCells(run) {
  const { pyramid } = run;
  const { element, draw, say } = board("The pyramid", "The pyramid’s cells");
  const { levels } = pyramid;
  const GAP = 12;

  const show = (k, e) => {
    const touched = pyramid.touched(k);
    const which = e && pyramid.of(e.number);
    const cell = which ? pyramid.cellOf(e.k, which) : null;
    const at = cell ? pyramid.placeOf(cell[0]) : -1;
    const most = touched.map((level) => level.reduce((a, b) => Math.max(a, b), 1));
    say(at < 0 ? "The more often a cell was asked about, the darker it is."
      : `Asked now: a cell of ${levels[at].size} × ${levels[at].size} samples, at ${
        cell[1]}, ${cell[2]} of ${levels[at].across} × ${levels[at].down}`);
    // As many levels in a row as fit at a size that can be seen.
    const wide = Math.max(120, element.clientWidth);
    const fit = Math.min(levels.length, Math.max(2, Math.floor(wide / 110)));
    const side = Math.min(150, (wide - GAP * (fit - 1)) / fit);
    const tall = side * run.height / run.width;
    const rows = Math.ceil(levels.length / fit);
    draw(rows * (tall + 22), (context) => levels.forEach((level, p) => {
      const x = p % fit * (side + GAP), y = Math.floor(p / fit) * (tall + 22);
      const unit = side * level.size / run.width;
      context.fillStyle = kindColour("compare");
      touched[p].forEach((n, c) => {
        if (!n) return;
        context.globalAlpha = 0.15 + 0.75 * Math.log(1 + n) / Math.log(1 + most[p]);
        fillCell(context, x, y, unit, c % level.across,
          Math.floor(c / level.across), side, tall);
      });
      context.globalAlpha = 1;
      context.strokeStyle = colourOf("--line");
      context.lineWidth = 1;
      context.strokeRect(x + 0.5, y + 0.5, side - 1, tall - 1);
      if (at === p) {
        context.strokeStyle = colourOf("--ink");
        context.lineWidth = 2;
        const w = Math.max(unit, 4);
        context.strokeRect(x + cell[1] * unit + (unit - w) / 2,
          y + cell[2] * unit + (unit - w) / 2, w, w);
      }
      context.fillStyle = colourOf("--faint");
      context.font = "11px system-ui, sans-serif";
      context.textAlign = "left";
      context.textBaseline = "alphabetic";
      context.fillText(`${level.across} × ${level.down}`, x, y + tall + 14);
    }));
  };
  return { element, show };
}

function fillCell(context, x, y, unit, i, j, side, tall) {
  context.fillRect(x + i * unit, y + j * unit,
    Math.min(unit, side - i * unit), Math.min(unit, tall - j * unit));
}
