// SPDX-License-Identifier: GPL-3.0-or-later
// A browser without a screen, for tests of pages. They open pages from disk as a
// reader would, and print TAP.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

// modules: the folder of node_modules; executablePath: chromium.
export async function begin(modules, executablePath) {
  const load = createRequire(join(resolve(modules), "x"));
  const { chromium } = load("playwright-core");
  const axe = readFileSync(load.resolve("axe-core"), "utf8");
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  let tests = 0, failures = 0;

  async function test(what, body) {
    tests += 1;
    try {
      await body();
      console.log(`ok ${tests} - ${what}`);
    } catch (error) {
      failures += 1;
      console.log(`not ok ${tests} - ${what}`);
      console.log(String(error.message).replace(/^/gm, "# "));
    }
  }

  // Opens a window. Errors of its pages are collected in .faults.
  async function open(options = {}) {
    const context = await browser.newContext({
      viewport: { width: 1280, height: 900 }, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(60000); // a busy machine is slow, not wrong
    const faults = [];
    page.on("console", (m) => m.type() === "error" && faults.push(m.text()));
    page.on("pageerror", (error) => faults.push(error.message));
    page.on("requestfailed", (r) => faults.push(`not there: ${r.url()}`));
    page.on("request", (r) => /^(file|data|blob):/.test(r.url()) ||
      faults.push(`a request left: ${r.url()}`));
    return { page, faults, close: () => context.close() };
  }

  // What axe finds serious or critical on the page as it is.
  async function serious(page) {
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => globalThis.axe.run(document,
      { preload: false }));
    return violations.filter((v) => /serious|critical/.test(v.impact))
      .map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => n.target.join(" "))
        .join("; ")}`);
  }

  async function end() {
    await browser.close();
    console.log(`1..${tests}`);
    process.exitCode = failures ? 1 : 0;
  }
  return { test, open, serious, end };
}

export const addressOf = (file) => pathToFileURL(resolve(file)).href;

// Runs in the page; returns what is wrong with it.
export function blemishes() {
  const bad = [];
  const root = document.documentElement;
  if (root.scrollWidth > innerWidth)
    bad.push(`the page is ${root.scrollWidth} wide in ${innerWidth}`);
  if (!root.lang) bad.push("no language");
  if (document.querySelectorAll("h1").length !== 1) bad.push("not one h1");
  const label = (e) => e.getAttribute("aria-label")?.trim();
  for (const e of document.querySelectorAll("input, select"))
    if (!e.labels[0]?.textContent.trim() && !label(e))
      bad.push(`no label: ${e.name}`);
  for (const e of document.querySelectorAll("img"))
    if (!e.alt) bad.push(`no alt: ${e.src}`);
  for (const e of document.querySelectorAll("button, a"))
    if (!e.textContent.trim() && !label(e) && !e.hidden &&
        !e.querySelector("img[alt]")) bad.push(`no name: ${e.outerHTML}`);
  const ids = [...document.querySelectorAll("[id]")].map((e) => e.id);
  for (const id of ids)
    if (ids.indexOf(id) !== ids.lastIndexOf(id)) bad.push(`id twice: ${id}`);
  for (const e of document.querySelectorAll(".plot")) {
    if (!e.querySelector("svg[role=img][aria-label]")) bad.push("empty plot");
    const figure = e.closest("figure");
    if (!figure.querySelector("table") &&
        !figure.nextElementSibling?.querySelector("table"))
      bad.push("a plot without its table");
  }
  const text = document.querySelector("main").innerText;
  for (const word of ["undefined", "NaN", "[object"])
    if (text.includes(word)) bad.push(`“${word}” in the text`);
  return bad;
}
