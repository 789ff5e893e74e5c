// SPDX-License-Identifier: MIT
#include "papers/experiments/turns.hpp"

#include <utility>

namespace boxstream::papers {

std::vector<Measured> measure_in_turns(int repeats, const std::vector<Contestant>& contestants) {
  std::vector<std::vector<double>> times(contestants.size());
  std::vector<Measured> all(contestants.size());
  for (int i = 0; i < repeats; ++i)
    for (std::size_t c = 0; c < contestants.size(); ++c) {
      PairSum found;
      const auto sink = [&](std::uint32_t a, std::uint32_t b) { found.add(a, b); };
      const double begun = thread_ms();
      contestants[c].search(sink);
      times[c].push_back(thread_ms() - begun);
      all[c].found = found;
      require_same(found, all[0].found, contestants[c].name);
    }
  for (std::size_t c = 0; c < contestants.size(); ++c) all[c].ms = median(std::move(times[c]));
  return all;
}

}  // namespace boxstream::papers
