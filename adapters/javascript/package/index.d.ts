// SPDX-License-Identifier: MIT
// All touching pairs of axis-aligned boxes in three dimensions.
//
// Boxes are closed, touching counts, and no tolerance is added, unless options say otherwise: an array of boxes has six
// numbers a box, min x, y, z and max x, y, z; of two dimensions four, of one two. A box with a NaN or with min > max is invalid and pairs with nothing; infinite bounds are legal.
// Arguments of a wrong type, and options of a wrong name, are a TypeError; those of a wrong length or value, and memory
// that runs out, a RangeError. Objects then stay as they were. Arrays are copied in and copied out: results are the
// caller's. Pairs of a World are copied once after each update: until the next, all who ask get the same array.

declare global {
  interface SymbolConstructor {
    /** Of TypeScript 5.2's `using`; declared here for those before. */
    readonly dispose: unique symbol;
  }
}

export type Floats = Float32Array | Float64Array;

/** Of searches, whose numbers are compared exactly. */
export type Boxes = Floats | Int32Array;

/** What invalid boxes are: `"skip"`, without pairs, or `"throw"`, a RangeError that names the first. */
export type Invalid = "skip" | "throw";

/** Two boxes may pair where the group of each meets the mask of the other. One number a box; by default 1 and 0xffffffff. */
export interface Filters {
  groups?: Uint32Array;
  masks?: Uint32Array;
}

/** Which boxes pair. */
export interface Rules {
  /** False: boxes that share no more than a face, an edge or a corner do not pair. True unless given. */
  closed?: boolean;
  /** Boxes pair, too, that are so far apart on each axis; nothing is rounded. 0 unless given. */
  tolerance?: number;
  /** 3 unless given. With 2 an array has min x, y, max x, y of each box, with 1 the two ends of each interval. */
  dimensions?: 1 | 2 | 3;
  /**
   * `"warn"` unless given: as `"skip"`, and if more than a tenth are invalid, a warning on the console names the likely layout: once
   * for each layout, in a page or worker.
   */
  invalid?: "warn" | Invalid;
}

export interface OneSet extends Filters, Rules {
  other?: undefined;
  /** Boxes with equal ids do not pair. One number a box. */
  ids?: Uint32Array;
}

export interface TwoSets<T extends Boxes> extends Rules {
  /** Pairs are sought between the boxes and these, of the same type, and not within one of the two. */
  other: T;
  /** Of the boxes and of the other ones. */
  groups?: [Uint32Array | undefined, Uint32Array | undefined];
  masks?: [Uint32Array | undefined, Uint32Array | undefined];
  /** Boxes do not pair with other ones of the same id. */
  idsA?: Uint32Array;
  idsB?: Uint32Array;
}

/**
 * All pairs of boxes that touch, each once: indices a, b, a, b, ... with a < b, or with b in `other`. Their order is a
 * function of the boxes alone.
 */
export function findPairs<T extends Boxes>(boxes: T, options?: OneSet | TwoSets<T>): Uint32Array;

/** The neighbours of box i are `indices.subarray(offsets[i], offsets[i + 1])`, ascending. */
export interface Neighbours {
  readonly offsets: Uint32Array;
  readonly indices: Uint32Array;
}

export interface Directions {
  /** True unless given: of two boxes that pair each is a neighbour of the other. False: the one with the larger index only. */
  both?: boolean;
}

/** The pairs of `findPairs` as neighbours of each box; with `other`, of each box those in it. */
export function findNeighbours<T extends Boxes>(boxes: T, options?: (OneSet | TwoSets<T>) & Directions): Neighbours;

/** An object in the module's memory. That is given back by `free`, or some time after the object is out of reach. */
declare class Resource {
  /** Any use after it is an Error. */
  free(): void;
  [Symbol.dispose](): void;
}

/** What one search did; `tests` are comparisons of two boxes. */
export interface Stats {
  readonly boxes: number;
  readonly invalid: number;
  readonly pairs: number;
  readonly tests: number;
}

/** How pairs are found; which ones they are does not depend on it. */
export interface MethodOptions {
  /**
   * `"planned"` unless given. `"hybrid"` is the streamed segment tree with scans of Zomorodian and Edelsbrunner, "Fast
   * software for box intersections", alone: several times slower, and worth comparing with. In a World each update in
   * which a box has changed is then one search of all.
   */
  method?: "planned" | "hybrid";
  /** Of `"hybrid"`, which scans nodes with fewer intervals or points than that. 0 unless given: samples tell when. */
  cutoff?: number;
}

/** The same search as `findPairs`, which keeps its scratch memory from search to search. */
export class Detector extends Resource {
  constructor(options?: MethodOptions);
  findPairs<T extends Boxes>(boxes: T, options?: OneSet | TwoSets<T>): Uint32Array;
  findNeighbours<T extends Boxes>(boxes: T, options?: (OneSet | TwoSets<T>) & Directions): Neighbours;
  /** Of the last search. */
  get stats(): Stats;
}

