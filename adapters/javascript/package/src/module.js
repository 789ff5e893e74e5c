// SPDX-License-Identifier: MIT
// The WebAssembly module: its memory, how arrays go in and come out, and what its errors become.
import "./wasm.js";

/* global BOXSTREAM_VERSION -- which the build defines; programs may have several versions of this package */
const compiled = globalThis[Symbol.for(`boxstream ${BOXSTREAM_VERSION}`)];

// The memory can grow in any call, which takes away what was viewed before: each use makes its own view.
const { memory, ...exported } = instantiate();
export const functions = exported;

function instantiate() {
  const ignored = () => 0;
  const host = { emscripten_notify_memory_growth: ignored, proc_exit: ignored };
  const { exports } = new WebAssembly.Instance(compiled, {
    env: host,
    wasi_snapshot_preview1: host,
  });
  exports._initialize();
  return exports;
}

const address = functions.answer();
const statuses = { ok: 0, noMemory: 1 };
const places = { error: 6, numbers: 8 };

function textAt(from) {
  const all = new Uint8Array(memory.buffer);
  return String.fromCharCode(...all.subarray(from, all.indexOf(0, from)));
}

function words() {
  return new Uint32Array(memory.buffer, address);
}

/** Calls a function that returns a status. */
export function call(name, ...given) {
  const status = functions[name](...given);
  if (status === statuses.ok) return;
  functions.forget();
  if (status === statuses.noMemory) throw new RangeError("boxstream: out of memory");
  throw new RangeError(textAt(words()[places.error]));
}

/** A copy of one array of the last answer, of which one element has `columns` of the type. */
export function part(index, Type, columns = 1) {
  const [from, elements] = words().subarray(2 * index);
  return new Type(memory.buffer, from, elements * columns).slice();
}

/** The address of an object that was made. */
export const made = () => words()[0];

export function number(index) {
  return new Float64Array(memory.buffer, address + 4 * places.numbers)[index];
}

/** What `read` makes of the answer to a call, whose memory is given back. */
export function answer(name, given, read) {
  call(name, ...given);
  try {
    return read();
  } finally {
    functions.forget();
  }
}

/** Where copies of the arrays lie while `use` runs: 0 for undefined. */
export function lend(arrays, use) {
  const copies = [];
  try {
    for (const array of arrays) copies.push(array === undefined ? 0 : copyOf(array));
    return use(...copies);
  } finally {
    for (const copy of copies) functions.release(copy);
  }
}

/** Byte by byte: constructors of classes that extend typed arrays take what they like. */
function copyOf(array) {
  const bytes = array.byteLength; // once: a worker may make a shared array longer meanwhile
  const copy = functions.allocate(bytes) >>> 0;
  if (copy === 0) throw new RangeError("boxstream: out of memory");
  new Uint8Array(memory.buffer, copy, bytes).set(new Uint8Array(array.buffer, array.byteOffset, bytes));
  return copy;
}

export const simdTarget = () => textAt(functions.simdTarget());
