// SPDX-License-Identifier: GPL-3.0-or-later
// What is chosen above the pictures.
import { h } from "../../page/parts/dom.js";
import { choice } from "./choice.js";
import { otherProjection } from "../views/camera.js";

const SIZES = { "": "as large as here", "64x48": "64 × 48", "128x96": "128 × 96",
  "256x192": "256 × 192", "320x240": "320 × 240", "512x384": "512 × 384",
  "640x480": "640 × 480", "1024x768": "1024 × 768" };
const OVERLAYS = { "": "the picture", differ: "the picture, and what differs",
  work: "the picture, and where the work went" };

export const sizeText = (size) => size ? size.join("x") : "";
export const sizeOf = (text) => /^\d+x\d+$/.test(text) ? text.split("x").map(Number)
  : null;

// camera(): the one that is looked through.
export function viewBar(lab, source, camera) {
  const { state } = lab;
  const views = h("select", { name: "view", "aria-label": "Where it is seen from",
    onchange: (e) => e.target.value && lab.set({ camera: null,
      view: Number(e.target.value) }) });
  const flat = h("input", { type: "checkbox", name: "parallel",
    onchange: () => camera() && lab.set({ camera: otherProjection(camera()) }) });
  const blink = h("input", { type: "checkbox", name: "blink",
    onchange: (e) => lab.set({ blink: e.target.checked }) });
  const fields = h("span", { class: "bar-fields" });

  async function showViews() {
    const { views: all } = await (await source.current()).info.catch(() =>
      ({ views: [] }));
    views.replaceChildren(
      ...(state.camera ? [h("option", { value: "" }, "as turned")] : []),
      ...all.map((_, k) => h("option", { value: k }, `view ${k + 1}`)));
    views.value = state.camera ? "" : String(state.view);
    flat.checked = (camera()?.parallel ?? 0) > 0;
  }

  function show() {
    fields.replaceChildren(
      choice("overlay", OVERLAYS, state.overlay, (overlay) => lab.set({ overlay }),
        "show "),
      choice("size", { ...SIZES, [sizeText(state.size)]: SIZES[sizeText(state.size)] ??
        sizeText(state.size).replace("x", " × ") }, sizeText(state.size),
      (text) => lab.set({ size: sizeOf(text) }), "size "));
    blink.checked = state.blink;
    blink.disabled = state.a.length < 2;
  }

  lab.when("overlay size blink a", show);
  lab.when("scene own camera view", showViews);
  show();
  showViews();
  return h("form", { class: "view-bar", "aria-label": "The pictures",
    onsubmit: (e) => e.preventDefault() },
  h("label", {}, "from ", views), h("label", {}, flat, "parallel"), fields,
  h("label", {}, blink, "blink"));
}
