// SPDX-License-Identifier: MIT
import { element, make } from "./dom.js";
import { whole } from "./words.js";

/** The search field: return selects the first object that is meant, and at the next time the next one. */
export function watchSearch(names, select) {
  const field = element("wanted");
  element("names").replaceChildren(...names.words.slice(0, 200).map((word) => make("option", "", { value: word })));
  let last = { text: "", place: -1 };
  element("search").addEventListener("submit", (event) => {
    event.preventDefault();
    const found = names.find(field.value);
    last = { text: field.value, place: field.value === last.text ? (last.place + 1) % Math.max(found.length, 1) : 0 };
    element("found").textContent = found.length === 0 ? names.nothing(field.value) : `${whole(last.place + 1)} of ${whole(found.length)}`;
    if (found.length > 0) select(found[last.place]);
  });
  field.addEventListener("input", () => (element("found").textContent = ""));
}
