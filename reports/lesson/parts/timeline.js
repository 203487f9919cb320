// SPDX-License-Identifier: GPL-3.0-or-later
// Where in the run we are: a slider, and above it a lane for each kind of step,
// with a mark wherever there are such steps. Lines across
// all lanes are where rows or windows begin.
import { KINDS, colourOf, kindColour } from "../data/kinds.js";
import { h } from "../../page/parts/dom.js";

const LANE = 7;

// go(k): called when a place is chosen.
export function timeline(run, go) {
  const own = new Set(run.header.counters.filter((c) => !c.computed)
    .map((c) => c.kind));
  const kinds = Object.keys(KINDS).filter((kind) => own.has(kind));
  const kindOf = run.header.counters.map((c) => kinds.indexOf(c.kind));
  const canvas = h("canvas", { class: "lanes", role: "img", "aria-label":
    `Where there are steps of each kind: ${kinds.join(", ")}` });
  const slider = h("input", { type: "range", min: 0, max: run.n, value: 0,
    name: "step", "aria-label": `Step of ${run.name}`,
    oninput: (e) => go(Number(e.target.value)) });
  let shares = null, width = 0;

  // The share of each kind in each column, as a mark's strength.
  const measure = () => {
    shares = kinds.map(() => new Float32Array(width));
    const { counter, kept } = run.trace;
    for (let k = 0; k < kept; k++)
      shares[kindOf[counter[k]]][Math.min(width - 1,
        Math.floor(k / run.n * width))] += 1;
  };

  const draw = (k) => {
    const dots = globalThis.devicePixelRatio || 1;
    const wide = Math.round(canvas.clientWidth * dots);
    if (!wide) return;
    if (wide !== width) {
      width = wide;
      measure();
    }
    canvas.width = width;
    canvas.height = kinds.length * LANE * dots;
    canvas.style.height = `${kinds.length * LANE}px`;
    const context = canvas.getContext("2d");
    markUnits(context, dots);
    kinds.forEach((kind, lane) => {
      context.fillStyle = kindColour(kind);
      const most = shares[lane].reduce((a, b) => Math.max(a, b), 1);
      for (let x = 0; x < width; x++) {
        if (!shares[lane][x]) continue;
        context.globalAlpha = 0.35 + 0.65 * shares[lane][x] / most;
        context.fillRect(x, (lane * LANE + 1) * dots, 1, (LANE - 2) * dots);
      }
    });
    context.globalAlpha = 1;
    context.fillStyle = colourOf("--ink");
    context.fillRect(Math.min(width - 2 * dots, k / run.n * width), 0, 2 * dots,
      canvas.height);
    slider.value = k;
    slider.setAttribute("aria-valuetext", `step ${k} of ${run.n}`);
  };

  // Where rows and windows begin, if they are few enough to be told apart.
  const markUnits = (context, dots) => {
    if (3 * dots * run.units.length > width) return;
    context.fillStyle = colourOf("--line");
    for (const k of run.units)
      context.fillRect(Math.floor(k / run.n * width), 0, dots, canvas.height);
  };

  const choose = (e) => {
    if (e.buttons !== 1) return;
    const box = canvas.getBoundingClientRect();
    go(Math.round(Math.min(1, Math.max(0, (e.clientX - box.left) / box.width)) *
      run.n));
  };
  canvas.addEventListener("pointerdown", choose);
  canvas.addEventListener("pointermove", choose);
  return { element: h("div", { class: "timeline" }, canvas, slider), draw };
}
