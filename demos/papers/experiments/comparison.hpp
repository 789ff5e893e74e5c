// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/structures.hpp"

namespace boxstream::papers {

/// One kind of work on one set of boxes.
struct Job {
  std::string batch;  ///< how the set is called
  std::size_t n;
  unsigned works;                                                   ///< for structures that can do one of these
  double operations;                                                ///< in one run
  std::function<void(Structure&)> once = nullptr;                   ///< for each structure, untimed; may be empty
  std::function<void(Structure&)> prepare = nullptr;                ///< before each run, untimed; may be empty
  std::function<PairSum(Structure&)> run = nullptr;                 ///< must find the same with all structures
  std::function<void(Structure&, unsigned works)> check = nullptr;  ///< after each run, untimed; may be empty
  unsigned not_for = 0;                                             ///< but not for those that have one of these
};

/// Measurements of all structures, side by side.
class Comparison {
 public:
  /// `unit` is that of one operation, of which a millisecond has `units_per_ms`.
  Comparison(const Settings& settings, std::string title, std::string unit, double units_per_ms);

  /// Interleaved; the median of each counts. Throws std::runtime_error when two do not find the same.
  void add(const Job& job);

  /// A value from elsewhere.
  void add(const std::string& structure, const std::string& batch, std::size_t n, double value, std::uint64_t found);

  /// A table of all; a plot of the first batch over n if it has several; for each set, the fastest; and how often
  /// each was that.
  Outcome outcome() const;

 private:
  struct Result {
    std::string structure, batch;
    std::size_t n;
    double value;
    std::uint64_t found;
  };

  std::vector<Result> of_set(const Result& like) const;
  picture::Plot plot() const;

  const Settings& settings_;
  std::string title_, unit_;
  double units_per_ms_;
  std::vector<Result> results_;
};

}  // namespace boxstream::papers
