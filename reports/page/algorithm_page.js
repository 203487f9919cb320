// SPDX-License-Identifier: GPL-3.0-or-later
// Everything about one algorithm, and another one beside it if wanted.
import { facts, h, link, section } from "./dom.js";
import { href, read } from "./address.js";
import { placeColumns } from "./filters.js";
import {
  count, digits, exponent, interval, memory, seconds, where, whole,
} from "./format.js";
import { key } from "./looks.js";
import {
  PEER, pictureId, RESTRICTIONS, STATUSES, unique,
} from "./model.js";
import { figure, stepPlot } from "./plots.js";
import { formula } from "./symbols.js";
import { table } from "./table.js";

const KINDS = { ids: "the visible face of every sample",
  segments: "a line drawing", filtered: "filtered colours",
  none: "no picture" };

export function algorithmPage(report, name) {
  const algorithm = report.algorithm(name);
  if (!report.algorithms.includes(algorithm))
    return { title: "No such algorithm", body: [h("p", {},
      `“${name}” is not in this report; see `, link("#/", "the tree"), ".")] };
  const other = report.algorithms.find((a) => a.name === read().params
    .get("with") && a !== algorithm);
  return { title: algorithm.title, body: [
    h("p", { class: "kicker" }, key(name), h("code", {}, name),
      algorithm.known_wrong && " · known to be wrong sometimes"),
    compareForm(report, algorithm, other),
    other ? sideBySide(report, algorithm, other)
      : [facts(descriptor(report, algorithm)),
        section("The sorts it makes", "sorts", sorts(algorithm))],
    section("What it costs, and the prediction", "steps",
      steps(report, algorithm)),
    section("Its pictures", "pictures", pictures(report, algorithm)),
    section("What it counted", "counters", counters(report, algorithm)),
    section("How long it took", "timings", timings(report, algorithm)),
    section("The outcome of its cells", "cells", outcomes(report, algorithm)),
  ] };
}

function descriptor(report, a) {
  return [
    ["Authors", a.authors],
    ["Year", a.year],
    ["Source", a.source],
    ["Class", a.taxonomy === PEER
      ? "a peer: another renderer on the same bench" : a.taxonomy],
    ["Makes", KINDS[a.kind] && KINDS[a.kind] + (a.visible_only
      ? " that tells what is visible, not how many faces hide the rest"
      : "")],
    ["Sorting order", a.sort_order],
    ["Coherence", a.coherence],
    ["Demands", a.restrictions && (a.restrictions.length
      ? h("ul", { class: "plain" }, a.restrictions.map((code) => h("li", {},
        h("abbr", { title: RESTRICTIONS[code] }, code),
        ` ${RESTRICTIONS[code] ?? ""}`)))
      : "nothing of the scene")],
  ];
}

function compareForm(report, algorithm, other) {
  const go = (e) => {
    location.hash = href("algorithm", algorithm.name,
      e.target.value ? { with: e.target.value } : {});
  };
  return h("form", { class: "filters", onsubmit: (e) => e.preventDefault() },
    h("label", {}, "Compare with",
      h("select", { name: "with", onchange: go },
        h("option", { value: "" }, "no other"),
        report.algorithms.filter((a) => a !== algorithm).map((a) =>
          h("option", { value: a.name, selected: a === other }, a.name)))));
}

function sorts(a) {
  if (!a.sorts?.length) return null;
  return h("ol", { class: "sorts" }, a.sorts.map((s) => h("li", {},
    h("b", {}, s.what), " by ", h("b", {}, s.key), `: ${s.method}, ${s.often}`)));
}

// Two algorithms, one property in each row.
function sideBySide(report, a, b) {
  const [left, right] = [a, b].map((x) => [...descriptor(report, x),
    ["Sorts", sorts(x)], ["Steps", stepList(report, x)]]);
  const rows = left.map(([term, value], k) => [term, value, right[k][1]])
    .filter(([, x, y]) => x || y);
  return [
    h("div", { class: "table" }, h("div", { class: "scroll", tabindex: 0,
      role: "region", "aria-label": `${a.name} beside ${b.name}` },
    h("table", { class: "beside" },
      h("caption", {}, `${a.title}, beside ${b.title}`),
      h("thead", {}, h("tr", {}, h("td"), [a, b].map((x) =>
        h("th", { scope: "col" }, link(href("algorithm", x.name), key(x.name),
          x.name))))),
      h("tbody", {}, rows.map(([term, x, y]) => h("tr", {},
        h("th", { scope: "row" }, term), h("td", {}, x ?? "–"),
        h("td", {}, y ?? "–"))))))),
    timesBeside(report, a, b),
  ];
}

function stepList(report, a) {
  const rows = stepRows(report, a);
  const names = report.environments.map((e) => e.scene);
  if (!rows.length || !names.length)
    return a.steps?.length ? h("ol", { class: "sorts" }, a.steps.map((s) =>
      h("li", {}, h("b", {}, s.label),
        s.formula && [": ", formula(s.formula)]))) : null;
  return h("ol", { class: "sorts" }, rows.map((r) => h("li", {},
    h("b", {}, r.step), `: ${names.map((name, k) =>
      `${count(r.measured?.[k])} on ${name}`).join(", ")}`)));
}

