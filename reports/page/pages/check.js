// SPDX-License-Identifier: GPL-3.0-or-later
// Which algorithms agree with the oracle: a row for each view, a column for each
// algorithm.
import { href } from "../data/address.js";
import { number, size, views, where, whole } from "../data/format.js";
import { STATUSES, symbolOf, unique } from "../data/model.js";
import {
  algorithmColumn, outcomeColumns, placeColumns,
} from "../parts/columns.js";
import { h, link, section } from "../parts/dom.js";
import { chosen, filterForm } from "../parts/filters.js";
import { table } from "../parts/table.js";

const FILTERS = ["scene", "size", "class", "status"];
const WORST = ["crash", "wrong", "memory", "timeout", "refused", "ok"];

export function checkPage(report) {
  const results = h("div");
  const update = () => results.replaceChildren(...show(report).filter(Boolean));
  update();
  return { title: "Do they agree?", body: [
    h("p", { class: "lead" }, "Every picture is compared with the oracle’s, " +
      "sample for sample, and every line drawing with the line oracle’s, edge " +
      "by edge. A cell links to its pixels if there is a picture."),
    h("ul", { class: "statuses" }, Object.entries(STATUSES).map(
      ([name, { meaning }]) => h("li", {}, mark(name),
        h("span", {}, h("b", {}, name), `: ${meaning}`)))),
    filterForm(report, report.cells, FILTERS, update),
    results,
  ] };
}

function show(report) {
  const cells = chosen(report, report.cells, FILTERS);
  if (!cells.length) return [h("p", {}, "These filters leave nothing.")];
  const modules = cells.filter((c) => !c.peer && report.draws(c.algorithm));
  const failed = cells.filter((c) => c.status !== "ok");
  return [
    ...unique(modules.map((c) => c.kind)).map((kind) => matrix(report,
      titleOf(report, kind), modules.filter((c) => c.kind === kind))),
    matrix(report, "Peers", cells.filter((c) => c.peer)),
    failed.length ? section("Cells that did not pass", "failed",
      table({ id: "failed", caption: "Cells that are not ok, and why",
        rows: failed, columns: [algorithmColumn, ...placeColumns,
          ...outcomeColumns(failed)] })) : null,
  ];
}

function titleOf(report, kind) {
  const meaning = report.kind(kind)?.meaning ?? kind ?? "Other answers";
  return meaning.charAt(0).toUpperCase() + meaning.slice(1);
}

function matrix(report, title, cells) {
  if (!cells.length) return null;
  const there = new Set(cells.map((c) => c.algorithm));
  const names = report.algorithms.map((a) => a.name)
    .filter((name) => there.has(name));
  const at = new Map();
  for (const c of cells) {
    const k = `${c.place} ${c.algorithm}`;
    if (!at.has(k) || worse(c, at.get(k))) at.set(k, c);
  }
  const rows = [...new Map(cells.map((c) => [c.place, c])).values()];
  const cell = (row, name) => at.get(`${row.place} ${name}`);
  return section(title, null, table({ rows, look: "matrix",
    caption: `${title}: ${number(rows.length, "views")} by ${
      number(names.length, cells[0].peer ? "peers" : "algorithms")}`,
    columns: [
      { name: "place", label: "scene and view", value: where, show: (r) => [
        `${r.scene} ${views(r)}`, h("small", {}, ` ${size(r)}`)] },
      ...names.map((name) => ({ name, turned: true,
        label: link(href("algorithm", name), name),
        value: (r) => cell(r, name)?.status ?? null,
        mark: (r) => `status ${cell(r, name)?.status ?? ""}`,
        title: (r) => told(cell(r, name)),
        show: (r) => square(report, cell(r, name)) }))] }));
}

function worse(a, b) {
  return WORST.indexOf(a.status) < WORST.indexOf(b.status);
}

function told(cell) {
  return cell && `${cell.algorithm} on ${where(cell)}: ${cell.status}` +
    (cell.reason ? `, ${cell.reason}` : "");
}

function square(report, cell) {
  if (!cell) return null;
  const text = cell.status === "wrong" ? whole(cell.mismatches) : cell.status;
  const picture = report.picture(cell);
  const content = [mark(cell.status), " ", h("small", {}, text)];
  return picture?.probe ? link(href("probe", picture.key,
    { module: cell.algorithm }), content) : content;
}

function mark(status) {
  return h("span", { class: `mark ${status}`, "aria-hidden": "true" },
    symbolOf(status));
}
