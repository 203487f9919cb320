// SPDX-License-Identifier: GPL-3.0-or-later
// The tables and figures of Sutherland, Sproull and Schumacker 1974 beside our
// measurements; and Greene's.
import { href } from "../data/address.js";
import { count, digits, size, where, whole } from "../data/format.js";
import { RESTRICTIONS, unique } from "../data/model.js";
import {
  algorithmColumn, growthColumns, named, number,
} from "../parts/columns.js";
import { h, link, section } from "../parts/dom.js";
import { formula } from "../parts/symbols.js";
import { folded, table } from "../parts/table.js";
import { taxonomyTree } from "../parts/taxonomy.js";
import { tree } from "../parts/tree.js";

export function tablesPage(report) {
  const t = report.tables;
  const all = [
    ["table-1", "Table I: the statistics", table1(report, t)],
    ["table-2", "Table II: the rules of thumb", table2(report, t)],
    ["table-3", "Table III: the steps", table3(report, t)],
    ...(t.summary ?? []).map((s, k) => [`table-${k + 4}`,
      `Table ${["IV", "V", "VI"][k] ?? k + 4}: ${s.scene}`, summary(report, s)]),
    ["table-7", "Table VII: totals a frame", table7(report, t)],
    ["figure-13", "Figure 13: the taxonomy",
      report.algorithms.length && figure13(report)],
    ["figure-29a", "Figure 29a: what each demands", figure29a(t)],
    ["figure-29b", "Figure 29b: the sorts each makes", figure29b(t)],
    ["orders", "The sorting orders", orders(t)],
    ["conclusions", "What the paper concluded", conclusions(t)],
    ["greene", "Greene’s tables", greene(t)],
  ].filter(([, , content]) => content);
  return { title: "The tables of 1974", body: [
    h("p", { class: "lead" }, "What Sutherland, Sproull and Schumacker " +
      "predicted from rules of thumb, what the same formulas predict from the " +
      "statistics of our scenes, and what was counted. Costs are in " +
      "comparisons: each count of a step times the price of its kind of comparison."),
    all.length ? h("nav", { "aria-label": "Tables" }, h("ul", { class: "toc" },
      all.map(([id, title]) => h("li", {}, link(href("tables", id), title)))))
      : h("p", {}, "There are no tables."),
    ...all.map(([id, title, content]) => section(title, id, content)),
  ] };
}

// The survey's tree, and all algorithms of the testbed in its branches.
function figure13(report) {
  const of = (name) => report.algorithms.find((a) => a.name === name);
  const said = (name) => [of(name)?.title, of(name)?.sort_order &&
    `sorts ${of(name).sort_order}`].filter(Boolean).join(" · ");
  const lesson = (name) => report.lessonPages.find(({ names }) => names.includes(name));
  return [
    taxonomyTree(report.algorithms, { to: (name) => href("algorithm", name), said,
      watch: (name) => lesson(name) && `${lesson(name).file}${href("", "", { a: name })}`,
      end: "Choose one to see what it did." }),
    h("p", {}, "All algorithms of the testbed in the same tree; the ten are framed."),
    tree(report)];
}

function table1(report, t) {
  const symbols = t.table1 ?? [];
  if (!symbols.length) return null;
  const views = report.views.filter((v) => v.table1);
  return [
    table({ id: "meanings", caption: "The symbols", rows: symbols, columns: [
      { name: "symbol", label: "symbol", value: (s) => s.symbol,
        show: (s) => formula(s.symbol) },
      { name: "meaning", label: "meaning", prose: true, value: (s) => s.meaning },
      ...report.environments.map((e, k) => {
        const v = views.find((x) => where(x) === where(e));
        return v && number(`e${k}`, e.scene, (s) => v.table1[s.symbol], count);
      }).filter(Boolean)] }),
    views.length ? folded(`Table I of all ${views.length} views`,
      table({ id: "views", caption: "Table I, view by view", rows: views,
        columns: [
          { name: "scene", label: "scene", value: (v) => v.scene },
          { name: "view", label: "view", number: true, value: (v) => v.view },
          { name: "size", label: "size", number: true,
            value: (v) => v.width * v.height, show: size, csv: size },
          ...symbols.map((s) => ({ ...number(s.symbol, s.symbol,
            (v) => v.table1[s.symbol], count), label: formula(s.symbol) }))] })) : null,
  ];
}

