// SPDX-License-Identifier: GPL-3.0-or-later
// The priority list as a strip.
import { colourOf, kindColour } from "../data/kinds.js";
import { whole } from "../../page/data/format.js";
import { board } from "./board.js";

const MANY = 240; // items; of more, no numbers are shown

export function listStrip(run) {
  const { element, draw, say, width } = board("The list",
    `${run.list.title}${run.list.ofPieces ? "; numbers of pieces" : ""}`);
  const same = (item, s) => s && (s.kind === "piece"
    ? item.piece === s.ids[1] && item.face === s.ids[0]
    : s.kind === "face" && item.piece === null && item.face === s.ids[0]);

  const show = (k, e) => {
    const { painted, order, marked, sorting } = run.list.at(k);
    const items = [...painted, ...order];
    const [w, high] = items.length > MANY ? [7, 9] : [36, 18];
    const across = Math.max(1, Math.floor(width() / w));
    const rows = Math.max(1, Math.ceil(items.length / across));
    say(sorting ? "It is being sorted." : !items.length ? "It is still empty."
      : !order.length ? `${whole(painted.length)} in the order in which they come`
        : `${whole(painted.length)} done (without colour), ${whole(order.length)
        } to come; next: ${nameOf(run, order[0])}${marked.size
          ? "; a filled corner is a marker" : ""}`);
    draw(rows * (high + 2), (context, wide) => {
      const fit = Math.max(1, Math.floor(wide / w));
      context.font = "11px system-ui, sans-serif";
      context.textAlign = "center";
      context.textBaseline = "middle";
      items.forEach((item, n) => {
        const x = n % fit * w, y = Math.floor(n / fit) * (high + 2);
        drawItem(context, item, { x, y, w: w - 2, h: high },
          n < painted.length && order.length > 0);
        const isP = e && same(item, e.a), isQ = e && same(item, e.b);
        if (isP || isQ) drawFrame(context, { x, y, w: w - 2, h: high },
          kindColour(e.kind), isP ? [] : [4, 3]);
        if (marked.has(item.piece)) drawMarker(context, x + w - 2, y);
      });
      if (painted.length && order.length) { // where painting is
        const n = painted.length;
        context.fillStyle = colourOf("--ink");
        context.fillRect(n % fit * w - 2, Math.floor(n / fit) * (high + 2), 2, high);
      }
    });
  };

  const drawItem = (context, item, box, isDone) => {
    const colour = run.header.faces[item.face]?.[2] ?? "#888888";
    const strip = isDone ? 3 : box.h;
    context.fillStyle = colour;
    context.fillRect(box.x, box.y + box.h - strip, box.w, strip);
    if (box.w > 20) {
      context.fillStyle = isDone ? colourOf("--ink")
        : isLight(colour) ? "#000" : "#fff";
      context.fillText(String(item.piece ?? item.face), box.x + box.w / 2,
        box.y + (box.h - (isDone ? strip : 0)) / 2 + 1);
    }
  };
  return { element, show };
}

function drawFrame(context, { x, y, w, h }, own, dash) {
  for (const [colour, line, dashes] of [[colourOf("--paper"), 6, []], [own, 3, dash]]) {
    context.strokeStyle = colour;
    context.lineWidth = line;
    context.setLineDash(dashes);
    context.strokeRect(x + 1, y + 1, w - 2, h - 2);
  }
  context.setLineDash([]);
}

// A filled corner, with a pale seam, over the frame of P or Q.
function drawMarker(context, x, y) {
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x - 10, y);
  context.lineTo(x, y + 10);
  context.closePath();
  context.strokeStyle = colourOf("--paper");
  context.lineWidth = 2;
  context.stroke();
  context.fillStyle = colourOf("--ink");
  context.fill();
}

const nameOf = (run, { face, piece }) => piece === null || !run.list.at
  ? run.faceName(face) : `piece ${piece} of ${run.faceName(face)}`;

function isLight(colour) {
  const [r, g, b] = [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
  return 0.3 * r + 0.59 * g + 0.11 * b > 140;
}
