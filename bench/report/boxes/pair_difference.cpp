// SPDX-License-Identifier: MIT
#include "boxes/pair_difference.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "peers/peer.hpp"
#include "peers/plain.hpp"

namespace boxstream::report {
namespace {

constexpr std::size_t most_for_all_against_all = 20000;

std::unique_ptr<bench::Peer> second_engine() {
  for (bench::PeerConfig& config : bench::make_peers(1))
    if (config.name == "cgal:100") return std::move(config.peer);
  return bench::make_sweep();
}

}  // namespace

void PairDifference::add(const PairDifference& other) {
  missed += other.missed;
  extra += other.extra;
  duplicates += other.duplicates;
}

std::string PairDifference::complaint(bool extra_allowed) const {
  if (missed == 0 && duplicates == 0 && (extra == 0 || extra_allowed)) return {};
  return fmt::format("{} pairs missed, {} extra, {} found again", missed, extra, duplicates);
}

PairDifference compare_pairs(Span<const Pair> expected, std::vector<Pair> found) {
  std::sort(found.begin(), found.end());
  const auto end = std::unique(found.begin(), found.end());
  PairDifference difference;
  difference.duplicates = static_cast<std::uint64_t>(found.end() - end);
  std::size_t i = 0;
  for (auto pair = found.begin(); pair != end; ++pair) {
    for (; i < expected.size() && expected[i] < *pair; ++i) ++difference.missed;
    if (i < expected.size() && expected[i] == *pair)
      ++i;
    else
      ++difference.extra;
  }
  difference.missed += expected.size() - i;
  return difference;
}

std::vector<Pair> reference_pairs(Span<const Aabb> boxes) {
  const std::unique_ptr<bench::Peer> engine =
      boxes.size() <= most_for_all_against_all ? bench::make_brute_force() : second_engine();
  std::vector<Pair> pairs;
  engine->find_pairs(boxes, pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace boxstream::report