/** What one update did; `moved` are boxes that changed since the update before, new ones included. */
export interface WorldStats {
  readonly proxies: number;
  readonly invalid: number;
  readonly moved: number;
  readonly pairs: number;
  readonly begun: number;
  readonly ended: number;
}

export interface WorldOptions extends MethodOptions {
  /** Of all boxes, points and rays that it takes and gives: `"float32"` unless given. */
  dtype?: "float32" | "float64";
  /** True: groups and masks are tested only when a pair begins. Otherwise a pair that they refuse ends. */
  stickyFilters?: boolean;
}

export interface CreateOptions extends Filters {
  /** Numbers of the caller's, such as indices of bodies; 0 unless given. */
  users?: Uint32Array;
  invalid?: "warn" | Invalid;
}

/** What several queries found: hit i is of query `queries[i]`, which ascend, and has the id `ids[i]`. */
export interface Hits {
  readonly queries: Uint32Array;
  readonly ids: Float64Array;
}

/** `enters[i]` is where the ray enters, in lengths of its direction; 0 if it starts inside. */
export interface RayHits<T extends Floats = Floats> extends Hits {
  readonly enters: T;
}

/** The first hit of each ray: id 0 and Infinity where there is none. */
export interface FirstHits<T extends Floats = Floats> {
  readonly ids: Float64Array;
  readonly enters: T;
}

/**
 * Boxes that live from frame to frame. An update finds which pairs began and ended; queries see the present boxes.
 *
 * A box in a World is a proxy. Its id is an integer above 0; 0 is no proxy. The first ids are 1, 2, 3, ...; those of
 * destroyed proxies stay stale, until their place has been used two million times more. Calls pass over stale ids unless
 * they say otherwise. Pairs are two ids each, a, b, a, b, ... where a was created before b.
 */
export class World extends Resource {
  constructor(options?: WorldOptions);
  get dtype(): "float32" | "float64";
  /** How many proxies there are. */
  get size(): number;

  /** New proxies, whose pairs begin at the next update. Returns their ids. */
  create(boxes: Floats, options?: CreateOptions): Float64Array;
  /** Replaces boxes, one for each id; fastest in order of creation. Returns how many ids were live. */
  move(ids: Float64Array, boxes: Floats, options?: { invalid?: Invalid }): number;
  /** Removes proxies. Their pairs end at the next update, with ids that are stale by then. Returns how many were live. */
  destroy(ids: Float64Array): number;
  /** Replaces groups and masks; those that are not given become 1 and 0xffffffff. Returns how many were live. */
  setFilters(ids: Float64Array, filters?: Filters): number;
  /** Back to the state of a new World: ids start again. */
  clear(): void;
  /** Brings pairs up to date with boxes and filters. */
  update(): WorldStats;

  /** 1 for live ids, 0 for others. */
  contains(ids: Float64Array): Uint8Array;
  /** Of ids that are all live; a RangeError otherwise. */
  boxes(ids: Float64Array): Floats;
  /** Of ids that are all live; a RangeError otherwise. `world.users(world.begun)` are pairs of the caller's numbers. */
  users(ids: Float64Array): Uint32Array;
  /** A box around all valid boxes; min > max if there are none. */
  get bounds(): Floats;

  /**
   * Pairs that began in the last update. This, `ended` and `pairs` are the same array each time until the next update or
   * `clear`: copy it with `slice()` before writing to it or transferring it. Later updates do not change it.
   */
  get begun(): Float64Array;
  /** Pairs that ended in the last update. */
  get ended(): Float64Array;
  /** All pairs, sorted by creation of the first, then of the second. */
  get pairs(): Float64Array;

  /** Proxies that touch each box, for one box in no particular order. */
  queryBoxes(boxes: Floats): Hits;
  /**
   * All proxies that each ray meets: the points origin + t * direction, 0 <= t <= length. Three numbers an origin and a
   * direction, which needs no unit length. One length for all, rounded up to the World's floats, or one each; without it
   * rays have no end.
   */
  queryRays(origins: Floats, directions: Floats, lengths?: number | Floats): RayHits;
  /** The first proxy that each ray meets. */
  castRays(origins: Floats, directions: Floats, lengths?: number | Floats): FirstHits;
  /**
   * Ids of the `count` (1) proxies nearest to each point of three numbers, nearest first, 0 where there are no more. Ties
   * are in order of creation, and distances are compared without rounding.
   */
  queryNearest(points: Floats, count?: number): Float64Array;
}

/** The SIMD instructions in use: "WASM". */
export function simdTarget(): string;

export {};