function table2(report, t) {
  return t.table2?.length ? table({ id: "rules",
    caption: "The paper’s rules, and our measurements", rows: t.table2,
    columns: [
      { name: "symbol", label: "symbol", value: (r) => r.symbol,
        show: (r) => formula(r.symbol) },
      { name: "rule", label: "rule", value: (r) => r.rule ?? null,
        show: (r) => formula(r.rule ?? "") },
      ...report.environments.flatMap((e, k) => [
        number(`paper-${k}`, "paper", (r) => r.paper?.[k], count),
        number(`rule-${k}`, "by the rule", (r) => r.rule_of_measured?.[k], count),
        number(`measured-${k}`, "measured", (r) => r.measured?.[k], count),
        number(`ratio-${k}`, "ratio", (r) => r.ratio?.[k], digits),
      ].map((c) => ({ ...c, group: e.scene })))] }) : null;
}

function stepName({ step, once }) {
  return once ? `${step} (not each frame)` : step;
}

function table3(report, t) {
  return t.table3?.length ? table({ id: "steps", caption: "Steps and their " +
    "costs: the paper’s figure, the formula on our statistics, the count",
  rows: t.table3, columns: [
    algorithmColumn,
    { name: "step", label: "step", whole: true, value: (r) => r.step,
      show: stepName },
    { name: "formula", label: "formula", prose: true,
      value: (r) => r.formula ?? null, show: (r) => formula(r.formula ?? "–") },
    ...report.environments.flatMap((e, k) => [
      number(`paper-${k}`, "paper", (r) => r.paper?.[k], count),
      number(`predicted-${k}`, "predicted", (r) => r.predicted?.[k], count),
      number(`measured-${k}`, "measured", (r) => r.measured?.[k], count),
      number(`ratio-${k}`, "ratio", (r) => r.ratio?.[k], digits),
    ].map((c) => ({ ...c, group: e.scene }))),
    ...growthColumns] }) : null;
}

// Tables IV to VI, one for each environment. In the paper an algorithm is a
// column; here it is a row, since a page must be narrow.
function summary(report, { scene, columns }) {
  const rows = (columns ?? []).flatMap((c) => [
    ...c.steps.map((s) => ({ ...s, algorithm: c.algorithm })),
    { ...c, step: "total a frame", total: true }]);
  const title = report.environments.find((e) => e.scene === scene)?.title;
  return rows.length ? table({ rows,
    caption: `Steps and totals on ${scene}${title ? `, ${title}` : ""}`,
    columns: [algorithmColumn,
      { name: "step", label: "step", value: (r) => r.step,
        show: (r) => r.total ? h("b", {}, r.step) : stepName(r) },
      number("paper", "paper", (r) => r.paper, count),
      number("predicted", "predicted", (r) => r.predicted, count),
      { ...number("measured", "measured", (r) => r.measured, count),
        show: (r) => r.missing ?? count(r.measured) }] }) : null;
}

function table7(report, t) {
  return t.table7?.length ? table({ id: "totals",
    caption: "Comparisons a frame, all steps together", rows: t.table7,
    columns: [algorithmColumn, ...report.environments.flatMap((e, k) => [
      number(`paper-${k}`, "paper", (r) => r.paper?.[k], count),
      number(`predicted-${k}`, "predicted", (r) => r.predicted?.[k], count),
      number(`measured-${k}`, "measured", (r) => r.measured?.[k], count),
    ].map((c) => ({ ...c, group: e.scene }))),
    ...growthColumns] }) : null;
}

