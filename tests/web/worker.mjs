// SPDX-License-Identifier: GPL-3.0-or-later
// node worker.mjs MODULES CHROMIUM FOLDER: the Worker and its client, in a page that is
// one file and is opened from disk. Prints TAP.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { addressOf, begin } from "../browser.mjs";

const [modules, chromium, folder] = process.argv.slice(2);
const { buildSync } = createRequire(join(resolve(modules), "x"))("esbuild");

const bundle = (file, options) => buildSync({ entryPoints: [join(folder, file)],
  bundle: true, write: false, minify: true, external: ["node:*"], ...options })
  .outputFiles[0].text;
const quoted = (text) => JSON.stringify(text).replaceAll("</", "<\\/");

const dir = mkdtempSync(join(tmpdir(), "hsr-web-"));
const file = join(dir, "page.html");
writeFileSync(file, `<!doctype html><html lang="en"><title>core</title><script>
${bundle("client.js", { format: "iife", globalName: "hsr" })}
const bytes = Uint8Array.from(atob("${
  readFileSync(join(folder, "hsr.wasm")).toString("base64")}"), (c) => c.charCodeAt(0));
const worker = URL.createObjectURL(new Blob([${
  quoted(bundle("worker.js", { format: "iife", define: { "import.meta.url": "''" } }))}],
  { type: "text/javascript" }));
const asked = async () => ({ module: await WebAssembly.compile(bytes), worker });
</script></html>`);

const same = (got, wanted) => {
  const [a, b] = [got, wanted].map((x) => JSON.stringify(x));
  if (a !== b) throw new Error(`${a}, not ${b}`);
};

const { test, open, end } = await begin(modules, chromium);
const { page, faults } = await open();
await page.goto(addressOf(file));
const inPage = (does) => page.evaluate(does);

await test("a Worker in a page from disk draws, by bytes or by a module", async () => {
  const drawn = await inPage(async () => {
    const out = [];
    for (const parts of [asked(), { wasm: bytes, worker }]) {
      const client = globalThis.client = hsr.connect(parts);
      const scene = await client.open({ name: "house" });
      const answer = await client.draw(scene, { algorithm: "watkins", m: 64, n: 48 });
      out.push([await client.version !== "", answer.ids instanceof Uint32Array,
        answer.ids.length, answer.rgba.length]);
      globalThis.scene = scene;
      globalThis.hash = answer.hash;
    }
    return out;
  });
  same(drawn, [[true, true, 3072, 12288], [true, true, 3072, 12288]]);
});

await test("errors have a status and a line", async () => {
  same(await inPage(() => client.draw(scene, { algorithm: "none" }).catch((e) =>
    [e.name, e.status, typeof e.text])), ["HsrError", 2, "string"]);
});

await test("what takes long can be stopped, and scenes stay open", async () => {
  same(await inPage(async () => {
    const drawer = await client.prepare(scene, { algorithm: "watkins" });
    const long = client.draw(scene, { algorithm: "oracle", m: 4000, n: 4000 })
      .catch((e) => e.status);
    await new Promise((done) => { setTimeout(done, 300); });
    client.stop();
    const again = await client.draw(scene, { algorithm: "newell", m: 64, n: 48 });
    const redrawn = await client.redraw(drawer, { m: 64, n: 48 });
    return [await long, again.hash === hash, redrawn.hash === hash];
  }), [7, true, true]);
});

await test("a core that has ended is told of, and starts again", async () => {
  same(await inPage(async () => {
    const broken = hsr.connect({ module: await WebAssembly.compile(bytes),
      worker: URL.createObjectURL(new Blob(["throw new Error('no')"])) });
    const first = await broken.builtins().catch((e) => e.status);
    const big = await client.draw(scene, { algorithm: "watkins", m: 16384, n: 16384 })
      .then(() => "drawn", (e) => e.status);
    const after = await client.draw(scene, { algorithm: "watkins", m: 64, n: 48 });
    return [first, ["drawn", 4, 5].includes(big), after.hash === hash];
  }), [5, true, true]);
});

await test("nothing else goes wrong", async () => {
  same(faults.filter((f) => f !== "no"), []);
});
await end();
rmSync(dir, { recursive: true });
