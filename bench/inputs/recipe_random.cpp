// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "inputs/recipe.hpp"

namespace boxstream::bench {

namespace {

using batches::Random;

constexpr std::size_t most_parts = 4;

/// Two digits after the point, so that texts are short.
double rounded(double value) {
  return std::round(100 * value) / 100;
}

bool chance(Random& random, double probability) {
  return random.unit() < probability;
}

double random_size(Random& random) {
  return rounded(random.real(-5, 0.3));
}

Part random_part(Random& random) {
  Part part;
  part.weight = static_cast<int>(std::round(random.log_uniform(100)));
  part.place = static_cast<Place>(random.integer(0, 6));
  part.groups = static_cast<int>(std::round(random.log_uniform(300)));
  if (chance(random, 0.5))
    for (double& extent : part.extent) extent = chance(random, 0.5) ? 0 : rounded(random.real(-4, 0));
  const double size = random_size(random);
  const bool cubes = chance(random, 0.4);
  for (double& side : part.size) side = cubes ? size : random_size(random);
  part.decades = chance(random, 0.5) ? 0 : rounded(random.real(0, 4));
  part.alike = chance(random, 0.5);
  part.copies = chance(random, 0.8) ? 1 : static_cast<int>(random.integer(2, 16));
  part.snap = chance(random, 0.8) ? 0 : std::ldexp(1, -static_cast<int>(random.integer(3, 14)));
  if (chance(random, 0.4)) {
    part.pieces = static_cast<int>(std::round(random.log_uniform(64)));
    part.lean = chance(random, 0.6) ? 0 : rounded(random.unit());
    part.jitter = chance(random, 0.5) ? 0 : std::pow(10, -static_cast<int>(random.integer(1, 7)));
  }
  if (chance(random, 0.3)) {
    part.levels = static_cast<int>(random.integer(1, 10));
    part.shrink = rounded(random.real(0.3, 4));
  }
  return part;
}

void mutate(Part& part, Random& random) {
  const auto nudge = [&](double& value) { value = rounded(value + random.real(-0.7, 0.7)); };
  const Part other = random_part(random);
  const std::function<void()> changes[] = {
      [&] { part.weight = other.weight; },
      [&] { part.place = other.place; },
      [&] { part.groups = other.groups; },
      [&] { nudge(part.extent[random.integer(0, 2)]); },
      [&] { std::copy(other.extent, other.extent + 3, part.extent); },
      [&] { part.decades = rounded(std::clamp(part.decades + random.real(-1, 1), 0.0, 5.0)); },
      [&] { part.alike = !part.alike; },
      [&] { std::tie(part.copies, part.snap) = std::tie(other.copies, other.snap); },
      [&] { std::copy(other.size, other.size + 3, part.size); },
      [&] { std::tie(part.pieces, part.lean, part.jitter) = std::tie(other.pieces, other.lean, other.jitter); },
      [&] { std::tie(part.levels, part.shrink) = std::tie(other.levels, other.shrink); },
      [&] { nudge(part.size[random.integer(0, 2)]); },
  };
  changes[random.integer(0, 11)]();
}

}  // namespace

Recipe random_recipe(std::size_t n, Random& random) {
  Recipe recipe;
  recipe.n = n;
  recipe.seed = static_cast<std::uint64_t>(random.integer(1, 999));
  recipe.order = static_cast<Order>(random.integer(0, 3));
  recipe.axis = static_cast<int>(random.integer(0, 2));
  const std::int64_t parts = random.integer(1, most_parts);
  for (std::int64_t i = 0; i < parts; ++i) recipe.parts.push_back(random_part(random));
  return recipe;
}

Recipe mutated(const Recipe& recipe, Random& random) {
  Recipe changed = recipe;
  const std::int64_t changes = random.integer(1, 3);
  for (std::int64_t i = 0; i < changes; ++i) {
    const auto which = static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(changed.parts.size()) - 1));
    if (chance(random, 0.06) && changed.parts.size() < most_parts) {
      changed.parts.push_back(random_part(random));
    } else if (chance(random, 0.06) && changed.parts.size() > 1) {
      changed.parts.erase(changed.parts.begin() + static_cast<std::ptrdiff_t>(which));
    } else if (chance(random, 0.06)) {
      changed.order = static_cast<Order>(random.integer(0, 3));
      changed.axis = static_cast<int>(random.integer(0, 2));
    } else {
      mutate(changed.parts[which], random);
    }
  }
  return changed;
}

}  // namespace boxstream::bench
