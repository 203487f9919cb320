// SPDX-License-Identifier: GPL-3.0-or-later
// Which face is seen at a sample? The reader chooses, and the order of the depths
// says why.
import { digits, number } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";
import { board, hue } from "./board.js";
import { chance, M, N, shuffled } from "./over.js";

const QUESTIONS = 8;

export function seen({ over, polygons, camera, name, seed, again }) {
  const random = chance(seed);
  const worth = over.map((list, k) => [list.length, k]).filter(([n]) => n > 1);
  const places = shuffled(worth, random).slice(0, QUESTIONS).map(([, k]) => k);
  const drawing = board(polygons, camera, "Outlines of all faces, and a sample");
  const side = h("div", { class: "decide-side" });
  const element = h("div", { class: "decide-two" }, drawing.canvas, side);
  let at = 0, right = 0, now = {};

  // The reader asks about a sample of her own.
  drawing.canvas.addEventListener("pointerdown", (e) => {
    const box = drawing.canvas.getBoundingClientRect();
    const k = Math.floor((e.clientY - box.top) / box.height * N) * M +
      Math.floor((e.clientX - box.left) / box.width * M);
    if (!(over[k]?.length > 1)) return;
    places.splice(at, 1, k);
    ask();
  });

  const draw = (changes) => drawing.draw(now = { ...now, ...changes });

  function ask() {
    if (at >= places.length) return end();
    const k = places[at], list = over[k];
    const offered = shuffled(list.slice(0, 6), random);
    const colours = new Map(offered.map(({ face }, c) => [face, hue(c)]));
    now = {};
    side.replaceChildren(
      h("h2", {}, `Which face is seen in the circle? ${at + 1} of ${places.length}`),
      h("p", {}, `${number(list.length, "faces")} lie over this sample. `,
        "Point at an answer to see its face, or click another sample."),
      h("div", { class: "answers" }, offered.map(({ face }) => h("button",
        { type: "button", "data-face": face,
          style: `--own: var(${colours.get(face)})`,
          onclick: () => reply(face, list, colours),
          onpointerenter: () => draw({ filled: new Set([face]) }),
          onfocus: () => draw({ filled: new Set([face]) }) }, name(face)))));
    draw({ sample: { i: k % M, j: Math.floor(k / M) }, strong: colours,
      filled: new Set() });
  }

  function reply(face, list, colours) {
    const isRight = face === list[0].face;
    right += isRight ? 1 : 0;
    at += 1;
    const on = h("button", { type: "button", class: "main-act", onclick: ask },
      at < places.length ? "Next" : "See the result");
    side.querySelectorAll(".answers button").forEach((b) => {
      b.disabled = true;
      if (b.dataset.face === String(face)) b.append(isRight ? " ✓" : " ✕ your answer");
      else if (b.dataset.face === String(list[0].face)) b.append(" ✓ the nearest");
    });
    side.append(h("div", { role: "status" }, h("p", {}, h("b", { class: isRight
      ? "good" : "bad" }, isRight ? "✓ Yes. " : "✕ No. "), whyWords(list, name)),
    depths(list, name)), h("p", {}, `${right} of ${at} right. `, on));
    draw({ filled: new Set([list[0].face]), strong: colours });
    on.focus();
  }

  function end() {
    const many = places.length;
    side.replaceChildren(h("h2", {}, many ? `${right} of ${many} right`
      : "No sample has two faces over it"),
    h("p", {}, many ? "Turn the camera in Look for other questions, or:"
      : "Choose another scene, or turn the camera in Look."),
    many ? h("button", { type: "button", class: "main-act", onclick: again },
      "Other samples") : "");
    draw({ sample: null, strong: new Map(), filled: new Set() });
  }
  return { element, open: ask, show: () => draw({}),
    answer: () => over[places[at]]?.[0].face, places: () => places };
}

export const whyWords = ([first, second], name) => `${name(first.face)} is seen: ${
  second.depth === first.depth ? "it is as deep as" : "it is nearer than"} ${
  name(second.face)}.`;

export const depths = (list, name) => h("ol", { class: "depths" }, list.slice(0, 8)
  .map(({ face, depth }) => h("li", {}, `${name(face)}: depth ${digits(depth)}`)));
