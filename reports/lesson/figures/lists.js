// SPDX-License-Identifier: GPL-3.0-or-later
// The survey's figures of list-priority algorithms: 18 to 20 of Schumacker's, 22
// and 23 of Newell's.
import { closeness, segmentsOn } from "../data/projection.js";
import { hasOutcome } from "../data/run.js";
import { board, colourOf, line, middle, pathOf, round, s, section,
  text } from "./drawing.js";

// The events of the counter of that key.
export function* eventsOf(run, key) {
  const c = run.counterOf(key);
  for (let k = 0; k < run.trace.kept; k++)
    if (run.trace.counter[k] === c) yield run.event(k);
}

// --- Plans: seen from above ---

// The two axes of a plan, and the scale that shows all `points` in a square.
function planOf(run, points, side) {
  const { up } = run.header.view;
  const dropped = up.map(Math.abs).indexOf(Math.max(...up.map(Math.abs)));
  const [a, b] = [0, 1, 2].filter((k) => k !== dropped);
  const bounds = [a, b].map((k) => [Math.min(...points.map((p) => p[k])),
    Math.max(...points.map((p) => p[k]))]);
  const span = Math.max(...bounds.map(([low, high]) => high - low)) || 1;
  const place = (p) => [a, b].map((k, n) => {
    const at = 18 + (p[k] - bounds[n][0]) / span * (side - 36);
    return n ? side - at : at;
  });
  return { place, axes: [a, b], dropped };
}

const corners = (run, f) => run.header.faces[f][3].map((v) => run.trace.points[v]);

// --- 18: priority within a cluster ---

export function facePriority(run) {
  const { clusters } = run.trace.structure;
  const culls = [...eventsOf(run, "back-face-cull")];
  const best = clusters.reduce((x, y) => new Set(y).size > new Set(x).size ? y : x);
  const faces = [...new Set(best)];
  const { place, dropped } = planOf(run, faces.flatMap((f) => corners(run, f)), 240);
  // Of the faces on edge in the plan; the others are seen flat.
  const upright = faces.filter((f) => {
    const own = corners(run, f).map((p) => p[dropped]);
    return Math.max(...own) > Math.min(...own);
  });
  const isFront = new Set(culls.filter((e) => hasOutcome(e, "front"))
    .map((e) => e.a.ids[0]));
  const plan = (dashBack, x) => s("g", { transform: `translate(${x} 0)` },
    upright.map((f) => {
      const at = corners(run, f).map(place);
      const [p, q] = ends(at);
      const back = dashBack && !isFront.has(f);
      const [cx, cy] = middle([p, q]);
      const away = [cx - 120, cy - 120].map((d) =>
        d / (Math.hypot(cx - 120, cy - 120) || 1) * 12);
      return [line(...p, ...q, { "stroke-width": 2.5,
        "stroke-dasharray": back ? "4 4" : null }),
      back ? null : text(cx + away[0], cy + away[1] + 4, best.indexOf(f) + 1)];
    }), text(120, 258, dashBack ? "b" : "a"));
  const eye = place(run.header.view.eye);
  const length = Math.hypot(eye[0] - 120, eye[1] - 120) || 1;
  const from = [0, 1].map((k) => (eye[k] - 120) / length);
  return board(530, 266, "Priority numbers of a cluster’s faces, from above; and " +
    "from one eye, with back faces dashed", plan(false, 0), plan(true, 270),
  s("g", { transform: "translate(270 0)" },
    line(120 + 118 * from[0], 120 + 118 * from[1], 120 + 96 * from[0],
      120 + 96 * from[1], { stroke: "var(--hue-0)", "stroke-width": 3 }),
    text(120 + 128 * from[0], 120 + 128 * from[1] + 4, "eye",
      { fill: "var(--hue-0)" })));
}

// The two points of a plan that lie farthest apart.
function ends(points) {
  let best = [points[0], points[1]], most = -1;
  points.forEach((p) => points.forEach((q) => {
    const d = Math.hypot(p[0] - q[0], p[1] - q[1]);
    if (d > most) [best, most] = [[p, q], d];
  }));
  return best;
}

