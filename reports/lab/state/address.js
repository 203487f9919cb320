// SPDX-License-Identifier: GPL-3.0-or-later
// The address holds all that is shown, so that a link opens the same.
import { href, read } from "../../page/data/address.js";
import { LEVELS, TOGETHER } from "../../lesson/parts/controls.js";
import { ownOf } from "../scene/own.js";
import { cameraOf, cameraText } from "../views/camera.js";
import { sizeOf, sizeText } from "../parts/view_bar.js";
import { asked, fileOfPage } from "./asked.js";
import { MODES, MOST, standard } from "./lab.js";
import { bytesOf, inflate, pack, packed, unpacked } from "./pack.js";

const LARGEST = 6000; // characters of a file in a link

// The state that an address holds. What is wrong there has its standard, and is named
// in `unread`.
export async function readAddress() {
  const { params } = read();
  const own = { ...standard(), ...asked }, unread = [];
  const get = (name) => params.get(name) ?? "";
  const part = async (name, words, does, normal) => {
    const found = get(name) && await Promise.resolve(get(name)).then(does)
      .catch(() => null);
    if (found) return found;
    if (get(name)) unread.push(words);
    return normal;
  };
  if (get("s")) Object.assign(own, { scene: get("s"), own: fileOfPage(get("s")),
    camera: null });
  own.note = get("note").slice(0, 400);
  own.own = await part("f", "file", async (text) => ownOf(own.scene,
    await inflate(bytesOf(text))), own.own);
  own.edits = await part("e", "edits", async (text) =>
    editsOf(await unpacked(text)), []);
  if (get("a")) own.a = get("a").split(",").slice(0, MOST);
  own.camera = await part("c", "camera", cameraOf, own.camera);
  own.view = whole(get("v"));
  own.size = await part("size", "size", sizeOf, null);
  if (Object.hasOwn(MODES, get("mode"))) own.mode = get("mode");
  if (/^(work|differ)$/.test(get("overlay"))) own.overlay = get("overlay");
  own.blink = get("blink") === "1";
  own.holds = get("held") === "1";
  own.held = own.holds ? own.held : await part("held", "held counts", heldOf, own.held);
  if (sizeOf(get("steps"))) own.steps = get("steps");
  own.window = await part("w", "part of the picture", windowOf, null);
  readPlayer(own.play, get);
  readMeasure(own.measure, get);
  if (/^(seen|order)$/.test(get("task"))) own.decide.task = get("task");
  if (get("seed")) own.decide.seed = whole(get("seed"));
  return { state: own, unread };
}

// They are lists of names, targets, numbers and colours.
function editsOf(value) {
  const isGood = (x) => typeof x === "string" || Number.isFinite(x);
  return Array.isArray(value) && value.every((edit) => Array.isArray(edit) &&
    edit.every(isGood)) ? value : null;
}

// "warnock.12.3,newell.4.5": counts of algorithms.
function heldOf(text) {
  const all = text.split(",").map((one) => one.split("."));
  return all.every(([name, ...counts]) => name && counts.length &&
    counts.every((x) => /^\d{1,15}$/.test(x)))
    ? new Map(all.map(([name, ...counts]) => [name, counts.map(Number)])) : null;
}
const heldText = ({ held, holds }) => held.size
  ? [...held].map(([name, counts]) => [name, ...counts].join(".")).join(",")
  : holds ? 1 : null;

const whole = (text) => /^\d{1,9}$/.test(text) ? Number(text) : 0;
const windowOf = (text) => {
  const w = text.split(",").map(Number);
  return w.length === 4 && w.every((x) => Number.isInteger(x) && x >= 0) &&
    w[2] > w[0] && w[3] > w[1] ? w : null;
};

function readPlayer(play, get) {
  if (get("k")) play.k = get("k").split(",").map(Number).filter(Number.isFinite);
  play.lead = whole(get("lead"));
  if (Object.hasOwn(LEVELS, get("level"))) play.level = get("level");
  if (Object.hasOwn(TOGETHER, get("by"))) play.by = get("by");
  if (get("speed")) play.speed = Math.min(100, whole(get("speed")));
  play.to = get("to");
  play.face = get("face");
  play.quiz = get("quiz") === "1";
  play.outlines = get("outlines") !== "0";
  const [i, j] = get("at").split(",").map(Number);
  play.pixel = Number.isInteger(i) && Number.isInteger(j) ? { i, j } : null;
}

function readMeasure(measure, get) {
  if (/^(scene|size|depth)$/.test(get("mby"))) measure.by = get("mby");
  if (get("mwhat")) measure.what = get("mwhat");
  measure.values = get("mx").split(",").map(whole).filter((x) => x > 0);
}

// { hash, note }: the note says what a link cannot hold.
export async function addressOf(state) {
  const { play, measure, decide } = state, usual = standard();
  let note = "", file = null;
  if (state.own && state.own !== fileOfPage(state.scene)) {
    file = await pack(state.own.bytes);
    if (file.length > LARGEST) {
      file = null;
      note = `The link does not hold ${state.own.name}: it is too large for one.`;
    }
  }
  const unlike = (value, normal) => value === normal ? null : value;
  const steps = state.mode === "step" ? { k: play.k.join(",") || null,
    lead: play.lead || null, level: unlike(play.level, "step"),
    by: unlike(play.by, "share"), speed: unlike(play.speed, 30), to: play.to || null,
    face: play.face || null, quiz: play.quiz ? 1 : null,
    outlines: play.outlines ? null : 0,
    at: play.pixel ? `${play.pixel.i},${play.pixel.j}` : null,
    steps: unlike(state.steps, usual.steps), w: state.window?.join(",") } : {};
  const measured = state.mode === "measure" ? { mby: unlike(measure.by, "scene"),
    mwhat: unlike(measure.what, "compare"), mx: measure.values.join(",") || null }
    : {};
  const decided = state.mode === "decide" ? { task: decide.task, seed: decide.seed }
    : {};
  const all = { s: state.scene, f: file,
    e: state.edits.length ? await packed(state.edits) : null,
    note: state.note || null, a: state.a.join(","),
    c: state.camera ? cameraText(state.camera) : null,
    v: state.camera ? null : state.view || null, size: sizeText(state.size) || null,
    mode: unlike(state.mode, "look"), overlay: state.overlay || null,
    blink: state.blink ? 1 : null, held: heldText(state), ...steps, ...measured, ...decided };
  return { note, hash: href("", "", Object.fromEntries(Object.entries(all)
    .filter(([, value]) => value !== null && value !== undefined))) };
}
