// SPDX-License-Identifier: GPL-3.0-or-later
// A picture under the magnifying glass: for every pixel the face and the depth
// that each module gives it. Pointer, taps, arrow keys and numbers choose it.
import { href, read, set } from "../data/address.js";
import { whole } from "../data/format.js";
import { key, looks } from "../data/looks.js";
import { symbolOf, titleOf } from "../data/model.js";
import { loadProbe } from "../data/probe_data.js";
import { h, link } from "../parts/dom.js";
import { table } from "../parts/table.js";
import { workScale } from "../parts/work_scale.js";

const ZOOMS = ["1", "2", "4", "8", "16"];

export function probePage(report, id) {
  const picture = report.pictures.find((p) => p.key === id);
  if (!picture?.probe)
    return { title: "No such picture", body: [h("p", {}, `There is no probe “${
      id}”; see `, link(href("check"), "all pictures"), ".")] };
  const place = h("div", {}, h("p", {}, "Reading the pixels …"));
  loadProbe(id, picture.probe).then(
    (pixels) => place.replaceChildren(...probe(picture, pixels)),
    (error) => place.replaceChildren(h("p", { role: "alert" }, error.message)));
  return { title: `${titleOf(picture)}, pixel by pixel`,
    body: [others(report, id), place] };
}

function form(...fields) {
  return h("form", { class: "filters", onsubmit: (e) => e.preventDefault() },
    fields);
}

function others(report, id) {
  return form(h("label", {}, "Picture",
    h("select", { name: "picture", onchange: (e) => {
      location.hash = href("probe", e.target.value,
        { module: read().params.get("module") ?? "" });
    } }, report.pictures.filter((p) => p.probe).map((p) => h("option",
      { value: p.key, selected: p.key === id },
      titleOf(p))))));
}

// The layers that can be shown of the module: those that have files.
function layersOf(picture, entry) {
  return [["picture", picture.picture], ["differences", entry?.difference],
    ["work", entry?.work], ["drawing", entry?.drawing]]
    .filter(([, source]) => source);
}

function probe(picture, pixels) {
  const { width, height } = pixels;
  const entries = picture.entries ?? [];
  const { params } = read();
  const bounded = (text, n, standard) => {
    const x = text === null || text === "" ? standard : Number(text);
    return Number.isFinite(x) ? Math.min(Math.max(Math.round(x), 0), n - 1) : 0;
  };
  // The state of the page; what is pinned is in the address.
  const state = {
    i: bounded(params.get("i"), width, width >> 1),
    j: bounded(params.get("j"), height, height >> 1),
    module: params.get("module") ?? "",
    layer: params.get("layer") ?? "",
    zoom: ZOOMS.includes(params.get("zoom")) ? params.get("zoom") : "",
  };

  const image = h("img", { alt: titleOf(picture),
    width, height });
  const marks = h("canvas", { width, height, "aria-hidden": "true" });
  const cursor = h("div", { class: "cursor" });
  const stage = h("div", { class: "stage", tabindex: 0, role: "application",
    "aria-label": "The picture; arrow keys choose a pixel, with Shift ten " +
      "pixels on" }, image, marks, cursor);
  const box = h("div", { class: "stage-box" }, stage);
  const status = h("p", { role: "status" });
  const readout = h("div", { id: "readout" });
  const legend = h("div");
  const layers = h("fieldset", { class: "layers" });
  const next = h("p", { class: "next" });

  const entry = () => entries.find((e) => e.algorithm === state.module) ?? null;
  const number = (name, n) => h("input", { type: "number", name, min: 0,
    max: n - 1, onchange: (e) => pin({ [name]: bounded(e.target.value, n, 0) }) });
  const iBox = number("i", width), jBox = number("j", height);

  const point = (i, j) => {
    cursor.style.left = `${100 * i / width}%`;
    cursor.style.top = `${100 * j / height}%`;
    status.textContent = inAWord(entries, pixels, i, j);
    readout.replaceChildren(readoutOf(entries, pixels, i, j, state.module));
  };
  const pin = ({ i = state.i, j = state.j }) => {
    Object.assign(state, { i, j });
    iBox.value = i;
    jBox.value = j;
    point(i, j);
    later(() => set({ i: state.i, j: state.j }));
  };
  const pixelAt = (event) => {
    const area = stage.getBoundingClientRect();
    return {
      i: bounded((event.clientX - area.left) / area.width * width - 0.5, width),
      j: bounded((event.clientY - area.top) / area.height * height - 0.5,
        height) };
  };
  const walk = (event) => {
    const step = event.shiftKey ? 10 : 1;
    const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0],
      ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
    if (!move) return;
    event.preventDefault();
    pin({ i: bounded(state.i + move[0], width),
      j: bounded(state.j + move[1], height) });
    cursor.scrollIntoView({ block: "nearest", inline: "nearest" });
  };
  stage.addEventListener("pointermove", (e) => {
    if (e.pointerType !== "mouse") return;
    const { i, j } = pixelAt(e);
    point(i, j);
  });
  stage.addEventListener("pointerleave", () => point(state.i, state.j));
  stage.addEventListener("click", (e) => pin(pixelAt(e)));
  stage.addEventListener("keydown", walk);

  const showModule = () => {
    const there = layersOf(picture, entry());
    if (!there.some(([name]) => name === state.layer))
      state.layer = entry()?.drawing ? "drawing" : "picture";
    layers.replaceChildren(h("legend", {}, "Show"), ...there.map(([name]) =>
      h("label", {}, h("input", { type: "radio", name: "layer", value: name,
        checked: name === state.layer, onchange: () => {
          state.layer = name;
          set({ layer: name });
          showModule();
        } }), name)));
    const [name, source] = there.find(([n]) => n === state.layer) ?? there[0];
    image.src = source;
    legend.replaceChildren(...name === "work" ? [workScale()] : []);
    image.alt = `${name} of ${titleOf(picture)}` +
      (name === "picture" ? "" : ` by ${state.module}`);
    const list = state.module ? pixels.differing(state.module)
      : pixels.anyDiffering();
    drawMarks(marks, pixels, list);
    next.replaceChildren(...nextOf(state, pixels, list, (k) => {
      pin({ i: k % width, j: Math.floor(k / width) });
      cursor.scrollIntoView({ block: "nearest", inline: "nearest" });
    }));
    point(state.i, state.j);
  };
  // Enlarged by a whole number, so that all pixels are equally large.
  const zoom = () => {
    const room = box.clientWidth;
    const fit = Math.max(1, Math.floor(room / width));
    stage.style.width = `${width * (Number(state.zoom) || fit)}px`;
    cursor.style.width = `${100 / width}%`;
    cursor.style.height = `${100 / height}%`;
  };
  new ResizeObserver(zoom).observe(box);

  const moduleSelect = h("select", { name: "module", onchange: (e) => {
    state.module = e.target.value;
    set({ module: state.module });
    showModule();
  } }, h("option", { value: "" }, "all of them"), entries.map((e) =>
    h("option", { value: e.algorithm, selected: e.algorithm === state.module },
      `${symbolOf(e.status)} ${e.algorithm}`)));
  const zoomSelect = h("select", { name: "zoom", onchange: (e) => {
    state.zoom = e.target.value;
    set({ zoom: state.zoom });
    zoom();
    cursor.scrollIntoView({ block: "nearest", inline: "nearest" });
  } }, h("option", { value: "" }, "to fit"), ZOOMS.map((z) =>
    h("option", { value: z, selected: z === state.zoom }, `${z} times`)));

  showModule();
  pin({});
  return [
    form(h("label", {}, "Module", moduleSelect), layers),
    h("div", { class: "probe" },
      h("div", {}, box, legend, status, next,
        form(h("label", {}, "i, from the left", iBox),
          h("label", {}, "j, from the top", jBox),
          h("label", {}, "Enlarge", zoomSelect))),
      h("details", { open: true },
        h("summary", {}, "What each module sees there"), readout)),
  ];
}

