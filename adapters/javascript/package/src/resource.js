// SPDX-License-Identifier: MIT
// Objects in the module's memory, which the garbage collector does not see.
import { call, functions, made } from "./module.js";

const dispose = Symbol.dispose ?? Symbol.for("Symbol.dispose");
const forgotten = new FinalizationRegistry(({ destroy, handle }) => functions[destroy](handle));

/** Owns one object of the module. It is destroyed by `free`, or some time after nothing refers to it any more. */
export class Resource {
  #handle;
  #destroy;

  constructor(create, destroy, ...given) {
    call(create, ...given);
    this.#handle = made();
    this.#destroy = destroy;
    forgotten.register(this, { destroy, handle: this.#handle }, this);
  }

  static handleOf(resource) {
    if (resource.#handle === 0) throw new Error(`this ${resource.constructor.name} has been freed`);
    return resource.#handle;
  }

  free() {
    if (this.#handle === 0) return;
    forgotten.unregister(this);
    functions[this.#destroy](this.#handle);
    this.#handle = 0;
  }

  [dispose]() {
    this.free();
  }
}
