// SPDX-License-Identifier: GPL-3.0-or-later
// On paper nothing scrolls and nothing is asked for. So a table shows all its
// rows, if they are not thousands, and one that is wider than its page shrinks to
// it; a very wide one gets pages that lie on their side, for its section.

const UPRIGHT = 680, LYING = 1000; // CSS pixels across A4 between its margins
const STEPS = 3; // letters do not shrink quite as their table does

const widthOf = (table) => table.getBoundingClientRect().width;

function fit(table) {
  const lies = widthOf(table) > LYING;
  if (lies) (table.closest("section") ?? table).classList.add("lies");
  for (let k = 0, zoom = 1; k < STEPS; k++) {
    zoom *= Math.min(1, (lies ? LYING : UPRIGHT) / widthOf(table)) || 1;
    table.style.zoom = zoom;
  }
}

const all = (selector) => [...document.querySelectorAll(selector)]
  .filter((e) => !e.closest("details:not([open])"));

export function fitTablesOnPaper() {
  addEventListener("beforeprint", () => {
    all("button.all").forEach((button) => button.click());
    all(".scroll table").forEach(fit);
  });
  addEventListener("afterprint", () => all(".scroll table").forEach((table) => {
    table.style.zoom = "";
  }));
}
