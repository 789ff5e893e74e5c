// SPDX-License-Identifier: MIT
// Worlds of which it is known by a closed form what must come of them.

/** How many worlds with a closed form are right at which price: the default's is 1. */
export function rightAt(closedForms) {
  const cases = Object.values(closedForms);
  const isRight = ({ error, tolerance }) => error !== null && error <= tolerance;
  const prices = cases.filter((one) => isRight(one) || one.within).map((one) => (isRight(one) ? 1 : Math.max(1, one.price))).sort((a, b) => a - b);
  const steps = [...new Set(prices)].map((price) => [price, prices.filter((other) => other <= price).length]);
  return { all: cases.length, steps, byDefault: cases.filter(isRight).length, never: cases.length - prices.length, most: prices.at(-1) ?? 1 };
}
