// SPDX-License-Identifier: MIT
import { element, make } from "./dom.js";
import { whole } from "./words.js";

/** What objects are called, and which of them a search means. */
export class Names {
  /** `kinds`: what objects without a name are called by. */
  constructor({ names, states }, objects, kinds) {
    this.objects = objects;
    const given = states.map((_, object) => (object < names.of.length ? names.words[names.of[object]] : "wheel"));
    const plain = given.map((name, object) => name || kinds[object] || "object");
    const uses = new Map();
    for (const name of plain) uses.set(name, (uses.get(name) ?? 0) + 1);
    this.words = [...uses.keys()];
    this.all = plain.map((name, object) => (uses.get(name) > 1 || !given[object] ? `${name} ${objects.numberOf(object)}` : name));
  }

  of(object) {
    return this.all[object];
  }

  isNumber(text) {
    return /^\d+$/.test(text) && Number(text) < this.objects.count;
  }

  /** What is said where `find` finds nothing. */
  nothing(text) {
    if (this.objects.isAll) return "none";
    return this.isNumber(text.trim()) ? "not shown" : "none shown";
  }

  /** Objects that `text` means, in order: that with this number, or those with it in their names. */
  find(text) {
    const wanted = text.trim().toLowerCase();
    if (!wanted) return [];
    if (this.isNumber(wanted)) return [this.objects.placeOf(Number(wanted))].filter((object) => object >= 0);
    return this.all.flatMap((name, object) => (name.toLowerCase().includes(wanted) ? [object] : []));
  }
}

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
