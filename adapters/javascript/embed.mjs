// SPDX-License-Identifier: MIT
// node embed.mjs MODULE.wasm VERSION OUT.js: makes a script that compiles the module, of which it has the bytes as text.
//
// A character is a byte plus 32, so that few are control characters. Such text becomes hardly larger by packing than the
// module itself; base64 would be half as large again.
import { readFileSync, writeFileSync } from "node:fs";

const [, , from, version, to] = process.argv;
const escapes = { "\0": "\\x00", "\n": "\\n", "\r": "\\r", '"': '\\"', "\\": "\\\\" };
const text = Buffer.from(readFileSync(from).map((byte) => byte + 32)).toString("latin1");

// A script that is a module for browsers and bundlers, and CommonJS for Node: one file for both kinds of package.
writeFileSync(to, `// SPDX-License-Identifier: MIT
globalThis[Symbol.for("boxstream ${version}")] = new WebAssembly.Module(
  Uint8Array.from("${text.replace(/[\0\n\r"\\]/g, (c) => escapes[c])}", (character) => character.charCodeAt(0) - 32),
);
`);