function timesBeside(report, a, b) {
  const rows = report.cellsOf(a.name).filter((c) => c.seconds)
    .map((c) => ({ ...c, other: report.cellsOf(b.name).find((d) => d.seconds &&
      where(d) === where(c) && d.threads === c.threads) }))
    .filter((r) => r.other);
  if (!rows.length) return null;
  const apart = (r) => r.seconds.low > r.other.seconds.high ||
    r.other.seconds.low > r.seconds.high;
  return table({ id: "beside", rows,
    caption: `Seconds a frame of ${a.name} and ${b.name}`,
    columns: [...placeColumns,
      { name: "a", label: a.name, number: true,
        value: (r) => r.seconds.median, show: (r) => spread(r.seconds) },
      { name: "b", label: b.name, number: true,
        value: (r) => r.other.seconds.median,
        show: (r) => spread(r.other.seconds) },
      { name: "ratio", label: `${a.name} / ${b.name}`, number: true,
        value: (r) => r.seconds.median / r.other.seconds.median,
        show: (r) => [digits(r.seconds.median / r.other.seconds.median),
          apart(r) ? null : " (intervals overlap)"] }] });
}

function spread({ median, low, high }) {
  return interval(median, low, high, seconds);
}

function stepRows(report, a) {
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
    `${a.name}: cost is factor × count, in comparisons`, rows, columns: [
    { name: "step", label: "step", whole: true, value: (r) => r.step,
      show: (r) => r.once ? `${r.step} (not each frame)` : r.step },
    { name: "formula", label: "the paper’s formula", prose: true,
      value: (r) => r.formula ?? null, show: (r) => formula(r.formula ?? "–") },
    { name: "factor", label: "factor", value: (r) => r.factor, number: true },
    ...measured.flatMap(([e, k]) => [
      { group: e.scene, name: `predicted-${k}`, label: "predicted", number: true,
        value: (r) => r.predicted?.[k] ?? null,
        title: (r) => whole(r.predicted?.[k]),
        show: (r) => count(r.predicted?.[k]) },
      { group: e.scene, name: `measured-${k}`, label: "measured", number: true,
        value: (r) => r.measured?.[k] ?? null,
        title: (r) => whole(r.measured?.[k]),
        show: (r) => count(r.measured?.[k]) },
      { group: e.scene, name: `ratio-${k}`, label: "ratio", number: true,
        value: (r) => r.ratio?.[k] ?? null, show: (r) => digits(r.ratio?.[k]) },
    ]),
    { group: "grows as faces to the", name: "predicted", label: "predicted",
      number: true, value: (r) => r.growth?.predicted ?? null,
      show: (r) => exponent(r.growth?.predicted) },
    { group: "grows as faces to the", name: "measured", label: "measured",
      number: true, value: (r) => r.growth?.measured ?? null,
      show: (r) => growth(r.growth) },
  ] });
  const drawable = plotted.some((r) => r.measured > 0 || r.predicted > 0);
  return drawable ? figure({
    caption: `The steps of ${a.name} on ${measured.map(([e]) => e.scene)
      .join(", ")}: the ring is the prediction of the paper’s formula from the ` +
      "scene’s statistics, the disk is the count.",
    draw: (width) => stepPlot(plotted, a.name, width), numbers }) : numbers;
}

export function growth(g) {
  return interval(g?.measured, g?.low, g?.high, exponent);
}

function pictures(report, a) {
  const shown = report.pictures
    .map((p) => ({ p, entry: p.entries?.find((e) => e.algorithm === a.name) }))
    .filter(({ entry }) => entry);
  return shown.length ? h("div", { class: "pictures" },
    shown.map(({ p, entry }) => h("div", { class: "pair" },
      h("h3", {}, `${p.scene}, view ${p.view}`),
      h("div", {}, image(entry.drawing, p, `line drawing of ${p.scene} by ${
        a.name}`, "drawing"),
      entry.kind === "ids" && entry.status === "ok" &&
        image(p.picture, p, `${p.scene}, as drawn by ${a.name}`, "picture"),
      image(entry.difference, p, `where ${a.name} differs on ${p.scene}`,
        "differences"),
      image(entry.work, p, `work picture of ${a.name} on ${p.scene}`,
        "work: lighter samples were touched more often")),
      h("p", {}, verdict(entry), p.probe && [" · ",
        link(href("probe", pictureId(p), { module: a.name }), "probe")])))) : null;
}

function image(source, { width, height }, alt, caption) {
  return source ? h("figure", {}, link(source,
    h("img", { src: source, alt, width, height, loading: "lazy" })),
  h("figcaption", {}, caption)) : null;
}

