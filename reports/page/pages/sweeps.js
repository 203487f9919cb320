// SPDX-License-Identifier: GPL-3.0-or-later
// How the seconds and the comparisons of a frame grow with the scene and the
// picture.
import { count, exponent, seconds } from "../data/format.js";
import { family, unique } from "../data/model.js";
import { algorithmColumn, placeColumns } from "../parts/columns.js";
import { h, section } from "../parts/dom.js";
import { chosen, filterForm } from "../parts/filters.js";
import {
  algorithmKeys, drawable, figure, sweepPlot,
} from "../parts/plots.js";
import { behind, table } from "../parts/table.js";

const FILTERS = ["scene", "size", "class"];
const MEASURES = {
  seconds: { title: "Seconds", label: "↑ seconds a frame", show: seconds },
  comparisons: { title: "Comparisons", label: "↑ comparisons a frame",
    show: count },
};
const OVER = {
  faces: { title: "over faces", label: "relevant faces →",
    grows: "Twice the faces take 2^exponent times as many." },
  samples: { title: "over samples", label: "samples in the picture →",
    grows: "With an exponent of 1 they are proportional to the samples." },
  depth: { title: "over depth complexity",
    label: "depth complexity D_c →",
    grows: "With an exponent near 0 hidden faces cost nothing." },
};

export function sweepsPage(report) {
  const results = h("div");
  const points = report.growth.filter((g) => report.draws(g.algorithm))
    .flatMap((g) => pointsOf(report, g));
  const update = () => {
    const shown = chosen(report, points, FILTERS);
    results.replaceChildren(...shown.length
      ? Object.keys(MEASURES).flatMap((measure) => Object.keys(OVER)
        .map((over) => sweep(report, measure, over, shown))).filter(Boolean)
      : [h("p", {}, "These filters leave nothing.")]);
  };
  update();
  return { title: "How they grow", body: [
    h("p", { class: "lead" }, "Each line is one algorithm on one scene that " +
      "grows. Both axes are logarithmic, so that a power is a straight line " +
      "and its exponent the slope. Bars are 95 % intervals. Comparisons are " +
      "counted, a step’s counts times the paper’s prices, and need no clock."),
    points.length ? filterForm(report, points, FILTERS, update)
      : h("p", {}, "No sweep was run: that is, no scene in three sizes or " +
        "more, and no picture in three sizes or more."),
    results,
  ] };
}

// A ladder is the same scene with another parameter, seen from the same view.
function pointsOf(report, { algorithm, measure, over, points }) {
  return (points ?? []).map((p) => {
    const timed = measure === "seconds" && report.cell(p, algorithm)?.seconds;
    const ladder = [over === "samples" ? p.scene : family(p.scene), p.view,
      over !== "samples" && `${p.width}x${p.height}`].join(" ");
    return { ...p, algorithm, measure, over, ladder,
      low: timed?.low ?? null, high: timed?.high ?? null };
  }).filter((p) => p.x > 0 && p.y > 0);
}

function sweep(report, measure, over, shown) {
  const points = shown.filter((p) => p.over === over && p.measure === measure);
  if (!points.length) return null;
  const y = MEASURES[measure];
  const { label, grows } = OVER[over];
  const title = `${y.title} ${OVER[over].title}`;
  const there = new Set(points.map((p) => p.algorithm));
  const names = report.algorithms.map((a) => a.name)
    .filter((name) => there.has(name));
  const fits = report.growth.filter((g) => g.over === over &&
    g.measure === measure && there.has(g.algorithm));
  const { marks, missing } = drawable(points);
  return section(title, `${measure}-${over}`,
    figure({
      caption: `${title}: ${few(unique(points.map((p) => family(p.scene))))}.${
        missing}`,
      draw: (width) => sweepPlot(marks, label, y, width),
      keys: algorithmKeys(names),
      numbers: behind(pointsTable(measure, over, title, points)) }),
    h("p", {}, grows, " Every ladder has its own exponent, whatever is chosen above."),
    exponents(`exponents-${measure}-${over}`, title, fits));
}

function few(names) {
  return names.length > 8 ? `${names.slice(0, 8).join(", ")} and ${
    names.length - 8} more` : names.join(", ");
}

function exponents(id, title, fits) {
  const column = (name, label) => ({ name, label, number: true,
    value: (g) => g[name] ?? null, show: (g) => exponent(g[name]) });
  return table({ id, rows: fits, caption: `Growth exponents: ${title}`,
    columns: [algorithmColumn,
      { name: "of", label: "of", value: (g) => g.of ?? "" },
      column("exponent", "exponent"), column("low", "at least"),
      column("high", "at most"),
      { name: "points", label: "points", number: true,
        value: (g) => g.points?.length ?? 0 }] });
}

function pointsTable(measure, over, title, points) {
  const { show } = MEASURES[measure];
  const column = (name, label) => ({ name, label, number: true,
    value: (p) => p[name], show: (p) => p[name] === null ? "–" : show(p[name]) });
  return table({ id: `points-${measure}-${over}`, rows: points, caption: title,
    columns: [algorithmColumn, ...placeColumns,
      { name: "x", label: OVER[over].label.replace(" →", ""), number: true,
        value: (p) => p.x, show: (p) => count(p.x) },
      column("y", measure),
      ...measure === "seconds" ? [column("low", "from"), column("high", "to")]
        .map((c) => ({ ...c, group: "95 % interval" })) : []] });
}
