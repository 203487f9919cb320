// SPDX-License-Identifier: GPL-3.0-or-later
// How the seconds a frame grow with the scene and the picture.
import { h, link, section } from "./dom.js";
import { href } from "./address.js";
import { chosen, filterForm, placeColumns } from "./filters.js";
import { count, exponent, seconds } from "./format.js";
import { key } from "./looks.js";
import { unique } from "./model.js";
import { figure, sweepPlot } from "./plots.js";
import { behind, table } from "./table.js";

const FILTERS = ["scene", "class"];
const OVER = {
  faces: { title: "Over faces", label: "faces →",
    grows: "Twice the faces take 2^exponent times as long." },
  samples: { title: "Over samples", label: "samples in the picture →",
    grows: "With an exponent of 1 the time is proportional to the samples." },
  depth: { title: "Over depth complexity",
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
      ? Object.keys(OVER).map((over) => sweep(report, over, shown)).filter(Boolean)
      : [h("p", {}, "These filters leave nothing.")]);
  };
  update();
  return { title: "How they grow", body: [
    h("p", { class: "lead" }, "Each line is one algorithm on one scene that " +
      "grows; both axes are logarithmic, so that a power is a straight line " +
      "and its exponent the slope. Bars are 95 % intervals."),
    points.length ? filterForm(report, points, FILTERS, update)
      : h("p", {}, "No sweep was run."),
    results,
  ] };
}

// A ladder is the same scene with another parameter, seen from the same view.
function pointsOf(report, { algorithm, over, points }) {
  return (points ?? []).map((p) => {
    const { low = null, high = null } = report.cell(p, algorithm)?.seconds ?? {};
    const ladder = [p.scene.split(":")[0], p.view, over !== "samples" &&
      `${p.width}x${p.height}`].join(" ");
    return { ...p, algorithm, over, ladder, low, high };
  }).filter((p) => p.x > 0 && p.seconds > 0);
}

function sweep(report, over, shown) {
  const points = shown.filter((p) => p.over === over);
  if (!points.length) return null;
  const { title, label, grows } = OVER[over];
  const names = report.algorithms.map((a) => a.name)
    .filter((name) => points.some((p) => p.algorithm === name));
  const fits = report.growth.filter((g) => g.over === over &&
    names.includes(g.algorithm));
  return section(title, over,
    figure({
      caption: `Seconds a frame ${title.toLowerCase()}, ${unique(points.map(
        (p) => p.scene.split(":")[0])).join(", ")}.`,
      draw: (width) => sweepPlot(points, label, width), algorithms: names,
      numbers: behind(pointsTable(over, points, label)) }),
    h("p", {}, grows, " Every ladder has its own exponent, whatever is chosen above."),
    exponents(over, fits));
}

const algorithmColumn = { name: "algorithm", label: "algorithm",
  value: (r) => r.algorithm,
  show: (r) => link(href("algorithm", r.algorithm), key(r.algorithm),
    r.algorithm) };

function exponents(over, fits) {
  return table({ id: `exponents-${over}`, rows: fits,
    caption: `Growth exponents over ${over}`, columns: [
      algorithmColumn,
      fits.some((g) => g.of) && { name: "of", label: "of",
        value: (g) => g.of ?? null, show: (g) => g.of ?? "" },
      { name: "exponent", label: "exponent", number: true,
        value: (g) => g.exponent ?? null, show: (g) => exponent(g.exponent) },
      { name: "low", label: "at least", number: true,
        value: (g) => g.low ?? null, show: (g) => exponent(g.low) },
      { name: "high", label: "at most", number: true,
        value: (g) => g.high ?? null, show: (g) => exponent(g.high) },
      { name: "points", label: "points", number: true,
        value: (g) => g.points?.length ?? 0 }].filter(Boolean) });
}

function pointsTable(over, points, label) {
  return table({ id: `points-${over}`, rows: points,
    caption: `Seconds a frame over ${over}`, columns: [
      algorithmColumn, ...placeColumns,
      { name: "x", label: label.replace(" →", ""), number: true,
        value: (p) => p.x, show: (p) => count(p.x) },
      { name: "seconds", label: "median", number: true,
        value: (p) => p.seconds, show: (p) => seconds(p.seconds) },
      { name: "interval", label: "95 % interval", number: true,
        value: (p) => p.low, show: (p) => p.low === null ? "–"
          : `${seconds(p.low)} – ${seconds(p.high)}` }] });
}