// The address is written when the pointer rests: browsers limit the number of
// changes a second.
let waiting = 0;
function later(write) {
  clearTimeout(waiting);
  waiting = setTimeout(write, 150);
}

function drawMarks(canvas, { width, height }, list) {
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, width, height);
  context.fillStyle = "#ff00d4";
  for (const k of list)
    context.fillRect(k % width, Math.floor(k / width), 1, 1);
}

function nextOf(state, { width, drew }, list, go) {
  const who = state.module || "some module";
  if (state.module && !drew(state.module))
    return [`${who} is not compared pixel by pixel here.`];
  if (!list.length) return [state.module ? `No pixel of ${who} differs.`
    : "No pixel of any module differs."];
  const from = () => state.j * width + state.i;
  const button = (label, find) => h("button", { type: "button",
    onclick: () => go(find()) }, label);
  return [`${whole(list.length)} pixels of ${who} differ (marked). `,
    button("Previous", () => list.findLast((k) => k < from()) ?? list.at(-1)),
    " ",
    button("Next", () => list.find((k) => k > from()) ?? list[0])];
}

function faceOf(pixels, face) {
  if (face < 0) return "background";
  const object = pixels.object(face);
  return object ? `${object.name}, face ${object.number}` : "";
}

function inAWord(entries, pixels, i, j) {
  const k = j * pixels.width + i;
  const { face, depth } = pixels.oracle(k);
  const other = entries.filter((e) => pixels.seen(e.algorithm, k))
    .map((e) => e.algorithm);
  return `i = ${i}, j = ${j}: ${faceOf(pixels, face)}` +
    (face < 0 ? "" : `, depth ${depthOf(depth)}`) +
    (other.length ? `; otherwise by ${other.join(", ")}` : "");
}

// The oracle, then the modules that see something else, then the others.
function readoutOf(entries, pixels, i, j, module) {
  const k = j * pixels.width + i;
  const truth = pixels.oracle(k);
  const drawn = entries.filter((e) => pixels.drew(e.algorithm) &&
    e.algorithm !== "oracle").map(({ algorithm: name }) => {
    const own = pixels.seen(name, k);
    return { name, differs: own !== null, ...own ?? truth };
  });
  const rows = [{ name: "oracle", differs: false, ...truth },
    ...drawn.filter((r) => r.differs), ...drawn.filter((r) => !r.differs)];
  const differs = (r) => r.differs ? "differs" : null;
  return table({ caption: `Pixel i = ${i}, j = ${j}`, rows, columns: [
    { name: "module", label: "module", value: (r) => r.name,
      mark: (r) => r.name === module ? "chosen" : null,
      show: (r) => [key(looks(r.name)), r.name] },
    { name: "verdict", label: "agrees", whole: true, mark: differs,
      value: (r) => r.differs ? "✗ differs" : "✓" },
    { name: "face", label: "face", number: true, mark: differs,
      value: (r) => r.face < 0 ? "none" : String(r.face) },
    { name: "depth", label: "depth", number: true, mark: differs,
      value: (r) => depthOf(r.depth) },
    { name: "object", label: "object", mark: differs,
      value: (r) => faceOf(pixels, r.face) }] });
}

// The file holds only seven digits.
function depthOf(t) {
  return t === null || !Number.isFinite(t) ? "–" : t.toPrecision(7);
}
