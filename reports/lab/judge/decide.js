// SPDX-License-Identifier: GPL-3.0-or-later
// The reader decides what is seen, and exact numbers judge.
import { h } from "../../page/parts/dom.js";
import { orderOf } from "../scene/mesh.js";
import { facesOver } from "./over.js";
import { order } from "./order.js";
import { seen } from "./seen.js";

const TASKS = { seen: ["Which face is seen?", seen],
  order: ["Paint it in order", order] };

export function decide(lab, core, source) {
  const { state } = lab;
  const top = h("div", { class: "view-bar", role: "group", "aria-label": "The task" });
  const body = h("div", { class: "decide-body" });
  const element = h("div", { class: "decide" }, top, body);
  let isOpen = false, wanted = 0, task = null;

  async function begin() {
    if (!isOpen) return;
    const mine = ++wanted;
    showTop();
    body.replaceChildren(h("p", { class: "facts-of", role: "status" },
      "Exact numbers find which faces lie over each sample …"));
    try {
      const given = await subjectMatter();
      if (mine !== wanted || !given) return;
      task = TASKS[state.decide.task][1](given);
      body.replaceChildren(task.element);
      task.open();
    } catch (error) {
      if (mine === wanted) body.replaceChildren(h("p", { class: "refusal",
        role: "alert" }, error.text ?? error.message));
    }
  }

  // What both tasks are about.
  async function subjectMatter() {
    const now = await source.current();
    const { views } = await now.info;
    const mesh = await now.mesh(), ids = orderOf(mesh);
    const camera = state.camera ?? views[Math.min(state.view, views.length - 1)];
    const view = { camera };
    const over = await core.judge.ask(now.subject, (client, id) =>
      facesOver(client, id, view));
    const name = (id) => `face ${id}${mesh.solids[mesh.faces[ids[id]].solid]
      ? ` (${mesh.solids[mesh.faces[ids[id]].solid]})` : ""}`;
    return over && { over, camera, name, seed: state.decide.seed,
      polygons: ids.map((f, id) => [id, mesh.faces[f].ring.map((p) =>
        mesh.points[p])]),
      judge: (wrong) => core.judge.ask(now.subject, (client, id) =>
        client.judge(id, { algorithm: "zbuffer", ...view, ...wrong.size }, wrong.ids)),
      again: () => lab.set({ decide: { ...state.decide,
        seed: state.decide.seed + 1 } }) };
  }

  function showTop() {
    top.replaceChildren(...Object.entries(TASKS).map(([name, [text]]) => h("button",
      { type: "button", "aria-pressed": String(name === state.decide.task),
        onclick: () => lab.set({ decide: { ...state.decide, task: name } }) }, text)));
  }

  lab.when("scene own edits camera view decide", begin);
  return { element, open: () => { isOpen = true; begin(); },
    close: () => { isOpen = false; wanted += 1; },
    show: () => task?.show(), task: () => task };
}
