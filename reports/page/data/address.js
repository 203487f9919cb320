// SPDX-License-Identifier: GPL-3.0-or-later
// The address says what is shown: #/page/argument?name=value&...

export function read() {
  const [path, query] = split(location.hash.replace(/^#\/?/, ""), "?");
  const [page, argument] = split(path, "/").map(decode);
  return { page, argument, params: new URLSearchParams(query) };
}

function split(text, at) {
  const k = text.indexOf(at);
  return k < 0 ? [text, ""] : [text.slice(0, k), text.slice(k + 1)];
}

function decode(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

export function href(page, argument = "", params = {}) {
  const query = new URLSearchParams(params).toString();
  const path = [page, argument].filter(Boolean).map(encodeURIComponent);
  return `#/${path.join("/")}${query && `?${query}`}`;
}

// Puts the reader's choice into the address, without a new entry in the history.
export function set(changes) {
  const { page, argument, params } = read();
  for (const [name, value] of Object.entries(changes)) {
    if (value === null || value === "") params.delete(name);
    else params.set(name, value);
  }
  history.replaceState(null, "", href(page, argument, params));
}
