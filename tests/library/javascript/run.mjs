// SPDX-License-Identifier: MIT
// node run.mjs PROGRAM.wasm: runs a program that does nothing with its host but print.
import { readFileSync, writeSync } from "node:fs";

let memory;

/** Writes `count` pieces, each an address and a length, and tells how many bytes they were. */
function write(descriptor, pieces, count, told) {
  const words = new Uint32Array(memory.buffer);
  words[told / 4] = 0;
  for (let i = 0; i < count; ++i) {
    const [from, length] = words.subarray(pieces / 4 + 2 * i);
    writeSync(descriptor, new Uint8Array(memory.buffer, from, length));
    words[told / 4] += length;
  }
  return 0;
}

const host = { fd_write: write, proc_exit: (status) => process.exit(status) };
const nothing = new Proxy(host, { get: (calls, name) => calls[name] ?? (() => 0) });
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { env: nothing, wasi_snapshot_preview1: nothing });
memory = instance.exports.memory;
instance.exports._start();
