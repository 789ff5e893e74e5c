// SPDX-License-Identifier: MIT
// What is given must be of the type and the length that is expected: TypeError for types, RangeError for the rest, with
// what was expected and what was given.

export const floatTypes = { float32: Float32Array, float64: Float64Array };

/** What a value is called in errors. Typed arrays of other windows are known by it too. */
export function typeOf(value) {
  if (value === null || typeof value !== "object") return value === null ? "null" : typeof value;
  return ArrayBuffer.isView(value) ? value[Symbol.toStringTag] : (value.constructor?.name ?? "object");
}

/** What makes a typed array of what has numbers. */
function conversion(value, type) {
  const made = (from) => `; ${type}.from(${from}) makes one`;
  if (Array.isArray(value)) {
    if (Array.isArray(value[0])) return made("rows.flat()");
    return typeof value[0] === "object" ? made("objects.flatMap((o) => [o.minX, o.minY, o.maxX, o.maxY])") : made("numbers");
  }
  const hasNumbers = ArrayBuffer.isView(value) && "BYTES_PER_ELEMENT" in value && typeof value[0] !== "bigint";
  return hasNumbers ? made("numbers") + (typeOf(value) === "Float64Array" && type === "Float32Array" ? ", rounded" : "") : "";
}

function requireType(value, name, types, why = "") {
  if (types.includes(typeOf(value))) return;
  throw new TypeError(`${name}: expected a ${types.join(" or ")}${why}, got ${typeOf(value)}${conversion(value, types.includes("Float64Array") ? "Float64Array" : types[0])}`);
}

/** An object that has no other properties than these: what is misspelt would not be seen. */
export function requireOptions(value, names) {
  if (typeof value !== "object" || value === null) throw new TypeError(`options: expected an object, got ${typeOf(value)}`);
  if (Array.isArray(value) || ArrayBuffer.isView(value)) throw new TypeError(`options: expected an object, got ${typeOf(value)}${names.includes("other") ? "; a second set of boxes is { other: boxes }" : ""}`);
  for (const name of Object.keys(value)) {
    if (!names.includes(name)) throw new TypeError(`options: expected of ${names.join(", ")}, got ${name}`);
  }
}

/** `float32` or `float64`, of an array of floats in groups of `columns`; it has to be `dtype`, if that is given. */
export function requireFloats(value, name, columns, dtype, owner = "as the World has") {
  if (dtype) requireType(value, name, [floatTypes[dtype].name], `, ${owner}`);
  else requireType(value, name, ["Float32Array", "Float64Array"]);
  if (value.length % columns) {
    throw new RangeError(`${name}: expected a length that is a multiple of ${columns}, got ${value.length}`);
  }
  return typeOf(value) === "Float32Array" ? "float32" : "float64";
}

export const boxTypes = { float32: Float32Array, float64: Float64Array, int32: Int32Array };

/** `float32`, `float64` or `int32`, of an array of boxes; it has to be `dtype`, if that is given. */
export function requireBoxes(value, name, dimensions, dtype) {
  if (dtype) requireType(value, name, [boxTypes[dtype].name], ", as boxes are");
  else requireType(value, name, ["Float32Array", "Float64Array", "Int32Array"]);
  const columns = 2 * dimensions;
  if (value.length % columns) {
    const hint = value.length % 4 === 0 && dimensions === 3 ? "; boxes of two dimensions take dimensions: 2" : "";
    throw new RangeError(`${name}: expected a length that is a multiple of ${columns}, got ${value.length}${hint}`);
  }
  return Object.keys(boxTypes).find((type) => boxTypes[type].name === typeOf(value));
}

export function requireBoolean(value, name) {
  if (typeof value !== "boolean") throw new TypeError(`${name}: expected true or false, got ${typeOf(value)}`);
}

function requireCount(value, name, count) {
  if (value.length !== count) throw new RangeError(`${name}: expected ${count} elements, got ${value.length}`);
}

/** An array of one type with `count` elements, or undefined. */
export function optionalArray(value, name, type, count) {
  if (value === undefined || value === null) return undefined;
  requireType(value, name, [type]);
  requireCount(value, name, count);
  return value;
}

export function requireIds(value, name = "ids") {
  requireType(value, name, ["Float64Array"]);
  return value;
}

export function requireAsMany(given, name, count, what) {
  if (given !== count) throw new RangeError(`${name}: expected one for each of ${count} ${what}, got ${given}`);
}

export function requireOneOf(value, name, choices) {
  if (choices.includes(value)) return;
  const expected = `${name}: expected ${choices.map((choice) => `"${choice}"`).join(" or ")}`;
  if (typeof value !== "string") throw new TypeError(`${expected}, got ${typeOf(value)}`);
  throw new RangeError(`${expected}, got "${value}"`);
}

export function requireInteger(value, name, least) {
  if (typeof value !== "number") throw new TypeError(`${name}: expected an integer, got ${typeOf(value)}`);
  if (!Number.isSafeInteger(value) || value < least) {
    throw new RangeError(`${name}: expected an integer of at least ${least}, got ${value}`);
  }
}

/** What the module takes of `{ method, cutoff }`. */
export function methodOf({ method = "planned", cutoff = 0 }) {
  requireOneOf(method, "method", ["planned", "hybrid"]);
  requireInteger(cutoff, "cutoff", 0);
  if (cutoff > 0xffffffff) throw new RangeError(`cutoff: expected an integer below 2^32, got ${cutoff}`);
  return [method === "hybrid", cutoff];
}
