// SPDX-License-Identifier: MIT
//
// Times batches, each given as NAME:N: what constants.sh builds with other constants, and runs in turn.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <boxstream/detector.hpp>

#include "batches/batches.hpp"
#include "measure.hpp"
#include "pair_hash.hpp"

int main(int argc, char** argv) {
  using namespace boxstream;
  constexpr double warm_up_ms = 150, sample_ms = 80;
  for (double spent = 0; spent < warm_up_ms;) {
    const std::vector<Aabb> boxes = batches::make("U", 10000, 1);
    spent += bench::time_once([&] { find_pairs(boxes); });
  }
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) return 2;
    const std::vector<Aabb> boxes =
        batches::make(name.substr(0, colon), std::strtoull(name.c_str() + colon + 1, nullptr, 10), 1);
    Detector detector;
    std::vector<Pair> pairs;
    detector.find_pairs(boxes, pairs);
    double best = 1e300;
    for (double spent = 0; spent < sample_ms;) {
      const double ms = bench::time_once([&] { detector.find_pairs(boxes, pairs); });
      best = std::min(best, ms);
      spent += ms;
    }
    std::printf("%s %.6f %016llx\n", name.c_str(), best, static_cast<unsigned long long>(bench::summarize(pairs).hash));
  }
}
