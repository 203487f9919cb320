// SPDX-License-Identifier: GPL-3.0-or-later
// The set of hiding faces along an edge, as Galimberti and Montanari carry it. The
// steps name the edges at which the set changes, and say how many faces hide each
// interval. Which faces these are they do not say: that is found from the scene, and
// an edge is shown only if both agree on all of its length.
import { depths, projection } from "../data/projection.js";
import { hasOutcome } from "../data/run.js";
import { board, colourOf, ground, line, pathOf, round, s, text } from "./drawing.js";
import { eventsOf } from "./lists.js";

const WIDE = 420, FROM = 90, TO = 410;
const SAME = 1e-6; // of an edge: places that are one
const left = { "text-anchor": "start" };
const letter = (k) => String.fromCharCode(97 + k);

export function natures(run) {
  const all = followed(run).map((edge) => setsAlong(run, edge)).filter(Boolean);
  const best = all.reduce((p, q) => !p || q.value > p.value ? q : p, null);
  return best && drawn(run, best);
}

// --- From the steps ---

// The edges in the order in which they are followed: their ends, where they change,
// and their intervals.
function followed(run) {
  const { trace } = run, edges = [];
  const [compares, changes, draws] = ["edge-intersection", "nature-change",
    "interval-drawn"].map((key) => run.counterOf(key));
  let now = null;
  for (let k = 0; k < trace.kept; k++) {
    const c = trace.counter[k];
    if (c !== compares && c !== changes && c !== draws) continue;
    const e = run.event(k);
    if (c === compares && (!now || !isSame(now.ids, e.a.ids))) {
      now = { ids: e.a.ids, crossed: [], parts: [] };
      edges.push(now);
    }
    if (c === changes && e.outcome === "forwards") now?.crossed.push(e.a);
    if (c === draws && now && isSame(now.ids, e.a.ids)) now.parts.push(e.part);
  }
  return edges.filter(({ crossed, parts }) => parts.length > 1 &&
    crossed.every(({ kind }) => kind === "edge"));
}

const isSame = ([p, q], [r, t]) => p === r && q === t;

// --- Along one edge ---

// { ids, cuts: [{ at, edges }], pieces: [{ from, to, many, faces }], value }, shares of
// the edge's image; null: the scene does not agree with the steps, or they cannot be
// compared.
function setsAlong(run, { ids, crossed, parts }) {
  const see = projection(run.header.view);
  const imageOf = (v) => run.trace.points[v] ? see(run.trace.points[v]) : null;
  const [a, b] = ids.slice(0, 2).map(imageOf);
  if (!a || !b) return null;
  const shareOf = ([x, y]) => ((x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1])) /
    ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2);
  const cuts = cutsOf(crossed, a, b, imageOf);
  if (!cuts) return null;
  const ends = parts.map((part) => [part[4], part[5]].map((p) => {
    const at = see(p);
    return at ? shareOf(at) : NaN;
  }));
  const [low, high] = [ends[0][0], ends.at(-1)[1]];
  const inside = cuts.filter(({ at }) => at > low + SAME && at < high - SAME);
  const limits = [low, ...inside.map(({ at }) => at), high];
  const pieces = limits.slice(1).map((to, k) => {
    const middle = (limits[k] + to) / 2;
    const p = ends.findIndex(([s0, s1]) => s0 <= middle && middle <= s1);
    return { from: limits[k], to, many: parts[p]?.[1],
      faces: hidingAt(run, ids, a, b, middle) };
  });
  if (pieces.some(({ many, faces }) => many !== faces.length)) return null;
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const least = Math.min(...pieces.map(({ from, to }) => to - from));
  const numbers = new Set(pieces.map(({ many }) => many)).size;
  return { ids, a, b, cuts: inside, pieces, low, high, value: least * length < 1.5 ? 0
    : pieces.length + numbers + length / run.width + least };
}

// Where the image is crossed, those at one place together; null: not known.
function cutsOf(crossed, a, b, imageOf) {
  const cuts = [];
  for (const { ids } of crossed) {
    const [c, d] = ids.slice(0, 2).map(imageOf);
    const at = c && d ? crossing(a, b, c, d) : null;
    if (at === null) return null;
    const there = cuts.find((cut) => Math.abs(cut.at - at) < SAME);
    if (there) there.edges.push(ids);
    else cuts.push({ at, edges: [ids] });
  }
  // The steps have sorted them.
  return cuts.every(({ at }, k) => !k || at > cuts[k - 1].at) ? cuts : null;
}

// The share of ab where it meets the line cd; null: nowhere.
function crossing(a, b, c, d) {
  const [ux, uy] = [b[0] - a[0], b[1] - a[1]], [vx, vy] = [d[0] - c[0], d[1] - c[1]];
  const det = ux * vy - uy * vx;
  return Math.abs(det) < 1e-9 ? null
    : ((c[0] - a[0]) * vy - (c[1] - a[1]) * vx) / det;
}

// The faces seen from the front, not the edge's own, that are nearer than the edge at
// a share of its image.
function hidingAt(run, ids, a, b, share) {
  const { deep } = depths(run);
  const [x, y] = [0, 1].map((c) => a[c] + share * (b[c] - a[c]));
  const own = run.header.view.parallel ? a[2] + share * (b[2] - a[2])
    : 1 / (1 / a[2] + share * (1 / b[2] - 1 / a[2]));
  return frontFaces(run).filter((f) => {
    const [, , , corners, polygon] = run.header.faces[f];
    const d = ids.slice(0, 2).every((v) => corners.includes(v)) ? null : deep(f, x, y);
    return d !== null && d < own * (1 - 1e-9) && isInside(polygon, x, y);
  });
}

