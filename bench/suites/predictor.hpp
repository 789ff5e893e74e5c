// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace boxstream::bench {

/// Predicts the time of a run at n by the power law through the two largest smaller runs that are known.
class Predictor {
 public:
  /// Adds a run of `key` that took `ms` at `n`.
  void add(const std::string& key, std::size_t n, double ms);

  /// Milliseconds at n, from earlier runs or else from `run` at n / 100 and n / 10, which returns theirs; no more runs
  /// than it takes to see that `limit_ms` will be exceeded. 0 for small n, whose runs are short.
  double predict(const std::string& key, std::size_t n, double limit_ms, const std::function<double(std::size_t)>& run);

 private:
  std::map<std::string, std::map<std::size_t, double>> runs_;
};

}  // namespace boxstream::bench
