// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of data.js, with empty values for those that may be missing; and
// functions with which pages look things up.
import {
  cleanCell, cleanErrors, cleanHeader, cleanView, list, number,
} from "./clean.js";

export const STATUSES = {
  ok: { symbol: "✓", meaning: "no sample differs from the oracle's" },
  wrong: { symbol: "✗", meaning: "samples differ from the oracle's" },
  refused: { symbol: "∅",
    meaning: "the scene breaks a restriction, or is too large" },
  timeout: { symbol: "◷", meaning: "took longer than its limit" },
  crash: { symbol: "!", meaning: "ended without an answer" },
  memory: { symbol: "▤", meaning: "needed more memory than its limit" },
};

export function symbolOf(status) {
  return Object.hasOwn(STATUSES, status) ? STATUSES[status].symbol : "?";
}

// Sutherland et al. 1974, figure 29a, in our own words.
export const RESTRICTIONS = {
  CC: "clusters are closed convex polyhedra",
  CF: "faces are convex polygons",
  TR: "faces are triangles",
  LS: "planes can separate the clusters",
  NP: "no face penetrates another",
  TP: "it must be known which faces and edges meet, and in which cluster",
  PF: "faces are planar",
  OF: "no face lies outside the field of view",
  BE: "no face lies behind the eye",
};

export const PEER = "peer";

export function model(data) {
  const listed = data.algorithms ?? [];
  const kinds = new Map((data.kinds ?? []).map((k) => [k.name, k]));
  const cells = cellsOf(data);
  const ofAlgorithm = grouped(cells);
  const known = new Set(listed.map((a) => a.name));
  const algorithms = [...listed, ...[...ofAlgorithm]
    .filter(([name]) => !known.has(name)).map(stranger)];
  const byName = new Map(algorithms.map((a) => [a.name, a]));
  // If several numbers of threads were timed, only the smallest is shown.
  const byKey = new Map([...cells].sort((a, b) => b.threads - a.threads)
    .map((c) => [cellKey(c, c.algorithm), c]));
  const tables = data.tables ?? {};
  const pictures = data.pictures ?? [];

  return {
    title: data.title || "Hidden surfaces, measured",
    headers: (data.headers ?? []).map(cleanHeader),
    baseline: data.baseline ?? null,
    growth: data.growth ?? [],
    geometric: data.geometric ?? [],
    lessonPages: list(data.lessons).filter((l) => Array.isArray(l?.names)),
    laboratory: data.laboratory ?? null,
    pictures, leftOut: data.left_out ?? [],
    views: (data.views ?? []).map(cleanView),
    errors: list(data.errors).map(cleanErrors),
    environments: tables.environments ?? [],
    algorithms, cells, tables,
    kind: (name) => kinds.get(name) ?? null,
    draws: (name) => byName.get(name)?.draws !== false,
    algorithm: (name) => byName.get(name) ?? { name, title: name },
    cell: (record, name) => byKey.get(cellKey(record, name)) ?? null,
    cellsOf: (name) => ofAlgorithm.get(name) ?? [],
    picture: (record) => pictureOf(pictures, record),
  };
}

// In data.js a cell has the number of its place, and its counts are a list: the
// number of the list of their names, then the counts.
function cellsOf({ cells = [], places = [], counters = [], baseline = null }) {
  return cells.map((cell) => {
    const { place, seconds, ratio, phases = {}, peak_kb } = cell;
    const [names, ...counts] = cell.counts ?? [];
    return {
      ...cleanCell(cell), ...places[place], place, phases,
      peak_kb: number(peak_kb),
      counts: cell.counts ? Object.fromEntries(list(counters[names])
        .map((name, k) => [name, number(counts[k])])) : null,
      seconds: seconds ? { ...figureOf(seconds), least: seconds[3] } : null,
      ratio: ratio ? { ...figureOf(ratio), to: baseline } : null,
    };
  });
}

function figureOf([value, low, high]) {
  return { value, low, high };
}

function grouped(cells) {
  const groups = new Map();
  for (const c of cells) {
    if (!groups.has(c.algorithm)) groups.set(c.algorithm, []);
    groups.get(c.algorithm).push(c);
  }
  return groups;
}

// A peer, or an algorithm that has numbers but no description. "none" is no kind: it
// draws nothing.
function stranger([name, [{ peer, kind }]]) {
  return { name, title: name, taxonomy: peer ? PEER : null, kind,
    draws: kind !== "none" };
}

function cellKey(record, name) {
  return JSON.stringify([record.scene, record.view, record.width, record.height,
    record.walk ?? 1, name]);
}

function pictureOf(pictures, { scene, view }) {
  return pictures.find((p) => p.view === view &&
    (p.scene === scene || p.also?.includes(scene))) ?? null;
}

// "harbor or harbor:2500, view 1": scenes that are the same have one picture.
export function titleOf({ scene, also = [], view }) {
  return `${[scene, ...also].join(" or ")}, view ${view}`;
}

export function unique(all) {
  return [...new Set(all)];
}

// Where a scene's parameters begin, a family of scenes ends: "harbor" of
// "harbor:500".
export function family(scene) {
  return scene.split(":")[0];
}

// Whether the interval of a ratio tells it from 1.
export function distinguishable({ low, high }) {
  return low !== null && (low > 1 || high < 1);
}
