// SPDX-License-Identifier: MIT
// Which points an entry of an experiment's file is about.

/** Of each key one name, a list, or "*" for all; without it all. */
export const matches = (point, where = {}) => Object.entries(where).every(([key, wanted]) => wanted === undefined || [wanted].flat().some((one) => String(one) === "*" || point[key] === String(one)));

export const matching = (points, where) => points.filter((point) => matches(point, where));
