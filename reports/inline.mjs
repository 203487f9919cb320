// SPDX-License-Identifier: GPL-3.0-or-later
// node inline.mjs PAGE SCRIPT STYLE... OUTPUT: puts a script and style sheets into
// a page, which then is one file.
import { readFileSync, writeFileSync } from "node:fs";

const [page, script, ...rest] = process.argv.slice(2);
const output = rest.pop();
const text = (path) => readFileSync(path, "utf8");
const put = (html, mark, what) => {
  if (html.split(mark).length !== 2) throw new Error(`${page}: not one ${mark}`);
  return html.replace(mark, () => what);
};
let html = put(text(page), "<!--style-->", rest.map(text).join("\n"));
html = put(html, "<!--script-->", text(script).replaceAll("</script", "<\\/script"));
writeFileSync(output, html);