// --- 19: priority of clusters ---

export function clusterPriority(run) {
  const { separators, clusters } = run.trace.structure;
  const { tree } = run;
  const filled = clusters.map((faces, c) => [c, faces]).filter(([, f]) => f.length);
  const all = filled.flatMap(([, faces]) => faces.flatMap((f) => corners(run, f)));
  const { place, axes } = planOf(run, all, 250);
  const rank = new Map(run.tree.at(run.n).seen.filter((n) => n >= separators.length)
    .map((n, k) => [n - separators.length, k + 1]));
  const stacks = new Map(); // clusters over one another share their place
  const boxes = filled.map(([c, faces]) => {
    const at = faces.flatMap((f) => corners(run, f)).map(place);
    const [x, y] = [0, 1].map((k) => at.map((p) => p[k]));
    const box = { x: Math.min(...x), y: Math.min(...y) };
    const key = `${Math.round(box.x)},${Math.round(box.y)}`;
    const below = stacks.get(key) ?? 0;
    stacks.set(key, below + 1);
    return [s("rect", { x: round(box.x), y: round(box.y), fill: "var(--hue-0)",
      width: round(Math.max(...x) - box.x), height: round(Math.max(...y) - box.y),
      "fill-opacity": 0.12, stroke: "var(--ink)" }),
    text((Math.max(...x) + box.x) / 2, (Math.max(...y) + box.y) / 2 - 2 + 14 * below,
      `${c}: ${rank.get(c) ?? "–"}`)];
  });
  const lines = new Map(); // planes at one place share a line
  separators.forEach(([face, axis, at], k) => {
    if (face !== null || !axes.includes(axis)) return;
    const key = `${axis} ${at}`;
    lines.set(key, [...lines.get(key) ?? [], k]);
  });
  const planes = [...lines.values()].map((own) => {
    const [, axis, at] = separators[own[0]];
    const n = axes.indexOf(axis);
    const names = own.map(letter).join(", ");
    const point = [0, 0, 0];
    point[axis] = at;
    const v = place(point)[n];
    return n === 0 ? [line(v, 4, v, 246, { "stroke-dasharray": "5 3",
      stroke: "var(--hue-1)" }), text(v + 4, 12, names, { "text-anchor": "start" })]
      : [line(4, v, 246, v, { "stroke-dasharray": "5 3", stroke: "var(--hue-1)" }),
        text(4, v - 4, names, { "text-anchor": "start" })];
  });
  const px = (n) => 285 + 215 * (n.x + 0.5) / tree.width;
  const py = (n) => 20 + 210 * n.y / Math.max(1, tree.depth - 1);
  const nodes = tree.nodes.filter((n) => n.x !== undefined).map((n) => [
    n.parent === undefined ? null
      : line(px(n), py(n), px(tree.nodes[n.parent]), py(tree.nodes[n.parent]),
        { "stroke-width": 0.8 })]);
  const names = tree.nodes.map((n, k) => n.x === undefined ? null : [
    s("circle", { cx: round(px(n)), cy: round(py(n)), r: 8, fill: "var(--paper)",
      stroke: n.name ? "var(--hue-0)" : "var(--hue-1)" }),
    text(px(n), py(n) + 3.5, n.name ?? letter(k), { "font-size": 10 })]);
  return board(510, 256, "Clusters from above with the planes between them, and the " +
    "tree of the planes", ...planes, ...boxes, ...nodes, ...names);
}

const letter = (k) => k < 24 ? String.fromCodePoint(0x3b1 + k + (k > 16 ? 1 : 0))
  : `p${k}`;

// --- 20: the intercepts of a face ---

