// SPDX-License-Identifier: MIT
// HTML elements in one call each; text stays text.

/** element("p.note", {title: "t"}, "text", child): strings become text, null is left out. */
export function element(what, attributes = {}, ...children) {
  const [name, ...classes] = what.split(".");
  const made = document.createElement(name);
  if (classes.length > 0) made.className = classes.join(" ");
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false && child !== ""));
  return made;
}

export const escaped = (text) => String(text).replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);

/** Saves `content`, text or a data address, as a file. */
export function save(name, content, type) {
  const isAddress = type === undefined;
  const href = isAddress ? content : URL.createObjectURL(new Blob([content], { type }));
  element("a", { href, download: name }).click();
  if (!isAddress) setTimeout(() => URL.revokeObjectURL(href), 10_000);
}

export const saveButton = (label, name, make, type) => element("button.save", { type: "button", title: `Save ${name}`, onclick: async () => save(name, await make(), type) }, label);

/** A table whose cells are texts, elements, or {text, number: true}. */
export function tableOf(head, rows, attributesOf = () => ({})) {
  const cell = (name, content) => (content !== null && typeof content === "object" && "number" in content ? element(`${name}.n`, {}, content.text) : element(name, {}, content));
  return element(
    "div.wide",
    { tabindex: "0" },
    element("table", {}, element("thead", {}, element("tr", {}, head.map((text) => cell("th", text)))), element("tbody", {}, rows.map((row, i) => element("tr", attributesOf(i), row.map((content) => cell("td", content)))))),
  );
}

/** A part that opens; what is in it is made when it is opened first, or by `reveal`, which opens it. */
export function unfolding(title, make, attributes = {}) {
  const made = element("details", attributes, element("summary", {}, title));
  made.fill = () => {
    if (made.children.length === 1) made.append(...[make()].flat(Infinity).filter(Boolean));
  };
  made.reveal = () => {
    made.fill();
    made.open = true;
  };
  made.addEventListener("toggle", () => made.open && made.fill());
  return made;
}
