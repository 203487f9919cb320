// SPDX-License-Identifier: GPL-3.0-or-later
// Of a line drawing: the edge that the step is about, from end to end, with the
// number of faces that hide each interval of it, as far as it is drawn.
import { h } from "../../page/parts/dom.js";

const MOST = 60; // letters are left out of what is narrower than 1/60

export function edgeStrip(run) {
  const of = new Map(); // edge -> numbers of its parts
  run.trace.parts.forEach(([[kind, ...ids]], k) => {
    const key = keyOf(run.header.subjects[kind].name, ids);
    of.set(key, [...of.get(key) ?? [], k]);
  });
  const title = h("p", { class: "where" });
  const bar = h("div", { class: "strip", role: "img" });
  const element = h("div", { class: "edge" }, title, bar);

  const show = (k, e) => {
    const edges = e ? [e.a, e.b].filter((s) => /edge/.test(s.kind)) : [];
    const edge = edges.find((s) => of.has(keyOf(s.kind, s.ids))) ?? edges[0];
    const key = edge && keyOf(edge.kind, edge.ids);
    const drawn = run.accepted(k);
    const parts = (of.get(key) ?? []).filter((p) => p < drawn)
      .map((p) => run.trace.parts[p]).sort((a, b) => a[2] - b[2]);
    title.textContent = !key ? "No edge is asked about now."
      : `Edge ${key.replace(",", "–")}: ${parts.length
        ? "0 is visible, other numbers say how much hides it; white: not drawn"
        : of.has(key) ? "not drawn yet" : "nothing of it comes into the drawing"}`;
    bar.replaceChildren(...pieces(parts));
    bar.setAttribute("aria-label", inWords(parts));
  };
  return { element, show };
}

function keyOf(kind, ids) {
  const [p, q] = ids;
  return kind === "edge" ? `${Math.min(p, q)},${Math.max(p, q)}`
    : `where faces ${p} and ${q} penetrate`;
}

function pieces(parts) {
  const out = [];
  let end = 0;
  const add = (length, look, text) => length > 0 && out.push(h("span",
    { class: look, style: `flex: ${length} 0 0` },
    length > 1 / MOST ? text : ""));
  for (const [, invisibility, t0, t1] of parts) {
    add(t0 - end, "gap", "");
    add(t1 - t0, invisibility ? "hidden-part" : "seen-part",
      String(invisibility));
    end = t1;
  }
  add(1 - end, "gap", "");
  return out;
}

function inWords(parts) {
  const percent = (t) => `${Math.round(100 * t)} %`;
  return parts.length ? parts.map(([, n, t0, t1]) => `from ${percent(t0)} to ${
    percent(t1)} ${n ? `hidden by ${n}` : "visible"}`).join("; ")
    : "nothing of this edge is drawn yet";
}
