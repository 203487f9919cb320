// SPDX-License-Identifier: GPL-3.0-or-later
// Elements. Anything that is not an element becomes text, never markup, because
// names of scenes may hold any character.

export function h(name, attributes, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? "" : value);
  }
  append(element, children);
  return element;
}

function append(element, children) {
  for (const child of children) {
    if (Array.isArray(child)) append(element, child);
    else if (child !== null && child !== undefined && child !== false)
      element.append(child);
  }
}

export function link(href, ...children) {
  return h("a", { href }, children);
}

// A heading and its content; nothing at all if there is no content.
export function section(title, id, ...children) {
  const there = children.flat(Infinity).filter(Boolean);
  return there.length ? h("section", { id }, h("h2", {}, title), there) : null;
}

// Pairs of a term and its value; pairs without a value are left out.
export function facts(pairs) {
  const there = pairs.filter(([, value]) => value !== null && value !== "" &&
    value !== undefined && !(Array.isArray(value) && !value.length));
  return h("dl", { class: "facts" }, there.map(([term, value]) =>
    h("div", {}, h("dt", {}, term), h("dd", {}, value))));
}
