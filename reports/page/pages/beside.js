// SPDX-License-Identifier: GPL-3.0-or-later
// Two or three algorithms beside one another: what they are, their pictures, the
// work in them on one scale, their steps and counters, and their times on the same
// cells.
import { href } from "../data/address.js";
import { count, digits, interval, seconds, size, views,
  where } from "../data/format.js";
import { titleOf, unique } from "../data/model.js";
import { named, number, placeColumns } from "../parts/columns.js";
import { h, link, section } from "../parts/dom.js";
import { formula } from "../parts/symbols.js";
import { table } from "../parts/table.js";
import { workScale } from "../parts/work_scale.js";
import { descriptor, picturesOf, sorts, stepRows,
  verdict } from "./algorithm.js";

const MOST_PICTURES = 8; // scenes and views; of more, the first
const MOST_PLACES = 3; // whose counters are shown

export function sideBySide(report, all) {
  return [
    properties(report, all),
    watching(report, all),
    section("Their pictures", "pictures", pictures(report, all)),
    section("What they cost, and the predictions", "steps", steps(report, all)),
    section("What they counted", "counters", counters(report, all)),
    section("How long they took", "times", times(report, all)),
  ];
}

function properties(report, all) {
  const lists = all.map((x) => [...descriptor(report, x), ["Sorts", sorts(x)]]);
  const rows = lists[0].map(([term], k) => ({ term,
    values: lists.map((list) => list[k][1]) }))
    .filter(({ values }) => values.some(Boolean));
  const text = (x) => x?.textContent ?? x;
  return table({ caption: all.map((x) => x.title).join(", beside "), rows,
    look: "beside", columns: [
      { name: "property", label: "of the algorithm", value: (r) => r.term },
      ...all.map((x, k) => ({ name: x.name, label: named(x.name),
        value: (r) => r.values[k] ?? "–", csv: (r) => text(r.values[k]) }))] });
}

function watching(report, all) {
  const [first] = report.lessonPages.filter(({ scene, names }) =>
    scene && all.every((x) => names.includes(x.name)));
  return first ? h("p", {}, link(`${first.file}${href("", "",
    { a: all.map((x) => x.name).join(",") })}`,
  `Watch them at work side by side, on ${first.scene}`)) : null;
}

// --- Pictures ---

function pictures(report, all) {
  const shown = report.pictures.map((p) => ({ p, entries: all.map((x) =>
    p.entries?.find((e) => e.algorithm === x.name)) }))
    .filter(({ entries }) => entries.filter(Boolean).length > 1);
  if (!shown.length) return null;
  const few = shown.slice(0, MOST_PICTURES);
  return [
    few.some(({ entries }) => entries.some((e) => e?.work)) && workScale(),
    few.map(({ p, entries }) => h("div", { class: "pair" },
      h("h3", {}, titleOf(p)),
      h("div", { class: `row-of of-${all.length}` }, entries.map((entry, k) =>
        h("div", {}, h("h4", {}, named(all[k].name)), entry
          ? [h("div", { class: "row" }, picturesOf(all[k], p, entry)),
            h("p", {}, verdict(report, entry))]
          : h("p", {}, "not drawn")))))),
    shown.length > few.length && h("p", {}, `The first ${MOST_PICTURES} of ${
      shown.length} scenes and views.`),
  ];
}

// --- Steps ---