function figure29a(t) {
  const rows = t.figure29a ?? [];
  const codes = unique([...Object.keys(RESTRICTIONS),
    ...rows.flatMap((r) => r.restrictions)])
    .filter((code) => rows.some((r) => r.restrictions.includes(code)));
  return rows.length ? [
    table({ id: "demands", caption: "Demands on the scene", rows,
      columns: [algorithmColumn, ...codes.map((code) => ({
        name: code, label: code, title: () => RESTRICTIONS[code],
        value: (r) => r.restrictions.includes(code) ? 0 : null,
        show: (r) => r.restrictions.includes(code) ? `✓ ${code}` : "" }))] }),
    h("ul", { class: "plain" }, codes.map((code) => h("li", {},
      h("b", {}, code), ` ${RESTRICTIONS[code] ?? ""}`))),
  ] : null;
}

function figure29b(t) {
  return t.figure29b?.length ? table({ id: "sorts",
    caption: "Sorting order, coherence and sorts", rows: t.figure29b, columns: [
      algorithmColumn,
      { name: "order", label: "order", value: (r) => r.sort_order ?? null,
        show: (r) => r.sort_order ?? "–" },
      { name: "coherence", label: "coherence it bets on", prose: true,
        value: (r) => r.coherence ?? null, show: (r) => r.coherence ?? "–" },
      { name: "sorts", label: "sorts, in order",
        value: (r) => r.sorts?.length ?? 0,
        show: (r) => h("ol", { class: "sorts" }, (r.sorts ?? []).map((s) =>
          h("li", {}, h("b", {}, s.what), " by ", h("b", {}, s.key),
            `: ${s.method}, ${s.often}`))) }] }) : null;
}

function orders(t) {
  return t.sorting_orders?.length ? table({ id: "order",
    caption: "The algorithms of each sorting order", rows: t.sorting_orders,
    columns: [
      { name: "order", label: "order", value: (o) => o.order },
      { name: "algorithms", label: "algorithms",
        value: (o) => o.algorithms.join(" "),
        show: (o) => h("ul", { class: "legend" }, o.algorithms.map((name) =>
          h("li", {}, named(name)))) }] }) : null;
}

const VERDICTS = { "borne out": "✓", "not borne out": "✗", undecided: "?",
  "not measured": "–" };

function conclusions(t) {
  return t.conclusions?.length ? table({ id: "claims",
    caption: "Claims of the paper, judged by our measurements",
    rows: t.conclusions, columns: [
      { name: "claim", label: "claim", prose: true, value: (c) => c.claim },
      { name: "section", label: "where", value: (c) => c.section ?? "" },
      { name: "criterion", label: "borne out if", prose: true,
        value: (c) => c.criterion ?? "" },
      { name: "verdict", label: "verdict", whole: true, value: (c) => c.verdict,
        show: (c) => `${VERDICTS[c.verdict] ?? ""} ${c.verdict}` },
      { name: "evidence", label: "evidence", prose: true,
        value: (c) => c.evidence ?? "" },
    ] }) : null;
}

function greene(t) {
  const rows = (t.greene ?? []).filter((g) => typeof g.ours === "number");
  return rows.length ? table({ id: "figures",
    caption: "Greene’s figures beside ours", rows, columns: [
      { name: "table", label: "of", prose: true, value: (g) => g.table },
      { name: "what", label: "what", prose: true, value: (g) => g.what },
      { name: "source", label: "where", whole: true, value: (g) => g.source },
      number("paper", "his", (g) => g.paper, digits),
      number("ours", "ours", (g) => g.ours, digits),
      number("ratio", "ours / his", (g) => g.ratio, digits),
      { name: "reason", label: "why so far off", prose: true,
        value: (g) => g.reason ?? "" }] }) : null;
}
