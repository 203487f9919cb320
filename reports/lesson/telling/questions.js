// SPDX-License-Identifier: GPL-3.0-or-later
// The questions of a run: before some of its key moments, what will come of the step?
// Only where both subjects can be seen.
import { hasOutcome, keysOfOutcome } from "../data/run.js";
import { unseen, looksOf } from "../looks/all.js";
import { withOutcome } from "./figures.js";
import { boxOf, momentsOf } from "./moments.js";

const MOST = 8; // questions of a run
const LEAST = 0.05; // of the picture's width and height: what can be seen

// [{ k, text, answers: [[word, label]], right }]: the question about event k - 1,
// asked while the picture is as before it.
export function questionsOf(run) {
  if (!run.questions) {
    const all = momentsOf(run).map((m) => questionAt(run, m)).filter(Boolean);
    run.questions = spread(all, MOST);
  }
  return run.questions;
}

// At most n of them, over the whole run.
const spread = (all, n) => all.length <= n ? all : Array.from({ length: n }, (_, k) =>
  all[Math.round(k * (all.length - 1) / (n - 1))]);

function questionAt(run, { k, ask, words }) {
  if (k > run.trace.kept) return null;
  const e = run.event(k - 1);
  if (hasOutcome(e, "undecided")) return null; // nothing is found out yet
  const answers = words ? Object.keys(words) : answersTo(run, e);
  if (answers.length < 2 || !answers.includes(e.outcome) || !isSeen(run, e))
    return null;
  const text = ask ?? askedOf(e);
  return text && { k, text, right: e.outcome,
    answers: answers.map((word) => [word, words?.[word] ?? plain(word)]) };
}

// What the six tests ask.
const OF_TESTS = ["extents", "boxes", "plane-of-q", "plane-of-p"];

// Of a counter of several questions, the outcomes of the one that is asked ("test 2:
// apart", but not "test 3: apart").
function answersTo(run, e) {
  const { counter, outcome } = e;
  const has = (word, key) => keysOfOutcome(counter, word).includes(key);
  const all = (counter.outcomes ?? []).filter((w) => !has(w, "undecided"));
  const of = (word) => word.includes(":") ? word.split(":")[0] : null;
  // Of the six tests: these, and what else comes in this run.
  const own = counter.key === "list-test" ? all.filter((w) => !has(w, "end-of-q") &&
    (OF_TESTS.some((key) => has(w, key)) || has(w, "may-obscure") || has(w, "no-overlap") ||
      withOutcome(run, counter.key, w)))
    : all.filter((w) => of(w) === of(outcome));
  return own.filter((w) => has(w, "body") === hasOutcome(e, "body"));
}

const plain = (word) => word.replace(/^\w+: /, (text) =>
  text.startsWith("test") ? text : "");

// For algorithms without a lesson: only what the picture can answer.
function askedOf({ kind, counter: { outcomes }, a, b }) {
  const of = (word) => outcomes.includes(word);
  if (kind !== "compare" || !/face|piece|edge/.test(`${a.kind} ${b.kind}`)) return null;
  if (of("nearer") && a.kind === "edge" && b.kind === "edge") // the outcome is of b
    return "Where the two cross, is the dashed one nearer or farther?";
  if (of("nearer")) return "Is the solid one nearer or farther than the dashed one here?";
  if (of("hides")) return "Does the dashed one hide the solid one?";
  if (of("disjoint")) return "How does the face lie to the window?";
  return null;
}

function isSeen(run, e) {
  if (unseen(run, e).length) return false;
  const { a, b, where } = looksOf(run, e);
  return [[e.a, a], [e.b, b]].every(([s, shapes]) => {
    if (s.kind === "nothing") return true;
    if (/face|piece/.test(s.kind) && s.ids[0] < 0) return false;
    const box = boxOf(run, s.kind === "window" ? where : shapes);
    if (s.kind === "window" || s.kind === "vertex" || s.kind === "cell")
      return Boolean(box);
    return box && box.x1 - box.x0 + box.y1 - box.y0 >
      LEAST * (run.width + run.height);
  });
}
