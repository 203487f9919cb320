// SPDX-License-Identifier: GPL-3.0-or-later
// Everything about one algorithm; or the same of it and one or two others.
import { href, read } from "../data/address.js";
import { count, digits, size, views, where, whole } from "../data/format.js";
import { key, looks } from "../data/looks.js";
import {
  family, PEER, RESTRICTIONS, symbolOf, titleOf, unique,
} from "../data/model.js";
import {
  growthColumns, number, outcomeColumns, placeColumns, timeColumns,
} from "../parts/columns.js";
import { facts, h, link, section } from "../parts/dom.js";
import { chosen, filterForm } from "../parts/filters.js";
import { countPlot, figure, keysByNumber, stepPlot } from "../parts/plots.js";
import { formula } from "../parts/symbols.js";
import { behind, folded, table } from "../parts/table.js";
import { workScale } from "../parts/work_scale.js";
import { sideBySide } from "./beside.js";

const FILTERS = ["view", "size"];
const MOST_BESIDE = 2; // other algorithms
const MANY_RUNGS = 64; // of a ladder; of more, some are left out

export function algorithmPage(report, name) {
  const algorithm = report.algorithm(name);
  if (!report.algorithms.includes(algorithm))
    return { title: "No such algorithm", body: [h("p", {},
      `“${name}” is not in this report; see `, link("#/", "the tree"), ".")] };
  const others = (read().params.get("with") ?? "").split(",").map((other) =>
    report.algorithms.find((a) => a.name === other && a !== algorithm))
    .filter(Boolean).slice(0, MOST_BESIDE);
  return { title: algorithm.title, body: [
    h("p", { class: "kicker" }, key(looks(name)), h("code", {}, name),
      algorithm.known_wrong && " · known to be wrong sometimes",
      report.lessonPages.filter(({ names }) => names.includes(name))
        .map(({ file, scene }) => [" · ", link(`${file}${href("", "",
          { a: name })}`, scene ? `watch it on ${scene}` : "watch it at work")]),
      tryIt(report, name)),
    compareForm(report, algorithm, others),
    ...others.length ? sideBySide(report, [algorithm, ...unique(others)])
      : alone(report, algorithm),
  ] };
}

// In the laboratory, on a scene that it drew.
function tryIt(report, name) {
  const { file, scenes } = report.laboratory ?? { scenes: [] };
  const cell = report.cellsOf(name).find(({ status, scene }) =>
    status === "ok" && scenes.includes(scene));
  return cell ? [" · ", link(`${file}${href("", "", { s: cell.scene, a: name })}`,
    "try it")] : null;
}

function alone(report, algorithm) {
  return [
    facts(descriptor(report, algorithm)),
    section("The sorts it makes", "sorts", sorts(algorithm)),
    section("What it costs, and the prediction", "steps",
      steps(report, algorithm)),
    section("Its pictures", "pictures", pictures(report, algorithm)),
    section("How its counts grow", "growth", growing(report, algorithm)),
    cellsOf(report, algorithm),
  ];
}

export function descriptor(report, a) {
  const meaning = report.kind(a.kind)?.meaning;
  return [
    ["Authors", a.authors],
    ["Year", a.year],
    ["Source", a.source],
    ["Class", a.taxonomy === PEER
      ? "a peer: another renderer on the same bench"
      : [a.taxonomy, a.branch].filter(Boolean).join(", ")],
    ["Makes", meaning && meaning + (a.visible_only
      ? "; only whether it is visible, not how many faces hide it" : "")],
    ["Sorting order", a.sort_order],
    ["Coherence", a.coherence],
    ["Demands", a.restrictions && (a.restrictions.length
      ? h("ul", { class: "plain" }, a.restrictions.map((code) => h("li", {},
        h("abbr", { title: RESTRICTIONS[code] }, code),
        ` ${RESTRICTIONS[code] ?? ""}`)))
      : "nothing of the scene")],
  ];
}

// A choice for each of the others, and one more while there is room.
function compareForm(report, algorithm, others) {
  const chosen = others.map((a) => a.name);
  const choose = (k) => (e) => {
    const names = chosen.slice();
    names[k] = e.target.value;
    const left = unique(names.filter(Boolean)).join(",");
    location.hash = href("algorithm", algorithm.name, left ? { with: left } : {});
  };
  const slot = (k) => h("label", {}, k ? "and with" : "Compare with",
    h("select", { name: k ? `with-${k}` : "with", onchange: choose(k) },
      h("option", { value: "" }, "no other"),
      report.algorithms.filter((a) => a !== algorithm && (a.name === chosen[k] ||
        !chosen.includes(a.name))).map((a) => h("option",
        { value: a.name, selected: a.name === chosen[k] }, a.name))));
  return h("form", { class: "filters", onsubmit: (e) => e.preventDefault() },
    Array.from({ length: Math.min(MOST_BESIDE, chosen.length + 1) },
      (_, k) => slot(k)));
}

