// SPDX-License-Identifier: MIT

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
