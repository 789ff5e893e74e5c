// SPDX-License-Identifier: MIT

// Of so many bodies boxes can be told apart in a picture, and pairs and contacts, of which each has several.
const legible = { boxes: 300, pairs: 100 };
const [far, near, nearest] = [0, 1, 2];

/** Which objects' boxes, pairs and contacts are drawn: those of a selection, else all where they are few, else the nearest to the eye. */
export class Focus {
  constructor(count) {
    this.marks = new Uint8Array(count);
    this.distances = new Float32Array(count);
    this.isAll = true;
  }

  hasBox(object) {
    return this.isAll || this.marks[object] >= near;
  }
  hasPairs(object) {
    return this.isAll || this.marks[object] === nearest;
  }

  /** `objects`: those that move. */
  set(frame, poses, objects, selected, eye) {
    this.isAll = selected < 0 && objects.length <= legible.boxes;
    if (this.isAll) return;
    this.marks.fill(0);
    if (selected >= 0) this.around(frame, selected);
    else this.ranked(poses, objects, eye);
  }

  around({ pairs }, selected) {
    this.marks[selected] = nearest;
    for (let i = 0; i < pairs.length; i += 2) {
      if (pairs[i] === selected) this.marks[pairs[i + 1]] = nearest;
      if (pairs[i + 1] === selected) this.marks[pairs[i]] = nearest;
    }
  }

  ranked({ places, visible }, objects, eye) {
    const away = (object) => (places[3 * object] - eye.x) ** 2 + (places[3 * object + 1] - eye.y) ** 2 + (places[3 * object + 2] - eye.z) ** 2;
    const distances = this.distances.subarray(0, objects.length);
    objects.forEach((object, i) => (distances[i] = visible[object] ? away(object) : Infinity));
    const sorted = Float32Array.from(distances).sort();
    const [most, least] = [sorted[legible.boxes], sorted[legible.pairs]];
    objects.forEach((object, i) => (this.marks[object] = distances[i] < least ? nearest : distances[i] < most ? near : far));
  }
}
