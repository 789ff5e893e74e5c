// SPDX-License-Identifier: MIT

export const element = (id) => document.getElementById(id);

export function make(tag, text = "", properties = {}) {
  const node = document.createElement(tag);
  node.textContent = text;
  return Object.assign(node, properties);
}

/** Terms and what they stand for, for a <dl>. */
export const rows = (list) => list.flatMap(([term, text]) => [make("dt", term), make("dd", text)]);
