// SPDX-License-Identifier: GPL-3.0-or-later
// The laboratory: hidden-surface algorithms at work on a scene that the reader
// chooses and edits.
import { whenLooksChange } from "../lesson/parts/redraw.js";
import { keys } from "../lesson/parts/controls.js";
import { h } from "../page/parts/dom.js";
import { openCore } from "./core/connect.js";
import { hand } from "./editing/hand.js";
import { measure } from "./experiments/measure.js";
import { decide } from "./judge/decide.js";
import { header } from "./parts/header.js";
import { editKeys, keyHelp, pictureKeys } from "./parts/keys.js";
import { savings } from "./parts/savings.js";
import { scenePanel } from "./parts/scene_panel.js";
import { viewBar } from "./parts/view_bar.js";
import { welcome } from "./parts/tries.js";
import { makeSource } from "./scene/source.js";
import { addressOf, readAddress } from "./state/address.js";
import { makeHistory } from "./state/history.js";
import { makeLab } from "./state/lab.js";
import { look } from "./views/look.js";
import { steps } from "./steps/steps.js";

const main = document.querySelector("main");
const lab = makeLab();
const { state } = lab;
const history = makeHistory(lab);

async function begin() {
  const opening = openCore();
  const asked = await readAddress();
  Object.assign(state, asked.state);
  const core = await opening;
  core.makeReady(state.a.length);
  document.getElementById("version").textContent = core.version;
  tellUnread(build(core), asked.unread);
  globalThis.lab = { ...globalThis.lab, core };
}

function build(core) {
  const source = makeSource(state, core.seats[0].must);
  const over = { attach: (canvas) => editing.attach(canvas),
    layers: () => editing.layers(), changed: () => editing.lookAgain() };
  const pictures = look(lab, core, source, over);
  const editing = hand(lab, source, history, {
    now: () => ({ camera: pictures.camera(), size: pictures.whole() }),
    moving: pictures.moving, repaint: pictures.overlay });
  const moves = movedByKeys(pictures);
  const looking = { element: h("div", { class: "looking" },
    viewBar(lab, source, pictures.camera), pictures.element, keyHelp()),
  open: pictures.open, close: pictures.close, show: () => {
    pictures.paint();
    moves();
  } };
  const modes = { look: looking, step: steps(lab, core, source),
    measure: measure(lab, core, source), decide: decide(lab, core, source) };
  const room = h("section", { class: "work", "aria-label": "The work" });
  const head = header(lab, { link: copyLink, save: savings(lab, source, pictures) });

  let open = null;
  const change = () => {
    open?.close();
    open = modes[state.mode];
    document.body.dataset.mode = state.mode;
    room.replaceChildren(open.element);
    open.open();
  };
  document.body.prepend(head.element);
  main.replaceChildren(
    h("h1", { class: "unseen" }, "The laboratory of hidden surfaces"),
    welcome(lab), h("div", { class: "desk" }, h("aside", { class: "side",
      "aria-label": "The scene" }, scenePanel(lab, core, source, editing, history)),
    room));
  lab.when("mode", change);
  pictureKeys(room, lab, pictures.camera, editing, moves);
  editKeys(lab, editing, history);
  keys(modes.step.act, () => state.mode === "step");
  whenLooksChange(() => open.show?.());
  keepAddress(head);
  change();
  globalThis.lab = { state, set: lab.set, source, pictures, modes, history, editing };
  return head;
}

// A picture that is moved by keys is drawn whole after a moment.
function movedByKeys(pictures) {
  let waiting = 0;
  return () => {
    pictures.moving(true);
    clearTimeout(waiting);
    waiting = setTimeout(() => pictures.moving(false), 200);
  };
}

// --- The address ---

let written = location.hash; // the address, as it was last written or read

function keepAddress(head) {
  let waiting = 0;
  const write = async () => {
    const { hash } = await addressOf(state);
    if (location.hash !== written) return; // the reader has gone elsewhere
    written = hash;
    document.title = `${state.scene}: ${state.a.join(", ")} · the laboratory of hsr`;
    globalThis.history.replaceState(null, "", hash);
  };
  lab.when(Object.keys(state).join(" "), () => {
    clearTimeout(waiting);
    waiting = setTimeout(write, 250);
  });
  addEventListener("hashchange", async () => {
    if (location.hash === written) return;
    written = location.hash;
    const { state: asked, unread } = await readAddress();
    Object.assign(state.play, asked.play);
    lab.set({ ...asked, play: state.play });
    history.forget();
    tellUnread(head, unread);
  });
}

const tellUnread = (head, unread) => unread.length && head.say(
  `Of this link, this cannot be read: ${unread.join(", ")}.`);

async function copyLink() {
  const { hash, note } = await addressOf({ ...state, size: state.size ??
    (state.mode === "look" ? globalThis.lab.pictures.whole() : null) });
  await navigator.clipboard.writeText(location.href.split("#")[0] + hash);
  return note || "The link is copied.";
}

begin().catch((error) => {
  main.replaceChildren(h("h1", {}, "The laboratory cannot open"), h("p",
    { role: "alert" }, error.text ?? error.message));
  throw error;
});