export function sorts(a) {
  if (!a.sorts?.length) return null;
  return h("ol", { class: "sorts" }, a.sorts.map((s) => h("li", {},
    h("b", {}, s.what), " by ", h("b", {}, s.key), `: ${s.method}, ${s.often}`)));
}

// --- Table III ---

export function stepRows(report, a) {
  return (report.tables.table3 ?? []).filter((r) => r.algorithm === a.name);
}

function steps(report, a) {
  const rows = stepRows(report, a);
  const { environments } = report;
  if (!rows.length || !environments.length) return null;
  const measured = environments.map((e, k) => [e, k])
    .filter(([, k]) => rows.some((r) => r.measured?.[k] > 0));
  const plotted = measured.flatMap(([e, k]) => rows.map((r) => ({
    environment: e.scene, step: r.step, predicted: r.predicted?.[k] ?? null,
    measured: r.measured?.[k] ?? null })));
  const numbers = table({ id: "steps", caption: "Table III of " +
    `${a.name}: cost is price × count, in comparisons`, rows, columns: [
    { name: "step", label: "step", whole: true, value: (r) => r.step,
      show: (r) => r.once ? `${r.step} (not each frame)` : r.step },
    { name: "formula", label: "the paper’s formula", prose: true,
      value: (r) => r.formula ?? null, show: (r) => formula(r.formula ?? "–") },
    { name: "prices", label: "prices", prose: true,
      value: (r) => (r.terms ?? []).map((t) => `${t.price} ${t.kind}`).join(", ") },
    ...measured.flatMap(([e, k]) => [
      number(`predicted-${k}`, "predicted", (r) => r.predicted?.[k], count),
      number(`measured-${k}`, "measured", (r) => r.measured?.[k], count),
      number(`ratio-${k}`, "ratio", (r) => r.ratio?.[k], digits),
    ].map((c) => ({ ...c, group: e.scene }))),
    ...growthColumns,
  ] });
  const drawable = plotted.some((r) => r.measured > 0 || r.predicted > 0);
  return drawable ? figure({
    caption: `The steps of ${a.name} on ${measured.map(([e]) => e.scene)
      .join(", ")}: the ring is the prediction of the paper’s formula from the ` +
      "scene’s statistics, the disk is the count.",
    draw: (width) => stepPlot(plotted, a.name, width), numbers }) : numbers;
}

// --- pictures ---

function pictures(report, a) {
  const shown = report.pictures
    .map((p) => ({ p, entry: p.entries?.find((e) => e.algorithm === a.name) }))
    .filter(({ entry }) => entry);
  return shown.length ? [
    shown.some(({ entry }) => entry.work) && workScale(),
    h("div", { class: "pictures" }, shown.map(({ p, entry }) =>
      h("div", { class: "pair" },
        h("h3", {}, titleOf(p)),
        h("div", {}, picturesOf(a, p, entry)),
        h("p", {}, verdict(report, entry), p.probe && [" · ",
          link(href("probe", p.key, { module: a.name }), "probe")])))),
  ] : null;
}

// What algorithm a drew of a scene and view, where it differs, and its work.
export function picturesOf(a, p, entry) {
  return [
    image(entry.drawing, p, `line drawing of ${p.scene} by ${a.name}`, "drawing"),
    !entry.drawing && entry.status === "ok" &&
      image(entry.picture ?? p.picture, p, `${p.scene}, as drawn by ${a.name}`, "picture"),
    image(entry.difference, p, `where ${a.name} differs on ${p.scene}`,
      "differences"),
    image(entry.work, p, `work picture of ${a.name} on ${p.scene}`,
      "work: how often each sample was touched"),
    passesOf(a, p, entry)];
}

// The picture and how uncertain it is, after every pass.
function passesOf(a, p, { passes }) {
  if (!passes?.length) return null;
  const all = p.width * p.height;
  return h("details", { class: "passes", open: true },
    h("summary", {}, "Pass by pass, with how uncertain each pixel is: black if " +
      "it is known exactly, brightest if it is as uncertain as it may be, or more"),
    h("div", {}, passes.map(({ picture, uncertainty, uncertain }, k) => [
      image(picture, p, `${p.scene} after pass ${k} of ${a.name}`,
        `pass ${k}: ${digits(100 * (1 - uncertain / all))} % within the tolerance`),
      image(uncertainty, p,
        `how uncertain ${p.scene} is after pass ${k} of ${a.name}`,
        `pass ${k}: uncertainty`)])));
}

