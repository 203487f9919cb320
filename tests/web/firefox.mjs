// SPDX-License-Identifier: GPL-3.0-or-later
// node firefox.mjs FIREFOX CORE [SIZE] <HASHES: as equal.mjs, in Firefox without a
// screen. A server of its own gives Firefox the page, and gets what the page found.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [firefox, core, size = "128"] = process.argv.slice(2);
const folders = [resolve(core), dirname(fileURLToPath(import.meta.url))];
const lines = readFileSync(0, "utf8").split("\n").filter(Boolean);
const types = { js: "text/javascript", mjs: "text/javascript",
  wasm: "application/wasm" };

const page = `<!doctype html><html lang="en"><title>core</title><script type="module">
const say = (path, text) => fetch(path, { method: "POST", body: text });
try {
  const { loadCore } = await import("./core.js");
  const { differing } = await import("./differing.mjs");
  const wasm = await (await fetch("hsr.wasm")).arrayBuffer();
  const { drawn, differ } = differing(await loadCore({ wasm }),
    ${JSON.stringify(lines)}, ${Number(size)}, (line) => say("line", line));
  await say("end", navigator.userAgent.replace(/.*Firefox/, "Firefox") + ": " +
    drawn + " drawn, " + differ + " differ");
} catch (error) {
  await say("end", "failed: " + error);
}
</script></html>`;

const bodyOf = async (request) => {
  let text = "";
  for await (const part of request) text += part;
  return text;
};

const ended = new Promise((end) => {
  const server = createServer(async (request, response) => {
    const name = request.url.slice(1);
    const file = folders.map((folder) => join(folder, name)).find(existsSync);
    if (request.method === "POST") {
      const text = await bodyOf(request);
      response.end();
      console.log(text);
      if (name === "end") end(text);
    } else if (name === "" || !file) {
      response.writeHead(name === "" ? 200 : 404, { "content-type": "text/html" });
      response.end(name === "" ? page : "");
    } else {
      response.writeHead(200, { "content-type": types[name.split(".").pop()] });
      response.end(readFileSync(file));
    }
  });
  server.listen(0, "127.0.0.1", () => {
    const profile = mkdtempSync(join(tmpdir(), "hsr-firefox-"));
    const program = spawn(firefox, ["--headless", "--no-remote", "--profile", profile,
      `http://127.0.0.1:${server.address().port}/`], { stdio: "ignore" });
    program.on("error", (error) => end(`failed: ${error}`));
    program.on("exit", () => {
      server.closeAllConnections();
      server.close();
      rmSync(profile, { recursive: true, force: true });
      end("failed: Firefox ended");
    });
    ended.then(() => program.kill());
  });
});
process.exitCode = / [1-9]\d* drawn, 0 differ$/.test(await ended) ? 0 : 1;
