// SPDX-License-Identifier: GPL-3.0-or-later
// The story of a sample as a list; each entry leads to its step.
import { kindLook } from "../data/kinds.js";
import { eventWords } from "../data/words.js";
import { whole as number } from "../../page/data/format.js";
import { h } from "../../page/parts/dom.js";

const MANY = 200; // entries that are shown at first

export function storyList(run, go) {
  const title = h("h3", {});
  const end = h("p", {});
  const list = h("ol", { class: "story" });
  const more = h("button", { type: "button", hidden: true,
    onclick: () => fill(all ? story.events : story.own, Infinity) });
  const whole = h("input", { type: "checkbox", onchange: () => {
    all = whole.checked;
    fill(all ? story.events : story.own);
  } });
  const others = h("span", {}, "and all others");
  const wider = h("label", { class: "wider" }, whole, others);
  let all = false;
  const element = h("div", { class: "story-box", hidden: true }, title, end, wider,
    list, more);
  let story = null, now = -1, entries = new Map();

  const entry = (k) => {
    const e = run.event(k);
    const look = kindLook(e.kind);
    const button = h("button", { type: "button", "data-step": k + 1,
      onclick: () => go(k + 1) },
    h("span", { class: "sign", "aria-hidden": "true",
      style: `color: var(--hue-${look.hue})` }, look.sign),
    h("span", {}, eventWords(run, e)), h("small", {}, ` step ${number(k + 1)}`));
    entries.set(k, button);
    return h("li", {}, button);
  };
  const fill = (events, most = MANY) => {
    entries = new Map();
    // The last ones decide: of a long story, these are shown first.
    const shown = events.slice(-most);
    list.start = events.length - shown.length + 1;
    list.replaceChildren(...shown.map(entry));
    more.hidden = shown.length === events.length;
    more.textContent = `Show all ${number(events.length)} steps`;
    mark(now);
  };
  const mark = (k) => {
    entries.get(now)?.removeAttribute("aria-current");
    now = k;
    entries.get(now)?.setAttribute("aria-current", "step");
  };

  return {
    element,
    tell: (place) => {
      story = place ? run.story(place) : null;
      element.hidden = !story;
      if (!story) return null;
      const n = story.own.length, rest = story.events.length - n;
      wider.hidden = !rest;
      others.textContent = `and ${number(rest)} steps of its whole row, or of ` +
        "the picture";
      title.textContent = `The story of ${story.place}: ${
        n === 1 ? "one step" : `${number(n)} steps`}`;
      end.textContent = story.end;
      fill(all ? story.events : story.own);
      return story;
    },
    show: (k) => mark(k - 1),
  };
}
