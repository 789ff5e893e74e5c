// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "sweep.hpp"

namespace boxstream::accuracy {

/// Times of a setting over those of the scene as it is: below 1 it is cheaper. An interval that has 1 in it is noise.
struct Price {
  double value = 1, low = 1, high = 1;
};

/// What to set a scene to, found by running it.
struct Advice {
  Sweep sweep;                      ///< what was tried
  std::optional<std::size_t> best;  ///< among its rows: the cheapest sound one; none: none that was tried is sound
  std::optional<Price> price;       ///< of the best one; none: the scene as it is was not tried, or is void

  const Row* best_row() const { return best ? &sweep.rows[*best] : nullptr; }
  /// The scene as it is; null: not among those that were tried. `Row::unsound` and `Row::failure` say what is wrong
  /// with it.
  const Row* own_row() const { return sweep.own ? &sweep.rows[*sweep.own] : nullptr; }
  bool is_scene_as_it_is() const { return best && best == sweep.own; }
};

/// Asks for the cheapest sound setting among those that are worth trying on the scene, solvers included. `scene` is the
/// text of the file `file`; it takes about `budget_seconds`.
Request advice_request(const nlohmann::json& scene, const std::string& file, double budget_seconds,
                       Elsewhere elsewhere = {});

/// Tries settings in the order of what they are expected to cost, until no other can be cheaper than a sound one whose
/// first measure has an error of at most `request.seek->bound`. `request` has `seek`; `progress` and throws: as `run`.
Advice advise(const Request& request, const Progress& progress);

/// The same of what was tried already.
Advice advice_of(const Request& request, Sweep sweep, std::size_t measure, double bound);

}  // namespace boxstream::accuracy