function image(source, { width, height }, alt, caption) {
  return source ? h("figure", {}, link(source,
    h("img", { src: source, alt, width, height })),
  h("figcaption", {}, caption)) : null;
}

export function verdict(report, { status, mismatches, kind }) {
  const what = report.kind(kind)?.places ?? "samples";
  return status === "wrong"
    ? `${symbolOf(status)} wrong: ${whole(mismatches)} ${what} differ`
    : `${symbolOf(status)} ${status}`;
}

// --- counts over faces ---

// The largest family of scenes, seen from one view in one size, whose cells of
// this algorithm were counted, by relevant faces.
function growing(report, a) {
  const faces = new Map(report.views.map((v) => [where(v), v.table1.F_r]));
  const ladders = new Map();
  for (const c of report.cellsOf(a.name)) {
    const F_r = faces.get(where(c));
    if (!c.counts || !(F_r > 0)) continue;
    const name = `${family(c.scene)}, view ${views(c)}, ${size(c)}`;
    if (!ladders.has(name)) ladders.set(name, new Map());
    ladders.get(name).set(F_r, { ...c, F_r });
  }
  const [name, rungs] = [...ladders].sort(([, x], [, y]) => y.size - x.size)[0] ??
    [null, new Map()];
  if (rungs.size < 3) return null;
  const rows = [...rungs.values()].sort((x, y) => x.F_r - y.F_r)
    .filter((_, k) => k % Math.ceil(rungs.size / MANY_RUNGS) === 0);
  const counters = (a.counters ?? []).map((c) => c.name)
    .filter((counter) => rows.some((r) => r.counts[counter] > 0));
  const points = counters.flatMap((counter) => rows.map((r) => ({ counter,
    x: r.F_r, y: r.counts[counter], place: where(r) }))).filter((p) => p.y > 0);
  return figure({ caption: `Counts of ${a.name} over relevant faces: ${name}.`,
    draw: (width) => countPlot(points, counters, width),
    keys: keysByNumber(counters),
    numbers: behind(table({ id: "growing", rows,
      caption: `Counts of ${a.name} over relevant faces`, columns: [
        ...placeColumns, number("F_r", "relevant faces", (r) => r.F_r, whole),
        ...counters.map((counter) => number(counter, counter,
          (r) => r.counts[counter], count))] })) });
}

// --- the cells that the filters choose ---

function cellsOf(report, a) {
  const cells = report.cellsOf(a.name);
  if (!cells.length) return null;
  const results = h("div");
  const update = () => {
    const some = chosen(report, cells, FILTERS);
    results.replaceChildren(...some.length ? [
      section("What it counted", "counters", counters(report, a, some)),
      section("How long it took", "timings", timings(report, a, some)),
      section("The outcome of its cells", "cells", outcomes(some)),
    ].filter(Boolean) : [h("p", {}, "These filters leave nothing.")]);
  };
  update();
  return [filterForm(report, cells, FILTERS, update), results];
}

// Counts on the environments of 1974, or, if those are not among the cells, on
// the first ones. All others are folded away.
function counters(report, a, cells) {
  const counted = cells.filter((c) => c.counts);
  if (!counted.length || !a.counters?.length) return null;
  const wanted = new Set(report.environments.map(where));
  const main = counted.filter((c) => wanted.has(where(c)));
  const few = (main.length ? main : counted).slice(0, 4);
  const kept = a.counters.filter((k) => counted.some((c) => k.name in c.counts));
  return [
    table({ id: "counters", caption: `Counters of ${a.name}`, rows: kept,
      columns: [
        { name: "counter", label: "counter", value: (k) => k.name },
        ...few.map((c, n) => ({ ...number(`c${n}`, `view ${views(c)}, ${size(c)}`,
          (k) => c.counts[k.name], count), group: c.scene })),
        { name: "meaning", label: "what is counted", prose: true,
          value: (k) => k.meaning },
      ] }),
    folded(`All ${counted.length} cells`,
      table({ id: "counts", caption: `Counters of ${a.name}, cell by cell`,
        rows: counted, columns: [...placeColumns, ...kept.map((k) => ({
          ...number(k.name, k.name, (c) => c.counts[k.name], whole),
          title: () => k.meaning }))] })),
  ];
}

function timings(report, a, cells) {
  const rows = cells.filter((c) => c.seconds);
  return rows.length ? table({ id: "timings",
    caption: `Seconds a frame of ${a.name}`, rows,
    columns: [...placeColumns, ...timeColumns(report, rows)] }) : null;
}

function outcomes(cells) {
  const rows = cells.filter((c) => c.status !== "ok" || c.adapted.length);
  return rows.length ? table({ id: "outcomes", rows,
    caption: "Cells that did not pass, or whose scene was adapted",
    columns: [...placeColumns, ...outcomeColumns(rows)] }) : null;
}
