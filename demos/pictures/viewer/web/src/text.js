// SPDX-License-Identifier: MIT
// What the page carries in script elements; text.hpp of the recorder says how.

const digits = 93;
const digit = (code) => code - (code > 60 ? 34 : 33);

function bytesOf(text) {
  const bytes = new Uint8Array((13 * (text.length >> 1) + 6 * (text.length & 1)) >> 3);
  let held = 0;
  let bits = 0;
  let to = 0;
  for (let i = 0; i < text.length; i += 2) {
    const isPair = i + 1 < text.length;
    held |= (digit(text.charCodeAt(i)) + (isPair ? digits * digit(text.charCodeAt(i + 1)) : 0)) << bits;
    for (bits += isPair ? 13 : 6; bits >= 8; bits -= 8) {
      bytes[to++] = held;
      held >>>= 8;
    }
  }
  return bytes;
}

/** The bytes of the element `id`. */
export async function unpacked(id) {
  const bytes = bytesOf(document.getElementById(id).textContent);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