const frontFaces = (run) => run.frontFaces ??= [...new Set(trueFronts(run))];

function* trueFronts(run) {
  const c = run.counterOf("edge-cull");
  for (let k = 0; k < run.trace.kept; k++)
    if (run.trace.counter[k] === c && hasOutcome(run.event(k), "exists"))
      yield run.trace.b0[k];
}

function isInside(polygon, x, y) {
  let inside = false;
  polygon.forEach(([xk, yk], k) => {
    const [xl, yl] = polygon.at(k - 1);
    if ((yk > y) !== (yl > y) && x < (xl - xk) * (y - yk) / (yl - yk) + xk)
      inside = !inside;
  });
  return inside;
}

// --- The drawing ---

function drawn(run, best) {
  const { ids, cuts, pieces } = best;
  const rows = [...new Set(pieces.flatMap(({ faces }) => faces))];
  const px = (share) => FROM + (share - best.low) / (best.high - best.low) * (TO - FROM);
  const [top, high] = [226, 24], foot = top + high * rows.length;
  const chart = rows.flatMap((f, r) => [text(FROM - 8, top + high * (r + 0.5) + 4,
    `face ${f}`, { "text-anchor": "end", "font-size": 13 }),
  pieces.filter(({ faces }) => faces.includes(f)).map(({ from, to }) => s("rect",
    { class: "hiding", "data-face": f, x: round(px(from)), y: top + high * r + 4,
      width: round(px(to) - px(from)), height: high - 8, fill: colourOf(run, f),
      stroke: "var(--ink)" }))]);
  const numbers = pieces.map(({ from, to, many }) => [
    line(px(from), foot + 12, px(to), foot + 12, { stroke: many ? "var(--hue-1)"
      : "var(--hue-2)", "stroke-width": 4, "stroke-dasharray": many ? "4 3" : null }),
    text((px(from) + px(to)) / 2, foot + 31, many, { class: "many", "font-size": 13 })]);
  const words = cuts.map(({ edges }, k) => `${letter(k)}: edge ${edges.map(([p, q]) =>
    `${p}–${q}`).join(" and ")}`);
  return board(WIDE, foot + 48 + 16 * words.length,
    `Edge ${ids[0]}–${ids[1]}: the faces that hide it, which change at ${
      cuts.length} places`, map(run, best),
  cuts.map(({ at }, k) => [line(px(at), top - 4, px(at), foot + 18,
    { "stroke-dasharray": "2 3" }), text(px(at), top - 9 - 13 * isTight(cuts, k, px),
    letter(k), { "font-size": 13 })]),
  chart, numbers, text(FROM - 8, foot + 31, "how many", { "text-anchor": "end",
    "font-size": 13 }),
  words.map((word, k) => text(FROM, foot + 52 + 16 * k, word, { ...left,
    "font-size": 13 })));
}

// Whether the letter has no room beside the one before it: 1, else 0.
const isTight = (cuts, k, px) => k > 0 && px(cuts[k].at) - px(cuts[k - 1].at) < 11 &&
  !isTight(cuts, k - 1, px) ? 1 : 0;

// The edge among the faces, what is around it, with a letter at each change.
function map(run, { a, b, low, high, cuts, pieces }) {
  const side = 190;
  const size = Math.max(Math.abs(a[0] - b[0]), Math.abs(a[1] - b[1]), 8) * 1.6;
  const from = [0, 1].map((c) => (a[c] + b[c] - size) / 2), unit = side / size;
  const place = (p) => [0, 1].map((c) => (p[c] - from[c]) * unit);
  const on = (share) => place([0, 1].map((c) => a[c] + share * (b[c] - a[c])));
  const clip = `along-${run.name}`;
  const faces = [...new Set(pieces.flatMap((p) => p.faces))];
  const across = on(high).map((x, c) => x - on(low)[c]);
  const aside = [across[1], -across[0]].map((x) => x / Math.hypot(...across) * 12);
  return s("g", { transform: `translate(${(WIDE - side) / 2} 0)` },
    s("clipPath", { id: clip }, s("rect", { width: side, height: side })),
    s("g", { "clip-path": `url(#${clip})` }, faces.map((f) => s("path",
      { d: pathOf(run.header.faces[f][4].map(place)), fill: colourOf(run, f),
        "fill-opacity": 0.35 })), ground(run, unit, place),
    pieces.map((p) => line(...on(p.from), ...on(p.to), { "stroke-width": 4,
      stroke: p.many ? "var(--hue-1)" : "var(--hue-2)",
      "stroke-dasharray": p.many ? "4 3" : null })),
    cuts.map(({ at }, k) => {
      const [x, y] = on(at), far = 1 + 0.9 * isTight(cuts, k, (t) => t * size * unit);
      return [s("circle", { cx: round(x), cy: round(y), r: 3, fill: "var(--ink)" }),
        text(x + far * aside[0], y + far * aside[1] + 4, letter(k), { "font-size": 13 })];
    })),
    s("rect", { width: side, height: side, fill: "none", stroke: "var(--line)" }));
}
