// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of the survey's figure 13 with the ten algorithms as its leaves, as a
// drawing that can be saved.
import { h } from "./dom.js";
import { saveSvg } from "./save.js";
import { board, line, s, text } from "./svg.js";

const TREE = ["opaque objects", [
  ["object space", [
    ["edges against volumes", ["roberts"]],
    ["edges against edges", ["appel", "loutrel", "galimberti"]]]],
  ["list priority", [
    ["found before the frame", ["schumacker"]],
    ["found in each frame", ["newell"]]]],
  ["image space", [
    ["area sampling", ["warnock"]],
    ["point sampling", ["romney", "bouknight", "watkins"]]]]]];

// The ten, by name.
export const TEN = new Set(TREE[1].flatMap(([, branches]) =>
  branches.flatMap(([, names]) => names)));

const ROW = 30, X = [8, 150, 280, 470], WIDTH = 860;

// known: the algorithms of the page; to(name): where a leaf leads; said(name): what
// stands below it; watch(name): where it can be watched at work, null: nowhere; end: what a
// reader can do with it.
export function taxonomyTree(known, { to, said, watch, end }) {
  const shapes = [];
  let row = 0;

  const leaf = (name) => {
    const y = 20 + ROW * row++;
    const a = known.find((k) => k.name === name);
    const label = text(X[3], y + 4, a ? `${a.authors} ${a.year ?? ""}` : name,
      { "text-anchor": "start", "font-size": 13, fill: a ? "var(--link)" : null });
    const idea = text(X[3], y + 16, said(name), { "text-anchor": "start",
      "font-size": 10, fill: "var(--faint)" });
    const lesson = a && watch?.(name);
    shapes.push(a ? s("a", { href: to(name) }, label) : label, idea,
      ...lesson ? [s("a", { class: "watch", href: lesson, "aria-label":
        `Watch ${a.authors} at work` }, text(WIDTH - 8, y + 4, "watch it", {
        "text-anchor": "end", "font-size": 13, fill: "var(--link)" }))] : []);
    return y;
  };

  const node = (label, children, depth) => {
    const ys = children.map((child) => typeof child === "string" ? leaf(child)
      : node(child[0], child[1], depth + 1));
    const y = (ys[0] + ys.at(-1)) / 2;
    const width = 7 * label.length;
    ys.forEach((to) => shapes.push(line(X[depth] + width + 4, y, X[depth + 1] - 14, to,
      { "stroke-width": 1 }), line(X[depth + 1] - 14, to, X[depth + 1] - 4, to,
      { "stroke-width": 1 })));
    shapes.push(text(X[depth], y + 4, label, { "text-anchor": "start",
      "font-size": 13 }));
    return y;
  };

  node(TREE[0], TREE[1], 0);
  const drawing = board(WIDTH, 20 + ROW * row, "The ten algorithms in the tree of " +
    "figure 13", ...shapes);
  drawing.setAttribute("role", "group"); // it has links
  drawing.setAttribute("width", WIDTH);
  drawing.setAttribute("height", 20 + ROW * row);
  const caption = "Figure 13 of the survey: the ten algorithms";
  return h("figure", { class: "taxonomy" }, h("div", { class: "scroll", tabindex: 0,
    role: "region", "aria-label": "The tree" }, drawing),
  h("figcaption", {}, `${caption}. ${end} `,
    saveSvg(caption, () => drawing, [])));
}
