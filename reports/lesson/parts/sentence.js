// SPDX-License-Identifier: GPL-3.0-or-later
// The step in words: where it is, what it tells of the idea, what it does.
import { firstLine } from "../data/branches.js";
import { kindLook } from "../data/kinds.js";
import { keepsRows } from "../data/lists.js";
import { eventWords } from "../data/words.js";
import { momentsOf } from "../telling/moments.js";
import { wrongSamples } from "../telling/wrong.js";
import { whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";

export function sentence(run) {
  const { trace } = run;
  const where = h("p", { class: "where" });
  const caption = h("p", { class: "caption" });
  const sign = h("span", { class: "sign", "aria-hidden": "true" });
  const said = h("span");
  const raised = h("small");
  const element = h("div", { class: "words", "aria-live": "polite" }, where, caption,
    h("p", {}, sign, said), h("p", {}, raised));

  const placeWords = (k) => {
    const moments = momentsOf(run);
    const at = moments.findIndex((m) => m.k === k);
    return [at >= 0 ? `Key moment ${at + 1} of ${moments.length}` : null,
      k > trace.kept ? `The end, after all ${whole(trace.events)} steps`
        : `Step ${whole(k)} of ${whole(trace.events)}`,
      progressWords(run, k)]
      .filter(Boolean).join(" · ");
  };

  const show = (k, e) => {
    where.textContent = placeWords(k);
    caption.textContent = momentsOf(run).find((m) => m.k === k)?.say ?? "";
    const kind = wrongAtEnd(run, k) ? "reject" : e?.kind;
    const look = kind ? kindLook(kind) : null;
    sign.textContent = look?.sign ?? "";
    sign.style.color = look ? `var(--hue-${look.hue})` : "";
    said.textContent = saidOf(run, k, e);
    raised.textContent = e ? `${e.kind} · ${e.counter.name}: ${e.counter.meaning}`
      : k === 0 ? firstLine(run) : "";
  };
  return { element, show };
}

// How much of the answer is there. Where rows are kept until all is done, how many
// pieces are in them.
function progressWords(run, k) {
  const done = run.painting.decided(k), { progress } = run.kind;
  if (done >= 0.01) return `${Math.floor(100 * done)} % ${progress}`;
  if (done) return `less than 1 % ${progress}`;
  const { painted, order } = keepsRows(run) ? run.list.at(k) : { painted: [], order: [] };
  const all = painted.length + order.length;
  return all ? `${whole(painted.length)} of ${whole(all)} pieces in the rows, not shown yet`
    : `nothing ${progress.split(" ").at(-1)} yet`;
}

const wrongAtEnd = (run, k) => k >= run.n ? wrongSamples(run).size : 0;

function saidOf(run, k, e) {
  const wrong = wrongAtEnd(run, k);
  if (wrong) return `${whole(wrong)} samples are wrong, marked by crosses: a farther ` +
    "face was painted over a nearer one.";
  if (e) return eventWords(run, e);
  return k === 0 ? "Before the first step."
    : `The page leaves out ${whole(run.leftOut)} steps here; this is the end.`;
}
