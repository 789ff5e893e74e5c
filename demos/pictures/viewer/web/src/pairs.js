// SPDX-License-Identifier: MIT
// Pairs, touches and contacts of frames; pair_code.hpp of the recorder says how they are coded.

const isBefore = (list, i, other, k) => list[i] < other[k] || (list[i] === other[k] && list[i + 1] < other[k + 1]);

/** Places that ascend. */
function places(bytes) {
  const list = new Uint32Array(bytes.number());
  let last = 0;
  for (let i = 0; i < list.length; ++i) list[i] = last += bytes.number();
  return list;
}

/** Pairs a, b, a, b ... */
function newPairs(bytes) {
  const list = new Uint32Array(2 * bytes.number());
  let a = 0;
  let b = 0;
  for (let i = 0; i < list.length; i += 2) {
    const step = bytes.number();
    a += step;
    b = bytes.number() + (step === 0 ? b : a);
    list[i] = a;
    list[i + 1] = b;
  }
  return list;
}

/** Sorted pairs and whether they touch, {pairs, touching}: of `former`, without those at the places `ended`, and with `begun`. */
function changed(former, ended, begun) {
  const count = former.touching.length - ended.length + begun.length / 2;
  const pairs = new Uint32Array(2 * count);
  const touching = new Uint8Array(count);
  let gone = 0;
  let added = 0;
  let to = 0;
  const put = (list, i, touches) => {
    touching[to / 2] = touches;
    pairs[to++] = list[i];
    pairs[to++] = list[i + 1];
  };
  for (let i = 0; i < former.pairs.length; i += 2) {
    if (gone < ended.length && 2 * ended[gone] === i) {
      ++gone;
      continue;
    }
    for (; added < begun.length && isBefore(begun, added, former.pairs, i); added += 2) put(begun, added, 0);
    put(former.pairs, i, former.touching[i / 2]);
  }
  for (; added < begun.length; added += 2) put(begun, added, 0);
  return { pairs, touching };
}

/** A direction from its place on the square of an octahedron. */
function direction(u, v) {
  let x = (2 * u) / 63 - 1;
  let y = (2 * v) / 63 - 1;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/**
 * Contacts of the pairs `pairs`: {objects: a, b, a, b ..., offsets: from the place of a, or of b where a is fixed, in quanta,
 * normals, anchors: which of the two it is}; null: those of the frame before.
 */
function contacts(bytes, pairs, isFixed) {
  const count = bytes.number() - 1;
  if (count < 0) return null;
  const list = { objects: new Uint32Array(2 * count), offsets: new Float32Array(3 * count), normals: new Float32Array(3 * count), anchors: new Uint32Array(count) };
  let place = 0;
  for (let i = 0; i < count; ++i) {
    place += bytes.number();
    const a = pairs[2 * place];
    const b = pairs[2 * place + 1];
    list.objects[2 * i] = a;
    list.objects[2 * i + 1] = b;
    list.anchors[i] = isFixed(a) ? b : a;
    for (let d = 0; d < 3; ++d) list.offsets[3 * i + d] = bytes.signed();
    list.normals.set(direction(bytes.number(), bytes.number()), 3 * i);
  }
  return list;
}

/** {pairs, touching, contacts} of the frame after `former`, which has the same. */
export function nextPairs(bytes, former, isFixed) {
  const ended = places(bytes);
  const next = changed(former, ended, newPairs(bytes));
  for (const place of places(bytes)) next.touching[place] ^= 1;
  next.contacts = contacts(bytes, next.pairs, isFixed) ?? former.contacts;
  return next;
}

export const noPairs = { pairs: new Uint32Array(0), touching: new Uint8Array(0), contacts: null };
