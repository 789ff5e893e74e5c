// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <boxstream/detector.hpp>

#include "fast_oracle.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {

/// One Detector, used for search after search, each compared with the truth in pairs and in counts.
/// The checks return false (and have reported a failure) when something differs.
template <class S>
class Checker {
 public:
  explicit Checker(DetectorOptions options = {}) : detector_(options) {}

  bool one_set(const Boxes<S>& boxes, const std::string& scene, std::uint64_t seed = 0) {
    return one_set(boxes, truth(boxes), scene, seed);
  }

  bool one_set(const Boxes<S>& boxes, const Pairs& expected, const std::string& scene, std::uint64_t seed = 0) {
    const Stats stats = detector_.find_pairs(boxes, found_);
    const bool counts = check_counts(stats, boxes.size(), count_invalid(boxes), scene, seed);
    return expect_same_pairs(found_, expected, boxes, scene, seed) && counts;
  }

  bool two_sets(const Boxes<S>& a, const Boxes<S>& b, const std::string& scene, std::uint64_t seed = 0) {
    return two_sets(a, b, truth(a, b), scene, seed);
  }

  bool two_sets(const Boxes<S>& a, const Boxes<S>& b, const Pairs& expected, const std::string& scene,
                std::uint64_t seed = 0) {
    const Stats stats = detector_.find_pairs(a, b, found_);
    const bool counts = check_counts(stats, a.size() + b.size(), count_invalid(a) + count_invalid(b), scene, seed);
    return expect_same_pairs(found_, expected, a, b, scene, seed) && counts;
  }

  /// What the last search found, in its order.
  const Pairs& found() const { return found_; }
  Detector& detector() { return detector_; }

 private:
  static constexpr std::size_t brute_force_limit_ = 600;

  static Pairs truth(const Boxes<S>& boxes) {
    return boxes.size() <= brute_force_limit_ ? brute_force(boxes) : sweep(boxes);
  }
  static Pairs truth(const Boxes<S>& a, const Boxes<S>& b) {
    return a.size() + b.size() <= brute_force_limit_ ? brute_force(a, b) : sweep(a, b);
  }

  bool check_counts(const Stats& stats, std::size_t boxes, std::size_t invalid, const std::string& scene,
                    std::uint64_t seed) {
    const bool right = stats.boxes == boxes && stats.invalid == invalid && stats.pairs == found_.size();
    EXPECT_TRUE(right) << "scene " << scene << ", seed " << seed << ": Stats say boxes " << stats.boxes << " of "
                       << boxes << ", invalid " << stats.invalid << " of " << invalid << ", pairs " << stats.pairs
                       << " of " << found_.size();
    return right;
  }

  Detector detector_;
  Pairs found_;
};

}  // namespace boxstream::tests