function verdict({ status, mismatches, kind }) {
  const symbol = STATUSES[status]?.symbol ?? "";
  const what = { segments: "edges", filtered: "pixels" }[kind] ?? "samples";
  return status === "wrong" ? `${symbol} wrong: ${whole(mismatches)} ${what} differ`
    : `${symbol} ${status}`;
}

// Counts on the environments of 1974, or, if those were not run, on the first
// scenes that were. All other scenes are folded away.
function counters(report, a) {
  const counted = report.cellsOf(a.name).filter((c) => c.counts);
  if (!counted.length || !a.counters?.length) return null;
  const wanted = new Set(report.environments.map((e) => where(e)));
  const main = counted.filter((c) => wanted.has(where(c)));
  const chosen = (main.length ? main : counted).slice(0, 4);
  const kept = a.counters.filter((k) => counted.some((c) => k.name in c.counts));
  return [
    table({ id: "counters", caption: `Counters of ${a.name}`, rows: kept,
      columns: [
        { name: "counter", label: "counter", value: (k) => k.name },
        ...chosen.map((c, n) => ({ name: `c${n}`, number: true,
          label: `${c.scene}, view ${c.view}`, value: (k) => c.counts[k.name] ??
            null, title: (k) => `${where(c)}: ${whole(c.counts[k.name])}`,
          show: (k) => count(c.counts[k.name]) })),
        { name: "meaning", label: "what is counted", prose: true,
          value: (k) => k.meaning },
      ] }),
    h("details", { class: "behind" },
      h("summary", {}, `All ${counted.length} cells`),
      table({ id: "counts", caption: `Counters of ${a.name}, cell by cell`,
        rows: counted, columns: [...placeColumns, ...kept.map((k) => ({
          name: k.name, label: k.name, number: true, value: (c) =>
            c.counts[k.name] ?? null, title: () => k.meaning,
          show: (c) => whole(c.counts[k.name]) }))] })),
  ];
}

function timings(report, a) {
  const rows = report.cellsOf(a.name).filter((c) => c.seconds);
  return rows.length ? table({ id: "timings",
    caption: `Seconds a frame of ${a.name}`, rows,
    columns: [...placeColumns, ...timeColumns(report, rows)] }) : null;
}

export function timeColumns(report, rows) {
  const phases = unique(rows.flatMap((r) => Object.entries(r.phases ?? {})
    .filter(([, s]) => s !== null).map(([phase]) => phase)));
  return [
    rows.some((r) => r.threads > 1) && { name: "threads", label: "threads",
      number: true, value: (r) => r.threads },
    { name: "median", label: "median", number: true,
      value: (r) => r.seconds.median, show: (r) => seconds(r.seconds.median) },
    { name: "interval", label: "95 % interval", number: true,
      value: (r) => r.seconds.high - r.seconds.low,
      show: (r) => `${seconds(r.seconds.low)} – ${seconds(r.seconds.high)}` },
    { name: "least", label: "least", number: true,
      value: (r) => r.seconds.min, show: (r) => seconds(r.seconds.min) },
    rows.some((r) => r.ratio) && { name: "ratio",
      label: `to ${report.baseline ?? "baseline"}`, number: true,
      value: (r) => r.ratio?.value ?? null, show: ratio },
    rows.some((r) => r.memory_kb?.peak) && { name: "peak", label: "peak memory",
      number: true, value: (r) => r.memory_kb?.peak ?? null,
      show: (r) => memory(r.memory_kb?.peak) },
    ...phases.map((phase) => ({ group: "apart from the frame", name: phase,
      label: phase, number: true, value: (r) => r.phases?.[phase] ?? null,
      show: (r) => seconds(r.phases?.[phase]) })),
  ].filter(Boolean);
}

function ratio({ ratio: r, algorithm }) {
  if (!r) return "–";
  if (r.to === algorithm) return "1";
  return [interval(r.value, r.low, r.high),
    r.distinguishable ? null : h("span", { class: "note" },
      " not distinguishable")];
}

function outcomes(report, a) {
  const rows = report.cellsOf(a.name)
    .filter((c) => c.status !== "ok" || c.adapted?.length);
  return rows.length ? table({ id: "outcomes", rows,
    caption: "Cells that did not pass, or whose scene was adapted",
    columns: [...placeColumns, ...outcomeColumns(rows)] }) : null;
}

export function outcomeColumns(rows) {
  return [
    { name: "status", label: "outcome", value: (r) => r.status,
      show: (r) => `${STATUSES[r.status]?.symbol ?? ""} ${r.status}` },
    rows.some((r) => r.mismatches) && { name: "mismatches", label: "differing",
      number: true, value: (r) => r.mismatches ?? null,
      show: (r) => r.compared ? `${whole(r.mismatches)} of ${whole(r.compared)}`
        : whole(r.mismatches) },
    rows.some((r) => r.adapted?.length) && { name: "adapted",
      label: "scene adapted", value: (r) => r.adapted?.join(", ") ?? "" },
    rows.some((r) => r.reason) && { name: "reason", label: "why",
      prose: true, value: (r) => r.reason ?? null, show: (r) => r.reason ?? "" },
  ].filter(Boolean);
}
