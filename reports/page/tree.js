// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of figure 13: nested lists, which the style sheet draws as a tree; it
// runs from left to right if there is room.
import { h, link } from "./dom.js";
import { href } from "./address.js";
import { key } from "./looks.js";
import { PEER, unique } from "./model.js";

const APART = ["brute force", "hierarchical", "yardstick", PEER];

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
    h("small", {}, [authors, year].filter(Boolean).join(", ")));
}

// The classes of figure 13 and of all other algorithms listed. In the name of a
// class, a branch follows after a comma.
function branchesOf(report) {
  const branches = (report.tables.figure13 ?? [])
    .filter((b) => !APART.includes(b.class))
    .map((b) => ({ ...b, algorithms: [...b.algorithms] }));
  const placed = new Set(branches.flatMap((b) => b.algorithms));
  for (const { name, taxonomy } of report.algorithms) {
    if (placed.has(name) || !taxonomy || APART.includes(taxonomy)) continue;
    const [own, branch = null] = taxonomy.split(", ");
    const there = branches.find((b) => b.class === own && b.branch === branch);
    if (there) there.algorithms.push(name);
    else branches.push({ class: own, branch, algorithms: [name] });
  }
  return branches;
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
