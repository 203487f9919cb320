// SPDX-License-Identifier: GPL-3.0-or-later
// Where answers differ from one another, and what the judge says of them.
import { whole } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";

// The samples at which the ids differ.
export function differences(a, b) {
  const places = [];
  if (a.m !== b.m || a.n !== b.n) return places;
  for (let k = 0; k < a.ids.length; k++) if (a.ids[k] !== b.ids[k]) places.push(k);
  return places;
}

// The picture with which all others are compared: the first that ought to be right.
// Of [{ algorithm, answer }].
export function reference(all) {
  const pictures = all.filter(({ answer }) => answer?.ids);
  return pictures.find(({ algorithm }) => !algorithm.isKnownWrong) ?? pictures[0];
}

// The line above the pictures. shown(): [{ algorithm, text, answer }].
export function verdictLine(lab, core, source, shown) {
  const said = h("span", { role: "status" });
  const judged = h("span", { role: "status" });
  const ask = h("button", { type: "button", class: "quiet ask",
    onclick: () => askJudge().catch((error) => tell(error)) }, "Ask the exact judge");
  const element = h("p", { class: "verdict" }, said, " ", ask, " ", judged);
  const tell = (error) => { judged.textContent = error.text ?? error.message; };

  function show(all) {
    judged.textContent = "";
    const first = reference(all);
    const others = all.filter((x) => x.answer?.ids && x !== first);
    said.replaceChildren(...others.length ? others.flatMap((other) =>
      [...inWords(first, other), " "]) : [alone(all)]);
  }

  const alone = (all) => all.filter(({ answer }) => answer).length > 1
    ? "Answers of different kinds are not compared sample by sample." : "";

  function inWords(first, other) {
    const n = differences(first.answer, other.answer).length;
    const names = `${first.text} and ${other.text}`;
    if (!n) return [h("b", { class: "good" }, "✓ 0"), ` of ${
      whole(first.answer.ids.length)} samples differ: ${names} agree.`];
    return [h("b", { class: "bad" }, `✕ ${whole(n)}`), ` samples differ: ${names}. ${
      other.algorithm.isKnownWrong ? `${other.text} is known to be wrong. ` : ""}`,
    h("button", { type: "button", class: "quiet", onclick: () => lab.set({ overlay:
      lab.state.overlay === "differ" ? "" : "differ" }) },
    lab.state.overlay === "differ" ? "Hide them" : "Show them")];
  }

  // Each of the pictures is put to the oracle of its kind.
  async function askJudge() {
    judged.textContent = "The judge computes with exact numbers …";
    const { subject } = await source.current();
    const { camera, view } = lab.state;
    const texts = [];
    for (const { text, answer } of shown()) {
      if (!answer) continue;
      const request = { algorithm: text, m: answer.m, n: answer.n,
        ...(camera ? { camera } : { view }) };
      const v = await core.judge.ask(subject, (client, id) =>
        client.judgeAlgorithm(id, request));
      if (!v) return;
      texts.push(`${text}: ${v.differing ? `${whole(v.differing)} of ${
        whole(v.compared)} wrong, the first ${v.first}`
        : `all ${whole(v.compared)} right`}`);
      judged.textContent = `${texts.join("; ")}.`;
    }
  }
  return { element, show };
}
