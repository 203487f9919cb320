// SPDX-License-Identifier: GPL-3.0-or-later
// The reader paints faces one over another, the farthest first, as the painter's
// algorithm does.
import { digits, number, whole } from "../../page/data/format.js";
import { h, link } from "../../page/parts/dom.js";
import { board, hue } from "./board.js";
import { depths, whyWords } from "./seen.js";
import { chance, circleIn, M, N, shuffled } from "./over.js";

const MANY = 16; // faces that can be put in order by hand
const NONE = 0xffffffff;

// From where to where each face is deep, at the samples it covers.
function rangesOf(over) {
  const ranges = new Map();
  for (const list of over)
    for (const { face, depth } of list) {
      const [least, most] = ranges.get(face) ?? [depth, depth];
      ranges.set(face, [Math.min(least, depth), Math.max(most, depth)]);
    }
  return ranges;
}

export function order({ over, polygons, camera, name, seed, judge, again }) {
  const faces = shuffled([...new Set(over.flatMap((list) => list.map((x) => x.face)))]
    .sort((a, b) => a - b), chance(seed));
  const ranges = rangesOf(over);
  const colours = new Map(faces.map((face, k) => [face, hue(k)]));
  const drawing = board(polygons, camera, "What is painted so far");
  const side = h("div", { class: "decide-side" });
  const element = h("div", { class: "decide-two" }, drawing.canvas, side);
  let painted = [], bad = null, under = null;

  // The face that the reader's order shows at each sample; null: none yet.
  const ids = () => {
    const place = new Map(painted.map((face, k) => [face, k]));
    return over.map((list) => list.map((x) => x.face).filter((f) => place.has(f))
      .sort((f, g) => place.get(g) - place.get(f))[0] ?? null);
  };

  function draw() {
    const style = getComputedStyle(document.documentElement);
    drawing.draw({ painted: ids().map((f) => f === null ? null
      : style.getPropertyValue(colours.get(f)).trim()), strong: colours,
    filled: new Set(under === null ? [] : [under]), bad });
  }

  function show() {
    const left = faces.filter((f) => !painted.includes(f));
    const said = h("div", { role: "status" });
    side.replaceChildren(h("h2", {}, "Paint from the farthest to the nearest"),
      h("p", {}, painted.length ? `Painted so far, by number: ${painted.join(", ")}.`
        : "Choose the face to be painted first. Each covers those before it."),
      h("div", { class: "answers" }, left.map((face) => h("button", { type: "button",
        style: `--own: var(${colours.get(face)})`, onclick: () => paint(face),
        onpointerenter: () => { under = face; draw(); },
        onfocus: () => { under = face; draw(); } }, name(face), h("small", {},
        ` depth ${ranges.get(face).map(digits).join(" to ")}`)))),
      h("div", { class: "row" },
        h("button", { type: "button", disabled: !painted.length, onclick: () => {
          painted = painted.slice(0, -1);
          bad = null;
          show();
        } }, "Take the last one back"),
        h("button", { type: "button", class: "main-act", disabled: left.length > 0,
          onclick: () => pronounce(said) }, "Judge it"),
        h("button", { type: "button", class: "quiet", onclick: () => {
          said.replaceChildren(circleWords());
        } }, "Is there an order?")), said);
    draw();
  }

  function paint(face) {
    painted = [...painted, face];
    under = bad = null;
    show();
    side.querySelector(".answers button, .main-act:enabled")?.focus();
  }

  async function pronounce(said) {
    const own = Uint32Array.from(ids(), (f) => f ?? NONE);
    const verdict = await judge({ ids: own, size: { m: M, n: N } });
    bad = over.flatMap((list, k) => (list[0]?.face ?? NONE) === own[k] ? [] : [k]);
    draw();
    if (!verdict.differing) return said.replaceChildren(h("p", {}, h("b",
      { class: "good" }, "✓ Right "), `at all ${whole(verdict.compared)} samples.`),
    h("button", { type: "button", onclick: again }, "Another start"));
    const k = bad[0];
    said.replaceChildren(h("p", {}, h("b", { class: "bad" }, `✕ ${number(
      verdict.differing, "samples")} are wrong`), ` of ${whole(verdict.compared)}. In ${
      `column ${k % M}, row ${Math.floor(k / M)}`} you show ${name(own[k])}, but ${
      whyWords(over[k], name)}`), depths(over[k], name), h("p", {}, circleWords()));
  }

  function circleWords() {
    const circle = circleIn(over);
    if (!circle) return "There is an order that is right.";
    const words = circle.map((f, k) => `${name(f)} lies over ${
      name(circle[(k + 1) % circle.length])}`);
    return `No order is right: ${words.join(", ")}. So Newell divides one of them.`;
  }

  if (!faces.length || faces.length > MANY)
    return { show: () => {}, open: () => {}, element: h("p", {}, `${number(faces.length,
      "faces")} lie in this picture. Up to ${MANY} can be put in order by hand: try `,
    link("#/?s=soup:6&a=painter&mode=decide&task=order", "six triangles"),
    ", which have an order, or ",
    link("#/?s=cyclic-overlap&a=painter&mode=decide&task=order", "cyclic-overlap"),
    ", which has none.") };
  return { element, open: show, show: draw, faces: () => faces, paint,
    right: () => over.map((list) => list[0]?.face ?? NONE) };
}
