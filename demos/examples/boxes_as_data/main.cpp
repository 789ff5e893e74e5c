// SPDX-License-Identifier: MIT
// Boxes that are data: integers, half-open, with ids of what they belong to, and their neighbours.
#include <boxstream/boxstream.hpp>

#include <cstdio>
#include <vector>

int main() {
  // Tracks of a board in nanometres, on one layer: z from 0 to 1. The second begins where the first ends.
  const std::vector<boxstream::IntAabb> tracks = {
      {{0, 0, 0}, {1000000, 200000, 1}},
      {{1000000, 0, 0}, {2000000, 200000, 1}},
      {{1500000, 100000, 0}, {1700000, 900000, 1}},
      {{1750000, 300000, 0}, {1900000, 900000, 1}},
  };
  const std::vector<std::uint32_t> nets = {7, 8, 8, 9};

  const auto print = [](const char* what, const std::vector<boxstream::Pair>& pairs) {
    std::printf("%s:", what);
    for (const auto [a, b] : pairs) std::printf(" %u-%u", a, b);
    std::printf("\n");
  };
  boxstream::PairRules rules;
  print("touching", boxstream::find_pairs(tracks, rules));
  rules.touching = false;
  print("open", boxstream::find_pairs(tracks, rules));
  rules.touching = true;
  rules.ids = nets;
  print("of other nets", boxstream::find_pairs(tracks, rules));
  rules.tolerance = 100000;
  print("of other nets, within 100 micrometres", boxstream::find_pairs(tracks, rules));

  boxstream::Detector detector;
  boxstream::Neighbours neighbours;
  detector.find_neighbours(tracks, neighbours);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    std::printf("track %zu touches", i);
    for (std::size_t at = neighbours.offsets[i]; at < neighbours.offsets[i + 1]; ++at)
      std::printf(" %u", neighbours.indices[at]);
    std::printf("\n");
  }
}
