// SPDX-License-Identifier: GPL-3.0-or-later
// What figures of the lessons show, against the steps of their runs. Used by watch.mjs.
import assert from "node:assert/strict";

export async function figuresShow({ test, page, go }) {
  const at = async (name, look) => {
    await go(`#/?a=${name}`);
    await page.waitForSelector(".figures figure");
    return page.evaluate(look, name);
  };
  await test("painter: its figure has the order of painting and the wrong pairs",
    async () => {
      const seen = await at("painter", async () => {
        const run = await globalThis.lesson.run("painter");
        const svg = document.querySelector(".figures svg");
        const { trace, accepts } = run, order = [], before = new Map();
        const near = globalThis.lesson.closeness(run), wrong = new Map(), pairs = new Set();
        for (const k of accepts) {
          const [f, x, y] = [trace.a0[k], trace.x[k], trace.y[k]];
          if (!order.includes(f)) order.push(f);
          const there = before.get(`${x},${y}`) ?? [];
          const q = (g) => near(g)(x + 0.5, y + 0.5);
          there.forEach((g) => pairs.add(`${g},${f}`));
          wrong.delete(`${x},${y}`);
          const hidden = there.filter((g) => q(g) > q(f) * (1 + 1e-7));
          if (hidden.length) wrong.set(`${x},${y}`, `${hidden[0]},${f}`);
          before.set(`${x},${y}`, [...there, f]);
        }
        const words = [...svg.querySelectorAll("text")].map((e) => e.textContent);
        return { order, rows: words.filter((w) => /^face \d+$/.test(w)),
          pairs: pairs.size, wrong: new Set(wrong.values()).size, many: wrong.size,
          drawn: svg.querySelectorAll(".pair").length,
          dashed: svg.querySelectorAll(".pair.wrong").length,
          words: words.find((w) => w.startsWith("Wrong")),
          off: [...svg.querySelectorAll(".interval")].filter((bar, k) => Math.abs(
            Number(bar.getAttribute("x")) + Number(bar.getAttribute("width")) -
            svg.querySelectorAll("circle")[k].getAttribute("cx")) > 0.1).length };
      });
      assert.deepEqual(seen.rows, seen.order.map((f) => `face ${f}`));
      assert.ok(seen.pairs > 1 && seen.wrong > 0, "the scene has no wrong pair");
      assert.deepEqual([seen.drawn, seen.dashed, seen.off], [seen.pairs, seen.wrong, 0]);
      assert.match(seen.words, new RegExp(`at ${seen.many} samples$`));
    });
  await test("zbuffer: what its figure keeps only comes nearer", async () => {
    const { samples, first, most } = await at("zbuffer", async () => {
      const { trace, header } = await globalThis.lesson.run("zbuffer");
      const c = header.counters.findIndex(({ name }) => name === "writes");
      const of = new Map();
      for (let k = 0; k < trace.kept; k++)
        if (trace.counter[k] === c) {
          const key = `sample ${trace.x[k]}, ${trace.y[k]}`;
          of.set(key, (of.get(key) ?? 0) + 1);
        }
      const all = [...document.querySelectorAll(".figures .sample")];
      const words = (g) => [...g.querySelectorAll("text")].at(-1).textContent;
      return { samples: all.map((g) => [...g.querySelectorAll("circle")].map((e) =>
        [e.getAttribute("class"), Number(e.dataset.depth),
          Number(e.getAttribute("cy"))])),
      first: of.get(words(all[0])), most: Math.max(...of.values()) };
    });
    assert.equal(first, most);
    assert.equal(samples[0].filter(([is]) => is === "kept").length, most);
    assert.ok(samples.flat().some(([is]) => is === "refused"), "none is refused");
    for (const tests of samples) {
      let kept = Infinity, low = -Infinity;
      for (const [is, depth, y] of tests) {
        assert.equal(depth < kept, is === "kept", `${is} at ${depth}, ${kept} is kept`);
        if (is === "kept") assert.ok(y > low, "the line does not fall");
        if (is === "kept") [kept, low] = [depth, y];
      }
    }
  });
  await test("raycast: its figure has all hits of a ray, and the one that is shown",
    async () => {
      const seen = await at("raycast", async () => {
        const run = await globalThis.lesson.run("raycast");
        const svg = document.querySelector(".figures svg"), { trace } = run;
        const [, i, j, many, face] = /sample (\d+), (\d+): (\d+) hits.*face (\d+)/.exec(
          svg.getAttribute("aria-label")).map(Number);
        let hits = 0;
        for (let k = 0; k < trace.kept; k++)
          if (trace.x[k] === i && trace.y[k] === j && trace.width[k] === 1 &&
              run.event(k).outcome === "surrounds") hits += 1;
        return { hits, many, face, shown: run.painting.at(run.n)[j * run.width + i],
          circles: [...svg.querySelectorAll(".hit")].map((e) =>
            [e.matches(".nearest"), Number(e.getAttribute("cx"))]) };
      });
      assert.ok(seen.hits > 1, "a ray with one hit");
      assert.deepEqual([seen.many, seen.circles.length, seen.face],
        [seen.hits, seen.hits, seen.shown]);
      const left = Math.min(...seen.circles.map(([, x]) => x));
      for (const [isNearest, x] of seen.circles) assert.equal(isNearest, x === left);
      assert.ok(!seen.circles[0][0], "the first that is asked is the nearest");
    });
  await test("galimberti: the sets of its figure are as large as the steps say",
    async () => {
      const seen = await at("galimberti", async () => {
        const { trace } = await globalThis.lesson.run("galimberti");
        const svg = document.querySelector(".figures svg");
        const [, p, q] = /Edge (\d+)–(\d+)/.exec(svg.getAttribute("aria-label"))
          .map(Number);
        const number = (e, name) => Number(e.getAttribute(name));
        const bars = [...svg.querySelectorAll(".hiding")];
        return { drawn: [...svg.querySelectorAll(".many")].map((e) => [Number(
          e.textContent), bars.filter((b) => number(b, "x") < number(e, "x") &&
            number(b, "x") + number(b, "width") > number(e, "x")).map((b) =>
          b.dataset.face).join()]),
        said: trace.answer.filter(([ids]) => String(ids.slice(1, 3)) === `${p},${q}`)
          .sort((x, y) => x[2] - y[2]).map((part) => part[1]) };
      });
      const sizes = seen.drawn.map(([many, faces]) => {
        assert.equal(faces ? faces.split(",").length : 0, many);
        return many;
      });
      seen.drawn.forEach(([, faces], k) => k && assert.notEqual(faces,
        seen.drawn[k - 1][1], "the set does not change"));
      assert.deepEqual(sizes.filter((many, k) => !k || many !== sizes[k - 1]), seen.said);
      assert.ok(seen.said.length > 2);
    });
}
