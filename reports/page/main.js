// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a bench: one page that shows what its address asks for.
import { href, read } from "./data/address.js";
import { model } from "./data/model.js";
import { algorithmPage } from "./pages/algorithm.js";
import { checkPage } from "./pages/check.js";
import { errorsPage } from "./pages/errors.js";
import { indexPage } from "./pages/index.js";
import { probePage } from "./pages/probe.js";
import { sweepsPage } from "./pages/sweeps.js";
import { tablesPage } from "./pages/tables.js";
import { timingsPage } from "./pages/timings.js";
import { h, link } from "./parts/dom.js";
import { fitTablesOnPaper } from "./parts/print.js";

const PAGES = {
  "": { label: "Algorithms", show: indexPage },
  check: { label: "Agreement", show: checkPage },
  sweeps: { label: "Growth", show: sweepsPage },
  timings: { label: "Timings", show: timingsPage },
  errors: { label: "Filters", show: errorsPage,
    there: (report) => report.errors.length > 0 },
  tables: { label: "1974 tables", show: tablesPage },
  algorithm: { under: "", show: algorithmPage },
  probe: { under: "check", show: probePage },
};
const SCHEMA = "hsr-report/2";

const main = document.querySelector("main");

function start(data) {
  if (data?.schema !== SCHEMA) {
    main.replaceChildren(h("h1", {}, "Nothing to show"), h("p", {},
      data ? `data.js has another form, ${data.schema}; this page reads ${
        SCHEMA}.` : "data.js is missing beside this page, or is damaged."));
    return;
  }
  const report = model(data);
  const show = () => {
    const { page, argument } = read();
    const known = Object.hasOwn(PAGES, page) ? page : "";
    const { title, body } = PAGES[known].show(report, argument);
    navigation(report, known);
    const heading = h("h1", { tabindex: -1 }, title);
    main.replaceChildren(heading, ...body.flat(Infinity).filter(Boolean));
    document.title = title === report.title ? title
      : `${title} · ${report.title}`;
    return { heading, part: known === "tables" && argument };
  };
  // Another page begins at its top, or at the part asked for.
  const turn = () => {
    const { heading, part } = show();
    const at = part ? document.getElementById(part) : null;
    if (at) at.scrollIntoView();
    else scrollTo(0, 0);
    (at?.querySelector("h2") ?? heading).focus({ preventScroll: true });
  };
  addEventListener("hashchange", turn);
  const { part } = show();
  if (part) document.getElementById(part)?.scrollIntoView();
  document.querySelector("footer").append(h("p", {},
    "Made by ", h("code", {}, "hsr report"), ". The numbers: ",
    link("data.js", "data.js"), "; the records that they are made of: ",
    link("results.ndjson", "results.ndjson"), "."));
}

function navigation(report, page) {
  const here = PAGES[page].under ?? page;
  document.querySelector("header nav").replaceChildren(h("ul", {},
    Object.entries(PAGES).filter(([, { label, there }]) =>
      label && (!there || there(report)))
      .map(([name, { label }]) => h("li", {}, h("a", { href: href(name),
        "aria-current": name === here ? "page" : null }, label)))));
}

// The address says what is shown, so the link that skips the header cannot use
// it.
document.querySelector(".skip").addEventListener("click", (event) => {
  event.preventDefault();
  main.focus();
});

fitTablesOnPaper();
start(window.hsr);
