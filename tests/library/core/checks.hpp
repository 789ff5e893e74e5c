// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <boxstream/detector.hpp>

#include "fast_oracle.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {

/// One Detector, used for search after search, each compared with the truth in pairs and in counts. The paper's tree is
/// asked the same, with scans where a sample wants them and below a cutoff.
/// The checks return false (and have reported a failure) when something differs.
template <class S>
class Checker {
 public:
  explicit Checker(DetectorOptions options = {}) : detector_(options) {
    options.method = Method::hybrid;
    for (const std::uint32_t cutoff : {0, 20}) {
      options.cutoff = cutoff;
      hybrids_.emplace_back(options);
    }
  }

  bool one_set(const Boxes<S>& boxes, const std::string& scene, std::uint64_t seed = 0) {
    return one_set(boxes, truth(boxes), scene, seed);
  }

  bool one_set(const Boxes<S>& boxes, const Pairs& expected, const std::string& scene, std::uint64_t seed = 0) {
    bool right = true;
    for_each_method([&](Detector& detector, const std::string& method) {
      const Stats stats = detector.find_pairs(boxes, found_);
      right &= check_counts(stats, boxes.size(), count_invalid(boxes), scene + method, seed);
      right &= expect_same_pairs(found_, expected, boxes, scene + method, seed);
    });
    return right;
  }

  bool two_sets(const Boxes<S>& a, const Boxes<S>& b, const std::string& scene, std::uint64_t seed = 0) {
    return two_sets(a, b, truth(a, b), scene, seed);
  }

  bool two_sets(const Boxes<S>& a, const Boxes<S>& b, const Pairs& expected, const std::string& scene,
                std::uint64_t seed = 0) {
    bool right = true;
    for_each_method([&](Detector& detector, const std::string& method) {
      const Stats stats = detector.find_pairs(a, b, found_);
      const std::size_t invalid = count_invalid(a) + count_invalid(b);
      right &= check_counts(stats, a.size() + b.size(), invalid, scene + method, seed);
      right &= expect_same_pairs(found_, expected, a, b, scene + method, seed);
    });
    return right;
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

  /// The planned one last, so that what it has found stays.
  template <class Check>
  void for_each_method(const Check& check) {
    check(hybrids_[0], ", hybrid");
    check(hybrids_[1], ", hybrid with a cutoff");
    check(detector_, "");
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
  std::vector<Detector> hybrids_;
  Pairs found_;
};

}  // namespace boxstream::tests
