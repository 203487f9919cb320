// SPDX-License-Identifier: GPL-3.0-or-later
import { facts, h, link, section } from "./dom.js";
import { href } from "./address.js";
import { digits, memory, whole } from "./format.js";
import { key } from "./looks.js";
import { STATUSES, unique } from "./model.js";
import { table } from "./table.js";
import { apart, tree } from "./tree.js";

export function indexPage(report) {
  return { title: report.title, body: [
    h("p", { class: "lead" },
      "In 1974 Sutherland, Sproull and Schumacker compared ten " +
      "hidden-surface algorithms and estimated the cost of each. Here each of " +
      "them is a program, and so are algorithms that grew out of them. All " +
      "must draw the same correct picture, sample for sample, and their work " +
      "is counted and timed."),
    h("p", {}, "Begin with an algorithm in the tree; or see ",
      link(href("check"), "whether their pictures agree"), ", ",
      link(href("sweeps"), "how they grow"), ", ",
      link(href("timings"), "how fast they are"), " and ",
      link(href("tables"), "the tables of 1974 beside our counts"), "."),
    section("The algorithms", "tree", tree(report), apart(report)),
    section("What was run", "run", summary(report)),
    section("Where and when", "machine", report.headers.map(header)),
  ] };
}

function summary(report) {
  if (!report.cells.length) return null;
  const statuses = Object.keys(STATUSES)
    .filter((s) => report.cells.some((c) => c.status === s));
  const rows = report.algorithms
    .map((a) => ({ ...a, cells: report.cellsOf(a.name),
      mean: report.geometric.find((g) => g.algorithm === a.name) }))
    .filter((r) => r.cells.length);
  const of = (row, status) => row.cells.filter((c) => c.status === status);
  const places = unique(report.cells.map((c) => `${c.scene} ${c.view}`)).length;
  return [
    h("p", {}, `${whole(report.cells.length)} cells: each is one algorithm on ` +
      `one scene, view and size; ${places} views in all. A cell is timed only if ` +
      "its picture equals the oracle's."),
    table({ id: "cells", caption: "Cells by outcome", rows, columns: [
      { name: "algorithm", label: "algorithm", value: (r) => r.name,
        show: (r) => link(href("algorithm", r.name), key(r.name), r.name) },
      { name: "class", label: "class", whole: true,
        value: (r) => r.taxonomy ?? "" },
      ...statuses.map((status) => ({
        name: status, label: `${STATUSES[status].symbol} ${status}`, number: true,
        title: () => STATUSES[status].meaning,
        value: (r) => of(r, status).length,
        show: (r) => of(r, status).length ?
          link(href("check", "", { algorithms: r.name, status }),
            whole(of(r, status).length)) : h("span", { class: "faint" }, "0") })),
      report.geometric.length && { name: "ratio", number: true,
        label: `time, ${report.baseline ?? "baseline"} = 1`,
        title: (r) => r.mean && `geometric mean over the ${r.mean.cells} cells ` +
          "that both solved",
        value: (r) => r.mean?.ratio ?? null, show: (r) => digits(r.mean?.ratio) },
    ].filter(Boolean) }),
  ];
}

function header(record) {
  const { machine = {} } = record;
  return facts([
    ["Run", record.date && new Date(record.date).toUTCString()],
    ["Command", record.command && h("code", {}, [record.command].flat()
      .join(" "))],
    ["hsr", [record.version, record.commit && `commit ${record.commit}`]
      .filter(Boolean).join(", ")],
    ["Compiler", [record.compiler, record.flags].filter(Boolean).join(", ")],
    ["Processor", machine.cpu && `${machine.cpu}; ${machine.cores} cores, ${
      machine.threads} threads`],
    ["Caches", machine.caches?.map((c) => `L${c.level} ${memory(c.kb)}`)
      .join(", ")],
    ["Memory", machine.memory_kb && memory(machine.memory_kb)],
    ["System", machine.os],
    ["Governor", machine.governor],
    ["Load before", machine.load?.map((x) => x.toFixed(2)).join(", ")],
    ["Samples", record.starts && `${record.starts} starts of each process, ${
      record.repetitions} repetitions a start, in random order (seed ${
      record.seed})`],
    ["Limits", [record.timeout && `${record.timeout} s a picture`,
      record.memory_mb && `${whole(record.memory_mb)} MB`].filter(Boolean)
      .join(", ")],
    ["Code", record.code && h("code", {}, record.code)],
  ]);
}