function steps(report, all) {
  const { environments } = report;
  const rows = all.flatMap((x) => stepRows(report, x).map((r) => ({ ...r,
    algorithm: x.name })));
  const measured = environments.map((e, k) => [e, k])
    .filter(([, k]) => rows.some((r) => r.measured?.[k] > 0));
  if (!measured.length) return stepNames(all);
  const total = (name, what, k) => rows.filter((r) => r.algorithm === name &&
    !r.once).reduce((sum, r) => sum + (r[what]?.[k] ?? 0), 0);
  const sums = unique(rows.map((r) => r.algorithm)).map((name) => ({
    algorithm: name, step: "all of a frame",
    predicted: environments.map((_, k) => total(name, "predicted", k)),
    measured: environments.map((_, k) => total(name, "measured", k)) }));
  return table({ id: "steps", rows: [...rows, ...sums],
    caption: "Table III: comparisons", columns: [
      { name: "algorithm", label: "algorithm", value: (r) => r.algorithm,
        show: (r) => named(r.algorithm) },
      { name: "step", label: "step", whole: true, value: (r) => r.step,
        show: (r) => r.once ? `${r.step} (not each frame)` : r.step },
      ...measured.flatMap(([e, k]) => [
        number(`predicted-${k}`, "predicted", (r) => r.predicted?.[k], count),
        number(`measured-${k}`, "measured", (r) => r.measured?.[k], count),
      ].map((c) => ({ ...c, group: e.scene })))] });
}

function stepNames(all) {
  return all.some((x) => x.steps?.length) ? all.map((x) => [
    h("h3", {}, named(x.name)), h("ol", { class: "sorts" }, (x.steps ?? []).map((s) =>
      h("li", {}, h("b", {}, s.label), s.formula && [": ", formula(s.formula)])))])
    : null;
}

// --- Counters ---

// Of the places where all of them were counted: first the environments of 1974.
function counters(report, all) {
  const cells = all.map((x) => new Map(report.cellsOf(x.name)
    .filter((c) => c.counts).map((c) => [where(c), c])));
  const wanted = new Set(report.environments.map(where));
  const places = [...cells[0].keys()].filter((place) =>
    cells.every((own) => own.has(place)))
    .sort((a, b) => wanted.has(b) - wanted.has(a)).slice(0, MOST_PLACES);
  const names = unique(all.flatMap((x) => (x.counters ?? []).map((c) => c.name)));
  const counted = (k, place, name) => cells[k].get(place).counts[name];
  const rows = names.filter((name) => places.some((place) =>
    all.some((_, k) => counted(k, place, name) !== undefined)));
  return places.length ? table({ id: "counters", rows,
    caption: "Counters, on the same scenes and views", columns: [
      { name: "counter", label: "counter", value: (name) => name },
      ...places.flatMap((place, n) => all.map((x, k) => {
        const c = cells[k].get(place);
        return { ...number(`${n}-${x.name}`, x.name, (name) =>
          counted(k, place, name), count),
        group: `${c.scene}, view ${views(c)}, ${size(c)}` };
      })),
      { name: "meaning", label: "what is counted", prose: true, value: (name) =>
        all.flatMap((x) => x.counters ?? []).find((c) => c.name === name)?.meaning },
    ] }) : null;
}

// --- Times ---

function times(report, all) {
  const key = (c) => `${c.threads} ${where(c)}`;
  const [first, ...rest] = all.map((x) => new Map(report.cellsOf(x.name)
    .filter((c) => c.seconds).map((c) => [key(c), c])));
  const rows = [...first].map(([place, c]) => ({ ...c,
    all: [c, ...rest.map((own) => own.get(place))] }))
    .filter((r) => r.all.every(Boolean));
  if (!rows.length) return null;
  const apart = (p, q) => p.low > q.high || q.low > p.high;
  const time = (r, k) => r.all[k].seconds;
  const quotient = (r, k) => time(r, 0).value / time(r, k).value;
  return table({ id: "beside", rows,
    caption: `Seconds a frame of ${all.map((x) => x.name).join(" and ")}`,
    columns: [...placeColumns,
      ...all.map((x, k) => ({ name: `t${k}`, label: x.name, number: true,
        value: (r) => time(r, k).value, show: (r) => spread(time(r, k)) })),
      ...all.slice(1).map((x, k) => ({ name: `ratio${k}`, number: true,
        label: `${all[0].name} / ${x.name}`, value: (r) => quotient(r, k + 1),
        show: (r) => [digits(quotient(r, k + 1)), apart(time(r, 0), time(r, k + 1))
          ? null : " (intervals overlap)"] }))] });
}

function spread({ value, low, high }) {
  return interval(value, low, high, seconds);
}