export function intercepts(run) {
  const pairs = [...eventsOf(run, "counter-pair")].filter((e) =>
    run.header.faces[e.a.ids[0]][4].length >= 3);
  const slope = (e) => leaning(run.header.faces[e.a.ids[0]][4]);
  const best = pairs.reduce((x, y) => slope(y) * y.window.width >
    slope(x) * x.window.width ? y : x);
  const polygon = run.header.faces[best.a.ids[0]][4];
  const xs = polygon.map(([x]) => x), ys = polygon.map(([, y]) => y);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys),
    Math.max(...ys)];
  const tall = (y1 - y0) * 1.45, unit = 300 / Math.max(tall, (x1 - x0) * 1.6);
  const px = (x) => 200 + (x - (x0 + x1) / 2) * unit;
  const py = (y) => 20 + (y - y0) * unit;
  const rows = [(best.window.y + 0.5), y1 + (y1 - y0) * 0.2];
  const [cx] = middle(polygon);
  const edges = polygon.map((p, k) => [p, polygon[(k + 1) % polygon.length]])
    .filter(([p, q]) => Math.abs(p[1] - q[1]) > 1e-6);
  const across = ([p, q], y) => p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
  const isLeft = ([p, q]) => across([p, q], (p[1] + q[1]) / 2) <
    widthAt(edges, across, (p[1] + q[1]) / 2, cx);
  const reach = [y0 - (y1 - y0) * 0.05, y1 + (y1 - y0) * 0.3];
  const drawn = edges.map((edge) => line(px(across(edge, reach[0])), py(reach[0]),
    px(across(edge, reach[1])), py(reach[1]), { "stroke-dasharray": "4 3",
      stroke: isLeft(edge) ? "var(--hue-0)" : "var(--hue-1)" }));
  const scan = rows.map((y) => {
    const L = Math.max(...edges.filter(isLeft).map((e) => across(e, y)));
    const R = Math.min(...edges.filter((e) => !isLeft(e)).map((e) => across(e, y)));
    const mark = (x, name) => [s("circle", { cx: round(px(x)), cy: round(py(y)), r: 3,
      fill: name.includes("L") ? "var(--hue-0)" : "var(--hue-1)" }),
    text(px(x), py(y) - 7, name)];
    return [line(10, py(y), 390, py(y), { "stroke-width": 0.8 }),
      L < R ? line(px(L), py(y), px(R), py(y), { "stroke-width": 5 }) : null,
      mark(L, "max L"), mark(R, "min R"),
      text(388, py(y) + 14, L < R ? "meets the face" : "does not",
        { "text-anchor": "end" })];
  });
  return board(400, 40 + tall * unit, "A face between its left and right edges, and " +
    "two scan lines", s("path", { d: pathOf(polygon.map(([x, y]) =>
    [px(x), py(y)])), fill: colourOf(run, best.a.ids[0]), "fill-opacity": 0.5,
  stroke: "var(--ink)" }), ...drawn, ...scan);
}

// How far the sides of a polygon lean.
function leaning(polygon) {
  return polygon.reduce((sum, [x, y], k) => {
    const [u, v] = polygon[(k + 1) % polygon.length];
    const wide = Math.abs(u - x), tall = Math.abs(v - y);
    return sum + Math.min(wide, tall) / (Math.hypot(wide, tall) || 1);
  }, 0);
}

// The middle of the polygon at height y.
function widthAt(edges, across, y, otherwise) {
  const here = edges.filter(([p, q]) => (p[1] > y) !== (q[1] > y))
    .map((e) => across(e, y));
  return here.length ? (Math.min(...here) + Math.max(...here)) / 2 : otherwise;
}

// --- 22: the Z sort alone is wrong ---

const LEAST = 1e-3; // of the depth: a difference that can be seen

