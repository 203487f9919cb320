// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of figure 13: nested lists, which the style sheet draws as a tree,
// from left to right where there is room.
import { h, link } from "./dom.js";
import { href } from "./address.js";
import { key } from "./looks.js";
import { unique } from "./model.js";

const APART = ["brute force", "yardstick"];

export function tree(report) {
  const branches = branchesOf(report);
  const classes = unique(branches.map((b) => b.class));
  return h("ul", { class: "tree", "aria-label": "Taxonomy of the algorithms" },
    node(["hidden surfaces"], classes.map((name) => {
      const own = branches.filter((b) => b.class === name);
      return node([name], own.flatMap(({ branch, algorithms }) => {
        const leaves = algorithms.map((a) => leaf(report.algorithm(a)));
        return branch ? [node([branch], leaves)] : leaves;
      }));
    })));
}

function node(label, children) {
  return h("li", {}, h("span", { class: "node" }, label), h("ul", {}, children));
}

function leaf(algorithm) {
  return h("li", {}, leafOf(algorithm));
}

function leafOf({ name, authors, year }) {
  return h("span", { class: "leaf" },
    link(href("algorithm", name), key(name), name),
    authors && h("small", {}, ` ${[authors, year].filter(Boolean).join(", ")}`));
}

// What figure 13 names, and whatever else is listed under its own class.
function branchesOf(report) {
  const figure = report.tables.figure13 ?? [];
  const placed = new Set(figure.flatMap((b) => b.algorithms));
  const rest = report.algorithms.filter((a) => !placed.has(a.name) &&
    a.authors && a.taxonomy && !APART.includes(a.taxonomy));
  return [...figure.filter((b) => !APART.includes(b.class)),
    ...unique(rest.map((a) => a.taxonomy)).map((name) => ({
      class: name,
      branch: null,
      algorithms: rest.filter((a) => a.taxonomy === name).map((a) => a.name),
    }))];
}

// Brute force, yardsticks and peers, which have no place in the tree.
export function apart(report) {
  const groups = unique(report.algorithms.map((a) => a.taxonomy))
    .filter((name) => APART.includes(name) || name === "peer");
  return groups.length ? h("div", { class: "apart" }, groups.map((name) =>
    h("section", {}, h("h3", {}, name === "peer" ? "peers: renderers of others"
      : name),
    h("ul", {}, report.algorithms.filter((a) => a.taxonomy === name)
      .map((a) => h("li", {}, leafOf(a))))))) : null;
}
