// SPDX-License-Identifier: MIT
//
// Times batches, each given as NAME:N: what constants.sh builds with other constants, and profile.sh looks into. With
// NAME:N:TIMES, searches so often and no more, for tools that count.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <boxstream/detector.hpp>

#include "batches/batches.hpp"
#include "measure.hpp"
#include "pair_hash.hpp"

int main(int argc, char** argv) {
  using namespace boxstream;
  // The second search still waits for memory that the first one sized.
  constexpr std::size_t least_searches = 4;
  constexpr double warm_up_ms = 150, sample_ms = 80;
  const bool counted = argc > 1 && std::count(argv[1], argv[1] + std::strlen(argv[1]), ':') == 2;
  for (double spent = 0; spent < warm_up_ms && !counted;) {
    const std::vector<Aabb> boxes = batches::make("U", 10000, 1);
    spent += bench::time_once([&] { find_pairs(boxes); });
  }
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) return 2;
    char* rest = nullptr;
    const std::size_t n = std::strtoull(name.c_str() + colon + 1, &rest, 10);
    const std::size_t times = *rest == ':' ? std::strtoull(rest + 1, nullptr, 10) : 0;
    const std::vector<Aabb> boxes = batches::make(name.substr(0, colon), n, 1);
    Detector detector;
    std::vector<Pair> pairs;
    detector.find_pairs(boxes, pairs);
    double best = 1e300;
    std::size_t done = 0;
    for (double spent = 0; times > 0 ? done < times : done < least_searches || spent < sample_ms; ++done) {
      const double ms = bench::time_once([&] { detector.find_pairs(boxes, pairs); });
      best = std::min(best, ms);
      spent += ms;
    }
    std::printf("%s %.6f %016llx\n", name.c_str(), best, static_cast<unsigned long long>(bench::summarize(pairs).hash));
  }
}
