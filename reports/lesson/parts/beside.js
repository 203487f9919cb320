// SPDX-License-Identifier: GPL-3.0-or-later
// Beside the scene: the priority list as a strip, the tree of planes, and the
// pyramid with a square for each of its cells. Each is a canvas with its words.
import { colourOf, kindColour } from "../data/kinds.js";
import { whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";

// What this run has of these; show(k, e) draws them all.
export function beside(run) {
  const all = [run.list && listStrip(run), run.tree && planeTree(run),
    run.pyramid && pyramidCells(run)].filter(Boolean);
  return { element: all.length ? h("div", { class: "beside-scene" },
    all.map(({ element }) => element)) : null,
  show: (k, e) => all.forEach((part) => part.show(k, e)) };
}

// A canvas as wide as its place, of `height` pixels; draw(context, width).
function board(label, title) {
  const canvas = h("canvas", { role: "img", "aria-label": label });
  const words = h("p", { class: "where" });
  const element = h("div", { class: "board" }, h("h3", {}, title), words, canvas);
  const draw = (height, paint) => {
    const dots = globalThis.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    if (!width) return;
    canvas.width = Math.round(width * dots);
    canvas.height = Math.round(height * dots);
    canvas.style.height = `${height}px`;
    const context = canvas.getContext("2d");
    context.setTransform(dots, 0, 0, dots, 0, 0);
    paint(context, width);
  };
  const say = (text) => {
    if (words.textContent !== text) words.textContent = text;
    canvas.setAttribute("aria-label", `${label}: ${text}`);
  };
  return { element, draw, say, width: () => canvas.clientWidth };
}

// --- The list ---

const MANY = 240; // items; of more, no numbers are shown

function listStrip(run) {
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
          n < painted.length && order.length > 0, marked.has(item.piece));
        const isP = e && same(item, e.a), isQ = e && same(item, e.b);
        if (!isP && !isQ) return;
        for (const [colour, line, dash] of [["--paper", 6, []],
          [null, 3, isP ? [] : [4, 3]]]) {
          context.strokeStyle = colour ? colourOf(colour) : kindColour(e.kind);
          context.lineWidth = line;
          context.setLineDash(dash);
          context.strokeRect(x + 1, y + 1, w - 4, high - 2);
        }
        context.setLineDash([]);
      });
      if (painted.length && order.length) { // where painting is
        const n = painted.length;
        context.fillStyle = colourOf("--ink");
        context.fillRect(n % fit * w - 2, Math.floor(n / fit) * (high + 2), 2, high);
      }
    });
  };

  const drawItem = (context, item, box, isDone, isMarked) => {
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
    if (!isMarked) return;
    context.fillStyle = colourOf("--ink");
    context.beginPath();
    context.moveTo(box.x + box.w, box.y);
    context.lineTo(box.x + box.w - 7, box.y);
    context.lineTo(box.x + box.w, box.y + 7);
    context.fill();
  };
  return { element, show };
}

const nameOf = (run, { face, piece }) => piece === null || !run.list.at
  ? run.faceName(face) : `piece ${piece} of ${run.faceName(face)}`;

function isLight(colour) {
  const [r, g, b] = [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
  return 0.3 * r + 0.59 * g + 0.11 * b > 140;
}

// --- The tree ---

function planeTree(run) {
  const { tree } = run;
  const { element, draw, say } = board("The tree of planes",
    run.trace.structure.clusters ? "The tree of separating planes"
      : tree.roots.length > 1 ? "The BSP trees of the cubes" : "The BSP tree");
  const height = Math.min(260, 26 + 22 * tree.depth);
  const SIDES = { front: "in front", behind: "behind" };

  const show = (k) => {
    const { now, seen, path } = tree.at(k);
    say(now < 0 ? "It is not entered yet. In front of a plane is to the left."
      : path.map(([n, side]) => side ? `${tree.nodes[n].words}: ${SIDES[side]}`
        : tree.nodes[n].words).slice(-4).join(" → ").replace(/^/,
        path.length > 4 ? "… → " : ""));
    const order = new Map(seen.map((n, place) => [n, place + 1]).reverse());
    const onPath = new Set(path.map(([n]) => n));
    draw(height, (context, width) => {
      const px = (n) => 8 + (width - 16) * (n.x + 0.5) / tree.width;
      const py = (n) => 12 + (height - 26) * n.y / Math.max(1, tree.depth - 1);
      for (const bold of [false, true]) {
        context.strokeStyle = colourOf(bold ? "--ink" : "--faint");
        context.lineWidth = bold ? 2.5 : 0.8;
        context.beginPath();
        tree.nodes.forEach((node, k2) => {
          if (node.parent === undefined || onPath.has(k2) !== bold) return;
          const parent = tree.nodes[node.parent];
          context.moveTo(px(parent), py(parent));
          context.lineTo(px(node), py(node));
        });
        context.stroke();
      }
      const room = (width - 16) / tree.width;
      tree.nodes.forEach((node, k2) => drawNode(context, node, px(node), py(node),
        { isNow: k2 === now, isSeen: order.has(k2), room }));
    });
  };

  const drawNode = (context, node, x, y, { isNow, isSeen, room }) => {
    const r = isNow ? 6 : Math.max(1.5, Math.min(4, room * 0.45));
    context.fillStyle = isNow ? kindColour("activate")
      : colourOf(isSeen ? "--ink" : "--line");
    if (node.name === undefined) {
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.fill();
      return;
    }
    context.fillRect(x - r, y - r, 2 * r, 2 * r);
    if (room < 15) return;
    context.fillStyle = colourOf("--ink");
    context.font = "10px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillText(node.name, x, y + 14);
  };
  return { element, show };
}

// --- The pyramid ---

function pyramidCells(run) {
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
