// SPDX-License-Identifier: MIT
#include <algorithm>
#include <random>

#include <boxstream/detector.hpp>

#include "core/fast_oracle.hpp"
#include "inputs/batches.hpp"
#include "load.hpp"

namespace boxstream::soak {
namespace {

class BatchLoad final : public Load {
 public:
  std::uint64_t round(std::uint64_t seed) override {
    std::mt19937_64 random(seed);
    const batches::Batch& batch = batches::all()[random() % batches::all().size()];
    // Sizes over all magnitudes, small ones as often as large ones.
    const std::size_t largest = batch.quadratic ? 1500 : 30000;
    const auto n = static_cast<std::size_t>(
        std::pow(static_cast<double>(largest), std::uniform_real_distribution<double>(0, 1)(random)));
    const std::string name(batch.name);
    compare(batches::make(name, n, seed), batches::make(name, n / 3, seed + 1), name);
    compare(batches::make64(name, n, seed), batches::make64(name, n / 3, seed + 1), name);
    return 4;
  }

 private:
  template <class S>
  void compare(const tests::Boxes<S>& a, const tests::Boxes<S>& b, const std::string& name) {
    detector_.find_pairs(a, pairs_);
    require(pairs_, tests::sweep(a), a, a, name + ", one set");
    detector_.find_pairs(a, b, pairs_);
    require(pairs_, tests::sweep(a, b), a, b, name + ", two sets");
  }

  template <class S>
  static void require(const tests::Pairs& found, const tests::Pairs& truth, const tests::Boxes<S>& a,
                      const tests::Boxes<S>& b, const std::string& what) {
    const std::string difference = tests::first_difference(found, truth, a, b);
    if (!difference.empty()) throw Wrong("batch " + what + ", " + std::to_string(a.size()) + " boxes: " + difference);
  }

  Detector detector_;
  tests::Pairs pairs_;
};

}  // namespace

std::unique_ptr<Load> batch_load() {
  return std::make_unique<BatchLoad>();
}

}  // namespace boxstream::soak
