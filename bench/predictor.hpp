// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace boxstream::bench {

/// Foretells what a run at n takes, by the power law through the two largest smaller runs that are known.
class Predictor {
 public:
  /// Remembers that `key` took `ms` at `n`.
  void add(const std::string& key, std::size_t n, double ms);

  /// Milliseconds at n, from runs made before or else by `run` at n / 100 and n / 10, which returns theirs. Not more
  /// than is needed to see that `limit_ms` will be passed. Small n, whose runs are over at once, give 0.
  double predict(const std::string& key, std::size_t n, double limit_ms, const std::function<double(std::size_t)>& run);

 private:
  std::map<std::string, std::map<std::size_t, double>> runs_;
};

}  // namespace boxstream::bench
