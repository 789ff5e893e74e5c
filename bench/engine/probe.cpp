// SPDX-License-Identifier: MIT
//
// Times batches, each given as NAME:N; constants.sh builds it with other constants, and profile.sh profiles it. With
// NAME:N:TIMES, searches exactly TIMES times, for tools that count.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <boxstream/detector.hpp>

#include "inputs/batches.hpp"
#include "measure/interleave.hpp"
#include "measure/stopwatch.hpp"
#include "peers/pair_hash.hpp"

int main(int argc, char** argv) {
  using namespace boxstream;
  // The second search still waits for memory that the first one sized.
  constexpr std::size_t least_searches = 4;
  constexpr double warm_up_ms = 150, sample_ms = 80;
  const bool counted = argc > 1 && std::count(argv[1], argv[1] + std::strlen(argv[1]), ':') == 2;
  for (double spent = 0; spent < warm_up_ms && !counted;) {
    const std::vector<Aabb> boxes = batches::make("U", 10000, 1);
    spent += measure::time_once([&] { find_pairs(boxes); });
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
    // Not the shortest: the clock of a thread on a virtual machine now and then leaves out a part of its time.
    std::vector<double> searches;
    const auto is_done = [&](double spent) {
      return times > 0 ? searches.size() == times : searches.size() >= least_searches && spent >= sample_ms;
    };
    for (double spent = 0; !is_done(spent); spent += searches.back())
      searches.push_back(measure::time_once([&] { detector.find_pairs(boxes, pairs); }));
    std::printf("%s %.6f %016llx\n", name.c_str(), measure::median(searches),
                static_cast<unsigned long long>(bench::summarize(pairs).hash));
  }
}
