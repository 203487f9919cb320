// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of figure 13: nested lists, which the style sheet draws as a tree; it
// runs from left to right if there is room. The survey's ten are framed.
import { href } from "../data/address.js";
import { key, looks } from "../data/looks.js";
import { PEER, unique } from "../data/model.js";
import { h, link } from "./dom.js";
import { TEN } from "./taxonomy.js";

// In the figure's order.
const BRANCHES = [
  ["object space", "edges against volumes"],
  ["object space", "edges against edges"],
  ["list priority", "a priori"], ["list priority", "per frame"],
  ["image space", "area sampling"], ["image space", "point sampling"],
];
const APART = ["brute force", "hierarchical", "yardstick", PEER];

// Its branches are those of all algorithms listed, whatever was run.
export function tree(report) {
  const placed = report.algorithms
    .filter((a) => a.taxonomy && !APART.includes(a.taxonomy));
  const at = ({ taxonomy, branch }) => BRANCHES.findIndex(([name, part]) =>
    name === taxonomy && part === branch) + 1 || BRANCHES.length + 1;
  placed.sort((a, b) => at(a) - at(b));
  const classes = unique(placed.map((a) => a.taxonomy));
  return h("ul", { class: "tree", "aria-label": "Taxonomy of the algorithms" },
    node("hidden surfaces", classes.map((name) => {
      const own = placed.filter((a) => a.taxonomy === name);
      return node(name, unique(own.map((a) => a.branch)).flatMap((branch) => {
        const leaves = own.filter((a) => a.branch === branch).map(leaf);
        return branch ? [node(branch, leaves)] : leaves;
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
  return h("span", { class: TEN.has(name) ? "leaf ten" : "leaf" },
    link(href("algorithm", name), key(looks(name)), name),
    h("small", {}, [authors, year].filter(Boolean).join(", ")));
}

// Brute force, hierarchies, yardsticks and peers, which have no place in the
// tree.
export function apart(report) {
  const groups = unique(report.algorithms.map((a) => a.taxonomy))
    .filter((name) => APART.includes(name));
  return groups.length ? h("div", { class: "apart" }, groups.map((name) =>
    h("section", {}, h("h3", {}, name === PEER ? "peers: other people’s renderers"
      : name),
    h("ul", {}, report.algorithms.filter((a) => a.taxonomy === name)
      .map((a) => h("li", {}, leafOf(a))))))) : null;
}
