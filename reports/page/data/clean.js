// SPDX-License-Identifier: GPL-3.0-or-later
// A file of results comes from anywhere. What it says is taken only in the form
// that it should have; else it counts as not said.

export const text = (x) => typeof x === "string" ? x : null;
export const number = (x) => Number.isFinite(x) ? x : null;
export const list = (x) => Array.isArray(x) ? x : [];
const object = (x) =>
  typeof x === "object" && x !== null && !Array.isArray(x) ? x : {};
const numbers = (x) => Object.fromEntries(Object.entries(object(x))
  .map(([name, value]) => [name, number(value)]));
const words = (x) => list(x).filter((word) => text(word) !== null);

export function cleanHeader(record) {
  const { machine } = record;
  return {
    date: text(record.date),
    command: text(record.command) ?? words(record.command).join(" "),
    version: text(record.version), commit: text(record.commit),
    compiler: text(record.compiler), flags: text(record.flags),
    code: text(record.code),
    ...numbers({ seed: record.seed, starts: record.starts,
      repetitions: record.repetitions, timeout: record.timeout,
      memory_mb: record.memory_mb }),
    machine: {
      cpu: text(machine?.cpu), os: text(machine?.os),
      governor: text(machine?.governor),
      ...numbers({ cores: machine?.cores, threads: machine?.threads,
        memory_kb: machine?.memory_kb }),
      caches: list(machine?.caches).map(numbers)
        .filter((c) => c.level > 0 && c.kb > 0),
      load: list(machine?.load).filter((x) => number(x) !== null),
    },
  };
}

export function cleanView(record) {
  return {
    scene: text(record.scene) ?? "", walk: number(record.walk) ?? 1,
    ...numbers({ view: record.view, width: record.width,
      height: record.height }),
    table1: numbers(record.table1),
  };
}

// What hsr errors found. The places of pictures are of hsr report's own making.
export function cleanErrors(record) {
  const { scene, filter, pictures, view, width, height } = object(record);
  return {
    scene: text(scene) ?? "", filter: text(filter) ?? "", walk: 1,
    ...numbers({ view, width, height }),
    pictures: list(pictures).map(object).map((p) => ({
      picture: text(p.picture) ?? "", where: text(p.where),
      ...numbers({ samples: p.samples, mean: p.mean, largest: p.largest,
        over: p.over, x: p.x, y: p.y }) })),
  };
}

// Of a cell, only what is copied from the results.
export function cleanCell(record) {
  return {
    algorithm: text(record.algorithm) ?? "", kind: text(record.kind),
    status: text(record.status) ?? "unknown", peer: record.peer === true,
    threads: number(record.threads) ?? 1,
    mismatches: number(record.mismatches), compared: number(record.compared),
    reason: text(record.reason), adapted: words(record.adapted),
  };
}
