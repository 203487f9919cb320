// SPDX-License-Identifier: GPL-3.0-or-later
import { href } from "../data/address.js";
import { digits, memory, whole } from "../data/format.js";
import { STATUSES, titleOf } from "../data/model.js";
import { named } from "../parts/columns.js";
import { facts, h, link, section } from "../parts/dom.js";
import { folded, table } from "../parts/table.js";
import { apart, tree } from "../parts/tree.js";

export function indexPage(report) {
  return { title: report.title, body: [
    h("div", { class: "first" },
      h("div", {},
        h("p", { class: "lead" },
          "In 1974 Sutherland, Sproull and Schumacker compared ten " +
          "hidden-surface algorithms and estimated the cost of each. Here each " +
          "of them is a program, and so are algorithms that grew out of them. " +
          "All must draw the same correct picture, sample for sample, and " +
          "their work is counted and timed."),
        h("p", {}, "Begin with an algorithm in the tree; or see ",
          link(href("check"), "whether their pictures agree"), ", ",
          link(href("sweeps"), "how they grow"), ", ",
          link(href("timings"), "how fast they are"), " and ",
          link(href("tables"), "the tables of 1974 beside our counts"), "."),
        watching(report.lessonPages), trying(report.laboratory)),
      picture(report)),
    section("The algorithms", "tree", h("p", {}, "The survey’s ten are framed. ",
      link(href("tables", "figure-13"), "Its own tree"), " is with the tables."),
    tree(report), apart(report)),
    section("What was run", "run", summary(report), leftOut(report)),
    section("Where and when", "machine", runs(report.headers)),
  ] };
}

function watching(pages) {
  return pages.length ? h("p", {}, pages.map(({ file, scene }, k) => [
    k ? ", " : "", link(file, scene ? `on ${scene}` : "Watch the ten at work")]),
  ", step by step.") : null;
}

function trying(laboratory) {
  return laboratory ? h("p", {}, "Or ", link(laboratory.file, "try them in the " +
    "laboratory"), ": they run in the page, on scenes that you change.") : null;
}

// Of the largest of the environments of 1974 that have one; else of the scene
// with the most faces, which comes last.
function picture(report) {
  const shown = report.environments.map(report.picture).filter(Boolean)
    .at(-1) ?? report.pictures.at(-1);
  if (!shown) return null;
  const { width, height } = shown;
  const drawn = shown.entries.filter((e) => e.status === "ok").length;
  return h("figure", {}, link(href("probe", shown.key),
    h("img", { src: shown.picture, width, height,
      alt: titleOf(shown) })),
  h("figcaption", {}, `${titleOf(shown)}. ${drawn > 1
    ? `${drawn} algorithms of this report draw it correctly. ` : ""}` +
    "It opens under the magnifying glass."));
}

function leftOut(report) {
  if (!report.leftOut.length) return null;
  const n = report.leftOut.reduce((sum, { drawings }) => sum + drawings, 0);
  return [
    h("p", {}, `${whole(n)} drawings are not here, since there was no time for ` +
      "them or a scene could not be opened. More time for them: ",
    h("code", {}, "hsr report --budget SECONDS --timeout SECONDS"), "."),
    folded("Which drawings, and why", table({ id: "left-out",
      caption: "Drawings that are left out", rows: report.leftOut, columns: [
        { name: "scene", label: "scene", value: (r) => r.scene },
        { name: "view", label: "view", number: true, value: (r) => r.view },
        { name: "drawings", label: "drawings", number: true,
          value: (r) => r.drawings },
        { name: "why", label: "why", prose: true, value: (r) => r.why }] })),
  ];
}

function summary(report) {
  if (!report.cells.length) return null;
  const statuses = Object.keys(STATUSES)
    .filter((s) => report.cells.some((c) => c.status === s));
  const means = new Map(report.geometric.map((g) => [g.algorithm, g]));
  const rows = report.algorithms.map((a) => ({ ...a,
    mean: means.get(a.name), counts: counted(report.cellsOf(a.name)) }))
    .filter((r) => r.counts.size);
  const places = new Set(report.cells.map((c) => c.place)).size;
  return [
    h("p", {}, `${whole(report.cells.length)} cells: each is one algorithm on ` +
      `one scene, view and size; ${whole(places)} of these in all. A cell is ` +
      "timed only if its picture equals the oracle’s."),
    table({ id: "cells", caption: "Cells by outcome", rows, columns: [
      { name: "algorithm", label: "algorithm", value: (r) => r.name,
        show: (r) => named(r.name) },
      { name: "class", label: "class", whole: true,
        value: (r) => r.taxonomy ?? "" },
      ...statuses.map((status) => ({
        name: status, label: `${STATUSES[status].symbol} ${status}`, number: true,
        title: () => STATUSES[status].meaning,
        value: (r) => r.counts.get(status) ?? 0,
        show: (r) => r.counts.has(status) ?
          link(href("check", "", { algorithms: r.name, status }),
            whole(r.counts.get(status))) : h("span", { class: "faint" }, "0") })),
      report.geometric.length && { name: "ratio", number: true,
        label: `time, ${report.baseline ?? "baseline"} = 1`,
        title: (r) => r.mean && `geometric mean over the ${r.mean.cells} cells ` +
          "that both solved",
        value: (r) => r.mean?.ratio ?? null, show: (r) => digits(r.mean?.ratio) },
    ].filter(Boolean) }),
  ];
}

// The last run, and those before it.
function runs(headers) {
  const sorted = [...headers].sort((a, b) =>
    String(b.date).localeCompare(String(a.date)));
  const [last, ...others] = sorted.map(header);
  return [last, others.length ? folded(others.length === 1 ? "An earlier run"
    : `${whole(others.length)} earlier runs`, others) : null];
}

function counted(cells) {
  const counts = new Map();
  for (const { status } of cells)
    counts.set(status, (counts.get(status) ?? 0) + 1);
  return counts;
}

function header(record) {
  const { machine } = record;
  const day = new Date(record.date ?? NaN);
  return facts([
    ["Run", Number.isNaN(day.getTime()) ? record.date : day.toUTCString()],
    ["Command", record.command && h("code", {}, record.command)],
    ["hsr", [record.version, record.commit && `commit ${record.commit}`]
      .filter(Boolean).join(", ")],
    ["Compiler", [record.compiler, record.flags].filter(Boolean).join(", ")],
    ["Processor", [machine.cpu, machine.cores && `${machine.cores} cores`,
      machine.threads && `${machine.threads} threads`].filter(Boolean)
      .join(", ")],
    ["Caches", machine.caches.map((c) => `L${c.level} ${memory(c.kb)}`)
      .join(", ")],
    ["Memory", machine.memory_kb && memory(machine.memory_kb)],
    ["System", machine.os],
    ["Governor", machine.governor],
    ["Load before", machine.load.map((x) => x.toFixed(2)).join(", ")],
    ["Samples", record.starts && `${record.starts} starts of each process, ${
      record.repetitions ?? "–"} repetitions a start, in random order (seed ${
      record.seed ?? "–"})`],
    ["Limits", [record.timeout && `${record.timeout} s a picture`,
      record.memory_mb && `${whole(record.memory_mb)} MB`].filter(Boolean)
      .join(", ")],
    ["Code", record.code && h("code", {}, record.code)],
  ]);
}
