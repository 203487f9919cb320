// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of planes, and the way to where the walk is.
import { colourOf, kindColour } from "../data/kinds.js";
import { board } from "./board.js";

export function planeTree(run) {
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
