// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of data.js, with empty values for those that may be missing; and
// functions with which pages look things up.

export const STATUSES = {
  ok: { symbol: "✓", meaning: "no sample differs from the oracle's" },
  wrong: { symbol: "✗", meaning: "samples differ from the oracle's" },
  refused: { symbol: "∅",
    meaning: "the scene breaks a restriction, or is too large" },
  timeout: { symbol: "◷", meaning: "took longer than its limit" },
  crash: { symbol: "!", meaning: "ended without an answer" },
  memory: { symbol: "▤", meaning: "needed more memory than its limit" },
};

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
  const cells = data.cells ?? [];
  const listed = data.algorithms ?? [];
  const names = new Set(listed.map((a) => a.name));
  // Peers, and algorithms that have numbers but no description.
  const others = [...new Set(cells.map((c) => c.algorithm))]
    .filter((name) => !names.has(name))
    .map((name) => {
      const { peer, kind } = cells.find((c) => c.algorithm === name);
      return { name, title: name, taxonomy: peer ? PEER : null, kind };
    });
  const algorithms = [...listed, ...others];
  const byName = new Map(algorithms.map((a) => [a.name, a]));
  // If several numbers of threads were timed, only the smallest is shown.
  const byKey = new Map([...cells]
    .sort((a, b) => (b.threads ?? 1) - (a.threads ?? 1))
    .map((c) => [cellKey(c, c.algorithm), c]));
  const tables = data.tables ?? {};

  return {
    title: data.title || "Hidden surfaces, measured",
    headers: data.headers ?? [],
    baseline: data.baseline ?? null,
    growth: data.growth ?? [],
    geometric: data.geometric ?? [],
    pictures: data.pictures ?? [],
    views: data.views ?? [],
    environments: tables.environments ?? [],
    algorithms, cells, tables,
    classes: [...new Set(algorithms.map((a) => a.taxonomy))].filter(Boolean),
    draws: (name) => byName.get(name)?.kind !== "none" && name !== "null",
    algorithm: (name) => byName.get(name) ?? { name, title: name },
    cell: (record, name) => byKey.get(cellKey(record, name)) ?? null,
    cellsOf: (name) => cells.filter((c) => c.algorithm === name),
    picture: (record) => pictureOf(data.pictures ?? [], record),
  };
}

function cellKey(record, name) {
  return JSON.stringify([record.scene, record.view, record.width, record.height,
    record.walk ?? 1, name]);
}

function pictureOf(pictures, { scene, view, width, height }) {
  const same = pictures.filter((p) => p.scene === scene && p.view === view);
  return same.find((p) => p.width === width && p.height === height) ??
    same[0] ?? null;
}

// The name by which a picture is found in the address and in its probe.
export function pictureId({ probe, picture }) {
  return (probe ?? picture ?? "").replace(/^.*\//, "").replace(/\.[^.]*$/, "");
}

export function unique(list) {
  return [...new Set(list)];
}