export function wrongOrder(run) {
  const near = closeness(run);
  const farthest = (f) => Math.min(...run.header.faces[f][4].map(
    ([x, y]) => near(f)(x, y)));
  let best = null;
  for (const { a, b } of eventsOf(run, "list-move")) {
    const both = [a.ids[0], b.ids[0]];
    const far = both.map(farthest);
    for (const j of overlapOf(run, both)) {
      const segments = segmentsOn(run, j, near).filter(({ face }) =>
        both.includes(face));
      const gain = Math.min(far[1] - far[0], ahead(segments, both));
      if (!best || gain > best.gain) best = { j, both, far, segments, gain };
    }
  }
  if (!best || best.gain < LEAST * Math.abs(best.far[0])) return null;
  const { j, both, far, segments } = best;
  const name = (f) => f === both[0] ? "P" : "Q";
  const x = segments.flatMap(({ x0, x1 }) => [x0, x1]);
  const { py, drawn } = section(run, segments, { left: Math.min(...x) - 2,
    right: Math.max(...x) + 2, width: 420, height: 220, label: name,
    also: [{ z0: far[0], z1: far[1] }] });
  const keys = both.map((f, k) => [line(0, py(far[k]), 420, py(far[k]),
    { "stroke-dasharray": "2 4", stroke: k ? "var(--hue-1)" : "var(--hue-0)" }),
  text(416, py(far[k]) + (k ? 12 : -3), `farthest point of ${name(f)}`,
    { "text-anchor": "end" })]);
  return board(420, 220, `Row ${j} from above: P is sorted before Q, but hides it`,
    ...keys, ...drawn, text(210, 216, "the eye is below", { fill: "var(--faint)" }));
}

// By how much the first of two faces is nearer where both are, at most.
function ahead(segments, [f, g]) {
  const z = (s2, x) => s2.z0 + (x - s2.x0) / (s2.x1 - s2.x0 || 1) * (s2.z1 - s2.z0);
  let most = 0;
  for (const p of segments.filter(({ face }) => face === f))
    for (const q of segments.filter(({ face }) => face === g)) {
      const [l, r] = [Math.max(p.x0, q.x0), Math.min(p.x1, q.x1)];
      if (l < r) most = Math.max(most, z(p, l) - z(q, l), z(p, r) - z(q, r));
    }
  return most;
}

// The rows on which the images of two faces overlap.
function overlapOf(run, [f, g]) {
  const rows = [];
  const on = (face, y) => {
    const x = run.header.faces[face][4].flatMap(([xa, ya], k, all) => {
      const [xb, yb] = all[(k + 1) % all.length];
      return (ya > y) === (yb > y) ? [] : [xa + (y - ya) / (yb - ya) * (xb - xa)];
    });
    return x.length ? [Math.min(...x), Math.max(...x)] : null;
  };
  for (let j = 0; j < run.height; j++) {
    const p = on(f, j + 0.5), q = on(g, j + 0.5);
    if (p && q && p[0] < q[1] - 1 && q[0] < p[1] - 1) rows.push(j);
  }
  return rows;
}

// --- 23: a division ---

export function division(run) {
  for (const e of eventsOf(run, "list-division")) {
    const halves = run.children(e.k, e.a.ids[1]).filter(Boolean);
    if (halves.length < 2) continue;
    const other = run.header.faces[e.b.ids[0]][4];
    const all = [...halves.flat(), ...other];
    const [x, y] = [0, 1].map((k) => all.map((p) => p[k]));
    const unit = 380 / Math.max(Math.max(...x) - Math.min(...x),
      Math.max(...y) - Math.min(...y));
    const at = ([px, py]) => [20 + (px - Math.min(...x)) * unit,
      20 + (py - Math.min(...y)) * unit];
    const shape = (points, colour, opacity, name) => [s("path",
      { d: pathOf(points.map(at)), fill: colour, "fill-opacity": opacity,
        stroke: "var(--ink)", "stroke-width": 1.5 }),
    text(...at(middle(points)), name, { "font-size": 15 })];
    const own = colourOf(run, e.a.ids[0]);
    return board(420, 40 + (Math.max(...y) - Math.min(...y)) * unit,
      "A piece is divided by the plane of another face",
      shape(other, colourOf(run, e.b.ids[0]), 0.35, "P"),
      shape(halves[0], own, 0.85, "Qa"), shape(halves[1], own, 0.45, "Qb"));
  }
  return null;
}
