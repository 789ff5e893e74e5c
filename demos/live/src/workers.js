// SPDX-License-Identifier: MIT
// Workers run the script of the page once more, since a page that is one file has no other; their names tell their parts.

const source = globalThis.document?.scripts[0].textContent;
let address = null;

export function startWorker(name, onMessage) {
  address ??= URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  const worker = new Worker(address, { name });
  worker.onmessage = ({ data }) => onMessage(data);
  worker.onerror = (event) => onMessage({ failed: event.message || "a worker could not start" });
  return worker;
}
