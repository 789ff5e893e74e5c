// SPDX-License-Identifier: MIT
// Takes blocks of frames apart; frames.hpp of the recorder has their layout.

/** Reads the frames of one block, which can only be read in order. */
export class BlockReader {
  /** `bytes` of the block; a world of that many objects and nodes. */
  constructor(bytes, objects, nodes) {
    this.bytes = bytes;
    this.at = 0;
    this.objects = objects;
    this.nodes = nodes;
    this.former = null;
    this.beforeFormer = null;
  }

  next() {
    const { objects, nodes } = this;
    const frame = {
      places: this.series("places", new Int32Array(3 * (objects + nodes)), 4, true),
      rotations: this.series("rotations", new Int16Array(4 * objects), 3, true),
      corners: this.series("corners", new Int32Array(6 * objects), 4, true),
      islands: this.series("islands", new Int32Array(objects), 4, false),
      moods: this.series("moods", new Uint8Array(objects), 1, false),
      pairs: null,
    };
    const ended = this.pairs();
    const begun = this.pairs();
    frame.pairs = changed(this.former ? this.former.pairs : [], ended, begun);
    this.beforeFormer = this.former;
    this.former = frame;
    return frame;
  }

  /** Fills `values`, coded in `bytes` bytes each; `straight`: foretold from two frames rather than one. */
  series(name, values, bytes, straight) {
    const data = this.bytes;
    const count = values.length;
    const start = this.at;
    const former = this.former?.[name];
    const before = straight ? this.beforeFormer?.[name] : undefined;
    for (let i = 0; i < count; ++i) {
      let coded = data[start + i];
      for (let byte = 1; byte < bytes; ++byte) coded |= data[start + byte * count + i] << (8 * byte);
      let value = (coded >>> 1) ^ -(coded & 1);
      if (former) value += former[i];
      if (before) value += former[i] - before[i];
      values[i] = value;
    }
    this.at += bytes * count;
    return values;
  }

  number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++];
      value |= (byte & 0x7f) << shift;
      if (byte < 0x80) return value >>> 0;
    }
  }

  /** Pairs a, b, a, b ... */
  pairs() {
    const pairs = new Uint32Array(2 * this.number());
    let a = 0;
    let b = 0;
    for (let i = 0; i < pairs.length; i += 2) {
      const step = this.number();
      a += step;
      b = this.number() + (step === 0 ? b : a);
      pairs[i] = a;
      pairs[i + 1] = b;
    }
    return pairs;
  }
}

const isBefore = (list, i, other, k) => list[i] < other[k] || (list[i] === other[k] && list[i + 1] < other[k + 1]);

/** Sorted `pairs` without `ended`, which are all in it, and with `begun`. */
function changed(pairs, ended, begun) {
  const result = new Uint32Array(pairs.length - ended.length + begun.length);
  let gone = 0;
  let added = 0;
  let to = 0;
  const put = (list, i) => {
    result[to++] = list[i];
    result[to++] = list[i + 1];
  };
  for (let i = 0; i < pairs.length; i += 2) {
    if (gone < ended.length && ended[gone] === pairs[i] && ended[gone + 1] === pairs[i + 1]) {
      gone += 2;
      continue;
    }
    for (; added < begun.length && isBefore(begun, added, pairs, i); added += 2) put(begun, added);
    put(pairs, i);
  }
  for (; added < begun.length; added += 2) put(begun, added);
  return result;
}
