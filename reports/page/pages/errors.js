// SPDX-License-Identifier: GPL-3.0-or-later
// How far the pictures of every filter are from the exact areas: what hsr errors
// found, a table and pictures for each scene.
import { digits, where } from "../data/format.js";
import { number } from "../parts/columns.js";
import { h, section } from "../parts/dom.js";
import { table } from "../parts/table.js";
import { errorScale } from "../parts/work_scale.js";

export function errorsPage(report) {
  return { title: "How far filters are from the truth", body: [
    h("p", { class: "lead" }, "The exact value of a pixel is the integral of " +
      "the picture over its area, computed in rational numbers. The error of a " +
      "pixel is the greatest difference of its three channels, which are " +
      "linear, from 0 to 1."),
    report.errors.length ? report.errors.map(oneScene)
      : h("p", {}, "Nothing is known of them here. ",
        h("code", {}, "hsr errors SCENE --json"), " finds the errors, and ",
        h("code", {}, "hsr report --errors FILE"), " shows them."),
  ] };
}

function oneScene(found, k) {
  const pictures = found.pictures.filter((p) => p.where);
  return section(where(found), `errors-${k}`,
    table({ id: `errors-${k}`, rows: found.pictures,
      caption: `Errors on ${where(found)}, against the exact integrals (${
        found.filter})`,
      columns: [
        { name: "picture", label: "picture", value: nameOf },
        number("mean", "mean", (p) => p.mean, digits),
        number("largest", "largest", (p) => p.largest, digits),
        { name: "over", label: "pixels over 1/256", number: true,
          value: (p) => p.over, show: (p) => p.over === null ? "–"
            : `${digits(100 * p.over)} %` },
        { name: "at", label: "largest at", number: true,
          value: (p) => p.x, show: (p) => `(${p.x}, ${p.y})`,
          csv: (p) => `(${p.x}, ${p.y})` }] }),
    pictures.length ? h("div", { class: "pair" }, errorScale(), h("div", {},
      pictures.map((p) => h("figure", {},
        h("img", { src: p.where, width: found.width, height: found.height,
          loading: "lazy", alt: `Where ${nameOf(p)} is wrong` }),
        h("figcaption", {}, nameOf(p)))))) : null);
}

function nameOf({ picture, samples }) {
  return samples > 1 ? `${picture}, ${samples} × ${samples} samples` : picture;
}
