// SPDX-License-Identifier: GPL-3.0-or-later
// Draws with a core what tests/web/hashes drew natively. Under node, and in a browser.
// lines: of `hashes`, tab-separated; size: both sides of the picture, in samples.
// report: called with each line that differs. Returns how many were drawn and differ.
export function differing(core, lines, size, report) {
  // Oracles count what is compared as they sort, and each library sorts in its own way.
  const oracles = new Set(core.algorithms().filter((a) => a.isOracle)
    .map((a) => a.name));
  let scene = null, drawn = 0, differ = 0;
  const said = (does) => {
    try {
      return does();
    } catch (error) {
      if (error.isFatal) throw error;
      return [`${error.status}: ${error.text}`, ""];
    }
  };
  const drawing = (request) => {
    const answer = core.draw(scene, request);
    const { counts = [] } = core.draw(scene, { ...request, counts: true });
    return [answer.hash, counts.join()];
  };
  for (const line of lines) {
    const [name, algorithm, wanted, counts] = line.split("\t");
    if (scene?.name !== name) {
      if (scene) core.close(scene);
      scene = core.open({ name });
    }
    const [got, counted] = said(() => drawing({ algorithm, m: size, n: size }));
    drawn += 1;
    if (got === wanted && (oracles.has(algorithm) || counted === counts)) continue;
    differ += 1;
    report(`${name} ${algorithm}: ${got} ${counted}, not ${wanted} ${counts}`);
  }
  if (scene) core.close(scene);
  return { drawn, differ };
}
