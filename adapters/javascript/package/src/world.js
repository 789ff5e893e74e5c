// SPDX-License-Identifier: MIT
import { floatTypes, methodOf, optionalArray, requireAsMany, requireBoolean, requireFloats, requireIds, requireInteger, requireOneOf, requireOptions } from "./arguments.js";
import { filtersOf } from "./filters.js";
import { answer, lend, number, part } from "./module.js";
import { raysOf } from "./rays.js";
import { Resource } from "./resource.js";
import { checkValidity, warnInWorld } from "./validity.js";

const dtypes = ["float32", "float64"];
const ids = (index) => part(index, Float64Array);

export class World extends Resource {
  #dtype;
  #held = {}; // begun, ended and pairs, once they have been asked for since the last update

  constructor(options = {}) {
    requireOptions(options, ["dtype", "stickyFilters", "method", "cutoff"]);
    const { dtype = "float32", stickyFilters = false } = options;
    requireOneOf(dtype, "dtype", dtypes);
    requireBoolean(stickyFilters, "stickyFilters");
    super("createWorld", "destroyWorld", dtypes.indexOf(dtype), stickyFilters, ...methodOf(options));
    this.#dtype = dtype;
  }

  get dtype() {
    Resource.handleOf(this);
    return this.#dtype;
  }

  get size() {
    return this.#ask("size", [], () => number(0));
  }

  create(boxes, options = {}) {
    requireOptions(options, ["groups", "masks", "users", "invalid"]);
    const { groups, masks, users, invalid } = options;
    const count = this.#countOf(boxes, "boxes", 6, invalid);
    warnInWorld(boxes, invalid);
    const filters = filtersOf(groups, masks, count);
    const numbers = optionalArray(users, "users", "Uint32Array", count);
    return lend([boxes, filters, numbers], (at, ...more) => this.#ask("create", [at, count, ...more], () => ids(0)));
  }

  move(moved, boxes, options = {}) {
    requireOptions(options, ["invalid"]);
    const { invalid } = options;
    requireIds(moved);
    requireAsMany(this.#countOf(boxes, "boxes", 6, invalid), "boxes", moved.length, "ids");
    return lend([moved, boxes], (at, to) => this.#ask("move", [at, moved.length, to], () => number(0)));
  }

  destroy(destroyed) {
    return this.#askOf(destroyed, "destroy", () => number(0));
  }

  setFilters(changed, options = {}) {
    requireOptions(options, ["groups", "masks"]);
    const { groups, masks } = options;
    const filters = filtersOf(groups, masks, requireIds(changed).length);
    return lend([changed, filters], (at, to) => this.#ask("setFilters", [at, changed.length, to], () => number(0)));
  }

  clear() {
    this.#held = {};
    this.#ask("clear", [], () => undefined);
  }

  update() {
    const stats = this.#ask("update", [], () => Array.from({ length: 6 }, (_, i) => number(i)));
    this.#held = {};
    const [proxies, invalid, moved, pairs, begun, ended] = stats;
    return { proxies, invalid, moved, pairs, begun, ended };
  }

  contains(asked) {
    return this.#askOf(asked, "contains", () => part(0, Uint8Array));
  }

  boxes(asked) {
    return this.#askOfLive(asked, "boxes", () => this.#floats(0, 6));
  }

  users(asked) {
    return this.#askOfLive(asked, "users", () => part(0, Uint32Array));
  }

  get bounds() {
    return this.#ask("bounds", [], () => this.#floats(0, 6));
  }

  get begun() {
    return this.#pairs("begun");
  }

  get ended() {
    return this.#pairs("ended");
  }

  get pairs() {
    return this.#pairs("pairs");
  }

  queryBoxes(boxes) {
    const count = this.#countOf(boxes, "boxes", 6);
    return lend([boxes], (at) => this.#ask("queryBoxes", [at, count], () => ({ queries: part(0, Uint32Array), ids: ids(1) })));
  }

  queryRays(origins, directions, lengths) {
    return this.#cast("queryRays", origins, directions, lengths, () => ({
      queries: part(0, Uint32Array),
      ids: ids(1),
      enters: this.#floats(2),
    }));
  }

  castRays(origins, directions, lengths) {
    return this.#cast("castRays", origins, directions, lengths, () => ({ ids: ids(0), enters: this.#floats(1) }));
  }

  queryNearest(points, count = 1) {
    const size = this.#countOf(points, "points", 3);
    requireInteger(count, "count", 0);
    if (count * size > 2 ** 28) throw new RangeError(`count: too many for ${size} points, got ${count}`);
    return lend([points], (at) => this.#ask("queryNearest", [at, size, count], () => ids(0)));
  }

  #floats(index, columns) {
    return part(index, floatTypes[this.#dtype], columns);
  }

  #countOf(floats, name, columns, invalid) {
    requireFloats(floats, name, columns, this.#dtype);
    if (columns === 6) checkValidity(floats, name, invalid);
    return floats.length / columns;
  }

  #ask(name, given, read) {
    return answer(name, [Resource.handleOf(this), ...given], read);
  }

  #askOf(asked, name, read) {
    requireIds(asked);
    return lend([asked], (at) => this.#ask(name, [at, asked.length], read));
  }

  #askOfLive(asked, name, read) {
    return this.#askOf(asked, name, () => {
      if (number(0) === asked.length) return read();
      throw new RangeError(`ids: expected ids of live proxies, got a stale or null one at ids[${number(0)}]`);
    });
  }

  #pairs(name) {
    Resource.handleOf(this);
    return (this.#held[name] ??= this.#ask(name, [], () => ids(0)));
  }

  #cast(name, origins, directions, lengths, read) {
    const rays = raysOf(origins, directions, lengths, this.#dtype);
    return lend(rays.arrays, (from, to, ends) => this.#ask(name, [from, to, rays.count, ends, rays.length], read));
  }
}
