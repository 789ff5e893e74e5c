// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "formats/scene_model/settings.hpp"

namespace boxstream::tool {

/// Bodies that carry each other's weight, as a stack or a chain.
struct Column {
  std::size_t bodies = 0;
  double load = 0;  ///< the mass of the last one over that of each of the others
};

/// How finely a world is simulated.
struct Fineness {
  double steps_per_second = 0;  ///< that the engine takes, so substeps where there are some
  int iterations = 0;
};

struct Settings {
  int substeps;
  int iterations;
};

/// To compare by: a substep costs about what twenty iterations do, besides its own.
constexpr int price_of(const Settings& settings) {
  return settings.substeps * (20 + settings.iterations);
}

/// Columns of one kind, as they were measured (bench/results/hard-worlds.md). A world is expected to hold a column
/// that held at the finest measured settings that are no finer than its own. A shorter or lighter column is no harder.
/// Nothing is expected to hold beyond the measured range.
struct Family {
  struct Row {
    Fineness fineness;
    std::vector<double> loads;  ///< the greatest that held for each number of bodies; 0: none
  };
  std::vector<std::size_t> bodies;  ///< ascending
  std::vector<Row> rows;
  /// What a substep of another solver than Bullet's usual one costs, for each number of bodies, over one of that with
  /// ten iterations; empty: this is the usual one.
  std::vector<double> prices{};

  bool holds(const Column& column, const Fineness& fineness) const;

  /// The cheapest settings with which the column held, of substeps of so many steps a second and at least so many
  /// iterations; none if no settings that were tried did.
  std::optional<Settings> cheapest(const Column& column, const Fineness& least) const;

  /// What these settings cost, over a substep of Bullet's usual solver with ten iterations.
  double price(const Column& column, const Settings& settings) const;
};

/// As measured last; the list is compiled in.
struct Families {
  int starts;  ///< from which each world had to hold
  /// Of Bullet's usual solver first, then of others that were measured.
  std::map<scenes::SolverKind, Family> stack, chain;
  std::map<scenes::SolverKind, Family> hanging;  ///< chains that hang at rest; from one start
  std::map<scenes::SolverKind, Family> awake;    ///< stacks that may not fall asleep
};
const Families& measured_families();

/// That of a solver; of one that was not measured, that of Bullet's usual one.
const Family& family_of(const std::map<scenes::SolverKind, Family>& families, scenes::SolverKind kind);

}  // namespace boxstream::tool
