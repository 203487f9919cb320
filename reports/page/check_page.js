// SPDX-License-Identifier: GPL-3.0-or-later
// Which algorithms agree with the oracle: a row for each view, a column for each
// algorithm.
import { h, link, section } from "./dom.js";
import { href } from "./address.js";
import { chosen, filterForm, placeColumns } from "./filters.js";
import { size, where, whole } from "./format.js";
import { key } from "./looks.js";
import { outcomeColumns } from "./algorithm_page.js";
import { pictureId, STATUSES, unique } from "./model.js";
import { table } from "./table.js";

const FILTERS = ["scene", "class", "status"];
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
      ([name, { symbol, meaning }]) => h("li", {}, mark(name, symbol),
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
    matrix(report, "Surfaces", modules.filter((c) => c.kind !== "segments")),
    matrix(report, "Line drawings", modules.filter((c) => c.kind === "segments")),
    matrix(report, "Peers", cells.filter((c) => c.peer)),
    failed.length ? section("Cells that did not pass", "failed",
      table({ id: "failed", caption: "Cells that are not ok, and why",
        rows: failed, columns: [
          { name: "algorithm", label: "algorithm", value: (c) => c.algorithm,
            show: (c) => link(href("algorithm", c.algorithm), key(c.algorithm),
              c.algorithm) },
          ...placeColumns, ...outcomeColumns(failed)] })) : null,
  ];
}

function matrix(report, title, cells) {
  if (!cells.length) return null;
  const listed = report.algorithms.map((a) => a.name);
  const names = unique([...listed, ...cells.map((c) => c.algorithm)])
    .filter((name) => cells.some((c) => c.algorithm === name));
  const places = unique(cells.map(where));
  const at = new Map();
  for (const c of cells) {
    const k = JSON.stringify([where(c), c.algorithm]);
    if (!at.has(k) || worse(c, at.get(k))) at.set(k, c);
  }
  const first = new Map(cells.map((c) => [where(c), c]));
  return section(title, null,
    h("div", { class: "table" }, h("div", { class: "scroll", tabindex: 0,
      role: "region", "aria-label": `${title}: agreement` },
    h("table", { class: "matrix" },
      h("caption", {}, `${title}: ${places.length} views by ${names.length} ${
        cells[0].peer ? "peers" : "algorithms"}`),
      h("thead", {}, h("tr", {}, h("td"), names.map((name) =>
        h("th", { scope: "col" }, heading(name, listed.includes(name)))))),
      h("tbody", {}, places.map((place) => {
        const record = first.get(place);
        return h("tr", {},
          h("th", { scope: "row" }, `${record.scene} ${record.view}`,
            h("small", {}, ` ${size(record)}`)),
          names.map((name) =>
            square(report, at.get(JSON.stringify([place, name])))));
      }))))));
}

// A peer has no page of its own.
function heading(name, listed) {
  const turned = h("span", { class: "turned" }, name);
  return listed ? link(href("algorithm", name), turned) : turned;
}

function worse(a, b) {
  return WORST.indexOf(a.status) < WORST.indexOf(b.status);
}

function square(report, cell) {
  if (!cell) return h("td", {});
  const { symbol } = STATUSES[cell.status] ?? { symbol: "?" };
  const text = cell.status === "wrong" ? whole(cell.mismatches) : cell.status;
  const what = `${cell.algorithm} on ${where(cell)}: ${cell.status}` +
    (cell.reason ? `, ${cell.reason}` : "");
  const picture = report.picture(cell);
  const content = [mark(cell.status, symbol), " ", h("small", {}, text)];
  return h("td", { class: `status ${cell.status}`, title: what },
    picture?.probe ? link(href("probe", pictureId(picture),
      { module: cell.algorithm }), content) : content);
}

function mark(status, symbol) {
  return h("span", { class: `mark ${status}`, "aria-hidden": "true" }, symbol);
}
